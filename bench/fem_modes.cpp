// From a mesh file to natural modes, stage by stage, beside the peers (bench/run fem). Steel, SI.
//   fem_modes FILE.inp [--fixed SET] [--modes N] [--threads N] [--write-petsc FOLDER | --craig-bampton N]
// prints one JSON object. With --write-petsc it writes the assembled K and M of the free DOFs for bench/slepc_modes and
// stops; with --craig-bampton it times the reduction to N interface DOFs and as many modes as told beside the modes.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
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
#include "io/mesh/inp.hpp"
#include "linalg/eigenpairs.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "reduction/methods/craig_bampton.hpp"

namespace {

using namespace thinwall;

const fem::Material steel{210e9, 0.3, 7850.0};

struct Options {
  std::string inp;
  std::string fixed = "FIXED";
  int modes = 10;
  int threads = 2;
  std::string petsc_folder;
  int interface_dofs = 0;
};

/// K and M of the free DOFs.
fem::Assembled free_matrices(const mesh::SolidMesh& part, const std::vector<int>& fixed_nodes) {
  std::vector<int> fixed;
  for (const int node : fixed_nodes) {
    for (int axis = 0; axis < 3; ++axis) fixed.push_back(3 * node + axis);
  }
  return fem::assemble(part.nodes, steel, fixed);
}

linalg::SparseCholesky factorised(const fem::Assembled& matrices) {
  std::vector<int> node_of_row;
  for (const int row : matrices.free_rows) node_of_row.push_back(row / 3);
  return linalg::SparseCholesky(matrices.K, node_of_row);
}

/// Keeps a reference.
linalg::ShiftedInverse inverse_of(const linalg::SparseCholesky& factor) {
  return {[&factor](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factor.solve(B); }, 0.0};
}

void solve(const fem::Assembled& matrices, int modes, nlohmann::ordered_json& report) {
  bench::Stopwatch watch;
  const linalg::SparseCholesky factor = factorised(matrices);
  const double factorise_s = watch.lap();
  const linalg::FactorStatistics& cost = factor.statistics();
  const linalg::ShiftedInverse inverse = inverse_of(factor);
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

/// The three displacements of nodes that are spread evenly over the part's numbering. Nodes are fixed as a whole, so
/// that rows come in threes.
reduction::Interface spread_interface(Eigen::Index rows, int dofs) {
  reduction::Interface interface;
  std::vector<Eigen::Triplet<double>> entries;
  const Eigen::Index points = (dofs + 2) / 3;
  for (int k = 0; k < dofs; ++k) {
    const Eigen::Index node = (k / 3 + 1) * (rows / 3) / (points + 1);
    entries.emplace_back(static_cast<int>(3 * node + k % 3), k, 1.0);
    interface.dofs.push_back(
        {"P" + std::to_string(k / 3), Eigen::Vector3d::Unit(k % 3), dynamics::DofKind::translation});
  }
  interface.W.resize(rows, dofs);
  interface.W.setFromTriplets(entries.begin(), entries.end());
  return interface;
}

/// Seconds of the factor, of the modes alone and of the reduction, on the same matrices: medians of three.
void reduce(const fem::Assembled& matrices, const Options& options, nlohmann::ordered_json& report) {
  const reduction::Interface interface = spread_interface(matrices.K.rows(), options.interface_dofs);
  std::array<std::vector<double>, 3> seconds;
  bool converged = true;
  for (int repeat = 0; repeat < 3; ++repeat) {
    bench::Stopwatch watch;
    const linalg::SparseCholesky factor = factorised(matrices);
    seconds[0].push_back(watch.lap());
    const linalg::ShiftedInverse inverse = inverse_of(factor);
    const auto pairs = linalg::lowest_eigenpairs(matrices.K, matrices.M, inverse, options.modes);
    seconds[1].push_back(watch.lap());
    const auto reduced =
        reduction::craig_bampton(matrices.K, matrices.M, inverse, interface, {.modes = options.modes, .up_to_hz = {}});
    seconds[2].push_back(watch.lap());
    converged =
        converged && pairs.status == linalg::EigenStatus::converged && reduced.status == linalg::EigenStatus::converged;
  }
  for (auto& repeats : seconds) std::sort(repeats.begin(), repeats.end());
  report["factorise_s"] = seconds[0][1];
  report["modes_s"] = seconds[1][1];
  report["craig_bampton_s"] = seconds[2][1];
  report["interface_dofs"] = options.interface_dofs;
  report["modes"] = options.modes;
  report["converged"] = converged;
}

nlohmann::ordered_json run(const Options& options) {
  core::set_thread_count(options.threads);
  nlohmann::ordered_json report{{"program", "thinwall"}, {"threads", options.threads}};
  bench::Stopwatch total;
  bench::Stopwatch watch;
  const mesh::SolidMesh part = io::read_inp(options.inp, 1.0);
  const std::vector<int>& fixed = mesh::node_set(part, options.fixed, options.inp).nodes;
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
  if (options.interface_dofs > 0) {
    reduce(matrices, options, report);
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
  app.add_option("--craig-bampton", options.interface_dofs, "time the reduction to so many interface DOFs")
      ->check(CLI::Range(1, 1000));
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
