#include "milling/direct/helical_row.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "milling/direct/critical_depths.hpp"
#include "milling/direct/row_search.hpp"

namespace thinwall::milling {

namespace {

using std::complex;

Resolution finer_by(Resolution r, std::size_t levels) {
  for (std::size_t i = 0; i < levels; ++i) r = finer(r);
  return r;
}

/// ∂ν/∂w at a fixed angle as the depth shapes the cut, from a grid beside; `pair` is that of `gain`.
complex<double> change_with_depth(const CutAtSpeed& cut, Resolution resolution, double depth_m, double theta,
                                  const GainOnCircle& gain, const Eigenpair& pair) {
  complex<double> least = INFINITY;
  // The eigenvalue ν jumps by the error of the grid where a stretch of the cut appears with the depth, so the
  // difference is one-sided there.
  const double above = std::min(1e-6 * depth_m, cut.process.cutter.envelope.height_m - depth_m);
  for (const double step_m : {-1e-6 * depth_m, above}) {
    // ν ~ 1/w changes with the depth by about 1/w². A hundred times as much is a jump, and the other side is tried.
    if (step_m == 0.0 || std::abs(least) * depth_m * depth_m < 100.0) continue;
    const DiscreteCut beside = discrete(cut, resolution, depth_m + step_m);
    const GainOnCircle gain_beside = gain_of(beside);
    // With as many contacts the grid is the same but for the small step: another factorisation would tell no more.
    const complex<double> nu = gain_beside.size == gain.size ? rayleigh_quotient(pair, gain_beside.Z(theta))
                                                             : eigenpair_near(gain_beside, theta, pair.nu).nu;
    if (const complex<double> change = (nu - pair.nu) / step_m; std::abs(change) < std::abs(least)) least = change;
  }
  return least;
}

constexpr int most_steps = 12;  // of Newton's rule

/// Times the first crossing: one this near may turn out to be the first on a finer grid.
constexpr double clearly_beyond = 1.1;

/// A step of Newton's rule for angle and depth together, and what it started from.
struct NewtonStep {
  double depth_m = 0.0, theta_rad = 0.0;
  Eigenpair pair;            ///< near 1/depth on the grid of this depth
  complex<double> by_depth;  ///< ∂ν/∂w
  double miss = 0.0;         ///< |ν − 1/w| w; 0 of none
};

/// ∂ν/∂w by the secant from the step before: what the change of the angle does not explain. None if that step says too
/// little: it is too short for a difference, or did not bring ν nearer by half, as where the grid has changed.
std::optional<complex<double>> secant(const NewtonStep& before, const NewtonStep& now) {
  const double dw = now.depth_m - before.depth_m;
  if (now.miss > 0.5 * before.miss || std::abs(dw) < 1e-5 * now.depth_m) return std::nullopt;
  const complex<double> by_angle = 0.5 * (before.pair.slope + now.pair.slope) * (now.theta_rad - before.theta_rad);
  return (now.pair.nu - before.pair.nu - by_angle) / dw;
}

/// Brings a crossing to where ν(θ, w) = 1/w on grids of its own depth, by Newton's rule for angle and depth together.
/// A multiplier leaves the circle as the depth rises where
///
///     d ln|μ|/dw = −Re[i (∂ν/∂w + 1/w²) / (∂ν/∂θ)] > 0.
///
/// False if the depth does not settle to 1e-7 (relative) between two depths and among the edges, or if so many steps do
/// not bring ν nearer by half. Throws NumericalError if an eigenvalue is not found.
bool settled(const CutAtSpeed& cut, Resolution resolution, double from_m, double to_m, int patience,
             Crossing& crossing) {
  constexpr complex<double> i(0.0, 1.0);
  constexpr double tolerance = 1e-7;
  const double height = std::min(to_m, cut.process.cutter.envelope.height_m);
  const bool at_end = crossing.theta_rad == 0.0 || crossing.theta_rad == std::numbers::pi;
  double depth = std::min(crossing.depth_m, height);
  double theta = crossing.theta_rad;
  NewtonStep before;
  int not_nearer = 0;
  for (int step = 0; step < most_steps; ++step) {
    // ν(θ, w) − 1/w = 0 is one complex equation for two real unknowns, linearised in both.
    const DiscreteCut d = discrete(cut, resolution, depth);
    const GainOnCircle gain = gain_of(d);
    // The eigenvalue nearest to 1/w may be another one at each step, so that no vectors of the step before are a start.
    NewtonStep at{depth, theta, eigenpair_near(gain, theta, 1.0 / depth), {}, 0.0};
    const complex<double> miss = at.pair.nu - 1.0 / depth;
    at.miss = std::abs(miss) * depth;
    if (step > 0 && at.miss > 0.5 * before.miss && ++not_nearer == patience) return false;
    // A grid of another fineness changes the eigenvalue, but hardly how it changes with the depth.
    const std::optional<complex<double>> known = step == 0 ? crossing.by_depth : secant(before, at);
    at.by_depth = known ? *known : change_with_depth(cut, resolution, depth, theta, gain, at.pair);
    const complex<double> by_depth = at.by_depth + 1.0 / (depth * depth);
    Eigen::Matrix2d rows;
    rows << at.pair.slope.real(), by_depth.real(), at.pair.slope.imag(), by_depth.imag();
    // At θ = 0 and π ν is real and the angle stays: a fold or a flip, with the depth alone unknown.
    const Eigen::Vector2d change = at_end
                                       ? Eigen::Vector2d(0.0, -miss.real() / by_depth.real())
                                       : Eigen::Vector2d(-rows.inverse() * Eigen::Vector2d(miss.real(), miss.imag()));
    if (!change.allFinite()) return false;
    // Newton's rule and secants gain more from step to step, so that this step leaves less than its share of what the
    // one before left. A short step alone may come from a derivative over a jump of the grid: ν must be there, too, as
    // near as the step allows where it changes a hundred times as fast as 1/w.
    const double length = std::abs(change(1)) / depth;
    const double left = std::min(1.0, at.miss / before.miss) * std::max(length, at.miss);
    if ((length <= tolerance || left <= tolerance) && at.miss <= 100.0 * std::max(length, tolerance)) {
      const double leaves = -(i * by_depth / at.pair.slope).real();
      crossing = {depth + change(1), theta + change(0), (at_end ? 1 : 2) * (leaves > 0.0 ? 1 : -1), at.pair.right,
                  at.by_depth};
      return crossing.depth_m <= height;
    }
    // ν is known near here only: the depth moves by a tenth at most, the angle by half a radian.
    const double shorter = std::min({1.0, 0.1 * depth / std::abs(change(1)), 0.5 / std::abs(change(0))});
    depth = std::min(depth + shorter * change(1), height);
    theta += shorter * change(0);
    if (depth == at.depth_m || depth < from_m || theta < 0.0 || theta > std::numbers::pi) return false;
    before = std::move(at);
  }
  return false;
}

/// Settles a crossing as above; returns false where a guess leads to no eigenvalue.
bool settle(const CutAtSpeed& cut, Resolution resolution, double from_m, double to_m, int patience,
            Crossing& crossing) {
  try {
    return settled(cut, resolution, from_m, to_m, patience, crossing);
  } catch (const core::NumericalError&) {
    return false;
  }
}

/// Values that are known of the cut at one depth.
struct Probe {
  double depth_m = 0.0;
  int unstable = 0;               ///< multipliers outside of the unit circle
  std::vector<Crossing> guesses;  ///< where crossings of other depths may lie
};

/// True if a multiplier is that of a mode which the cut hardly moves, in a direction that the teeth do not feel: such a
/// mode decays slowly, near the circle, but leads to no crossing.
bool is_free(complex<double> mu, const Eigen::VectorXcd& flow) {
  constexpr double hardly = 0.01;  // of the way to the circle
  return std::ranges::any_of(flow, [&](complex<double> free) {
    const double distance = std::min(std::abs(mu - free), std::abs(mu - std::conj(free)));
    return distance <= hardly * (1.0 - std::abs(free));
  });
}

/// The search for the crossings of a speed on grids of one resolution, so many times finer than is needed.
class HelicalSearch {
 public:
  HelicalSearch(const CutAtSpeed& cut, std::size_t refinements, const StabilityOptions& options)
      : cut_(cut), refinements_(refinements), first_alone_(options.follow == 1.0) {}

