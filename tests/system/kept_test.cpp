// What a run keeps for the next one: nothing is computed twice, nothing that has changed is taken over.

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

#include "app/command_line.hpp"
#include "case/keys.hpp"
#include "core/atomic_file.hpp"
#include "io/program_id.hpp"
#include "report/summary/summary_json.hpp"
#include "run_in_folder.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/kept/stage_keys.hpp"
#include "tests/system/kept_wall.hpp"

namespace thinwall::tests::kept_test {

using namespace io;
using namespace app;
using namespace setup;
using namespace cases;
using namespace study;
using namespace report;

namespace {

namespace fs = std::filesystem;

const std::string wall = kept_wall();

/// Three positions along the wall's top; the point Q is on it, too.
std::string along_path(const std::string& text) {
  return text + R"([points.Q]
position = ["20 mm", "3 mm", "50 mm"]
patch_radius = "3 mm"
[path]
from = ["20 mm", "3 mm", "50 mm"]
to = ["40 mm", "3 mm", "50 mm"]
positions = 3
support = "follows"
)";
}

nlohmann::json without_times(nlohmann::json summary) {
  summary.erase("timings_s");
  return summary;
}

bool meshed(const nlohmann::json& summary) {
  return summary["timings_s"].contains("mesh");
}

TEST(Kept, TheSecondRunIsTheFirstOneWithoutItsMesh) {
  const fs::path folder = scratch("kept_twice");
  const auto first = run_kept(wall, folder);
  const auto chart = core::read_file(folder / "lobes" / "supported.csv");
  const auto second = run_kept(wall, folder);
  EXPECT_TRUE(meshed(first));
  EXPECT_FALSE(meshed(second));
  EXPECT_EQ(without_times(first), without_times(second)) << "to the last bit";
  EXPECT_EQ(core::read_file(folder / "lobes" / "supported.csv"), chart);
  const auto fresh = run_kept(wall, folder, true);
  EXPECT_TRUE(meshed(fresh)) << "--fresh";
}

/// The lines of the tool end below the teeth of a point at 60 000 rpm, which is refused before the part is computed.
TEST(Kept, NothingWhereThePointIsRefused) {
  const fs::path folder = scratch("kept_refused"), out = folder / "out";
  std::ofstream tip(folder / "tip.csv");
  for (double hz = 50.0; hz < 2500.0; hz += 10.0) {
    const std::complex<double> value =
        1e-7 / (1.0 - std::pow(hz / 900.0, 2) + std::complex<double>(0.0, 0.1 * hz / 900.0));
    tip << hz << ", " << value.real() << ", " << value.imag() << '\n';
  }
  tip.close();
  std::ofstream(folder / "case.toml") << wall.substr(0, wall.find("[path]"))
                                      << "[[tool.measured]]\nresponse = \"y\"\nforce = \"y\"\nfile = \"tip.csv\"\n"
                                         "quantity = \"receptance\"\nunit = \"m/N\"\n";
  const std::string case_file = (folder / "case.toml").string(), results = out.string();
  const std::array<const char*, 8> words{"thinwall", "run",  case_file.c_str(),  "--out", results.c_str(),
                                         "-q",       "--at", "60000 rpm, 0.1 mm"};
  std::ostringstream told, refused;
  EXPECT_EQ(app::run_command_line(static_cast<int>(words.size()), words.data(), app::run_case, told, refused), 3);
  EXPECT_NE(refused.str().find("do not hold the harmonic"), std::string::npos) << refused.str();
  EXPECT_FALSE(fs::exists(out));
}

TEST(Kept, WhatChangesIsComputedAnew) {
  const fs::path folder = scratch("kept_changed"), alone = scratch("kept_alone");
  (void)run_kept(wall, folder);
  const std::string cut = replaced(wall, "Kt = \"800 MPa\"", "Kt = \"900 MPa\"");
  const auto other_cut = run_kept(cut, folder);
  EXPECT_FALSE(meshed(other_cut)) << "the part is the same";
  EXPECT_EQ(without_times(other_cut)["lobes"], without_times(run_kept(cut, alone))["lobes"]);
  const std::string thick = replaced(cut, "thickness = \"3 mm\"", "thickness = \"4 mm\"");
  const auto other_part = run_kept(thick, folder);
  EXPECT_TRUE(meshed(other_part));
  EXPECT_EQ(without_times(other_part), without_times(run_kept(thick, alone)));
}

TEST(Kept, ADamagedFileIsUsedAsFarAsItIsSound) {
  const fs::path folder = scratch("kept_damaged");
  const auto first = run_kept(wall, folder);
  const fs::path part = folder / "cache" / "part.bin", lobes = folder / "cache" / "lobes.bin";
  std::string bytes = core::read_file(part);
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  core::write_file_atomically(part, bytes);
  fs::resize_file(lobes, fs::file_size(lobes) - 7);  // as if interrupted while it was written
  const auto second = run_kept(wall, folder);
  EXPECT_TRUE(meshed(second)) << "a piece with another sum is no piece";
  EXPECT_EQ(without_times(first), without_times(second));
  core::write_file_atomically(part, "thinwall-checkpoint 0 of another program\n");
  EXPECT_TRUE(meshed(run_kept(wall, folder)));
  EXPECT_FALSE(meshed(run_kept(wall, folder))) << "rebuilt";
}

/// Names of the pieces in a file of kept results: lengths of name and bytes, their sum, and both in the next line.
std::vector<std::string> pieces_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string line, sum;
  std::vector<std::string> names;
  std::getline(in, line);
  std::streamoff name_size = 0, size = 0;
  while (in >> name_size >> size >> sum) {
    std::string name(static_cast<std::size_t>(name_size), ' ');
    in.ignore(1);
    in.read(name.data(), name_size);
    in.seekg(size, std::ios::cur);
    names.push_back(name);
  }
  return names;
}

