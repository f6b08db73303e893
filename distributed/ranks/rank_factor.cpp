#include "distributed/ranks/rank_factor.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "distributed/matrix_file.hpp"
#include "distributed/open_file.hpp"

extern "C" void dgemm_(const char* transa, const char* transb, const int* m, const int* n, const int* k,
                       const double* alpha, const double* a, const int* lda, const double* b, const int* ldb,
                       const double* beta, double* c, const int* ldc);

namespace thinwall::distributed {

namespace {

namespace fs = std::filesystem;

/// Jobs of MUMPS.
constexpr int begin = -1, end = -2, analysis = 1, factorisation = 2, solution = 3;

/// By how much MUMPS' working space exceeds its estimate, ICNTL(14), per cent.
constexpr int spare_percent = 20;

/// The share of the speed of its matrix products at which MUMPS factorises; measured (docs/scaling.md).
constexpr double share_of_product_speed = 0.5;

int rank() {
  int number = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &number);
  return number;
}

int ranks() {
  int count = 0;
  MPI_Comm_size(MPI_COMM_WORLD, &count);
  return count;
}

double reduced(double value, MPI_Op operation) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_DOUBLE, operation, MPI_COMM_WORLD);
  return value;
}

/// A number that MUMPS gives as it is, or in millions if it is negative.
double counted(int value) {
  return value < 0 ? -1e6 * value : value;
}

/// The speed of a product of dense matrices on this rank while all ranks do one, flops a second.
double product_speed() {
  const int n = 400;
  const double one = 1.0, zero = 0.0;
  const std::vector<double> a(static_cast<std::size_t>(n) * n, 1.0);
  std::vector<double> c(a.size());
  double best = 0.0;
  for (int attempt = 0; attempt < 3; ++attempt) {
    const double start = MPI_Wtime();
    dgemm_("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &zero, c.data(), &n);
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
  MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  double needed = bytes;
  MPI_Allreduce(MPI_IN_PLACE, &needed, 1, MPI_DOUBLE, MPI_SUM, machine);
  MPI_Comm_free(&machine);
  double free = core::available_memory_bytes();
  struct {
    double share;
    int rank;
  } worst{free > 0.0 ? needed / free : 0.0, rank()};
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE_INT, MPI_MAXLOC, MPI_COMM_WORLD);
  MPI_Bcast(&needed, 1, MPI_DOUBLE, worst.rank, MPI_COMM_WORLD);
  MPI_Bcast(&free, 1, MPI_DOUBLE, worst.rank, MPI_COMM_WORLD);
  forecast.machine_bytes = needed;
  forecast.free_bytes = free;
}

}  // namespace

RankFactor::RankFactor(const fs::path& matrix, const fs::path& order) {
  const std::int64_t all = rows_of(matrix), first = all * rank() / ranks(), last = all * (rank() + 1) / ranks();
  UpperRows rows = read_upper_rows(matrix, first, last);
  row_.reserve(rows.column.size());
  for (std::size_t i = 0; i + 1 < rows.start.size(); ++i)
    row_.insert(row_.end(), static_cast<std::size_t>(rows.start[i + 1] - rows.start[i]),
                static_cast<int>(first + static_cast<std::int64_t>(i) + 1));
  column_ = std::move(rows.column);
  for (int& column : column_) ++column;  // MUMPS counts from 1
  value_ = std::move(rows.value);
  if (rank() == 0) {
    order_.resize(static_cast<std::size_t>(all));
    OpenFile(order, OpenFile::Access::read).read(order_.data(), sizeof(int) * order_.size(), 0);
  }
  mumps_.sym = 1;  // positive definite
  mumps_.par = 1;  // the first rank works, too
  mumps_.comm_fortran = static_cast<MUMPS_INT>(MPI_Comm_c2f(MPI_COMM_WORLD));
  call(begin);
  mumps_.n = static_cast<MUMPS_INT>(all);
  mumps_.nnz_loc = static_cast<MUMPS_INT8>(value_.size());
  mumps_.irn_loc = row_.data();
  mumps_.jcn_loc = column_.data();
  mumps_.a_loc = value_.data();
  mumps_.perm_in = order_.data();
}

