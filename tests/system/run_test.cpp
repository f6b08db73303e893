// The program as a user runs it: a process, its exit code, what it leaves.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "core/atomic_file.hpp"
#include "io/frf/response_csv.hpp"
#include "io/frf/uff_mesh.hpp"
#include "io/frf/uff_shapes.hpp"
#include "io/manifest.hpp"
#include "io/results/vtp.hpp"
#include "report/page/document.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::run_test {
namespace {

namespace fs = std::filesystem;

const std::string program = std::string(THINWALL_BUILD_DIR) + "/app/thinwall";
const std::string wall = std::string(THINWALL_SOURCE_DIR) + "/cases/cantilever-wall";
const std::string plate = std::string(THINWALL_SOURCE_DIR) + "/cases/barrios-2019";

fs::path scratch(const std::string& name) {
  const fs::path folder = tests::temporary_files() / name;
  fs::remove_all(folder);
  return folder;
}

pid_t start(const std::vector<std::string>& words, const fs::path& output) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  std::signal(SIGINT, SIG_DFL);  // which is ignored in all that a shell has put in the background
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const auto& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  if (std::freopen(output.c_str(), "w", stdout) == nullptr || std::freopen("/dev/null", "w", stderr) == nullptr)
    _exit(99);
  execv(program.c_str(), argv.data());
  _exit(99);
}

int exit_code(pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

int run(const std::vector<std::string>& words, const fs::path& output = "/dev/null") {
  return exit_code(start(words, output));
}

std::vector<fs::path> unfinished(const fs::path& folder) {
  std::vector<fs::path> found;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (core::is_partial_name(entry.path())) found.push_back(entry.path());
  }
  return found;
}

nlohmann::json summary_in(const fs::path& folder) {
  std::ifstream file(folder / "summary.json");
  return nlohmann::json::parse(file);
}

const std::vector<std::string> quick{"--set", "part.mesh.element_size=25 mm", "--set", "lobes.count=6",
                                     "--set", "response.lines=200",           "--set", "reduction.modes=20"};

