#pragma once
// Linear cutting force and its directional matrix.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "milling/cut/engagement.hpp"
#include "milling/cut/tool.hpp"

namespace thinwall::milling {

/// Force of one tooth with chip thickness h and axial depth w, F_i = w (K_i h + K_ie), i = t, r, a:
/// tangential against the tooth's motion, radial towards the tool's centre, axial along +axis, towards the spindle, all
/// on the *tool* (mechanistic model of Altintas 2012, ch. 2). A helix that draws the tool out of its holder has K_a <
/// 0. The edge terms do not depend on h and so have no part in stability. Where the edge is not parallel to the axis
/// (milling/cut/envelope.hpp) w is the width of cut b, db = dz/sin κ, radial means along the normal of the envelope and
/// axial along its meridian, upwards; the edge terms act per length of edge dS (edge_length_per_height).
struct CuttingCoefficients {
  double K_t = 0.0;   ///< N/m², > 0
  double K_r = 0.0;   ///< N/m²
  double K_a = 0.0;   ///< N/m²
  double K_te = 0.0;  ///< N/m
  double K_re = 0.0;  ///< N/m
  double K_ae = 0.0;  ///< N/m
};

/// Every violation, empty if there is none: all finite, K_t ≥ 0, not all of K_t, K_r, K_a zero.
[[nodiscard]] std::vector<std::string> validate(const CuttingCoefficients& coefficients);

/// Force per chip thickness in tool axes (rows x_T, y_T, z_T) against in-plane displacement (columns x_T, y_T), N/m².
using DirectionalMatrix = Eigen::Matrix<double, 3, 2>;

/// One tooth at φ: with r, t of ToolFrame and chip thickness h = rᵀ [q(t) − q(t−T)],
///
///     D(φ) = (K_t t + K_r r − K_a z_T) rᵀ          tool axes
///
/// so that the regenerative force on the tool is −w D [q(t) − q(t−T)] (Altintas & Budak 1995, with a row for z).
[[nodiscard]] DirectionalMatrix directional_matrix(const CuttingCoefficients& coefficients, double phi_rad);

/// The exact mean of one tooth's D(φ) over from < φ < to.
[[nodiscard]] DirectionalMatrix mean_directional_matrix(const CuttingCoefficients& coefficients, double from_rad,
                                                        double to_rad);

/// The exact mean of Σ_j D(entry + θ + j p) over from < θ < to, j = 0 … teeth − 1, within one segment of the tooth
/// period.
[[nodiscard]] DirectionalMatrix mean_directional_matrix(const CuttingCoefficients& coefficients, const Cutter& cutter,
                                                        const Engagement& engagement, int teeth, double from_rad,
                                                        double to_rad);

/// One tooth at φ whose edge has the axial immersion angle κ: with n = sin κ r − cos κ z_T, a = cos κ r + sin κ z_T,
///
///     D(φ, κ) = (K_t t + K_r n − K_a a) nᵀ,      force on the tool −D [q(t) − q(t−T)] db,      db = dz/sin κ
///
/// tool axes, N/m² (Engin & Altintas 2001, Eq. 17-20, whose axial force has the other sign). At κ = π/2 that of above.
[[nodiscard]] Eigen::Matrix3d directional_matrix_on(const CuttingCoefficients& coefficients, double kappa_rad,
                                                    double phi_rad);

/// Its exact mean over from < φ < to.
[[nodiscard]] Eigen::Matrix3d mean_directional_matrix_on(const CuttingCoefficients& coefficients, double kappa_rad,
                                                         double from_rad, double to_rad);

/// A in part axes, N/m²: the sum over the teeth in the cut when the reference tooth stands `theta_rad` past its entry
/// (0 ≤ θ < pitch), f = −w A [q(t) − q(t−T)] with f on the tool and q tool minus part. A z_T = 0: the chip sees the
/// in-plane displacement only.
[[nodiscard]] Eigen::Matrix3d directional_matrix(const CuttingCoefficients& coefficients, const Cutter& cutter,
                                                 const Engagement& engagement, const ToolFrame& frame,
                                                 double theta_rad);

}  // namespace thinwall::milling
