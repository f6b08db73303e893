#include "milling/simulation/cleared_area.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace thinwall::milling {

namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;
constexpr int rays_a_turn = 720;
constexpr int looks_a_turn = 12;

/// The angle in [0, 2π).
double within_turn(double rad) {
  const double rest = std::fmod(rad, turn_rad);
  return rest < 0.0 ? rest + turn_rad : rest;
}

Eigen::Vector2d direction(double phi_rad) {
  return {std::sin(phi_rad), std::cos(phi_rad)};
}

}  // namespace

ClearedArea::ClearedArea(const PathCut& cut, Stock stock) : cut_(cut), stock_(std::move(stock)) {
  std::size_t heights = 0;
  for (const ToothDisc& disc : cut.discs) heights = std::max(heights, static_cast<std::size_t>(disc.slice) + 1);
  slices_.resize(heights);
  for (const ToothDisc& disc : cut.discs) {
    Slice& slice = slices_[static_cast<std::size_t>(disc.slice)];
    slice.share = disc.width_m / cut.width_m;
    slice.discs.push_back(&disc);
  }
  // Passes up to twice as far behind are remembered, and a tip that shapes the wall at the line points at most 30° off
  // the normal of the wall.
  const double remembered_m = cut.feed_per_node_m * cut.discs.front().earlier.back().ahead_rad / cut.node_rad;
  behind_m_ = std::min(0.5 * cut.radius_m, 0.45 * remembered_m);
  nodes_a_look_ = std::max(2L, 2L * (cut.steps_a_turn / looks_a_turn));
}

double ClearedArea::rotation_rad(long node) const {
  return cut_.entry_rad + static_cast<double>(node) * cut_.node_rad;
}

double ClearedArea::line_m(long node) const {
  return cut_.start_m.x() + cut_.feed_per_node_m * static_cast<double>(node) - behind_m_;
}

/// The farthest from a place, which lies `before_m` behind the centre but for vibration, that the teeth of a slice have
/// cut up to a node, along the ray at an angle. Passes that cannot have cut farther than another are left out.
double ClearedArea::farthest_m(const CentrePath& path, const Moment& now, const Slice& slice,
                               const Eigen::Vector2d& from, double before_m, double phi_rad) const {
  constexpr double other_angle_rad = 0.6;  // at which a tooth meets a ray that does not begin at the centre
  const double feed_per_rad = cut_.feed_per_node_m / cut_.node_rad;
  const Eigen::Vector2d n = direction(phi_rad), t(n.y(), -n.x());
  double farthest = 0.0;
  for (const ToothDisc* disc : slice.discs) {
    const double latest = within_turn(rotation_rad(now.node) - disc->behind_rad - phi_rad);
    const auto look = [&](double ahead) {
      if (ahead >= disc->earlier.back().ahead_rad) return;
      const double x = before_m - feed_per_rad * ahead, unsure = 0.1 * (before_m - x) + other_angle_rad * feed_per_rad;
      if (farthest_cut_m(disc->radius_m, n, x - unsure, x + unsure, 2.0 * now.reach_m) < farthest) return;
      const PathRay ray{path,          from,          t, static_cast<double>(now.node) - ahead / cut_.node_rad,
                        cut_.node_rad, disc->radius_m};
      const PathRay::Crossing found = ray.crossing(std::max(-0.5 * std::numbers::pi, -ahead));
      if (found.met)
        farthest = std::max(farthest, found.from_centre_m.dot(n) + disc->radius_m * std::cos(found.epsilon_rad));
    };
    look(latest + turn_rad * std::round(before_m / (feed_per_rad * turn_rad)));  // the centre was about there
    for (double ahead = latest; ahead < disc->earlier.back().ahead_rad; ahead += turn_rad) look(ahead);
  }
  return farthest;
}

/// y₊ − y₋ within the stock where the line is at a node.
double ClearedArea::between_walls_m(const CentrePath& path, const Moment& now, const Slice& slice) const {
  const Eigen::Vector2d from(line_m(now.node), 0.0);
  double sum = 0.0;
  for (const double phi : {0.0, std::numbers::pi}) {
    const RaySpan span = within(stock_, from, direction(phi), 4.0 * cut_.radius_m);
    sum += std::max(0.0, std::min(span.to_m, farthest_m(path, now, slice, from, behind_m_, phi)) - span.from_m);
  }
  return sum;
}

void ClearedArea::pass(const CentrePath& path, const Moment& now) {
  if (now.node < looked_at_ + nodes_a_look_) return;
  passed_m2_ += since_look_m2(path, now);
  looked_at_ = now.node;
}

/// The area between the walls from the last look up to a node.
double ClearedArea::since_look_m2(const CentrePath& path, const Moment& now) const {
  double width = 0.0;
  for (const Slice& slice : slices_) width += slice.share * between_walls_m(path, now, slice);
  return width * cut_.feed_per_node_m * static_cast<double>(now.node - looked_at_);
}

/// The area within the stock ahead of the line. The tips, at which ρ jumps, lie between rays.
double ClearedArea::ahead_m2(const CentrePath& path, const Moment& now, const Slice& slice) const {
  std::vector<double> tips;
  for (const ToothDisc* disc : slice.discs) tips.push_back(within_turn(rotation_rad(now.node) - disc->behind_rad));
  std::sort(tips.begin(), tips.end());
  tips.push_back(tips.front() + turn_rad);
  const double to_line = now.centre.x() - line_m(now.node);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < tips.size(); ++i) {
    const double gap = tips[i + 1] - tips[i];
    const int rays = static_cast<int>(std::ceil(gap / turn_rad * rays_a_turn));
    for (int k = 0; k < rays; ++k) {
      const double phi = tips[i] + gap * (k + 0.5) / rays;
      const Eigen::Vector2d n = direction(phi);
      const double longest = n.x() < 0.0 ? std::min(4.0 * cut_.radius_m, -to_line / n.x()) : 4.0 * cut_.radius_m;
      const RaySpan span = within(stock_, now.centre, n, longest);
      if (span.from_m >= span.to_m) continue;
      const double to = std::clamp(farthest_m(path, now, slice, now.centre, 0.0, phi), span.from_m, span.to_m);
      sum += 0.5 * (to * to - span.from_m * span.from_m) * gap / rays;
    }
  }
  return sum;
}

std::optional<double> ClearedArea::area_m2(const CentrePath& path, const Moment& now) const {
  // A pass that is deeper by Δ takes more than others as far as √(2RΔ) from its deepest place; teeth that differ, the
  // feed of a turn.
  const double feed_a_turn_m = cut_.feed_per_node_m * turn_rad / cut_.node_rad;
  if (4.0 * cut_.radius_m * now.reach_m >= behind_m_ * behind_m_ || behind_m_ < feed_a_turn_m) return {};
  double area = passed_m2_ + since_look_m2(path, now);
  for (const Slice& slice : slices_) area += slice.share * ahead_m2(path, now, slice);
  return area;
}

}  // namespace thinwall::milling
