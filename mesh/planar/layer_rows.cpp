#include "mesh/planar/layer_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/planar/edge_layers.hpp"

namespace thinwall::mesh {

namespace {

/// Data that the steps below share.
struct Layout {
  const Prism& prism;
  const BorderGraph& graph;  ///< in pieces
  std::vector<BorderSide> sides;
  std::vector<double> unit;  ///< distances of the rows for a layer of width one
  double tolerance = 0.0;    ///< points nearer than this are one, m
};

const BorderSide& side_at(const Layout& layout, int index) {
  return layout.sides[static_cast<std::size_t>(index)];
}

const Eigen::Vector2d& point(const Layout& layout, int index) {
  return layout.graph.points[static_cast<std::size_t>(index)];
}

/// A place along a side, measured from its start, where a row may have a point. It may lie before the start or beyond
/// the end, at corners that the rows run past.
struct Station {
  double s = 0.0;
  double width = 0.0;      ///< width of the outermost layer here, m
  Eigen::Vector2d offset;  ///< from the border to a row at distance one
};

/// Feet of the rows at one end of a side, measured from that end; negative beyond it. Empty at a smooth end, and if the
/// other border of the corner has no layers, because the rows then end on that border.
std::vector<double> feet(const Layout& layout, const BorderSide& side, bool at_end) {
  const BorderSide& corner = at_end ? side : side_at(layout, side.previous);
  const BorderSide& other = side_at(layout, at_end ? side.next : side.previous);
  std::vector<double> result;
  if (smooth(corner) || other.width == 0.0) return result;
  for (const double distance : layout.unit)
    result.push_back(corner_foot(corner.angle, distance * side.width, distance * other.width));
  return result;
}

/// True if the corner at an end of the side is re-entrant.
bool reentrant(const Layout& layout, const BorderSide& side, bool at_end) {
  return (at_end ? side : side_at(layout, side.previous)).angle > std::numbers::pi;
}

/// The places where the border of a side gets points besides its ends: the feet on it. At a re-entrant corner, whose
/// feet lie beyond the end, points at the same distances inside grade the border towards the corner.
std::vector<double> foot_stations(const Layout& layout, const BorderSide& side) {
  const double span = length(layout.graph, side);
  std::vector<double> result;
  for (const bool at_end : {false, true}) {
    for (const double foot : feet(layout, side, at_end)) {
      if (foot < 0.0 && !reentrant(layout, side, at_end)) continue;
      const double s = std::abs(foot);
      if (s > layout.tolerance && s < 0.45 * span) result.push_back(at_end ? span - s : s);
    }
  }
  return result;
}

/// The stations on each border for both its sides, ascending from its `from`. Stations of the two sides that nearly
/// coincide become one.
std::vector<std::vector<double>> border_stations(const Layout& layout) {
  std::vector<std::vector<double>> result(layout.graph.borders.size());
  for (const auto& side : layout.sides) {
    const auto index = static_cast<std::size_t>(side.border);
    const double span = length(layout.graph, side);
    const bool forward = side.from == layout.graph.borders[index].from;
    const double narrowest = side.width > 0.0 ? 0.25 * side.width * layout.unit.front() : layout.tolerance;
    for (const double station : foot_stations(layout, side)) {
      const double s = forward ? station : span - station;
      const bool known = std::any_of(result[index].begin(), result[index].end(),
                                     [&](double other) { return std::abs(other - s) < narrowest; });
      if (!known) result[index].push_back(s);
    }
  }
  for (auto& stations : result) std::sort(stations.begin(), stations.end());
  return result;
}

/// The station at a smooth end, on the bisector of the two sides, as wide as the narrower of their layers; the offset
/// has length one in the direction across each of them.
Station joint(const Layout& layout, const BorderSide& side, bool at_end) {
  const BorderSide& other = side_at(layout, at_end ? side.next : side.previous);
  const Eigen::Vector2d a = inward(layout.graph, side);
  const Eigen::Vector2d b = inward(layout.graph, other);
  return {at_end ? length(layout.graph, side) : 0.0, std::min(side.width, other.width), (a + b) / (1.0 + a.dot(b))};
}

/// Width of the outermost layer at s: the side's own width at its corners, decreasing linearly towards a smooth end
/// whose neighbour has narrower layers.
double width_at(const Layout& layout, const BorderSide& side, double s) {
  const double span = length(layout.graph, side);
  const auto end_width = [&](bool at_end) {
    const bool curve = smooth(at_end ? side : side_at(layout, side.previous));
    return curve ? joint(layout, side, at_end).width : side.width;
  };
  const double t = std::clamp(s / span, 0.0, 1.0);
  for (const bool at_end : {false, true}) {
    const auto own = feet(layout, side, at_end);
    const double near = own.empty() ? 0.0 : std::abs(own.back());
    if (!own.empty() && (at_end ? span - s : s) <= near + layout.tolerance) return side.width;
  }
  return (1.0 - t) * end_width(false) + t * end_width(true);
}

/// The station at a corner: straight inwards, or along the other border if that has no layers.
Station corner_station(const Layout& layout, const BorderSide& side, bool at_end) {
  const double angle = (at_end ? side : side_at(layout, side.previous)).angle;
  const BorderSide& other = side_at(layout, at_end ? side.next : side.previous);
  Station station{at_end ? length(layout.graph, side) : 0.0, side.width, inward(layout.graph, side)};
  if (other.width > 0.0 || angle > 0.95 * std::numbers::pi || angle < 0.05 * std::numbers::pi) return station;
  station.offset = (at_end ? 1.0 : -1.0) * direction(layout.graph, other) / std::sin(angle);
  return station;
}

/// All stations of a side, ascending: its ends, those on the border, and those beyond re-entrant corners.
std::vector<Station> row_stations(const Layout& layout, const BorderSide& side, std::vector<double> on_border) {
  const double span = length(layout.graph, side);
  const Eigen::Vector2d inside = inward(layout.graph, side);
  std::vector<Station> stations;
  for (const bool at_end : {false, true}) {
    if (smooth(at_end ? side : side_at(layout, side.previous))) {
      stations.push_back(joint(layout, side, at_end));
    } else {
      stations.push_back(corner_station(layout, side, at_end));
      for (const double foot : feet(layout, side, at_end)) {
        if (foot < -layout.tolerance) on_border.push_back(at_end ? span - foot : foot);
      }
    }
  }
  for (const double s : on_border) stations.push_back({s, width_at(layout, side, s), inside});
  std::sort(stations.begin(), stations.end(), [](const Station& a, const Station& b) { return a.s < b.s; });
  return stations;
}

/// True if row j of the side exists at s, which is not the case beyond the mitres at the side's corners.
bool row_reaches(const Layout& layout, const BorderSide& side, std::size_t row, double s) {
  const double slack = 1e-6 * side.width * layout.unit.front() + layout.tolerance;
  for (const bool at_end : {false, true}) {
    const auto own = feet(layout, side, at_end);
    if (!own.empty() && (at_end ? length(layout.graph, side) - s : s) < own[row] - slack) return false;
  }
  return true;
}

/// True if a point of row `row` (from 0) at distance c from its own border lies in the same material and keeps away
/// from all other borders: by at least half of c, or of the distance of that border's own row if that is smaller.
bool keeps_away(const Layout& layout, const BorderSide& own, const Eigen::Vector2d& p, std::size_t row, double c) {
  const auto extent = extent_at(layout.prism, p);
  if (!extent || !(*extent == own.extent)) return false;
  return std::all_of(layout.sides.begin(), layout.sides.end(), [&](const BorderSide& side) {
    if (side.border == own.border) return true;
    const double theirs = side.width > 0.0 ? std::min(c, layout.unit[row] * side.width) : 0.4 * c;
    const Segment line{point(layout, side.from), point(layout, side.to)};
    return cross(line[1] - line[0], p - line[0]) < 0.0 || distance(line, p) >= 0.5 * theirs;
  });
}

/// The point of the sketch at p within the tolerance, or −1.
int find_point(const Sketch& sketch, const Eigen::Vector2d& p, double tolerance) {
  for (std::size_t i = 0; i < sketch.points.size(); ++i) {
    if ((sketch.points[i] - p).norm() <= tolerance) return static_cast<int>(i);
  }
  return -1;
}

/// True if the segment between points a and b touches no other point or segment of the sketch.
bool free_segment(const Sketch& sketch, int a, int b, double tolerance) {
  const auto at = [&](int i) { return sketch.points[static_cast<std::size_t>(i)]; };
  const Segment line{at(a), at(b)};
  for (std::size_t i = 0; i < sketch.points.size(); ++i) {
    const int index = static_cast<int>(i);
    if (index != a && index != b && distance(line, sketch.points[i]) <= tolerance) return false;
  }
  return std::all_of(sketch.segments.begin(), sketch.segments.end(), [&](const auto& other) {
    const bool same = (other[0] == a && other[1] == b) || (other[0] == b && other[1] == a);
    return !same && !crossing(line, {at(other[0]), at(other[1])});
  });
}

/// Adds the segment between two points (−1: none) if it is free.
void add_segment(Sketch& sketch, int a, int b, double tolerance) {
  if (a >= 0 && b >= 0 && a != b && free_segment(sketch, a, b, tolerance)) sketch.segments.push_back({a, b});
}

/// The sketch of the borders, cut at their stations.
Sketch border_sketch(const Layout& layout, const std::vector<std::vector<double>>& stations) {
  Sketch sketch;
  sketch.points = layout.graph.points;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const Border& border = layout.graph.borders[i];
    const auto [a, b] = segment(layout.graph, border);
    const double span = (b - a).norm();
    int from = border.from;
    for (const double s : stations[i]) {
      const int to = static_cast<int>(sketch.points.size());
      sketch.points.emplace_back((1.0 - s / span) * a + s / span * b);
      sketch.segments.push_back({from, to});
      from = to;
    }
    sketch.segments.push_back({from, border.to});
  }
  sketch.borders = sketch.segments.size();
  return sketch;
}

/// The sketch's point for row j at a station, which is added if need be; −1 if the row has no point there.
int row_point(const Layout& layout, const BorderSide& side, const Station& station, std::size_t row, Sketch& sketch) {
  const double c = station.width * layout.unit[row];
  if (c <= 0.0 || !row_reaches(layout, side, row, station.s)) return -1;
  const Eigen::Vector2d base = point(layout, side.from) + station.s * direction(layout.graph, side);
  const Eigen::Vector2d p = base + c * station.offset;
  const int known = find_point(sketch, p, layout.tolerance);
  if (known >= 0) return known;
  const double band = station.width * (layout.unit[row] - (row > 0 ? layout.unit[row - 1] : 0.0));
  if (!keeps_away(layout, side, p, row, c)) return -1;
  if (point_distance(sketch, p) < 0.3 * band || segment_distance(sketch, p) < 0.1 * band) return -1;
  sketch.points.push_back(p);
  return static_cast<int>(sketch.points.size()) - 1;
}

/// Adds the points of all rows of a side, and the segments between successive points.
void add_rows(const Layout& layout, const BorderSide& side, const std::vector<double>& on_border, Sketch& sketch) {
  const auto stations = row_stations(layout, side, on_border);
  for (std::size_t row = 0; row < layout.unit.size(); ++row) {
    int previous = -1;
    for (const auto& station : stations) {
      const int current = row_point(layout, side, station, row, sketch);
      add_segment(sketch, previous, current, layout.tolerance);
      previous = current;
    }
  }
}

/// Adds a segment from each convex corner to its innermost mitre, so that no triangle contains both borders of a
/// corner.
void add_mitres(const Layout& layout, Sketch& sketch) {
  for (const auto& side : layout.sides) {
    const auto own = feet(layout, side, true);
    if (side.angle >= std::numbers::pi || side.width == 0.0 || own.empty()) continue;
    const Eigen::Vector2d p = point(layout, side.to) - own.front() * direction(layout.graph, side) +
                              side.width * layout.unit.front() * inward(layout.graph, side);
    add_segment(sketch, side.to, find_point(sketch, p, layout.tolerance), layout.tolerance);
  }
}

}  // namespace

