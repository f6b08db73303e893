#include "milling/chart/line_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace thinwall::milling {

namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();
constexpr double safety = 2.0;
constexpr double unresolved = 2.0;  // further safety where the rows beside a gap bend the boundary to both sides
constexpr double unseen = 0.5;      // of the rise over a corner's gap: lobes may end there otherwise than they seem to

/// The chatter frequency in cuts of the period T: f_c T, by which a motion's multiplier is turned each period.
double periods_of(const LobeRow& row, double periods_per_turn) {
  return 60.0 * row.chatter_frequency_hz / (periods_per_turn * row.spindle_speed_rpm);
}

bool nearly_one_frequency(const LobeRow& a, const LobeRow& b) {
  constexpr double step = 0.05;
  const double f = a.chatter_frequency_hz, g = b.chatter_frequency_hz;
  return std::abs(f - g) <= step * std::max(f, g);
}

/// True if two rows may show one motion: both at the depth limit or neither, with one kind and nearly one frequency.
bool alike(const LobeRow& a, const LobeRow& b) {
  return a.at_limit == b.at_limit && a.kind == b.kind && nearly_one_frequency(a, b);
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

/// The chatter frequency that the motion of a row has at the speed of `next`, as the row before tells.
double expected_frequency(const LobeRow& before, const LobeRow& row, const LobeRow& next) {
  const double share =
      (next.spindle_speed_rpm - row.spindle_speed_rpm) / (row.spindle_speed_rpm - before.spindle_speed_rpm);
  return row.chatter_frequency_hz + share * (row.chatter_frequency_hz - before.chatter_frequency_hz);
}

/// True if another lobe takes over between a row and the next: the lobe of two rows goes on as a deeper crossing of the
/// next, or a deeper one of theirs becomes its first, by frequencies that are nearer by half to where the two point.
/// Modes beside each other have lobes of one ⌊f_c T⌋ whose frequencies differ by less than those of neighbouring
/// speeds.
bool another_takes_over(const LobeRow& before, const LobeRow& row, const LobeRow& next) {
  if (row.kind != Bifurcation::hopf || next.at_limit) return false;
  const double expected = expected_frequency(before, row, next), change = expected - row.chatter_frequency_hz;
  const double first = std::abs(next.chatter_frequency_hz - expected);
  const auto is_nearer = [first](const LobeRow& from, double moved_hz, double to_hz) {
    return std::ranges::any_of(from.crossings, [&](const LobePoint& other) {
      return other.kind == Bifurcation::hopf && other.depth_m > from.limiting_depth_m &&
             std::abs(other.chatter_frequency_hz + moved_hz - to_hz) < 0.5 * first;
    });
  };
  return is_nearer(next, 0.0, expected) || is_nearer(row, change, next.chatter_frequency_hz);
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
                       (!left_tells || another_takes_over(rows[i - 1], rows[i], rows[i + 1])) &&
                       (!right_tells || another_takes_over(rows[i + 2], rows[i + 1], rows[i]));
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

/// The largest distance of a smooth curve from its chord over the gap, by the rows beside it. Where the curve bends to
/// one side before the gap and to the other after it, or only one of the two is known, the bend within may be larger
/// than either.
double distance_from_chord(const Around& at, Value value) {
  if (at.before == nullptr && at.after == nullptr) return unknown;
  const double before = at.before != nullptr ? curvature(*at.before, *at.left, *at.right, value) : 0.0;
  const double after = at.after != nullptr ? curvature(*at.left, *at.right, *at.after, value) : 0.0;
  const double factor = before * after > 0.0 ? safety : unresolved * safety;
  return factor * std::max(std::abs(before), std::abs(after)) * width(at) * width(at) / 4.0;
}

double smooth_error(const Around& at) {
  return distance_from_chord(at, depth) / std::sqrt(depth(*at.left) * depth(*at.right));
}

bool is_wide_for_real_lobe(const LobeRow& left, const LobeRow& right) {
  return right.spindle_speed_rpm > left.spindle_speed_rpm * (1.0 + narrow_real_lobe);
}

/// The share of the way from a to b periods at which twice as many are a whole number, if they are.
std::optional<double> share_at_half_period(double a, double b) {
  constexpr double round_off = 1e-9;  // of a flip or fold twice the periods are a whole number but for this
  const double half = 0.5 * std::ceil(2.0 * std::min(a, b) - round_off);
  if (!(half <= std::max(a, b)) || a == b) return std::nullopt;
  return std::clamp((half - a) / (b - a), 0.05, 0.95);
}

/// The share of the gap between two rows of one motion, at its crossing or at the depth limit, at which its pair of
/// multipliers passes −1 or +1 (at the limit: the real axis): where 2 f_c T is a whole number; none if it does not.
/// There the two are equal and real, so that beside this speed one of them alone may leave the unit circle sooner: a
/// flip or fold lobe begins and ends within the gap although both rows show the same motion.
std::optional<double> passage_of_real_axis(const LobeRow& left, const LobeRow& right, double periods_per_turn) {
  constexpr double one_motion = 0.5;  // periods: lobes of two motions differ by more as a rule
  if (left.kind != Bifurcation::hopf || !alike(left, right) || !is_wide_for_real_lobe(left, right)) return std::nullopt;
  const double a = periods_of(left, periods_per_turn), b = periods_of(right, periods_per_turn);
  if (!on_one_lobe(left, right, periods_per_turn) && std::abs(a - b) >= one_motion) return std::nullopt;
  return share_at_half_period(a, b);
}

/// That share where the lobe of one side rises to the depth limit within the gap, by its last two rows, or by the
/// motion that is least stable at the limit on the other side.
std::optional<double> passage_below_limit(const Around& at, double periods_per_turn) {
  if (at.left->at_limit == at.right->at_limit || !is_wide_for_real_lobe(*at.left, *at.right)) return std::nullopt;
  const bool from_left = at.right->at_limit;
  const LobeRow& row = from_left ? *at.left : *at.right;
  const LobeRow* behind = from_left ? at.before : at.after;
  if (behind == nullptr || row.kind != Bifurcation::hopf) return std::nullopt;
  const double a = periods_of(row, periods_per_turn), away_rpm = row.spindle_speed_rpm - behind->spindle_speed_rpm;
  const double change = (a - periods_of(*behind, periods_per_turn)) * width(at) / std::abs(away_rpm);
  std::optional<double> share = share_at_half_period(a, a + change);
  const LobeRow& limit = from_left ? *at.right : *at.left;
  if (!share && nearly_one_frequency(row, limit)) {
    share = share_at_half_period(a, periods_of(limit, periods_per_turn));
    if (share && limit.kind != Bifurcation::hopf) share = 0.5;  // it has been passed somewhere within
  }
  return share && !from_left ? 1.0 - *share : share;
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
  double before_rpm = 0.0;  ///< from the row back to the other point of the slope; < 0: that lies in the gap

  /// At a distance from the row into the gap, rpm.
  [[nodiscard]] double at(double into_rpm) const {
    return value + slope * into_rpm + bend * into_rpm * (into_rpm + before_rpm);
  }
};

/// The depth of the deeper crossing as which the lobe of a row goes on at the other row of the gap, m; none if it is
/// not told from others by its frequency.
std::optional<double> known_beyond(const LobeRow& row, const LobeRow& behind, const LobeRow& other) {
  const double expected = expected_frequency(behind, row, other);
  const double as_far_as_hz = 0.25 * std::abs(other.chatter_frequency_hz - expected);
  std::optional<double> depth_m;
  for (const LobePoint& point : other.crossings) {
    if (point.kind != row.kind || !(point.depth_m > other.limiting_depth_m)) continue;
    if (std::abs(point.chatter_frequency_hz - expected) > as_far_as_hz) continue;
    if (depth_m) return std::nullopt;
    depth_m = point.depth_m;
  }
  return depth_m;
}

/// `row` is beside the gap, `behind` and `farther` follow away from it, null where the lobe has none, and `other` is
/// the row on the other side. Where that knows the lobe, too, the parabola goes through its crossing there.
Continued continued(const LobeRow& row, const LobeRow* behind, const LobeRow* farther, const LobeRow& other) {
  Continued lobe{inverse_depth(row)};
  if (row.at_limit || behind == nullptr) return lobe;
  const double away = behind->spindle_speed_rpm < row.spindle_speed_rpm ? 1.0 : -1.0;
  lobe.slope = away * slope(*behind, row, inverse_depth);
  lobe.before_rpm = std::abs(row.spindle_speed_rpm - behind->spindle_speed_rpm);
  if (farther != nullptr) lobe.bend = curvature(*farther, *behind, row, inverse_depth);
  if (const std::optional<double> beyond_m = known_beyond(row, *behind, other)) {
    const double h = std::abs(other.spindle_speed_rpm - row.spindle_speed_rpm);
    const double to_other = (1.0 / *beyond_m - lobe.value) / h;
    lobe.bend = (to_other - lobe.slope) / (h + lobe.before_rpm);
    lobe.slope = to_other;
    lobe.before_rpm = -h;
  }
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

/// By how much the chord of the gap is off the boundary that the lower of both continuations is, relative.
double off_chord(const Around& at, const Continued& left, const Continued& right) {
  constexpr int looks = 16;
  const double h = width(at), chord = slope(*at.left, *at.right);
  double off = 0.0;
  for (int k = 1; k < looks; ++k) {
    const double x = h * k / looks;
    off = std::max(off, std::abs(1.0 - (depth(*at.left) + chord * x) * std::max(left.at(x), right.at(h - x))));
  }
  return off;
}

/// By how much the continuations are off each other's row, relative: lobes that run nearly side by side do not meet as
/// far as their rows tell, but where each goes on close to the other's row, so does the boundary.
double off_rows(const Around& at, const Continued& left, const Continued& right) {
  const double h = width(at);
  return std::max(std::abs(1.0 - left.at(h) * depth(*at.right)), std::abs(1.0 - right.at(h) * depth(*at.left)));
}

/// True if a row knows its lobe's other end over it: of a flip or fold lobe, a second crossing of its kind at its
/// frequency.
bool ends_above(const LobeRow& row) {
  return row.kind != Bifurcation::hopf && std::ranges::any_of(row.crossings, [&](const LobePoint& point) {
           return point.kind == row.kind && point.depth_m > row.limiting_depth_m &&
                  std::abs(point.chatter_frequency_hz - row.chatter_frequency_hz) < 1e-6 * row.chatter_frequency_hz;
         });
}

/// By how much the boundary steps down at most, relative, where the lobe of `row` ends within the gap: both edges of a
/// flip or fold lobe meet upright at its end, so that the other lobe is the boundary up to there, wherever that is.
double step_of_end(const Continued& other, double h, const LobeRow& row) {
  return ends_above(row) ? std::max(0.0, 1.0 - row.limiting_depth_m * std::max(0.0, other.at(h))) : 0.0;
}

/// The corner where the continuations of both lobes meet, and what the line is off in the gap.
void add_corner(const Around& at, LineGap& gap) {
  gap.error = unknown;
  if (!(depth(*at.left) > 0.0 && depth(*at.right) > 0.0)) return;
  const bool known = (at.before != nullptr || at.left->at_limit) && (at.after != nullptr || at.right->at_limit);
  if (!known) return;
  const double h = width(at);
  const Continued left = continued(*at.left, at.before, at.farther_before, *at.right);
  const Continued right = continued(*at.right, at.after, at.farther_after, *at.left);
  const double rise = std::abs(std::log(depth(*at.left) / depth(*at.right)));
  const std::optional<double> x = corner_of(left, right, h);
  if (!x) {
    if (!(left.at(h) > 0.0 && right.at(h) > 0.0)) return;
    gap.error = safety * std::max(off_chord(at, left, right), off_rows(at, left, right));
  } else {
    const double top = 1.0 / left.at(*x);
    if (!(top > 0.0)) return;
    const double at_top = std::abs(1.0 - (depth(*at.left) + slope(*at.left, *at.right) * *x) / top);
    gap.error = safety * std::max(at_top, off_chord(at, left, right));
  }
  const double least = std::max({unseen * rise, step_of_end(left, h, *at.right), step_of_end(right, h, *at.left)});
  if (least > gap.error) gap.error = least;
  else if (x) gap.corner_rpm = at.left->spindle_speed_rpm + std::clamp(*x / h, 0.1, 0.9) * h;
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
    std::optional<double> passage = passage_of_real_axis(left, right, periods);
    if (!passage) passage = passage_below_limit(at, periods);
    if (passage) {
      gap.error = unknown;
      gap.corner_rpm = left.spindle_speed_rpm + *passage * width(at);
    } else if (left.at_limit && right.at_limit) gap.error = may_hide_lobe(at, joined[i]) ? unknown : 0.0;
    else if (gap.corner) add_corner(at, gap);
    else {
      gap.error = smooth_error(at);
      gap.one_sided = at.before == nullptr || at.after == nullptr;
    }
  }
  return gaps;
}

}  // namespace thinwall::milling
