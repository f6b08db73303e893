#pragma once
// The cut whose outcome is expected to tell most about a limit.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "learning/calibration.hpp"
#include "milling/chart/operating_point.hpp"
#include "milling/direct/lobe_row.hpp"

namespace thinwall::learning {

/// The highest probability of chatter of a cut that is proposed: a cut that chatters costs a part or a tool.
constexpr double riskiest_next_cut = 0.6;

/// A cut to make, and what it is expected to bring.
struct NextCut {
  milling::OperatingPoint point;
  double chatter_probability = 0.0;
  double deviation_before = 0.0;  ///< standard, of ln of what is to be known
  double deviation_after = 0.0;   ///< expected: root of the mean variance over both outcomes
};

/// The expected variance of a quantity y once the outcome of a cut is known, for each of the cuts that are columns of
/// `chatter`, whose rows are the draws' probabilities of chatter p,
///
///     E Var = P Var(y | chatter) + (1 − P) Var(y | stable),     P = Σ w p
///
/// with an outcome weighing a draw by its probability there, and the draws' own weights w, of sum 1. Cost O(entries).
[[nodiscard]] Eigen::VectorXd expected_variances(const Eigen::MatrixXd& chatter, const Eigen::VectorXd& y,
                                                 const Eigen::VectorXd& weights);

/// The one of the `candidates` that minimises expected_variances() of ln w at the wanted speed over `draws` of the
/// posterior; a draw that is stable up to the depth limit has its limit there. Candidates of a probability of chatter
/// above riskiest_next_cut, or without one, are left out; none if no other is left. Throws InputError without draws or
/// candidates, NumericalError if most draws have no limit there. Cost: draws times a row and a multiplier for each
/// candidate.
[[nodiscard]] std::optional<NextCut> next_cut(const Calibration& calibration, std::size_t draws,
                                              double spindle_speed_rpm,
                                              const std::vector<milling::OperatingPoint>& candidates);

/// next_cut() for the speed at which a draw removes most (best_speed_rpm()), its ln in place of that of the limit.
/// Throws as next_cut(). Cost: draws times a row for each speed and a multiplier for each candidate.
[[nodiscard]] std::optional<NextCut> next_cut_for_best_speed(const Calibration& calibration, std::size_t draws,
                                                             const std::vector<double>& speeds_rpm,
                                                             const std::vector<milling::OperatingPoint>& candidates);

/// The next cut for the best speed, where the best speed of every draw is known, that of cut i of
/// cuts_of_draws(calibration, best_rpm.size()) at i, none where it has no limit. Throws as next_cut(), and InputError
/// for more speeds than draws.
[[nodiscard]] std::optional<NextCut> next_cut_for_best_speed(const Calibration& calibration,
                                                             const std::vector<std::optional<double>>& best_rpm,
                                                             const std::vector<milling::OperatingPoint>& candidates);

/// The candidate of the highest removal rate, which is proportional to speed times depth, among those that chatter with
/// a probability of at most `risk` over the draws; none if every one is riskier. Its deviations are 0. Throws
/// InputError as next_cut(), or for a risk that is not between 0 and 1. Cost: draws times a multiplier for each
/// candidate.
[[nodiscard]] std::optional<NextCut> most_productive_cut(const Calibration& calibration, std::size_t draws,
                                                         const std::vector<milling::OperatingPoint>& candidates,
                                                         double risk);

/// The speed of the largest product of speed and limiting depth; none where no limit is known.
[[nodiscard]] std::optional<double> best_speed_rpm(const std::vector<double>& speeds_rpm,
                                                   const std::vector<std::optional<double>>& limits_m);

/// The limiting depth of a row, m; none if a crossing was missed, the data do not tell it, or it is no positive number.
[[nodiscard]] std::optional<double> answered_limit_m(const milling::LobeRow& row);

/// answered_limit_m() of a cut at a speed. Throws as milling::limiting_depth(). Cost: one row.
[[nodiscard]] std::optional<double> limit_at(const milling::Cut& cut, double spindle_speed_rpm,
                                             milling::StabilityOptions options);

}  // namespace thinwall::learning
