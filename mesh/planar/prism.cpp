#include "mesh/planar/prism.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

#include "core/error.hpp"
#include "mesh/planar/border_graph.hpp"

namespace thinwall::mesh {

namespace {

using Findings = std::vector<std::string>;

std::string in_mm(double length) {
  std::ostringstream text;
  text << length * 1e3 << " mm";
  return text.str();
}

std::string in_mm(const Eigen::Vector2d& p) {
  std::ostringstream text;
  text << '(' << p.x() * 1e3 << ", " << p.y() * 1e3 << ") mm";
  return text.str();
}

std::string named(const std::string& kind, std::size_t index) {
  return kind + " " + std::to_string(index + 1);
}

bool finite(const Polygon& polygon) {
  return std::all_of(polygon.begin(), polygon.end(), [](const auto& p) { return p.allFinite(); });
}

/// True if edges i and j of one polygon meet where they should not. Neighbours share their corner and nothing else;
/// other edges share nothing.
bool meet(const Polygon& polygon, std::size_t i, std::size_t j, double gap) {
  const std::size_t n = polygon.size();
  const Segment a = edge(polygon, i);
  const Segment b = edge(polygon, j);
  if (j == i + 1 && n > 2) return distance(a, b[1]) <= gap || distance(b, a[0]) <= gap;
  if (i == 0 && j == n - 1) return distance(a, b[0]) <= gap || distance(b, a[1]) <= gap;
  return distance(a, b) <= gap;
}

bool on_one_line(const Polygon& polygon, double gap) {
  const auto far = *std::max_element(polygon.begin(), polygon.end(), [&](const auto& a, const auto& b) {
    return (a - polygon[0]).squaredNorm() < (b - polygon[0]).squaredNorm();
  });
  const Eigen::Vector2d along = (far - polygon[0]).normalized();
  return std::all_of(polygon.begin(), polygon.end(),
                     [&](const auto& p) { return std::abs(cross(along, p - polygon[0])) <= gap; });
}

/// The first fault of a polygon by itself, or "".
std::string polygon_fault(const Polygon& polygon, const std::string& name, double gap) {
  if (polygon.size() < 3)
    return name + " has " + std::to_string(polygon.size()) + " points; a polygon needs at least 3";
  if (!finite(polygon)) return name + " has a coordinate that is not a finite number; give lengths";
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto [a, b] = edge(polygon, i);
    if ((b - a).norm() > gap) continue;
    return name + " repeats the point " + in_mm(a) + " (nearer than " + in_mm(gap) +
           "); name each point once, the last is joined to the first";
  }
  if (on_one_line(polygon, gap))
    return name + " has no area: its points lie on one line through " + in_mm(polygon[0]) + "; give it a width";
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    for (std::size_t j = i + 1; j < polygon.size(); ++j) {
      if (!meet(polygon, i, j, gap)) continue;
      const auto p = crossing(edge(polygon, i), edge(polygon, j)).value_or(polygon[j]);
      return name + " crosses or touches itself near " + in_mm(p) + " (edges " + std::to_string(i + 1) + " and " +
             std::to_string(j + 1) + " come within " + in_mm(gap) + "); order its points around the border";
    }
  }
  return "";
}

std::string thickness_fault(double bottom, double top, const std::string& name, double gap) {
  if (std::isfinite(bottom) && std::isfinite(top) && top - bottom > gap) return "";
  return name + " has thickness " + in_mm(top - bottom) + " (bottom " + in_mm(bottom) + ", top " + in_mm(top) +
         "); it must be above " + in_mm(gap);
}

double border_distance(const Polygon& a, const Polygon& b) {
  double least = INFINITY;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) least = std::min(least, distance(edge(a, i), edge(b, j)));
  }
  return least;
}

void check_holes(const Prism& prism, double gap, Findings& found) {
  const std::string remedy = "; leave more than " + in_mm(gap) + " of material";
  for (std::size_t i = 0; i < prism.holes.size(); ++i) {
    const Polygon& hole = prism.holes[i];
    const auto report = [&](const std::string& fault) {
      found.push_back(named("hole", i) + " at " + in_mm(hole[0]) + fault);
    };
    if (border_distance(hole, prism.outline) <= gap) {
      report(" touches or crosses the outline" + remedy);
    } else if (!contains(prism.outline, hole[0])) {
      report(" lies outside the outline; move it inside or drop it");
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Polygon& other = prism.holes[j];
      if (border_distance(hole, other) > gap && !contains(hole, other[0]) && !contains(other, hole[0])) continue;
      report(" touches, crosses or contains " + named("hole", j) + remedy + ", or join them to one hole");
    }
  }
}

