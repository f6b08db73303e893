#include "mesh/planar/border_graph.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

namespace thinwall::mesh {

namespace {

using Points = std::vector<Eigen::Vector2d>;
using Pairs = std::set<std::pair<int, int>>;

const Eigen::Vector2d& at(const Points& points, int index) {
  return points[static_cast<std::size_t>(index)];
}

/// The edges of the outline, of all holes and of all zones.
std::vector<Segment> all_edges(const Prism& prism) {
  std::vector<Segment> edges;
  const auto take = [&](const Polygon& polygon) {
    for (std::size_t i = 0; i < polygon.size(); ++i) edges.push_back(edge(polygon, i));
  };
  take(prism.outline);
  for (const auto& hole : prism.holes) take(hole);
  for (const auto& zone : prism.zones) take(zone.outline);
  return edges;
}

/// Adds p unless a point within the tolerance is there already.
void add_point(Points& points, const Eigen::Vector2d& p, double tolerance) {
  const bool known =
      std::any_of(points.begin(), points.end(), [&](const auto& q) { return (q - p).norm() <= tolerance; });
  if (!known) points.push_back(p);
}

/// The ends and crossings of all edges, each once.
Points graph_points(const std::vector<Segment>& edges, double tolerance) {
  Points points;
  for (const auto& line : edges) {
    for (const auto& end : line) add_point(points, end, tolerance);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (const auto p = crossing(edges[i], edges[j])) add_point(points, *p, tolerance);
    }
  }
  return points;
}

/// The edges cut at every point that lies on them, each piece once. Points are found by their distance, so that edges
/// that run on one line, or cross within round-off only, are cut too.
Pairs split_edges(const std::vector<Segment>& edges, const Points& points, double tolerance) {
  Pairs pairs;
  for (const auto& line : edges) {
    const Eigen::Vector2d along = line[1] - line[0];
    std::vector<int> order;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (distance(line, points[i]) <= tolerance) order.push_back(static_cast<int>(i));
    }
    std::sort(order.begin(), order.end(),
              [&](int a, int b) { return along.dot(at(points, a)) < along.dot(at(points, b)); });
    for (std::size_t k = 0; k + 1 < order.size(); ++k) pairs.insert(std::minmax(order[k], order[k + 1]));
  }
  return pairs;
}

Eigen::Vector2d left_normal(const Eigen::Vector2d& along) {
  return Eigen::Vector2d(-along.y(), along.x()).normalized();
}

/// The border from a to b. The extents beside it are looked up at its middle, at a distance smaller than that of any
/// other border.
Border border_between(const Prism& prism, const Points& points, std::pair<int, int> ends) {
  const Eigen::Vector2d a = at(points, ends.first);
  const Eigen::Vector2d b = at(points, ends.second);
  const Eigen::Vector2d step = 1e-7 * diagonal(prism) * left_normal(b - a);
  const Eigen::Vector2d middle = 0.5 * (a + b);
  return {ends.first, ends.second, extent_at(prism, middle + step), extent_at(prism, middle - step)};
}

/// Removes every point where only one straight run passes. A run counts as straight if its deviation is round-off, so
/// that the part's volume does not change.
void join_straight_runs(Pairs& pairs, const Points& points) {
  std::vector<std::set<int>> neighbours(points.size());
  for (const auto& [a, b] : pairs) {
    neighbours[static_cast<std::size_t>(a)].insert(b);
    neighbours[static_cast<std::size_t>(b)].insert(a);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (neighbours[i].size() != 2) continue;
    const int a = *neighbours[i].begin();
    const int b = *neighbours[i].rbegin();
    const double length = (at(points, b) - at(points, a)).norm();
    if (distance(Segment{at(points, a), at(points, b)}, points[i]) > 1e-14 * length) continue;
    const int middle = static_cast<int>(i);
    pairs.erase(std::minmax(a, middle));
    pairs.erase(std::minmax(b, middle));
    pairs.insert(std::minmax(a, b));
    for (const auto& [end, other] : {std::pair{a, b}, std::pair{b, a}}) {
      neighbours[static_cast<std::size_t>(end)].erase(middle);
      neighbours[static_cast<std::size_t>(end)].insert(other);
    }
    neighbours[i].clear();
  }
}

/// The graph of the borders with the points that they use, renumbered in the same order.
BorderGraph compacted(const Points& points, std::vector<Border> borders) {
  std::vector<int> number(points.size(), -1);
  for (const auto& border : borders) {
    for (const int end : {border.from, border.to}) number[static_cast<std::size_t>(end)] = 0;
  }
  BorderGraph graph;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (number[i] < 0) continue;
    number[i] = static_cast<int>(graph.points.size());
    graph.points.push_back(points[i]);
  }
  for (auto& border : borders) {
    border.from = number[static_cast<std::size_t>(border.from)];
    border.to = number[static_cast<std::size_t>(border.to)];
  }
  graph.borders = std::move(borders);
  return graph;
}

