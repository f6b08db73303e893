#pragma once
// What joins two components, from their free responses and that of the assembly.

#include <string>
#include <vector>

#include "coupling/joints.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// Relative standard deviation √(E|δH|²) / |H| of measured receptances, in one value or one a line.
struct RelativeNoise {
  Eigen::VectorXd part = Eigen::VectorXd::Constant(1, 0.01);
  Eigen::VectorXd robot = Eigen::VectorXd::Constant(1, 0.01);
  Eigen::VectorXd coupled = Eigen::VectorXd::Constant(1, 0.01);
};

/// The noise that a coherence γ² (one a line, in (0, 1]) of `averages` independent averages tells:
/// √((1 − γ²) / (γ² n)), real and imaginary part together (Bendat & Piersol 2010, Eq. 9.90, for modulus and phase
/// alike). Not below 1e-6. Throws InputError for a coherence out of its range or averages < 1.
[[nodiscard]] Eigen::VectorXd noise_from_coherence(const Eigen::VectorXd& coherence, int averages);

/// Where the assembly was measured, and which lines count.
struct IdentificationOptions {
  std::string response_point{};  ///< where the assembly was measured; empty: point a of the contact
  std::string force_point{};     ///< where it was excited; empty: point a of the contact
  RelativeNoise noise{};         ///< > 0
  bool viscous = true;           ///< C is sought
  bool structural = false;       ///< D = ηK is sought; with C the band must tell iωC from iD
  double largest_spread = 0.3;  ///< lines where Z's standard deviation is a larger share of |Z| are left out, in (0, 1)
};

/// Whether the lines told the joint.
enum class IdentificationStatus {
  identified,
  no_information,  ///< too few lines hold any: of some entry no more than there are unknowns; its values are NaN
};

/// Z(ω) = K + iD + iωC of a contact over its n directions. Half widths are of intervals of 95 % confidence.
struct [[nodiscard]] IdentifiedJoint {
  std::vector<Eigen::MatrixXcd> Z;      ///< n × n a line, in closed form; NaN where H − G cannot be inverted
  std::vector<Eigen::MatrixXd> spread;  ///< standard deviation of Z at each line (expected, from the fit)
  JointMatrices joint;                  ///< K, C, D; zero where not sought
  JointMatrices half_width;             ///< of K, C, D
  Eigen::MatrixXd loss_factor, loss_factor_half_width;  ///< η = D/K, if structural
  Eigen::MatrixXi lines_used;                           ///< of each entry
  double chi_squared = 0.0;  ///< (residual / spread)², mean over the degrees of freedom: 1 if the noise is as said
  IdentificationStatus status = IdentificationStatus::identified;
};

/// The dynamic stiffness of one contact from the free responses H of part (point a, P) and robot (point b, R) and the
/// assembly's response G between any point a' and force point b' of the part, in the contact's directions each. With
/// E = H_a'b' − G_a'b' = H_a'P S⁻¹ H_Pb' from Eq. 5,
///
///     S = H_Pb' E⁻¹ H_a'P,     Z = (S − H_PP − H_RR)⁻¹         (docs/theory/coupling.md, Eq. 16)
///
/// line by line: for one direction at a' = b' = P, Z⁻¹ = H_P² / (H_P − G) − H_P − H_R. Over the band K is the weighted
/// mean of Re Z, C and D the weighted least squares of Im Z = D + ωC, entry by entry of (Z + Zᵀ)/2. The weights are
/// 1/var(Z), the variance that the noise of all measured entries makes by first-order propagation at the values of the
/// last fit (Eq. 17), fitted again until they settle: weights taken from Z's own values would favour small ones.
/// Z is an analytic function of the data, so circular noise makes no bias in it to any order; that of the weights is of
/// second order. Noise is taken as independent between entries and lines. Where the residuals are larger than the
/// noise says (chi_squared > 1: a joint of another kind, a direction that is missing), the widths grow by its root.
///
/// The springs' stiffness, damping and loss are not used. Errors: InputError for unequal axes (with their overlap),
/// values that are not finite, unknown points or missing directions, faulty options. Cost lines · n⁴ times some passes.
IdentifiedJoint identify_joint(const dynamics::ResponseModel& part, const dynamics::ResponseModel& robot,
                               const dynamics::ResponseModel& coupled, const Contact& contact,
                               const IdentificationOptions& options = {});

}  // namespace thinwall::coupling