/// A point of the line from a to b that lies outside the polygon by more than the tolerance.
std::optional<Eigen::Vector2d> point_outside(const Polygon& polygon, const Segment& line, double tolerance) {
  const Eigen::Vector2d along = line[1] - line[0];
  std::vector<double> cuts{0.0, 1.0};
  const auto cut_at = [&](const Eigen::Vector2d& p) {
    cuts.push_back(std::clamp((p - line[0]).dot(along) / along.squaredNorm(), 0.0, 1.0));
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (const auto p = crossing(line, edge(polygon, i))) cut_at(*p);
    if (distance(line, polygon[i]) <= tolerance) cut_at(polygon[i]);
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const Eigen::Vector2d middle = line[0] + 0.5 * (cuts[k] + cuts[k + 1]) * along;
    if (contains(polygon, middle)) continue;
    double nearest = INFINITY;
    for (std::size_t i = 0; i < polygon.size(); ++i) nearest = std::min(nearest, distance(edge(polygon, i), middle));
    if (nearest > tolerance) return middle;
  }
  return std::nullopt;
}

void check_zones(const Prism& prism, double tolerance, Findings& found) {
  for (std::size_t z = 0; z < prism.zones.size(); ++z) {
    const Polygon& zone = prism.zones[z].outline;
    for (std::size_t i = 0; i < zone.size(); ++i) {
      const auto p = point_outside(prism.outline, edge(zone, i), tolerance);
      if (!p) continue;
      found.push_back(named("zone", z) + " reaches outside the outline at " + in_mm(*p) +
                      "; end it on the outline or widen the outline");
      break;
    }
  }
}

/// Notes borders that nearly touch. Borders of different polygons may share a line or be apart, but elements in a very
/// narrow gap between them would be flatter than double precision allows.
void check_gaps(const BorderGraph& graph, double gap, Findings& found) {
  for (const auto& border : graph.borders) {
    for (std::size_t i = 0; i < graph.points.size(); ++i) {
      const bool own = static_cast<int>(i) == border.from || static_cast<int>(i) == border.to;
      const auto [a, b] = segment(graph, border);
      const double apart = own ? (b - a).norm() : distance({a, b}, graph.points[i]);
      if (apart > gap) continue;
      found.push_back("borders come within " + in_mm(apart) + " of each other at " + in_mm(graph.points[i]) +
                      "; let them coincide, or keep them " + in_mm(gap) + " apart (1e-6 of the part's diagonal)");
      return;
    }
  }
}

int root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) i = parent[static_cast<std::size_t>(i)];
  return i;
}

double overlap(double a_low, double a_high, double b_low, double b_high) {
  return std::min(a_high, b_high) - std::max(a_low, b_low);
}

/// True if the slabs above two cells share a face, that is a piece of border and a piece of height.
bool joined(const Trapezoid& a, const Trapezoid& b, double gap) {
  if (overlap(a.extent.bottom, a.extent.top, b.extent.bottom, b.extent.top) <= gap) return false;
  if (a.x[1] == b.x[0]) return overlap(a.low[1], a.high[1], b.low[0], b.high[0]) > gap;
  return a.x == b.x && (a.high == b.low || b.high == a.low);
}

void check_pieces(const Prism& prism, const BorderGraph& graph, double gap, Findings& found) {
  const auto cells = trapezoids(prism, graph);
  std::vector<int> parent(cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = i + 1; j < cells.size() && cells[j].x[0] <= cells[i].x[1]; ++j) {
      if (!joined(cells[i], cells[j], gap)) continue;
      parent[static_cast<std::size_t>(root(parent, static_cast<int>(i)))] = root(parent, static_cast<int>(j));
    }
  }
  for (std::size_t i = 1; i < cells.size(); ++i) {
    if (root(parent, static_cast<int>(i)) == root(parent, 0)) continue;
    const auto where = [](const Trapezoid& cell) {
      return in_mm(Eigen::Vector2d(0.5 * (cell.x[0] + cell.x[1]),
                                   0.25 * (cell.low[0] + cell.low[1] + cell.high[0] + cell.high[1]))) +
             " (z from " + in_mm(cell.extent.bottom) + " to " + in_mm(cell.extent.top) + ")";
    };
    found.push_back("the part falls apart: the regions at " + where(cells[0]) + " and " + where(cells[i]) +
                    " are not joined; let neighbouring regions share more than " + in_mm(gap) + " of height");
    return;
  }
}

/// Sets every coordinate to the least one of those from which it differs by no more than the tolerance.
void merge_close(std::vector<double*> values, double tolerance) {
  std::sort(values.begin(), values.end(), [](const double* a, const double* b) { return *a < *b; });
  double representative = -INFINITY;
  for (double* value : values) {
    if (*value - representative > tolerance) representative = *value;
    *value = representative;
  }
}

}  // namespace

