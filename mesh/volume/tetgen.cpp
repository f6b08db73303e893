#include "mesh/volume/tetgen.hpp"

#include <tetgen.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::mesh {

namespace {

void fill(tetgenio& in, const FacetedSurface& surface) {
  in.firstnumber = 0;
  in.numberofpoints = static_cast<int>(surface.vertices.size());
  in.pointlist = new REAL[3 * surface.vertices.size()];
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    for (int k = 0; k < 3; ++k) in.pointlist[3 * i + static_cast<std::size_t>(k)] = surface.vertices[i](k);
  }
  in.numberoffacets = static_cast<int>(surface.facets.size());
  in.facetlist = new tetgenio::facet[surface.facets.size()];
  for (std::size_t f = 0; f < surface.facets.size(); ++f) {
    tetgenio::facet& facet = in.facetlist[f];
    tetgenio::init(&facet);
    facet.numberofpolygons = 1;
    facet.polygonlist = new tetgenio::polygon[1];
    tetgenio::polygon& polygon = facet.polygonlist[0];
    tetgenio::init(&polygon);
    polygon.numberofvertices = static_cast<int>(surface.facets[f].size());
    polygon.vertexlist = new int[surface.facets[f].size()];
    std::copy(surface.facets[f].begin(), surface.facets[f].end(), polygon.vertexlist);
  }
}

Eigen::Vector3d centroid(const tetgenio& mesh, int tet) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int k = 0; k < 4; ++k)
    sum += Eigen::Map<const Eigen::Vector3d>(mesh.pointlist + 3 * mesh.tetrahedronlist[4 * tet + k]);
  return sum / 4.0;
}

/// Refines a mesh once, where size_at() is smaller than its tetrahedra.
void refine(tetgenio& mesh, tetgenio& refined, const TetgenOptions& options, std::string switches) {
  mesh.tetrahedronvolumelist = new REAL[static_cast<std::size_t>(mesh.numberoftetrahedra)];
  for (int tet = 0; tet < mesh.numberoftetrahedra; ++tet) {
    mesh.tetrahedronvolumelist[tet] =
        regular_volume(std::min(options.element_size_m, options.size_at(centroid(mesh, tet))));
  }
  tetrahedralize(switches.data(), &mesh, &refined);
}

TetMesh tet_mesh(const tetgenio& from) {
  TetMesh mesh;
  for (int v = 0; v < from.numberofpoints; ++v)
    mesh.vertices.emplace_back(Eigen::Map<const Eigen::Vector3d>(from.pointlist + 3 * v));
  mesh.tets.resize(static_cast<std::size_t>(from.numberoftetrahedra));
  for (int t = 0; t < from.numberoftetrahedra; ++t)
    std::copy_n(from.tetrahedronlist + 4 * t, 4, mesh.tets[static_cast<std::size_t>(t)].begin());
  return mesh;
}

TetMesh run_tetgen(const FacetedSurface& surface, const TetgenOptions& options) {
  tetgenio in;
  fill(in, surface);
  std::ostringstream first;
  first.imbue(std::locale::classic());
  first.precision(17);
  first << "pQq" << options.radius_edge_ratio << 'a' << regular_volume(options.element_size_m);
  std::string switches = first.str();
  auto mesh = std::make_unique<tetgenio>();
  tetrahedralize(switches.data(), &in, mesh.get());
  if (options.size_at) {
    std::ostringstream again;
    again.imbue(std::locale::classic());
    again << "rQaq" << options.radius_edge_ratio;
    for (int pass = 0; pass < 3; ++pass) {
      auto refined = std::make_unique<tetgenio>();
      refine(*mesh, *refined, options, again.str());
      mesh = std::move(refined);
    }
  }
  return tet_mesh(*mesh);
}

/// The mesh that `work` makes in a process of its own, if its volume agrees with the surface's. `remedy` ends the
/// message of an error.
TetMesh checked(const FacetedSurface& surface, const std::function<TetMesh()>& work, const ProcessLimits& limits,
                const std::string& remedy) {
  TetMesh mesh;
  try {
    mesh = mesh_confined("TetGen", work, limits);
  } catch (const core::NumericalError& error) {
    throw core::NumericalError(error.what() + remedy);
  }
  const double expected = volume(surface);
  const double found = volume(mesh);
  if (!(std::abs(found - expected) <= 1e-9 * expected)) {
    throw core::NumericalError("the mesh's volume is " + std::to_string(found * 1e9) + " mm³, the part's " +
                               std::to_string(expected * 1e9) + " mm³" + remedy);
  }
  return mesh;
}

}  // namespace

double regular_volume(double edge_m) {
  return edge_m * edge_m * edge_m / (6.0 * std::sqrt(2.0));
}

TetMesh tetrahedralise(const FacetedSurface& surface, const TetgenOptions& options) {
  return checked(
      surface, [&] { return run_tetgen(surface, options); }, {options.time_limit_s, options.memory_limit_bytes},
      "; try another part.mesh.element_size, a larger part.mesh.quality (at most 5), or larger limits");
}

TetMesh tetrahedralise_as_given(const FacetedSurface& surface, const ProcessLimits& limits, double radius_edge_ratio) {
  const auto work = [&] {
    tetgenio in;
    tetgenio out;
    fill(in, surface);
    std::string switches = "pYQ";
    if (radius_edge_ratio > 0.0) switches += "q" + core::number_text(radius_edge_ratio, 3);
    tetrahedralize(switches.data(), &in, &out);
    return tet_mesh(out);
  };
  return checked(surface, work, limits, "; try other sizes of the surface's triangles, or larger limits");
}

}  // namespace thinwall::mesh
