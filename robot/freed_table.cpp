#include "robot/freed_table.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "dynamics/modal_model.hpp"
#include "robot/modal_table.hpp"

namespace thinwall::robot {

namespace {

using dynamics::ModalTable;
using dynamics::ModalTableRow;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

/// The table as ẋ = Λx + B f, y = C x.
struct States {
  VectorXcd poles;
  MatrixXcd C;  ///< DOFs × poles
  MatrixXcd B;  ///< poles × DOFs
};

States states_of(const ModalTable& table) {
  const Index n = std::ssize(table.rows), dofs = std::ssize(table.dofs);
  States states{VectorXcd(2 * n), MatrixXcd(dofs, 2 * n), MatrixXcd(2 * n, dofs)};
  for (Index k = 0; k < n; ++k) {
    const ModalTableRow& row = table.rows[static_cast<std::size_t>(k)];
    const double omega = 2.0 * std::numbers::pi * row.frequency_hz, zeta = row.damping_ratio;
    states.poles(2 * k) = omega * std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta));
    states.poles(2 * k + 1) = std::conj(states.poles(2 * k));
    states.C.col(2 * k) = row.right;
    states.C.col(2 * k + 1) = row.right.conjugate();
    states.B.row(2 * k) = row.left.transpose();
    states.B.row(2 * k + 1) = row.left.adjoint();
  }
  return states;
}

/// The translations of the point.
std::vector<int> moved_dofs(const ModalTable& table, const std::string& point) {
  const auto at_point = [&](const dynamics::Dof& dof) { return dof.point == point; };
  if (std::ranges::none_of(table.dofs, at_point)) {
    std::string points;
    for (const dynamics::Dof& dof : table.dofs) {
      if (points.find("\"" + dof.point + "\"") == std::string::npos)
        points += (points.empty() ? "\"" : ", \"") + dof.point + "\"";
    }
    throw core::InputError("\"" + point + "\" is no point of the table of modes; it has " + points);
  }
  std::vector<int> moved;
  for (const int row : dynamics::rows_of_point(table.dofs, point)) {
    if (table.dofs[static_cast<std::size_t>(row)].kind == dynamics::DofKind::translation) moved.push_back(row);
  }
  if (moved.empty()) throw core::InputError("point \"" + point + "\" has no translation in the table of modes");
  for (const int a : moved) {
    for (const int b : moved) {
      if (a < b && std::abs(table.dofs[static_cast<std::size_t>(a)].direction.dot(
                       table.dofs[static_cast<std::size_t>(b)].direction)) > 1e-9)
        throw core::InputError("a mass at \"" + point + "\" needs orthogonal directions there");
    }
  }
  return moved;
}

/// 1 − m Σ φφᵀ = 1 − m C_p Λ B_p: the share of the inertia at the point that stays.
Eigen::MatrixXd inertia_left(const States& states, const MatrixXcd& C_p, const MatrixXcd& B_p, double mass_kg) {
  const MatrixXcd sum = C_p * states.poles.asDiagonal() * B_p;
  return Eigen::MatrixXd::Identity(sum.rows(), sum.cols()) - mass_kg * sum.real();
}

