#include "milling/forced/surface_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "milling/direct/sampled_peak.hpp"

namespace thinwall::milling {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double hair = 1e-9;  // rad, by which a moment lies inside of the cut

/// Rotation from the entry of an arc to the angle at which an edge generates a wall, if the arc holds it.
std::optional<double> reached(const Sweep& sweep, int side) {
  const double wall = side > 0 ? 0.0 : std::numbers::pi;
  double s = std::fmod(wall - sweep.entry_phi_rad + 2.0 * turn, turn);
  if (s > turn - hair) s = 0.0;
  if (s > sweep.arc_rad + hair) return std::nullopt;
  return s;
}

/// The height above which the envelope is its side, m; beyond the depth if the cut does not reach it.
double lowest_of_side(const Cutter& cutter, double depth_m) {
  const MeridianPiece top = edge_shape(cutter, depth_m).pieces.back();
  if (cutter.envelope.straight()) return 0.0;
  return top.straight() && top.kappa_rad == 0.5 * std::numbers::pi - cutter.envelope.taper_rad
             ? top.from_m
             : std::numeric_limits<double>::infinity();
}

double error_at(const Sweep& sweep, int side, double s, double height, const PeriodicMotion& motion) {
  const double inwards = 2.0 * s < sweep.arc_rad ? hair : -hair;
  const double rotation = sweep.entry_rad + s + height * sweep.lag_rad + inwards;
  return side * displacement(motion, moment_at(motion.grid, rotation)).y();
}

}  // namespace

std::vector<SurfaceProfile> surface_profiles(const Cutter& cutter, const CutCycle& cycle, double depth_m,
                                             const PeriodicMotion& motion, int heights) {
  std::vector<SurfaceProfile> profiles;
  const double lowest = lowest_of_side(cutter, depth_m);
  if (!(lowest < depth_m)) return profiles;
  for (const int side : {1, -1}) {
    SurfaceProfile profile{side, Eigen::VectorXd::LinSpaced(heights, lowest, depth_m),
                           Eigen::VectorXd::Constant(heights, -std::numeric_limits<double>::infinity())};
    for (const Sweep& sweep : cycle.sweeps) {
      const auto s = reached(sweep, side);
      if (!s) continue;
      double error = error_at(sweep, side, *s, profile.height_m(0) / depth_m, motion);
      for (Eigen::Index i = 0; i < heights; ++i) {
        // A straight edge generates all heights at one moment.
        if (i > 0 && sweep.lag_rad != 0.0) error = error_at(sweep, side, *s, profile.height_m(i) / depth_m, motion);
        profile.error_m(i) = std::max(profile.error_m(i), error);
      }
    }
    if (profile.error_m.allFinite()) profiles.push_back(std::move(profile));
  }
  return profiles;
}

double largest_error_m(const std::vector<SurfaceProfile>& profiles) {
  double largest = 0.0;
  for (const SurfaceProfile& profile : profiles) {
    const double over = sampled_peak(profile.error_m);
    const double under = -sampled_peak(-profile.error_m);
    for (const double error : {over, under})
      if (std::abs(error) > std::abs(largest)) largest = error;
  }
  return largest;
}

}  // namespace thinwall::milling
