#include "milling/chart/line_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace thinwall::milling {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
constexpr double safety = 2.0;
constexpr double unseen = 0.2;  // of the rise over a corner's gap: lobes may end there otherwise than they seem to

/// The chatter frequency in cuts of the period T: f_c T, by which a motion's multiplier is turned each period.
double periods_of(const LobeRow& row, double periods_per_turn) {
  return 60.0 * row.chatter_frequency_hz / (periods_per_turn * row.spindle_speed_rpm);
}

/// True if two rows may show one motion: both at the depth limit or neither, with one kind and nearly one frequency.
bool alike(const LobeRow& a, const LobeRow& b) {
  constexpr double step = 0.05;
  const double f = a.chatter_frequency_hz, g = b.chatter_frequency_hz;
  return a.at_limit == b.at_limit && a.kind == b.kind && std::abs(f - g) <= step * std::max(f, g);
}

/// True if the boundary runs smoothly from one row to the other; of two rows at the depth limit, if it is one motion
/// that decays least.
bool on_one_lobe(const LobeRow& a, const LobeRow& b, double periods_per_turn) {
  const auto lobe = [&](const LobeRow& row) {
    const double periods = periods_of(row, periods_per_turn);
    return row.kind == Bifurcation::fold ? std::round(periods) : std::floor(periods);  // of a fold it is a whole number
  };
  return alike(a, b) && lobe(a) == lobe(b);
}

/// True if the lobe of two rows goes on as another crossing of the next row than its first: one whose chatter frequency
/// is nearer by half to where the two rows point. Modes beside each other have lobes of one ⌊f_c T⌋ whose frequencies
/// differ by less than those of neighbouring speeds.
bool goes_on_above(const LobeRow& before, const LobeRow& row, const LobeRow& next) {
  if (row.kind != Bifurcation::hopf || next.at_limit) return false;
  const double share =
      (next.spindle_speed_rpm - row.spindle_speed_rpm) / (row.spindle_speed_rpm - before.spindle_speed_rpm);
  const double expected = row.chatter_frequency_hz + share * (row.chatter_frequency_hz - before.chatter_frequency_hz);
  const double first = std::abs(next.chatter_frequency_hz - expected);
  return std::ranges::any_of(next.crossings, [&](const LobePoint& other) {
    return other.kind == Bifurcation::hopf && other.depth_m > next.limiting_depth_m &&
           std::abs(other.chatter_frequency_hz - expected) < 0.5 * first;
  });
}

/// For each gap, true if both rows lie on one lobe. The rows of either side tell that it goes on as a deeper crossing;
/// where both sides can tell, both must, because two rows on the sides of another such corner point anywhere.
std::vector<bool> joined_rows(const std::vector<LobeRow>& rows, double periods_per_turn) {
  std::vector<bool> one(rows.size() - 1);
  for (std::size_t i = 0; i < one.size(); ++i) one[i] = on_one_lobe(rows[i], rows[i + 1], periods_per_turn);
  std::vector<bool> joined = one;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const bool left_tells = i > 0 && one[i - 1], right_tells = i + 1 < one.size() && one[i + 1];
    const bool parts = (left_tells || right_tells) &&
                       (!left_tells || goes_on_above(rows[i - 1], rows[i], rows[i + 1])) &&
                       (!right_tells || goes_on_above(rows[i + 2], rows[i + 1], rows[i]));
    if (parts) joined[i] = false;
  }
  return joined;
}

using Value = double (*)(const LobeRow&);

double depth(const LobeRow& row) {
  return row.limiting_depth_m;
}

/// Nearly straight over the speed on a lobe's flank, where the depth is not.
double inverse_depth(const LobeRow& row) {
  return 1.0 / row.limiting_depth_m;
}

/// The growth of the least stable motion at the depth limit, below 0.
double growth(const LobeRow& row) {
  return std::log(row.modulus_at_limit);
}

double slope(const LobeRow& a, const LobeRow& b, Value value = depth) {
  return (value(b) - value(a)) / (b.spindle_speed_rpm - a.spindle_speed_rpm);
}

/// The second divided difference of three rows.
double curvature(const LobeRow& a, const LobeRow& b, const LobeRow& c, Value value) {
  return (slope(b, c, value) - slope(a, b, value)) / (c.spindle_speed_rpm - a.spindle_speed_rpm);
}

