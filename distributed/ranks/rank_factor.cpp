#include "distributed/ranks/rank_factor.hpp"

#include <petscblaslapack.h>

#include <algorithm>
#include <fstream>
#include <string>
#include <vector>

#include "core/memory.hpp"
#include "distributed/matrix_file.hpp"
#include "distributed/open_file.hpp"
#include "distributed/ranks/petsc_call.hpp"

namespace thinwall::distributed {

namespace {

constexpr int metis = 5;              // ICNTL(7)
constexpr int spare_percent = 20;     // ICNTL(14): by how much MUMPS' working space exceeds its estimate

/// The share of the speed of its matrix products at which MUMPS factorises; measured (docs/scaling.md).
constexpr double share_of_product_speed = 0.5;

int rank() {
  int number = 0;
  MPI_Comm_rank(PETSC_COMM_WORLD, &number);
  return number;
}

int ranks() {
  int count = 0;
  MPI_Comm_size(PETSC_COMM_WORLD, &count);
  return count;
}

double reduced(double value, MPI_Op operation) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, PETSC_COMM_WORLD);
  return value;
}

/// A number that MUMPS gives as it is, or in millions if it is negative.
double counted(PetscInt value) {
  return value < 0 ? -1e6 * value : value;
}

/// The speed of a product of dense matrices on this rank while all ranks do one, flops a second.
double product_speed() {
  const PetscBLASInt n = 400;
  const std::vector<PetscScalar> a(static_cast<std::size_t>(n) * n, 1.0);
  std::vector<PetscScalar> c(a.size());
  const PetscScalar one = 1.0, zero = 0.0;
  double best = 0.0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const double start = MPI_Wtime();
    BLASgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &zero, c.data(), &n);
    best = std::max(best, 2.0 * n * n * n / (MPI_Wtime() - start));
  }
  return best;
}

/// The most memory that this process has held, bytes.
double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kibibytes = 0.0;
    if (word == "VmHWM:" && status >> kibibytes) return 1024.0 * kibibytes;
  }
  return 0.0;
}

/// Sets machine_bytes and free_bytes to those of the machine whose free memory is used to the largest share.
void compare_machines(double bytes, Forecast& forecast) {
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(PETSC_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  double needed = bytes;
  MPI_Allreduce(MPI_IN_PLACE, &needed, 1, MPI_DOUBLE, MPI_SUM, machine);
  MPI_Comm_free(&machine);
  double free = core::available_memory_bytes();
  struct {
    double share;
    int rank;
  } worst{free > 0.0 ? needed / free : 0.0, rank()};
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, PETSC_COMM_WORLD);
  MPI_Bcast(&needed, 1, MPI_DOUBLE, worst.rank, PETSC_COMM_WORLD);
  MPI_Bcast(&free, 1, MPI_DOUBLE, worst.rank, PETSC_COMM_WORLD);
  forecast.machine_bytes = needed;
  forecast.free_bytes = free;
}

}  // namespace

RankFactor::RankFactor(const std::filesystem::path& matrix) {
  rows_ = rows_of(matrix);
  first_ = rows_ * rank() / ranks();
  last_ = rows_ * (rank() + 1) / ranks();
  const auto own = static_cast<PetscInt>(last_ - first_), all = static_cast<PetscInt>(rows_);
  const UpperRows rows = read_upper_rows(matrix, first_, last_);
  require(MatCreate(PETSC_COMM_WORLD, &A_));
  require(MatSetSizes(A_, own, own, all, all));
  require(MatSetType(A_, MATSBAIJ));
  require(MatSeqSBAIJSetPreallocationCSR(A_, 1, rows.start.data(), rows.column.data(), rows.value.data()));
  require(MatMPISBAIJSetPreallocationCSR(A_, 1, rows.start.data(), rows.column.data(), rows.value.data()));
  require(MatSetOption(A_, MAT_SPD, PETSC_TRUE));
}

RankFactor::~RankFactor() {
  MatDestroy(&F_);
  MatDestroy(&A_);
}

Forecast RankFactor::analyse() {
  const double start = MPI_Wtime();
  require(MatGetFactor(A_, MATSOLVERMUMPS, MAT_FACTOR_CHOLESKY, &F_));
  require(MatFactorInfoInitialize(&info_));
  require(MatMumpsSetIcntl(F_, 7, metis));
  require(MatMumpsSetIcntl(F_, 14, spare_percent));
  require(MatCholeskyFactorSymbolic(F_, A_, nullptr, &info_));
  Forecast forecast;
  PetscInt megabytes = 0, entries = 0;
  require(MatMumpsGetInfo(F_, 15, &megabytes));
  require(MatMumpsGetInfog(F_, 20, &entries));
  require(MatMumpsGetRinfog(F_, 1, &forecast.flops));
  const double bytes = 1e6 * megabytes / (1.0 + 0.01 * spare_percent);  // the spare space is never touched
  compare_machines(bytes, forecast);
  forecast.least_bytes = reduced(core::held_memory_bytes() + bytes, MPI_MIN);
  forecast.most_bytes = reduced(core::held_memory_bytes() + bytes, MPI_MAX);
  forecast.entries = counted(entries);
  forecast.analysis_s = MPI_Wtime() - start;
  const double speed = reduced(product_speed(), MPI_MIN);
  forecast.seconds = forecast.flops / (share_of_product_speed * speed * ranks());
  return forecast;
}

Outcome RankFactor::factorise() {
  const double start = MPI_Wtime();
  require(MatCholeskyFactorNumeric(F_, A_, &info_));
  require(MatDestroy(&A_));
  Outcome outcome;
  PetscInt error = 0, detail = 0, negative = 0;
  require(MatMumpsGetInfog(F_, 1, &error));
  require(MatMumpsGetInfog(F_, 2, &detail));
  require(MatMumpsGetInfog(F_, 12, &negative));
  outcome.error = static_cast<int>(error);
  outcome.detail = static_cast<int>(detail);
  outcome.negative_pivots = static_cast<int>(negative);
  outcome.seconds = MPI_Wtime() - start;
  outcome.peak_bytes = reduced(peak_bytes(), MPI_MAX);
  return outcome;
}

void RankFactor::solve(const std::filesystem::path& path, int count) {
  const auto own = static_cast<std::size_t>(last_ - first_);
  std::vector<PetscScalar> b(own * static_cast<std::size_t>(count)), x(b.size());
  const auto place = [&](int column) {
    return sizeof(double) * static_cast<std::size_t>(first_ + rows_ * column);
  };
  {
    const OpenFile file(path, OpenFile::Access::read);
    for (int j = 0; j < count; ++j)
      file.read(b.data() + own * static_cast<std::size_t>(j), sizeof(double) * own, place(j));
  }
  Mat B = nullptr, X = nullptr;
  const auto n = static_cast<PetscInt>(own), all = static_cast<PetscInt>(rows_);
  require(MatCreateDense(PETSC_COMM_WORLD, n, PETSC_DECIDE, all, count, b.data(), &B));
  require(MatCreateDense(PETSC_COMM_WORLD, n, PETSC_DECIDE, all, count, x.data(), &X));
  require(MatMatSolve(F_, B, X));
  require(MatDestroy(&B));
  require(MatDestroy(&X));
  MPI_Barrier(PETSC_COMM_WORLD);  // no rank writes before all have read
  const OpenFile file(path, OpenFile::Access::write);
  for (int j = 0; j < count; ++j)
    file.write(x.data() + own * static_cast<std::size_t>(j), sizeof(double) * own, place(j));
}

}  // namespace thinwall::distributed