/// Charts that end after their first speeds go on from there, to the same end; what is there is not computed again.
TEST(Kept, InterruptedChartsGoOn) {
  const fs::path folder = scratch("kept_interrupted");
  const std::string text = replaced(along_path(wall), "count = 72", "count = 24");
  const nlohmann::json summary = run_kept(text, folder);
  std::size_t added = 0;
  for (const auto& of : summary["lobes"]) added += of["line"]["speeds_added"].get<std::size_t>();
  const fs::path lobes = folder / "cache" / "lobes.bin", chart = folder / "lobes" / "supported_path.csv";
  const std::string whole = core::read_file(chart), bytes = core::read_file(lobes);
  auto pieces = pieces_of(lobes);
  EXPECT_GT(added, 0U);
  EXPECT_EQ(pieces.size(), 2U * 3U + added + 2U * 1U + 2U * 1U + 2U * 24U)
      << "of two charts by blocks of eight speeds, by added speeds and the case's own, their errors, and along the "
         "path "
         "by speeds";
  fs::resize_file(lobes, bytes.size() * 4 / 5);
  (void)run_kept(text, folder);
  EXPECT_EQ(core::read_file(chart), whole);
  const std::string again = core::read_file(lobes);
  EXPECT_EQ(again.size(), bytes.size()) << "the pieces that were missing are there again";
  EXPECT_EQ(again.substr(0, again.size() * 3 / 4), bytes.substr(0, bytes.size() * 3 / 4)) << "the others stayed";
  auto now = pieces_of(lobes);
  std::ranges::sort(pieces);
  std::ranges::sort(now);
  EXPECT_EQ(now, pieces) << "each once";
  (void)run_kept(text, folder);
  EXPECT_EQ(core::read_file(lobes), again) << "nothing was computed";
}

