// `thinwall postures`: a robot that is known at postures in closed form.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "app/case_run.hpp"
#include "core/atomic_file.hpp"
#include "io/results/csv_table.hpp"
#include "report/postures/posture_summary.hpp"
#include "report/summary/schema_of.hpp"
#include "tests/app/lobes_command.hpp"

namespace thinwall::tests::postures_command_test {
namespace {

/// Two modes, along x and along y, that cross over the posture u, 0 … 4.
double first_hz(double u) {
  return 20.0 * std::exp(0.05 * u);
}
double second_hz(double u) {
  return 24.0 * std::exp(-0.04 * u);
}

std::string row(double hz, double damping, double along_x) {
  const std::string x = std::to_string(along_x), y = std::to_string(0.01 - along_x);
  return std::to_string(hz) + "," + std::to_string(damping) + "," + x + ",0,0,-" + x + "," + y + ",0,0,-" + y + "\n";
}

class Postures : public testing::Test {
 protected:
  Postures() {
    std::string list = "posture,u\n";
    for (int i = 0; i < postures; ++i) {
      const double u = 4.0 * i / (postures - 1), damping = 0.02 + 0.002 * u;
      list += "p" + std::to_string(i) + "," + std::to_string(u) + "\n";
      std::vector<std::string> rows{row(first_hz(u), damping, 0.009), row(second_hz(u), damping, 0.001)};
      if (second_hz(u) < first_hz(u)) std::swap(rows[0], rows[1]);
      write("p" + std::to_string(i) + ".csv",
            "frequency_hz,damping_ratio,R_1X_re,R_1X_im,L_1X_re,L_1X_im,R_1Y_re,R_1Y_im,L_1Y_re,L_1Y_im\n" + rows[0] +
                rows[1]);
    }
    write("postures.csv", list);
    write("case.toml", R"([robot]
model = "modal_table"
carries = "tool"
postures = "postures.csv"
table = "{posture}.csv"
over = ["u"]
at = [1.7]
[tool]
teeth = 2
diameter = "10 mm"
length = "60 mm"
[cutting]
radial_depth = "5 mm"
feed_direction = "x"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
spindle_speed = "700 rpm"
[lobes]
from = "500 rpm"
to = "900 rpm"
count = 5
most_added = 0
)");
  }
  void write(const std::string& name, const std::string& text) const {
    core::write_file_atomically(temporary.path / name, text);
  }
  [[nodiscard]] Outcome command(const std::vector<std::string>& more) const { return command_of("postures", more); }
  [[nodiscard]] Outcome command_of(const std::string& name, const std::vector<std::string>& more) const {
    std::vector<std::string> words{name, temporary.path / "case.toml", "-q", "--out", temporary.path / "out"};
    words.insert(words.end(), more.begin(), more.end());
    return call(std::move(words), run_case);
  }
  [[nodiscard]] std::vector<double> numbers(const std::string& file, const std::string& column) const {
    const auto path = temporary.path / "out" / "postures" / file;
    return io::numbers_or_gaps(io::read_csv(path), column, path);
  }
  [[nodiscard]] nlohmann::json figures() const {
    return nlohmann::json::parse(core::read_file(temporary.path / "out" / "postures" / "postures.json"));
  }