double diagonal(const Prism& prism) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY);
  Eigen::Vector3d high = -low;
  const auto take = [&](const Polygon& polygon, double bottom, double top) {
    for (const auto& p : polygon) {
      low = low.cwiseMin(Eigen::Vector3d(p.x(), p.y(), bottom));
      high = high.cwiseMax(Eigen::Vector3d(p.x(), p.y(), top));
    }
  };
  take(prism.outline, prism.bottom, prism.top);
  for (const auto& zone : prism.zones) take(zone.outline, zone.bottom, zone.top);
  const double length = (high - low).norm();
  return std::isfinite(length) ? length : 0.0;
}

std::optional<Extent> extent_at(const Prism& prism, const Eigen::Vector2d& p) {
  if (!contains(prism.outline, p)) return std::nullopt;
  for (const auto& hole : prism.holes) {
    if (contains(hole, p)) return std::nullopt;
  }
  for (auto zone = prism.zones.rbegin(); zone != prism.zones.rend(); ++zone) {
    if (contains(zone->outline, p)) return Extent{zone->bottom, zone->top};
  }
  return Extent{prism.bottom, prism.top};
}

Prism cleaned(const Prism& prism) {
  Prism result = prism;
  std::array<std::vector<double*>, 3> axes;
  const auto take = [&](Polygon& polygon) {
    for (auto& p : polygon) {
      axes[0].push_back(&p.x());
      axes[1].push_back(&p.y());
    }
  };
  take(result.outline);
  for (auto& hole : result.holes) take(hole);
  axes[2] = {&result.bottom, &result.top};
  for (auto& zone : result.zones) {
    take(zone.outline);
    axes[2].insert(axes[2].end(), {&zone.bottom, &zone.top});
  }
  const double tolerance = 1e-9 * diagonal(prism);
  for (auto& values : axes) merge_close(std::move(values), tolerance);
  return result;
}

std::vector<std::string> violations(const Prism& prism) {
  Findings found;
  const double gap = 1e-6 * diagonal(prism);
  const auto check = [&](const std::string& fault) {
    if (!fault.empty()) found.push_back(fault);
  };
  check(polygon_fault(prism.outline, "the outline", gap));
  for (std::size_t i = 0; i < prism.holes.size(); ++i) check(polygon_fault(prism.holes[i], named("hole", i), gap));
  for (std::size_t i = 0; i < prism.zones.size(); ++i)
    check(polygon_fault(prism.zones[i].outline, named("zone", i), gap));
  check(thickness_fault(prism.bottom, prism.top, "the part", gap));
  for (std::size_t i = 0; i < prism.zones.size(); ++i)
    check(thickness_fault(prism.zones[i].bottom, prism.zones[i].top, named("zone", i), gap));
  if (!found.empty()) return found;
  check_holes(prism, gap, found);
  check_zones(prism, 1e-3 * gap, found);
  if (!found.empty()) return found;
  const Prism clean = cleaned(prism);
  const BorderGraph graph = border_graph(clean);
  check_gaps(graph, gap, found);
  if (found.empty()) check_pieces(clean, graph, gap, found);
  return found;
}

void validate(const Prism& prism) {
  std::string all;
  for (const auto& violation : violations(prism)) all += (all.empty() ? "" : "; ") + violation;
  if (!all.empty()) throw core::InputError(all);
}

bool has_reentrant_edge(const Prism& given) {
  const Prism prism = cleaned(given);
  const Extent part{prism.bottom, prism.top};
  const auto other_height = [&](const Zone& zone) { return Extent{zone.bottom, zone.top} != part; };
  if (std::any_of(prism.zones.begin(), prism.zones.end(), other_height)) return true;
  // `inside` 1: the material lies inside of the polygon; −1: outside.
  const auto turns_inwards = [](const Polygon& polygon, double inside) {
    const double side = signed_area(polygon) > 0.0 ? inside : -inside;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Segment in = edge(polygon, i);
      const Segment out = edge(polygon, (i + 1) % polygon.size());
      const Eigen::Vector2d a = in[1] - in[0];
      const Eigen::Vector2d b = out[1] - out[0];
      if (side * std::atan2(cross(a, b), a.dot(b)) < -(1.0 + 1e-6) * std::numbers::pi / 6.0) return true;
    }
    return false;
  };
  if (turns_inwards(prism.outline, 1.0)) return true;
  return std::any_of(prism.holes.begin(), prism.holes.end(),
                     [&](const Polygon& hole) { return turns_inwards(hole, -1.0); });
}

double volume(const Prism& prism) {
  const Prism clean = cleaned(prism);
  double sum = 0.0;
  for (const auto& cell : trapezoids(clean, border_graph(clean))) {
    const double mean = 0.5 * (cell.high[0] - cell.low[0] + cell.high[1] - cell.low[1]);
    sum += (cell.x[1] - cell.x[0]) * mean * (cell.extent.top - cell.extent.bottom);
  }
  return sum;
}

}  // namespace thinwall::mesh
