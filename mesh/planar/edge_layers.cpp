#include "mesh/planar/edge_layers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

using std::numbers::pi;

const Eigen::Vector2d& at(const BorderGraph& graph, int point) {
  return graph.points[static_cast<std::size_t>(point)];
}

/// Angle from u to v, counter-clockwise, in (0, 2π].
double turn(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  const double angle = std::atan2(cross(u, v), u.dot(v));
  return angle > 1e-12 ? angle : angle + 2.0 * pi;
}

/// The sides that leave each point.
std::vector<std::vector<int>> leaving(const BorderGraph& graph, const std::vector<BorderSide>& sides) {
  std::vector<std::vector<int>> result(graph.points.size());
  for (std::size_t i = 0; i < sides.size(); ++i)
    result[static_cast<std::size_t>(sides[i].from)].push_back(static_cast<int>(i));
  return result;
}

/// The distance from a side to the part of `line` that lies across it: the least t of that part within 0 ≤ s ≤ length,
/// in the frame (s, t) of the side; infinite if there is no such part or it lies on the right.
double way_across(const Segment& line, const Eigen::Vector2d& origin, const Eigen::Vector2d& along, double length) {
  Eigen::Vector2d a(along.dot(line[0] - origin), cross(along, line[0] - origin));
  Eigen::Vector2d b(along.dot(line[1] - origin), cross(along, line[1] - origin));
  if (a.x() > b.x()) std::swap(a, b);
  if (b.x() <= 1e-9 * length || a.x() >= (1.0 - 1e-9) * length) return INFINITY;
  const auto height = [&](double s) { return a.y() + (b.y() - a.y()) * (s - a.x()) / (b.x() - a.x()); };
  double least = std::min(a.y(), b.y());
  if (b.x() > a.x()) least = std::min(height(std::max(a.x(), 0.0)), height(std::min(b.x(), length)));
  return std::max(a.y(), b.y()) > 0.0 && least > 0.0 ? least : INFINITY;
}

/// Distance from p along the unit vector u to the first border; infinite if there is none.
double ray(const BorderGraph& graph, const Eigen::Vector2d& p, const Eigen::Vector2d& u) {
  double first = INFINITY;
  for (const auto& border : graph.borders) {
    const auto [a, b] = segment(graph, border);
    const double ta = cross(u, a - p);
    const double tb = cross(u, b - p);
    if ((ta > 0.0) == (tb > 0.0)) continue;
    const double s = u.dot(a - p) + ta / (ta - tb) * u.dot(b - a);
    if (s > 0.0) first = std::min(first, s);
  }
  return first;
}

/// The space beside a side.
struct Room {
  double across = 0.0;     // distance to the opposite border
  double thickness = 0.0;  // the smaller of the material's height and its length along the side
};

/// The space beside a side, from all borders that do not end at it.
Room room(const BorderGraph& graph, const BorderSide& side) {
  const Eigen::Vector2d along = direction(graph, side);
  const double span = length(graph, side);
  Room result{INFINITY, side.extent.top - side.extent.bottom};
  for (const auto& border : graph.borders) {
    const bool neighbour =
        border.from == side.from || border.from == side.to || border.to == side.from || border.to == side.to;
    if (!neighbour)
      result.across = std::min(result.across, way_across(segment(graph, border), at(graph, side.from), along, span));
  }
  // In a triangle, the other borders are all neighbours; the distance across is then measured along a ray from the
  // middle.
  const Eigen::Vector2d middle = 0.5 * (at(graph, side.from) + at(graph, side.to));
  const Eigen::Vector2d inside = inward(graph, side);
  if (!std::isfinite(result.across)) result.across = ray(graph, middle + 1e-6 * span * inside, inside);
  const Eigen::Vector2d p = middle + 0.5 * std::min(result.across, result.thickness) * inside;
  result.thickness = std::min(result.thickness, ray(graph, p, along) + ray(graph, p, -along));
  return result;
}

/// Width of a side's outermost layer as set_layer_widths() describes it; `reach`: width of all layers over it.
double wanted_width(const Room& room, const PrismMeshOptions& options, double reach) {
  if (room.across < 0.99 * room.thickness) return 0.0;
  const double wall = std::min(room.thickness, room.across);
  const double wanted = options.layer_width_m > 0.0 ? options.layer_width_m : wall;
  return std::min({wanted, options.size_m, room.across / (3.0 * reach)});
}

