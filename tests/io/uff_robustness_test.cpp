// Whatever bytes a universal file holds: it is read or refused with an error of ours, soon, and without more memory
// than a small multiple of its size. The same reader is under libFuzzer in fuzz/uff_fuzz.cpp, from the same corpus.

#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/frf/uff.hpp"
#include "io/frf/uff_mesh.hpp"
#include "io/frf/uff_shapes.hpp"
#include "scratch_folder.hpp"
#include "tests/processor_time.hpp"
#include "uff_bytes.hpp"

namespace thinwall::io::test::uff_robustness_test {

namespace {

const std::filesystem::path corpus = std::filesystem::path(THINWALL_SOURCE_DIR) / "fuzz" / "corpus" / "uff";

std::vector<std::string> corpus_files() {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(corpus)) paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<std::string> files;
  for (const auto& path : paths) files.push_back(core::read_file(path));
  return files;
}

/// True if the bytes were read, false if they were refused; any other exception fails the test.
template <typename Read>
bool reads_by(Read read) {
  try {
    (void)read();
    return true;
  } catch (const core::DataError&) {
  } catch (const core::InputError&) {
  }
  return false;
}

/// As FRFs, geometry or mode shapes.
bool reads(const std::string& bytes) {
  const bool frfs = reads_by([&bytes] { return response_matrix(uff_entries(bytes, "x")); });
  const bool mesh = reads_by([&bytes] { return uff_mesh(bytes, "x"); });
  const bool shapes = reads_by([&bytes] { return uff_shapes(bytes, "x"); });
  return frfs || mesh || shapes;
}

/// One to eight bytes changed, a piece cut out, doubled or moved, or the end cut off.
std::string mutated(std::string bytes, std::mt19937& random) {
  const auto below = [&random](std::size_t bound) { return random() % std::max<std::size_t>(bound, 1); };
  const auto piece = [&](std::size_t longest) { return bytes.substr(below(bytes.size()), 1 + below(longest)); };
  switch (below(8)) {
    case 0:
      return bytes.substr(0, below(bytes.size()));
    case 1:
      return bytes.erase(below(bytes.size()), 1 + below(200));
    case 2:
      return bytes.insert(below(bytes.size()), piece(400));
    case 3:
    case 4:
    case 5: {
      // Digits into digits: headings stay readable and state something else.
      for (std::size_t found = 0, wanted = 1 + below(6), tries = 0; found < wanted && tries < 100; ++tries) {
        char& c = bytes[below(bytes.size())];
        if (c < '0' || c > '9') continue;
        c = static_cast<char>('0' + below(10));
        ++found;
      }
      return bytes;
    }
    default:
      for (std::size_t k = 0; k <= below(8); ++k) bytes[below(bytes.size())] = static_cast<char>(below(256));
      return bytes;
  }
}

}  // namespace

TEST(UniversalFileBytes, OfTheCorpusAreReadOrRefused) {
  const std::vector<std::string> files = corpus_files();
  ASSERT_GE(files.size(), 8U);
  std::size_t read = 0;
  for (const std::string& bytes : files) read += reads(bytes) ? 1 : 0;
  EXPECT_GE(read, 5U) << "a corpus of files that are refused reaches nothing";
}