/// The rows around a gap; null where the lobe has none beside it.
struct Around {
  const LobeRow* before = nullptr;
  const LobeRow* left = nullptr;
  const LobeRow* right = nullptr;
  const LobeRow* after = nullptr;
  const LobeRow* farther_before = nullptr;
  const LobeRow* farther_after = nullptr;
};

/// Those around gap i; `joined` tells which neighbouring rows lie on one lobe.
Around around(const std::vector<LobeRow>& rows, const std::vector<bool>& joined, std::size_t i) {
  Around at;
  at.left = &rows[i];
  at.right = &rows[i + 1];
  if (i > 0 && joined[i - 1]) at.before = &rows[i - 1];
  if (at.before != nullptr && i > 1 && joined[i - 2]) at.farther_before = &rows[i - 2];
  if (i + 1 < joined.size() && joined[i + 1]) at.after = &rows[i + 2];
  if (at.after != nullptr && i + 2 < joined.size() && joined[i + 2]) at.farther_after = &rows[i + 3];
  return at;
}

double width(const Around& at) {
  return at.right->spindle_speed_rpm - at.left->spindle_speed_rpm;
}

/// The largest distance of a smooth curve from its chord over the gap, by the rows beside it.
double distance_from_chord(const Around& at, Value value) {
  if (at.before == nullptr && at.after == nullptr) return unknown;
  double bend = 0.0;
  if (at.before != nullptr) bend = std::abs(curvature(*at.before, *at.left, *at.right, value));
  if (at.after != nullptr) bend = std::max(bend, std::abs(curvature(*at.left, *at.right, *at.after, value)));
  return safety * bend * width(at) * width(at) / 4.0;
}

double smooth_error(const Around& at) {
  return distance_from_chord(at, depth) / std::sqrt(depth(*at.left) * depth(*at.right));
}

/// The share of the gap between two rows of one motion, at its crossing or at the depth limit, at which its pair of
/// multipliers passes −1 or +1 (at the limit: the real axis): where 2 f_c T is a whole number; none if it does not.
/// There the two are equal and real, so that beside this speed one of them alone may leave the unit circle sooner: a
/// flip or fold lobe begins and ends within the gap although both rows show the same motion.
std::optional<double> passage_of_real_axis(const LobeRow& left, const LobeRow& right, double periods_per_turn) {
  constexpr double one_motion = 0.5;  // periods: lobes of two motions differ by more as a rule
  if (left.kind != Bifurcation::hopf || !alike(left, right)) return std::nullopt;
  if (right.spindle_speed_rpm <= left.spindle_speed_rpm * (1.0 + narrow_real_lobe)) return std::nullopt;
  const double a = periods_of(left, periods_per_turn), b = periods_of(right, periods_per_turn);
  if (!on_one_lobe(left, right, periods_per_turn) && std::abs(a - b) >= one_motion) return std::nullopt;
  const double half = 0.5 * std::ceil(2.0 * std::min(a, b));
  if (half > std::max(a, b) || a == b) return std::nullopt;
  return std::clamp((half - a) / (b - a), 0.05, 0.95);
}

/// Between two rows that are stable to the depth limit a lobe may be hidden if the growth of motions there, as far as
/// it can have risen, passes 0.
bool may_hide_lobe(const Around& at, bool one_motion) {
  if (at.left->modulus_at_limit <= 0.0 || at.right->modulus_at_limit <= 0.0) return false;
  const double left = growth(*at.left), right = growth(*at.right);
  if (one_motion) {
    // A parabola over a chord that rises by more than four times its height has no top between the ends; twice that.
    const double bump = distance_from_chord(at, growth);
    return std::abs(right - left) < 8.0 * bump && std::max(left, right) + bump > 0.0;
  }
  if (at.before == nullptr || at.after == nullptr) return true;
  const double h = width(at);
  return std::max(left + h * std::max(0.0, slope(*at.before, *at.left, growth)),
                  right - h * std::min(0.0, slope(*at.right, *at.after, growth))) > 0.0;
}

/// A lobe's 1/w continued from its row beside a gap, by a parabola where three of its rows are known, else by its
/// chord.
struct Continued {
  double value = 0.0, slope = 0.0, bend = 0.0;
  double before_rpm = 0.0;  ///< distance from the row to the one behind it

