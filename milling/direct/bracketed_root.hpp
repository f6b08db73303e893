#pragma once
// A root between two places where a function has opposite signs.

#include <functional>

namespace thinwall::milling {

/// The root of f between a and b, where f has the values f_a and f_b of opposite sign: regula falsi in the Illinois
/// form (Dowell & Jarratt 1971), which halves the value of an end that stays and so converges superlinearly,
/// order 1.44, and never leaves the bracket. Where three values do not halve the bracket, at a kink, the next one does.
/// To `tolerance`, relative to the root, above 0. Throws NumericalError if f is not finite or 200 values do not settle.
/// Cost: some ten values of a smooth f.
[[nodiscard]] double bracketed_root(const std::function<double(double)>& f, double a, double f_a, double b, double f_b,
                                    double tolerance);

}  // namespace thinwall::milling