  static constexpr int postures = 12;
  TemporaryFolder temporary;
};

/// A mode keeps its number through the crossing; those that are held out are told by the others.
TEST_F(Postures, AreFollowedAndToldByOthers) {
  const Outcome done = command({"--parts", "errors,sharing"});
  ASSERT_EQ(done.code, 0) << done.err;
  const auto u = numbers("modes.csv", "u"), mode = numbers("modes.csv", "mode"),
             hz = numbers("modes.csv", "frequency_hz");
  ASSERT_EQ(hz.size(), 2U * postures);
  const bool first_is_1 = std::abs(hz[0] - first_hz(0.0)) < 1e-4 ? mode[0] == 1.0 : mode[1] == 1.0;
  for (std::size_t i = 0; i < hz.size(); ++i)
    EXPECT_NEAR(hz[i], (mode[i] == 1.0) == first_is_1 ? first_hz(u[i]) : second_hz(u[i]), 1e-4);
  const nlohmann::json found = figures();
  ASSERT_EQ(found["modes"].size(), 2U);
  for (const auto& of : found["modes"]) {
    EXPECT_EQ(of["postures"], postures);
    EXPECT_EQ(of["numbers"].size(), 10U);
    EXPECT_LT(of["numbers"][0]["median_error"].get<double>(), 1e-3);  // of a range of 0.2
  }
  EXPECT_EQ(found["shared"].size(), 6U);
  EXPECT_GE(found["depths"]["covered"].get<double>(), 0.75);  // bands of 95 % hold fewer in one case of 500
  EXPECT_FALSE(found.contains("map"));
  EXPECT_NE(done.out.find("errors are those of postures that were held out"), std::string::npos) << done.out;
  // Each number of each mode at each posture; left out in closed form beside.
  const auto measured = numbers("errors.csv", "measured"), left_out = numbers("errors.csv", "left_out");
  ASSERT_EQ(measured.size(), 2U * postures * 10U);
  EXPECT_NEAR(left_out[60], measured[60], 0.01);
}

/// The page is whole, has what was asked for, and carries the text of a title that is HTML safely.
TEST_F(Postures, AreShownOnAPage) {
  write("case.toml", "title = \"</script>\"\n" + core::read_file(temporary.path / "case.toml"));
  const Outcome done = command({"--parts", "map,next", "--grid", "3"});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("postures.html"), std::string::npos) << done.out;
  const std::string page = core::read_file(temporary.path / "out" / "postures" / "postures.html");
  const std::string begin = "<script type=\"application/json\" id=\"data\">";
  const auto from = page.find(begin);
  ASSERT_NE(from, std::string::npos);
  const auto end = page.find("</script>", from);
  const auto data = nlohmann::json::parse(page.substr(from + begin.size(), end - from - begin.size()));
  EXPECT_EQ(data["title"], "</script>");
  const nlohmann::json& shown = data["postures"];
  EXPECT_EQ(shown["figures"], figures());
  EXPECT_EQ(shown["asked"], nlohmann::json({1.7}));
  EXPECT_EQ(shown["places"]["shape"], nlohmann::json({postures, 1}));
  EXPECT_EQ(shown["map"]["depth_m"]["shape"], nlohmann::json({3, 3}));
  EXPECT_EQ(shown["next"]["reduction"]["shape"], nlohmann::json({3}));
  for (const char* absent : {"modes", "depths", "envelope"}) EXPECT_FALSE(shown.contains(absent)) << absent;
}

/// The map has the lowest mode in closed form; depths lie within their bands, and the envelope below the low modes.
TEST_F(Postures, AreMapped) {
  const Outcome done = command({"--parts", "map,envelope", "--grid", "9"});
  ASSERT_EQ(done.code, 0) << done.err;
  const auto u = numbers("map.csv", "u"), hz = numbers("map.csv", "first_frequency_hz");
  const auto low = numbers("map.csv", "low_depth_m"), depth = numbers("map.csv", "depth_m"),
             high = numbers("map.csv", "high_depth_m");
  ASSERT_EQ(u.size(), 9U);
  for (std::size_t i = 0; i < u.size(); ++i) {
    EXPECT_NEAR(hz[i], std::min(first_hz(u[i]), second_hz(u[i])), 0.01);
    EXPECT_LE(low[i], depth[i]);
    EXPECT_GE(high[i], depth[i]);
  }
  const auto rpm = numbers("envelope.csv", "spindle_speed_rpm"), lower = numbers("envelope.csv", "envelope_depth_m"),
             low_modes = numbers("envelope.csv", "low_modes_depth_m");
  ASSERT_EQ(rpm.size(), 5U);
  EXPECT_EQ(rpm[2], 700.0);
  for (std::size_t i = 0; i < rpm.size(); ++i) EXPECT_LE(lower[i], low_modes[i]);
  EXPECT_FALSE(std::filesystem::exists(temporary.path / "out" / "postures" / "errors.csv"));
}

/// The map's depth at a place is that of a run with robot.at there: of the robot alone, with a tool that yields, which
/// takes depth, and without cross terms, which change it.
TEST_F(Postures, HaveTheDepthsOfARunThere) {
  const std::string plain = core::read_file(temporary.path / "case.toml");
  const std::string mode =
      "[[tool.modes]]\nfrequency = \"110 Hz\"\ndamping_ratio = 0.03\nstiffness = \"1 N/um\"\ndirection = \"y\"\n";
  std::string direct = plain;
  direct.replace(direct.find("carries"), 0, "cross_terms = false\n");
  std::vector<double> depths;
  for (const std::string& text : {plain, plain + mode, direct}) {
    write("case.toml", text);
    const Outcome run = command_of("run", {"--set", "robot.at=[1.5]"}),
                  mapped = command({"--parts", "map", "--grid", "9"});
    ASSERT_EQ(mapped.code, 0) << mapped.err;
    ASSERT_EQ(run.code, 0) << run.err;
    ASSERT_EQ(numbers("map.csv", "u").at(3), 1.5);
    depths.push_back(numbers("map.csv", "depth_m").at(3));
    const nlohmann::json summary = nlohmann::json::parse(core::read_file(temporary.path / "out" / "summary.json"));
    const double expected = summary["lobes"][0]["at_case_speed"]["limiting_depth_m"];
    EXPECT_NEAR(depths.back(), expected, 1e-4 * expected) << text;
  }
  EXPECT_LT(depths[1], 0.97 * depths[0]);
  EXPECT_GT(std::abs(depths[2] - depths[0]), 0.02 * depths[0]);
}

/// Of candidates within the path's range and far from it, on a robot that was tapped everywhere, those are listed by
/// what they take, and the best is told.
TEST_F(Postures, TellWhichToTapNext) {
  write("path.csv", "u\n3.2\n3.4\n");
  write("candidates.csv", "u\n0.1\n3.3\n");
  const Outcome done = command({"--parts", "next", "--path", (temporary.path / "path.csv").string(), "--candidates",
                                (temporary.path / "candidates.csv").string()});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(numbers("next.csv", "u")[0], 3.3);
  const auto reduction = numbers("next.csv", "reduction");
  EXPECT_GT(reduction[0], reduction[1]);
  EXPECT_NE(done.out.find("tap at u 3.3"), std::string::npos) << done.out;
  EXPECT_EQ(figures()["next"]["of_depth"], true);
}

TEST_F(Postures, HaveASchemaOfTheirFigures) {
  ASSERT_EQ(command({"--parts", "envelope"}).code, 0);
  const auto schema = report::file_schema<report::LearnedRobotSummary>("postures.json of thinwall");
  const nlohmann::json found = figures();
  for (const auto& [key, value] : found.items()) EXPECT_TRUE(schema["properties"].contains(key)) << key;
  for (const auto& key : schema["required"]) EXPECT_TRUE(found.contains(key.get<std::string>())) << key;
}

TEST_F(Postures, RefuseWhatCannotBeAsked) {
  EXPECT_EQ(command({"--parts", "error"}).code, 2);
  EXPECT_EQ(command({"--speed", "fast"}).code, 2);
  EXPECT_EQ(command({"--parts", "next", "--path", (temporary.path / "none.csv").string()}).code, 4);
  write("case.toml", "[robot]\nmodel = \"modal_table\"\ncarries = \"tool\"\ntable = \"p0.csv\"\n" + tool_toml);
  const Outcome without = command({});
  EXPECT_EQ(without.code, 3);
  EXPECT_NE(without.err.find("give robot.postures"), std::string::npos) << without.err;
  EXPECT_FALSE(std::filesystem::exists(temporary.path / "out")) << "nothing was computed";
}

}  // namespace
}  // namespace thinwall::tests::postures_command_test
