#pragma once
// Stiffness and damping of an arm's joints from modes that were identified at some of its postures.

#include <Eigen/Core>
#include <vector>

#include "posture/arm_modes.hpp"
#include "posture/tapped_posture.hpp"

namespace thinwall::posture {

/// Trust in the model's modes and in the joints' nominal values, as standard deviations of logarithms.
struct CalibrationOptions {
  double sd_ln_frequency = 0.01;  ///< what the model leaves out, not the noise of an identification, which is less
  double sd_ln_damping = 0.10;
  double sd_ln_stiffness = 0.3;      ///< of a joint about its nominal stiffness
  double sd_ln_joint_damping = 0.5;  ///< of a joint about its nominal damping
  int most_steps = 40;
};

/// The calibrated arm.
struct Calibration {
  robot::SerialArm arm;                 ///< with the stiffnesses and dampings that were found
  Eigen::VectorXd stiffness;            ///< of each joint, N m/rad (N/m)
  Eigen::VectorXd damping;              ///< N m s/rad (N s/m)
  Eigen::MatrixXd covariance;           ///< of all ln k, then all ln d: (JᵀJ)⁻¹ with the priors
  std::vector<std::vector<int>> model;  ///< of each posture and mode the number of the model's mode, −1 for none
  double rms = 0.0;  ///< of all weighted differences of ln f and ln ζ: about 1 if the trust is right
  int steps = 0;
  bool converged = false;
};

/// Numbers of the model's modes that identified ones are: the cheapest pairing by identification::unlikeness(), shapes
/// and frequencies together; −1 for a mode that is unlike all by more than 3, as those of parts that the model has
/// rigid.
[[nodiscard]] std::vector<int> paired(const std::vector<identification::FittedMode>& identified,
                                      const std::vector<identification::FittedMode>& model);

/// Minimises Σ (Δ ln f/σ_f)² + (Δ ln ζ/σ_ζ)² + Σ (Δ ln k/σ_k)² + (Δ ln d/σ_d)² over the joints' stiffnesses and
/// dampings by Gauss-Newton steps, halved until the sum falls. With shapes scaled as in ArmModes and the stretch s_i of
/// a joint,
///
///     ∂λ/∂ ln k_i = −k_i s_i²,   ∂λ/∂ ln d_i = −λ d_i s_i²        (Fox & Kapoor 1968; Adhikari 1999)
///
/// and ln f, ln ζ follow from λ. Modes are paired anew at each step. Throws InputError for no posture, no mode that the
/// model has, a joint without damping, modes whose vectors do not have as many entries as rows are tapped, or as
/// arm_modes() does. Cost: steps × postures × arm_modes().
[[nodiscard]] Calibration calibrate(const TappedArm& nominal, const std::vector<TappedPosture>& postures,
                                    const CalibrationOptions& options = {});

}  // namespace thinwall::posture
