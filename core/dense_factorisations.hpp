#pragma once
// Eigen's dense factorisations of dynamic size, compiled once, in dense_factorisations.cpp: a singular value
// decomposition takes gcc seven seconds, each of the others one to three, which a file that includes this header does
// not spend again. Include it instead of <Eigen/Cholesky>, <Eigen/QR>, <Eigen/SVD> (cmake/check_includes.py), and
// instead of <Eigen/LU> where matrices of dynamic size are factorised.
//
// compute() of LLT and LDLT is a template of its argument, and only its instance for a matrix is compiled here: pass an
// expression as Eigen::MatrixXd(expression); Eigen evaluates it into a matrix in any case. Factorisations of fixed size
// are compiled where they are used.

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

// The kernel of a product by the orthogonal factor of a QR decomposition.
extern template void Eigen::internal::apply_block_householder_on_the_left(
    Eigen::Block<Eigen::MatrixXd>&, const Eigen::Block<Eigen::MatrixXd>&,
    const Eigen::VectorBlock<const Eigen::VectorXd>&, bool);
