#include "mesh/surface/matched_walls.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <utility>

#include "core/interrupt.hpp"
#include "mesh/surface/plane_overlay.hpp"

namespace thinwall::mesh {

namespace {

using Eigen::Vector3d;

constexpr double flat = 1e-6;             // of the diagonal: distance of a plane face's vertices from its plane
constexpr double opposite = -1.0 + 5e-7;  // cosine between the normals of two parallel sides
constexpr double thickest = 1.0 / 3.0;    // of the triangles' edges
constexpr double slide = 0.4;             // of the shorter edge beside a vertex on a straight line
constexpr double slide_round = 0.55;      // likewise on a curve, where a regular polygon may have to turn
constexpr double straight = 1e-4;         // sine of the turn of a straight line
constexpr double smooth = 0.85;           // cosine of the turn of a curve
constexpr double off_the_chord = 0.4;     // distance from a curve's chord over that along it
constexpr double least_gap = 0.2;         // of the wall's thickness, between borders that do not touch
constexpr int passes = 3;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

/// A plane face of the surface.
struct PlaneFace {
  Vector3d normal = Vector3d::Zero();
  double offset = 0.0;  // normal · x of its plane, m
  double edge = 0.0;    // mean of its triangles' longest edges, by area, m
  bool plane = false;
  std::vector<int> triangles{};
};

double longest_edge(const TriangleSurface& surface, const std::array<int, 3>& t) {
  const auto& x = surface.vertices;
  return std::sqrt(std::max({(x[at(t[1])] - x[at(t[0])]).squaredNorm(), (x[at(t[2])] - x[at(t[1])]).squaredNorm(),
                             (x[at(t[0])] - x[at(t[2])]).squaredNorm()}));
}

/// Every patch as a face; those that are curved have `plane` false.
std::vector<PlaneFace> faces_of(const Remeshed& r) {
  std::vector<PlaneFace> faces(at(1 + *std::max_element(r.patch_of_triangle.begin(), r.patch_of_triangle.end())));
  for (std::size_t t = 0; t < r.surface.triangles.size(); ++t) {
    PlaneFace& face = faces[at(r.patch_of_triangle[t])];
    const Vector3d area = area_vector(r.surface, static_cast<int>(t));
    face.normal += area;
    face.edge += area.norm() * longest_edge(r.surface, r.surface.triangles[t]);
    face.triangles.push_back(static_cast<int>(t));
  }
  const double tolerance = flat * diagonal(r.surface);
  for (PlaneFace& face : faces) {
    double low = std::numeric_limits<double>::infinity(), high = -low, area = 0.0;
    face.normal.normalize();
    for (const int t : face.triangles) {
      area += area_vector(r.surface, t).norm();
      for (const int v : r.surface.triangles[at(t)]) {
        low = std::min(low, face.normal.dot(r.surface.vertices[at(v)]));
        high = std::max(high, face.normal.dot(r.surface.vertices[at(v)]));
      }
    }
    face.plane = high - low <= tolerance;
    face.offset = 0.5 * (low + high);
    face.edge /= std::max(area, std::numeric_limits<double>::min());
  }
  return faces;
}

/// A set of plane faces that are sides of the same walls, directly or by way of each other.
struct Walls {
  std::vector<int> patches{};
  double thickness = 0.0;  // of the thinnest, m
};

/// The directed edges of a patch that another patch has on its other side.
std::vector<std::array<int, 2>> border(const Remeshed& r, const PlaneFace& face) {
  std::set<std::array<int, 2>> edges;
  for (const int t : face.triangles) {
    const auto& v = r.surface.triangles[at(t)];
    for (std::size_t k = 0; k < 3; ++k) edges.insert({v[k], v[(k + 1) % 3]});
  }
  std::vector<std::array<int, 2>> result;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) result.push_back({a, b});
  return result;
}

/// The thickness of the wall between two plane faces: their distance, if they are parallel with material between, not
/// too far from each other for the first one's triangles, and a triangle of the first has its centroid before the
/// second.
std::optional<double> wall_between(const Remeshed& r, const PlaneFace& one, const PlaneFace& other) {
  // From a vertex of the other side and not from its offset, which two planes that are not quite parallel have at the
  // origin, however far away that is.
  const int there = r.surface.triangles[at(other.triangles.front())][0];
  const double thickness = one.offset - one.normal.dot(r.surface.vertices[at(there)]);
  if (one.normal.dot(other.normal) > opposite || !(thickness > 0.0) || thickness > thickest * one.edge)
    return std::nullopt;
  Eigen::Matrix<double, 2, 3> axes;
  axes.row(0) = one.normal.unitOrthogonal().transpose();
  axes.row(1) = one.normal.cross(axes.row(0).transpose()).transpose();
  std::vector<std::array<Eigen::Vector2d, 2>> edges;
  for (const auto& [a, b] : border(r, other))
    edges.push_back({axes * r.surface.vertices[at(a)], axes * r.surface.vertices[at(b)]});
  const bool covered = std::any_of(one.triangles.begin(), one.triangles.end(),
                                   [&](int t) { return is_within(edges, axes * centroid(r.surface, t)); });
  return covered ? std::optional(thickness) : std::nullopt;
}

/// The walls of the surface.
std::vector<Walls> walls_of(const Remeshed& r, const std::vector<PlaneFace>& faces) {
  std::vector<int> group(faces.size());
  std::iota(group.begin(), group.end(), 0);
  std::vector<double> thickness(faces.size(), std::numeric_limits<double>::infinity());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::size_t g = 0; g < faces.size(); ++g) {
      if (g == f || !faces[f].plane || !faces[g].plane) continue;
      const auto wall = wall_between(r, faces[f], faces[g]);
      if (!wall) continue;
      const int from_group = group[g], to_group = group[f];
      std::replace(group.begin(), group.end(), from_group, to_group);
      thickness[f] = std::min(thickness[f], *wall);
    }
  }
  std::map<int, Walls> walls;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    Walls& own = walls.try_emplace(group[f], Walls{{}, thickness[f]}).first->second;
    own.patches.push_back(static_cast<int>(f));
    own.thickness = std::min(own.thickness, thickness[f]);
  }
  std::vector<Walls> result;
  for (auto& [number, wall] : walls)
    if (wall.patches.size() > 1) result.push_back(std::move(wall));
  return result;
}

