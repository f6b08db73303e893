#pragma once
// The area of the chips of a simulation, held against that by which the material became less.

#include <cmath>
#include <optional>

namespace thinwall::milling {

/// A share of the area by which chips may be off it. With the usual steps they are off by 1e-4 to 1e-3, and forces
/// follow chips.
inline constexpr double most_removal_error = 0.01;

/// Looks at both areas when the record begins, after each tenth of its turns, and after the last. Whatever the motion,
/// they are equal but for the steps; where one of them is not known, nothing is said. Equal areas are necessary for
/// enough steps and do not suffice: too few may begin a chatter whose chips are those of its own motion.
class RemovalCheck {
 public:
  /// Less than `least_m2` is not judged: where a tool enters at a border, the first chips are few.
  RemovalCheck(int recorded_turns, double least_m2)
      : turns_(recorded_turns), turns_a_look_((recorded_turns + 9) / 10), least_m2_(least_m2) {}

  /// True after a turn of the record, 0 before the first one, at which to look.
  [[nodiscard]] bool is_due(int turn) const { return turn == turns_ || (turn >= 0 && turn % turns_a_look_ == 0); }

  /// Takes in the area of the chips since the record began, and that which was cleared, up to a constant, m². Both
  /// count from the first look at which both are known.
  void look(double chips_m2, std::optional<double> cleared_m2, double time_s) {
    error_.reset();
    if (!cleared_m2) return;
    if (!first_m2_) {
      first_m2_ = cleared_m2;
      first_chips_m2_ = chips_m2;
    }
    if (!(*cleared_m2 - *first_m2_ > least_m2_)) return;
    error_ = (chips_m2 - first_chips_m2_) / (*cleared_m2 - *first_m2_) - 1.0;
    if (!broken_s_ && !(std::abs(*error_) < most_removal_error)) broken_s_ = time_s;  // NaN is no balance either
  }

  /// Chips over cleared area, less one, at the last look; none where an area is not known.
  [[nodiscard]] std::optional<double> error() const { return error_; }
  /// The time of the first look at which the error was too large.
  [[nodiscard]] std::optional<double> broken_s() const { return broken_s_; }

 private:
  int turns_, turns_a_look_;
  double least_m2_;
  double first_chips_m2_ = 0.0;
  std::optional<double> first_m2_, error_, broken_s_;
};

}  // namespace thinwall::milling
