#pragma once
// The factor of a symmetric positive definite matrix on all ranks, by PETSc and MUMPS.

#include <petscmat.h>

#include <cstdint>
#include <filesystem>

namespace thinwall::distributed {

/// What MUMPS forecasts after its analysis.
struct Forecast {
  double machine_bytes = 0.0;  ///< beside what is held now, on the machine whose memory is used most
  double free_bytes = 0.0;     ///< there
  double least_bytes = 0.0, most_bytes = 0.0;  ///< peak of a rank: what it holds now and MUMPS' INFO(15)
  double seconds = 0.0;                        ///< of the numeric phase
  double entries = 0.0;                        ///< of the factor, INFOG(20)
  double flops = 0.0;                          ///< RINFOG(1)
  double analysis_s = 0.0;
};

/// What the numeric phase has come to. `negative_pivots` is INFOG(12), `error` INFOG(1), a negative number of MUMPS'
/// manual, section 8.
struct Outcome {
  double seconds = 0.0;
  double peak_bytes = 0.0;  ///< the largest of all ranks
  int negative_pivots = 0;
  int error = 0, detail = 0;
};

/// A matrix and its factor; each rank holds its share of both. All functions are called by all ranks together. Errors
/// of PETSc are thrown as std::runtime_error, those of files as core::DataError.
class RankFactor {
 public:
  /// Reads the rank's rows of a matrix (matrix_file.hpp).
  explicit RankFactor(const std::filesystem::path& matrix);
  ~RankFactor();
  RankFactor(const RankFactor&) = delete;
  RankFactor& operator=(const RankFactor&) = delete;

  /// Orders the matrix by METIS and counts the factor.
  [[nodiscard]] Forecast analyse();
  /// The numeric phase.
  [[nodiscard]] Outcome factorise();
  /// Replaces B (n × columns, by columns) in a file by A⁻¹ B; each rank reads and writes its rows.
  void solve(const std::filesystem::path& columns, int count);

 private:
  Mat A_ = nullptr, F_ = nullptr;
  MatFactorInfo info_{};
  std::int64_t rows_ = 0, first_ = 0, last_ = 0;
};

}  // namespace thinwall::distributed
