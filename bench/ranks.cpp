// Factor and ten modes of a clamped steel plate by this process or by ranks of MPI, for `bench/run ranks`.
//   bench_ranks WIDTH_M RANKS THREADS DISK     elements of order 2, 4 mm; 0 ranks: this process factorises
// prints one JSON object. Seconds are wall time; processor time is for the caller to measure.

#include <cstdlib>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>

#include "bench/stages.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "distributed/rank_team.hpp"
#include "fem/supports.hpp"
#include "linalg/eigenpairs.hpp"
#include "mesh/planar/prism_mesh.hpp"

namespace {

using namespace thinwall;

fem::Model clamped_plate(double width_m) {
  mesh::PrismMeshOptions options;
  options.size_m = 0.004;
  const mesh::Prism plate{{{0, 0}, {0.45, 0}, {0.45, width_m}, {0, width_m}}, {}, 0.0, 0.006, {}};
  const fem::Support left{"left", mesh::PlaneRegion{{0, 0, 0}, {1, 0, 0}}, {0, 1, 2}};
  const fem::Support right{"right", mesh::PlaneRegion{{0.45, 0, 0}, {1, 0, 0}}, {0, 1, 2}};
  return fem::supported_model(mesh::mesh_prism(plate, options), 2, {210e9, 0.3, 7850.0}, {left, right});
}

nlohmann::ordered_json run(double width_m, int ranks, int threads, bool on_disk) {
  core::set_thread_count(threads);
  bench::Stopwatch watch;
  const fem::Model model = clamped_plate(width_m);
  nlohmann::ordered_json report{{"dofs", model.K.rows()}, {"assembly_s", watch.lap()}};
  std::unique_ptr<distributed::DistributedFactors> team;
  if (ranks > 0)
    team = std::make_unique<distributed::DistributedFactors>(
        distributed::TeamOptions{ranks, std::max(1, threads / ranks), on_disk, 1});
  report["start_s"] = watch.lap();
  const fem::Factored factored = fem::factorise(model);
  report["factor_s"] = watch.lap();
  const auto pairs = linalg::lowest_eigenpairs(model.K, model.M, fem::inverse_of(factored), 10);
  report["eigen_s"] = watch.lap();
  report["entries"] = factored.factor.statistics().nonzeros;
  report["converged"] = pairs.status == linalg::EigenStatus::converged;
  report["worst_residual"] = linalg::residuals(model.K, model.M, pairs).maxCoeff();
  report["first_hz"] = std::sqrt(pairs.lambda(0)) / (2.0 * std::numbers::pi);
  report["own_peak_bytes"] = bench::peak_memory_bytes();
  if (team) {
    report["rank_peak_bytes"] = team->latest().peak_bytes;
    report["rank_forecast_bytes"] = team->latest().forecast_bytes;
    report["numeric_s"] = team->latest().factor_s;
    report["forecast_s"] = team->latest().forecast_s;
  }
  return report;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: bench_ranks WIDTH_M RANKS THREADS DISK\n";
    return 2;
  }
  core::keep_freed_memory();  // as the program does
  try {
    std::cout << run(std::atof(argv[1]), std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]) != 0).dump()
              << '\n';
  } catch (const std::exception& error) {
    std::cerr << "bench_ranks: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