/// The patches that meet at each vertex.
std::vector<std::set<int>> patches_at_vertices(const Remeshed& r) {
  std::vector<std::set<int>> result(r.surface.vertices.size());
  for (std::size_t t = 0; t < r.surface.triangles.size(); ++t)
    for (const int v : r.surface.triangles[t]) result[at(v)].insert(r.patch_of_triangle[t]);
  return result;
}

/// The neighbours of each border vertex along the border: before and after.
std::map<int, std::vector<int>> along_border(const std::vector<std::array<int, 2>>& edges) {
  std::map<int, std::vector<int>> result;
  for (const auto& [a, b] : edges) {
    result[a].push_back(b);
    result[b].push_back(a);
  }
  return result;
}

/// The border of a face with those of its vertices that may slide: between two patches, on a line without a corner.
struct FaceBorder {
  std::map<int, std::vector<int>> neighbours{};
  std::set<int> sliding{};
};

/// The directions of the border before and behind a vertex.
std::pair<Vector3d, Vector3d> directions(const TriangleSurface& surface, int v, const std::vector<int>& around) {
  const auto& x = surface.vertices;
  return {(x[at(v)] - x[at(around[0])]).normalized(), (x[at(around[1])] - x[at(v)]).normalized()};
}

FaceBorder border_of(const Remeshed& r, const PlaneFace& face, const std::vector<std::set<int>>& patches) {
  FaceBorder result{along_border(border(r, face)), {}};
  for (const auto& [v, around] : result.neighbours) {
    if (around.size() != 2 || patches[at(v)].size() != 2) continue;
    const auto [before, behind] = directions(r.surface, v, around);
    if (before.dot(behind) > smooth) result.sliding.insert(v);
  }
  return result;
}

/// True if the triangles around v keep their sense and a tenth of their area with v at x.
bool may_move(const Remeshed& r, int v, const Vector3d& x) {
  core::check_interrupt();
  for (const auto& t : r.surface.triangles) {
    const auto corner = std::find(t.begin(), t.end(), v);
    if (corner == t.end()) continue;
    const auto k = static_cast<std::size_t>(corner - t.begin());
    const Vector3d& b = r.surface.vertices[at(t[(k + 1) % 3])];
    const Vector3d& c = r.surface.vertices[at(t[(k + 2) % 3])];
    const Vector3d before = (b - r.surface.vertices[at(v)]).cross(c - r.surface.vertices[at(v)]);
    if (before.dot((b - x).cross(c - x)) < 0.1 * before.squaredNorm()) return false;
  }
  return true;
}

