#pragma once
// Semi- and full-discretization: the map of a period in equal steps, as the literature has it.

#include <Eigen/Core>
#include <array>
#include <vector>

#include "milling/cut/step_coefficients.hpp"
#include "milling/direct/dominant_eigenvalue.hpp"
#include "milling/structure/contact_state.hpp"

namespace thinwall::milling {

/// The map of v = (x_0, y_{−H} … y_{−1}) over a period: the modal state and the contact displacement of the last period
/// at step ends, H ≥ m. Delays are kept as they are: where t_i − τ lies between step ends, y there is the cubic through
/// the four nearest, so that the order in the step and its constant are those of delays of whole steps. 2M + p H
/// unknowns, where the papers carry 2M (m + 1); the map is applied, never formed.
class UniformStepMap {
 public:
  /// The map of a period of `steps` m steps, without a depth yet. Cost O(m).
  UniformStepMap(ContactState state, int steps, double period_s, StepRule rule);

  /// Sets w, m; coefficients of m steps. Throws InputError unless every delay is at least three steps. Cost: semi
  /// O(m (2M + 3 q)³), an exponential a step with a tooth in the cut (Van Loan 1978 for the delayed terms); full
  /// O(m M²); every delay adds O(m M).
  void set_depth(double depth_m, const StepCoefficients& coefficients);

  /// v ↦ v a period later; `in` and `out` have size() entries and may not overlap. Cost O(m M (M + delays)).
  void apply(const Eigen::Ref<const Eigen::VectorXd>& in, Eigen::Ref<Eigen::VectorXd> out) const;

  /// The multiplier of largest modulus, to 1e-11 of it; by Arnoldi's method for larger maps, by all eigenvalues if that
  /// does not converge. Throws NumericalError if neither does.
  [[nodiscard]] DominantEigenvalue dominant() const;

  /// Number of unknowns: states and what is remembered.
  [[nodiscard]] Eigen::Index size() const { return state_.size() + state_.directions() * history_; }
  /// Steps of a period.
  [[nodiscard]] int steps() const { return steps_; }
  /// The period, s.
  [[nodiscard]] double period_s() const { return steps_ * step_s_; }

  /// The force that belongs to an eigenvector over the period at the start of its steps, tool axes, up to a factor:
  /// P_i y_i − Σ_d Q_{d,i} y(t_i − τ_d), where y a period earlier is y/μ. Shape 3 × m. Cost O(m delays).
  [[nodiscard]] Eigen::Matrix3Xcd force_over_period(const DominantEigenvalue& eigen) const;

 private:
  /// A matrix on y_{i + offset}.
  struct Felt {
    int offset = 0;
    Eigen::MatrixXd by;
  };
  /// x_{i+1} = flow x_i + Σ by y_{i + offset}
  struct Step {
    Eigen::MatrixXd flow;
    std::vector<Felt> felt;
  };
  /// Share of y_{i + offset} in a displacement between step ends.
  struct Share {
    int offset = 0;
    double weight = 0.0;
  };
  /// The shares of one delay, for each value of the delayed polynomial.
  using Reach = std::vector<std::vector<Share>>;

  [[nodiscard]] static std::vector<Share> displacement_at(double steps_from_start);
  [[nodiscard]] Reach reach_of(double delay) const;
  static void add_felt(const Eigen::MatrixXd& by, const std::vector<Share>& shares, Step& step);

  [[nodiscard]] Step semi_step(std::size_t i, double depth_m, const StepCoefficients& c,
                               const std::vector<Reach>& reach) const;
  [[nodiscard]] Step full_step(std::size_t i, double depth_m, const StepCoefficients& c,
                               const std::vector<Reach>& reach) const;

  ContactState state_;
  StepRule rule_;
  int steps_ = 0;
  double step_s_ = 0.0;
  Eigen::MatrixXd free_;  ///< e^{ΛΔ}
  /// ∫ e^{Λ (t_{i+1} − t)} B ℓ(t) (1 − σ, σ) dt, σ the share of the step: of a polynomial times a line.
  using Push = std::array<Eigen::MatrixXd, 2>;
  std::vector<Push> state_push_;    ///< for each ℓ of the state
  std::vector<Push> delayed_push_;  ///< for each ℓ of the delayed term
  int history_ = 0;
  StepCoefficients coefficients_;
  std::vector<Step> step_;
};

}  // namespace thinwall::milling