  /// At a distance from the row into the gap, rpm.
  [[nodiscard]] double at(double into_rpm) const {
    return value + slope * into_rpm + bend * into_rpm * (into_rpm + before_rpm);
  }
};

/// `row` is beside the gap, `behind` and `farther` follow away from it; null where the lobe has none.
Continued continued(const LobeRow& row, const LobeRow* behind, const LobeRow* farther) {
  Continued lobe{inverse_depth(row)};
  if (row.at_limit || behind == nullptr) return lobe;
  const double away = behind->spindle_speed_rpm < row.spindle_speed_rpm ? 1.0 : -1.0;
  lobe.slope = away * slope(*behind, row, inverse_depth);
  lobe.before_rpm = std::abs(row.spindle_speed_rpm - behind->spindle_speed_rpm);
  if (farther != nullptr) lobe.bend = curvature(*farther, *behind, row, inverse_depth);
  return lobe;
}

/// The distance from the left row at which two lobes meet within a gap, by bisection; none if the left one is not the
/// lower at the left end, or the right one not at the right end: the boundary is the lower of both.
std::optional<double> corner_of(const Continued& left, const Continued& right, double h) {
  const auto left_is_lower = [&](double x) { return left.at(x) > right.at(h - x); };
  if (!left_is_lower(0.0) || left_is_lower(h)) return std::nullopt;
  double from = 0.0, to = h;
  for (int i = 0; i < 30; ++i) {
    const double middle = 0.5 * (from + to);
    (left_is_lower(middle) ? from : to) = middle;
  }
  return 0.5 * (from + to);
}

/// The corner where the continuations of both lobes meet, and what the line is off there.
void add_corner(const Around& at, LineGap& gap) {
  gap.error = unknown;
  const bool known = (at.before != nullptr || at.left->at_limit) && (at.after != nullptr || at.right->at_limit);
  if (!known) return;
  const double h = width(at);
  const Continued left = continued(*at.left, at.before, at.farther_before);
  const Continued right = continued(*at.right, at.after, at.farther_after);
  const double rise = std::abs(std::log(depth(*at.left) / depth(*at.right)));
  const std::optional<double> x = corner_of(left, right, h);
  if (!x) {
    // Lobes that run nearly side by side do not meet as far as their rows tell: where each goes on close to the
    // other's row, so does the boundary.
    if (!(left.at(h) > 0.0 && right.at(h) > 0.0)) return;
    const double beside =
        std::max(std::abs(1.0 - left.at(h) * depth(*at.right)), std::abs(1.0 - right.at(h) * depth(*at.left)));
    gap.error = std::max(safety * beside, unseen * rise);
    return;
  }
  const double top = 1.0 / left.at(*x);
  if (!(top > 0.0)) return;
  gap.error = safety * std::abs(1.0 - (depth(*at.left) + slope(*at.left, *at.right) * *x) / top);
  if (unseen * rise > gap.error) gap.error = unseen * rise;
  else gap.corner_rpm = at.left->spindle_speed_rpm + std::clamp(*x / h, 0.1, 0.9) * h;
}

}  // namespace

std::vector<LineGap> line_gaps(const std::vector<LobeRow>& rows, const MillingProcess& process, double narrow) {
  const double periods = process.cutter.pitches_rad.empty() ? process.cutter.teeth : 1.0;
  if (rows.empty()) return {};
  std::vector<LineGap> gaps(rows.size() - 1);
  const std::vector<bool> joined = joined_rows(rows, periods);
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    LineGap& gap = gaps[i];
    const LobeRow &left = rows[i], &right = rows[i + 1];
    gap.row_error = std::max(left.error_estimate, right.error_estimate);
    gap.corner_rpm = 0.5 * (left.spindle_speed_rpm + right.spindle_speed_rpm);
    gap.corner = !joined[i];
    if (right.spindle_speed_rpm <= left.spindle_speed_rpm * (1.0 + narrow)) continue;
    const Around at = around(rows, joined, i);
    if (const std::optional<double> passage = passage_of_real_axis(left, right, periods)) {
      gap.error = unknown;
      gap.corner_rpm = left.spindle_speed_rpm + *passage * width(at);
    } else if (left.at_limit && right.at_limit) gap.error = may_hide_lobe(at, joined[i]) ? unknown : 0.0;
    else if (gap.corner) add_corner(at, gap);
    else gap.error = smooth_error(at);
  }
  return gaps;
}

}  // namespace thinwall::milling
