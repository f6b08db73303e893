#include "mesh/surface/solid_union.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/bbox.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Surface_mesh.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <list>
#include <map>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"

namespace thinwall::mesh {

namespace {

namespace processing = CGAL::Polygon_mesh_processing;

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

Mesh mesh_of(const TriangleSoup& body) {
  Mesh mesh;
  for (const auto& x : body.points) mesh.add_vertex({x(0), x(1), x(2)});
  for (const auto& t : body.triangles) {
    const auto at = [&](std::size_t k) { return Mesh::Vertex_index(static_cast<std::uint32_t>(t[k])); };
    if (mesh.add_face(at(0), at(1), at(2)) == Mesh::null_face())
      throw core::NumericalError("a body touches itself in a point");
  }
  return mesh;
}

TriangleSoup soup_of(const Mesh& mesh) {
  TriangleSoup result;
  std::map<Mesh::Vertex_index, int> number;
  for (const auto v : mesh.vertices()) {
    number[v] = static_cast<int>(result.points.size());
    const auto& x = mesh.point(v);
    result.points.emplace_back(CGAL::to_double(x.x()), CGAL::to_double(x.y()), CGAL::to_double(x.z()));
  }
  for (const auto f : mesh.faces()) {
    auto& corners = result.triangles.emplace_back();
    std::size_t k = 0;
    for (const auto v : mesh.vertices_around_face(mesh.halfedge(f))) corners[k++] = number.at(v);
  }
  return result;
}

/// A body or the union of some, with the box around it.
struct Body {
  explicit Body(Mesh of) : mesh(std::move(of)), box(processing::bbox(mesh)) {}
  Mesh mesh;
  CGAL::Bbox_3 box;
};

/// The union of a body with the first of the others that has one with it, which is taken off their list. Empty if there
/// is none.
std::optional<Body> united_with_one(const Body& body, std::list<Body>& others) {
  for (auto other = others.begin(); other != others.end(); ++other) {
    if (!CGAL::do_overlap(body.box, other->box) || !processing::do_intersect(body.mesh, other->mesh)) continue;
    Mesh a = body.mesh, b = other->mesh, both;
    if (!processing::corefine_and_compute_union(a, b, both, CGAL::parameters::throw_on_self_intersection(true)))
      continue;
    both.collect_garbage();
    others.erase(other);
    return Body(std::move(both));
  }
  return std::nullopt;
}

/// Unites the bodies in pairs. A sum to which each is added by itself would be cut anew for every body.
std::list<Body> united_in_pairs(std::list<Body> bodies) {
  std::list<Body> result;
  while (!bodies.empty()) {
    Body body = std::move(bodies.front());
    bodies.pop_front();
    std::optional<Body> both = united_with_one(body, bodies);
    result.push_back(both ? std::move(*both) : std::move(body));
  }
  return result;
}

/// Points and triangles as bytes, behind the number of points; empty where there is no union.
std::vector<char> union_in_bytes(const std::vector<TriangleSoup>& bodies) {
  std::list<Body> left;
  for (const TriangleSoup& body : bodies) left.emplace_back(mesh_of(body));
  while (left.size() > 1) {
    const std::size_t before = left.size();
    left = united_in_pairs(std::move(left));
    if (left.size() == before) return {};
  }
  const TriangleSoup result = soup_of(left.front().mesh);
  const std::size_t count = result.points.size();
  const std::size_t of_points = count * sizeof result.points[0];
  const std::size_t of_triangles = result.triangles.size() * sizeof result.triangles[0];
  std::vector<char> bytes(sizeof count + of_points + of_triangles);
  std::memcpy(bytes.data(), &count, sizeof count);
  std::memcpy(bytes.data() + sizeof count, static_cast<const void*>(result.points.data()), of_points);
  std::memcpy(bytes.data() + sizeof count + of_points, result.triangles.data(), of_triangles);
  return bytes;
}

/// The soup of union_in_bytes(); empty where there is no union.
std::optional<TriangleSoup> soup_from(const std::vector<char>& bytes) {
  std::size_t count = 0;
  if (bytes.size() <= sizeof count) return std::nullopt;
  std::memcpy(&count, bytes.data(), sizeof count);
  TriangleSoup result;
  result.points.resize(count);
  const std::size_t of_points = count * sizeof result.points[0];
  const std::size_t of_triangles = bytes.size() - sizeof count - of_points;
  result.triangles.resize(of_triangles / sizeof(std::array<int, 3>));
  std::memcpy(static_cast<void*>(result.points.data()), bytes.data() + sizeof count, of_points);
  std::memcpy(result.triangles.data(), bytes.data() + sizeof count + of_points, of_triangles);
  return result;
}

}  // namespace

SolidUnion united(const std::vector<TriangleSoup>& bodies, const ProcessLimits& limits) {
  if (bodies.empty()) return {};
  SolidUnion result;
  try {
    const auto bytes = run_confined([&] { return union_in_bytes(bodies); }, limits.time_s, limits.memory_bytes);
    result.surface = soup_from(bytes);
  } catch (const core::NumericalError& error) {
    core::check_interrupt();
    result.failure = error.what();
  }
  return result;
}

}  // namespace thinwall::mesh
