// Cases that nobody means: too deep, too many, too large, no files. Each is refused in few lines before anything is
// computed; without a bound these end the process, or do not end.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>

#include "case/reader.hpp"
#include "case/schema/physical_range.hpp"
#include "core/atomic_file.hpp"
#include "tests/case/case_text.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::hostile_case_test {

using namespace cases;

namespace {

/// The messages about a case with these options; "" if nothing is wrong.
std::string refusal(const std::string& text, const std::vector<std::string>& overrides = {},
                    const std::filesystem::path& folder = ".") {
  EXPECT_FALSE(text.empty()) << "the replacement did not match";
  try {
    (void)parse_case(text, folder, "case.toml", overrides);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

void expect_refused(const std::string& text, const std::string& part, const std::vector<std::string>& overrides = {}) {
  const std::string found = refusal(text, overrides);
  EXPECT_NE(found.find(part), std::string::npos) << found.substr(0, 400);
  EXPECT_EQ(found.find('\n'), std::string::npos) << found.substr(0, 400);
}

void expect_replaced_refused(const std::string& from, const std::string& to, const std::string& part) {
  expect_refused(with(plate_case(), from, to), part);
}

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

TEST(HostileCase, NestingIsBoundedBeforeTheParser) {
  const std::string deep = "nested deeper than 32";
  expect_refused("[a" + repeated(".a", 1000000) + "]\n", deep);
  expect_refused("a" + repeated(".a", 1000000) + " = 1\n", deep);
  expect_refused("a = " + repeated("[", 1000000) + "\n", deep);
  expect_refused("a = " + repeated("{a=", 1000000) + "\n", deep);
  expect_refused(plate_case(), deep, {"part" + repeated(".a", 50000) + "=1"});
  expect_refused(plate_case(), deep, {"title=" + repeated("[", 50000)});
  const std::string dots = repeated(".[{", 100);
  EXPECT_EQ(refusal(with(plate_case(), "\"plate\"", "\"\"\"" + dots + "\n\\\"\"\"\" # " + dots)), "")
      << "quoted text and comments have no depth";
  EXPECT_EQ(refusal(with(plate_case(), "\"plate\"", "'" + dots + "'")), "");
}

TEST(HostileCase, OfVeryManyProblemsTheFirstTwentyAreShownAndTheOthersCounted) {
  std::string text = plate_case();
  for (int i = 0; i < 100000; ++i) text += "k" + std::to_string(i) + " = 1\n";
  const std::string found = refusal(text);
  EXPECT_EQ(std::ranges::count(found, '\n'), 20);
  EXPECT_NE(found.find("lobes.k19: unknown key"), std::string::npos) << found;
  EXPECT_EQ(found.find("lobes.k20: unknown key"), std::string::npos) << found;
  EXPECT_TRUE(found.ends_with("case.toml: and 99980 more problems; the first 20 are shown")) << found;
}

TEST(HostileCase, MoreTablesAndEntriesThanACaseHasAreRefused) {
  std::string points = plate_case();
  for (int i = 0; i < 5000; ++i) points += "[points.N" + std::to_string(i) + "]\nat = [0.5, 0.5, 0.5]\n";
  expect_refused(points, "points: 5002 tables are too many, at most 1000 are read");
  const std::string supports = plate_case() + repeated("[[part.supports]]\non = \"y_min\"\n", 100000);
  expect_refused(supports, "part.supports: 100002 tables are too many");
  expect_replaced_refused("ratios = [0.008, \"0.6 %\"]", "ratios = [" + repeated("0.01, ", 100000) + "]",
                          "damping.ratios: 100000 entries are too many, at most 2000 are read");
}

TEST(HostileCase, NumbersOfListsInOptionsAreThoseOfTheCase) {
  for (const char* place : {"99999999999999999999", "-1", "", "x", "1x", "0]["}) {
    const std::string key = "part.supports[" + std::string(place) + "]";
    expect_refused(plate_case(), "--set " + key + ".on: there is no supports[" + place + "]", {key + ".on=y_min"});
  }
  expect_refused(plate_case(), "supports[0] to [1]", {"part.supports[2].on=y_min"});
  expect_refused(plate_case(), "the case has no clamps[0]", {"part.clamps[0].on=y_min"});
  expect_refused(plate_case(), "there is no ratios[99999999999999999999]",
                 {"damping.ratios[99999999999999999999]=0.1"});
  EXPECT_EQ(refusal(plate_case(), {"part.supports[1].on=z_min", "damping.ratios[0]=0.02"}), "");
}

TEST(HostileCase, AListOfTheCaseIsNoTableOfIt) {
  expect_refused(plate_case(), "--set part.supports.on: supports is a list of 2; name the entry, as in supports[0]",
                 {"part.supports.on=z_min"});
  expect_refused(plate_case(), "--set robot.modes[0].frequency: the case has no modes[0]",
                 {"robot.modes[0].frequency=3 Hz"});
}

TEST(HostileCase, AListThatHasADefaultIsNotEmpty) {
  expect_replaced_refused(
      "fixed = [\"x\", \"y\", \"z\"]", "fixed = []",
      "part.supports[1].fixed: is a list without an entry; name what is meant, or leave the key out");
  expect_replaced_refused("[[contacts]]", "[[contacts]]\ndirections = []",
                          "contacts[0].directions: is a list without an entry");
  expect_replaced_refused("[[contacts]]", "[[contacts]]\nstiffness = []",
                          "contacts[0].stiffness: is a list without an entry");
  EXPECT_EQ(refusal(with(plate_case(), "[lobes]", "[lobes]\ncompare = []")), "") << "no chart beside";
}

TEST(HostileCase, AnEmptyTextOrAnEmptyListIsNoKeyThatIsLeftOut) {
  expect_replaced_refused("on = \"y_min\"", "on = \"\"", "part.supports[0].on: is an empty text; write what is meant");
  expect_replaced_refused("point = \"P.x\"", "point = \"\"", "updating[0].targets[0].point: is an empty text");
  expect_replaced_refused("lower = \"380 mm\"", "lower = \"\"", "updating[0].parameters[0].lower: is an empty text");
  expect_replaced_refused("ratios = [0.008, \"0.6 %\"]", "ratios = []",
                          "damping.ratios: is a list without an entry; write its numbers, or remove the key");
  expect_replaced_refused("teeth = 6", "teeth = 6\nhelices = []", "tool.helices: is a list without an entry");
  EXPECT_EQ(refusal(with(plate_case(), "title = \"plate\"", "title = \"\"")), "") << "no title is one";
}

TEST(HostileCase, AFileThatIsNotThereIsToldWithItsKey) {
  const std::string matrices = "[part]\nunit = \"mm\"\nmass_unit = \"t\"\n[part.matrices]\nstiffness = \"none.mtx\"\n";
  EXPECT_EQ(refusal(matrices, {}, "/nowhere"),
            "case.toml:5:13: part.matrices.stiffness: there is no file \"/nowhere/none.mtx\"");
}

TEST(HostileCase, ASelectionOffThePartHoldsNothing) {
  const auto held_on = [](const std::string& selection) {
    return with(plate_case(), "on = \"y_min\"", "on = \"S\"") + "[selections.S." + selection;
  };
  const std::string part =
      "part.supports[0].on: the selection \"S\" holds no face of the part, which reaches from (0 m, 0 m, 0 m) to "
      "(6 mm, 392 mm, 100 mm)";
  expect_refused(held_on("sphere]\ncentre = [9, 9, 9]\nradius = \"1 mm\"\n"), part);
  expect_refused(held_on("box]\nmin = [0, \"-2 mm\", 0]\nmax = [\"6 mm\", \"-1 mm\", \"100 mm\"]\n"), part);
  expect_refused(held_on("plane]\npoint = [0, \"393 mm\", 0]\nnormal = [0, 2, 0]\n"), part);
  EXPECT_EQ(refusal(held_on("box]\nmin = [0, \"-2 mm\", 0]\nmax = [\"6 mm\", 0, \"100 mm\"]\n")), "") << "a face";
  EXPECT_EQ(refusal(held_on("plane]\npoint = [0, \"392 mm\", 0]\nnormal = [0, 2, 0]\n")), "");
  EXPECT_EQ(refusal(held_on("sphere]\ncentre = [0, 0, 0]\nradius = \"9 mm\"\n")), "");
}

TEST(HostileCase, AQuantityIsOneOfMachining) {
  const auto lobes = [](const std::string& from, const std::string& to, const std::string& part) {
    expect_refused(
        with(plate_case(), "from = \"1000 rpm\"\nto = \"3000 rpm\"", "from = \"" + from + "\"\nto = \"" + to + "\""),
        part);
  };
  lobes("1e-300 rpm", "3000 rpm",
        "lobes.from: 1e-300 rpm is no spindle speed in machining: these lie between 20 rpm and");
  lobes("1000 rpm", "1e300 rpm", "lobes.to: 1e+300 rpm is no spindle speed");
  expect_replaced_refused("length = \"392 mm\"", "length = \"60 m^-1/m^-2\"", "multiplies and divides by m");
  expect_replaced_refused("length = \"392 mm\"", "length = \"1e-300 m\"", "is no length in machining");
  expect_replaced_refused("thickness = \"6 mm\"", "thickness = \"1 nm\"",
                          "part.thickness: the part has thickness 1e-06 mm");
  expect_replaced_refused("element_size = \"12 mm\"", "element_size = \"1e300 m\"",
                          "part.mesh.element_size: 1e+300 m is no length in machining: these lie between");
  expect_replaced_refused("element_size = \"12 mm\"", "element_size = \"12 mm\"\ntime_limit = \"1e-300 s\"",
                          "part.mesh.time_limit: 1e-300 s is out of range");
  expect_replaced_refused("offset = [\"0 mm\"", "offset = [\"1e300 m\"", "these lie below 1000 m");
  expect_replaced_refused("frequency = \"29 Hz\"", "frequency = \"1e12 Hz\"",
                          "robot.frequency: 1e+12 Hz is no frequency in machining");
  expect_replaced_refused("stiffness = \"1.7e6 N/m\"", "stiffness = \"1e-6 N/m\"",
                          "robot.stiffness: 1e-06 N/m is no stiffness in machining: these lie between 1 N/m and");
  expect_replaced_refused("frequency = \"29 Hz\"", "mass = \"1e-9 kg\"",
                          "robot.mass: beside robot.stiffness it cannot be: 656");
  EXPECT_EQ(refusal(with(plate_case(), "offset = [\"0 mm\"", "offset = [\"6e-17 m\"")), "") << "round-off is zero";
  expect_replaced_refused("[points.P2]", "patch_radius = \"1e-300 m\"\n[points.P2]",
                          "points.P.patch_radius: 1e-294 µm is less than a millionth of the part, 0.4046 µm");
}

// The page lists the ranges that hold.
/// A message ends at such a character, so that the bound and what to do would be missing.
TEST(HostileCase, ATextWithoutVisibleCharactersIsToldAsWhatItIs) {
  const std::string part = "holds the character U+0000, which no name, file or number has; remove it";
  expect_refused(plate_case(), part, {"part.thickness=\"6\\u0000 mm\""});
  expect_refused(plate_case(), part, {"cutting.mode=\"\\u0000\""});
  expect_refused(plate_case(), part, {"title=\"a\\u0000b\""});
}

TEST(HostileCase, ThePageOfTheCaseFileHasEveryRange) {
  const std::string page = core::read_file(std::filesystem::path(THINWALL_SOURCE_DIR) / "docs" / "case-file.md");
  for (const PhysicalRange& range : physical_ranges()) {
    const auto text = [&](double bound) { return core::number_text(bound) + " " + std::string(range.kind.unit); };
    const std::string row =
        "| " + std::string(range.kind.name) + " | " + text(range.smallest) + " | " + text(range.largest) + " |";
    EXPECT_NE(page.find(row), std::string::npos) << row;
  }
}

TEST(HostileCase, APartOfAnEmptyNameIsNoDataFile) {
  const std::string part =
      "[part]\nfile = \"\"\nunit = \"mm\"\n[part.material]\nyoungs_modulus = \"71 GPa\"\npoisson_ratio = 0.33\n"
      "density = \"2810 kg/m^3\"\n";
  EXPECT_EQ(refusal(part),
            "case.toml:2:8: part.file: names no file; write what is meant (Surface of the part: .stl, .off, .obj, "
            ".ply, .3mf, .glb, .gltf, "
            ".step; or its mesh: .msh, .inp, .vtu), or remove the key");
  const std::string matrices = "[part]\nunit = \"mm\"\nmass_unit = \"t\"\n[part.matrices]\nstiffness = \"\"\n";
  EXPECT_EQ(refusal(matrices),
            "case.toml:5:13: part.matrices.stiffness: names no file; write what is meant (K: Matrix Market, .sti of "
            "CalculiX, "
            "Abaqus, DMIG, OP2, OP4, MAT, NetCDF)");
  const std::string tool =
      "[tool]\nteeth = 2\ndiameter = \"10 mm\"\n[[tool.measured]]\nresponse = \"x\"\nforce = \"x\"\nfile = \"\"\n"
      "quantity = \"receptance\"\nunit = \"um/N\"\n";
  EXPECT_NE(refusal(tool).find("case.toml:7:8: tool.measured[0].file: names no file"), std::string::npos);
}

TEST(HostileCase, APipeOrAFolderIsNoDataFile) {
  const TemporaryFolder folder;
  const auto pipe = folder.path / "pipe.stl";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_directory(folder.path / "folder.stl");
  const auto part = [](const std::string& file) {
    return "[part]\nfile = \"" + file + "\"\nunit = \"mm\"\n[part.material]\nyoungs_modulus = \"71 GPa\"\n" +
           "poisson_ratio = 0.33\ndensity = \"2810 kg/m^3\"\n";
  };
  EXPECT_EQ(refusal(part("pipe.stl"), {}, folder.path),
            "case.toml:2:8: part.file: \"pipe.stl\" is a pipe or a device; name a plain file");
  EXPECT_EQ(refusal(part("folder.stl"), {}, folder.path),
            "case.toml:2:8: part.file: \"folder.stl\" is a folder; name a file in it");
  const std::string arm = "[robot]\nmodel = \"flexible_joints\"\nurdf = \"pipe.stl\"\njoints = \"pipe.stl\"\n" +
                          std::string("[robot.posture]\njoints = [0.0]\n");
  EXPECT_NE(refusal(arm, {}, folder.path).find("robot.joints: \"pipe.stl\" is a pipe"), std::string::npos);
  ASSERT_EQ(::mkfifo((folder.path / "expected.toml").c_str(), 0600), 0);
  EXPECT_THROW((void)read_expectations(folder.path / "case.toml"), core::InputError);
}

}  // namespace
}  // namespace thinwall::tests::hostile_case_test
