#include "coupling/finite_difference_rotations.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/faults.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::ResponseModel;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

constexpr double unit_to = 1e-9;  ///< allowed error of a direction

/// The rotation that equals, up to a sign, the slope along `axis` of the displacement along `direction`, about an axis
/// whose largest component is positive.
struct Slope {
  Eigen::Vector3d about;
  double sign;  ///< rotation = sign · slope
};

Slope slope(const Eigen::Vector3d& axis, const Eigen::Vector3d& direction) {
  const Eigen::Vector3d about = axis.cross(direction);
  Index largest = 0;
  about.cwiseAbs().maxCoeff(&largest);
  const double sign = about(largest) < 0.0 ? -1.0 : 1.0;
  Slope found{sign * about, sign};
  for (double& component : found.about) {
    if (std::abs(component) < unit_to) component = 0.0;  // an exact axis, so that the DOF is named after it
    if (std::abs(component - 1.0) < unit_to) component = 1.0;
  }
  return found;
}

/// The row of the displacement of `point` along `direction`; if it is missing, −1, and the fault is noted.
Index find(const dynamics::DofTable& dofs, const std::string& point, const Eigen::Vector3d& direction,
           const std::string& of, core::Faults& faults) {
  for (std::size_t row = 0; row < dofs.size(); ++row) {
    const Dof& dof = dofs[row];
    if (dof.kind == DofKind::translation && dof.point == point && (dof.direction - direction).norm() < unit_to) {
      return static_cast<Index>(row);
    }
  }
  faults.require(false, of + " " + dynamics::name({point, direction, DofKind::translation}), "is missing");
  return -1;
}

void check(const DifferencePoints& points, core::Faults& faults) {
  faults.require_number(points.distance_m, points.distance_m > 0.0, "the pair " + points.tip + ", " + points.up,
                        "distance S (m)", "be positive");
  faults.require(std::abs(points.axis.norm() - 1.0) < unit_to, "the tool's axis", "is not a unit vector");
  const std::size_t count = points.directions.size();
  faults.require(count == 1 || count == 2, "directions:", "give one or two");
  for (const Eigen::Vector3d& e : points.directions) {
    faults.require(std::abs(e.norm() - 1.0) < unit_to && std::abs(e.dot(points.axis)) < unit_to, "a direction",
                   "is not a unit vector at right angles to the tool's axis");
  }
  if (count == 2) {
    faults.require(std::abs(points.directions[0].dot(points.directions[1])) < unit_to, "the two directions",
                   "are not at right angles");
  }
}

void check(const RotationOptions& options, core::Faults& faults) {
  if (options.tip_section) dynamics::check(*options.tip_section, "the tool between both points", faults);
  faults.require(options.rule != RotationRule::corrected || options.tip_section,
                 "corrected rotations:", "the tool's section between both points is missing");
  faults.require_number(options.section_uncertainty, options.section_uncertainty >= 0.0, "the tool's section",
                        "uncertainty", "not be negative");
}

/// The rows and columns of the FRFs that are needed: for each direction the tip, then the point up the tool.
struct Needed {
  std::vector<Index> rows, columns;
};

Needed needed(const ResponseModel& H, const DifferencePoints& points, core::Faults& faults) {
  Needed found;
  for (const Eigen::Vector3d& e : points.directions) {
    for (const std::string& point : {points.tip, points.up}) {
      found.rows.push_back(find(H.responses, point, e, "the response", faults));
      found.columns.push_back(find(H.forces, point, e, "the force", faults));
    }
  }
  return found;
}

dynamics::DofTable tip_dofs(const DifferencePoints& points) {
  dynamics::DofTable dofs;
  for (const Eigen::Vector3d& e : points.directions) {
    dofs.push_back({points.tip, e, DofKind::translation});
    dofs.push_back({points.tip, slope(points.axis, e).about, DofKind::rotation});
  }
  return dofs;
}

/// The matrix Q of all directions, which gives displacement and rotation at the tip from both displacements.
MatrixXd differences(const DifferencePoints& points) {
  const auto directions = static_cast<Index>(points.directions.size());
  MatrixXd Q = MatrixXd::Zero(2 * directions, 2 * directions);
  for (Index i = 0; i < directions; ++i) {
    const double weight = slope(points.axis, points.directions[static_cast<std::size_t>(i)]).sign / points.distance_m;
    Q.block<2, 2>(2 * i, 2 * i) << 1.0, 0.0, -weight, weight;
  }
  return Q;
}

/// The rank-one estimate N L / H_11 for the force in one direction and the response in another; it is not finite if
/// H_11 is zero and N L is not.
std::complex<double> rank_one(const Eigen::Matrix2cd& T) {
  const std::complex<double> product = T(1, 0) * T(0, 1);
  return product == 0.0 && T(0, 0) == 0.0 ? 0.0 : product / T(0, 0);
}

