#pragma once
// Force and torque of all edges together on the tool, with the feed in the chip and the edge terms.

#include <Eigen/Core>
#include <functional>

#include "milling/cut/cut_cycle.hpp"
#include "milling/cut/edge.hpp"

namespace thinwall::milling {

/// Force and torque of the cut on tool and spindle at a moment.
struct CuttingLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  ///< on the tool, tool axes, N
  double torque = 0.0;                              ///< that the spindle must give, N m
};

/// The displacement d of the tool towards the part since the surface that an edge meets was left there, tool axes, m,
/// as a function of a height of the edge (share of the depth). The chip is h = nᵀ d: d = f x_T of a tool that does not
/// vibrate.
using Advance = std::function<Eigen::Vector3d(const Sweep& sweep, double height)>;

/// f x_T with f = z f_z delay/2π, the feed while the edge ahead was followed: the chip of a circle that moves on by f_z
/// a tooth, h = f sin κ sin φ (Martellotti 1941). `feed_per_tooth_m`: the mean over the teeth.
[[nodiscard]] Advance feed_advance(const Cutter& cutter, double feed_per_tooth_m);

/// The load of one tooth's edge whose tip entered s rad ago, with `sweep.coefficients`:
///
///     force  = −∫ [(K_t t + K_r n − K_a a) nᵀd db + (K_te t + K_re n − K_ae a) dS],
///     torque =  ∫ [K_t nᵀd db + K_te dS] r(z)                          over the heights in the cut
///
/// (the signs of cutting_force.hpp; db = dz/sin κ, dS as edge_length_per_height). Gauss's rule, to 1e-10 where d is
/// smooth over the height. `shape` is edge_shape() of the depth.
[[nodiscard]] CuttingLoad edge_load(const Cutter& cutter, const Sweep& sweep, const EdgeShape& shape, double depth_m,
                                    double s, const Advance& advance);

/// The sum over all edges that cut at a rotation of the cycle, rad.
[[nodiscard]] CuttingLoad cutting_load(const Cutter& cutter, const CutCycle& cycle, const EdgeShape& shape,
                                       double depth_m, double theta_rad, const Advance& advance);

}  // namespace thinwall::milling
