#include "mesh/surface/solid_union.hpp"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>
#include <CGAL/Surface_mesh.h>

#include <cstdint>
#include <cstring>
#include <list>
#include <map>

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

/// Adds one of the bodies to the sum and takes it off the list. False if none can be added.
bool adds_one(Mesh& sum, std::list<Mesh>& left) {
  for (auto body = left.begin(); body != left.end(); ++body) {
    if (!processing::do_intersect(sum, *body)) continue;
    Mesh a = sum, b = *body, both;
    if (!processing::corefine_and_compute_union(a, b, both, CGAL::parameters::throw_on_self_intersection(true)))
      continue;
    sum = both;
    left.erase(body);
    return true;
  }
  return false;
}

/// Points and triangles as bytes, behind the number of points; empty where there is no union.
std::vector<char> union_in_bytes(const std::vector<TriangleSoup>& bodies) {
  std::list<Mesh> left;
  for (const TriangleSoup& body : bodies) left.push_back(mesh_of(body));
  Mesh sum = left.front();
  left.pop_front();
  while (!left.empty()) {
    if (!adds_one(sum, left)) return {};
  }
  sum.collect_garbage();
  const TriangleSoup result = soup_of(sum);
  const std::size_t count = result.points.size();
  const std::size_t of_points = count * sizeof result.points[0];
  const std::size_t of_triangles = result.triangles.size() * sizeof result.triangles[0];
  std::vector<char> bytes(sizeof count + of_points + of_triangles);
  std::memcpy(bytes.data(), &count, sizeof count);
  std::memcpy(bytes.data() + sizeof count, result.points.data(), of_points);
  std::memcpy(bytes.data() + sizeof count + of_points, result.triangles.data(), of_triangles);
  return bytes;
}

}  // namespace

std::optional<TriangleSoup> united(const std::vector<TriangleSoup>& bodies, const ProcessLimits& limits) {
  if (bodies.empty()) return std::nullopt;
  std::vector<char> bytes;
  try {
    bytes = run_confined([&] { return union_in_bytes(bodies); }, limits.time_s, limits.memory_bytes);
  } catch (const core::NumericalError&) {
    core::check_interrupt();
  }
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

}  // namespace thinwall::mesh
