// Whatever bytes a matrix file holds: it is read or refused with an error of ours, soon. The same readers are under
// libFuzzer in fuzz/, from the same corpus.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/matrices/dmig.hpp"
#include "io/matrices/mat4.hpp"
#include "io/matrices/matrix_market.hpp"
#include "io/matrices/matrix_triplets.hpp"
#include "io/matrices/op2.hpp"
#include "io/matrices/op4.hpp"
#include "io/matrices/superelement.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::test::matrix_robustness_test {

namespace {

struct Format {
  std::string name;
  std::function<void(std::string_view)> read;
};

void assemble(const MatrixEntries& matrix) {
  for (const auto& entry : matrix.entries) {
    ASSERT_TRUE(entry.row >= 0 && entry.row < matrix.size && entry.column >= 0 && entry.column < matrix.size);
    ASSERT_TRUE(std::isfinite(entry.value));
  }
  if (matrix.size <= 100000) (void)whole_matrix(matrix);
}

void assemble(const LabelledEntries& labelled) {
  assemble(in_rows(labelled, dofs_of({&labelled})));
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {"matrix_market", [](std::string_view bytes) { assemble(matrix_market_entries(bytes, "x")); }},
      {"triplets", [](std::string_view bytes) { assemble(triplet_entries(bytes, "x")); }},
      {"abaqus_matrix", [](std::string_view bytes) { assemble(labelled_triplets(bytes, "x")); }},
      {"ccx_dof", [](std::string_view bytes) { (void)ccx_dofs(bytes, "x"); }},
      {"dmig",
       [](std::string_view bytes) {
         for (const DmigMatrix& matrix : read_dmig(bytes, "x").matrices) assemble(matrix.labelled);
       }},
      {"op4",
       [](std::string_view bytes) {
         for (const NastranMatrix& matrix : read_op4(bytes, "x"))
           assemble(MatrixEntries{"x", matrix.rows, matrix.entries, matrix.form == 6});
       }},
      {"op2",
       [](std::string_view bytes) {
         for (const NastranMatrix& matrix : read_op2(bytes, "x"))
           assemble(MatrixEntries{"x", matrix.rows, matrix.entries, matrix.form == 6});
       }},
      {"superelement", [](std::string_view bytes) { (void)read_superelement(bytes, "x"); }},
      {"mat4", [](std::string_view bytes) {
         (void)mat4_variables(bytes, {"K", "M", "dof_node"}, "x");
       }}};
  return all;
}

std::vector<std::string> corpus_of(const std::string& format) {
  std::vector<std::filesystem::path> paths;
  const auto folder = std::filesystem::path(THINWALL_SOURCE_DIR) / "fuzz" / "corpus" / format;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const auto& path : paths) files.push_back(core::read_file(path));
  return files;
}

/// True if the bytes were read, false if they were refused; anything else fails the test.
bool reads(const Format& format, const std::string& bytes) {
  try {
    format.read(bytes);
    return true;
  } catch (const core::DataError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
  return false;
}

/// Digits into digits, a few bytes into any, a piece cut out or doubled.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t bound) { return random() % std::max<std::size_t>(bound, 1); };
  if (bytes.empty()) return bytes;
  switch (below(4)) {
    case 0:
      return bytes.erase(below(bytes.size()), 1 + below(40));
    case 1:
      return bytes.insert(below(bytes.size()), bytes.substr(below(bytes.size()), 1 + below(60)));
    case 2:
      for (std::size_t k = 0; k < 30; ++k) {
        char& c = bytes[below(bytes.size())];
        if (c >= '0' && c <= '9') c = static_cast<char>('0' + below(10));
      }
      return bytes;
    default:
      for (std::size_t k = 0; k <= below(4); ++k) bytes[below(bytes.size())] = static_cast<char>(below(256));
      return bytes;
  }
}

}  // namespace

TEST(MatrixFileBytes, OfTheCorpusAreReadOrRefused) {
  for (const Format& format : formats()) {
    const std::vector<std::string> corpus = corpus_of(format.name);
    const auto read =
        std::count_if(corpus.begin(), corpus.end(), [&](const auto& bytes) { return reads(format, bytes); });
    EXPECT_GE(read, 3) << format.name << ": a corpus of files that are refused reaches nothing";
    EXPECT_LT(read, std::ssize(corpus)) << format.name << ": nothing is refused";
  }
}

TEST(MatrixFileBytes, CutAnywhereAreReadOrRefused) {
  for (const Format& format : formats())
    for (const std::string& bytes : corpus_of(format.name))
      for (std::size_t size = 0; size < bytes.size(); ++size) (void)reads(format, bytes.substr(0, size));
}

TEST(MatrixFileBytes, MutatedFiftyThousandTimesAreReadOrRefusedInTime) {
  for (const Format& format : formats()) {
    const std::vector<std::string> corpus = corpus_of(format.name);
    std::mt19937 random(6);
    std::size_t read = 0;
    const double start = tests::processor_seconds();
    for (int trial = 0; trial < 50000; ++trial) {
      std::string bytes = corpus[random() % corpus.size()];
      for (std::size_t k = 0; k <= random() % 3; ++k) bytes = mutated(bytes, random);
      read += reads(format, bytes) ? 1 : 0;
    }
    std::printf("%s: 50000 mutated files in %.1f s, %zu of them read\n", format.name.c_str(),
                tests::processor_seconds() - start, read);
    EXPECT_LT(tests::processor_seconds() - start, 20.0);
    EXPECT_GT(read, 500U);
  }
}

// Counts and indices that a file states ask for no memory that its bytes do not fill.
TEST(MatrixFileBytes, ThatStateMoreThanThereIsAreRefusedAtOnce) {
  const double start = tests::processor_seconds();
  const std::string banner = "%%MatrixMarket matrix ";
  EXPECT_FALSE(reads(formats()[0], banner + "coordinate real general\n2000000000 2000000000 2000000000\n1 1 1.0\n"));
  EXPECT_FALSE(reads(formats()[0], banner + "array real general\n2000000000 2000000000\n1.0\n"));
  EXPECT_FALSE(reads(formats()[0], banner + "coordinate real general\n99999999999 99999999999 1\n1 1 1.0\n"));
  EXPECT_TRUE(reads(formats()[1], "2000000000 2000000000 1.0\n"));  // one entry; a DOF table of two rows refuses it
  EXPECT_TRUE(reads(formats()[2], "2000000000 1 2000000000 1 1.0\n"));
  EXPECT_LT(tests::processor_seconds() - start, 20.0);
}

}  // namespace thinwall::io::test::matrix_robustness_test
