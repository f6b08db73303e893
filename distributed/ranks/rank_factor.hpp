#pragma once
// The factor of a symmetric positive definite matrix on all ranks, by MUMPS.

#include <dmumps_c.h>
#include <mpi.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace thinwall::distributed {

/// The forecast of MUMPS after its analysis.
struct Forecast {
  double machine_bytes = 0.0;  ///< beside what is held now, on the machine whose memory is used most
  double free_bytes = 0.0;     ///< there
  double least_bytes = 0.0,
         most_bytes = 0.0;  ///< peak of a rank: what it holds now and MUMPS' INFO(15), on disk INFO(17)
  double seconds = 0.0;     ///< of the numeric phase
  double entries = 0.0;     ///< of the factor, INFOG(20)
  double flops = 0.0;       ///< RINFOG(1)
  double analysis_s = 0.0;
};

/// The outcome of the numeric phase. `negative_pivots` is INFOG(12); `error` and `detail` are INFOG(1) and (2), of
/// which a negative error is explained in section 8 of MUMPS' manual.
struct Outcome {
  double seconds = 0.0;
  double peak_bytes = 0.0;  ///< the largest of all ranks
  int negative_pivots = 0;
  int error = 0, detail = 0;
};

/// A matrix and its factor; each rank of MPI_COMM_WORLD holds its share of both. All functions are called by all ranks
/// together.
class RankFactor {
 public:
  /// Reads the rank's rows of a matrix (matrix_file.hpp); the first rank reads the order, for each row its place in the
  /// elimination, from 1 on, 32 bits each. Throws DataError for files that cannot be read.
  RankFactor(const std::filesystem::path& matrix, const std::filesystem::path& order);
  ~RankFactor();
  RankFactor(const RankFactor&) = delete;
  RankFactor& operator=(const RankFactor&) = delete;

  /// Counts the factor, which goes to files in the folder `on_disk`, or stays in memory if it is empty. Throws
  /// NumericalError with MUMPS' code if the analysis fails.
  [[nodiscard]] Forecast analyse(const std::filesystem::path& on_disk);
  /// The numeric phase.
  [[nodiscard]] Outcome factorise();
  /// Replaces B (n × count, by columns) in a file by A⁻¹ B; the first rank reads and writes it. Throws DataError, and
  /// NumericalError with MUMPS' code.
  void solve(const std::filesystem::path& columns, int count);

 private:
  void call(int job);
  DMUMPS_STRUC_C mumps_{};
  std::vector<int> row_, column_, order_;
  std::vector<double> value_;
};

}  // namespace thinwall::distributed
