// Parts from files through the whole pipeline: the same part described in two ways gives the same results.

#include <gtest/gtest.h>

#include "app/case_reader.hpp"
#include "app/pipeline.hpp"
#include "app/reduce_command.hpp"
#include "io/stl.hpp"
#include "mesh/box.hpp"
#include "mesh/shapes.hpp"

namespace thinwall::app {
namespace {

namespace fs = std::filesystem;

const std::string rest = R"(
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
tolerance = 0.005
[[part.supports]]
on = "y_min"
[points.P]
position = ["30 mm", "100 mm", "4 mm"]
patch_radius = "4 mm"
[modes]
count = 5
[damping]
ratio = 0.01
)";

nlohmann::json run(const std::string& part, const fs::path& folder, const std::string& out) {
  return run_case(parse_case("[part]\n" + part + rest, folder), {folder / out, true, -1, false}).summary;
}

/// A wall of 60 x 100 x 4 mm as a box, and as the triangles of an STL in inches whose facets are turned and doubled:
/// the meshers, the orders and the checks differ, the frequencies do not.
TEST(PartFile, AnStlOfABoxHasTheModesOfTheBox) {
  const fs::path folder = fs::path(::testing::TempDir()) / "part_file";
  fs::remove_all(folder);
  fs::create_directories(folder);
  mesh::TriangleSoup soup = mesh::soup(mesh::triangulated(mesh::surface(mesh::Box{{0.06, 0.1, 0.004}})));
  std::swap(soup.triangles[3][0], soup.triangles[3][1]);
  soup.triangles.push_back(soup.triangles[5]);
  io::write_stl(folder / "wall.stl", soup, 0.0254);
  const auto box =
      run("length = \"60 mm\"\nheight = \"100 mm\"\nthickness = \"4 mm\"\n"
          "[part.axes]\nlength = \"x\"\nheight = \"y\"\nthickness = \"z\"\n",
          folder, "box");
  const auto surface = run("file = \"wall.stl\"\nunit = \"inch\"\n", folder, "surface");
  for (std::size_t k = 0; k < 5; ++k) {
    const double expected = box["part"]["modes"][k]["frequency_hz"].get<double>();
    EXPECT_NEAR(surface["part"]["modes"][k]["frequency_hz"].get<double>() / expected, 1.0, 0.005 + 0.005) << k;
  }
  EXPECT_NEAR(surface["part"]["mass_kg"].get<double>(), 2810 * 0.06 * 0.1 * 0.004, 1e-6);
  EXPECT_EQ(surface["geometry"]["mended"].size(), 2U) << surface["geometry"]["mended"].dump();
  EXPECT_TRUE(fs::exists(folder / "surface" / "modes" / "wall_thickness.vtp"));
}

const std::string held_plate = R"([part]
length = "60 mm"
height = "100 mm"
thickness = "4 mm"
[part.axes]
length = "x"
height = "y"
thickness = "z"
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "15 mm"
order = 3
[[part.supports]]
on = "y_min"
)";

const std::string rest_of_matrices = R"([points.P]
PLACE
[damping]
model = "DAMPING"
RATIO
[reduction]
modes = 20
[response]
to = "3000 Hz"
lines = 300
[robot]
frequency = "40 Hz"
stiffness = "1e5 N/m"
damping_ratio = 0.02
direction = "z"
[[contacts]]
part = "P"
directions = "z"
stiffness = "1e6 N/m"
[tool]
teeth = 4
diameter = "16 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "0.5 mm"
tool_axis = "y"
feed_direction = "x"
Kt = "800 N/mm^2"
spindle_speed = "5000 rpm"
[lobes]
from = "3000 rpm"
to = "9000 rpm"
count = 20
depth_limit = "20 mm"
)";

std::string with_place(const std::string& place, const std::string& damping, const std::string& ratio) {
  std::string text = rest_of_matrices;
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"PLACE", place}, {"DAMPING", damping}, {"RATIO", ratio}})
    text.replace(text.find(from), from.size(), to);
  return text;
}

/// A plate is reduced and written; the files, as a part of matrices without a shape, go through modes, a second
/// reduction with all of their modes, coupling by both routes and lobes to the same results as the plate's own model.
TEST(PartFile, MatricesOfAPartGoThroughThePipelineAsThePartDoes) {
  const fs::path folder = fs::path(::testing::TempDir()) / "part_matrices";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string plate =
      held_plate +
      with_place("position = [\"30 mm\", \"100 mm\", \"4 mm\"]\npatch_radius = \"4 mm\"", "modal", "ratio = 0.01");
  ReduceRequest request;
  request.out = folder / "model";
  request.modes = 20;
  (void)reduce_part(parse_case(plate, folder), request);
  const auto own = run_case(parse_case(plate, folder), {folder / "own", true, -1, false}).summary;
  const std::string matrices =
      "[part]\nunit = \"m\"\nmass_unit = \"kg\"\n[part.matrices]\nstiffness = \"model/stiffness.mtx\"\n"
      "mass = \"model/mass.mtx\"\ndamping = \"model/damping.mtx\"\ndofs = \"model/dofs.csv\"\n" +
      with_place("", "matrices", "");
  const auto from_files = run_case(parse_case(matrices, folder), {folder / "files", true, -1, false}).summary;
  EXPECT_EQ(from_files["reduction"]["full_dofs"], 23);
  EXPECT_LT(from_files["coupling"]["route_difference"]["max_relative"].get<double>(), 1e-9);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& a = own["coupling"]["modes"][k];
    const auto& b = from_files["coupling"]["modes"][k];
    EXPECT_NEAR(b["frequency_hz"].get<double>() / a["frequency_hz"].get<double>(), 1.0, 1e-8) << k;
    EXPECT_NEAR(b["damping_ratio"].get<double>(), a["damping_ratio"].get<double>(), 1e-8) << k;
  }
  for (const std::size_t chart : {0, 1}) {
    EXPECT_NEAR(from_files["lobes"][chart]["minimum_depth_m"].get<double>() /
                    own["lobes"][chart]["minimum_depth_m"].get<double>(),
                1.0, 1e-5);
  }
}

}  // namespace
}  // namespace thinwall::app