/// The place to which v slides: that of the nearest vertex of the other side, in projection along n, on one of the two
/// edges beside v, or near them on a curve.
std::optional<Vector3d> target(const Remeshed& r, int v, const std::vector<int>& around, const FaceBorder& other,
                               bool to_sliding, const Vector3d& n, double tolerance) {
  const auto& x = r.surface.vertices;
  const auto [before, behind] = directions(r.surface, v, around);
  const bool is_straight = before.cross(behind).norm() < straight;
  const Vector3d along = (before + behind).normalized();
  double nearest = (is_straight ? slide : slide_round) *
                   std::min((x[at(around[0])] - x[at(v)]).norm(), (x[at(around[1])] - x[at(v)]).norm());
  std::optional<Vector3d> result;
  for (const auto& entry : other.neighbours) {
    const Vector3d to = x[at(entry.first)] - x[at(v)];
    const Vector3d way = to - n.dot(to) * n;
    if (way.norm() <= tolerance) return std::nullopt;  // it has its counterpart
    if (!to_sliding && other.sliding.contains(entry.first)) continue;
    const double off = is_straight ? tolerance : off_the_chord * way.norm();
    if (way.norm() >= nearest || way.cross(along).norm() > off) continue;
    nearest = way.norm();
    result = x[at(v)] + (is_straight ? Vector3d(along.dot(way) * along) : way);
  }
  return result;
}

/// Slides vertices of the borders to those of the other side.
void slide_vertices(Remeshed& r, const std::vector<PlaneFace>& faces, const Walls& walls) {
  const auto patches = patches_at_vertices(r);
  const double tolerance = flat * diagonal(r.surface);
  for (const int f : walls.patches) {
    const FaceBorder own = border_of(r, faces[at(f)], patches);
    for (const int g : walls.patches) {
      if (faces[at(f)].normal.dot(faces[at(g)].normal) > 0.0) continue;
      const FaceBorder other = border_of(r, faces[at(g)], patches);
      for (const int v : own.sliding) {
        const auto x = target(r, v, own.neighbours.at(v), other, g < f, faces[at(f)].normal, tolerance);
        if (x && may_move(r, v, *x)) r.surface.vertices[at(v)] = *x;
      }
    }
  }
}

/// The overlay's input: the walls' faces in the plane.
PlaneSides sides_of(const Remeshed& r, const std::vector<PlaneFace>& faces, const Walls& walls) {
  const Vector3d n = faces[at(walls.patches.front())].normal;
  PlaneSides sides;
  sides.tolerance = flat * diagonal(r.surface);
  sides.least_gap = least_gap * walls.thickness;
  Eigen::Matrix<double, 2, 3> axes;
  axes.row(0) = n.unitOrthogonal().transpose();
  axes.row(1) = n.cross(axes.row(0).transpose()).transpose();
  for (const int f : walls.patches) {
    const PlaneFace& face = faces[at(f)];
    PlaneSide side;
    side.upper = face.normal.dot(n) > 0.0;
    side.border = border(r, face);
    side.edge = face.edge;
    for (const int t : face.triangles)
      for (const int v : r.surface.triangles[at(t)]) side.place[v] = axes * r.surface.vertices[at(v)];
    sides.faces.push_back(std::move(side));
  }
  return sides;
}

/// Divides the triangle with the directed edge from a to b at the vertices `between`, from a to b.
void divide_edge(Remeshed& r, int a, int b, const std::vector<int>& between) {
  for (std::size_t t = 0; t < r.surface.triangles.size(); ++t) {
    const auto v = r.surface.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      if (v[k] != a || v[(k + 1) % 3] != b) continue;
      const int apex = v[(k + 2) % 3];
      int last = a;
      for (std::size_t i = 0; i <= between.size(); ++i) {
        const int next = i < between.size() ? between[i] : b;
        if (i == 0) {
          r.surface.triangles[t] = {last, next, apex};
        } else {
          r.surface.triangles.push_back({last, next, apex});
          r.patch_of_triangle.push_back(r.patch_of_triangle[t]);
        }
        last = next;
      }
      return;
    }
  }
}