/// Runs in folders of their own share the parts that are the same, as the points of a sweep do.
TEST(Kept, PartsMayBeSharedByManyRuns) {
  const fs::path parts = scratch("kept_parts");
  const auto run = [&](const std::string& text, const std::string& name) {
    RunOptions options{scratch(name), false, -1, false};
    options.parts = parts;
    return summary_json(run_case(parse_case(text, options.out), options).summary);
  };
  const std::string cut = replaced(wall, "radial_depth = \"1 mm\"", "radial_depth = \"0.5 mm\"");
  const std::string thick = replaced(wall, "thickness = \"3 mm\"", "thickness = \"4 mm\"");
  EXPECT_TRUE(meshed(run(wall, "kept_parts_a")));
  const auto other_cut = run(cut, "kept_parts_b");
  EXPECT_FALSE(meshed(other_cut));
  EXPECT_EQ(without_times(other_cut), without_times(run_kept(cut, scratch("kept_parts_alone"))));
  EXPECT_TRUE(meshed(run(thick, "kept_parts_c")));
  EXPECT_FALSE(meshed(run(wall, "kept_parts_d"))) << "the other part is there, too";
}

/// Whatever is taken over from a run before, the results are those of a run from nothing.
TEST(Kept, WhatIsTakenOverIsWhatAFreshRunWouldGive) {
  struct Change {
    std::string from, to;
    bool same_part;
  };
  const std::string law =
      replaced(replaced(wall, "Kt = ", "law = \"power\"\nexponents = [0.3]\nfeed_rate = \"600 mm/min\"\nKt = "),
               "count = 72", "count = 8");
  const std::string path = replaced(along_path(wall), "count = 72", "count = 8");
  const std::vector<std::pair<std::string, Change>> changes{
      {path, {"at = \"P\"", "at = \"Q\"", false}},
      {path, {"part = \"P\"", "part = \"Q\"", false}},
      {path, {"radial_depth = \"1 mm\"", "radial_depth = \"0.5 mm\"", true}},
      {path, {"ratio = 0.01", "ratio = 0.03", true}},
      {law, {"8000 rpm", "10000 rpm", true}},
      {law, {"feed_rate = \"600 mm/min\"", "feed_rate = \"900 mm/min\"", true}},
      {law, {"ratio = 0.01", "ratio = 0.03", true}},
      {law, {"frequency = \"30 Hz\"", "frequency = \"45 Hz\"", true}},
      {law, {"stiffness = \"1e6 N/m\"", "stiffness = \"2e6 N/m\"", true}},
      {law, {"teeth = 4", "teeth = 2", true}},
      {law, {"tolerance = 0.01", "tolerance = 0.001", true}},
      {law, {"modes = 6", "modes = 8", false}}};
  const std::size_t step = std::getenv("THINWALL_SLOW") != nullptr ? 1 : 4;  // every fourth change in the short run
  for (std::size_t i = 0; i < changes.size(); i += step) {
    const auto& [text, change] = changes[i];
    const fs::path folder = scratch("kept_over"), alone = scratch("kept_over_alone");
    (void)run_kept(text, folder);
    const std::string changed = replaced(text, change.from, change.to);
    const auto kept = run_kept(changed, folder);
    EXPECT_EQ(meshed(kept), !change.same_part) << change.to;
    EXPECT_EQ(without_times(kept), without_times(run_kept(changed, alone))) << change.to;
    for (const char* file : {"frf/coupled_receptance.csv", "lobes/supported.csv", "modes/coupled_modes.csv"})
      EXPECT_EQ(core::read_file(folder / file), core::read_file(alone / file)) << file << " " << change.to;
    const fs::path along = fs::path("lobes") / "supported_path.csv";
    if (!fs::exists(alone / along)) continue;
    EXPECT_EQ(core::read_file(folder / along), core::read_file(alone / along)) << change.to;
  }
}