std::vector<std::string> words(const std::string& verb, const std::string& source, const fs::path& out,
                               const std::vector<std::string>& more) {
  std::vector<std::string> all{verb, source, "--out", out.string()};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// H = Hᵀ to 1e-10 of the line's largest entry, and Im of the driving points never positive.
void expect_reciprocal_and_passive(const dynamics::ResponseModel& response, const std::string& name) {
  for (std::size_t line = 0; line < response.H.size(); ++line) {
    const Eigen::MatrixXcd& H = response.H[line];
    const double largest = H.cwiseAbs().maxCoeff();
    ASSERT_LE((H - H.transpose()).cwiseAbs().maxCoeff(), 1e-10 * largest) << name << " line " << line;
    ASSERT_LE(H.diagonal().imag().maxCoeff(), 0.0) << name << " line " << line;
  }
}

TEST(Run, FoldersThatAreNotARunsAreLeftAlone) {
  const fs::path out = scratch("run_foreign");
  fs::create_directories(out / "models");
  EXPECT_EQ(run(words("run", wall, out, {})), 4);
  EXPECT_TRUE(fs::exists(out / "models"));
}

/// Every file beside the log with its sum, the page among them, and the times of all stages, writing the page included.
void expect_whole_manifest(const fs::path& out) {
  const auto manifest = nlohmann::json::parse(core::read_file(out / "manifest.json"));
  std::vector<std::string> names;
  for (const auto& file : manifest["outputs"]) {
    names.push_back(file["name"]);
    EXPECT_EQ(file["sha256"], io::sha256_of_file(out / names.back())) << names.back();
  }
  for (const char* name : {"report.html", "summary.json", "modes/modes.csv", "case.resolved.toml"})
    EXPECT_EQ(std::ranges::count(names, name), 1) << name;
  double sum = 0.0;
  for (const auto& [stage, seconds] : manifest["timings_s"].items())
    sum += stage == "total" ? 0.0 : seconds.get<double>();
  EXPECT_GT(manifest["timings_s"]["report"].get<double>(), 0.0);
  EXPECT_LE(sum, manifest["timings_s"]["total"].get<double>());
  EXPECT_EQ(manifest["timings_s"], summary_in(out)["timings_s"]);
  const bool repository = fs::exists(fs::path(THINWALL_SOURCE_DIR) / ".git");
  EXPECT_EQ(manifest["program"].value("commit", "").size() >= 7, repository);
}

/// Shapes of which the largest entry is 1 at most (the robot's end may hold it), the factor to show them by, and the
/// same shapes on the corners of the surface for programs of modal tests.
void expect_shapes_in_one_scale(const fs::path& modes, const std::string& of) {
  const io::SurfaceFields surface = io::read_vtp(modes / (of + "_surface.vtp"));
  Eigen::AlignedBox3d box;
  for (const auto& x : surface.surface.vertices) box.extend(x);
  ASSERT_EQ(surface.of_file.size(), 1U);
  EXPECT_EQ(surface.of_file[0].name, "warp_factor");
  EXPECT_NEAR(surface.of_file[0].value, 0.05 * box.diagonal().norm(), 1e-6 * box.diagonal().norm());
  const io::UffShapes test = io::read_uff_shapes(modes / (of + ".uff"));
  const io::UffMesh geometry = io::read_uff_mesh(modes / (of + ".uff"));
  EXPECT_TRUE(test.notes.empty() && geometry.notes.empty());
  ASSERT_EQ(test.shapes.size(), surface.vectors.size());
  std::set<std::pair<long, long>> drawn;
  for (const io::UffTraceLine& line : geometry.lines) {
    for (std::size_t i = 1; i < line.nodes.size(); ++i) {
      if (line.nodes[i - 1] == 0 || line.nodes[i] == 0) continue;
      EXPECT_TRUE(drawn.insert(std::minmax(line.nodes[i - 1], line.nodes[i])).second) << "an edge is drawn twice";
    }
  }
  EXPECT_EQ(drawn.size(), 3 * (geometry.nodes.size() - 2)) << "edges of a closed surface of triangles without holes";
  for (std::size_t k = 0; k < test.shapes.size(); ++k) {
    const double largest = surface.vectors[k].values.cwiseAbs().maxCoeff();
    EXPECT_LE(largest, 1.0 + 1e-6);
    if (of == "part") {
      EXPECT_NEAR(largest, 1.0, 0.02) << "mode " << k + 1;
    }
    if (of == "part") {
      EXPECT_GT(test.shapes[k].modal_mass, 0.0);
    }
    EXPECT_EQ(test.shapes[k].nodes.size(), geometry.nodes.size());
    const double on_corners = test.shapes[k].displacement.cwiseAbs().maxCoeff();
    EXPECT_LE(on_corners, largest + 1e-5);
    EXPECT_GE(on_corners, 0.5 * largest) << "mode " << k + 1;
  }
}

TEST(Run, LeavesEveryFileOfAResultFolder) {
  const fs::path out = scratch("run_plate");
  const fs::path table = scratch("run_plate.txt");
  const int code = run(words("run", plate, out, quick), table);
  EXPECT_TRUE(code == 0 || code == 6) << code;
  for (const char* name : {"summary.json",
                           "manifest.json",
                           "case.toml",
                           "case.resolved.toml",
                           "run.log",
                           "modes/part.pvd",
                           "modes/part_mode_01.vtu",
                           "modes/coupled.pvd",
                           "modes/coupled_mode_01.vtu",
                           "modes/modes.csv",
                           "frf/part.csv",
                           "frf/part_added.csv",
                           "modes/part.uff",
                           "modes/coupled.uff",
                           "frf/part.uff",
                           "frf/robot.csv",
                           "frf/coupled_receptance.csv",
                           "frf/coupled_spatial.csv",
                           "frf/coupled_receptance_added.csv",
                           "lobes/part.csv",
                           "lobes/supported.csv",
                           "models/part.mat"}) {
    EXPECT_TRUE(fs::exists(out / name)) << name;
  }
  EXPECT_TRUE(unfinished(out).empty());
  expect_shapes_in_one_scale(out / "modes", "part");
  expect_shapes_in_one_scale(out / "modes", "coupled");
  expect_whole_manifest(out);
  const auto summary = summary_in(out);
  EXPECT_LE(summary["coupling"]["route_difference"]["max_relative"].get<double>(), 1e-9);
  EXPECT_LE(summary["part"]["mass_difference_relative"].get<double>(), 1e-9);
  EXPECT_TRUE(fs::exists(out / "case.fitted.toml")) << "what updating found";
  for (const char* name : {"part.csv", "robot.csv", "coupled_receptance.csv", "coupled_spatial.csv"}) {
    expect_reciprocal_and_passive(io::read_response(out / "frf" / name), name);
  }
  std::ifstream text(table);
  std::string all((std::istreambuf_iterator<char>(text)), {});
  EXPECT_NE(all.find("part alone"), std::string::npos) << "the answer comes first";
}

/// The plate of reference/structures.md: 3-D frequencies in Hz, right to 1e-4.
TEST(Run, ThePageHasWhatItDrawsBesideTheLobes) {
  const fs::path out = scratch("run_cutting");
  std::vector<std::string> more = quick;
  more.insert(more.end(), {"--set", "machine.max_spindle_speed=2800 rpm"});
  const int code = run(words("run", plate, out, more));
  ASSERT_TRUE(code == 0 || code == 6) << code;
  const nlohmann::json document = report::document({{out}, "thinwall"}), cutting = document["runs"][0]["cutting"];
  EXPECT_EQ(cutting["teeth"], 6);
  EXPECT_DOUBLE_EQ(cutting["depth_limit_m"].get<double>(), 0.02) << "the tool's length";
  EXPECT_DOUBLE_EQ(cutting["spindle_speed_rpm"].get<double>(), 1900.0);
  EXPECT_EQ(cutting["spindle_range_rpm"], nlohmann::json({0.0, 2800.0}));
  EXPECT_EQ(cutting["depth_limit_is"], "tool_length");
  EXPECT_EQ(cutting["at"], "P");
  // 6 teeth and 1.8 m/min: the feed of a tooth at 1900 rpm is kept, so the rate is ae·a·f z n, in cm³/min of m and rpm.
  EXPECT_NEAR(cutting["removal_cm3_per_min_per_m_rpm"].get<double>(), 0.2e-3 * 1.8 / 1900.0 * 1e6, 1e-9);
  const nlohmann::json points = document["runs"][0]["shapes"]["points"];
  ASSERT_EQ(points.size(), 2U);
  EXPECT_EQ(points[0]["directions"].size(), 3U);
  EXPECT_EQ(points[0]["joined"], nlohmann::json({{1.0, 0.0, 0.0}})) << "the robot holds x of P";
  EXPECT_EQ(points[1]["joined"], nlohmann::json::array()) << "and nothing of P2";
  EXPECT_FALSE(document["runs"][0]["sentences"].empty());
}

TEST(Run, AToleranceAloneGivesThePlatesFrequenciesWithinItAndSaysSo) {
  const fs::path out = scratch("run_tolerance");
  const fs::path source = scratch("run_tolerance_case");
  fs::create_directories(source);
  std::ofstream(source / "case.toml") << R"([part]
length = "450 mm"
height = "100 mm"
thickness = "6 mm"
[part.material]
youngs_modulus = "210 GPa"
poisson_ratio = 0.3
density = "7850 kg/m^3"
[part.mesh]
tolerance = 0.0005
[[part.supports]]
on = "y_min"
[[part.supports]]
on = "y_max"
[modes]
count = 7
)";
  ASSERT_EQ(run(words("run", source.string(), out, {"-q"})), 0);
  const auto summary = summary_in(out);
  const double reference[] = {160.73, 442.17, 475.67, 866.55, 989.0, 1431.95, 1571.11};
  double worst = 0.0;
  for (std::size_t k = 0; k < 7; ++k)
    worst = std::max(worst, summary["part"]["modes"][k]["frequency_hz"].get<double>() / reference[k] - 1.0);
  const auto estimate = summary["mesh"]["error_estimate"];
  std::printf("tolerance 5e-4: seven modes within %.1e, estimate %.1e, %d degrees of freedom, %.2f s\n", worst,
              estimate["max_relative_frequency_error"].get<double>(), summary["mesh"]["dofs"].get<int>(),
              summary["timings_s"]["total"].get<double>());
  EXPECT_LT(worst, 5e-4);
  EXPECT_TRUE(estimate["met"].get<bool>());
  EXPECT_LT(estimate["max_relative_frequency_error"].get<double>(), 5e-4);
  // The reference itself is right to 1e-4.
  EXPECT_LT(worst, estimate["max_relative_frequency_error"].get<double>() + 1e-4);
  EXPECT_TRUE(fs::exists(out / "modes" / "part_surface.vtp"));
}