/// The standard deviation of N L / H from its derivatives by H_11, H_a1 and H_1a, which are independent. weight_i,
/// weight_j: ±1/S.
double rank_one_noise(const Eigen::Matrix2cd& T, double weight_i, double weight_j, const Eigen::Matrix2d& sigma) {
  const std::complex<double> H = T(0, 0), N = T(1, 0), L = T(0, 1);
  if (H == 0.0) return 0.0;  // the estimate is zero or infinite, and has no derivative
  const std::complex<double> by_11 = -(weight_i * L + weight_j * N) / H - N * L / (H * H);
  return std::sqrt(std::norm(by_11 * sigma(0, 0)) + std::norm(weight_i * L / H * sigma(1, 0)) +
                   std::norm(weight_j * N / H * sigma(0, 1)));
}

/// Coefficients of the truncation error of differences over S, as in the header: those due to a force, to a moment, to
/// the inertia of the displacement u and to that of the rotation ψ.
struct Terms {
  double c_F, c_M, c_u, c_psi;
};

/// The truncation error by its leading terms of bending and of shear, which have opposite signs, with the signs of the
/// rotations.
struct Truncation {
  Terms bending, shear;
  double S;
  Eigen::VectorXd sign;

  [[nodiscard]] MatrixXcd operator()(const MatrixXcd& T) const { return by(bending, T) + by(shear, T); }
  /// The sum of the magnitudes of both terms, without their cancellation.
  [[nodiscard]] MatrixXd size(const MatrixXcd& T) const { return by(bending, T).cwiseAbs() + by(shear, T).cwiseAbs(); }

 private:
  [[nodiscard]] MatrixXcd by(const Terms& c, const MatrixXcd& T) const {
    MatrixXcd error = MatrixXcd::Zero(T.rows(), T.cols());
    for (Index i = 0; i < sign.size(); ++i) {
      for (Index j = 0; j < sign.size(); ++j) {
        const std::complex<double> H = T(2 * i, 2 * j), N = T(2 * i + 1, 2 * j), L = T(2 * i, 2 * j + 1);
        const double same = i == j ? 1.0 : 0.0;
        error(2 * i + 1, 2 * j) = sign(i) * (c.c_F * same + c.c_u * H) + c.c_psi * N;
        error(2 * i, 2 * j + 1) = sign(j) * (c.c_F * same + c.c_u * H) + c.c_psi * L;
        error(2 * i + 1, 2 * j + 1) =
            (c.c_M - c.c_F / S) * same + c.c_u * (sign(j) * N + sign(i) * L) + 2.0 * c.c_psi * T(2 * i + 1, 2 * j + 1);
      }
    }
    return error;
  }
};

/// The truncation at an angular frequency (rad/s), with the coefficients given in the header.
Truncation truncation(const DifferencePoints& points, const dynamics::Tube& tube, double omega) {
  const dynamics::BeamSection b = dynamics::section(tube);
  const double EI = b.youngs_modulus_Pa * b.I_y_m4, kGA = b.shear_y * b.shear_modulus_Pa * b.area_m2;
  const double w2 = omega * omega, rhoA = b.density_kg_m3 * b.area_m2, rhoI = b.density_kg_m3 * b.I_y_m4;
  const double S = points.distance_m, S2 = S * S;
  Truncation t{{S2 / (6.0 * EI), -S / (2.0 * EI), w2 * rhoA * S * S2 / (24.0 * EI),
                w2 * (rhoA * S2 * S2 / (120.0 * EI) - rhoI * S2 / (6.0 * EI))},
               {-1.0 / kGA, 0.0, -w2 * rhoA * S / (2.0 * kGA), -w2 * rhoA * S2 / (6.0 * kGA)},
               S,
               {}};
  t.sign.resize(static_cast<Index>(points.directions.size()));
  for (Index i = 0; i < t.sign.size(); ++i) {
    t.sign(i) = slope(points.axis, points.directions[static_cast<std::size_t>(i)]).sign;
  }
  return t;
}

/// One frequency line in progress: T by the second difference, the deviations of the FRFs (or empty), and those of T.
struct Line {
  double hz;
  MatrixXcd T;
  MatrixXd sigma, noise;
};

/// Replaces P by its rank-one estimate if that is the rule; returns the distance between both rules in the entries of
/// P.
MatrixXd apply_rank_one(const MatrixXd& Q, RotationRule rule, Line& line) {
  MatrixXd defect = MatrixXd::Zero(line.T.rows(), line.T.cols());
  for (Index i = 0; i < defect.rows(); i += 2) {
    for (Index j = 0; j < defect.cols(); j += 2) {
      const Eigen::Matrix2cd block = line.T.block<2, 2>(i, j);
      const std::complex<double> P = rank_one(block);
      const double distance = std::abs(P - block(1, 1));
      defect(i + 1, j + 1) = std::isfinite(distance) ? distance : std::numeric_limits<double>::infinity();
      if (rule != RotationRule::rank_one) continue;
      if (!std::isfinite(distance)) {
        std::ostringstream text;
        text << "rotations by rank one at " << line.hz << " Hz: N L / H with H = 0; take the second difference";
        throw core::NumericalError(text.str());
      }
      line.T(i + 1, j + 1) = P;
      if (line.sigma.size() == 0) continue;
      line.noise(i + 1, j + 1) = rank_one_noise(block, Q(i + 1, i + 1), Q(j + 1, j + 1), line.sigma.block<2, 2>(i, j));
    }
  }
  return defect;
}

