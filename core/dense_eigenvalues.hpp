#pragma once
// Eigen's dense eigenvalue solvers of dynamic size, compiled once, in dense_eigenvalues.cpp: each takes gcc six to
// nine seconds, a file that includes this header none of them. It stands for <Eigen/Eigenvalues>
// (cmake/check_includes.py).
//
// compute() is a template of its argument. What is compiled is that of a matrix: hand an expression over as
// Eigen::MatrixXd(expression), which it becomes within anyway. Other sizes are compiled where they are used.

#include <Eigen/Eigenvalues>

#include "core/dense_factorisations.hpp"

extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
extern template class Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>;
extern template class Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>;
extern template class Eigen::EigenSolver<Eigen::MatrixXd>;
extern template class Eigen::ComplexEigenSolver<Eigen::MatrixXcd>;

extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>& Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, int);
extern template Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>&
Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>::compute(const Eigen::EigenBase<Eigen::MatrixXcd>&, int);
extern template Eigen::EigenSolver<Eigen::MatrixXd>& Eigen::EigenSolver<Eigen::MatrixXd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXd>&, bool);
extern template Eigen::ComplexEigenSolver<Eigen::MatrixXcd>& Eigen::ComplexEigenSolver<Eigen::MatrixXcd>::compute(
    const Eigen::EigenBase<Eigen::MatrixXcd>&, bool);
