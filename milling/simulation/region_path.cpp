#include "milling/simulation/region_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "milling/simulation/chip_force.hpp"
#include "milling/simulation/modal_tool.hpp"
#include "milling/simulation/path_march.hpp"

namespace thinwall::milling {

namespace {

using Point = Eigen::Vector2d;

/// Each slice of the part, and what the discs of the teeth do to it: the material of path_march.hpp.
class Slices {
 public:
  Slices(const std::vector<Outline>& part, double cell_m, const PathCut& cut, SweptEdge edge)
      : cut_(cut), edge_(edge), beyond_m_(cell_m) {
    int most = 0;
    for (const ToothDisc& disc : cut.discs) most = std::max(most, disc.slice);
    for (int i = 0; i <= most; ++i) slices_.emplace_back(part, cell_m);
    before_.emplace(part, 4.0 * cell_m);
    constexpr double off_path_m = 5e-10;
    // A chord over an angle δ leaves the arc by R δ²/8.
    chords_ = edge == SweptEdge::chords
                  ? 1
                  : std::max(1, static_cast<int>(std::ceil(cut.node_rad / std::sqrt(8.0 * off_path_m / cut.radius_m))));
  }

  /// The material on the ray is looked for at the first place of the centre in a step; further places move the tip by
  /// far less than a chip.
  double chip(const ToothDisc& disc, DiscRay& ray, double /*node*/, const Point& centre) const {
    if (!ray.found) {
      const double reach = disc.radius_m + beyond_m_;
      const RayMaterial met =
          slices_[static_cast<std::size_t>(disc.slice)].on_ray(centre, ray.n(), disc.radius_m, reach);
      ray.found = met.within_m > 0.0 || met.beyond_m < reach;
      ray.in_cut = ray.sine > 0.0 && was_material(ray, disc.radius_m, centre);
      ray.farthest_m = met.within_m > 0.0 || met.tip_within ? disc.radius_m - met.within_m : met.beyond_m;
      ray.from = centre;
      if (!ray.found) return 0.0;
    }
    return disc.radius_m - ray.farthest_m + ray.n().dot(centre - ray.from);
  }

  /// Takes away the sectors of the discs whose rays have met material; of all where none was looked for.
  void leave(const PathStep& step) {
    const auto& rays = step.rays;
    for (std::size_t i = 0; i < cut_.discs.size(); ++i) {
      if (rays[0].empty() || rays[0][i].found || rays[1][i].found || rays[2][i].found) sweep(step, i);
    }
  }

  /// Takes away an area of all slices.
  void erase(const Outline& outline) {
    for (PartRegion& slice : slices_) slice.erase(outline);
  }

  /// The area that was taken away, up to a constant.
  [[nodiscard]] std::optional<double> cleared_m2() const { return -mean_area_m2(); }

  [[nodiscard]] double mean_area_m2() const {
    double sum = 0.0;
    for (const ToothDisc& disc : cut_.discs) {
      if (disc.tooth == 0) sum += disc.width_m / cut_.width_m * slices_[static_cast<std::size_t>(disc.slice)].area_m2();
    }
    return sum;
  }

  [[nodiscard]] const PartRegion& slice(int i) const { return slices_[static_cast<std::size_t>(i)]; }

 private:
  /// True if the ray crossed the material before the cut: a tooth that meets nothing there has lost its contact, and
  /// one beside it has not.
  [[nodiscard]] bool was_material(const DiscRay& ray, double radius_m, const Point& centre) const {
    return before_->on_ray(centre, ray.n(), radius_m, radius_m).tip_within;
  }

  void sweep(const PathStep& step, std::size_t i) {
    const ToothDisc& disc = cut_.discs[i];
    const double phi = cut_.entry_rad + static_cast<double>(step.node) * cut_.node_rad - disc.behind_rad;
    const auto tip = [&](double phi_at, const Point& centre) {
      return Point(centre + disc.radius_m * Point(std::sin(phi_at), std::cos(phi_at)));
    };
    swept_.assign(1, step.centre[0]);
    swept_.push_back(tip(phi, step.centre[0]));
    if (edge_ == SweptEdge::arcs) {
      for (std::size_t half = 0; half < 2; ++half) {
        const Point moved = step.centre[half + 1] - step.centre[half];
        for (int k = 1; k <= chords_; ++k) {
          const double s = static_cast<double>(k) / chords_;
          swept_.push_back(tip(phi + (static_cast<double>(half) + s) * cut_.node_rad, step.centre[half] + s * moved));
        }
      }
    } else {
      swept_.push_back(tip(phi + 2.0 * cut_.node_rad, step.centre[2]));
    }
    swept_.push_back(step.centre[2]);
    slices_[static_cast<std::size_t>(disc.slice)].erase(swept_);
  }

