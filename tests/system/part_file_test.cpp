// Parts from files through the whole pipeline: the same part described in two ways gives the same results.

#include <gtest/gtest.h>

#include "app/case_reader.hpp"
#include "app/pipeline.hpp"
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

}  // namespace
}  // namespace thinwall::app