/// Files of an unchanged structure stay the same files; one that was touched is written anew.
TEST(Kept, FilesOfTheSameStructureStay) {
  const fs::path folder = scratch("kept_files");
  const auto file_number = [](const fs::path& file) {
    struct stat status {};
    EXPECT_EQ(::stat(file.c_str(), &status), 0) << file;
    return status.st_ino;
  };
  const fs::path shape = folder / "modes" / "part_mode_01.vtu", frf = folder / "frf" / "part.csv";
  (void)run_kept(wall, folder);
  const auto number = file_number(shape);
  const std::string values = core::read_file(frf);
  const std::string cut = replaced(wall, "Kt = \"800 MPa\"", "Kt = \"900 MPa\"");
  (void)run_kept(cut, folder);
  EXPECT_EQ(file_number(shape), number);
  const auto pieces = pieces_of(folder / "cache" / "structure.bin");
  EXPECT_EQ(pieces.size(), 4U) << "coupling, files and two sections of the page; nothing was added by the second run";
  std::ofstream(frf, std::ios::app) << "0,0,0\n";
  (void)run_kept(wall, folder);
  EXPECT_EQ(core::read_file(frf), values) << "what somebody wrote into it is gone";
  fs::remove(shape);
  (void)run_kept(cut, folder);
  EXPECT_TRUE(fs::exists(shape));
}

TEST(Kept, PiecesMayHaveAnyName) {
  const fs::path file = scratch("kept_names") / "pieces.bin";
  const std::vector<std::string> names{"plain", "with blanks", "7 5 of\nnumbers", "", std::string(500, 'x'), "\xff"};
  {
    Checkpoint kept(file, "key", false);
    for (const std::string& name : names) kept.add(name, "bytes of " + name);
  }
  const Checkpoint kept(file, "key", false);
  for (const std::string& name : names) {
    ASSERT_NE(kept.find(name), nullptr) << name;
    EXPECT_EQ(*kept.find(name), "bytes of " + name);
  }
  EXPECT_EQ(kept.find("another"), nullptr);
  EXPECT_EQ(Checkpoint(file, "other key", false).find("plain"), nullptr);
}

TEST(Kept, TheProgramIsKnownByWhatItHolds) {
  EXPECT_EQ(program_id().size(), 40U) << "the linker's build ID, a SHA-1";
  EXPECT_EQ(program_id().find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Kept, WhereAPathLeadsThePointThatIsCutBelongsToTheStructure) {
  const fs::path folder = scratch("kept_path_keys");
  const std::string path = along_path(wall);
  const auto key = [&](const std::string& text) { return study::structure_key(parse_case(text, folder)); };
  EXPECT_NE(key(path), key(replaced(path, "at = \"P\"", "at = \"Q\""))) << "postures of the robot follow from it";
  EXPECT_EQ(key(path), key(replaced(path, "radial_depth = \"1 mm\"", "radial_depth = \"2 mm\"")));
  EXPECT_EQ(key(wall), key(replaced(wall, "radial_depth = \"1 mm\"", "radial_depth = \"2 mm\"")));
}

TEST(Kept, KeysTellWhatTheyStandFor) {
  const fs::path folder = scratch("kept_keys");
  const auto key = [&](const std::string& text, const std::vector<std::string>& without) {
    return key_of(parse_case(text, folder), without);
  };
  const std::string other_speed = replaced(wall, "8000 rpm", "9000 rpm");
  EXPECT_EQ(key(wall, {}), key(wall + "# a comment\n", {}));
  EXPECT_NE(key(wall, {}), key(other_speed, {}));
  EXPECT_EQ(key(wall, {"cutting.spindle_speed"}), key(other_speed, {"cutting.spindle_speed"}));
  EXPECT_NE(key(wall, {"cutting.spindle"}), key(other_speed, {"cutting.spindle"}))
      << "a key, not the letters it begins with";
}

}  // namespace
}  // namespace thinwall::tests::kept_test