RankFactor::~RankFactor() {
  mumps_.job = end;
  dmumps_c(&mumps_);
}

/// Errors of the numeric phase are for factorise() to tell; no other job may fail.
void RankFactor::call(int job) {
  mumps_.job = job;
  dmumps_c(&mumps_);
  if (job == factorisation || mumps_.infog[0] >= 0) return;
  throw core::NumericalError("MUMPS ends job " + std::to_string(job) + " with error " +
                             std::to_string(mumps_.infog[0]) + " (" + std::to_string(mumps_.infog[1]) +
                             ") of its manual: take more ranks or more memory");
}

Forecast RankFactor::analyse(const fs::path& on_disk) {
  const double start = MPI_Wtime();
  const auto option = [this](int number) -> MUMPS_INT& { return mumps_.icntl[number - 1]; };
  for (const int output : {1, 2, 3, 4}) option(output) = 0;
  option(7) = 1;  // the order is given
  option(14) = spare_percent;
  option(18) = 3;  // each rank has entries of its own
  option(28) = 1;  // the first rank analyses
  option(22) = on_disk.empty() ? 0 : 1;
  if (on_disk.native().size() >= sizeof mumps_.ooc_tmpdir)
    throw core::DataError("TMPDIR: MUMPS takes names of folders of " + std::to_string(sizeof mumps_.ooc_tmpdir - 1) +
                          " characters at most, and " + on_disk.string() + " has more: name a shorter one");
  std::strncpy(mumps_.ooc_tmpdir, on_disk.c_str(), sizeof mumps_.ooc_tmpdir - 1);
  call(analysis);
  Forecast forecast;
  const double bytes =
      1e6 * mumps_.info[on_disk.empty() ? 14 : 16] / (1.0 + 0.01 * spare_percent);  // the spare space is never touched
  compare_machines(bytes, forecast);
  forecast.least_bytes = reduced(core::held_memory_bytes() + bytes, MPI_MIN);
  forecast.most_bytes = reduced(core::held_memory_bytes() + bytes, MPI_MAX);
  forecast.entries = counted(mumps_.infog[19]);
  forecast.flops = mumps_.rinfog[0];
  forecast.analysis_s = MPI_Wtime() - start;
  const double speed = reduced(product_speed(), MPI_MIN);
  forecast.seconds = forecast.flops / (share_of_product_speed * speed * ranks());
  return forecast;
}

Outcome RankFactor::factorise() {
  const double start = MPI_Wtime();
  call(factorisation);
  for (std::vector<int>* list : {&row_, &column_, &order_}) std::vector<int>().swap(*list);
  std::vector<double>().swap(value_);
  Outcome outcome;
  outcome.error = mumps_.infog[0];
  outcome.detail = mumps_.infog[1];
  outcome.negative_pivots = mumps_.infog[11];
  outcome.seconds = MPI_Wtime() - start;
  outcome.peak_bytes = reduced(peak_bytes(), MPI_MAX);
  return outcome;
}

void RankFactor::solve(const fs::path& path, int count) {
  std::vector<double> columns(rank() == 0 ? static_cast<std::size_t>(mumps_.n) * static_cast<std::size_t>(count) : 0);
  const std::size_t bytes = sizeof(double) * columns.size();
  if (rank() == 0) OpenFile(path, OpenFile::Access::read).read(columns.data(), bytes, 0);
  mumps_.rhs = columns.data();
  mumps_.nrhs = count;
  mumps_.lrhs = mumps_.n;
  call(solution);
  if (rank() != 0) return;
  OpenFile written(path, OpenFile::Access::write);
  written.write(columns.data(), bytes, 0);
  written.finish();
}

}  // namespace thinwall::distributed
