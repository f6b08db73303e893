#include "study/lobes/lobes_forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <iterator>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/time_limit.hpp"
#include "milling/chart/robust_lobes.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "setup/identified/identify.hpp"
#include "setup/milling_process.hpp"
#include "setup/path.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

/// A structure that stands in for that of a chart, and how many times as long as it the true one takes to be made.
struct StandIn {
  CutStructure structure;
  double longer = 1.0;
};

/// The structure with a part of these modes, or of modes_like().
StandIn structure_like(const setup::Setup& source, const std::optional<milling::RelativeStructure>& of_part) {
  return {
      cut_structure(before_identification(source), setup::milling_process(source).frame, poles_like(source, of_part))};
}

/// The supported part as it is known by its lines: some of them, for a fit takes as long as there are lines.
StandIn lines_like(const setup::Setup& source, const std::optional<milling::RelativeStructure>& of_part) {
  constexpr Eigen::Index enough = 1000;
  const dynamics::FrequencyAxis axis = frequency_axis(source.response, source, source);
  const Eigen::Index lines = std::min(enough, axis.size());
  milling::SampledStructure felt{{Eigen::VectorXd::LinSpaced(lines, axis.hz(0), axis.hz(axis.size() - 1)), {}},
                                 cut_poles(before_identification(source), nullptr)};
  const milling::ToolFrame frame = setup::milling_process(source).frame;
  const milling::RelativeStructure part = milling::in_tool_axes(of_part ? *of_part : modes_like(source), frame);
  for (const double hz : felt.samples.frequency_hz)
    felt.samples.H.push_back(milling::receptance(part, 2.0 * std::numbers::pi * hz));
  return {milling::fitted_structure(felt, frame), static_cast<double>(axis.size()) / static_cast<double>(lines)};
}

/// Seconds that `work` takes; at least so many where the limit of the thread ended it.
struct Took {
  double seconds = 0.0;
  bool over = false;
};

Took time_of(const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Took took;
  try {
    work();
  } catch (const core::TimeIsOver&) {
    took.over = true;
  }
  took.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return took;
}

/// The mean of what a row takes at speeds that are spread evenly over ln n: even speeds are denser in it at the top,
/// those that a line adds at the bottom. Rows of one chart differ a hundredfold, for a deep limit needs a fine grid.
/// The last speed, which is the cheapest as a rule, comes first. A row is begun while fewer than three are timed or
/// `enough_s` are not over.
Took mean_row(const std::function<void(double rpm)>& row, double from_rpm, double to_rpm, double enough_s) {
  constexpr double golden = std::numbers::phi - 1.0;  // its multiples, less whole ones, spread evenly
  constexpr int least = 3, most = 20;
  Took all;
  int rows = 0;
  while (rows < most && !all.over && (rows < least || all.seconds < enough_s)) {
    const double share = std::fmod(rows++ * golden, 1.0);
    const Took took = time_of([&] { row(to_rpm * std::pow(from_rpm / to_rpm, share)); });
    all.seconds += took.seconds;
    all.over = took.over;
  }
  return {all.seconds / rows, all.over};
}

/// The objection of milling::require_range() against the tool's lines at the speeds that the chart certainly has, the
/// highest first, for it needs the widest range; empty if nothing, or if the lines follow from modes that are not
/// learned yet.
std::string refusal_of_lines(const setup::Setup& source, const std::vector<milling::OperatingPoint>& points) {
  if (!setup::known_by_lines(*source.tool) || setup::awaits_learning(source)) return "";
  const milling::MillingProcess process = setup::milling_process(source);
  const milling::SampledReceptance lines = tip_lines(before_identification(source), process.frame);
  std::vector<double> speeds = even_speeds(*source.lobes);
  std::ranges::copy(asked_speeds(source, points), std::back_inserter(speeds));
  std::ranges::sort(speeds, std::greater());
  try {
    milling::require_range(lines, process, speeds);
  } catch (const core::InputError& error) {
    return (source.tool->swap ? "tool.swap: " : "tool.measured: ") + std::string(error.what());
  }
  return "";
}

