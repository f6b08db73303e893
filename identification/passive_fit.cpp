#include "identification/passive_fit.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "core/dense_eigenvalues.hpp"
#include "core/interrupt.hpp"
#include "dynamics/frf_checks.hpp"

namespace thinwall::identification {

namespace {

using Complex = std::complex<double>;
using dynamics::Collocated;

/// The driving points, and the scale that brings rotations and translations to one size.
struct Points {
  std::vector<int> rows, columns;
  Eigen::VectorXd sign, scale;

  /// A matrix over all responses and forces as one between the points.
  [[nodiscard]] Eigen::MatrixXcd between(const Eigen::MatrixXcd& all) const {
    return scale.asDiagonal() * all(rows, columns) * (scale.cwiseProduct(sign)).asDiagonal();
  }
};

/// The lines, and some beside each resonance.
std::vector<double> checked_lines(const ModalFit& fit, const Eigen::VectorXd& hz) {
  std::vector<double> lines(hz.begin(), hz.end());
  constexpr int beside = 4;
  for (const FittedMode& mode : fit.modes) {
    for (int i = -beside; i <= beside; ++i)
      lines.push_back(mode.frequency_hz * (1.0 + 0.5 * static_cast<double>(i) * mode.damping_ratio));
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

Points points_of(const ModalFit& fit, const std::vector<double>& lines, const std::vector<Collocated>& driving) {
  Points points;
  points.sign.resize(static_cast<Eigen::Index>(driving.size()));
  for (std::size_t i = 0; i < driving.size(); ++i) {
    points.rows.push_back(static_cast<int>(driving[i].row));
    points.columns.push_back(static_cast<int>(driving[i].column));
    points.sign(static_cast<Eigen::Index>(i)) = driving[i].sign;
  }
  points.scale = Eigen::VectorXd::Ones(points.sign.size());
  Eigen::VectorXd largest = Eigen::VectorXd::Constant(points.sign.size(), 1e-300);
  for (const double f : lines) largest = largest.cwiseMax(points.between(value(fit, f)).diagonal().cwiseAbs());
  points.scale = largest.cwiseSqrt().cwiseInverse();
  return points;
}

/// The largest eigenvalue at a line, and the model's size there.
struct Peak {
  double hz = 0.0;
  double eigenvalue = 0.0;  ///< of A
  double size = 0.0;        ///< ‖B‖
  Eigen::VectorXcd vector;
};

Peak peak_at(const ModalFit& fit, double hz, const Points& points) {
  const Eigen::MatrixXcd B = points.between(value(fit, hz));
  const Eigen::MatrixXcd A = (B - B.adjoint()) / Complex(0.0, 2.0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> solver(A);
  const Eigen::Index last = A.rows() - 1;
  return {hz, solver.eigenvalues()(last), B.norm(), solver.eigenvectors().col(last)};
}

/// The local maxima among all lines that are not well below zero.
std::vector<Peak> peaks_of(const std::vector<Peak>& all) {
  constexpr double near = -0.05;
  std::vector<Peak> peaks;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double here = all[i].eigenvalue;
    const bool highest =
        (i == 0 || here >= all[i - 1].eigenvalue) && (i + 1 == all.size() || here >= all[i + 1].eigenvalue);
    if (highest && here > near * all[i].size) peaks.push_back(all[i]);
  }
  return peaks;
}

/// The weighted size of what the lines change by with a residue.
double share_of(const MeasuredLines& lines, Complex pole, const Eigen::MatrixXcd& residue) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < lines.lines(); ++i) {
    const Complex s(0.0, 2.0 * std::numbers::pi * lines.hz(i));
    const Eigen::MatrixXcd change = residue / (s - pole) + residue.conjugate() / (s - std::conj(pole));
    sum += 2.0 * (change.cwiseAbs2().array() / lines.variance[static_cast<std::size_t>(i)].array()).sum();
  }
  return std::sqrt(sum);
}

/// The change of a mode by an unknown of size 1, by which χ² rises by 1.
struct Direction {
  std::size_t mode = 0;
  Eigen::MatrixXcd residue;      ///< of a free residue
  Eigen::VectorXcd right, left;  ///< of the vectors of rank one
  Eigen::MatrixXcd change;       ///< of the residue to first order, between the points
};

/// The entries between the points, for a free residue.
void add_entries(const FittedMode& mode, const Points& points, Complex unit, std::vector<Direction>& directions) {
  for (const int i : points.rows) {
    for (const int j : points.columns) {
      Direction direction;
      direction.residue = Eigen::MatrixXcd::Zero(mode.residue.rows(), mode.residue.cols());
      direction.residue(i, j) = unit * mode.residue.norm();
      directions.push_back(std::move(direction));
    }
  }
}

/// The entries of both vectors at the points. Those of symmetric residues, whose right vector is c times the left one,
/// move together: δR = c δL.
void add_vectors(const FittedMode& mode, const Points& points, Complex unit, Residues form,
                 std::vector<Direction>& directions) {
  const Eigen::VectorXcd still_right = Eigen::VectorXcd::Zero(mode.right.size()),
                         still_left = Eigen::VectorXcd::Zero(mode.left.size());
  if (form == Residues::symmetric) {
    const Complex c = mode.left.dot(mode.right) / mode.left.squaredNorm();
    std::set<int> both(points.rows.begin(), points.rows.end());
    both.insert(points.columns.begin(), points.columns.end());
    for (const int i : both) {
      Direction direction{0, {}, still_right, still_left, {}};
      direction.left(i) = unit * mode.left.norm();
      direction.right(i) = c * direction.left(i);
      directions.push_back(std::move(direction));
    }
    return;
  }
  for (const int i : points.rows) {
    Direction direction{0, {}, still_right, still_left, {}};
    direction.right(i) = unit * mode.right.norm();
    directions.push_back(std::move(direction));
  }
  for (const int j : points.columns) {
    Direction direction{0, {}, still_right, still_left, {}};
    direction.left(j) = unit * mode.left.norm();
    directions.push_back(std::move(direction));
  }
}

/// The directions in which residues of a form move.
std::vector<Direction> directions_of(const ModalFit& fit, const MeasuredLines& lines, const Points& points,
                                     Residues form) {
  std::vector<Direction> all;
  for (std::size_t r = 0; r < fit.modes.size(); ++r) {
    const FittedMode& mode = fit.modes[r];
    const bool is_free = mode.left.size() == 0;
    std::vector<Direction> of_mode;
    for (const Complex unit : {Complex(1.0, 0.0), Complex(0.0, 1.0)}) {
      if (is_free) add_entries(mode, points, unit, of_mode);
      else add_vectors(mode, points, unit, form, of_mode);
    }
    for (Direction& direction : of_mode) {
      const Eigen::MatrixXcd change =
          is_free ? direction.residue
                  : Eigen::MatrixXcd(direction.right * mode.left.transpose() + mode.right * direction.left.transpose());
      const double share = share_of(lines, mode.pole(), change);
      all.push_back({r, direction.residue / share, direction.right / share, direction.left / share,
                     points.between(change) / share});
    }
  }
  return all;
}

/// The smallest x with G x ≤ b (Hildreth 1957).
Eigen::VectorXd least_within(const Eigen::MatrixXd& G, const Eigen::VectorXd& b) {
  constexpr int sweeps = 2000;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(G.cols()), multiplier = Eigen::VectorXd::Zero(G.rows());
  const Eigen::VectorXd square = G.rowwise().squaredNorm().cwiseMax(1e-300);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    double largest = 0.0;
    for (Eigen::Index k = 0; k < G.rows(); ++k) {
      const double next = std::max(0.0, multiplier(k) + (G.row(k).dot(x) - b(k)) / square(k));
      x -= (next - multiplier(k)) * G.row(k).transpose();
      largest = std::max(largest, std::abs(next - multiplier(k)) * std::sqrt(square(k)));
      multiplier(k) = next;
    }
    if (largest < 1e-12) break;
  }
  return x;
}

/// The change of each peak's eigenvalue with each unknown.
Eigen::MatrixXd slopes_of(const ModalFit& fit, const std::vector<Peak>& peaks,
                          const std::vector<Direction>& directions) {
  Eigen::MatrixXd G(std::ssize(peaks), std::ssize(directions));
  for (Eigen::Index k = 0; k < G.rows(); ++k) {
    const Peak& peak = peaks[static_cast<std::size_t>(k)];
    const Complex s(0.0, 2.0 * std::numbers::pi * peak.hz);
    for (Eigen::Index d = 0; d < G.cols(); ++d) {
      const Direction& direction = directions[static_cast<std::size_t>(d)];
      const Complex pole = fit.modes[direction.mode].pole();
      const Complex up = peak.vector.dot(direction.change * peak.vector),
                    down = peak.vector.dot(direction.change.conjugate() * peak.vector);
      G(k, d) = (up / (s - pole) + down / (s - std::conj(pole))).imag();
    }
  }
  return G;
}

void move(ModalFit& fit, const std::vector<Direction>& directions, const Eigen::VectorXd& x) {
  for (std::size_t d = 0; d < directions.size(); ++d) {
    const Direction& direction = directions[d];
    FittedMode& mode = fit.modes[direction.mode];
    const double by = x(static_cast<Eigen::Index>(d));
    if (mode.left.size() == 0) {
      mode.residue += by * direction.residue;
    } else {
      mode.right += by * direction.right;
      mode.left += by * direction.left;
    }
  }
  for (FittedMode& mode : fit.modes) {
    if (mode.left.size() == 0) continue;
    Eigen::Index largest = 0;
    mode.left.cwiseAbs().maxCoeff(&largest);
    const Complex scale = mode.left(largest);
    mode.left /= scale;
    mode.right *= scale;
    mode.residue = mode.right * mode.left.transpose();
  }
}

double excess_of(const std::vector<Peak>& all) {
  double excess = 0.0;
  for (const Peak& peak : all) excess = std::max(excess, peak.eigenvalue / peak.size);
  return excess;
}

}  // namespace

