#include "milling/chart/sensitivity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/stability.hpp"
#include "milling/structure/parameter_change.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

using std::numbers::pi;

/// Mode k alone, without residual.
RelativeStructure alone(const RelativeStructure& s, Index k) {
  return {s.poles.segment(k, 1), s.phi.col(k), s.b.col(k)};
}

RelativeStructure with_pole(RelativeStructure mode, complex<double> pole) {
  move_pole(mode, 0, pole);
  return mode;
}

using Coefficient = double CuttingCoefficients::*;

/// One coefficient alone, of every tooth.
MillingProcess with_only(MillingProcess process, Coefficient which) {
  const auto only = [&](const CuttingCoefficients& all) {
    CuttingCoefficients one;
    one.*which = all.*which;
    return one;
  };
  const bool unequal = !equal_teeth(process);
  process.coefficients = only(process.coefficients);
  for (CuttingCoefficients& of_tooth : process.tooth_coefficients) of_tooth = only(of_tooth);
  // Teeth that differ in another coefficient still make a turn the period: an edge force, which no contact sees.
  if (unequal && equal_teeth(process)) process.tooth_coefficients.front().K_te = 1.0;
  process.damping = {};
  return process;
}

/// The crossing on a grid whose depth agrees with it to the estimate, with its eigenpair.
struct Found {
  Resolution resolution;
  DiscreteCut d;
  Crossing crossing;
  Eigenpair pair;
};

Found found_again(const CutAtSpeed& cut, const LobePoint& point, const StabilityOptions& options) {
  Resolution r = finer(resolving(cut, point.depth_m), estimating(cut, point.depth_m, options));
  while (true) {
    Found f{r, discrete(cut, r, point.depth_m), {}, {}};
    const GainOnCircle gain = gain_of(f.d);
    f.crossing = {point.depth_m, multiplier_angle_rad(point, f.d.loop.period_s), 0, {}};
    const bool kept = refine(gain, f.crossing);
    const double error = std::abs(f.crossing.depth_m / point.depth_m - 1.0);
    if (kept && error <= 10.0 * std::max(point.error_estimate, options.error_tolerance)) {
      f.pair = eigenpair_near(gain, f.crossing.theta_rad, 1.0 / f.crossing.depth_m);
      return f;
    }
    r = finer(r);
    if (r.elements * r.nodes > options.most_nodes) break;
  }
  std::ostringstream text;
  text << "sensitivity: no crossing at " << point.depth_m * 1e3 << " mm and " << cut.spindle_speed_rpm
       << " rpm; give a crossing of the same structure and process";
  throw core::NumericalError(text.str());
}

/// ∂ν/∂w of the grid itself, of a helix.
complex<double> own_change(const CutAtSpeed& cut, const Found& f) {
  if (!cut.process.cutter.depends_on_depth()) return 0.0;
  const double step = 1e-5 * f.crossing.depth_m;
  const auto nu_at = [&](double depth) {
    const DiscreteCut d = discrete(cut, f.resolution, depth);
    return eigenpair_near(gain_of(d), f.crossing.theta_rad, f.pair.nu).nu;
  };
  return (nu_at(f.crossing.depth_m + step) - nu_at(f.crossing.depth_m - step)) / (2.0 * step);
}

/// The change of Z when one coefficient doubles, as far as the eigenpair feels it. The loop's eigenvalues are those of
/// M = D G on the forces at the nodes, too, D the cut and G the structure, and M changes by D_which G. With the
/// contacts of both cuts on one grid, X what the contacts see of the motion by the forces of `which`, Y the reverse:
///
///     dν = lᵀ X Y r / (ν lᵀ r)
Eigen::MatrixXcd gain_by(Coefficient which, const CutAtSpeed& cut, const Found& f, double depth_m) {
  const MillingProcess process = with_only(cut.process, which);
  const ContactGrid other = contact_grid(process, cut.yielding, f.resolution, depth_m);
  ContactGrid both = f.d.grid;
  both.contacts.insert(both.contacts.end(), other.contacts.begin(), other.contacts.end());
  const Eigen::MatrixXcd Z =
      loop_gain(regenerative_loop(cut.structure, both, cut.spindle_speed_rpm), on_circle(f.crossing.theta_rad));
  const auto contacts = static_cast<Index>(f.d.grid.contacts.size());
  const auto others = static_cast<Index>(other.contacts.size());
  return -Z.topRightCorner(contacts, others) * Z.bottomLeftCorner(others, contacts) / f.pair.nu;
}