  /// Each depth has a grid of its own, which need not serve depths of twenty times as much.
  [[nodiscard]] Resolution resolution(double depth_m) const {
    const double on_edge_m = std::min(depth_m, cut_.process.cutter.envelope.height_m);
    return finer_by(searching(cut_, on_edge_m), refinements_);
  }

  /// The cut keeps the shape of this depth while its force grows: what crosses the unit circle up to a sixth beyond.
  /// The crossings up to the depth itself say how many multipliers are outside there, for there the frozen cut is the
  /// true one; those near it are guesses of the true crossings. Pairs that leave the circle and return within a step,
  /// which no count shows, are among them. While the cut is stable such a search costs less than a count.
  [[nodiscard]] Probe frozen(double depth_m) const {
    constexpr double beyond = 7.0 / 6.0;
    const DiscreteCut d = discrete(cut_, resolution(beyond * depth_m), depth_m);
    Probe probe{depth_m, 0, CriticalDepths(gain_of(d)).up_to(beyond * depth_m)};
    for (const Crossing& c : probe.guesses) probe.unstable += c.depth_m <= depth_m ? c.unstable_change : 0;
    return probe;
  }

  /// The multipliers at this depth, those nearest to the circle among the ones that the cut moves for guesses:
  /// `unstable_change` is 1 for those outside, −1 for those within.
  [[nodiscard]] Probe counted(double depth_m) const {
    constexpr std::size_t most = 6;
    const DiscreteCut d = discrete(cut_, resolution(depth_m), depth_m);
    std::vector<complex<double>> near;
    Probe probe{depth_m, 0, {}};
    for (const complex<double> mu : multipliers(d, depth_m)) {
      probe.unstable += std::abs(mu) > 1.0 ? 1 : 0;
      // Of conjugate pairs one, and none that is near zero: the nodes' share of the past decays within a period.
      if (mu.imag() >= 0.0 && std::abs(mu) > 0.2 && !is_free(mu, d.loop.flow)) near.push_back(mu);
    }
    // ln|μ| is 0 on the circle and changes in proportion to a small change of the depth: the least are the nearest.
    std::ranges::sort(near, {}, [](complex<double> mu) { return std::abs(std::log(std::abs(mu))); });
    near.resize(std::min(near.size(), most));
    for (const complex<double> mu : near) {
      const double theta = mu.imag() > 0.0 ? std::arg(mu) : mu.real() > 0.0 ? 0.0 : std::numbers::pi;
      probe.guesses.push_back({depth_m, theta, std::abs(mu) > 1.0 ? 1 : -1, {}});
    }
    return probe;
  }

