// `thinwall inspect FILE.uff`: what a universal file holds, as a user reads it.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/case_run.hpp"
#include "core/atomic_file.hpp"
#include "io/frf/uff.hpp"
#include "io/frf/uff_shapes.hpp"
#include "tests/app/command_call.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::inspect_universal_test {

namespace {

namespace fs = std::filesystem;

Outcome inspected(std::vector<std::string> words) {
  words.insert(words.begin(), "inspect");
  return call(std::move(words), app::run_case);
}

fs::path scratch(const std::string& name) {
  const fs::path folder = tests::temporary_files() / ("inspect_universal_" + name);
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

/// A test of three points: a sensor at A, a hammer at A, B and C, with coherence at B; geometry and a shape.
fs::path roving_test(const fs::path& folder) {
  const auto along_z = [](const std::string& point) {
    return dynamics::Dof{point, Eigen::Vector3d::UnitZ(), dynamics::DofKind::translation};
  };
  io::MeasuredResponse measured;
  measured.response.axis.hz = Eigen::VectorXd::LinSpaced(5, 10.0, 50.0);
  measured.response.responses = {along_z("A")};
  measured.response.forces = {along_z("A"), along_z("B"), along_z("C")};
  measured.response.forces.back().direction *= -1.0;
  measured.response.H.assign(5, Eigen::RowVector3cd(3e-6, 2e-6, 1e-6));
  measured.coherence = {{0, 1, (Eigen::VectorXd(5) << 0.5, 0.9, 1.0, 0.95, 0.7).finished()}};
  io::write_uff(folder / "frf.uff", measured);
  io::UffMesh geometry;
  geometry.nodes = {{1, {0.0, 0.0, 0.0}}, {2, {0.25, 0.0, 0.0}}, {3, {0.25, 0.1, -0.05}}};
  geometry.lines = {{1, "edge", {1, 2, 3}}};
  io::UffShape shape;
  shape.number = 1;
  shape.frequency_hz = 512.345;
  shape.damping_ratio = 0.0125;
  shape.modal_mass = 1.0;
  shape.nodes = {1, 2, 9};
  shape.displacement = Eigen::MatrixXcd::Zero(3, 3);
  shape.displacement(1, 1) = -2.0;
  io::write_uff_shapes(folder / "shapes.uff", {shape}, geometry);
  core::write_file_atomically(folder / "test.dat",
                              core::read_file(folder / "shapes.uff") + core::read_file(folder / "frf.uff"));
  return folder / "test.dat";
}

void expect_lines(const Outcome& answer, const std::vector<std::string>& lines) {
  for (const std::string& line : lines)
    EXPECT_NE(answer.out.find(line), std::string::npos) << line << "\n" << answer.out << answer.err;
}

}  // namespace

TEST(InspectUniversal, TellsGeometryShapesFrfsAndTheReferenceOfARovingTest) {
  const fs::path folder = scratch("whole");
  const Outcome answer = inspected({roving_test(folder).string(), "--json", (folder / "facts.json").string()});
  EXPECT_EQ(answer.code, 0) << answer.err;
  expect_lines(answer, {"geometry: 3 nodes within 250 x 100 x 50 mm, 1 trace line, 0 elements",
                        "     1    512.35 Hz    1.250 %  normal        3  node 2 in y",
                        "     2  A.z              B.z                   5            10 to 50 Hz  0.900",
                        "     3  A.z              C.-z                  5            10 to 50 Hz  -",
                        "test: one reference, A.z; 3 DOFs make one column of receptances of a force there, 2 by "
                        "reciprocity, since the hammer moved",
                        "note: no place in the geometry has 1 node of the shapes, first node 9"});
  const auto facts = nlohmann::json::parse(core::read_file(folder / "facts.json"));
  EXPECT_EQ(facts["geometry"]["highest_m"][1], 0.1);
  EXPECT_EQ(facts["shapes"][0]["frequency_hz"], 512.345);
  EXPECT_EQ(facts["frfs"][1]["median_coherence"], 0.9);
  EXPECT_EQ(facts["reference"]["by_reciprocity"], 2);
}

TEST(InspectUniversal, APartThatCannotBeReadEndsWithCode6AndItsReason) {
  const fs::path folder = scratch("parts");
  const std::string nodes =
      "    -1\n    15\n         1         0         0         8  4.00000E+01  0.00000E+00  0.00000E+00\n    -1\n";
  core::write_file_atomically(folder / "nodes.unv", nodes);
  const std::string file = (folder / "nodes.unv").string();
  const Outcome unstated = inspected({file});
  EXPECT_EQ(unstated.code, 6);
  expect_lines(unstated, {"not read: " + file, "state the unit of length"});
  const Outcome stated = inspected({file, "--unit", "mm"});
  EXPECT_EQ(stated.code, 0) << stated.out;
  EXPECT_EQ(inspected({file, "--unit", "kg"}).code, 3);
}

}  // namespace thinwall::tests::inspect_universal_test