/// The gain that is a share of the way from that of one loop to that of another with the same contacts; both must
/// outlive it.
GainOnCircle gain_between(const RegenerativeLoop& from, const RegenerativeLoop& to, double share) {
  const auto between = [&from, &to, share](const auto& of) {
    auto there = of(to);
    if (share < 1.0) there = share * there + (1.0 - share) * of(from);
    return there;
  };
  return {to.K.rows(),
          [between](double theta) {
            return between([&](const RegenerativeLoop& loop) { return loop_gain(loop, on_circle(theta)); });
          },
          [between](double theta, const Eigen::VectorXcd& l, const Eigen::VectorXcd& r) {
            return between([&](const RegenerativeLoop& loop) { return loop_gain_slope(loop, on_circle(theta), l, r); });
          },
          {}};
}

/// A crossing found again, and how its depth follows the gain.
class DepthFollower {
 public:
  DepthFollower(const CutAtSpeed& cut, const LobePoint& point, const StabilityOptions& options)
      : cut_(cut), found_(found_again(cut, point, options)), by_depth_(own_change(cut, found_)) {
    by_depth_ += 1.0 / (found_.crossing.depth_m * found_.crossing.depth_m);
  }

  [[nodiscard]] const Found& found() const { return found_; }

  /// Z of any structure in tool axes, on the crossing's grid and at its place on the circle.
  [[nodiscard]] Eigen::MatrixXcd gain(const RelativeStructure& structure) const {
    return loop_gain(regenerative_loop(structure, found_.d.grid, cut_.spindle_speed_rpm),
                     on_circle(found_.crossing.theta_rad));
  }

  /// d ln w of a change dZ of the gain.
  [[nodiscard]] double relative_change(const Eigen::MatrixXcd& dZ) const {
    const Eigenpair& pair = found_.pair;
    const double w = found_.crossing.depth_m;
    const complex<double> nu_p =
        -(pair.left.transpose() * dZ * pair.right).value() / (pair.left.transpose() * pair.right).value();
    const bool at_end = found_.crossing.theta_rad == 0.0 || found_.crossing.theta_rad == pi;
    if (at_end) return -nu_p.real() / by_depth_.real() / w;
    Eigen::Matrix2d rows;
    rows << pair.slope.real(), by_depth_.real(), pair.slope.imag(), by_depth_.imag();
    return (rows(1, 0) * nu_p.real() - rows(0, 0) * nu_p.imag()) / rows.determinant() / w;
  }

  /// The depth, m, to which the crossing moves with the loop of another structure in tool axes; none if Newton's rule
  /// does not settle there, on the way in one step, in two or in four.
  [[nodiscard]] std::optional<double> depth_with(const RelativeStructure& structure) const {
    const RegenerativeLoop loop = regenerative_loop(structure, found_.d.grid, cut_.spindle_speed_rpm);
    for (int steps = 1; steps <= 4; steps *= 2) {
      Crossing moved = found_.crossing;
      bool settled = true;
      for (int k = 1; k <= steps && settled; ++k)
        settled =
            to_axis(gain_between(found_.d.loop, loop, static_cast<double>(k) / steps), 1.0 / moved.depth_m, moved);
      if (settled) return moved.depth_m;
    }
    return std::nullopt;
  }

 private:
  const CutAtSpeed& cut_;
  Found found_;
  complex<double> by_depth_;
};

}  // namespace

