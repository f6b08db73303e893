#include "milling/cut/cutting_load.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace thinwall::milling {

namespace {

/// Points a piece of the edge for products of three sines of an angle that turns by the lag.
int points_for(const EdgeShape& shape, const Sweep& sweep, Heights h) {
  int points = 1;
  for (const MeridianPiece& piece : shape.pieces) {
    const double from = std::max(piece.from_m, h.low * shape.depth_m);
    const double to = std::min(piece.to_m, h.high * shape.depth_m);
    if (to > from)
      points = std::max(points, exact_points(piece, from, to, sweep.lag_rad / shape.depth_m * (to - from)));
  }
  return points;
}

}  // namespace

Advance feed_advance(const Cutter& cutter, double feed_per_tooth_m) {
  const double per_rad = feed_per_tooth_m / cutter.pitch_rad();
  return [per_rad](const Sweep& sweep, double height) {
    return Eigen::Vector3d(per_rad * sweep.delay_rad(height), 0.0, 0.0);
  };
}

CuttingLoad edge_load(const Cutter& cutter, const Sweep& sweep, const EdgeShape& shape, double depth_m, double s,
                      const Advance& advance) {
  const CuttingCoefficients& k = sweep.coefficients;
  const Heights h = heights_in_cut(sweep, s);
  CuttingLoad load;
  for (const EdgeWeight& w : edge_weights(shape, points_for(shape, sweep, h), h.low, h.high)) {
    const double phi = sweep.entry_phi_rad + s - w.height * sweep.lag_rad;
    const double sine = std::sin(w.kappa_rad);
    const double cosine = std::cos(w.kappa_rad);
    const Eigen::Vector3d r(std::sin(phi), std::cos(phi), 0.0);
    const Eigen::Vector3d t(std::cos(phi), -std::sin(phi), 0.0);
    const Eigen::Vector3d n = sine * r - cosine * Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d a = cosine * r + sine * Eigen::Vector3d::UnitZ();
    const double height_m = w.height * depth_m;
    const double db = w.weight * depth_m;
    const double dS = edge_length_per_height(cutter, sweep.tooth, height_m) * sine * db;
    const double chip = n.dot(advance(sweep, w.height)) * db;
    const double tangential = k.K_t * chip + k.K_te * dS;
    load.force -= tangential * t + (k.K_r * chip + k.K_re * dS) * n - (k.K_a * chip + k.K_ae * dS) * a;
    load.torque += tangential * at_height(cutter.envelope, cutter.diameter_m, height_m).radius_m;
  }
  return load;
}

CuttingLoad cutting_load(const Cutter& cutter, const CutCycle& cycle, const EdgeShape& shape, double depth_m,
                         double theta_rad, const Advance& advance) {
  CuttingLoad sum;
  for (const Sweep& sweep : cycle.sweeps) {
    each_pass(cycle, sweep, theta_rad, [&](double s) {
      const CuttingLoad one = edge_load(cutter, sweep, shape, depth_m, s, advance);
      sum.force += one.force;
      sum.torque += one.torque;
    });
  }
  return sum;
}

}  // namespace thinwall::milling
