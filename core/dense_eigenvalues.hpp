#pragma once
// Eigen's dense eigenvalue solvers of dynamic size, and those of tensors and of six motions, compiled once, in
// dense_eigenvalues.cpp: gcc needs four to nine seconds for each, which a file that includes this header does not spend
// again. Include it instead of <Eigen/Eigenvalues> (cmake/check_includes.py).
//
// compute() is a template of its argument, and only its instance for a matrix is compiled here: pass an expression as
// Eigen::MatrixXd(expression); Eigen evaluates it into a matrix in any case. Solvers of other fixed sizes are compiled
// where they are used.

#include <Eigen/Eigenvalues>

#include "core/dense_factorisations.hpp"

extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>;
extern template class Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>;
extern template class Eigen::EigenSolver<Eigen::MatrixXd>;
extern template class Eigen::ComplexEigenSolver<Eigen::MatrixXcd>;

extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, int);
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>::compute(const Eigen::EigenBase<Eigen::MatrixXcd>&, int);
extern template Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>& Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>::compute(
    const Eigen::EigenBase<Eigen::Matrix3d>&, int);
extern template Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>>& Eigen::SelfAdjointEigenSolver<
    Eigen::Matrix<double, 6, 6>>::compute(const Eigen::EigenBase<Eigen::Matrix<double, 6, 6>>&, int);
extern template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, bool);
extern template Eigen::ComplexEigenSolver<Eigen::MatrixXcd>& Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXcd>&, bool);