/// Notes the truncation of the second difference T and its uncertainty, and returns what a correction must subtract
/// (zero if none was asked for).
MatrixXcd truncate(const Truncation& truncation, const RotationOptions& options, const MatrixXcd& T,
                   RotationErrors& errors) {
  // The error formulas need the true T. They are first evaluated at T as measured, then at T less this first estimate.
  const MatrixXcd first = truncation(T);
  const MatrixXcd second = truncation(T - first);
  errors.truncation_uncertainty.emplace_back(options.section_uncertainty * truncation.size(T) +
                                             (second - first).cwiseAbs());
  const MatrixXcd none = MatrixXcd::Zero(T.rows(), T.cols());
  const bool corrected = options.rule == RotationRule::corrected;
  errors.truncation.push_back(corrected ? none : second);
  return corrected ? second : none;
}

}  // namespace

TipReceptance finite_difference_rotations(const ResponseModel& displacements, const DifferencePoints& points,
                                          const RotationOptions& options) {
  dynamics::require_complete(displacements);
  core::Faults faults;
  check(points, faults);
  check(options, faults);
  const Needed where = needed(displacements, points, faults);
  faults.raise("rotations from displacements");
  if (!options.noise.empty()) require_valid(options.noise, displacements);

  const MatrixXd Q = differences(points);
  const MatrixXd Q_squared = Q.cwiseAbs2();
  const dynamics::DofTable dofs = tip_dofs(points);
  TipReceptance tip{{displacements.axis, dofs, dofs, {}}, {}};
  for (std::size_t i = 0; i < displacements.H.size(); ++i) {
    const auto at = static_cast<Index>(i);
    Line line{displacements.axis.hz(at), Q * displacements.H[i](where.rows, where.columns) * Q.transpose(), {}, {}};
    if (!options.noise.empty()) {
      line.sigma = options.noise[i](where.rows, where.columns);
      line.noise = (Q_squared * line.sigma.cwiseAbs2() * Q_squared.transpose()).cwiseSqrt();
    }
    const MatrixXcd second_difference = line.T;
    tip.errors.rank_one.push_back(apply_rank_one(Q, options.rule, line));
    if (options.tip_section) {
      const Truncation of = truncation(points, *options.tip_section, displacements.axis.omega_rad_s(at));
      line.T -= truncate(of, options, second_difference, tip.errors);
    }
    if (line.noise.size() > 0) tip.errors.noise.push_back(std::move(line.noise));
    tip.T.H.push_back(std::move(line.T));
  }
  return tip;
}

std::vector<MatrixXcd> truncation_by_distance(const ResponseModel& near, double near_distance_m,
                                              const ResponseModel& far, double far_distance_m) {
  dynamics::require_equal(near.axis, far.axis);
  core::Faults faults;
  const auto names = [](const dynamics::DofTable& dofs) {
    std::string all;
    for (const Dof& dof : dofs) all += dynamics::name(dof) + " ";
    return all;
  };
  faults.require(names(near.responses) == names(far.responses) && names(near.forces) == names(far.forces),
                 "the two responses", "have different degrees of freedom");
  faults.require(near_distance_m > 0.0 && near_distance_m < far_distance_m && std::isfinite(far_distance_m),
                 "the distances", "must be 0 < S1 < S2");
  faults.raise("truncation of differences");
  dynamics::require_complete(near);
  dynamics::require_complete(far);
  const double weight = near_distance_m / (far_distance_m - near_distance_m);
  std::vector<MatrixXcd> estimate;
  for (std::size_t line = 0; line < near.H.size(); ++line) estimate.emplace_back(weight * (far.H[line] - near.H[line]));
  return estimate;
}

std::vector<MatrixXd> error_bound(const RotationErrors& errors, RotationRule rule, double k) {
  if (!(k >= 0.0 && std::isfinite(k))) throw core::InputError("error of rotations: k must be finite and not negative");
  if (errors.truncation.empty()) {
    throw core::InputError(
        "error of rotations: the truncation is not known; give the tool's section between both points, or a second "
        "distance");
  }
  std::vector<MatrixXd> bound;
  for (std::size_t line = 0; line < errors.truncation.size(); ++line) {
    bound.emplace_back(errors.truncation[line].cwiseAbs());
    if (!errors.truncation_uncertainty.empty()) bound.back() += errors.truncation_uncertainty[line];
    if (rule == RotationRule::rank_one) bound.back() += errors.rank_one[line];
    if (!errors.noise.empty()) bound.back() += k * errors.noise[line];
  }
  return bound;
}

}  // namespace thinwall::coupling