/// The surface's vertex for each point of the overlay on a face: its own, or a new one. A new one on the border divides
/// the triangle beyond.
std::map<int, int> vertices_on(Remeshed& r, const PlaneFace& face, const Vector3d& n, const OverlaidFace& overlaid,
                               const std::vector<Eigen::Vector2d>& points) {
  std::map<int, int> vertex = overlaid.vertex_of_point;
  const auto add = [&](int point, const Vector3d& x) {
    vertex[point] = static_cast<int>(r.surface.vertices.size());
    r.surface.vertices.push_back(x);
  };
  for (const auto& [edge, between] : overlaid.divided) {
    std::vector<int> added;
    const Vector3d a = r.surface.vertices[at(edge[0])], b = r.surface.vertices[at(edge[1])];
    const Eigen::Vector2d& pa = points[at(overlaid.point_of_vertex.at(edge[0]))];
    const Eigen::Vector2d& pb = points[at(overlaid.point_of_vertex.at(edge[1]))];
    for (const int point : between) {
      const double s = (points[at(point)] - pa).dot(pb - pa) / (pb - pa).squaredNorm();
      add(point, a + s * (b - a));
      added.push_back(vertex[point]);
    }
    std::reverse(added.begin(), added.end());
    divide_edge(r, edge[1], edge[0], added);
  }
  const Vector3d u = n.unitOrthogonal(), v = n.cross(u);
  for (const auto& triangle : overlaid.triangles) {
    for (const int point : triangle) {
      if (vertex.contains(point)) continue;
      // Along n onto the face's own plane, which may lean a little.
      const Vector3d p = points[at(point)](0) * u + points[at(point)](1) * v;
      add(point, p + (face.offset - face.normal.dot(p)) / face.normal.dot(n) * n);
    }
  }
  return vertex;
}

/// Replaces the triangles of the walls by those of the overlay.
void replace_triangles(Remeshed& r, const std::vector<PlaneFace>& faces, const Walls& walls, const Overlay& overlay) {
  const Vector3d n = faces[at(walls.patches.front())].normal;
  std::vector<std::map<int, int>> vertices;
  for (std::size_t i = 0; i < walls.patches.size(); ++i)
    vertices.push_back(vertices_on(r, faces[at(walls.patches[i])], n, overlay.faces[i], overlay.points));
  const std::set<int> replaced(walls.patches.begin(), walls.patches.end());
  Remeshed result;
  result.longest_edge = r.longest_edge;
  for (std::size_t t = 0; t < r.surface.triangles.size(); ++t) {
    if (replaced.contains(r.patch_of_triangle[t])) continue;
    result.surface.triangles.push_back(r.surface.triangles[t]);
    result.patch_of_triangle.push_back(r.patch_of_triangle[t]);
  }
  for (std::size_t i = 0; i < walls.patches.size(); ++i) {
    const bool upper = faces[at(walls.patches[i])].normal.dot(n) > 0.0;
    for (const auto& t : overlay.faces[i].triangles) {
      std::array<int, 3> corners{vertices[i].at(t[0]), vertices[i].at(t[1]), vertices[i].at(t[2])};
      if (!upper) std::swap(corners[1], corners[2]);
      result.surface.triangles.push_back(corners);
      result.patch_of_triangle.push_back(walls.patches[i]);
    }
  }
  result.surface.vertices = std::move(r.surface.vertices);
  r = std::move(result);
}

/// Leaves out the vertices that no triangle uses.
void drop_unused(TriangleSurface& surface) {
  std::vector<int> number(surface.vertices.size(), -1);
  std::vector<Vector3d> used;
  for (auto& t : surface.triangles) {
    for (int& v : t) {
      if (number[at(v)] < 0) {
        number[at(v)] = static_cast<int>(used.size());
        used.push_back(surface.vertices[at(v)]);
      }
      v = number[at(v)];
    }
  }
  surface.vertices = std::move(used);
}

}  // namespace

Remeshed matched_walls(Remeshed remeshed) {
  for (int pass = 0; pass < passes; ++pass) {
    const auto walls = walls_of(remeshed, faces_of(remeshed));
    bool added = false;
    for (const Walls& wall : walls) {
      core::check_interrupt();
      Remeshed slid = remeshed;
      slide_vertices(slid, faces_of(slid), wall);
      const auto faces = faces_of(slid);
      const auto overlay = plane_overlay(sides_of(slid, faces, wall));
      if (!overlay) continue;
      for (const OverlaidFace& face : overlay->faces) added = added || !face.divided.empty();
      replace_triangles(slid, faces, wall, *overlay);
      remeshed = std::move(slid);
    }
    drop_unused(remeshed.surface);
    if (!added) break;
  }
  return remeshed;
}

}  // namespace thinwall::mesh
