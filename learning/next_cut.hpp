#pragma once
// The cut whose outcome is expected to tell most about a limit.

#include <optional>
#include <vector>

#include "learning/calibration.hpp"
#include "milling/chart/operating_point.hpp"

namespace thinwall::learning {

/// The highest probability of chatter of a cut that is proposed: a cut that chatters costs a part or a tool.
constexpr double riskiest_next_cut = 0.6;

/// A cut to make, and what it is expected to bring.
struct NextCut {
  milling::OperatingPoint point;
  double chatter_probability = 0.0;
  double deviation_before = 0.0;  ///< standard, of ln of the limiting depth at the wanted speed
  double deviation_after = 0.0;   ///< expected: root of the mean variance over both outcomes
};

/// The one of the `candidates` that minimises the expected variance of ln w at the wanted speed,
///
///     E Var = P Var(ln w | chatter) + (1 − P) Var(ln w | stable)
///
/// over `draws` of the posterior, which an outcome weighs by its probability at each of them; a draw that is stable up
/// to the depth limit has its limit there. Candidates of a probability of chatter above riskiest_next_cut are left out;
/// none if no other is left. Throws InputError without draws or candidates. Cost: draws times a row and
/// a multiplier for each candidate.
[[nodiscard]] std::optional<NextCut> next_cut(const Calibration& calibration, std::size_t draws,
                                              double spindle_speed_rpm,
                                              const std::vector<milling::OperatingPoint>& candidates);

/// The limiting depth of a cut, m; none if its first crossing was missed or the depth is no positive number. Throws as
/// milling::limiting_depth(). Cost: one row.
[[nodiscard]] std::optional<double> answered_limit_m(const milling::Cut& cut, double spindle_speed_rpm,
                                                     milling::StabilityOptions options);

}  // namespace thinwall::learning
