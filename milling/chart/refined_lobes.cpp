#include "milling/chart/refined_lobes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "milling/chart/line_error.hpp"

namespace thinwall::milling {

namespace {

/// Crossings of added speeds are followed up to this many times the first one, as deep as the lobes of one side of a
/// gap go on at the other while they matter there: the deeper ones are drawn at the even speeds, and most of a row's
/// time goes to them.
constexpr double follow_between = 3.0;

/// A speed to add, and what the line has there.
struct Added {
  double rpm = 0.0;
  double expected_m = 0.0;
  double weight = 0.0;  ///< of the gap: error, at most 1, times width
};

double between(const LobeRow& a, const LobeRow& b, double rpm) {
  const double share = (rpm - a.spindle_speed_rpm) / (b.spindle_speed_rpm - a.spindle_speed_rpm);
  return a.limiting_depth_m + share * (b.limiting_depth_m - a.limiting_depth_m);
}

double widest_gap_rpm(const std::vector<LobeRow>& rows) {
  double widest = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i)
    widest = std::max(widest, rows[i].spindle_speed_rpm - rows[i - 1].spindle_speed_rpm);
  return widest;
}

/// Less than this cannot be gained: a line through rows with errors of their own.
double wanted_error(const LineGap& gap, double tolerance) {
  return std::max(tolerance, 2.0 * gap.row_error);
}

/// The speeds that a gap needs, as far as its rows tell.
void add_speeds(const LineGap& gap, const LobeRow& left, const LobeRow& right, double wanted,
                std::vector<Added>& speeds) {
  const double weight = std::min(1.0, gap.error) * (right.spindle_speed_rpm - left.spindle_speed_rpm);
  const auto add = [&](double rpm) { speeds.push_back({rpm, between(left, right, rpm), weight}); };
  if (gap.corner || std::isinf(gap.error)) return add(gap.corner_rpm);
  // The error of a smooth line falls with the square of its gaps.
  const double parts = std::clamp(std::ceil(std::sqrt(gap.error / wanted)), 2.0, 4.0);
  for (double i = 1.0; i < parts; i += 1.0)
    add(left.spindle_speed_rpm + i / parts * (right.spindle_speed_rpm - left.spindle_speed_rpm));
}

/// True if a gap needs no speed: its line is near enough to the boundary, and no rows of one side alone, which know of
/// no step on the other, tell so of a gap as wide as those of the even speeds.
bool suffices(const LineGap& gap, double width_rpm, double even_rpm, double wanted) {
  constexpr double not_yet_halved = 0.75;  // of an even gap: between a whole and half of one
  return gap.error <= wanted && !(gap.one_sided && width_rpm > not_yet_halved * even_rpm);
}

/// The speeds of the next generation, at most so many; `even_rpm` is the width of the widest gap before the first.
std::vector<Added> next_speeds(const std::vector<LobeRow>& rows, const std::vector<LineGap>& gaps, double tolerance,
                               double even_rpm, std::size_t most) {
  std::vector<Added> speeds;
  for (std::size_t i = 0; i < gaps.size(); ++i) {
    const double wanted = wanted_error(gaps[i], tolerance);
    const double width_rpm = rows[i + 1].spindle_speed_rpm - rows[i].spindle_speed_rpm;
    if (!suffices(gaps[i], width_rpm, even_rpm, wanted)) add_speeds(gaps[i], rows[i], rows[i + 1], wanted, speeds);
  }
  if (speeds.size() <= most) return speeds;
  std::ranges::stable_sort(speeds, std::greater<>{}, &Added::weight);
  speeds.resize(most);
  std::ranges::sort(speeds, {}, &Added::rpm);
  return speeds;
}

/// The rows with those of further speeds among them.
void insert_rows(std::vector<LobeRow>& rows, const std::vector<Added>& speeds, const RowAt& row_at,
                 const StabilityOptions& options, const KeptRows& kept) {
  std::vector<double> rpm(speeds.size());
  std::ranges::transform(speeds, rpm.begin(), &Added::rpm);
  const auto at = [&](std::size_t i) {
    StabilityOptions with = options;
    with.expected_depth_m = speeds[i].expected_m;
    return row_at(speeds[i].rpm, with);
  };
  std::vector<LobeRow> more = separate_rows(rpm, at, rows.size(), kept);
  const auto before = static_cast<std::ptrdiff_t>(rows.size());
  std::ranges::move(more, std::back_inserter(rows));
  std::ranges::inplace_merge(rows, rows.begin() + before, {}, &LobeRow::spindle_speed_rpm);
}

/// The asked speeds that lie within the rows' and are none of them.
std::vector<Added> missing(const std::vector<LobeRow>& rows, std::vector<double> asked) {
  std::ranges::sort(asked);
  asked.erase(std::unique(asked.begin(), asked.end()), asked.end());
  std::vector<Added> speeds;
  for (const double rpm : asked) {
    const auto right = std::ranges::lower_bound(rows, rpm, {}, &LobeRow::spindle_speed_rpm);
    if (right == rows.begin() || right == rows.end() || right->spindle_speed_rpm == rpm) continue;
    speeds.push_back({rpm, between(*std::prev(right), *right, rpm), 0.0});
  }
  return speeds;
}

DrawnLine drawn_line(const std::vector<LobeRow>& rows, const std::vector<LineGap>& gaps, double tolerance, int added) {
  const auto worst = std::ranges::max_element(gaps, {}, &LineGap::error);
  const auto at = static_cast<std::size_t>(worst - gaps.begin());
  const bool met =
      std::ranges::all_of(gaps, [&](const LineGap& gap) { return gap.error <= wanted_error(gap, tolerance); });
  return {tolerance, worst->error, 0.5 * (rows[at].spindle_speed_rpm + rows[at + 1].spindle_speed_rpm), added, met};
}

}  // namespace