/// The time of so many rows of a structure, on all threads, and of making it; over: at least so much.
Took time_of_charts(const setup::Setup& source, const std::function<StandIn()>& like, double rows, double limit_s) {
  constexpr double share_of_limit = 0.2;  // after which no further row is begun
  if (rows == 0.0) return {};
  const setup::LobesOptions& lobes = *source.lobes;
  const milling::MillingProcess process = setup::milling_process(source);
  const milling::MethodOptions options = method_options(lobes);
  const core::TimeLimit limit(limit_s);
  std::optional<StandIn> made;
  const Took making = time_of([&] { made = like(); });
  if (making.over) return making;
  const auto row = [&](double rpm) {
    if (const auto* sampled = std::get_if<milling::FittedStructure>(&made->structure)) {
      (void)milling::limiting_depth(*sampled, process, rpm, options.stability);
    } else {
      (void)milling::lobe_method(lobes.method, std::get<milling::RelativeStructure>(made->structure), process, options)
          ->limiting_depth(rpm, std::nullopt);
    }
  };
  const Took of_row = mean_row(row, lobes.from_rpm, lobes.to_rpm, share_of_limit * limit_s);
  return {made->longer * making.seconds + rows * of_row.seconds / core::thread_count(), of_row.over};
}

/// The rows of a robust chart: those at the speeds and at their neighbours, and what is changed at each of them.
double robust_rows(const setup::LobesOptions& lobes, double speeds) {
  constexpr double rows_of_each = 2.5, neighbours_of_reach = 4.0;
  const double reach = milling::two_sided_coverage(lobes.robust->confidence) * lobes.robust->uncertainty.frequency;
  const double range = std::log(lobes.to_rpm / lobes.from_rpm) + 2.0 * std::log1p(reach);
  const double neighbours = reach > 0.0 ? neighbours_of_reach * range / std::log1p(reach) : 0.0;
  return rows_of_each * (speeds + neighbours);
}

}  // namespace

ExpectedRows expected_rows(const setup::Setup& source) {
  constexpr double usual = 500.0, least_share = 1.25;  // of the even speeds
  const setup::LobesOptions& lobes = *source.lobes;
  const double speeds =
      std::min(std::max(usual, least_share * lobes.count), 1.0 * lobes.count + setup::most_added(lobes));
  double chart = speeds * (1.0 + static_cast<double>(lobes.compare.size()));
  if (lobes.robust) chart += robust_rows(lobes, speeds);
  if (lobes.map_depths) chart += 0.02 * lobes.count * *lobes.map_depths;
  const double stations = source.path ? static_cast<double>(source.path->positions.size()) : 0.0;
  chart += stations * lobes.count;
  const bool with_robot = setup::robot_beside_tool(source, source) || (source.robot && !source.contacts.empty());
  if (!source.part || !with_robot) return {chart, 0.0};
  return setup::is_measured(*source.robot) ? ExpectedRows{chart, speeds} : ExpectedRows{2.0 * chart, 0.0};
}

std::optional<LobesForecast> forecast_lobes(const setup::Setup& source, double limit_s,
                                            const std::vector<milling::OperatingPoint>& points,
                                            const StandInModesOf& modes_of) {
  if (!source.lobes || !source.cutting || !source.tool) return std::nullopt;
  const core::Silence forecast_only;
  try {
    LobesForecast result{expected_rows(source), 0.0, false, refusal_of_lines(source, points)};
    if (!result.refusal.empty()) return result;
    const std::optional<StandInModes> modes = modes_of ? modes_of() : std::nullopt;
    const auto add = [&](auto like, const std::optional<milling::RelativeStructure>& of_part, double rows) {
      const Took took = time_of_charts(
          source, [&] { return like(source, of_part); }, rows, limit_s);
      result.seconds += took.seconds;
      result.at_least |= took.over;
    };
    const std::optional<milling::RelativeStructure> part = modes ? std::optional(modes->part) : std::nullopt;
    // The supported part, which is stable up to other depths, has half of the rows if its modes are known.
    const double supported = modes && modes->supported ? 0.5 * result.rows.of_structure : 0.0;
    add(structure_like, part, result.rows.of_structure - supported);
    if (supported > 0.0) add(structure_like, modes->supported, supported);
    add(lines_like, part, result.rows.of_lines);
    return result;
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error&) {
    return std::nullopt;
  }
}

}  // namespace thinwall::study
