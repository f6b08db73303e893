#include "mesh/surface/plane_overlay.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/interrupt.hpp"

namespace thinwall::mesh {

using Eigen::Vector2d;

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_tag>;

constexpr double clear_of_borders = 0.3;  // of the usual edge: distance of interior points from borders

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A border edge of a face with the places at which it is cut.
struct Segment {
  std::size_t face = 0;
  std::array<int, 2> vertices{};
  int from = 0, to = 0;                        // points
  std::vector<std::pair<double, int>> cuts{};  // parameter and point
};

/// The overlay while it is made.
struct Drawing {
  const PlaneSides& sides;
  Overlay overlay{};
  std::vector<Segment> segments{};

  [[nodiscard]] const Vector2d& point(int i) const { return overlay.points[static_cast<std::size_t>(i)]; }

  /// The number of the point at p, which is added if there is none within the tolerance.
  int number(const Vector2d& p) {
    auto& points = overlay.points;
    for (std::size_t i = 0; i < points.size(); ++i)
      if ((points[i] - p).norm() <= sides.tolerance) return static_cast<int>(i);
    points.push_back(p);
    return static_cast<int>(points.size()) - 1;
  }
};

/// Adds the borders' vertices and edges.
void add_borders(Drawing& s) {
  s.overlay.faces.resize(s.sides.faces.size());
  for (std::size_t f = 0; f < s.sides.faces.size(); ++f) {
    OverlaidFace& face = s.overlay.faces[f];
    for (const auto& edge : s.sides.faces[f].border) {
      for (const int v : edge) {
        if (face.point_of_vertex.contains(v)) continue;
        const int p = s.number(s.sides.faces[f].place.at(v));
        face.point_of_vertex[v] = p;
        face.vertex_of_point[p] = v;
      }
      s.segments.push_back({f, edge, face.point_of_vertex.at(edge[0]), face.point_of_vertex.at(edge[1])});
    }
  }
}

/// The parameter of the foot of p on a segment, and the distance from it.
std::pair<double, double> foot(const Vector2d& a, const Vector2d& b, const Vector2d& p) {
  const double s = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return {s, (a + s * (b - a) - p).norm()};
}

/// Cuts two segments where they cross away from their ends.
void cross_segments(Drawing& s, Segment& one, Segment& two) {
  const Vector2d a = s.point(one.from), u = s.point(one.to) - a;
  const Vector2d b = s.point(two.from), v = s.point(two.to) - b;
  const double determinant = cross(u, v);
  if (std::abs(determinant) <= 1e-9 * u.norm() * v.norm()) return;
  const double p = cross(b - a, v) / determinant, q = cross(b - a, u) / determinant;
  const double margin_p = s.sides.tolerance / u.norm(), margin_q = s.sides.tolerance / v.norm();
  if (p <= margin_p || p >= 1.0 - margin_p || q <= margin_q || q >= 1.0 - margin_q) return;
  const int point = s.number(a + p * u);
  one.cuts.emplace_back(p, point);
  two.cuts.emplace_back(q, point);
}

/// Cuts the segments at each other and at points that lie on them.
void cut_segments(Drawing& s) {
  for (std::size_t i = 0; i < s.segments.size(); ++i) {
    core::check_interrupt();
    for (std::size_t j = 0; j < i; ++j)
      if (s.segments[i].face != s.segments[j].face) cross_segments(s, s.segments[i], s.segments[j]);
  }
  for (Segment& segment : s.segments) {
    core::check_interrupt();
    for (int p = 0; p < static_cast<int>(s.overlay.points.size()); ++p) {
      if (p == segment.from || p == segment.to) continue;
      const auto [at, distance] = foot(s.point(segment.from), s.point(segment.to), s.point(p));
      if (distance <= s.sides.tolerance) segment.cuts.emplace_back(at, p);
    }
    std::sort(segment.cuts.begin(), segment.cuts.end());
    const auto same = [](const auto& a, const auto& b) { return a.second == b.second; };
    segment.cuts.erase(std::unique(segment.cuts.begin(), segment.cuts.end(), same), segment.cuts.end());
  }
}

/// True if points and segments touch or keep the least gap.
bool keeps_gap(const Drawing& s) {
  const auto& points = s.overlay.points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    core::check_interrupt();
    for (std::size_t j = 0; j < i; ++j)
      if ((points[i] - points[j]).norm() < s.sides.least_gap) return false;
  }
  return std::all_of(s.segments.begin(), s.segments.end(), [&](const Segment& segment) {
    core::check_interrupt();
    return std::all_of(points.begin(), points.end(), [&](const Vector2d& p) {
      const double distance = foot(s.point(segment.from), s.point(segment.to), p).second;
      return distance <= s.sides.tolerance || distance >= s.sides.least_gap;
    });
  });
}

using Edges = std::vector<std::array<Vector2d, 2>>;

