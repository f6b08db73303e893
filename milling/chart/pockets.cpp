#include "milling/chart/pockets.hpp"

#include <algorithm>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

namespace {

/// Rates that differ by less are one: along a bound of power the rate is constant but for round-off.
constexpr double same = 1.0 + 1e-9;

/// The share of a pocket's depth that must be left within its width.
constexpr double share_of_depth = 0.9;

double rate(const Pocket& cut) {
  return cut.spindle_speed_rpm * cut.depth_m;
}

/// The deepest cut of a row's speed, and what keeps it from being deeper.
Pocket deepest_cut(const LobeRow& row, const MachineLimits& machine, const std::optional<CutLoad>& load) {
  Pocket cut{row.spindle_speed_rpm, row.limiting_depth_m, row.at_limit,
             row.at_limit ? PocketLimit::depth_limit : PocketLimit::stability};
  if (!load) return cut;
  const auto bound = [&](double depth_m, PocketLimit limit) {
    if (depth_m >= cut.depth_m) return;
    cut = {cut.spindle_speed_rpm, depth_m, false, limit};
  };
  bound(depth_for_torque(*load, machine), PocketLimit::torque);
  bound(depth_for_power(*load, machine, cut.spindle_speed_rpm), PocketLimit::power);
  cut.removal_rate_m3_s = rate(cut) * load->removal_per_depth_turn_m2 / 60.0;
  return cut;
}

/// True if the row's depth is known to a tenth or better: it is an answer, or its estimate at the largest number of
/// nodes says so.
bool is_known(const LobeRow& row) {
  constexpr double known_to = 0.1;
  return answers(row.status) || (row.status == StabilityStatus::node_limit_reached && row.error_estimate <= known_to);
}

/// The nearest row to row i towards `step` that is known; the number of rows where there is none.
std::size_t neighbour(const std::vector<LobeRow>& rows, std::size_t i, int step) {
  auto j = static_cast<std::ptrdiff_t>(i) + step;
  while (j >= 0 && j < std::ssize(rows) && !is_known(rows[static_cast<std::size_t>(j)])) j += step;
  return j < 0 ? rows.size() : static_cast<std::size_t>(j);
}

/// The speed from cut i towards `step` up to which `least_m` of depth can be cut; not beyond a row that is not known.
double end_of_depth(const std::vector<LobeRow>& rows, const std::vector<Pocket>& cuts, std::size_t i, int step,
                    double least_m) {
  double end = cuts[i].spindle_speed_rpm;
  for (auto j = static_cast<std::ptrdiff_t>(i) + step; j >= 0 && j < std::ssize(cuts); j += step) {
    const Pocket& next = cuts[static_cast<std::size_t>(j)];
    const Pocket& before = cuts[static_cast<std::size_t>(j - step)];
    if (!is_known(rows[static_cast<std::size_t>(j)])) break;
    if (next.depth_m < least_m) {
      const double share = (before.depth_m - least_m) / (before.depth_m - next.depth_m);
      return before.spindle_speed_rpm + share * (next.spindle_speed_rpm - before.spindle_speed_rpm);
    }
    end = next.spindle_speed_rpm;
  }
  return end;
}

bool is_better(const Pocket& a, const Pocket& b) {
  if (a.at_chart_edge != b.at_chart_edge) return b.at_chart_edge;
  return a.depth_m != b.depth_m ? a.depth_m > b.depth_m : a.spindle_speed_rpm > b.spindle_speed_rpm;
}

}  // namespace

std::string name(PocketLimit limit) {
  switch (limit) {
    case PocketLimit::stability:
      return "stability";
    case PocketLimit::depth_limit:
      return "depth_limit";
    case PocketLimit::power:
      return "power";
    case PocketLimit::torque:
      return "torque";
    case PocketLimit::spindle_speed:
      return "spindle_speed";
    case PocketLimit::feed_rate:
      break;
  }
  return "feed_rate";
}

std::vector<Pocket> best_pockets(const std::vector<LobeRow>& rows, std::size_t most) {
  return best_pockets(rows, {}, {}, most);
}

std::vector<Pocket> best_pockets(const std::vector<LobeRow>& rows, const MachineLimits& machine,
                                 const std::optional<CutLoad>& load, std::size_t most) {
  require_valid(validate(machine));
  std::vector<Pocket> cuts;
  cuts.reserve(rows.size());
  for (const LobeRow& row : rows) cuts.push_back(deepest_cut(row, machine, load));
  const double fastest = load ? speed_for_feed_rate(*load, machine) : MachineLimits::none;
  const auto reached = [&](const Pocket& cut) {
    return cut.spindle_speed_rpm >= machine.min_spindle_speed_rpm &&
           cut.spindle_speed_rpm <= std::min(fastest, machine.max_spindle_speed_rpm);
  };
  std::vector<Pocket> tops;
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    if (!is_known(rows[i]) || !reached(cuts[i])) continue;
    // Neighbours beyond the machine's speeds do not compete, but tell that speed is what bounds this one.
    const auto beaten_by = [&](std::size_t j, double by) {
      return j < cuts.size() && rate(cuts[j]) > rate(cuts[i]) * by;
    };
    const std::size_t before = neighbour(rows, i, -1), after = neighbour(rows, i, 1);
    const bool within_before = before < cuts.size() && reached(cuts[before]);
    const bool within_after = after < cuts.size() && reached(cuts[after]);
    if (within_before && !(rate(cuts[i]) > rate(cuts[before]) * same)) continue;
    if (within_after && beaten_by(after, same)) continue;
    Pocket top = cuts[i];
    if (!within_after && beaten_by(after, same))
      top.limited_by = fastest < machine.max_spindle_speed_rpm ? PocketLimit::feed_rate : PocketLimit::spindle_speed;
    if (!within_before && beaten_by(before, same)) top.limited_by = PocketLimit::spindle_speed;
    top.from_rpm =
        std::max(machine.min_spindle_speed_rpm, end_of_depth(rows, cuts, i, -1, share_of_depth * top.depth_m));
    top.to_rpm = std::min(
        {fastest, machine.max_spindle_speed_rpm, end_of_depth(rows, cuts, i, 1, share_of_depth * top.depth_m)});
    top.at_chart_edge = before == cuts.size() || after == cuts.size();
    tops.push_back(top);
  }
  std::stable_sort(tops.begin(), tops.end(), is_better);
  tops.resize(std::min(tops.size(), most));
  return tops;
}

}  // namespace thinwall::milling
