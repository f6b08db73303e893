#include "mesh/surface/closed_surface.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <span>
#include <string>

#include "core/error.hpp"
#include "mesh/pieces.hpp"
#include "mesh/surface/edge_uses.hpp"

namespace thinwall::mesh {

namespace {

/// Least volume of a surface that can be meshed, over its diagonal cubed.
constexpr double smallest_relative_volume = 1e-9;
/// Least area of a triangle with a defined normal, over its longest edge squared.
constexpr double smallest_relative_area = 1e-12;

std::string millimetres(const Eigen::Vector3d& x) {
  char text[96];
  std::snprintf(text, sizeof text, "(%.6g, %.6g, %.6g) mm", 1e3 * x(0), 1e3 * x(1), 1e3 * x(2));
  return text;
}

const Eigen::Vector3d& vertex(const TriangleSurface& surface, int v) {
  return surface.vertices[static_cast<std::size_t>(v)];
}

void require_triangles(const TriangleSurface& surface) {
  if (surface.triangles.empty()) throw core::InputError("the surface has no triangles; give a closed surface");
  for (const auto& x : surface.vertices) {
    if (!x.allFinite()) throw core::InputError("a vertex of the surface is not finite: " + millimetres(x));
  }
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
    const auto& v = surface.triangles[static_cast<std::size_t>(t)];
    if (!has_area(vertex(surface, v[0]), vertex(surface, v[1]), vertex(surface, v[2]))) {
      throw core::InputError("the surface has a triangle without area at " + millimetres(centroid(surface, t)) +
                             "; remove it and join its neighbours");
    }
  }
}

/// Throws InputError unless each directed edge occurs once and its opposite once.
void require_edges_paired(const TriangleSurface& surface) {
  for_each_edge(sorted_edges(surface.triangles), [&](std::span<const EdgeUse> uses) {
    const auto& ends = uses[0].ends;
    const auto forward = std::count_if(uses.begin(), uses.end(), [](const EdgeUse& use) { return use.is_forward; });
    if (uses.size() == 2 && forward == 1) return;
    const std::string where =
        " at the edge around " + millimetres(0.5 * (vertex(surface, ends[0]) + vertex(surface, ends[1])));
    if (uses.size() == 1) throw core::InputError("the surface is open" + where + "; close it");
    if (uses.size() == 2)
      throw core::InputError("the surface changes its orientation" + where + "; turn all normals outwards");
    throw core::InputError(std::to_string(uses.size()) + " triangles meet" + where +
                           "; a closed surface has two at every edge");
  });
}

void require_one_piece(const TriangleSurface& surface) {
  const auto piece = pieces(static_cast<int>(surface.vertices.size()), surface.triangles);
  const int first = piece[static_cast<std::size_t>(surface.triangles[0][0])];
  for (const auto& t : surface.triangles) {
    if (piece[static_cast<std::size_t>(t[0])] == first) continue;
    throw core::InputError("the surface has several separate pieces, one around " +
                           millimetres(vertex(surface, surface.triangles[0][0])) + " and one around " +
                           millimetres(vertex(surface, t[0])) + "; give one body without inner voids");
  }
}

void require_outwards(const TriangleSurface& surface) {
  const double enclosed = volume(surface);
  const double length = diagonal(surface);
  const double bound = smallest_relative_volume * length * length * length;
  const std::string where = " around " + millimetres(vertex(surface, surface.triangles[0][0]));
  if (enclosed < -bound) {
    throw core::InputError("the surface" + where + " is inside out: it encloses " + std::to_string(enclosed * 1e9) +
                           " mm³; turn all normals outwards");
  }
  if (!(enclosed > bound)) {
    throw core::InputError("the surface" + where + " encloses " + std::to_string(enclosed * 1e9) + " mm³, at most " +
                           std::to_string(bound * 1e9) + " mm³: a wall without thickness; give it one");
  }
}

}  // namespace

bool has_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const double longest = std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  return 0.5 * (b - a).cross(c - a).norm() > smallest_relative_area * longest;
}

std::vector<std::array<int, 2>> self_intersections(const TriangleSurface& surface, int most) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  Mesh mesh;
  for (const auto& x : surface.vertices) mesh.add_vertex({x(0), x(1), x(2)});
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) {
    const auto& v = surface.triangles[static_cast<std::size_t>(t)];
    const auto at = [&](std::size_t k) { return Mesh::Vertex_index(static_cast<std::uint32_t>(v[k])); };
    if (mesh.add_face(at(0), at(1), at(2)) == Mesh::null_face()) {
      throw core::InputError("parts of the surface touch in a single vertex or edge of the triangle at " +
                             millimetres(centroid(surface, t)) + "; separate or join them");
    }
  }
  std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>> found;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found),
                                                    CGAL::parameters::maximum_number(static_cast<unsigned int>(most)));
  std::vector<std::array<int, 2>> result;
  result.reserve(found.size());
  for (const auto& [a, b] : found) result.push_back({static_cast<int>(a.idx()), static_cast<int>(b.idx())});
  return result;
}

void require_closed_shell(const TriangleSurface& surface) {
  require_triangles(surface);
  require_edges_paired(surface);
  require_one_piece(surface);
  require_outwards(surface);
}

void require_closed(const TriangleSurface& surface) {
  require_closed_shell(surface);
  const auto crossings = self_intersections(surface);
  if (!crossings.empty()) {
    throw core::InputError("the surface intersects itself in " + std::to_string(crossings.size()) +
                           " pairs of triangles, the first at " + millimetres(centroid(surface, crossings[0][0])) +
                           " and " + millimetres(centroid(surface, crossings[0][1])) + "; separate them");
  }
}

}  // namespace thinwall::mesh
