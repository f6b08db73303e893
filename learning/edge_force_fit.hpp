#pragma once
// Cutting coefficients and runout from forces over the angle of the tool.

#include <Eigen/Core>
#include <vector>

#include "learning/linear_fit.hpp"
#include "learning/mean_force_fit.hpp"
#include "milling/cut/cutting_force.hpp"
#include "milling/cut/engagement.hpp"
#include "milling/cut/tool.hpp"

namespace thinwall::learning {

/// A steady cut whose force was measured over the angle.
struct ForceRecord {
  milling::Engagement engagement;
  double depth_m = 0.0;           ///< axial
  double feed_per_tooth_m = 0.0;  ///< mean over the teeth
  Eigen::VectorXd angle_rad;      ///< of the tip of the first tooth, φ as in milling::ToolFrame
  Eigen::Matrix3Xd force_n;       ///< on the tool, tool axes: feed, normal, axis; a column an angle
};

/// True of edges on a cylinder, to which both fits of coefficients belong: no ball, no corner, no taper.
[[nodiscard]] bool is_cylinder(const milling::Cutter& cutter);

/// Neighbouring lines of one feed, depth and engagement as one record; the force of a line is that at its angle. Throws
/// InputError unless there is an angle for each line.
[[nodiscard]] std::vector<ForceRecord> records_of(const std::vector<MeanForceTest>& lines,
                                                  const Eigen::VectorXd& angles_rad);

/// The force of a cylinder's edges on the tool at an angle of the first tooth's tip, tool axes, N,
///
///     F = −Σ_j ∫ [(K_t t + K_r r − K_a z_T) h_j dz + (K_te t + K_re r − K_ae z_T) dS],
///     h_j = min_k [ f_k sin φ_j + ρ_j − ρ_{j−k} ],     k = 1 … z
///
/// over the heights at which tooth j stands in the engagement and h_j > 0, with φ_j(z) = φ − Σ pitches up to j − lag z
/// and the cutter's runout ρ (milling/cut/chip_load.hpp; Kline & DeVor 1983). Edge terms act per length of edge dS, as
/// in milling/cut/cutting_load.hpp. Gauss's rule of eight points a piece of an edge between the
/// places where the chip above a surface ends, so that the force of a helix is continuous in the runout. Cost
/// O(teeth³).
[[nodiscard]] Eigen::Vector3d edge_force_n(const milling::Cutter& cutter,
                                           const milling::CuttingCoefficients& coefficients, const ForceRecord& cut,
                                           double angle_rad);

/// The coefficients, N/m² and N/m, and the runout, with intervals of 95 %.
struct EdgeForceFit {
  FittedCoefficient K_t, K_r, K_a, K_te, K_re, K_ae;
  std::vector<FittedCoefficient> runout_m = {};  ///< of each tooth; their sum is 0, since a wider tool is not told
  double r_squared = 0.0;                        ///< 1 − residual/scatter of the forces about their means
  double residual_n = 0.0;                       ///< root mean square
  double condition = 1.0;                        ///< of the equations at the solution, columns of one length
  Eigen::Index degrees_of_freedom = 0;
  int steps = 0;
  bool converged = false;  ///< the last step changed no unknown by more than 1e-9 of its size, or less than noise does
};

/// Nonlinear least squares in the coefficients and the runout of every tooth but the last, which takes what their sum
/// leaves: steps of Gauss-Newton with the exact derivative of edge_force_n(), halved until they gain, from the linear
/// solution without runout, until a step predicts a gain of less than a thousandth of the residual variance. Intervals
/// by the variance of the residuals, which are taken for independent; records that were filtered or sampled densely
/// have fewer independent values than lines. The cutter's own runout is not used. Throws InputError for a bad record,
/// an envelope that is not a cylinder, or where records do not tell the unknowns apart (a condition above 1e8), with
/// the cut to add. Cost: some ten evaluations of all forces and derivatives.
[[nodiscard]] EdgeForceFit fit_edge_forces(const milling::Cutter& cutter, const std::vector<ForceRecord>& records);

}  // namespace thinwall::learning
