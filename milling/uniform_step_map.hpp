#pragma once
// Semi- and full-discretization: the map of a tooth period in equal steps, as the literature has it.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "milling/contact_state.hpp"
#include "milling/dominant_eigenvalue.hpp"
#include "milling/process.hpp"

namespace thinwall::milling {

/// What a step takes for exact, and what for a polynomial. With x' = Λ x − w B [P(t) y(t) − Q(t) y(t−T)], y = C x, and
/// step ends t_i = i T/m:
///
/// semi-discretization (Insperger & Stepan 2002, 2004; of any order Insperger, Stepan & Turi 2008): P and Q are their
/// means over the step, the state is exact, and y(t−T) is the polynomial through its values at t_{i+1}, t_i … of the
/// last period, `delayed_order` + 1 of them (order 0: at t_i, held);
///
/// full-discretization (Ding et al. 2010): Λ is exact, P and Q are linear between their values at t_i and t_{i+1}, y(t)
/// is the polynomial through t_{i+1}, t_i, t_{i−1} …, `state_order` + 1 of them, and y(t−T) that of `delayed_order`.
struct StepRule {
  bool full = false;
  int state_order = 0;  ///< full-discretization only
  int delayed_order = 1;
};

/// Order 0, 1 or 2 in the delayed term.
[[nodiscard]] StepRule semi_discretization(int order);

/// Order 1 (Ding et al. 2010), 2 (Ding et al. 2010b) or 3 (Guo et al. 2012) in the state; the delayed term is linear in
/// all of them.
[[nodiscard]] StepRule full_discretization(int order);

/// P and Q, 3 × p each, N/m²: means over m steps (semi), or values at m + 1 step ends (full).
struct StepCoefficients {
  std::vector<Eigen::MatrixXd> present;
  std::vector<Eigen::MatrixXd> delayed;
};

/// P = Q = Σ D in_plane of the teeth in the cut. The period begins as the literature's, with a tooth at φ = 0, so that
/// entry and exit lie where they happen to lie between step ends. Throws InputError for unequal teeth or a helix.
[[nodiscard]] StepCoefficients step_coefficients(const MillingProcess& process, const Eigen::Matrix2Xd& in_plane,
                                                 int steps, StepRule rule);

/// The map of v = (x_0, y_{−H} … y_{−1}) over a period: the modal state and the contact displacement of the last
/// period, H = m (one more for each order of the delayed term beyond the first). The delay is m steps exactly. 2M + p H
/// unknowns, where the papers carry 2M (m + 1); the map is applied, never formed.
class UniformStepMap {
 public:
  /// Cost O(m). Throws InputError unless m ≥ 3.
  UniformStepMap(ContactState state, StepCoefficients coefficients, double period_s, StepRule rule);

  /// Sets w, m. Cost: semi O(m (2M + p q)³), an exponential a step (Van Loan 1978 for the delayed term); full O(m M²).
  void set_depth(double depth_m);

  /// v ↦ v a period later; `in` and `out` have size() entries and may not overlap. Cost O(m M²).
  void apply(const Eigen::Ref<const Eigen::VectorXd>& in, Eigen::Ref<Eigen::VectorXd> out) const;

  /// The multiplier of largest modulus, to 1e-11 of it; by Arnoldi's method for larger maps, by all eigenvalues if that
  /// does not converge. Throws NumericalError if neither does.
  [[nodiscard]] DominantEigenvalue dominant() const;

  [[nodiscard]] Eigen::Index size() const { return state_.size() + state_.directions() * history_; }
  [[nodiscard]] int steps() const { return steps_; }

  /// The harmonic at ω of the force that belongs to an eigenvector v, tool axes, up to a factor: Σ P_i y_i e^{−iω t_i}.
  [[nodiscard]] Eigen::Vector3cd force_harmonic(const Eigen::VectorXcd& v, double omega_rad_s) const;

 private:
  /// x_{i+1} = flow x_i + Σ earlier_a y_{i−1−a} + Σ past_b y_{i−m+σ_b}
  struct Step {
    Eigen::MatrixXd flow;
    std::vector<Eigen::MatrixXd> earlier;
    std::vector<Eigen::MatrixXd> past;
  };

  [[nodiscard]] Step semi_step(std::size_t i, double depth_m) const;
  [[nodiscard]] Step full_step(std::size_t i, double depth_m) const;

  ContactState state_;
  StepCoefficients coefficients_;
  StepRule rule_;
  int steps_ = 0;
  int history_ = 0;
  double step_s_ = 0.0;
  Eigen::MatrixXd free_;               ///< e^{ΛT/m}
  Eigen::VectorXd point_;              ///< Gauss points of a step, shares of it
  std::vector<Eigen::MatrixXd> push_;  ///< weight · e^{Λ (t_{i+1} − t)} B at them
  std::vector<Step> step_;
};

}  // namespace thinwall::milling
