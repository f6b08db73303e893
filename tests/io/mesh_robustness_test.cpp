// Whatever bytes a mesh file holds: it is read or refused with an error of ours, soon, and without memory that its
// bytes do not call for. The same readers are under libFuzzer in fuzz/, from the same corpus.

#include <gtest/gtest.h>

#include <cstdio>

#include "byte_mutation.hpp"
#include "core/error.hpp"
#include "mesh_bytes.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::io::test::mesh_robustness_test {

namespace {

struct Format {
  const char* name;
  mesh::LabelledMesh (*read)(std::string_view, const std::string&, double);
  std::vector<std::string> corpus;
};

const std::vector<Format>& formats() {
  static const std::vector<Format> all{{"gmsh", gmsh_mesh, corpus_of("gmsh")},
                                       {"inp", inp_mesh_only, corpus_of("inp")},
                                       {"vtu", vtu_mesh, corpus_of("vtu")}};
  return all;
}

/// True if the bytes became a sound mesh, false if they were refused; anything else fails the test.
bool reads(const Format& format, const std::string& bytes) {
  try {
    const mesh::SolidMesh solid = mesh::solid_mesh(format.read(bytes, "x", 1e-3));
    EXPECT_GE(solid.nodes.elements.minCoeff(), 0);
    EXPECT_LT(solid.nodes.elements.maxCoeff(), solid.nodes.positions.rows());
    EXPECT_GT(mesh::volume_of(solid), 0.0);
    return true;
  } catch (const core::DataError& error) {
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
  return false;
}

}  // namespace

TEST(MeshFileBytes, OfTheCorpusAreReadOrRefused) {
  for (const Format& format : formats()) {
    const auto read = std::count_if(format.corpus.begin(), format.corpus.end(),
                                    [&](const std::string& bytes) { return reads(format, bytes); });
    EXPECT_GE(read, 3) << format.name << ": a corpus of files that are refused reaches nothing";
    EXPECT_LT(read, static_cast<std::ptrdiff_t>(format.corpus.size())) << format.name << ": nothing is refused";
  }
}

TEST(MeshFileBytes, CutAnywhereAreReadOrRefused) {
  for (const Format& format : formats())
    for (const std::string& bytes : format.corpus)
      for (std::size_t size = 0; size < bytes.size(); ++size) (void)reads(format, bytes.substr(0, size));
}

TEST(MeshFileBytes, MutatedTwentyThousandTimesAreReadOrRefusedInTime) {
  for (const Format& format : formats()) {
    std::mt19937 random(88);
    int read = 0;
    const double start = tests::processor_seconds();
    constexpr int trials = 20000;
    for (int trial = 0; trial < trials; ++trial) {
      std::string bytes = format.corpus[random() % format.corpus.size()];
      for (std::size_t k = 0; k <= random() % 3 && !bytes.empty(); ++k) bytes = mutated(bytes, random);
      read += reads(format, bytes) ? 1 : 0;
    }
    const double seconds = tests::processor_seconds() - start;
    std::printf("%s: %d mutated files in %.1f s, %d of them read\n", format.name, trials, seconds, read);
    EXPECT_LT(seconds, 30.0);
    EXPECT_GT(read, trials / 100);
  }
}

// Counts, ranges and sets that ask for more than the bytes hold.
TEST(MeshFileBytes, ThatStateMoreThanThereIsAreRefusedOrReadAtOnce) {
  const double start = tests::processor_seconds();
  const std::string heading = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
  EXPECT_FALSE(reads(formats()[0], heading + "$Nodes\n4000000000 4000000000 1 4000000000\n0 1 0 4000000000\n1\n"));
  EXPECT_FALSE(reads(formats()[0], heading + "$Entities\n4000000000 0 0 0\n1 0 0 0 0\n"));
  const std::string tet = "*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT,TYPE=C3D4,ELSET=E\n1,1,2,3,4\n";
  EXPECT_TRUE(reads(formats()[1], tet + "*NSET,NSET=A,GENERATE\n1,2147483647\n"));
  std::string doubled = tet + "*NSET,NSET=A\n1\n";
  for (int k = 0; k < 200; ++k) doubled += "A,A,A,A\n";
  EXPECT_TRUE(reads(formats()[1], doubled)) << "a set that holds itself";
  std::string chain = tet + "*NSET,NSET=A0\n1\n";
  for (int k = 1; k < 2000; ++k) chain += "*NSET,NSET=A" + std::to_string(k) + "\nA" + std::to_string(k - 1) + "\n";
  EXPECT_TRUE(reads(formats()[1], chain));
  EXPECT_LT(tests::processor_seconds() - start, 20.0);
}

}  // namespace thinwall::io::test::mesh_robustness_test
