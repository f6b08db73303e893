// Time of numeric assembly: a block cut into a million tetrahedra of order 2, and into fifty thousand of order 4.
//   bench_assembly [2|4] [THREADS]      both orders and two threads if left out
// Assembles twice: into memory that the process touches for the first time, whose pages the system has to bring and
// clear, and into the same memory again.

#include "fem/assembly.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <optional>
#include <vector>

#include "bench/stages.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"

namespace {

using namespace thinwall;

/// The unit cube in `cells`³ cells, each of the six tetrahedra that climb from its lowest corner to its highest along
/// the axes (Kuhn 1960).
mesh::TetMesh cube(int cells) {
  mesh::TetMesh mesh;
  const int points = cells + 1;
  const std::array<int, 3> step{1, points, points * points};
  for (int i = 0; i < points * points * points; ++i) {
    const Eigen::Vector3i lattice(i % points, i / points % points, i / (points * points));
    mesh.vertices.emplace_back(lattice.cast<double>() / cells);
  }
  std::array<std::size_t, 3> axes{0, 1, 2};
  do {
    const bool even = (axes[1] + 3 - axes[0]) % 3 == 1;
    for (int cell = 0; cell < cells * cells * cells; ++cell) {
      const int a = cell % cells + step[1] * (cell / cells % cells) + step[2] * (cell / (cells * cells));
      const int b = a + step[axes[0]];
      const int c = b + step[axes[1]];
      const int d = c + step[axes[2]];
      mesh.tets.push_back(even ? std::array{a, b, c, d} : std::array{a, b, d, c});
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return mesh;
}

void measure(int cells, int order) {
  const mesh::TetMesh mesh = cube(cells);
  bench::Stopwatch watch;
  const mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, order);
  const double nodes_s = watch.lap();
  std::optional<fem::Assembled> all = fem::assemble(nodes, {210e9, 0.3, 7850.0});
  const double fresh_s = watch.lap();
  all.reset();
  watch.lap();
  all = fem::assemble(nodes, {210e9, 0.3, 7850.0});
  const double again_s = watch.lap();
  std::printf(
      "order %d: %8zu tets, %8td DOFs, nodes %5.2f s, assembly of K and M %5.2f s, again %5.2f s, K holds %td, peak "
      "%.2f "
      "GB\n",
      order, mesh.tets.size(), all->K.rows(), nodes_s, fresh_s, again_s, all->K.nonZeros(),
      bench::peak_memory_bytes() / 1e9);
}

}  // namespace

int main(int argc, char** argv) {
  core::keep_freed_memory();  // as the program does
  try {
    const int order = argc > 1 ? std::atoi(argv[1]) : 0;
    core::set_thread_count(argc > 2 ? std::max(1, std::atoi(argv[2])) : 2);
    if (order != 2) measure(20, 4);
    if (order != 4) measure(55, 2);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_assembly: %s\n", error.what());
    return 1;
  }
}
