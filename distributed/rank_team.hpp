#pragma once
// The ranks of MPI that factorise large matrices in place of this process.

#include <filesystem>
#include <memory>
#include <string>

#include "linalg/external_factor.hpp"

namespace thinwall::distributed {

/// The program of the ranks, thinwall-mpi: that of the environment variable THINWALL_MPI, the one beside this program,
/// or that on the PATH; empty if there is none.
[[nodiscard]] std::filesystem::path rank_program();

/// One line on the ranks for people: that they are there, or what is to be installed.
[[nodiscard]] std::string ranks_in_words();

/// Options of a team.
struct TeamOptions {
  int ranks = 2;
  int threads = 1;        ///< of each rank
  bool on_disk = false;   ///< the factor goes to files in TMPDIR, and a rank holds its largest fronts only
  int least_rows = 5000;  ///< smaller matrices stay with this process, which is quicker for them
};

/// The largest share of a factor that a rank has, before and after.
struct RankCost {
  double forecast_bytes = 0.0, peak_bytes = 0.0;  ///< memory of the whole rank, which has other factors, too
  double forecast_s = 0.0, factor_s = 0.0;        ///< of the numeric phase
};

/// Processes of one MPI communicator, thinwall-mpi, started by mpirun (or what the environment variable THINWALL_MPIRUN
/// names, with its options: "srun --mpi=pmix"). They wait asleep for matrices. K stays with this process: it sends the
/// upper triangle to a scratch folder in TMPDIR, from which each rank reads its rows; MUMPS orders, factorises and
/// solves (docs/scaling.md).
class RankTeam {
 public:
  /// Starts the ranks. Throws UsageError if thinwall-mpi or mpirun is not there, or if the started processes are no
  /// communicator of so many ranks (an mpirun of another MPI than the library's); DataError if the scratch folder
  /// cannot be written or is not shared by all ranks. Cost: a third of a second.
  explicit RankTeam(const TeamOptions& options);
  /// Ends the ranks and removes the scratch folder.
  ~RankTeam();
  RankTeam(const RankTeam&) = delete;
  RankTeam& operator=(const RankTeam&) = delete;

  /// The factor of A: its memory is told before the numeric phase and compared with what is free on each machine.
  /// Throws MemoryLimitError with the number of ranks that would do; NumericalError if A is not positive definite or a
  /// rank dies; Interrupted. The team must outlive it.
  [[nodiscard]] std::unique_ptr<linalg::ExternalFactor> factorise(const linalg::SparseMatrix& A,
                                                                  const linalg::FactorOptions& options);

  /// The cost of the factor that was made last.
  [[nodiscard]] const RankCost& latest() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The ranks as the engine of every SparseCholesky of this process, as long as the object lives.
class DistributedFactors {
 public:
  explicit DistributedFactors(const TeamOptions& options);
  ~DistributedFactors();
  DistributedFactors(const DistributedFactors&) = delete;
  DistributedFactors& operator=(const DistributedFactors&) = delete;

  /// The cost of the factor that was made last.
  [[nodiscard]] const RankCost& latest() const { return team_.latest(); }

 private:
  RankTeam team_;
  linalg::Factoriser before_;
};

}  // namespace thinwall::distributed
