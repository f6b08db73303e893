// From a mesh file to natural modes, stage by stage, beside the peers (bench/run fem). Steel, SI.
//   fem_modes FILE.inp [--fixed SET] [--modes N] [--threads N] [--write-petsc FOLDER]      prints one JSON object
// With --write-petsc it writes the assembled K and M of the free DOFs for bench/slepc_modes and stops.

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/petsc_binary.hpp"
#include "bench/stages.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "fem/assembly.hpp"
#include "io/inp.hpp"
#include "linalg/eigenpairs.hpp"
#include "linalg/sparse_cholesky.hpp"

namespace {

using namespace thinwall;

const fem::Material steel{210e9, 0.3, 7850.0};

struct Options {
  std::string inp;
  std::string fixed = "FIXED";
  int modes = 10;
  int threads = 2;
  std::string petsc_folder;
};

/// K and M of the free DOFs.
fem::Assembled free_matrices(const io::InpMesh& part, const std::vector<int>& fixed_nodes) {
  std::vector<int> fixed;
  for (const int node : fixed_nodes) {
    for (int axis = 0; axis < 3; ++axis) fixed.push_back(3 * node + axis);
  }
  return fem::assemble(part.nodes, steel, fixed);
}

void solve(const fem::Assembled& matrices, int modes, nlohmann::ordered_json& report) {
  bench::Stopwatch watch;
  std::vector<int> node_of_row;
  for (const int row : matrices.free_rows) node_of_row.push_back(row / 3);
  const linalg::SparseCholesky factor(matrices.K, node_of_row);
  const double factorise_s = watch.lap();
  const linalg::FactorStatistics& cost = factor.statistics();
  const linalg::ShiftedInverse inverse{
      [&factor](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factor.solve(B); }, 0.0};
  const linalg::Eigenpairs pairs = linalg::lowest_eigenpairs(matrices.K, matrices.M, inverse, modes);
  report["ordering_s"] = cost.seconds_ordering;
  report["factor_s"] = factorise_s - cost.seconds_ordering;
  report["eigen_s"] = watch.lap();
  report["factor_nonzeros"] = cost.nonzeros;
  report["factor_flops"] = cost.flops;
  report["converged"] = pairs.status == linalg::EigenStatus::converged;
  report["worst_inverse_residual"] = pairs.inverse_residual.maxCoeff();
  for (const double lambda : pairs.lambda) {
    report["frequencies_hz"].push_back(std::sqrt(std::max(lambda, 0.0)) / (2.0 * std::numbers::pi));
  }
}

nlohmann::ordered_json run(const Options& options) {
  core::set_thread_count(options.threads);
  nlohmann::ordered_json report{{"program", "thinwall"}, {"threads", options.threads}};
  bench::Stopwatch total;
  bench::Stopwatch watch;
  const io::InpMesh part = io::read_inp(options.inp, 1.0);
  const std::vector<int>& fixed = io::node_set(part, options.fixed, options.inp).nodes;
  report["read_s"] = watch.lap();
  const fem::Assembled matrices = free_matrices(part, fixed);
  report["assembly_s"] = watch.lap();
  report["dofs"] = matrices.K.rows();
  report["nonzeros"] = matrices.K.nonZeros();
  if (!options.petsc_folder.empty()) {
    bench::write_petsc(std::filesystem::path(options.petsc_folder) / "K.petsc", matrices.K);
    bench::write_petsc(std::filesystem::path(options.petsc_folder) / "M.petsc", matrices.M);
    return report;
  }
  solve(matrices, options.modes, report);
  report["total_s"] = total.lap();
  report["peak_memory_bytes"] = bench::peak_memory_bytes();
  return report;
}

int parse_and_run(int argc, char** argv) {
  Options options;
  CLI::App app("From a mesh file to natural modes, stage by stage");
  app.add_option("file", options.inp, "mesh (.inp)")->required();
  app.add_option("--fixed", options.fixed, "node set that cannot move");
  app.add_option("--modes", options.modes, "how many")->check(CLI::Range(1, 10000));
  app.add_option("--threads", options.threads, "threads")->check(CLI::Range(1, 1024));
  app.add_option("--write-petsc", options.petsc_folder, "folder for K and M; nothing is solved");
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
    std::fprintf(stderr, "fem_modes: %s\n", error.what());
    return 1;
  }
}