/// The modes of s E z = A z that oscillate and decay, by rising frequency.
std::vector<ModalTableRow> freed_rows(const States& states, const MatrixXcd& C_p, const MatrixXcd& B_p,
                                      double mass_kg) {
  const Index n = states.poles.size(), p = C_p.rows();
  const double scale = states.poles.cwiseAbs().mean();  // s in the order of 1
  const VectorXcd poles = states.poles / scale;
  // The force u in units in which it moves the states as much as they move it.
  const double force = scale * std::sqrt(mass_kg * scale * C_p.norm() / B_p.norm());
  const MatrixXcd into = B_p * (force / scale);                   // of u into ẋ
  const MatrixXcd out = C_p * (mass_kg * scale * scale / force);  // of s² x into u
  MatrixXcd T = MatrixXcd::Zero(n + p, n + p);                    // A⁻¹E, whose eigenvalues are 1/s
  T.bottomLeftCorner(p, n) = out * poles.asDiagonal();
  T.bottomRightCorner(p, p) = out * into;
  T.topRows(n) = -(poles.cwiseInverse().asDiagonal() * into) * T.bottomRows(p);
  T.topLeftCorner(n, n).diagonal() += poles.cwiseInverse();
  const Eigen::ComplexEigenSolver<MatrixXcd> solver(T);
  if (solver.info() != Eigen::Success)
    throw core::NumericalError("the modes without the mass were not found; leave the mass out");
  const MatrixXcd& Z = solver.eigenvectors();
  const MatrixXcd W = Eigen::PartialPivLU<MatrixXcd>(Z).inverse();  // rows qᵀ
  std::vector<ModalTableRow> rows;
  for (Index k = 0; k < n + p; ++k) {
    const std::complex<double> mu = solver.eigenvalues()(k);
    if (std::abs(mu) < 1e-12) continue;  // infinite: without inertia in C_p B_p
    const std::complex<double> s = 1.0 / mu;
    if (s.imag() < 1e-6 * std::abs(s) || s.real() >= 0.0) continue;
    // wᵀ = qᵀ A⁻¹, and the input b(s) = (B, −s m C_p B) of f.
    const VectorXcd w_x = poles.cwiseInverse().cwiseProduct(W.row(k).head(n).transpose());
    const VectorXcd w_u = W.row(k).tail(p).transpose() -
                          into.transpose() * poles.cwiseInverse().cwiseProduct(W.row(k).head(n).transpose());
    const Eigen::RowVectorXcd b = w_x.transpose() * states.B - s * (w_u.transpose() * out) * states.B;
    ModalTableRow row;
    const std::complex<double> pole = scale * s;
    row.frequency_hz = std::abs(pole) / (2.0 * std::numbers::pi);
    row.damping_ratio = -pole.real() / std::abs(pole);
    row.right = states.C * Z.col(k).head(n);
    row.left = s * b.transpose();
    const double balance = std::sqrt(row.left.norm() / row.right.norm());
    row.right *= balance;
    row.left /= balance;
    rows.push_back(std::move(row));
  }
  std::ranges::sort(rows, {}, &ModalTableRow::frequency_hz);
  if (std::ssize(rows) > n / 2) rows.resize(static_cast<std::size_t>(n / 2));  // beyond them: nearly infinite ones
  return rows;
}

}  // namespace

FreedTable without_point_mass(const ModalTable& table, const std::string& point, double mass_kg) {
  if (!(mass_kg > 0.0 && std::isfinite(mass_kg)))
    throw core::InputError("the mass to be taken off point \"" + point + "\" is " + core::number_text(mass_kg, 3) +
                           " kg, must be above 0");
  const std::vector<int> moved = moved_dofs(table, point);
  (void)modal_model(at_point(table, point));  // sees that the numbers are modes, of one place
  const States states = states_of(table);
  const MatrixXcd C_p = states.C(moved, Eigen::all), B_p = states.B(Eigen::all, moved);
  const Eigen::MatrixXd left = inertia_left(states, C_p, B_p, mass_kg);
  FreedTable freed{{table.dofs, freed_rows(states, C_p, B_p, mass_kg)}, 1.0};
  const Eigen::VectorXd inertia =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(0.5 * (left + left.transpose()))).eigenvalues();
  if (inertia.minCoeff() > 0.0 && freed.table.rows.size() != table.rows.size())
    throw core::InputError("without " + core::readable_text(mass_kg, core::kind::mass) + " at \"" + point +
                           "\" a mode of the table no longer oscillates; state the mass that sat there");
  if (!(inertia.minCoeff() > 0.0))
    throw core::InputError(core::readable_text(mass_kg, core::kind::mass) + " is more than moves at \"" + point +
                           "\" in the modes of the table, by a factor of " +
                           core::number_text(1.0 - inertia.minCoeff(), 3) +
                           "; state the mass that sat there, or tap up to higher frequencies");
  freed.condition = 1.0 / inertia.minCoeff();
  for (std::size_t k = 0; k < table.rows.size(); ++k) {
    freed.table.rows[k].mode = table.rows[k].mode;
    freed.table.rows[k].place_m = table.rows.front().place_m;
  }
  return freed;
}

}  // namespace thinwall::robot
