#pragma once
// A root between two places where a function has opposite signs.

#include <functional>
#include <string>

namespace thinwall::linalg {

/// The function f(a), f(b) of opposite sign at the two ends of an interval.
struct Bracket {
  double a = 0.0;
  double f_a = 0.0;
  double b = 0.0;
  double f_b = 0.0;
};

/// The accuracy at which bracketed_root() ends.
struct RootTolerance {
  double relative = 1e-12;  ///< > 0: width of the bracket over the root
  double value = 0.0;       ///< ≥ 0: |f| that counts as zero
};

/// The root of f in the bracket: regula falsi in the Illinois form (Dowell & Jarratt 1971),
///
///     x = (f_a b − f_b a) / (f_a − f_b),      f of an end that stays twice is halved,
///
/// which converges superlinearly, order 1.44, and never leaves the bracket. Where three values do not halve the
/// bracket, at a kink or a jump, the next one is taken in its middle. `sought` names the root in the error's text, as
/// "the depth of a crossing". Throws NumericalError if f is not finite or 200 values do not settle. Cost: some ten
/// values of a smooth f.
[[nodiscard]] double bracketed_root(const std::function<double(double)>& f, Bracket bracket, RootTolerance tolerance,
                                    const std::string& sought);

}  // namespace thinwall::linalg
