// `thinwall reduce` and `thinwall inspect`: a small model of a part, on disk and back, and what is said of it.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "app/case_run.hpp"
#include "app/reduce_command.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "io/matrices/mat.hpp"
#include "report/model_files.hpp"
#include "tests/app/command_call.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::tests::reduce_test {

using namespace setup;
using namespace cases;
using namespace study;
using namespace report;
using namespace app;

namespace {

namespace fs = std::filesystem;

constexpr double density = 2810.0;

/// A plate 120 x 80 x 6 mm with three patches that do not lie on one line.
std::string plate(const std::string& supports) {
  return R"([part]
length = "120 mm"
height = "80 mm"
thickness = "6 mm"
[part.axes]
length = "x"
height = "y"
thickness = "z"
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = 2810
[part.mesh]
element_size = "20 mm"
order = 3
)" + supports +
         R"([points.A]
position = ["40 mm", "40 mm", "6 mm"]
patch_radius = "5 mm"
[points.B]
position = ["110 mm", "20 mm", "6 mm"]
patch_radius = "5 mm"
[points.C]
position = ["100 mm", "65 mm", 0]
patch_radius = "5 mm"
[damping]
ratio = 0.01
[response]
to = "4000 Hz"
)";
}

fs::path scratch(const std::string& name) {
  const fs::path folder = tests::temporary_files() / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

Outcome command(std::vector<std::string> words) {
  return call(std::move(words), run_case);
}

fs::path written_case(const fs::path& folder, const std::string& supports) {
  core::write_file_atomically(folder / "case.toml", plate(supports));
  return folder / "case.toml";
}

/// A free plate by Craig-Bampton to a tolerance: the folder reads back bit by bit, the report finds the plate's own
/// mass and inertia in it, and nothing against it.
TEST(Reduce, AFreePlateIsWrittenReadBackAndTrusted) {
  const fs::path folder = scratch("reduce_free");
  const std::string file = written_case(folder, "").string();
  const Outcome reduced = command({"reduce", file, "-o", (folder / "model").string(), "--from", "100", "-q"});
  ASSERT_EQ(reduced.code, 0) << reduced.err;
  EXPECT_NE(reduced.out.find("nothing found against this model"), std::string::npos) << reduced.out;
  const PlacedModel model = read_model(folder / "model");
  const dynamics::SpatialModel dense = io::read_mat(folder / "model" / "model.mat");
  EXPECT_EQ(model.model.K, dense.K);
  EXPECT_EQ(model.model.M, dense.M);
  EXPECT_EQ(model.model.C, dense.C);
  ASSERT_EQ(model.positions.size(), 3U);
  EXPECT_LT((model.positions.at("A") - Eigen::Vector3d(0.04, 0.04, 0.006)).norm(), 1e-12);
  const Outcome inspected = command(
      {"inspect", (folder / "model").string(), "--rigid-motions", "6", "--json", (folder / "inspected.json").string()});
  EXPECT_EQ(inspected.code, 0) << inspected.out << inspected.err;
  const auto report = nlohmann::json::parse(core::read_file(folder / "inspected.json"));
  const auto& body = report["rigid_body"];
  const double mass = density * 0.12 * 0.08 * 0.006;
  EXPECT_NEAR(body["mass_kg"].get<double>() / mass, 1.0, 1e-8);
  EXPECT_NEAR(body["centre_m"][0].get<double>(), 0.06, 1e-8);
  EXPECT_NEAR(body["centre_m"][2].get<double>(), 0.003, 1e-8);
  EXPECT_NEAR(body["inertia_about_centre_kg_m2"][2][2].get<double>() / (mass * (0.12 * 0.12 + 0.08 * 0.08) / 12.0), 1.0,
              1e-6);
  EXPECT_EQ(body["free_motions"], 6);
  EXPECT_LT(body["effective_mass"]["closure_relative"].get<double>(), 1e-6);
}

/// Tighter tolerances keep more modes, and the error that is printed is below the tolerance.
TEST(Reduce, AToleranceChoosesTheModes) {
  const fs::path folder = scratch("reduce_tolerance");
  const Case held = parse_case(plate("[[part.supports]]\non = \"x_min\"\n"), folder);
  Eigen::Index last = 0;
  for (const double tolerance : {0.1, 0.01, 0.001}) {
    ReduceRequest request;
    request.out = folder / "model";
    request.tolerance = tolerance;
    const std::string text = reduce_part(held, request);
    double error = 0.0;
    const auto place = text.find("receptance of the interface ");
    ASSERT_NE(place, std::string::npos) << text;
    std::istringstream(text.substr(place + 28)) >> error;
    EXPECT_LE(error, 2.0 * tolerance);
    EXPECT_GT(error, 0.1 * tolerance);
    const Eigen::Index size = read_model(folder / "model").model.size();
    EXPECT_GT(size, last);
    last = size;
  }
}

/// Every method that has matrices writes them, and its model has the frequencies of the part.
TEST(Reduce, EveryMethodWithMatricesIsWritten) {
  const fs::path folder = scratch("reduce_methods");
  const std::string file = written_case(folder, "[[part.supports]]\non = \"x_min\"\n").string();
  for (const std::string method : {"guyan", "craig_bampton", "characteristic_constraint_modes", "rubin", "macneal",
                                   "craig_chang", "dual_craig_bampton"}) {
    const Outcome reduced = command(
        {"reduce", file, "-o", (folder / method).string(), "--method", method, "--modes", "12", "--to", "2000", "-q"});
    EXPECT_EQ(reduced.code, 0) << method << reduced.err;
    EXPECT_TRUE(fs::exists(folder / method / "model.mat")) << method;
    EXPECT_GE(read_model(folder / method).model.size(), 9) << method;
  }
}

TEST(Reduce, WhatCannotBeReducedOrInspectedIsSaid) {
  const fs::path folder = scratch("reduce_bad");
  const std::string file = written_case(folder, "").string();
  const auto refused = [&](const std::vector<std::string>& words, int code, const std::string& part) {
    const Outcome answer = command(words);
    EXPECT_EQ(answer.code, code) << answer.err;
    EXPECT_NE(answer.err.find(part), std::string::npos) << answer.err;
  };
  refused({"reduce", file, "--method", "rubbin"}, 2, "rubin");
  refused({"reduce", file, "--method", "modal_truncation"}, 2, "no matrices to write");
  refused({"reduce", file, "--method", "rubin", "--tolerance", "0.01"}, 2, "chooses the modes of craig_bampton");
  refused({"reduce", file, "--from", "100", "--to", "50"}, 2, "band");
  refused({"reduce", file, "--modes", "4", "--tolerance", "0.1"}, 2, "excludes");
  refused({"inspect", (folder / "nothing").string()}, 4, "nothing");
  refused({"inspect", folder.string()}, 4, "neither stiffness.mtx nor model.mat");
  refused({"inspect"}, 2, "nothing to inspect");
  core::write_file_atomically(folder / "k.mtx", "%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 5\n");
  refused({"inspect", "--stiffness", (folder / "k.mtx").string(), "--mass", (folder / "k.mtx").string(), "--mass-unit",
           "kg"},
          2, "add --unit mm");
}

/// What is wrong with the options or the folder is said before the part is meshed: a mesh of this size takes minutes.
TEST(Reduce, OptionsAndFolderAreRefusedBeforeAnythingIsComputed) {
  const fs::path folder = scratch("reduce_early");
  const std::string file = written_case(folder, "").string();
  core::write_file_atomically(folder / "a_file", "x");
  const std::vector<std::string> fine{"reduce", file, "--set", "part.mesh.element_size=\"1.5 mm\""};
  const auto refused = [&](std::vector<std::string> words, int code, const std::string& part) {
    words.insert(words.begin(), fine.begin(), fine.end());
    const double start = tests::processor_seconds();
    const Outcome answer = command(words);
    EXPECT_EQ(answer.code, code) << answer.err;
    EXPECT_NE(answer.err.find(part), std::string::npos) << answer.err;
    EXPECT_EQ(answer.err.find('\n'), answer.err.size() - 1) << answer.err;
    EXPECT_LT(tests::processor_seconds() - start, 20.0);
  };
  const std::string out = (folder / "model").string();
  refused({"-o", out, "--tolerance", "5"}, 2, "--tolerance is 5; it is relative, a number from 1e-8 to 1");
  refused({"-o", out, "--tolerance", "0"}, 2, "--tolerance is 0");
  refused({"-o", out, "--tolerance", "0.1", "--method", "guyan"}, 2, "give --modes with --method guyan");
  EXPECT_FALSE(fs::exists(out)) << "a folder for nothing";
  for (const std::string& bad : {std::string("/proc/x"), (folder / "a_file").string(), (folder / "a_file/x").string()})
    refused({"-o", bad}, 4, "choose another folder with -o");
}

/// A model reduced from matrices, written where they lie, would take their place: the files are as they were.
TEST(Reduce, AModelIsNotWrittenOverTheMatricesThatItComesFrom) {
  const fs::path folder = scratch("reduce_over");
  ASSERT_EQ(command({"reduce", written_case(folder, "").string(), "-o", (folder / "model").string()}).code, 0);
  const fs::path own = folder / "model";
  const std::string before = core::read_file(own / "stiffness.mtx");
  core::write_file_atomically(own / "case.toml", R"([part]
shape = "matrices"
unit = "m"
mass_unit = "kg"
[part.matrices]
stiffness = "stiffness.mtx"
mass = "mass.mtx"
dofs = "dofs.csv"
[points.A]
[response]
to = "4000 Hz"
)");
  const Outcome answer = command({"reduce", own.string(), "-o", own.string(), "--modes", "2"});
  EXPECT_EQ(answer.code, 3) << answer.err;
  EXPECT_NE(answer.err.find("choose another folder with -o"), std::string::npos) << answer.err;
  EXPECT_EQ(core::read_file(own / "stiffness.mtx"), before);
}

/// The table alone lies where the model is to go.
TEST(Reduce, AModelIsNotWrittenOverATableEither) {
  const fs::path folder = scratch("reduce_over_table");
  ASSERT_EQ(command({"reduce", written_case(folder, "").string(), "-o", (folder / "model").string()}).code, 0);
  fs::create_directories(folder / "out");
  fs::rename(folder / "model" / "dofs.csv", folder / "out" / "dofs.csv");
  const std::string before = core::read_file(folder / "out" / "dofs.csv");
  core::write_file_atomically(folder / "case.toml", R"([part]
shape = "matrices"
unit = "m"
mass_unit = "kg"
[part.matrices]
stiffness = "model/stiffness.mtx"
mass = "model/mass.mtx"
dofs = "out/dofs.csv"
[points.A]
[response]
to = "4000 Hz"
)");
  const Outcome answer = command({"reduce", folder.string(), "-o", (folder / "out").string(), "--modes", "2"});
  EXPECT_EQ(answer.code, 3) << answer.err;
  EXPECT_NE(answer.err.find("dofs.csv"), std::string::npos) << answer.err;
  EXPECT_EQ(core::read_file(folder / "out" / "dofs.csv"), before);
}

const std::string symmetric_head = "%%MatrixMarket matrix coordinate real symmetric\n";

/// Two masses on springs, whose entries are given; what `run` and `inspect` say of them.
struct TwoMasses {
  fs::path folder;
  explicit TwoMasses(const std::string& name) : folder(scratch(name)) {
    write("k.mtx", "2 2 3\n1 1 200\n2 1 -100\n2 2 100\n");
    write("m.mtx", "2 2 2\n1 1 1\n2 2 1\n");
    core::write_file_atomically(folder / "dofs.csv", "node,component,point\n1,x,A\n2,x,B\n");
    core::write_file_atomically(folder / "case.toml",
                                "[part]\nunit = \"m\"\nmass_unit = \"kg\"\n[part.matrices]\nstiffness = \"k.mtx\"\n"
                                "mass = \"m.mtx\"\ndofs = \"dofs.csv\"\n");
  }
  void write(const std::string& file, const std::string& entries) const {
    core::write_file_atomically(folder / file, symmetric_head + entries);
  }
  [[nodiscard]] Outcome run() const {
    return command({"run", folder.string(), "--out", (folder / "out").string(), "-q"});
  }
  [[nodiscard]] Outcome inspect(const std::vector<std::string>& more) const {
    std::vector<std::string> words{"inspect", "--stiffness", (folder / "k.mtx").string(), "--dofs",
                                   (folder / "dofs.csv").string()};
    words.insert(words.end(), more.begin(), more.end());
    return command(words);
  }
};

void expect_answer(const Outcome& answer, int code, const std::string& part) {
  EXPECT_EQ(answer.code, code) << answer.err << answer.out;
  EXPECT_NE((answer.err + answer.out).find(part), std::string::npos) << answer.err << answer.out;
}

TEST(Inspect, NamesTheOptionOrTheFileThatIsAtFault) {
  const TwoMasses part("inspect_usage");
  const std::string mass = (part.folder / "m.mtx").string();
  expect_answer(part.inspect({"--mass", mass, "--mass-unit", "kg"}), 2, "add --unit mm");
  expect_answer(part.inspect({"--mass", mass, "--unit", "m"}), 2, "add --mass-unit t");
  expect_answer(part.inspect({"--unit", "m", "--mass-unit", "kg"}), 2, "k.mtx holds one matrix only: add --mass FILE");
  core::write_file_atomically(part.folder / "dofs.csv", "node,component,point\n1,x,A\n1,x,A\n");
  expect_answer(part.inspect({"--mass", mass, "--unit", "m", "--mass-unit", "kg"}), 4,
                "dofs.csv: rows 1 and 2 are both node 1.x");
}

TEST(Inspect, NamesTheDofsOfSmallMatricesThatShowWhatIsWrong) {
  const TwoMasses part("inspect_place");
  const std::vector<std::string> rest{"--mass", (part.folder / "m.mtx").string(), "--unit", "m", "--mass-unit", "kg"};
  part.write("k.mtx", "2 2 3\n1 1 200\n2 1 -100\n2 2 10\n");
  expect_answer(part.inspect(rest), 6, "; see B.x");
  core::write_file_atomically(part.folder / "k.mtx",
                              "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 200\n"
                              "2 1 -100\n1 2 -90\n2 2 100\n");
  expect_answer(part.inspect(rest), 6, "; see A.x, B.x");
}

/// Matrices that no part has: the file, the DOF and the remedy are said, not what finite elements would need.
TEST(MatricesOfAPart, ThatCannotBeAreToldByFileAndDof) {
  const TwoMasses part("matrices_at_fault");
  EXPECT_EQ(part.run().code, 0) << part.run().err;
  part.write("m.mtx", "2 2 2\n1 1 -1\n2 2 1\n");
  expect_answer(part.run(), 4, "m.mtx: imported matrices: M(A.x, A.x) = -1 is negative");
  EXPECT_EQ(part.run().err.find("k.mtx"), std::string::npos);
  part.write("m.mtx", "2 2 3\n1 1 1\n2 1 2\n2 2 1\n");
  expect_answer(part.run(), 4, "m.mtx: the mass matrix is indefinite");
  part.write("m.mtx", "2 2 2\n1 1 1\n2 2 1\n");
  part.write("k.mtx", "2 2 3\n1 1 200\n2 1 -100\n2 2 10\n");
  const Outcome stiffness = part.run();
  expect_answer(stiffness, 4, "k.mtx: the stiffness matrix is indefinite");
  EXPECT_NE(stiffness.err.find("most at B.x; export the matrix again"), std::string::npos) << stiffness.err;
  EXPECT_EQ(stiffness.err.find("element"), std::string::npos) << stiffness.err;
}

/// Without places no motion can be named, but their number is held to.
TEST(Reduce, RigidMotionsAreCountedWithoutPlaces) {
  const fs::path folder = scratch("inspect_count");
  core::write_file_atomically(folder / "k.mtx",
                              "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 100\n2 1 -100\n2 2 100\n");
  core::write_file_atomically(folder / "m.mtx",
                              "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 1\n2 2 1\n");
  core::write_file_atomically(folder / "dofs.csv", "node,component,point\n1,x,A\n2,x,B\n");
  const auto inspected = [&](const std::string& motions) {
    return command({"inspect", "--stiffness", (folder / "k.mtx").string(), "--mass", (folder / "m.mtx").string(),
                    "--dofs", (folder / "dofs.csv").string(), "--unit", "m", "--mass-unit", "kg", "--rigid-motions",
                    motions});
  };
  const Outcome one = inspected("1"), none = inspected("0");
  EXPECT_EQ(one.code, 0) << one.err << one.out;
  EXPECT_NE(one.out.find("modes counted as free: 1"), std::string::npos) << one.out;
  EXPECT_EQ(none.code, 6) << none.out;
  EXPECT_NE(none.out.find("modes without energy"), std::string::npos) << none.out;
}

}  // namespace
}  // namespace thinwall::tests::reduce_test