/// Narrows the layers of two sides if the feet of their corner would take more than 0.4 of either side. If that leaves
/// less than a fifth (at a needle or a notch), the sides get no layers.
void fit_corner(std::vector<BorderSide>& sides, const BorderGraph& graph, BorderSide& side, double reach) {
  BorderSide& next = sides[static_cast<std::size_t>(side.next)];
  const double a = reach * side.width;
  const double b = reach * next.width;
  double foot = 0.0;
  double next_foot = 0.0;
  if (smooth(side)) {
    foot = next_foot = std::min(a, b) * std::abs(std::tan(0.5 * (pi - side.angle)));
  } else {
    foot = std::abs(corner_foot(side.angle, a, b));
    next_foot = std::abs(corner_foot(side.angle, b, a));
  }
  const double excess = std::max(foot / length(graph, side), next_foot / length(graph, next)) / 0.4;
  if (excess <= 1.0) return;
  const double factor = excess > 5.0 ? 0.0 : 1.0 / excess;
  side.width *= factor;
  next.width *= factor;
}

}  // namespace

double corner_foot(double angle, double a, double b) {
  const double sine = std::sin(angle);
  return (b + a * std::cos(angle)) / (std::abs(sine) < 1e-9 ? std::copysign(1e-9, sine) : sine);
}

bool smooth(const BorderSide& side) {
  return std::abs(side.angle - pi) < pi / 6.0;
}

Eigen::Vector2d direction(const BorderGraph& graph, const BorderSide& side) {
  return (at(graph, side.to) - at(graph, side.from)).normalized();
}

Eigen::Vector2d inward(const BorderGraph& graph, const BorderSide& side) {
  const Eigen::Vector2d along = direction(graph, side);
  return {-along.y(), along.x()};
}

double length(const BorderGraph& graph, const BorderSide& side) {
  return (at(graph, side.to) - at(graph, side.from)).norm();
}

std::vector<BorderSide> border_sides(const BorderGraph& graph) {
  std::vector<BorderSide> sides;
  for (std::size_t i = 0; i < graph.borders.size(); ++i) {
    const Border& border = graph.borders[i];
    const int index = static_cast<int>(i);
    if (border.left) sides.push_back({index, border.from, border.to, *border.left, 0, 0, 0.0, 0.0});
    if (border.right) sides.push_back({index, border.to, border.from, *border.right, 0, 0, 0.0, 0.0});
  }
  const auto from = leaving(graph, sides);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    BorderSide& side = sides[i];
    const Eigen::Vector2d back = -direction(graph, side);
    side.angle = INFINITY;
    for (const int candidate : from[static_cast<std::size_t>(side.to)]) {
      // The first side clockwise from the direction back along this one is the next side of the region on the left.
      const double angle = turn(direction(graph, sides[static_cast<std::size_t>(candidate)]), back);
      if (angle >= side.angle) continue;
      side.angle = angle;
      side.next = candidate;
    }
    sides[static_cast<std::size_t>(side.next)].previous = static_cast<int>(i);
  }
  return sides;
}

void set_layer_widths(std::vector<BorderSide>& sides, const BorderGraph& graph, const PrismMeshOptions& options,
                      double narrowest_m) {
  for (auto& side : sides) side.width = 0.0;
  const auto unit = layer_distances(options.layers, options.layer_factor);
  if (unit.empty()) return;
  for (auto& side : sides) {
    side.width = wanted_width(room(graph, side), options, unit.back());
    if (side.width == 0.0 || side.width * unit.front() >= narrowest_m) continue;
    std::ostringstream text;
    const Eigen::Vector2d p = 1e3 * at(graph, side.from);
    text << "the innermost of " << options.layers << " layers would be " << side.width * unit.front() * 1e3
         << " mm wide at (" << p.x() << ", " << p.y() << ") mm; it must be at least " << narrowest_m * 1e3
         << " mm (1e-6 of the part's diagonal): fewer layers, or a larger layer_factor or layer_width";
    throw core::InputError(text.str());
  }
}

void fit_corners(std::vector<BorderSide>& sides, const BorderGraph& graph, const PrismMeshOptions& options,
                 double narrowest_m) {
  const auto unit = layer_distances(options.layers, options.layer_factor);
  if (unit.empty()) return;
  // Narrowing at one corner changes the feet at the next, so that a few passes are needed.
  for (int pass = 0; pass < 3; ++pass) {
    for (auto& side : sides) fit_corner(sides, graph, side, unit.back());
  }
  for (auto& side : sides) {
    if (side.width * unit.front() < narrowest_m) side.width = 0.0;
  }
}

}  // namespace thinwall::mesh