DepthSensitivity depth_sensitivity(const RelativeStructure& structure, const MillingProcess& process,
                                   double spindle_speed_rpm, const LobePoint& point, const StabilityOptions& options) {
  require_usable(process, options);
  const CutAtSpeed cut = cut_at_speed(structure, process, spindle_speed_rpm);
  const DepthFollower follower(cut, point, options);
  const auto to = [&](Coefficient which) {
    return follower.relative_change(gain_by(which, cut, follower.found(), point.depth_m));
  };
  const Index poles = cut.structure.poles.size();
  DepthSensitivity result{Eigen::VectorXd(poles), Eigen::VectorXd::Zero(poles), Eigen::VectorXd(poles)};
  for (Index k = 0; k < poles; ++k) {
    constexpr double h = 1e-5;
    const RelativeStructure mode = alone(cut.structure, k);
    const complex<double> pole = mode.poles(0);
    result.to_mass(k) = follower.relative_change(-follower.gain(mode));
    const auto by = [&](complex<double> up, complex<double> down) {
      return follower.relative_change((follower.gain(with_pole(mode, up)) - follower.gain(with_pole(mode, down))) /
                                      (2.0 * h));
    };
    result.to_frequency(k) = by(pole * (1.0 + h), pole * (1.0 - h));
    if (pole.imag() == 0.0) continue;
    const double omega = std::abs(pole);
    const double zeta = -pole.real() / omega;
    result.to_damping_ratio(k) = by(pole_of(omega, zeta * (1.0 + h)), pole_of(omega, zeta * (1.0 - h)));
  }
  result.to_K_t = to(&CuttingCoefficients::K_t);
  result.to_K_r = to(&CuttingCoefficients::K_r);
  result.to_K_a = to(&CuttingCoefficients::K_a);
  return result;
}

double relative_depth_change(const RelativeStructure& structure, const RelativeStructure& other,
                             const MillingProcess& process, double spindle_speed_rpm, const LobePoint& point,
                             const StabilityOptions& options) {
  require_usable(process, options);
  const CutAtSpeed cut = cut_at_speed(structure, process, spindle_speed_rpm);
  const DepthFollower follower(cut, point, options);
  return follower.relative_change(follower.gain(in_tool_axes(other, process.frame)) - follower.gain(cut.structure));
}

std::vector<double> moved_depths_m(const RelativeStructure& structure, const std::vector<RelativeStructure>& others,
                                   const MillingProcess& process, double spindle_speed_rpm, const LobePoint& point,
                                   const StabilityOptions& options) {
  require_usable(process, options);
  const CutAtSpeed cut = cut_at_speed(structure, process, spindle_speed_rpm);
  const DepthFollower follower(cut, point, options);
  const Eigen::MatrixXcd Z = follower.gain(cut.structure);
  const bool one_grid = !process.cutter.depends_on_depth();
  std::vector<double> depths;
  depths.reserve(others.size());
  for (const RelativeStructure& other : others) {
    const RelativeStructure turned = in_tool_axes(other, process.frame);
    if (const auto depth = one_grid ? follower.depth_with(turned) : std::nullopt) {
      depths.push_back(*depth);
      continue;
    }
    const double of_reciprocal = 1.0 - follower.relative_change(follower.gain(turned) - Z);
    if (!std::isfinite(of_reciprocal)) throw core::NumericalError("sensitivity: a depth without a derivative");
    depths.push_back(of_reciprocal > 0.0 ? point.depth_m / of_reciprocal : INFINITY);
  }
  return depths;
}

std::vector<std::string> validate(const Uncertainty& u) {
  std::vector<std::string> violations;
  const auto require = [&](double value, const char* what) {
    if (value >= 0.0 && value <= 1.0) return;
    std::ostringstream text;
    text << "uncertainty of " << what << " is " << value << ", must be from 0 to 1; 0.05 is 5 %";
    violations.push_back(text.str());
  };
  require(u.frequency, "frequencies");
  require(u.damping_ratio, "damping ratios");
  require(u.mass, "modal masses");
  require(u.coefficients, "coefficients");
  return violations;
}

double relative_uncertainty(const DepthSensitivity& s, const Uncertainty& u) {
  const double modes = (s.to_frequency * u.frequency).squaredNorm() +
                       (s.to_damping_ratio * u.damping_ratio).squaredNorm() + (s.to_mass * u.mass).squaredNorm();
  const double cutting =
      (s.to_K_t * s.to_K_t + s.to_K_r * s.to_K_r + s.to_K_a * s.to_K_a) * u.coefficients * u.coefficients;
  return std::sqrt(modes + cutting);
}

}  // namespace thinwall::milling
