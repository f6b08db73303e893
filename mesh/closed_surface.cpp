#include "mesh/closed_surface.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <map>
#include <string>

#include "core/error.hpp"
#include "mesh/pieces.hpp"

namespace thinwall::mesh {

namespace {

/// A surface thinner than this of its diagonal cubed encloses nothing that can be meshed.
constexpr double smallest_relative_volume = 1e-9;
/// A triangle with less than this of its longest edge squared as area has no direction.
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
    double longest = 0.0;
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest, (vertex(surface, v[k]) - vertex(surface, v[(k + 1) % 3])).squaredNorm());
    if (!(area_vector(surface, t).norm() > smallest_relative_area * longest)) {
      throw core::InputError("the surface has a triangle without area at " + millimetres(centroid(surface, t)) +
                             "; remove it and join its neighbours");
    }
  }
}

/// Each directed edge once, its opposite once.
void require_edges_paired(const TriangleSurface& surface) {
  std::map<std::array<int, 2>, int> uses;
  for (const auto& t : surface.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[{t[k], t[(k + 1) % 3]}];
  for (const auto& [edge, count] : uses) {
    const Eigen::Vector3d middle = 0.5 * (vertex(surface, edge[0]) + vertex(surface, edge[1]));
    const auto opposite = uses.find({edge[1], edge[0]});
    const int back = opposite == uses.end() ? 0 : opposite->second;
    if (count == 1 && back == 1) continue;
    const std::string where = " at the edge around " + millimetres(middle);
    if (count + back == 1) throw core::InputError("the surface is open" + where + "; close it");
    if (count == 2 && back == 0)
      throw core::InputError("the surface changes its orientation" + where + "; turn all normals outwards");
    throw core::InputError(std::to_string(count + back) + " triangles meet" + where +
                           "; a closed surface has two at every edge");
  }
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

std::vector<std::array<int, 2>> self_intersections(const TriangleSurface& surface) {
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
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(found));
  std::vector<std::array<int, 2>> result;
  result.reserve(found.size());
  for (const auto& [a, b] : found) result.push_back({static_cast<int>(a.idx()), static_cast<int>(b.idx())});
  return result;
}

void require_closed(const TriangleSurface& surface) {
  require_triangles(surface);
  require_edges_paired(surface);
  require_one_piece(surface);
  require_outwards(surface);
  const auto crossings = self_intersections(surface);
  if (!crossings.empty()) {
    throw core::InputError("the surface intersects itself in " + std::to_string(crossings.size()) +
                           " pairs of triangles, the first at " + millimetres(centroid(surface, crossings[0][0])) +
                           " and " + millimetres(centroid(surface, crossings[0][1])) + "; separate them");
  }
}

}  // namespace thinwall::mesh
