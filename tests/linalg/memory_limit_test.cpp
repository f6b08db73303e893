// The memory of a factor is known before it is allocated.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <string>

#include "linalg/sparse_cholesky.hpp"

namespace thinwall::linalg::memory_limit_test {
namespace {

/// The seven-point Laplacian on n³ points, shifted to be well conditioned: the fill of a solid.
SparseMatrix laplacian(int n) {
  std::vector<Eigen::Triplet<double>> entries;
  const int steps[] = {1, n, n * n};
  for (int row = 0; row < n * n * n; ++row) {
    entries.emplace_back(row, row, 7.0);
    const int place[] = {row % n, row / n % n, row / (n * n)};
    for (int axis = 0; axis < 3; ++axis) {
      if (place[axis] + 1 == n) continue;
      entries.emplace_back(row, row + steps[axis], -1.0);
      entries.emplace_back(row + steps[axis], row, -1.0);
    }
  }
  SparseMatrix A(n * n * n, n * n * n);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

std::vector<int> rows_as_nodes(const SparseMatrix& A) {
  std::vector<int> nodes(static_cast<std::size_t>(A.rows()));
  for (std::size_t row = 0; row < nodes.size(); ++row) nodes[row] = static_cast<int>(row);
  return nodes;
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

TEST(MemoryLimit, IsReportedWithTheNeedBeforeTheFactorIsAllocated) {
  const SparseMatrix A = laplacian(40);
  const auto nodes = rows_as_nodes(A);
  const double before = peak_bytes();
  try {
    const SparseCholesky factor(A, nodes, {.memory_limit_bytes = 5e7});
    FAIL() << "a factor of " << factor.statistics().bytes << " bytes";
  } catch (const MemoryLimitError& error) {
    const double taken = peak_bytes() - before;
    std::printf("memory limit 50 MB: needed %.0f MB, taken %.0f MB: %s\n", error.needed_bytes * 1e-6, taken * 1e-6,
                error.what());
    EXPECT_EQ(error.limit_bytes, 5e7);
    EXPECT_GT(error.needed_bytes, 1.2e8);
#if !defined(THINWALL_ADDRESS_SANITIZER)  // which keeps freed memory
    EXPECT_LT(taken, 0.5 * error.needed_bytes) << "the ordering and the symbolic factor only";
#endif
    EXPECT_NE(std::string(error.what()).find("64000 rows"), std::string::npos) << error.what();
  }
}

TEST(MemoryLimit, NeedIsWhatTheFactorTakes) {
  const SparseMatrix A = laplacian(20);
  const auto nodes = rows_as_nodes(A);
  const double bytes = SparseCholesky(A, nodes).statistics().bytes;
  EXPECT_GT(bytes, 8.0 * SparseCholesky(A, nodes).statistics().nonzeros);
  EXPECT_NO_THROW(SparseCholesky(A, nodes, {.memory_limit_bytes = bytes}));
  EXPECT_THROW(SparseCholesky(A, nodes, {.memory_limit_bytes = bytes - 1.0}), MemoryLimitError);
}

}  // namespace
}  // namespace thinwall::linalg::memory_limit_test