TEST(Run, TheResolvedCaseGivesTheSameNumbersAndAnotherRunDoesToo) {
  const fs::path a = scratch("run_same_a");
  const fs::path b = scratch("run_same_b");
  const std::vector<std::string> small{"--set", "part.mesh.element_size=12 mm", "--set", "lobes.count=4",
                                       "--set", "response.lines=100",           "--set", "reduction.up_to=8 kHz"};
  ASSERT_EQ(run(words("run", wall, a, small)), 0);
  const fs::path resolved = scratch("run_resolved") / "cantilever-wall";
  fs::create_directories(resolved);
  fs::copy_file(a / "case.resolved.toml", resolved / "case.toml");
  fs::copy_file(fs::path(wall) / "expected.toml", resolved / "expected.toml");
  const auto one_thread = words("run", resolved.string(), b, {"--threads", "1"});
  ASSERT_EQ(run(one_thread), 0);
  EXPECT_EQ(run({"compare", a.string(), b.string(), "--tolerance", "1e-6"}), 0)
      << "numbers do not depend on threads or on how a default was written";
}

TEST(Run, InterruptionAtAnyStageLeavesTheEarlierResultsAlone) {
  const fs::path out = scratch("run_interrupted");
  fs::create_directories(out);
  core::write_file_atomically(out / "summary.json", "{\"earlier\": true}\n");
  int interrupted = 0;
  for (const int milliseconds : {20, 150, 500, 1000, 2000}) {
    const pid_t pid = start(words("run", wall, out, {}), "/dev/null");
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    kill(pid, SIGINT);
    const int code = exit_code(pid);
    // Before the handlers stand, the signal ends the process itself (-1); after the end there is nothing to interrupt
    // (0).
    EXPECT_TRUE(code == 130 || code == -1 || code == 0) << code;
    if (code == 0) break;
    interrupted += code == 130 ? 1 : 0;
    EXPECT_TRUE(summary_in(out).contains("earlier"));
    EXPECT_FALSE(fs::exists(out / "modes"));
    EXPECT_TRUE(code == -1 || unfinished(out).empty());
  }
  EXPECT_GE(interrupted, 2);
}

