#include "core/dense_eigenvalues.hpp"

template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>;
template class Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>;
template class Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
template class Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>;
template class Eigen::EigenSolver<Eigen::MatrixXd>;
template class Eigen::ComplexEigenSolver<Eigen::MatrixXcd>;

template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, int);
template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>& Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXcd>&, int);
template Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>::compute(
    const Eigen::EigenBase<Eigen::Matrix3d>&, int);
template Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>& Eigen::SelfAdjointEigenSolver<
    Eigen::Matrix<double, 6, 6>>::compute(const Eigen::EigenBase<Eigen::Matrix<double, 6, 6>>&, int);
template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, bool);
template Eigen::ComplexEigenSolver<Eigen::MatrixXcd>& Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXcd>&, bool);
