// Findings of `check` that need the part's first mesh or its points, and which a run would tell after minutes only.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "app/command_line.hpp"
#include "core/atomic_file.hpp"
#include "io/surface/stl.hpp"
#include "mesh/box.hpp"
#include "mesh/faceted_surface.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::check_test {
namespace {

/// The output and the errors of `check` of a case with a wall of 60 x 100 x 4 mm, or another part, from an STL file.
struct Checked {
  int code = 0;
  std::string out, err;

  explicit Checked(const std::string& rest,
                   const mesh::FacetedSurface& surface = mesh::surface(mesh::Box{{0.06, 0.1, 0.004}})) {
    const tests::TemporaryFolder temporary;
    io::write_stl(temporary.path / "wall.stl", mesh::soup(mesh::triangulated(surface)), 0.001);
    core::write_file_atomically(temporary.path / "case.toml", R"([part]
file = "wall.stl"
unit = "mm"
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[modes]
count = 5
[damping]
ratio = 0.01
)" + rest);
    const std::string folder = temporary.path.string();
    const std::array<const char*, 3> words{"thinwall", "check", folder.c_str()};
    std::ostringstream printed, errors;
    code = app::run_command_line(3, words.data(), {}, printed, errors);
    out = printed.str();
    err = errors.str();
  }
};

TEST(Check, CountsTheElementsOfTheFirstMesh) {
  const Checked held("[[part.supports]]\non = \"y_min\"\n");
  EXPECT_EQ(held.code, 0) << held.err;
  EXPECT_NE(held.out.find("of order 4, size and order from the tolerance of 0.01"), std::string::npos) << held.out;
}

TEST(Check, FindsASelectionThatHoldsNoFace) {
  const std::string small =
      "[selections.foot]\n[selections.foot.box]\nmin = [\"20 mm\", \"40 mm\", \"1 mm\"]\n"
      "max = [\"21 mm\", \"41 mm\", \"2 mm\"]\n[[part.supports]]\non = \"foot\"\n";
  const Checked inside(small);
  EXPECT_EQ(inside.code, 3) << inside.out;
  EXPECT_NE(inside.err.find("selection \"foot\" holds no face of the part"), std::string::npos) << inside.err;
}

/// A tube along z, 60 mm wide and 100 mm long.
mesh::FacetedSurface tube(double thickness_m) {
  constexpr int sides = 48;
  mesh::FacetedSurface result;
  for (const double z : {0.0, 0.1})
    for (const double radius : {0.03, 0.03 - thickness_m})
      for (int k = 0; k < sides; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / sides;
        result.vertices.emplace_back(radius * std::cos(angle), radius * std::sin(angle), z);
      }
  for (int k = 0; k < sides; ++k) {
    // Outside and inside below, outside and inside above.
    const std::array<int, 4> here{k, sides + k, 2 * sides + k, 3 * sides + k};
    std::array<int, 4> next = here;
    for (int& vertex : next) vertex += k + 1 == sides ? 1 - sides : 1;
    result.facets.push_back({here[0], next[0], next[2], here[2]});
    result.facets.push_back({next[1], here[1], here[3], next[3]});
    result.facets.push_back({here[1], next[1], next[0], here[0]});
    result.facets.push_back({here[2], next[2], next[3], here[3]});
  }
  return result;
}

/// Plane walls take few elements however thin they are; bent ones are as long as they are thick.
TEST(Check, FindsACoarsestMeshOfMoreUnknownsThanAreSolved) {
  const Checked foil("[part.mesh]\norder = 4\n[[part.supports]]\non = \"z_min\"\n", tube(0.0004));
  EXPECT_EQ(foil.code, 3) << foil.out;
  EXPECT_NE(foil.err.find("more than the bound of 400000"), std::string::npos) << foil.err;
  EXPECT_NE(foil.err.find("part.mesh.order"), std::string::npos) << "a lower one fits: " << foil.err;
}

/// One point sees the three translations, three points off a line see all six motions.
TEST(Check, FindsPointsThatDoNotHoldAFreePart) {
  const auto point = [](const std::string& name, const std::string& place) {
    return "[points." + name + "]\nposition = [" + place + "]\n";
  };
  const std::string first = point("P", R"("60 mm", "100 mm", "4 mm")");
  const Checked one(first);
  EXPECT_EQ(one.code, 3) << one.out;
  EXPECT_NE(one.err.find("its points see 3 of its 6 rigid motions"), std::string::npos) << one.err;
  const std::string second = point("Q", R"("0 mm", "100 mm", "4 mm")");
  const Checked line(first + second);
  EXPECT_NE(line.err.find("its points see 5 of its 6 rigid motions"), std::string::npos) << line.err;
  const Checked three(first + second + point("R", R"("0 mm", "0 mm", "4 mm")"));
  EXPECT_EQ(three.code, 0) << three.err;
}

}  // namespace
}  // namespace thinwall::tests::check_test
