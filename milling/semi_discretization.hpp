#pragma once
// First-order semi-discretization of one tooth period (Insperger & Stepan 2002, 2004).

#include <Eigen/Core>
#include <vector>

#include "milling/contact_state.hpp"
#include "milling/cut_step.hpp"
#include "milling/process.hpp"

namespace thinwall::milling {

/// Steps in each segment of the cut. `base` steps are shared out over the cut; each is divided into `division` equal
/// parts, so that division = 1 and 2 give the two step counts of an error estimate.
struct StepCount {
  int base = 1;
  int division = 1;
};

/// The monodromy map of one tooth period at a given speed, for any depth.
///
/// State v = (x, y_0 … y_m): the modal state at tooth entry and the contact displacement of the *previous* period at
/// the m + 1 step ends of the cut. In step i the periodic coefficient is its exact mean and the delayed displacement is
/// linear between y_i and y_{i+1} (first order); the current state is solved exactly (CutStep). Steps end on every
/// tooth entry and exit, and the free flight is exact, so no time is ever rounded to a step. With x in modal
/// coordinates and a history of the contact displacement in the cut only, the map has 2M + p (m + 1) unknowns; it is
/// never formed.
class ToothPeriodMap {
 public:
  /// `rate_rad_s`: the fastest rate within a step, see CutStep. `spindle_speed_rpm` > 0. Cost O(states · n³ + m).
  ToothPeriodMap(const ContactState& state, const MillingProcess& process, double spindle_speed_rpm, StepCount steps,
                 double rate_rad_s);

  /// Sets the axial depth w, m. Cost O(m (p n)³).
  void set_depth(double depth_m);

  /// v ↦ the state one tooth period later. `in` and `out` have size() entries and may not overlap.
  /// Cost O(m · states · p n).
  void apply(const Eigen::Ref<const Eigen::VectorXd>& in, Eigen::Ref<Eigen::VectorXd> out);

  [[nodiscard]] Eigen::Index size() const { return state_.size() + state_.directions() * (step_total_ + 1); }
  [[nodiscard]] int steps() const { return step_total_; }
  [[nodiscard]] double longest_step_s() const;

  /// The force that belongs to an eigenvector v of multiplier μ, as a Fourier coefficient of e^{−iω t} v's motion: with
  /// y(t) = μ y(t−T), F(ω) = −w (1 − 1/μ) Σ_i D_i in_plane ∫_step y e^{−iωt} dt / T (trapezoids). Tool axes, N, up to
  /// the scale of v. The displacement at ω is G(ω) F(ω).
  [[nodiscard]] Eigen::Vector3cd force_harmonic(const Eigen::VectorXcd& v, std::complex<double> mu, double omega) const;

 private:
  struct Segment {
    CutStep step;
    double step_s = 0.0;
    double start_s = 0.0;
    std::vector<Eigen::MatrixXd> D;         ///< mean directional matrix times in_plane of each step, 3 × p
    std::vector<Eigen::MatrixXd> feedback;  ///< −w D (I + w K D)⁻¹ of each step, 3 n × p n
  };

  const ContactState& state_;
  std::vector<Segment> segments_;
  FreeFlight flight_;
  int step_total_ = 0;
  double period_s_ = 0.0;
  double depth_m_ = 0.0;
  Eigen::VectorXd x_, excess_, force_;
};

}  // namespace thinwall::milling
