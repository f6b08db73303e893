// The part of a case in elements of a chosen kind, size and order, and its natural modes (bench/run accuracy).
//   accuracy_modes CASE --mesher tetgen|cgal --size METRES [--order P] [--write-inp FILE]
//   accuracy_modes CASE --mesher nested --size METRES --pieces N ...   one layer of tetrahedra, each split into N³
//   accuracy_modes CASE --mesher graded --level L ...                prints one JSON object
// Every mesher fills the flat part; the nodes of order P then lie on the true surface of a bent one, those of the file
// for CalculiX as well.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/stages.hpp"
#include "case/reader.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "io/mesh/inp.hpp"
#include "mesh/box.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "mesh/volume/delaunay_volume.hpp"
#include "mesh/volume/tetgen.hpp"
#include "setup/graded_mesh.hpp"
#include "setup/part_geometry.hpp"
#include "study/part/discretisation.hpp"

namespace {

using namespace thinwall;

struct Options {
  std::string source;
  std::string mesher = "tetgen";
  double size_m = 0.0;
  int level = 0;
  int pieces = 1;
  int order = 2;
  int threads = 2;
  std::string inp;
};

constexpr mesh::ProcessLimits limits{600.0, 8e9};

/// With every tetrahedron of positive volume.
mesh::TetMesh turned(mesh::TetMesh mesh) {
  for (std::size_t e = 0; e < mesh.tets.size(); ++e) {
    if (mesh::volume(mesh, static_cast<int>(e)) < 0.0) std::swap(mesh.tets[e][2], mesh.tets[e][3]);
  }
  return mesh;
}

/// One layer of tetrahedra through every wall of the flat part, `size_m` wide.
mesh::TetMesh one_layer(const setup::Part& part, double size_m) {
  mesh::PrismMeshOptions options;
  options.size_m = size_m;
  options.layers = 0;
  const setup::PlanarPart planar = setup::planar(part);
  mesh::TetMesh mesh = mesh::mesh_prism(planar.prism, options);
  for (auto& v : mesh.vertices) {
    Eigen::Vector3d x;
    for (int k = 0; k < 3; ++k) x[planar.axes[static_cast<std::size_t>(k)]] = v[k];
    v = x;
  }
  return turned(std::move(mesh));
}

/// How a tetrahedron falls into n³ of three shapes at most, so that faces of neighbours fit: cut by the planes that
/// divide a cube into n³ cubes of six tetrahedra each, of which it is one sixth (Edelsbrunner & Grayson 2000, "Edgewise
/// subdivision of a simplex"). Corners as indices into mesh::lattice(n).
std::vector<std::array<Eigen::Index, 4>> edgewise(int n) {
  const auto lattice = mesh::lattice(n);
  const auto index = [&](const Eigen::Vector3i& y) {
    const std::array<int, 4> alpha{n - y[0], y[0] - y[1], y[1] - y[2], y[2]};
    return std::find(lattice.begin(), lattice.end(), alpha) - lattice.begin();
  };
  std::vector<std::array<Eigen::Index, 4>> pieces;
  for (int cube = 0; cube < n * n * n; ++cube) {
    std::array<int, 3> axes{0, 1, 2};
    do {
      Eigen::Vector3i y(cube / (n * n), cube / n % n, cube % n);
      std::array<Eigen::Index, 4> piece{index(y)};
      for (std::size_t k = 0; k < 3; ++k) {
        ++y[axes[k]];
        piece[k + 1] = index(y);
      }
      if (*std::max_element(piece.begin(), piece.end()) < std::ssize(lattice)) pieces.push_back(piece);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return pieces;
}

mesh::TetMesh subdivided(const mesh::TetMesh& mesh, int n) {
  const mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, n);
  const auto pieces = edgewise(n);
  mesh::TetMesh result;
  for (const auto& x : nodes.positions.rowwise()) result.vertices.emplace_back(x.transpose());
  for (const auto& element : nodes.elements.rowwise()) {
    for (const auto& p : pieces) result.tets.push_back({element[p[0]], element[p[1]], element[p[2]], element[p[3]]});
  }
  return turned(std::move(result));
}

/// The closed surface of the flat part, in triangles as large as its borders allow.
mesh::FacetedSurface flat_surface(const setup::Part& part) {
  if (setup::kind(part) == setup::ShapeKind::box) return mesh::surface(mesh::Box{setup::box_size(part)});
  const mesh::TetMesh filled = one_layer(part, mesh::diagonal(setup::planar(part).prism));
  mesh::FacetedSurface surface{filled.vertices, {}};
  for (const auto& t : mesh::boundary(filled)) surface.facets.emplace_back(t.vertices.begin(), t.vertices.end());
  return surface;
}

mesh::TetMesh meshed(const cases::Case& source, const Options& options) {
  if (options.mesher == "graded") return setup::graded_mesh(source, options.level);
  if (options.mesher == "nested") return subdivided(one_layer(*source.part, options.size_m), options.pieces);
  const mesh::FacetedSurface surface = flat_surface(*source.part);
  if (options.mesher == "tetgen") {
    mesh::TetgenOptions tetgen;
    tetgen.element_size_m = options.size_m;
    tetgen.time_limit_s = limits.time_s;
    tetgen.memory_limit_bytes = limits.memory_bytes;
    return mesh::tetrahedralise(surface, tetgen);
  }
  mesh::DelaunayVolumeOptions cgal;
  cgal.size_m = options.size_m;
  cgal.surface_distance_m = 0.1 * options.size_m;
  cgal.limits = limits;
  return mesh::delaunay_volume(mesh::triangulated(surface), cgal);
}

/// For CalculiX, on the very nodes of the model. The supports hold nodes in all three directions.
void write_inp(const std::string& path, const cases::Case& source, const fem::Model& model) {
  std::vector<bool> is_free(static_cast<std::size_t>(model.nodes.positions.rows()), false);
  for (const int node : model.node_of_row) is_free[static_cast<std::size_t>(node)] = true;
  mesh::NodeSet fixed{"FIXED", {}};
  for (std::size_t node = 0; node < is_free.size(); ++node) {
    if (!is_free[node]) fixed.nodes.push_back(static_cast<int>(node));
  }
  const fem::Material material = setup::material_of(*source.part);
  io::write_inp(path, model.nodes, {fixed},
                io::InpFrequencyStep{material.youngs_modulus_Pa,
                                     material.poisson_ratio,
                                     material.density_kg_m3,
                                     {fixed.name},
                                     setup::mode_options(source).count});
}

nlohmann::ordered_json run(const Options& options) {
  core::set_thread_count(options.threads);
  const cases::Case source = cases::read_case(options.source);
  bench::Stopwatch watch;
  mesh::TetMesh mesh = meshed(source, options);
  nlohmann::ordered_json report{{"mesh_s", watch.lap()}, {"tets", mesh.tets.size()}, {"order", options.order}};
  const fem::Model model = fem::supported_model(std::move(mesh), options.order, setup::material_of(*source.part),
                                                setup::supports_of(source), setup::shaping(*source.part));
  const fem::Factored factored = fem::factorise(model, core::available_memory_bytes());
  const fem::Modes modes = fem::modes(model, factored, setup::mode_options(source));
  report["solve_s"] = watch.lap();
  report["dofs"] = model.K.rows();
  report["frequencies_hz"] = modes.frequency_hz;
  if (!options.inp.empty()) write_inp(options.inp, source, model);
  return report;
}

int parse_and_run(int argc, char** argv) {
  Options options;
  CLI::App app("The natural modes of a case's part in elements of a chosen kind, size and order");
  app.add_option("case", options.source, "case file")->required();
  app.add_option("--mesher", options.mesher)->check(CLI::IsMember({"tetgen", "cgal", "nested", "graded"}));
  app.add_option("--size", options.size_m, "edge of a tetrahedron, m")->check(CLI::Range(1e-5, 1.0));
  app.add_option("--level", options.level, "of the graded mesh")->check(CLI::Range(0, 4));
  app.add_option("--pieces", options.pieces, "of each edge of the one layer")->check(CLI::Range(1, 6));
  app.add_option("--order", options.order, "of the elements")->check(CLI::Range(1, 6));
  app.add_option("--threads", options.threads, "threads")->check(CLI::Range(1, 1024));
  app.add_option("--write-inp", options.inp, "input file for CalculiX; order 1 or 2");
  CLI11_PARSE(app, argc, argv);
  std::cout << run(options).dump() << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  core::keep_freed_memory();  // as the program does
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "accuracy_modes: %s\n", error.what());
    return 1;
  }
}
