#pragma once
// The stability at one speed, or of one point, with its error.

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace thinwall::milling {

/// The kind of the loss of stability.
enum class Bifurcation {
  hopf,  ///< complex multiplier: quasi-periodic chatter
  flip,  ///< μ = −1: period doubling
  fold,  ///< μ = +1
};

/// The outcome of a row.
enum class StabilityStatus {
  converged,              ///< the error estimate meets the tolerance
  node_limit_reached,     ///< it does not, at the largest number of nodes; the estimate says by how much
  data_limited,           ///< it does not, for what noise, spacing and range of a sampled receptance leave open: up to
                          ///< a tenth
  data_insufficient,      ///< likewise, but more than a tenth
  stable_to_depth_limit,  ///< no crossing up to the depth limit
  crossing_missed,        ///< the count of unstable multipliers at the end of the search is not that of the crossings
};

/// The kind in one word, as files have it.
[[nodiscard]] std::string name(Bifurcation kind);

/// The kind of a multiplier on, inside or outside of the circle.
[[nodiscard]] Bifurcation bifurcation_of(std::complex<double> mu);

/// The kind of a multiplier e^{iθ}, 0 ≤ θ ≤ π.
[[nodiscard]] Bifurcation bifurcation_at(double theta_rad);

/// The status as in the enumeration.
[[nodiscard]] std::string name(StabilityStatus status);

/// The depth to search, the accuracy wanted and the nodes allowed.
struct StabilityOptions {
  double depth_limit_m = 0.02;    ///< > 0: the deepest cut of interest, for instance the tool's cutting length
  double error_tolerance = 1e-4;  ///< relative, in (0, 1): of the depth, or of |μ| at a point
  double follow = 20.0;           ///< ≥ 1: crossings are followed up to this many times the first one
  int most_nodes = 240;           ///< ≥ 8: nodes in the cut at which refinement gives up
  std::optional<double> expected_depth_m = {};  ///< of the first crossing, a neighbour's for instance: where the search
                                                ///< begins; a bad one costs time and no more
};

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const StabilityOptions& options);

/// The dominant Floquet multiplier at one speed and depth.
struct Multiplier {
  std::complex<double> value;         ///< Im ≥ 0
  double modulus = 0.0;               ///< stable below 1
  double error_estimate = 0.0;        ///< of `modulus`, relative
  double chatter_frequency_hz = 0.0;  ///< of the motion that belongs to μ, decaying or growing
  Bifurcation kind = Bifurcation::hopf;
  int nodes = 0;  ///< in the cut
  StabilityStatus status = StabilityStatus::converged;
};

/// A depth at which multipliers cross the unit circle.
struct LobePoint {
  double depth_m = 0.0;
  double chatter_frequency_hz = 0.0;
  Bifurcation kind = Bifurcation::hopf;
  int unstable_change = 0;      ///< multipliers that leave the circle there as the depth rises; negative: that return
  double error_estimate = 0.0;  ///< relative, of the depth
};

/// arg μ of a crossing, 0 to π, where the cut repeats itself after period_s.
[[nodiscard]] double multiplier_angle_rad(const LobePoint& point, double period_s);

/// All that is known of one speed: a column of the chart.
struct LobeRow {
  double spindle_speed_rpm = 0.0;
  double limiting_depth_m = 0.0;      ///< the depth limit itself if `at_limit`
  bool at_limit = false;              ///< stable up to the depth limit
  double chatter_frequency_hz = 0.0;  ///< at the crossing, or of the least damped motion at the limit
  Bifurcation kind = Bifurcation::hopf;
  double error_estimate = 0.0;    ///< relative, of the depth; at the limit of |μ|
  double modulus_at_limit = 0.0;  ///< |μ| at the depth limit, if `at_limit`; 0: not known
  double searched_m = 0.0;        ///< the depth up to which stable ranges are known: the crossings add up to the
                                  ///< multipliers that are unstable there. Less than was wanted if deeper ones do not
  std::vector<LobePoint> crossings;  ///< all up to there, ascending: islands and gaps too. Those that bound a
                                     ///< stable range meet the tolerance; deep in an unstable range, beyond one whose
                                     ///< estimate exceeds 1e-3, others may be missing, and with a helix beyond twice
                                     ///< the first those above which the cut is nowhere stable again
  int nodes = 0;                     ///< in the cut
  StabilityStatus status = StabilityStatus::converged;
};

/// True if a row of this status is an answer: converged, stable to the depth limit, or data_limited. No setting makes
/// lines tell more than they do, so that a chart of a good measurement counts as answered with its error said.
[[nodiscard]] bool answers(StabilityStatus status);

/// Limiting depth, frequency, kind and estimate are the first crossing's, if there is one.
void take_limit_from_crossings(LobeRow& row);

}  // namespace thinwall::milling