// What is mutated and cut below has values as bytes, too, of either order.
TEST(UniversalFileBytes, OfTheCorpusHaveBinarySetsOfEitherByteOrder) {
  std::size_t little = 0, big = 0;
  for (const std::string& bytes : corpus_files()) {
    if (!reads(bytes)) continue;
    little += bytes.find("\n    58b     1") != std::string::npos ? 1 : 0;
    big += bytes.find("\n    58b     2") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(little, 2U);
  EXPECT_GE(big, 2U);
}

TEST(UniversalFileBytes, MutatedFiftyThousandTimesAreReadOrRefusedInTime) {
  const std::vector<std::string> files = corpus_files();
  std::mt19937 random(58);
  std::size_t read = 0;
  const double start = tests::processor_seconds();
  constexpr int trials = 50000;
  for (int trial = 0; trial < trials; ++trial) {
    std::string bytes = files[random() % files.size()];
    for (std::size_t k = 0; k <= random() % 3 && !bytes.empty(); ++k) bytes = mutated(bytes, random);
    read += reads(bytes) ? 1 : 0;
  }
  const double seconds = tests::processor_seconds() - start;
  std::printf("%d mutated files in %.1f s, %zu of them read\n", trials, seconds, read);
  EXPECT_LT(seconds, 60.0);
  EXPECT_GT(read, static_cast<std::size_t>(trials) / 20);
}

TEST(UniversalFileBytes, CutAnywhereAreReadOrRefused) {
  for (const std::string& bytes : corpus_files()) {
    for (std::size_t size = 0; size < bytes.size(); ++size) (void)reads(bytes.substr(0, size));
  }
}

// Sizes that a file states ask for no memory that its bytes do not fill: these state thousands of millions of values.
TEST(UniversalFileBytes, ThatStateMoreThanThereIsAreRefusedAtOnce) {
  const std::string values(800, '1');
  for (const int type : {2, 4, 5, 6}) {
    for (const bool even : {true, false}) {
      const std::string heading = frf_heading(type, 2000000000, even);
      EXPECT_FALSE(reads(text_set(heading, values + "\n")));
      EXPECT_FALSE(reads(binary_set(heading, values, 2000000000, true)));
    }
  }
}

/// A line of /proc/self/status in kB.
long status_kb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(name + ":")) return std::stol(line.substr(name.size() + 1));
  }
  return -1;
}

// What costs most memory are the smallest pieces: empty lines, data sets without records, functions of one value, and
// real values of four bytes, each of which becomes a matrix of its own in a ResponseModel (some 20 times as much) on
// top of the list that it was read into.
TEST(UniversalFileBytes, TakeMemoryInProportion) {
#if defined(THINWALL_ADDRESS_SANITIZER)
  GTEST_SKIP() << "the address sanitizer keeps freed memory";
#endif
  const std::string frf = text_set(frf_heading(2, 1, true), "1\n");
  const std::string many_values =
      binary_set(frf_heading(2, 1000000, true), std::string(4000000, '\x3c'), 4000000, true);
  for (const std::string& piece : {frf, many_values, std::string("    -1\n1\n    -1\n"), std::string("\n")}) {
    std::string bytes;
    while (bytes.size() < 4000000) bytes += piece;
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts again
    const long before = status_kb("VmRSS");
    (void)reads(bytes);
    const double times = 1024.0 * static_cast<double>(status_kb("VmHWM") - before) / static_cast<double>(bytes.size());
    std::printf("peak memory %.1f times the file\n", times);
    EXPECT_LT(times, 40.0) << piece.substr(0, 20);
  }
}

// Cost is proportional to the bytes: sixteen times as many data sets, line ends or digits take no more than a hundred
// times as long, where a square law takes 256 times.
TEST(UniversalFileBytes, TakeTimeInProportion) {
  const auto seconds = [](const std::string& bytes) {
    double best = 1e9;
    for (int repetition = 0; repetition < 3; ++repetition) {
      const double start = tests::processor_seconds();
      (void)reads(bytes);
      best = std::min(best, tests::processor_seconds() - start);
    }
    return best;
  };
  const auto repeated = [](const std::string& piece, std::size_t times) {
    std::string bytes;
    for (std::size_t k = 0; k < times; ++k) bytes += piece;
    return bytes;
  };
  const std::string frf = text_set(frf_heading(2, 1, true), "  1.00000E+00\n");
  const std::string binary = binary_set(frf_heading(4, 1, true), doubles({1.0}, true), 8, true);
  const std::string unfinished = binary_set(frf_heading(4, 1000, true), doubles({1.0}, true), 8, true);
  for (const std::string& piece : {frf, binary, unfinished, std::string("    -1\n    15\n    -1\n"), std::string("\n"),
                                   std::string("    -1\n    58\n")}) {
    const std::size_t few = 200000 / piece.size();
    EXPECT_LT(seconds(repeated(piece, 16 * few)), 100.0 * seconds(repeated(piece, few)) + 0.05) << piece.substr(0, 20);
  }
}

}  // namespace thinwall::io::test::uff_robustness_test