  /// Deep in an unstable range counts are cheaper, and crossings that cancel there do not matter. None where an
  /// eigen-solution fails.
  [[nodiscard]] std::optional<Probe> after(const Probe& low, double depth_m) const {
    try {
      return low.unstable > 0 ? counted(depth_m) : frozen(depth_m);
    } catch (const core::NumericalError&) {
      return std::nullopt;
    }
  }

  /// True if a multiplier is outside of the circle by more than the error of a grid. A grid of a quarter of the
  /// elements takes a thirtieth of the time and has the largest multiplier to a tenth as a rule, since modes that it
  /// does not resolve hardly move in chatter. Where it finds one that is far outside the full grid is not asked.
  [[nodiscard]] bool clearly_unstable(double depth_m) const {
    constexpr double far_outside = 1.25, clearly = 1.001;
    const Resolution full = resolution(depth_m), quarter{(full.elements + 3) / 4, full.nodes};
    if (coarser(quarter, full) && exceeds(discrete(cut_, quarter, depth_m), depth_m, far_outside)) return true;
    return exceeds(discrete(cut_, full, depth_m), depth_m, clearly);
  }

  /// The first crossing up to a depth, by the shape that the cut has at a depth where it is all but surely stable: a
  /// guess of where it is by its own shape. The depth itself where none is found.
  [[nodiscard]] double likely_first_m(double to_m) const {
    const double shape_m = std::min(8.0 * surely_stable_depth_m(cut_), to_m);
    try {
      const DiscreteCut d = discrete(cut_, resolution(shape_m), shape_m);
      return first_crossing(gain_of(d), {.depth_limit_m = to_m}).depth_m();
    } catch (const core::NumericalError&) {
      return to_m;
    }
  }