std::vector<std::string> validate(const LineOptions& options) {
  std::vector<std::string> found;
  if (!(options.tolerance > 0.0 && options.tolerance < 1.0))
    found.push_back("line tolerance " + std::to_string(options.tolerance) + ", must lie in (0, 1); 0.02 is usual");
  if (!(options.narrow > 0.0 && options.narrow < 1.0))
    found.push_back("narrow gap " + std::to_string(options.narrow) + ", must lie in (0, 1); 1e-5 is usual");
  if (options.most_added < 0)
    found.push_back(std::to_string(options.most_added) + " added speeds at most, must be 0 or more");
  return found;
}

Lobes refined(Lobes chart, const RowAt& row_at, const MillingProcess& process, const StabilityOptions& options,
              const LineOptions& line, const std::vector<double>& asked, const KeptRows& kept) {
  require_valid(validate(line));
  if (chart.rows.size() < 2)
    throw core::InputError("refined chart: " + std::to_string(chart.rows.size()) +
                           " speeds, at least 2 are needed; give the ends of the range");
  std::vector<LobeRow>& rows = chart.rows;
  int added = 0;
  std::vector<LineGap> gaps;
  StabilityOptions between_even = options;
  between_even.follow = std::min(options.follow, follow_between);
  const double even_rpm = widest_gap_rpm(rows);
  const auto refine = [&] {
    while (true) {
      gaps = line_gaps(rows, process, line.narrow);
      const auto most = static_cast<std::size_t>(line.most_added - added);
      const auto speeds = next_speeds(rows, gaps, line.tolerance, even_rpm, most);
      if (speeds.empty()) return;
      insert_rows(rows, speeds, row_at, between_even, kept);
      added += static_cast<int>(speeds.size());
    }
  };
  refine();
  if (const auto speeds = missing(rows, asked); !speeds.empty()) {
    insert_rows(rows, speeds, row_at, options, kept);
    refine();
  }
  const DrawnLine drawn = drawn_line(rows, gaps, line.tolerance, added);
  const double residual_share = chart.residual_share;
  chart = lobes_of(std::move(rows), chart.method);
  chart.residual_share = residual_share;
  chart.line = drawn;
  return chart;
}

}  // namespace thinwall::milling