/// The y coordinate of a line at x.
double height_at(const Segment& line, double x) {
  const double t = (x - line[0].x()) / (line[1].x() - line[0].x());
  return (1.0 - t) * line[0].y() + t * line[1].y();
}

}  // namespace

Segment segment(const BorderGraph& graph, const Border& border) {
  return {at(graph.points, border.from), at(graph.points, border.to)};
}

BorderGraph border_graph(const Prism& prism) {
  const auto edges = all_edges(prism);
  const double tolerance = 1e-9 * diagonal(prism);
  const Points points = graph_points(edges, tolerance);
  Pairs pairs = split_edges(edges, points, tolerance);
  std::erase_if(pairs, [&](const auto& pair) {
    const Border border = border_between(prism, points, pair);
    return border.left == border.right;
  });
  join_straight_runs(pairs, points);
  std::vector<Border> borders;
  for (const auto& pair : pairs) borders.push_back(border_between(prism, points, pair));
  return compacted(points, std::move(borders));
}

std::vector<double> divide(double length, const std::function<double(double)>& size_at) {
  constexpr int samples = 256;
  std::vector<double> integral(samples + 1, 0.0);
  for (std::size_t k = 0; k < samples; ++k)
    integral[k + 1] = integral[k] + length / samples / size_at((static_cast<double>(k) + 0.5) / samples);
  const int pieces = std::max(1, static_cast<int>(std::ceil(integral.back() - 1e-6)));
  std::vector<double> cuts{0.0};
  for (int piece = 1; piece < pieces; ++piece) {
    const double wanted = integral.back() * piece / pieces;
    const auto upper = std::upper_bound(integral.begin(), integral.end(), wanted);
    const auto k = static_cast<std::size_t>(upper - integral.begin()) - 1;
    cuts.push_back((static_cast<double>(k) + (wanted - integral[k]) / (integral[k + 1] - integral[k])) / samples);
  }
  cuts.push_back(1.0);
  return cuts;
}

BorderGraph divided(const BorderGraph& graph, const std::function<double(const Eigen::Vector2d&)>& size_at) {
  BorderGraph result;
  result.points = graph.points;
  for (const auto& border : graph.borders) {
    const auto [a, b] = segment(graph, border);
    const auto point = [&, start = a, end = b](double t) { return Eigen::Vector2d(start + t * (end - start)); };
    const auto cuts = divide((b - a).norm(), [&](double t) { return size_at(point(t)); });
    int from = border.from;
    for (std::size_t k = 1; k < cuts.size(); ++k) {
      int to = border.to;
      if (k + 1 < cuts.size()) {
        to = static_cast<int>(result.points.size());
        result.points.push_back(point(cuts[k]));
      }
      result.borders.push_back({from, to, border.left, border.right});
      from = to;
    }
  }
  return result;
}

std::vector<Trapezoid> trapezoids(const Prism& prism, const BorderGraph& graph) {
  std::set<double> stations;
  for (const auto& p : graph.points) stations.insert(p.x());
  std::vector<Trapezoid> cells;
  for (auto right = stations.begin(); right != stations.end(); ++right) {
    if (right == stations.begin()) continue;
    const double x0 = *std::prev(right);
    const double x1 = *right;
    const double middle = 0.5 * (x0 + x1);
    std::vector<Segment> lines;
    for (const auto& border : graph.borders) {
      const Segment line = segment(graph, border);
      if (std::min(line[0].x(), line[1].x()) <= x0 && std::max(line[0].x(), line[1].x()) >= x1) lines.push_back(line);
    }
    std::sort(lines.begin(), lines.end(),
              [&](const Segment& a, const Segment& b) { return height_at(a, middle) < height_at(b, middle); });
    for (std::size_t k = 0; k + 1 < lines.size(); ++k) {
      const double y = 0.5 * (height_at(lines[k], middle) + height_at(lines[k + 1], middle));
      const auto extent = extent_at(prism, {middle, y});
      if (!extent) continue;
      cells.push_back({{x0, x1},
                       {height_at(lines[k], x0), height_at(lines[k], x1)},
                       {height_at(lines[k + 1], x0), height_at(lines[k + 1], x1)},
                       *extent});
    }
  }
  return cells;
}

}  // namespace thinwall::mesh