  const PathCut& cut_;
  SweptEdge edge_;
  double beyond_m_;
  int chords_ = 1;
  std::vector<PartRegion> slices_;
  std::optional<PartRegion> before_;  ///< the part before the cut
  Outline swept_;
};

/// Takes away what a tool that did not vibrate has cut before the start: its body up to some turns before, and the last
/// turns tooth by tooth.
void clear_behind(Slices& slices, const PathCut& cut, double behind_m) {
  constexpr int turns = 3;
  const long nodes = 2L * turns * cut.steps_a_turn;
  const Point start = cut.start_m.head<2>();
  const Point early = start - Point(cut.feed_per_node_m * static_cast<double>(nodes), 0.0);
  double least = std::numeric_limits<double>::infinity();
  for (const ToothDisc& disc : cut.discs) least = std::min(least, disc.radius_m);
  Outline body{{early.x() - behind_m, early.y() + least}, {early.x() - behind_m, early.y() - least}};
  constexpr int corners = 360;
  for (int i = 0; i <= corners; ++i) {
    const double angle = std::numbers::pi * (static_cast<double>(i) / corners - 0.5);
    body.emplace_back(early + least * Point(std::cos(angle), std::sin(angle)));
  }
  slices.erase(body);
  const std::array<std::vector<DiscRay>, 3> none;
  for (long node = -nodes; node < 0; node += 2) {
    const auto at = [&](long n) { return Point(start + Point(cut.feed_per_node_m * static_cast<double>(n), 0.0)); };
    slices.leave({node, {at(node), at(node + 1), at(node + 2)}, none});
  }
}

}  // namespace

Outline outline_of(const Stock& stock, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  Outline outline{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
  for (const StockEdge& edge : stock) {
    // The part of a convex polygon within an edge (Sutherland & Hodgman 1974).
    Outline left;
    for (std::size_t i = 0; i < outline.size(); ++i) {
      const Point& a = outline[i];
      const Point& b = outline[(i + 1) % outline.size()];
      const double beyond_a = edge.normal.dot(a) - edge.offset_m, beyond_b = edge.normal.dot(b) - edge.offset_m;
      if (beyond_a <= 0.0) left.push_back(a);
      if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0))
        left.emplace_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
    }
    outline = std::move(left);
  }
  return outline;
}

CutWindow cut_window(const MillingProcess& process, const SimulatedPoint& point, int turns) {
  double radius = 0.5 * process.cutter.diameter_m;
  for (const double runout : process.cutter.runout_m)
    radius = std::max(radius, 0.5 * process.cutter.diameter_m + runout);
  const double feed = turns * process.cutter.teeth * point.feed_per_tooth_m;
  const double around = 1.1 * radius;
  return {{-around, -around}, {feed + around, around}};
}

RegionCut simulate_region(const RelativeStructure& structure, const MillingProcess& process, const ForceLaw& law,
                          const SimulatedPoint& point, const std::vector<Outline>& part,
                          const SimulationOptions& options, const RegionOptions& region,
                          const TurnObserver& after_turn) {
  require_usable(process, law, point, options);
  require_valid(validate(PathOptions{region.steps_a_turn, 1}));
  require_whole_steps(options, whole_steps(process, region.steps_a_turn));
  const PathCut cut = path_cut(structure, process, point, options, region.steps_a_turn, 1, region.contact);
  const double cell = region.cell_m > 0.0 ? region.cell_m : cut.radius_m / 20.0;
  Slices slices(part, cell, cut, region.edge);
  double behind = 0.0;
  for (const Outline& outline : part) {
    for (const Point& corner : outline) behind = std::max(behind, -corner.x());
  }
  clear_behind(slices, cut, behind);
  const double before = slices.mean_area_m2();
  RegionCut result;
  result.cut = with_chip_force(process, law, [&](const auto& chip_force) {
    return with_modal_tool(
        cut, [&](const auto& tool) { return over_path(cut, tool, slices, chip_force, process, options, after_turn); });
  });
  result.removed_m2 = before - slices.mean_area_m2();
  const std::vector<Disc> heights = discs_of(process, point.depth_m, options.steps);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    result.slices.push_back({heights[i].height_m, heights[i].width_m, slices.slice(static_cast<int>(i)).outlines()});
  }
  return result;
}

}  // namespace thinwall::milling
