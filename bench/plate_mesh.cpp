// The mesh that all programs of the bench share: the CFCF plate 450 × 100 × 6 mm of steel in ten-node tetrahedra by
// TetGen, as an input file that CalculiX runs as it is.
//   plate_mesh ELEMENT_SIZE_M MODES FILE.inp      prints one JSON object

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "bench/stages.hpp"
#include "io/mesh/inp.hpp"
#include "mesh/box.hpp"
#include "mesh/selection.hpp"
#include "mesh/volume/tetgen.hpp"

namespace {

using namespace thinwall;

void write_plate(double element_size_m, int modes, const char* path) {
  const mesh::Box plate{{0.006, 0.450, 0.100}};
  bench::Stopwatch watch;
  mesh::TetgenOptions options;
  options.element_size_m = element_size_m;
  options.time_limit_s = 600.0;
  options.memory_limit_bytes = 8e9;
  const mesh::TetMesh mesh = mesh::tetrahedralise(mesh::surface(plate), options);
  const double mesh_s = watch.lap();
  const mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, 2);
  const auto boundary = mesh::boundary(mesh);
  mesh::NodeSet fixed{"FIXED", {}};
  for (const char* face : {"y_min", "y_max"}) {
    const auto held = mesh::nodes_on(nodes, mesh, mesh::select(mesh, boundary, mesh::face_of(plate, face), face));
    fixed.nodes.insert(fixed.nodes.end(), held.begin(), held.end());
  }
  io::write_inp(path, nodes, {fixed}, io::InpFrequencyStep{210e9, 0.3, 7850.0, {"FIXED"}, modes});
  std::printf(R"({"mesh_s": %.3f, "write_s": %.3f, "tets": %zu, "nodes": %td, "dofs": %td})", mesh_s, watch.lap(),
              mesh.tets.size(), nodes.positions.rows(),
              3 * (nodes.positions.rows() - static_cast<std::ptrdiff_t>(fixed.nodes.size())));
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: plate_mesh ELEMENT_SIZE_M MODES FILE.inp\n");
    return 2;
  }
  try {
    write_plate(std::strtod(argv[1], nullptr), std::atoi(argv[2]), argv[3]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plate_mesh: %s\n", error.what());
    return 1;
  }
}