  /// Steps in which neither the stretch of a tooth in the cut grows by more than 12 % nor, with unequal helices, the
  /// delay by more than a radian of the fastest mode; on round ends the depth itself shapes the cut.
  [[nodiscard]] double next_depth(double depth_m) const {
    constexpr double growth = 0.12;
    const MillingProcess& process = cut_.process;
    if (!process.cutter.envelope.straight())
      return depth_m > 0.0 ? (1.0 + growth) * depth_m : surely_stable_depth_m(cut_);
    double steepest = 0.0;
    double least = INFINITY;
    for (int tooth = 0; tooth < process.cutter.teeth; ++tooth) {
      steepest = std::max(steepest, process.cutter.lag_rad_per_m(tooth));
      least = std::min(least, process.cutter.lag_rad_per_m(tooth));
    }
    double shortest = INFINITY;
    for (const Engagement& arc : arcs(process)) shortest = std::min(shortest, arc.arc_rad());
    // A tooth is in the cut over its arc and its lag from tip to top: that is what grows by the share.
    const double step_m = growth * (depth_m + shortest / steepest);
    if (steepest == least) return depth_m + step_m;
    const double spindle_rad_s = cut_.spindle_speed_rpm * std::numbers::pi / 30.0;
    // Unequal helices change the delay along the edge: in a radian of it the phase of regeneration turns too far for
    // the guesses of one depth to lead to the crossings of the next.
    const double phase_rad_per_m = (steepest - least) * fastest_that_matters(cut_, 0.0, depth_m) / spindle_rad_s;
    return depth_m + std::max(0.05 * depth_m, std::min(step_m, 1.0 / phase_rad_per_m));
  }

  /// Adds the crossings between two depths; false if from some depth on, searched_m then, what is found does not
  /// explain the counts, however often the step is halved.
  [[nodiscard]] bool between(const Probe& low, const Probe& high, int halvings, CoarseCrossings& scan) const {
    std::vector<Crossing> inside;
    int change = 0;
    // Guesses that lead nowhere come no nearer twice as a rule, of the others one in thirty. While the cut is stable
    // that one may be a crossing of which the frozen cut has no sign.
    const int patience = low.unstable > 0 ? 2 : most_steps;
    int change_of_guesses = 0;
    bool first_known = false;
    const auto explained = [&] { return first_known || change == high.unstable - low.unstable; };
    const auto add_from = [&](const std::vector<Crossing>& guesses) {
      for (const Crossing& guess : guesses) {
        // Where the first crossing alone is wanted, those clearly beyond it need not be found once all guesses up to
        // there are: the row is checked below it.
        first_known = first_alone_ && low.unstable == 0 && !inside.empty() && change == change_of_guesses &&
                      guess.depth_m > clearly_beyond * inside.front().depth_m;
        if (first_known || (low.unstable > 0 && explained())) return;
        change_of_guesses += guess.unstable_change;
        Crossing c = guess;
        if (!settle(cut_, resolution(high.depth_m), 0.9 * low.depth_m, 1.1 * high.depth_m, patience, c)) continue;
        if (c.depth_m <= low.depth_m || c.depth_m > high.depth_m || is_known(c, inside)) continue;
        change += c.unstable_change;
        inside.push_back(std::move(c));
      }
    };
    // Deep in an unstable range nothing is looked for once the count is explained: what cancels there changes no limit.
    // The guesses of the upper depth come first, since crossings lie below it, and of them those that are by then on
    // the side to which the count has changed; those of the lower depth only if they are needed.
    const int side = high.unstable > low.unstable ? 1 : -1;
    std::vector<Crossing> likeliest_first = high.guesses;
    std::stable_partition(likeliest_first.begin(), likeliest_first.end(),
                          [&](const Crossing& c) { return c.unstable_change * side > 0; });
    add_from(likeliest_first);
    if (!explained()) add_from(low.guesses);
    // The crossings between two depths are all if their changes add up to that of the count.
    if (explained()) {
      std::move(inside.begin(), inside.end(), std::back_inserter(scan.found));
      scan.searched_m = high.depth_m;
      return true;
    }
    if (halvings == 0) return false;
    const std::optional<Probe> middle = after(low, 0.5 * (low.depth_m + high.depth_m));
    return middle && between(low, *middle, halvings - 1, scan) && between(*middle, high, halvings - 1, scan);
  }

