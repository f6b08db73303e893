#pragma once
// Identification of the joint between two components from their free responses and that of the assembly.

#include <string>
#include <vector>

#include "coupling/joints.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// The relative standard deviation √(E|δH|²) / |H| of measured receptances, as one value or one for each line.
struct RelativeNoise {
  Eigen::VectorXd part = Eigen::VectorXd::Constant(1, 0.01);
  Eigen::VectorXd robot = Eigen::VectorXd::Constant(1, 0.01);
  Eigen::VectorXd coupled = Eigen::VectorXd::Constant(1, 0.01);
};

/// The relative noise √((1 − γ²) / (γ² n)) that follows from a coherence γ² (one for each line, in (0, 1]) and n =
/// `averages` independent averages, for real and imaginary part together (Bendat & Piersol 2010, Eq. 9.90, for modulus
/// and phase alike). It is at least 1e-6. Throws InputError for a coherence out of its range or averages < 1.
[[nodiscard]] Eigen::VectorXd noise_from_coherence(const Eigen::VectorXd& coherence, int averages);

/// Options of identify_joint(): the points where the assembly was measured, the noise, and the damping sought.
struct IdentificationOptions {
  std::string response_point{};  ///< point where the assembly was measured; empty for point a of the contact
  std::string force_point{};     ///< point where it was excited; empty for point a of the contact
  RelativeNoise noise{};         ///< > 0
  bool viscous = true;           ///< true if C is sought
  bool structural = false;       ///< true if D = ηK is sought; with C, the band must be wide enough to separate both
  double largest_spread = 0.3;  ///< lines where Z's standard deviation is a larger share of |Z| are left out, in (0, 1)
};

/// Outcome of an identification.
enum class IdentificationStatus {
  identified,
  no_information,  ///< some entry has no more usable lines than unknowns; its values are NaN
};

/// The joint Z(ω) = K + iD + iωC of a contact over its n directions. Half widths are those of 95 % confidence
/// intervals.
struct [[nodiscard]] IdentifiedJoint {
  std::vector<Eigen::MatrixXcd> Z;      ///< n × n at each line, in closed form; NaN if H − G cannot be inverted
  std::vector<Eigen::MatrixXd> spread;  ///< expected standard deviation of Z at each line
  JointMatrices joint;                  ///< K, C, D; zero if not sought
  JointMatrices half_width;             ///< half widths of K, C, D
  Eigen::MatrixXd loss_factor, loss_factor_half_width;  ///< η = D/K, if structural
  Eigen::MatrixXi lines_used;                           ///< number of lines used for each entry
  double chi_squared = 0.0;  ///< mean (residual / spread)² by degree of freedom; 1 if noise is as stated
  IdentificationStatus status = IdentificationStatus::identified;
};

/// The dynamic stiffness of one contact, from the free responses H of the part (point a, called P) and the robot (point
/// b, called R) and from the assembly's response G between any response point a' and force point b' of the part, each
/// in the contact's directions. With E = H_a'b' − G_a'b' = H_a'P S⁻¹ H_Pb' from Eq. 5,
///
///     S = H_Pb' E⁻¹ H_a'P,     Z = (S − H_PP − H_RR)⁻¹         (docs/theory/coupling.md, Eq. 16)
///
/// line by line; for one direction at a' = b' = P this is Z⁻¹ = H_P² / (H_P − G) − H_P − H_R. Over the band, K is the
/// weighted mean of Re Z, and C and D follow from weighted least squares of Im Z = D + ωC, for every entry of (Z +
/// Zᵀ)/2. The weights are 1/var(Z), with the variance due to the noise of all measured entries by first-order
/// propagation (Eq. 17), evaluated at the values of the last fit and repeated until they settle: weights from Z's own
/// values at each line would favour lines with small Z. Z is an analytic function of the data, so that circular noise
/// causes no bias in it to any order; the bias due to the weights is of second order. Noise is taken as independent
/// between entries and lines. If the residuals are larger than the stated noise explains (chi_squared > 1: a joint of
/// another kind, or a missing direction), the widths are multiplied by the root of chi_squared.
///
/// The stiffness, damping and loss of the contact's springs are not used. Throws InputError for unequal axes (with
/// their overlap), values that are not finite, unknown points or missing directions, faulty options. Cost lines · n⁴
/// for each of at most 20 passes.
IdentifiedJoint identify_joint(const dynamics::ResponseModel& part, const dynamics::ResponseModel& robot,
                               const dynamics::ResponseModel& coupled, const Contact& contact,
                               const IdentificationOptions& options = {});

}  // namespace thinwall::coupling
