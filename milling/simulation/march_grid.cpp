#include "milling/simulation/march_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/error.hpp"
#include "milling/cut/cut_cycle.hpp"
#include "milling/cut/edge.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

constexpr double hair = 1e-9;  // rad: moments closer than this are one

/// Every disc of every tooth as a sweep of its own, without lag.
struct DiscCycle {
  CutCycle cycle;
  std::vector<int> disc;  ///< of each sweep
};

DiscCycle disc_cycle(const MillingProcess& process, double depth_m, const std::vector<Disc>& discs) {
  const CutCycle edges = equal_surfaces(process) ? cut_cycle(process, depth_m) : cycle_of_turn(process, depth_m);
  DiscCycle result{{edges.period_rad, edges.equal_teeth, {}, {0.0, 1.0}}, {}};
  for (const Sweep& edge : edges.sweeps) {
    for (std::size_t d = 0; d < discs.size(); ++d) {
      const double height = discs[d].height_m / depth_m;
      const double lag = height * edge.lag_rad;
      Sweep sweep = edge;
      sweep.entry_rad = std::fmod(edge.entry_rad + lag, edges.period_rad);
      sweep.pitch_rad = edge.delay_rad(height);
      sweep.lag_rad = sweep.ahead_lag_rad = 0.0;
      result.cycle.sweeps.push_back(sweep);
      result.disc.push_back(static_cast<int>(d));
    }
  }
  return result;
}

int steps_of(const CutStretch& stretch, const DiscCycle& teeth, const StepOptions& options) {
  double longest = 0.0;
  for (const Sweep& sweep : teeth.cycle.sweeps) longest = std::max(longest, sweep.arc_rad);
  const double share = (stretch.to_rad - stretch.from_rad) / longest;
  return std::max(2, static_cast<int>(std::ceil(share * options.steps_in_cut - 1e-6)));
}

/// A pass of a sweep through the cut: rotation since it entered, at the node.
struct Pass {
  int sweep = 0;
  double since_entry_rad = 0.0;
};

/// The passes in the cut all through a stretch, at one of its rotations.
std::vector<Pass> passes_at(const CutCycle& cycle, const MarchStretch& stretch, double rotation_rad) {
  std::vector<Pass> passes;
  const double middle = 0.5 * (stretch.from_rad + stretch.to_rad);
  for (std::size_t i = 0; i < cycle.sweeps.size(); ++i) {
    each_pass(cycle, cycle.sweeps[i], middle, [&](double s) {
      passes.push_back({static_cast<int>(i), std::clamp(s + rotation_rad - middle, 0.0, cycle.sweeps[i].arc_rad)});
    });
  }
  return passes;
}

double edge_share(const MillingProcess& process, const Disc& disc, int tooth) {
  return edge_length_per_height(process.cutter, tooth, disc.height_m) * disc.sin_kappa;
}

class Builder {
 public:
  Builder(const MillingProcess& process, double depth_m, double feed_per_tooth_m, const StepOptions& options)
      : process_(process), feed_m_per_rad_(feed_per_tooth_m / process.cutter.pitch_rad()) {
    grid_.discs = discs_of(process, depth_m, options);
    teeth_ = disc_cycle(process, depth_m, grid_.discs);
    grid_.period_rad = teeth_.cycle.period_rad;
    grid_.periods_a_turn = teeth_.cycle.equal_teeth ? process.cutter.teeth : 1;
    int node = 0;
    for (const CutStretch& stretch : cut_stretches(teeth_.cycle)) {
      const int steps = steps_of(stretch, teeth_, options);
      grid_.stretches.push_back({stretch.from_rad, stretch.to_rad, steps, node});
      node += 2 * steps + 1;
    }
  }

  MarchGrid build() && {
    for (const MarchStretch& stretch : grid_.stretches) add_points(stretch);
    grid_.first_point.push_back(static_cast<int>(grid_.points.size()));
    for (const MarchStretch& stretch : grid_.stretches) add_pasts(stretch);
    add_tips();
    return std::move(grid_);
  }