 private:
  /// Two guesses may settle to one crossing; two at one depth that change in opposite directions are two.
  [[nodiscard]] static bool is_known(const Crossing& c, const std::vector<Crossing>& all) {
    return std::any_of(all.begin(), all.end(), [&](const Crossing& other) {
      return std::abs(other.depth_m / c.depth_m - 1.0) < 1e-5 && other.unstable_change == c.unstable_change;
    });
  }

  const CutAtSpeed& cut_;
  std::size_t refinements_;
  bool first_alone_;
};

/// The depth to look at next. A search costs an eigenvalue problem at every stop that its depth can reach, so that the
/// first look goes a fifth beyond where the first crossing is likely if that is shallow beside the first step, and
/// further ones, while there is no crossing, to no more than so many times the depth.
double next_look(const HelicalSearch& search, double depth_m, bool crossed, const StabilityOptions& options) {
  constexpr double most_growth = 2.5;
  const double next = search.next_depth(depth_m);
  if (depth_m > 0.0) return crossed ? next : std::min(next, most_growth * depth_m);
  const double near = 1.2 * (options.expected_depth_m ? *options.expected_depth_m : search.likely_first_m(next));
  return near > 0.0 && near < 0.5 * next ? near : next;
}

/// The first depth above a given one, in the steps of the search up to `to_m`, at which the cut is not clearly
/// unstable, so that a stable range may lie there; none if it is unstable at all of them.
std::optional<double> stable_again_m(const HelicalSearch& search, double depth_m, double to_m) {
  while (depth_m < to_m) {
    depth_m = std::min(search.next_depth(depth_m), to_m);
    if (!search.clearly_unstable(depth_m)) return depth_m;
  }
  return std::nullopt;
}

/// The depths from 0 to where the crossings are wanted, to where what is found no longer explains the counts, or to
/// where an eigen-solution fails.
CoarseCrossings scan(const HelicalSearch& search, const StabilityOptions& options) {
  // Grids grow with the depth, and a crossing takes time with their third power. The line of a chart follows lobes from
  // row to row while they are no deeper than this; beyond it crossings matter where the cut is stable again only.
  constexpr double deep = 2.0;  // times the first crossing
  CoarseCrossings result;
  Probe low;
  double again_m = 0.0;  // where the cut is stable again
  while (low.depth_m < wanted_m(result.found, options)) {
    const double wanted = wanted_m(result.found, options);
    const double deep_m = result.found.empty() ? INFINITY : deep * result.found.front().depth_m;
    if (low.unstable > 0 && low.depth_m >= std::max(deep_m, again_m)) {
      const std::optional<double> again = stable_again_m(search, low.depth_m, wanted);
      if (!again) {
        result.unstable_to_m = wanted;
        break;
      }
      again_m = *again;
    }
    const double end = low.depth_m < deep_m ? std::min(deep_m, wanted) : wanted;
    std::optional<Probe> high =
        search.after(low, std::min(next_look(search, low.depth_m, !result.found.empty(), options), end));
    // Deep in an unstable range no limit depends on what is found, which is not worth many grids.
    const int halvings = low.unstable > 0 && high && high->unstable > 0 ? 1 : 5;
    const bool explained = high && search.between(low, *high, halvings, result);
    std::ranges::sort(result.found, {}, &Crossing::depth_m);
    if (!explained) break;
    low = std::move(*high);
  }
  if (options.follow == 1.0 && !result.found.empty()) {
    result.searched_m = wanted_m(result.found, options);
    std::erase_if(result.found, [&](const Crossing& c) { return c.depth_m > clearly_beyond * result.searched_m; });
  }
  return result;
}

/// Grids that each depth has of its own: a level is so many times finer than the depth's first.
class HelicalGrids : public SearchGrids {
 public:
  HelicalGrids(const CutAtSpeed& cut, const HelicalSearch& search, const StabilityOptions& options)
      : cut_(cut), search_(search), options_(options) {}

