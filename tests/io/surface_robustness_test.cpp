// Whatever bytes a surface file holds: it is read or refused with an error of ours, soon, and without more memory than
// a small multiple of its size. The same readers are under libFuzzer in fuzz/, from the same corpus.

#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "byte_mutation.hpp"
#include "core/error.hpp"
#include "io/surface/gltf.hpp"
#include "io/surface/obj.hpp"
#include "io/surface/off.hpp"
#include "io/surface/ply.hpp"
#include "io/surface/stl.hpp"
#include "surface_bytes.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::test::surface_robustness_test {

namespace {

struct Format {
  const char* name;
  mesh::TriangleSoup (*read)(std::string_view, const std::string&, double);
  std::vector<std::string> corpus;
  std::size_t least_read = 100;  ///< one mutated file of so many is read at least
};

mesh::TriangleSoup gltf_soup(std::string_view bytes, const std::string& name, double) {
  return gltf_surface(bytes, name).soup;
}

const std::vector<Format>& formats() {
  static const std::vector<Format> all{
      {"stl", stl_surface, corpus_of("stl")},
      {"off", off_surface, corpus_of("off")},
      {"obj", obj_surface, corpus_of("obj")},
      {"ply", ply_surface, corpus_of("ply")},
      {"gltf", gltf_soup, corpus_of("gltf"), 5000}};  // JSON with a changed byte is rarely JSON
  return all;
}

/// True if the bytes were read into a sound soup, false if they were refused; anything else fails the test.
bool reads(const Format& format, const std::string& bytes) {
  try {
    const mesh::TriangleSoup soup = format.read(bytes, "x", 1e-3);
    EXPECT_FALSE(soup.triangles.empty());
    EXPECT_NO_THROW((void)mesh::merged_points(soup)) << "a corner that is no point, or not finite";
    return true;
  } catch (const core::DataError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
  return false;
}

/// A line of /proc/self/status in kB.
long status_kb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return std::stol(line.substr(name.size() + 1));
  return -1;
}

}  // namespace

TEST(SurfaceFileBytes, OfTheCorpusAreReadOrRefused) {
  for (const Format& format : formats()) {
    const auto read = std::count_if(format.corpus.begin(), format.corpus.end(),
                                    [&](const std::string& bytes) { return reads(format, bytes); });
    EXPECT_GE(read, 3) << format.name << ": a corpus of files that are refused reaches nothing";
    EXPECT_LT(read, static_cast<std::ptrdiff_t>(format.corpus.size())) << format.name << ": nothing is refused";
  }
}

TEST(SurfaceFileBytes, CutAnywhereAreReadOrRefused) {
  for (const Format& format : formats())
    for (const std::string& bytes : format.corpus)
      for (std::size_t size = 0; size < bytes.size(); ++size) (void)reads(format, bytes.substr(0, size));
}

TEST(SurfaceFileBytes, MutatedFiftyThousandTimesAreReadOrRefusedInTime) {
  for (const Format& format : formats()) {
    std::mt19937 random(88);
    std::size_t read = 0;
    const double start = tests::processor_seconds();
    constexpr int trials = 50000;
    for (int trial = 0; trial < trials; ++trial) {
      std::string bytes = format.corpus[random() % format.corpus.size()];
      for (std::size_t k = 0; k <= random() % 3 && !bytes.empty(); ++k) bytes = mutated(bytes, random);
      read += reads(format, bytes) ? 1 : 0;
    }
    const double seconds = tests::processor_seconds() - start;
    std::printf("%s: %d mutated files in %.1f s, %zu of them read\n", format.name, trials, seconds, read);
    EXPECT_LT(seconds, 20.0);
    EXPECT_GT(read, static_cast<std::size_t>(trials) / format.least_read);
  }
}

// Counts that a file states ask for no memory that its bytes do not fill: these state thousands of millions.
TEST(SurfaceFileBytes, ThatStateMoreThanThereIsAreRefusedAtOnce) {
  const double start = tests::processor_seconds();
  const std::string many = "2147483647";
  EXPECT_FALSE(reads(formats()[0], std::string(80, ' ') + "\xff\xff\xff\x7f" + std::string(5000, 'a')));
  EXPECT_FALSE(reads(formats()[1], "OFF\n" + many + " " + many + " 0\n0 0 0\n"));
  EXPECT_FALSE(reads(formats()[1], "OFF\n0 " + many + " 0\n1000 0 0\n"));
  EXPECT_FALSE(reads(formats()[2], "v 0 0 0\nf " + many + " 1 1\n"));
  for (const char* kind : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    EXPECT_FALSE(reads(formats()[3], ply_heading(kind, 2147483647, 2147483647) + std::string(500, '0')));
    EXPECT_FALSE(reads(formats()[3], ply_heading(kind, 0, 2147483647)));
    // Rows without bytes are passed over, however many.
    std::string empty = ply_heading(kind, 0, 0);
    empty.insert(empty.find("element face"), "element nothing " + many + "\n");
    EXPECT_FALSE(reads(formats()[3], empty));
  }
  EXPECT_LT(tests::processor_seconds() - start, 20.0);
}

// Facets of very many corners, none of which sees all others, cost no more than a multiple of their bytes.
TEST(SurfaceFileBytes, OfFacetsWithAThousandCornersAreReadInTime) {
  mesh::TriangleSoup zigzag;
  std::string text;
  for (int k = 0; k < 1000; ++k)
    text += "v " + std::to_string(k % 2 == 0 ? 0 : 1) + " " + std::to_string(k * k % 37) + " 0\n";
  for (int f = 0; f < 300; ++f) {
    text += "f";
    for (int k = 1; k <= 1000; ++k) text += " " + std::to_string((k * (f + 1)) % 1000 + 1);
    text += "\n";
  }
  const double start = tests::processor_seconds();
  (void)reads(formats()[2], text);
  EXPECT_LT(tests::processor_seconds() - start, 20.0);
}

// The smallest pieces cost most: "v 0 0 0" is a point of 24 bytes, and a vector of points doubles as it grows.
TEST(SurfaceFileBytes, TakeMemoryInProportion) {
#if defined(THINWALL_ADDRESS_SANITIZER)
  GTEST_SKIP() << "the address sanitizer keeps freed memory";
#endif
  std::string points = "f 1 1 1\n", facets = "v 0 0 0\n";
  while (points.size() < 4000000) points += "v 0 0 0\n";
  while (facets.size() < 4000000) facets += "f 1 1 1\n";
  std::string stl = stl_bytes({{{0, 0, 0}}, std::vector<std::array<int, 3>>(80000, {0, 0, 0})}, 1.0);
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement face 1000000\nproperty list uchar uchar vertex_index\n"
      "element vertex 1\nproperty char x\nproperty char y\nproperty char z\nend_header\n";
  for (int k = 0; k < 1000000; ++k) ply += std::string("\3\0\0\0", 4);
  ply += std::string(3, '\0');
  for (const auto& [format, bytes] : {std::pair{2, points}, {2, facets}, {0, stl}, {3, ply}}) {
    ::malloc_trim(0);
    std::ofstream("/proc/self/clear_refs") << "5";  // the peak starts again
    const long before = status_kb("VmRSS");
    (void)reads(formats()[static_cast<std::size_t>(format)], bytes);
    const double times = 1024.0 * static_cast<double>(status_kb("VmHWM") - before) / static_cast<double>(bytes.size());
    std::printf("peak memory %.1f times the file\n", times);
    EXPECT_LT(times, 40.0) << format;
  }
}

}  // namespace thinwall::io::test::surface_robustness_test
