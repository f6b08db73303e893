#include "mesh/tetgen.hpp"

#include <tetgen.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <sstream>
#include <vector>

#include "core/error.hpp"

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

/// Refines a mesh where size_at() is smaller than the tetrahedra are; a few passes reach a graded size.
void refine(tetgenio& mesh, tetgenio& refined, const TetgenOptions& options, std::string switches) {
  mesh.tetrahedronvolumelist = new REAL[static_cast<std::size_t>(mesh.numberoftetrahedra)];
  for (int tet = 0; tet < mesh.numberoftetrahedra; ++tet) {
    mesh.tetrahedronvolumelist[tet] =
        regular_volume(std::min(options.element_size_m, options.size_at(centroid(mesh, tet))));
  }
  tetrahedralize(switches.data(), &mesh, &refined);
}

template <class T>
void append(std::vector<char>& bytes, const T* data, std::size_t count) {
  const auto* begin = reinterpret_cast<const char*>(data);
  bytes.insert(bytes.end(), begin, begin + count * sizeof(T));
}

std::vector<char> serialise(const tetgenio& mesh) {
  std::vector<char> bytes;
  append(bytes, &mesh.numberofpoints, 1);
  append(bytes, &mesh.numberoftetrahedra, 1);
  append(bytes, mesh.pointlist, 3 * static_cast<std::size_t>(mesh.numberofpoints));
  append(bytes, mesh.tetrahedronlist, 4 * static_cast<std::size_t>(mesh.numberoftetrahedra));
  return bytes;
}

TetMesh deserialise(const std::vector<char>& bytes) {
  int counts[2]{};
  std::memcpy(counts, bytes.data(), sizeof counts);
  TetMesh mesh;
  if (counts[1] == 0) return mesh;  // an open surface: nothing to copy, and no arrays to copy to
  mesh.vertices.resize(static_cast<std::size_t>(counts[0]));
  mesh.tets.resize(static_cast<std::size_t>(counts[1]));
  const char* points = bytes.data() + sizeof counts;
  std::memcpy(static_cast<void*>(mesh.vertices.data()), points, mesh.vertices.size() * sizeof(Eigen::Vector3d));
  std::memcpy(static_cast<void*>(mesh.tets.data()), points + mesh.vertices.size() * sizeof(Eigen::Vector3d),
              mesh.tets.size() * sizeof(std::array<int, 4>));
  for (int tet = 0; tet < counts[1]; ++tet) {
    if (volume(mesh, tet) < 0.0)
      std::swap(mesh.tets[static_cast<std::size_t>(tet)][2], mesh.tets[static_cast<std::size_t>(tet)][3]);
  }
  return mesh;
}

/// Vertices that no tetrahedron uses would be motions without stiffness.
void drop_unused_vertices(TetMesh& mesh) {
  std::vector<int> number(mesh.vertices.size(), -1);
  std::vector<Eigen::Vector3d> used;
  for (auto& tet : mesh.tets) {
    for (int& v : tet) {
      int& n = number[static_cast<std::size_t>(v)];
      if (n < 0) {
        n = static_cast<int>(used.size());
        used.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = n;
    }
  }
  mesh.vertices = std::move(used);
}

std::vector<char> run_tetgen(const FacetedSurface& surface, const TetgenOptions& options) {
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
  return serialise(*mesh);
}

/// Runs a mesher in its own process and checks what it gave back.
TetMesh mesh_confined(const FacetedSurface& surface, const std::function<std::vector<char>()>& work,
                      double time_limit_s, double memory_limit_bytes, const std::string& remedy) {
  std::vector<char> bytes;
  try {
    bytes = run_confined(work, time_limit_s, memory_limit_bytes);
  } catch (const core::NumericalError& error) {
    throw core::NumericalError(std::string("TetGen failed on the part's surface: ") + error.what() + remedy);
  }
  if (bytes.size() < 2 * sizeof(int)) throw core::NumericalError("TetGen returned nothing" + remedy);
  TetMesh mesh = deserialise(bytes);
  drop_unused_vertices(mesh);
  if (mesh.tets.empty())
    throw core::NumericalError("TetGen returned no tetrahedra: the surface is not closed" + remedy);
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
  return mesh_confined(
      surface, [&] { return run_tetgen(surface, options); }, options.time_limit_s, options.memory_limit_bytes,
      "; try another part.mesh.element_size, a larger part.mesh.quality (at most 5), or larger limits");
}

TetMesh tetrahedralise_as_given(const FacetedSurface& surface, double time_limit_s, double memory_limit_bytes) {
  return mesh_confined(
      surface,
      [&] {
        tetgenio in;
        tetgenio out;
        fill(in, surface);
        std::string switches = "pYQ";
        tetrahedralize(switches.data(), &in, &out);
        return serialise(out);
      },
      time_limit_s, memory_limit_bytes, "; try other sizes of the surface's triangles, or larger limits");
}

}  // namespace thinwall::mesh
