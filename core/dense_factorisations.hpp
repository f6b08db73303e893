#pragma once
// Eigen's dense factorisations of dynamic size, compiled once, in dense_factorisations.cpp: a singular value
// decomposition takes gcc seven seconds, the others one to three, a file that includes this header none of them. It
// stands for <Eigen/Cholesky>, <Eigen/QR>, <Eigen/SVD> (cmake/check_includes.py), and for <Eigen/LU> where matrices of
// dynamic size are factorised.
//
// compute() of LLT and LDLT is a template of its argument. What is compiled is that of a matrix: hand an expression
// over as Eigen::MatrixXd(expression), which it becomes within anyway. Other sizes are compiled where they are used.

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <Eigen/SVD>

extern template class Eigen::LLT<Eigen::MatrixXd>;
extern template class Eigen::LDLT<Eigen::MatrixXd>;
extern template class Eigen::PartialPivLU<Eigen::MatrixXd>;
extern template class Eigen::PartialPivLU<Eigen::MatrixXcd>;
extern template class Eigen::FullPivLU<Eigen::MatrixXcd>;
extern template class Eigen::HouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::ColPivHouseholderQR<Eigen::MatrixXd>;
extern template class Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>;
extern template class Eigen::JacobiSVD<Eigen::MatrixXd>;
extern template class Eigen::JacobiSVD<Eigen::MatrixXcd>;

extern template Eigen::LLT<Eigen::MatrixXd>& Eigen::LLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
extern template Eigen::LDLT<Eigen::MatrixXd>& Eigen::LDLT<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&);
