#include "mesh/volume/delaunay_volume.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Polyhedral_mesh_domain_with_features_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/make_mesh_3.h>

#include <map>
#include <numbers>
#include <string>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Surface_mesh<Kernel::Point_3>;
using Domain = CGAL::Polyhedral_mesh_domain_with_features_3<Kernel, Polyhedron>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation, Domain::Corner_index, Domain::Curve_index>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

Polyhedron polyhedron(const TriangleSurface& surface) {
  Polyhedron result;
  for (const auto& x : surface.vertices) result.add_vertex({x(0), x(1), x(2)});
  const auto index = [](int v) { return Polyhedron::Vertex_index(static_cast<std::uint32_t>(v)); };
  for (const auto& t : surface.triangles) result.add_face(index(t[0]), index(t[1]), index(t[2]));
  return result;
}

TetMesh tet_mesh(const Complex& complex) {
  TetMesh mesh;
  std::map<Complex::Vertex_handle, int> numbers;
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<int, 4> tet{};
    for (int k = 0; k < 4; ++k) {
      const auto vertex = cell->vertex(k);
      const auto [entry, is_new] = numbers.try_emplace(vertex, static_cast<int>(numbers.size()));
      const auto& x = vertex->point();
      if (is_new) mesh.vertices.emplace_back(x.x(), x.y(), x.z());
      tet[static_cast<std::size_t>(k)] = entry->second;
    }
    mesh.tets.push_back(tet);
  }
  return mesh;
}

TetMesh refine(const TriangleSurface& surface, const DelaunayVolumeOptions& options) {
  namespace parameters = CGAL::parameters;
  constexpr double facet_angle_deg = 25.0;   // guaranteed up to 30
  constexpr double radius_edge_ratio = 3.0;  // guaranteed above 2
  const Polyhedron input = polyhedron(surface);
  CGAL::Random random(0);  // the same mesh every time
  Domain domain(input, &random);
  domain.detect_features(options.sharp_angle_rad * 180.0 / std::numbers::pi);
  const Criteria criteria(
      parameters::edge_size = options.size_m, parameters::facet_angle = facet_angle_deg,
      parameters::facet_size = options.size_m, parameters::facet_distance = options.surface_distance_m,
      parameters::cell_radius_edge_ratio = radius_edge_ratio, parameters::cell_size = options.size_m);
  return tet_mesh(CGAL::make_mesh_3<Complex>(domain, criteria, parameters::no_perturb()));
}

}  // namespace

TetMesh delaunay_volume(const TriangleSurface& surface, const DelaunayVolumeOptions& options) {
  if (!(options.size_m > 0.0) || !(options.surface_distance_m > 0.0)) {
    throw core::InputError("a Delaunay mesh was asked for with size " + std::to_string(options.size_m) +
                           " m and surface distance " + std::to_string(options.surface_distance_m) +
                           " m; give positive lengths");
  }
  return mesh_confined(
      "CGAL", [&] { return refine(surface, options); }, options.limits);
}

}  // namespace thinwall::mesh