PassiveFit made_passive(const ModalFit& fit, const MeasuredLines& measured, const dynamics::DofTable& responses,
                        const dynamics::DofTable& forces, Residues form) {
  constexpr int most_steps = 60;
  constexpr double margin = 1e-4;
  PassiveFit result{fit, {}};
  result.change.chi2_before = fit.chi2;
  const std::vector<Collocated> driving = dynamics::driving_points({{measured.hz}, responses, forces, {}});
  if (driving.empty()) return result;
  const std::vector<double> lines = checked_lines(fit, measured.hz);
  const Points points = points_of(fit, lines, driving);
  for (int step = 0;; ++step) {
    core::check_interrupt();
    std::vector<Peak> all;
    all.reserve(lines.size());
    for (const double hz : lines) all.push_back(peak_at(result.fit, hz, points));
    result.change.after = excess_of(all);
    if (step == 0) result.change.before = result.change.after;
    if (result.change.after == 0.0 || step == most_steps) break;
    const std::vector<Peak> peaks = peaks_of(all);
    const std::vector<Direction> directions = directions_of(result.fit, measured, points, form);
    Eigen::VectorXd room(std::ssize(peaks));
    for (Eigen::Index k = 0; k < room.size(); ++k) {
      const Peak& peak = peaks[static_cast<std::size_t>(k)];
      room(k) = -peak.eigenvalue - margin * peak.size;
    }
    move(result.fit, directions, least_within(slopes_of(result.fit, peaks, directions), room));
  }
  for (std::size_t r = 0; r < fit.modes.size(); ++r) {
    const Eigen::MatrixXcd before = points.between(fit.modes[r].residue);
    result.change.moved =
        std::max(result.change.moved, (points.between(result.fit.modes[r].residue) - before).norm() / before.norm());
  }
  return result;
}

}  // namespace thinwall::identification
