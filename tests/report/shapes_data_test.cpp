#include "report/page/shapes_data.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "io/results/csv_table.hpp"
#include "io/results/vtp.hpp"
#include "result_folder.hpp"
#include "unpacked.hpp"

namespace thinwall::report::shapes_data_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;
using Numbers = std::vector<double>;

/// A square of two triangles, the first held by "left", the second by "right"; its modes move vertex 3 along z by 2 and
/// vertex 1 along x by −4.
void write_square(const fs::path& file, int modes) {
  mesh::LagrangeNodes nodes;
  nodes.positions.resize(4, 3);
  nodes.positions << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  std::vector<io::NodeVectors> shapes;
  for (int k = 0; k < modes; ++k) {
    shapes.push_back({"mode 0" + std::to_string(k + 1), {}});
    shapes.back().values.setZero(4, 3);
    shapes.back().values(3, 2) = k == 0 ? 2.0 : 0.0;
    shapes.back().values(1, 0) = k == 1 ? -4.0 : 0.0;
  }
  io::write_vtp(file, nodes, {{0, 1, 2}, {1, 3, 2}}, shapes,
                {{"held", {1.0, 1.0}}, {"held by left", {1.0, 0.0}}, {"held by right", {0.0, 1.0}}});
}

fs::path square(const std::string& name, const io::Table& modes) {
  const fs::path folder = result_folder(name);
  write_square(folder / "modes" / "part_surface.vtp", 2);
  io::write_csv(folder / "modes" / "modes.csv", modes);
  return folder;
}

const io::Table two_modes{
    {"mode", Numbers{1, 2}}, {"frequency_hz", Numbers{100.0, 250.5}}, {"damping_ratio", Numbers{0.01, NAN}, true}};

void expect_shapes_refused(const fs::path& folder, const std::string& file) {
  try {
    (void)shapes_data(folder, Summary{});
    FAIL() << file;
  } catch (const core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
  }
}

TEST(ShapesData, AreTheModesOfTheTableOnTheSurface) {
  const json shapes = shapes_data(square("shapes_square", two_modes), Summary{})["shapes"];
  ASSERT_EQ(shapes["modes"].size(), 2U);
  const json &first = shapes["modes"][0], &second = shapes["modes"][1];
  EXPECT_EQ(first["hz"], 100.0);
  EXPECT_EQ(first["damping"], 0.01);
  EXPECT_EQ(second["hz"], 250.5);
  EXPECT_TRUE(second["damping"].is_null()) << "not known, not undamped";
  const auto shape = unpacked<std::int16_t>(first["shape"]);
  EXPECT_NEAR(shape[3 * 3 + 2] * first["step"].get<double>(), 1.0, 1e-3);
  EXPECT_NEAR(unpacked<std::int16_t>(second["shape"])[3 * 1 + 0] * second["step"].get<double>(), -1.0, 1e-3);
  const auto places = unpacked<std::int16_t>(shapes["vertices"]);
  const double step = shapes["step_m"];
  EXPECT_NEAR(shapes["origin_m"][0].get<double>() + step * places[3 * 1], 1.0, 1e-4);
  EXPECT_EQ(unpacked<std::uint32_t>(shapes["triangles"]), (std::vector<std::uint32_t>{0, 1, 2, 1, 3, 2}));
}

TEST(ShapesData, SupportsHaveTheirNames) {
  const json fixtures = shapes_data(square("shapes_supports", two_modes), Summary{})["shapes"]["fixtures"];
  ASSERT_EQ(fixtures.size(), 2U);
  EXPECT_EQ(fixtures[0]["name"], "left");
  EXPECT_EQ(unpacked<std::uint32_t>(fixtures[0]["triangles"]), (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(fixtures[1]["name"], "right");
  EXPECT_EQ(unpacked<std::uint32_t>(fixtures[1]["triangles"]), (std::vector<std::uint32_t>{1}));
}

/// The robot's end moves five times as far as the part: it has length 1 on the page, the part a fifth.
TEST(ShapesData, PartAndRobotHaveOneScale) {
  const fs::path folder = square("shapes_robot", two_modes);
  write_square(folder / "modes" / "coupled_surface.vtp", 1);
  io::write_csv(folder / "modes" / "coupled_modes.csv", {{"mode", Numbers{1}},
                                                         {"frequency_hz", Numbers{30.0}},
                                                         {"damping_ratio", Numbers{0.02}},
                                                         {"robot_x", Numbers{6.0}},
                                                         {"robot_y", Numbers{-8.0}},
                                                         {"robot_z", Numbers{0.0}}});
  const json mode = shapes_data(folder, Summary{})["shapes"]["modes"][2];
  EXPECT_EQ(mode["of"], "coupled");
  EXPECT_NEAR(mode["robot"][0].get<double>(), 0.6, 1e-12);
  EXPECT_NEAR(mode["robot"][1].get<double>(), -0.8, 1e-12);
  EXPECT_NEAR(unpacked<std::int16_t>(mode["shape"])[3 * 3 + 2] * mode["step"].get<double>(), 0.2, 1e-3);
}

TEST(ShapesData, TheMacIsTheTable) {
  const fs::path folder = square("shapes_mac", two_modes);
  io::write_csv(folder / "modes" / "coupled_modes.csv",
                {{"mode", Numbers{1, 2, 3}}, {"frequency_hz", Numbers{30.0, 40.0, 50.0}}});
  io::write_csv(folder / "modes" / "mac.csv", {{"part_mode", Numbers{1, 2}},
                                               {"coupled_mode_1", Numbers{0.5, 0.25}},
                                               {"coupled_mode_2", Numbers{1.0, 0.0}},
                                               {"coupled_mode_3", Numbers{0.0, 0.125}}});
  const json mac = shapes_data(folder, Summary{})["mac"];
  EXPECT_EQ(mac["values"]["shape"], (std::vector<int>{2, 3}));
  EXPECT_EQ(unpacked<float>(mac["values"]), (std::vector<float>{0.5F, 1.0F, 0.0F, 0.25F, 0.0F, 0.125F}));
  EXPECT_EQ(mac["row_hz"], (Numbers{100.0, 250.5}));
  EXPECT_EQ(mac["column_hz"], (Numbers{30.0, 40.0, 50.0}));
}

TEST(ShapesData, FilesThatAreNotAsWrittenAreNamed) {
  expect_shapes_refused(square("shapes_no_damping", {{"mode", Numbers{1, 2}}, {"frequency_hz", Numbers{100.0, 250.5}}}),
                        "modes.csv");
  expect_shapes_refused(
      square("shapes_few", {{"mode", Numbers{1}}, {"frequency_hz", Numbers{100.0}}, {"damping_ratio", Numbers{0.01}}}),
      "modes.csv");
  const fs::path folder = square("shapes_word", two_modes);
  core::write_file_atomically(folder / "modes" / "mac.csv", "part_mode,coupled_mode_1\n1,much\n2,more\n");
  expect_shapes_refused(folder, "mac.csv");
}

}  // namespace
}  // namespace thinwall::report::shapes_data_test