/// The border of a face as edges in the plane.
Edges edges_of(const PlaneSide& face) {
  Edges edges;
  edges.reserve(face.border.size());
  for (const auto& [a, b] : face.border) edges.push_back({face.place.at(a), face.place.at(b)});
  return edges;
}

/// True if p is at least this far from all borders.
bool is_clear(const Drawing& s, const Vector2d& p, double distance) {
  return std::all_of(s.segments.begin(), s.segments.end(), [&](const Segment& segment) {
    return foot(s.point(segment.from), s.point(segment.to), p).second >= distance;
  });
}

/// Adds the interior vertices of the upper faces, and of the lower ones where no upper face is, that are clear of all
/// borders.
void add_interior(Drawing& s) {
  std::vector<Edges> upper;
  for (const PlaneSide& face : s.sides.faces)
    if (face.upper) upper.push_back(edges_of(face));
  const auto is_covered = [&](const Vector2d& p) {
    return std::any_of(upper.begin(), upper.end(), [&](const Edges& edges) { return is_within(edges, p); });
  };
  for (const PlaneSide& face : s.sides.faces) {
    std::set<int> on_border;
    for (const auto& edge : face.border) on_border.insert(edge[0]);
    const double clear = std::max(s.sides.least_gap, clear_of_borders * face.edge);
    for (const auto& entry : face.place) {
      core::check_interrupt();
      if (on_border.contains(entry.first) || (!face.upper && is_covered(entry.second))) continue;
      if (is_clear(s, entry.second, clear)) s.overlay.points.push_back(entry.second);
    }
  }
}

using Pair = std::pair<int, int>;

/// The pieces of each face's border between cuts.
std::vector<std::set<Pair>> pieces_of_borders(Drawing& s) {
  std::vector<std::set<Pair>> pieces(s.sides.faces.size());
  for (const Segment& segment : s.segments) {
    int last = segment.from;
    OverlaidFace& face = s.overlay.faces[segment.face];
    for (const auto& [at, point] : segment.cuts) {
      pieces[segment.face].insert(std::minmax(last, point));
      if (!face.vertex_of_point.contains(point)) face.divided[segment.vertices].push_back(point);
      last = point;
    }
    pieces[segment.face].insert(std::minmax(last, segment.to));
  }
  return pieces;
}

/// The triangulation of all points and pieces; a vertex's info is the number of its point.
Delaunay triangulated(const Overlay& overlay, const std::vector<std::set<Pair>>& pieces) {
  Delaunay result;
  std::vector<Delaunay::Vertex_handle> handles;
  for (const Vector2d& p : overlay.points) {
    handles.push_back(result.insert({p.x(), p.y()}));
    handles.back()->info() = static_cast<int>(handles.size()) - 1;
  }
  std::set<Pair> all;  // CGAL takes a constraint that is there already for an intersection
  for (const auto& of_face : pieces) all.insert(of_face.begin(), of_face.end());
  for (const auto& [a, b] : all)
    result.insert_constraint(handles[static_cast<std::size_t>(a)], handles[static_cast<std::size_t>(b)]);
  return result;
}

/// The triangles within a border: those that a way from outside reaches after an odd number of crossings.
std::vector<std::array<int, 3>> within(Delaunay& delaunay, const std::set<Pair>& border) {
  for (const auto face : delaunay.all_face_handles()) face->info() = -1;
  std::vector<Delaunay::Face_handle> queue{delaunay.infinite_face()};
  queue.front()->info() = 0;
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const auto face = queue[i];
    if (face->info() == 1)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    for (int k = 0; k < 3; ++k) {
      const auto next = face->neighbor(k);
      if (next->info() >= 0) continue;
      const auto a = face->vertex(Delaunay::ccw(k)), b = face->vertex(Delaunay::cw(k));
      const bool crosses =
          !delaunay.is_infinite(a) && !delaunay.is_infinite(b) && border.contains(std::minmax(a->info(), b->info()));
      next->info() = crosses ? 1 - face->info() : face->info();
      queue.push_back(next);
    }
  }
  return triangles;
}

}  // namespace

bool is_within(const std::vector<std::array<Vector2d, 2>>& border, const Vector2d& p) {
  bool inside = false;
  for (const auto& [a, b] : border) {
    if ((a.y() > p.y()) == (b.y() > p.y())) continue;
    if (p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside;
}

std::optional<Overlay> plane_overlay(const PlaneSides& sides) {
  Drawing s{sides};
  add_borders(s);
  cut_segments(s);
  if (!keeps_gap(s)) return std::nullopt;
  add_interior(s);
  const auto pieces = pieces_of_borders(s);
  Delaunay delaunay = triangulated(s.overlay, pieces);
  for (std::size_t f = 0; f < sides.faces.size(); ++f) s.overlay.faces[f].triangles = within(delaunay, pieces[f]);
  return std::move(s.overlay);
}

}  // namespace thinwall::mesh