 private:
  void add_points(const MarchStretch& stretch) {
    for (int i = 0; i <= 2 * stretch.steps; ++i) {
      grid_.first_point.push_back(static_cast<int>(grid_.points.size()));
      for (const Pass& pass : passes_at(teeth_.cycle, stretch, MarchGrid::rotation_rad(stretch, i))) {
        const Sweep& sweep = teeth_.cycle.sweeps[static_cast<std::size_t>(pass.sweep)];
        const int d = teeth_.disc[static_cast<std::size_t>(pass.sweep)];
        const Disc& disc = grid_.discs[static_cast<std::size_t>(d)];
        const double phi = sweep.entry_phi_rad + pass.since_entry_rad;
        const auto tooth = static_cast<std::size_t>(sweep.tooth);
        const double runout = process_.cutter.runout_m.empty() ? 0.0 : process_.cutter.runout_m[tooth];
        grid_.points.push_back({std::sin(phi), std::cos(phi),
                                feed_m_per_rad_ * sweep.pitch_rad * disc.sin_kappa * std::sin(phi),
                                runout * disc.sin_kappa, edge_share(process_, disc, sweep.tooth), d, sweep.tooth,
                                pass.since_entry_rad < hair || pass.since_entry_rad > sweep.arc_rad - hair});
      }
    }
  }

  void add_pasts(const MarchStretch& stretch) {
    for (int i = 0; i <= 2 * stretch.steps; ++i) {
      const double rotation = MarchGrid::rotation_rad(stretch, i);
      const int node = stretch.first_node + i;
      int point = grid_.first_point[static_cast<std::size_t>(node)];
      for (const Pass& pass : passes_at(teeth_.cycle, stretch, rotation)) {
        CutPoint& p = grid_.points[static_cast<std::size_t>(point)];
        p.first_past = static_cast<int>(grid_.pasts.size());
        if (teeth_.cycle.equal_teeth) {
          grid_.pasts.push_back({point, 1.0});  // the tooth ahead was at this very node, a period ago
        } else {
          add_interpolated_past(pass, rotation);
        }
        p.pasts = static_cast<int>(grid_.pasts.size()) - p.first_past;
        ++point;
      }
    }
  }

  /// The sweep of the tooth ahead with the same disc and arc.
  int ahead_of(int sweep) const {
    const auto& sweeps = teeth_.cycle.sweeps;
    const int count = static_cast<int>(sweeps.size());
    const int of_a_tooth = count / process_.cutter.teeth;
    return (sweep + count - of_a_tooth) % count;
  }

  void add_interpolated_past(const Pass& pass, double rotation) {
    const Sweep& sweep = teeth_.cycle.sweeps[static_cast<std::size_t>(pass.sweep)];
    const int ahead = ahead_of(pass.sweep);
    const double then = std::fmod(rotation - sweep.pitch_rad + 2.0 * grid_.period_rad, grid_.period_rad);
    for (const MarchStretch& stretch : grid_.stretches) {
      // A moment at the very start of the period is at its end, too.
      for (const double at : {then, then - grid_.period_rad, then + grid_.period_rad}) {
        if (at < stretch.from_rad - hair || at > stretch.to_rad + hair) continue;
        const int place = place_of(ahead, stretch);
        if (place < 0) continue;
        interpolate(stretch, place, at);
        return;
      }
    }
    throw core::InputError("simulation: a tooth meets a surface that no tooth has left; tell the authors of thinwall");
  }

  /// Which of the points of each node of a stretch is that of a sweep; −1 if it does not cut there.
  int place_of(int sweep, const MarchStretch& stretch) const {
    const auto passes = passes_at(teeth_.cycle, stretch, stretch.from_rad);
    for (std::size_t i = 0; i < passes.size(); ++i) {
      if (passes[i].sweep == sweep) return static_cast<int>(i);
    }
    return -1;
  }

