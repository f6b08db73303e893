#pragma once
// Is the cut stable at a speed and depth, and how deep may it be at a speed? Answers with their error.

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "milling/process.hpp"
#include "milling/relative_structure.hpp"

namespace thinwall::milling {

/// How stability is lost.
enum class Bifurcation {
  hopf,  ///< complex multiplier: quasi-periodic chatter
  flip,  ///< μ = −1: period doubling
  fold,  ///< μ = +1
};

enum class StabilityStatus {
  converged,                 ///< the error estimate meets the tolerance
  step_limit_reached,        ///< it does not, at the largest step count; the estimate says by how much
  stable_to_depth_limit,     ///< no crossing up to the depth limit
  eigenvalue_not_converged,  ///< an eigenvalue on the way did not meet its residual; do not rely on this point
};

[[nodiscard]] std::string name(Bifurcation kind);
[[nodiscard]] std::string name(StabilityStatus status);

struct StabilityOptions {
  double depth_limit_m = 0.02;    ///< > 0: the deepest cut of interest, for instance the tool's cutting length
  double error_tolerance = 0.01;  ///< relative, in (0, 1): of the depth, or of |μ| at a point
  int most_steps = 4096;          ///< ≥ 32: steps in the cut at which refinement gives up
  double scan_ratio = 1.25;  ///< in (1, 2]: between neighbouring depths of the scan. Every unstable range wider than
                             ///< this ratio is found; a narrower island below the limit may be missed, a quarter
                             ///< as wide if it lies just below the limit
};

/// Every violation, empty if there is none.
[[nodiscard]] std::vector<std::string> validate(const StabilityOptions& options);

/// The dominant Floquet multiplier at one speed and depth.
struct Multiplier {
  std::complex<double> value;         ///< Im ≥ 0, finest step count
  double modulus = 0.0;               ///< |μ| extrapolated to zero step size; stable below 1
  double error_estimate = 0.0;        ///< of `modulus`, relative
  double chatter_frequency_hz = 0.0;  ///< of the motion that belongs to μ, decaying or growing
  Bifurcation kind = Bifurcation::hopf;
  int steps = 0;  ///< in the cut, finest
  StabilityStatus status = StabilityStatus::converged;
};

/// The limiting depth at one speed.
struct LobeRow {
  double spindle_speed_rpm = 0.0;
  double limiting_depth_m = 0.0;      ///< the depth limit itself if `at_limit`
  bool at_limit = false;              ///< stable up to the depth limit
  double chatter_frequency_hz = 0.0;  ///< at the crossing, or of the least damped motion at the limit
  Bifurcation kind = Bifurcation::hopf;
  double error_estimate = 0.0;  ///< relative, of the depth; at the limit of |μ|
  int steps = 0;                ///< in the cut, finest
  StabilityStatus status = StabilityStatus::converged;
};

/// |μ| at a point, by first-order semi-discretization with m and 2m steps. The method is of second order, so with
/// δ = |μ_2m| − |μ_m| the result is |μ_2m| + δ/3 (Richardson 1911). The estimate is 1.25 |δ|/3, the distance from the
/// finer of the two values with Roache's (1994) safety factor, plus (ω_c Δ)⁴/10 for the term that is left where δ
/// happens to vanish. m is raised until the estimate meets the tolerance and 2m resolves the chatter frequency by
/// sixteen steps a wave. Throws InputError for a bad process, option, speed or depth (≤ 0). Cost: two dominant
/// eigenvalues for each m.
[[nodiscard]] Multiplier multiplier_at(const RelativeStructure& structure, const MillingProcess& process,
                                       double spindle_speed_rpm, double depth_m, const StabilityOptions& options);

/// The lowest depth in (0, depth_limit] at which |μ| = 1. Below w₀ = 1/(2 max‖D‖ max‖G‖) the loop gain is under one and
/// the cut is stable (small-gain theorem: the difference of the delay has gain 2). From w₀ on a scan in geometric
/// progression finds the first unstable depth, then bracketed root finding (Illinois method, Dowell & Jarratt 1971)
/// with m and 2m steps and Richardson's estimate as above, now of the depth. The scan resolves by five steps a wave
/// every mode that could regenerate at the depth in question, that is with loop gain 2 w ‖D̄‖ ‖φ‖ ‖b‖ / |Re λ| of at
/// least ½. A scan that ends stable is repeated at its least stable depth with 2m steps. Throws InputError as above,
/// NumericalError if no depth is stable.
/// Cost: some 10 to 30 dominant eigenvalues.
[[nodiscard]] LobeRow limiting_depth(const RelativeStructure& structure, const MillingProcess& process,
                                     double spindle_speed_rpm, const StabilityOptions& options);

}  // namespace thinwall::milling