/// Runs with a limit of memory; the exit code, and the most that the process ever held, bytes.
std::pair<int, double> run_within(const std::string& memory, const fs::path& out) {
  std::vector<std::string> all = words("run", plate, out, {"--fresh", "-q", "--memory", memory});
  all.insert(all.end(), {"--set", "lobes.count=4"});
  const pid_t pid = start(all, "/dev/null");
  int status = 0;
  rusage used{};
  wait4(pid, &status, 0, &used);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, 1024.0 * static_cast<double>(used.ru_maxrss)};
}

/// Of a part that takes some 0.8 GB: what is beyond the limit is refused or ended, and what is within goes through.
TEST(Run, TheProcessStaysWithinItsMemory) {
#if defined(THINWALL_ADDRESS_SANITIZER)
  GTEST_SKIP() << "the address sanitizer takes memory of its own";
#endif
  const fs::path out = scratch("run_memory");
  const std::vector<std::pair<std::string, double>> limits{{"150 MB", 1.5e8}, {"250 MB", 2.5e8}, {"500 MB", 5e8}};
  for (const auto& [text, bytes] : limits) {
    const auto [code, most] = run_within(text, out);
    std::printf("memory %s: exit code %d, at most %.0f MB\n", text.c_str(), code, most * 1e-6);
    EXPECT_EQ(code, 5) << text;
    EXPECT_LE(most, bytes) << text;
    EXPECT_FALSE(fs::exists(out / "summary.json"));
  }
  const auto [code, most] = run_within("4 GB", out);
  EXPECT_TRUE(code == 0 || code == 6) << code;
  EXPECT_GT(most, 5e8) << "the limits above are too little";
  EXPECT_EQ(run_within("4 apples", out).first, 2);
  EXPECT_EQ(run_within("4 MB", out).first, 2);
}

TEST(Run, TwoRunsDoNotMeetInOneFolder) {
  const fs::path out = scratch("run_twice");
  const pid_t first = start(words("run", wall, out, {}), "/dev/null");
  while (!fs::exists(out / "run.log"))
    std::this_thread::sleep_for(std::chrono::milliseconds(5));  // the folder is taken
  EXPECT_EQ(run(words("run", wall, out, {})), 4);
  kill(first, SIGINT);
  EXPECT_EQ(exit_code(first), 130);
}

}  // namespace
}  // namespace thinwall::run_test