  void interpolate(const MarchStretch& stretch, int place, double at) {
    const double nodes_before = (at - stretch.from_rad) / (stretch.to_rad - stretch.from_rad) * 2.0 * stretch.steps;
    const auto nearest = static_cast<int>(std::lround(nodes_before));
    const auto point = [&](int of_stretch) {
      const int node = stretch.first_node + of_stretch;
      return grid_.first_point[static_cast<std::size_t>(node)] + place;
    };
    if (std::abs(nodes_before - nearest) < 1e-6) {
      grid_.pasts.push_back({point(nearest), 1.0});
      return;
    }
    const int window = std::min(6, 2 * stretch.steps + 1);
    const int first =
        std::clamp(static_cast<int>(std::floor(nodes_before)) - (window / 2 - 1), 0, 2 * stretch.steps + 1 - window);
    const Eigen::VectorXd weights =
        lagrange_polynomials(Eigen::VectorXd::LinSpaced(window, first, first + window - 1), nodes_before);
    std::vector<int> order(static_cast<std::size_t>(window));  // the two about the moment come first
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return std::abs(first + a - nodes_before) < std::abs(first + b - nodes_before); });
    for (const int k : order) grid_.pasts.push_back({point(first + k), weights(k)});
  }

  void add_tips() {
    for (std::size_t i = 0; i < teeth_.cycle.sweeps.size(); ++i) {
      if (teeth_.disc[i] != 0) continue;
      const Sweep& sweep = teeth_.cycle.sweeps[i];
      const double exit = std::fmod(sweep.entry_rad + sweep.arc_rad, grid_.period_rad);
      grid_.tips.push_back(
          {sweep.tooth, sweep.entry_rad, exit < hair ? grid_.period_rad : exit, sweep.entry_phi_rad, sweep.arc_rad});
    }
  }

  const MillingProcess& process_;
  double feed_m_per_rad_;
  DiscCycle teeth_;
  MarchGrid grid_;
};

}  // namespace

std::vector<Disc> discs_of(const MillingProcess& process, double depth_m, const StepOptions& options) {
  const Cutter& cutter = process.cutter;
  const EdgeShape shape = edge_shape(cutter, depth_m);
  std::vector<Disc> discs;
  for (const EdgeWeight& w : edge_weights(shape, cutter.depends_on_depth() ? options.discs : 1, 0.0, 1.0)) {
    const double height = w.height * depth_m;
    const bool upright = w.kappa_rad == 0.5 * std::numbers::pi;
    discs.push_back({height, std::sin(w.kappa_rad), upright ? 0.0 : std::cos(w.kappa_rad), w.weight * depth_m,
                     at_height(cutter.envelope, cutter.diameter_m, height).radius_m});
  }
  return discs;
}

std::vector<std::string> validate(const StepOptions& options) {
  std::vector<std::string> violations;
  if (options.steps_in_cut < 4) {
    violations.push_back("simulation: " + std::to_string(options.steps_in_cut) +
                         " steps in the cut, must be at least 4; 200 are usual");
  }
  if (options.discs < 1) {
    violations.push_back("simulation: " + std::to_string(options.discs) +
                         " discs, must be at least 1; 12 are usual where a helix or an end makes height matter");
  }
  return violations;
}

int MarchGrid::steps() const {
  int sum = 0;
  for (const MarchStretch& stretch : stretches) sum += stretch.steps;
  return sum;
}

double MarchGrid::rotation_rad(const MarchStretch& stretch, int node) {
  return stretch.from_rad + (stretch.to_rad - stretch.from_rad) * node / (2.0 * stretch.steps);
}

MarchGrid march_grid(const MillingProcess& process, double depth_m, double feed_per_tooth_m,
                     const StepOptions& options) {
  require_valid(validate(process));
  require_valid(validate(options));
  return Builder(process, depth_m, feed_per_tooth_m, options).build();
}

}  // namespace thinwall::milling
