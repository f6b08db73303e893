#pragma once
// The bound of Cramer and Rao: how well poles and residues can be known from noisy lines.

#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "identification/modal_fit.hpp"

namespace thinwall::identification::testing {

/// The mean squares of errors that no estimator without bias falls below, by modes.
struct Bound {
  double pole = 0.0;         ///< expected |δλ|², (rad/s)²
  Eigen::ArrayXXd residues;  ///< expected |δR|² of each entry
};

/// A small change of a mode of rank one.
struct ModeChange {
  std::complex<double> pole;
  Eigen::MatrixXcd residue;
};

/// The changes of pole, right vector and left vector; the left vector's largest entry stays 1.
inline std::vector<ModeChange> changes_of(const FittedMode& mode) {
  const Eigen::MatrixXcd none = Eigen::MatrixXcd::Zero(mode.right.size(), mode.left.size());
  Eigen::Index largest = 0;
  mode.left.cwiseAbs().maxCoeff(&largest);
  std::vector<ModeChange> changes;
  for (const std::complex<double> unit : {std::complex<double>(1.0, 0.0), std::complex<double>(0.0, 1.0)}) {
    changes.push_back({unit * std::abs(mode.pole()), none});
    for (Eigen::Index a = 0; a < mode.right.size(); ++a) {
      changes.push_back({0.0, none});
      changes.back().residue.row(a) = unit * mode.right.norm() * mode.left.transpose();
    }
    for (Eigen::Index b = 0; b < mode.left.size(); ++b) {
      if (b == largest) continue;
      changes.push_back({0.0, none});
      changes.back().residue.col(b) = unit * mode.right;
    }
  }
  return changes;
}

/// The changes of all lines by each change of each mode and of each residual term, in units of their noise: a row for
/// each real and imaginary part, a column a change.
inline Eigen::MatrixXd changes_of_lines(const ModalFit& model, const std::vector<std::vector<ModeChange>>& changes,
                                        const MeasuredLines& lines) {
  const Eigen::Index entries = lines.H.front().size();
  std::vector<Eigen::VectorXd> columns;
  const auto add = [&](const auto& change_at) {
    Eigen::VectorXd column(2 * entries * lines.lines());
    for (Eigen::Index k = 0; k < lines.lines(); ++k) {
      const Eigen::ArrayXXcd change = change_at(std::complex<double>(0.0, 2.0 * std::numbers::pi * lines.hz(k)));
      const Eigen::ArrayXXd weight = (lines.variance[static_cast<std::size_t>(k)].array() / 2.0).rsqrt();
      column.segment(2 * entries * k, entries) = (weight * change.real()).reshaped();
      column.segment(2 * entries * k + entries, entries) = (weight * change.imag()).reshaped();
    }
    columns.push_back(column);
  };
  for (std::size_t r = 0; r < changes.size(); ++r) {
    const std::complex<double> pole = model.modes[r].pole();
    const Eigen::MatrixXcd& R = model.modes[r].residue;
    for (const ModeChange& c : changes[r]) {
      add([&](std::complex<double> s) -> Eigen::ArrayXXcd {
        const std::complex<double> at = s - pole, of_conj = s - std::conj(pole);
        return c.residue / at + c.residue.conjugate() / of_conj + R * (c.pole / (at * at)) +
               R.conjugate() * (std::conj(c.pole) / (of_conj * of_conj));
      });
    }
  }
  const double last = 2.0 * std::numbers::pi * lines.hz(lines.lines() - 1);
  for (int power = model.inertia.size() > 0 ? -2 : 0; power < static_cast<int>(model.powers.size()); ++power) {
    if (power == -1) continue;
    for (Eigen::Index e = 0; e < entries; ++e) {
      add([&](std::complex<double> s) {
        Eigen::ArrayXXcd term = Eigen::ArrayXXcd::Zero(lines.responses(), lines.references());
        term(e) = std::pow(s / last, power);
        return term;
      });
    }
  }
  Eigen::MatrixXd result(columns.front().size(), std::ssize(columns));
  for (std::size_t i = 0; i < columns.size(); ++i) result.col(static_cast<Eigen::Index>(i)) = columns[i];
  return result;
}

/// The bounds of the modes of a model whose lines scatter by their variances: the inverse of the information matrix
/// JᵀJ, with J = changes_of_lines(). The residues of the model are of rank one, and its terms are unknown, too.
inline std::vector<Bound> bounds(const ModalFit& model, const MeasuredLines& lines) {
  std::vector<std::vector<ModeChange>> changes;
  for (const FittedMode& mode : model.modes) changes.push_back(changes_of(mode));
  Eigen::MatrixXd J = changes_of_lines(model, changes, lines);
  const Eigen::VectorXd scale = J.colwise().norm().cwiseInverse();
  J = J * scale.asDiagonal();
  const Eigen::Index unknowns = J.cols();
  const Eigen::MatrixXd T = Eigen::HouseholderQR<Eigen::MatrixXd>(J).matrixQR().topRows(unknowns);
  const Eigen::MatrixXd inverse =
      scale.asDiagonal() * T.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(unknowns, unknowns));
  const Eigen::MatrixXd covariance = inverse * inverse.transpose();
  std::vector<Bound> result;
  Eigen::Index first = 0;
  for (const std::vector<ModeChange>& of_mode : changes) {
    Bound bound{0.0, Eigen::ArrayXXd::Zero(lines.responses(), lines.references())};
    for (std::size_t a = 0; a < of_mode.size(); ++a) {
      for (std::size_t b = 0; b < of_mode.size(); ++b) {
        const double c = covariance(first + static_cast<Eigen::Index>(a), first + static_cast<Eigen::Index>(b));
        bound.pole += c * (of_mode[a].pole * std::conj(of_mode[b].pole)).real();
        bound.residues += c * (of_mode[a].residue.array() * of_mode[b].residue.array().conjugate()).real();
      }
    }
    first += std::ssize(of_mode);
    result.push_back(bound);
  }
  return result;
}

}  // namespace thinwall::identification::testing