double point_distance(const Sketch& sketch, const Eigen::Vector2d& p) {
  double least = INFINITY;
  for (const auto& q : sketch.points) least = std::min(least, (q - p).squaredNorm());
  return std::sqrt(least);
}

double segment_distance(const Sketch& sketch, const Eigen::Vector2d& p) {
  double least = INFINITY;
  for (const auto& [a, b] : sketch.segments) {
    const Segment line{sketch.points[static_cast<std::size_t>(a)], sketch.points[static_cast<std::size_t>(b)]};
    least = std::min(least, distance(line, p));
  }
  return least;
}

Sketch layer_rows(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options) {
  const BorderGraph pieces = divided(graph, [&](const Eigen::Vector2d& p) { return wanted_size(options, p); });
  const double size = diagonal(prism);
  Layout layout{prism, pieces, border_sides(pieces), layer_distances(options.layers, options.layer_factor),
                1e-9 * size};
  set_layer_widths(layout.sides, pieces, options, 1e-6 * size);
  fit_corners(layout.sides, pieces, options, 1e-6 * size);
  const auto stations = border_stations(layout);
  Sketch sketch = border_sketch(layout, stations);
  for (const auto& side : layout.sides) {
    if (side.width == 0.0) continue;
    const auto index = static_cast<std::size_t>(side.border);
    auto on_border = stations[index];
    if (side.from != pieces.borders[index].from) {
      for (auto& s : on_border) s = length(pieces, side) - s;
    }
    add_rows(layout, side, on_border, sketch);
  }
  add_mitres(layout, sketch);
  return sketch;
}

}  // namespace thinwall::mesh