  [[nodiscard]] OnFinerGrid move_to(std::size_t level, Crossing& crossing) override {
    const Resolution next = resolution(level, crossing.depth_m);
    if (level > 2 && next.elements * next.nodes > options_.most_nodes) return OnFinerGrid::none_finer;
    finest_ = std::max(finest_, next.elements * next.nodes);
    const double w = crossing.depth_m;
    return settle(cut_, next, 0.9 * w, 1.1 * w, most_steps, crossing) ? OnFinerGrid::kept : OnFinerGrid::lost;
  }
  [[nodiscard]] double unresolved(std::size_t level, double depth_m) override {
    return milling::unresolved(cut_, resolution(level, depth_m), depth_m);
  }
  /// The nodes of the finest grid so far, whatever the level.
  [[nodiscard]] int nodes(std::size_t /*level*/) override { return finest_; }
  [[nodiscard]] int unstable(std::size_t level, double depth_m) override {
    return milling::unstable(discrete(cut_, resolution(level, depth_m), depth_m), depth_m);
  }
  [[nodiscard]] bool stable(std::size_t level, double depth_m) override {
    return milling::stable(discrete(cut_, resolution(level, depth_m), depth_m), depth_m);
  }
  [[nodiscard]] double chatter_frequency_hz(std::size_t level, const Crossing& crossing) override {
    const Resolution on = resolution(level, crossing.depth_m);
    const double theta = crossing.theta_rad;
    const ContactGrid grid = contact_grid(cut_.process, cut_.yielding, on, crossing.depth_m);
    // The mode is that of the last step of Newton's rule, whose grid is this one unless a stretch of the cut began.
    if (static_cast<std::size_t>(crossing.mode.size()) == grid.contacts.size())
      return milling::chatter_frequency_hz(cut_, grid, theta, crossing.mode);
    const DiscreteCut d = discrete(cut_, on, crossing.depth_m);
    return milling::chatter_frequency_hz(cut_, d.grid, theta, modulation(d, crossing.depth_m, on_circle(theta)));
  }

 private:
  [[nodiscard]] Resolution resolution(std::size_t level, double depth_m) const {
    const Resolution first = search_.resolution(depth_m);
    if (level == 0) return first;
    const double depth = std::min(depth_m, cut_.process.cutter.envelope.height_m);
    return finer_by(finer(first, estimating(cut_, depth, options_)), level - 1);
  }

  const CutAtSpeed& cut_;
  const HelicalSearch& search_;
  const StabilityOptions& options_;
  int finest_ = 0;
};

/// The row of a search on grids that are so many times finer than is needed.
LobeRow row_of(const CutAtSpeed& cut, std::size_t refinements, const StabilityOptions& options) {
  const HelicalSearch search(cut, refinements, options);
  CoarseCrossings coarse = scan(search, options);
  const bool ended_early = coarse.found.empty() && coarse.searched_m < options.depth_limit_m;
  LobeRow row;
  row.spindle_speed_rpm = cut.spindle_speed_rpm;
  if (coarse.searched_m > 0.0) {
    HelicalGrids grids(cut, search, options);
    row = checked_row(grids, std::move(coarse), cut.spindle_speed_rpm, options);
  }
  if (ended_early) row.status = StabilityStatus::crossing_missed;
  return row;
}

}  // namespace

LobeRow helical_row(const CutAtSpeed& cut, const StabilityOptions& options) {
  // A crossing that is missed on grids of one fineness is as a rule found on finer ones.
  for (std::size_t refinements = 0;; ++refinements) {
    LobeRow row = row_of(cut, refinements, options);
    if (row.status != StabilityStatus::crossing_missed || refinements == 2) return row;
  }
}

}  // namespace thinwall::milling
