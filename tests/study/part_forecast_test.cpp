// The time of a part before it is solved.

#include "study/part/part_forecast.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "fem/closed_part.hpp"
#include "fem/size/solution_bytes.hpp"
#include "mesh/tet_mesh.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_geometry.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::part_forecast_test {
namespace {

/// A block of one hexahedron, which is read as tetrahedra.
constexpr auto block =
    "*NODE\n1, 0, 0, 0\n2, 10, 0, 0\n3, 10, 10, 0\n4, 0, 10, 0\n5, 0, 0, 10\n6, 10, 0, 10\n7, 10, 10, 10\n"
    "8, 0, 10, 10\n*ELEMENT, TYPE=C3D8, ELSET=ALL\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";

setup::PartSize forecast_of_block(const std::string& mesh) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "block.inp", block);
  const cases::Case source = cases::parse_case(
      "[part]\nfile = \"block.inp\"\nunit = \"mm\"\n[part.material]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.3\n"
      "density = \"2700 kg/m^3\"\n[[part.supports]]\non = \"z_min\"\n[modes]\ncount = 1\n[damping]\nratio = 0.01\n" +
          mesh,
      folder.path);
  return study::forecast(study::part_input(source)).value();
}

/// Of order p the block has (p + 1)³ nodes, and no vertex inside.
TEST(PartForecast, AMeshOfAFileIsSolvedOnceMoreOneOrderHigher) {
  const double elements = forecast_of_block("").elements;
  const auto solved_s = [&](int order) {
    const double nodes = (order + 1.0) * (order + 2.0) * (order + 3.0) / 6.0;
    return 3e-7 * elements * nodes * nodes + 0.8 * std::pow(3.0 * std::pow(order + 1.0, 3) / 4e4, 1.3);
  };
  EXPECT_NEAR(forecast_of_block("").seconds, solved_s(2) + solved_s(3), 1e-12);
  EXPECT_NEAR(forecast_of_block("[part.mesh]\norder = 5\n").seconds, solved_s(5) + solved_s(6), 1e-12);
  EXPECT_NEAR(forecast_of_block("[part.mesh]\norder = 6\n").seconds, solved_s(6), 1e-12) << "there is none higher";
}

/// A part of n × n × k cubes of 1 mm.
cases::Case case_of_blocks(int n, int k) {
  const TemporaryFolder folder;
  std::string text = "*NODE\n";
  const auto node = [&](int x, int y, int z) { return std::to_string(1 + x + (n + 1) * (y + (n + 1) * z)); };
  for (int z = 0; z <= k; ++z)
    for (int y = 0; y <= n; ++y)
      for (int x = 0; x <= n; ++x)
        text += node(x, y, z) + ", " + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) + "\n";
  text += "*ELEMENT, TYPE=C3D8, ELSET=ALL\n";
  int element = 0;
  for (int z = 0; z < k; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) {
        text += std::to_string(++element);
        for (const int up : {0, 1})
          for (const auto& [dx, dy] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
            text += ", " + node(x + dx, y + dy, z + up);
        text += "\n";
      }
  core::write_file_atomically(folder.path / "blocks.inp", text);
  return cases::parse_case(
      "[part]\nfile = \"blocks.inp\"\nunit = \"mm\"\n[part.material]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = "
      "0.3\ndensity = \"2700 kg/m^3\"\n[[part.supports]]\non = \"z_min\"\n[modes]\ncount = 1\n[damping]\nratio = "
      "0.01\n",
      folder.path);
}

setup::PartSize forecast_of_blocks(int n, int k) {
  const cases::Case source = case_of_blocks(n, k);
  return study::forecast(study::part_input(source)).value();
}

// The factor of a body fills more than that of a wall of one layer.
TEST(PartForecast, ABodyTakesLongerThanAWallOfAsManyElementsAndMoreUnknowns) {
  const setup::PartSize body = forecast_of_blocks(12, 12), wall = forecast_of_blocks(41, 1);
  ASSERT_NEAR(body.elements / wall.elements, 1.0, 0.05);
  EXPECT_LT(body.dofs, wall.dofs);
  EXPECT_GT(body.seconds, wall.seconds);
}

/// A mesh of order 2 is solved at order 3, too, while the matrices and the factor of order 2 are there.
TEST(PartForecast, TheMemoryIsThatOfBothSolutions) {
  const cases::Case source = case_of_blocks(6, 6);
  const mesh::TetMesh& mesh = source.part->imported->mesh->solid.mesh;
  double held = 0.0;
  for (const int order : {2, 3}) {
    const fem::Model model = fem::supported_model(mesh, order, setup::material_of(*source.part), {});
    held += fem::bytes_of(model.K) + fem::bytes_of(model.M) + fem::factorise(model).factor.statistics().bytes;
  }
  const double told = study::forecast(study::part_input(source)).value().memory_bytes;
  EXPECT_GT(told, held);
  EXPECT_LT(told, 1.2 * held + 0.2e9) << "the program itself and its vectors";
}

/// A row of boxes along x, each of six tetrahedra about its diagonal, m.
mesh::TetMesh row_of_boxes(int count, const Eigen::Vector3d& size) {
  mesh::TetMesh mesh;
  for (int x = 0; x <= count; ++x)
    for (const int y : {0, 1})
      for (const int z : {0, 1}) mesh.vertices.emplace_back(size.cwiseProduct(Eigen::Vector3d(x, y, z)));
  for (int box = 0; box < count; ++box) {
    std::array<int, 3> axes{4, 2, 1};  // by which the number of a vertex grows along x, y, z
    std::ranges::sort(axes);
    do {
      std::array<int, 4> tet{4 * box};
      for (std::size_t i = 0; i < 3; ++i) tet[i + 1] = tet[i] + axes[i];
      mesh.tets.push_back(tet);
      if (mesh::volume(mesh, static_cast<int>(mesh.tets.size()) - 1) < 0.0)
        std::swap(mesh.tets.back()[2], mesh.tets.back()[3]);
    } while (std::ranges::next_permutation(axes).found);
  }
  return mesh;
}

/// Seconds of a part with the surface and the first mesh `mesh` that one of its faces holds.
double seconds_held_by(const std::string& face, const mesh::TetMesh& mesh, const std::string& points = "",
                       bool has_rows = false) {
  std::string stl = "solid part\n";
  for (const mesh::BoundaryTriangle& triangle : mesh::boundary(mesh)) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const int vertex : triangle.vertices) {
      const Eigen::Vector3d x = 1e3 * mesh.vertices[static_cast<std::size_t>(vertex)];
      stl += "vertex " + std::to_string(x.x()) + " " + std::to_string(x.y()) + " " + std::to_string(x.z()) + "\n";
    }
    stl += "endloop\nendfacet\n";
  }
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "part.stl", stl + "endsolid part\n");
  const cases::Case source = cases::parse_case(
      "[part]\nfile = \"part.stl\"\nunit = \"mm\"\n[part.material]\nyoungs_modulus = \"70 GPa\"\npoisson_ratio = 0.3\n"
      "density = \"2700 kg/m^3\"\n[part.mesh]\ntolerance = 0.02\n[[part.supports]]\non = \"" +
          face + "\"\n[modes]\ncount = 1\n[damping]\nratio = 0.01\n" + points,
      folder.path);
  return study::forecast(study::part_input(source),
                         std::make_shared<fem::FirstMesh>(fem::FirstMesh{mesh, {}, {}, has_rows}))
      .value()
      .seconds;
}

// A wall that is held along its edge swings in waves of a few times its height, which elements longer than the height
// resolve by higher orders only; held by its end, farther away than an element is long, it swings in longer ones, and a
// cube has no wall.
TEST(PartForecast, AThinWallThatIsLowerThanItsElementsAreLongTakesAllOrders) {
  const mesh::TetMesh wall = row_of_boxes(2, {0.020, 0.002, 0.012});
  EXPECT_GT(seconds_held_by("z_min", wall), 3.0 * seconds_held_by("x_min", wall));
  const mesh::TetMesh cube = row_of_boxes(1, {0.012, 0.012, 0.012});
  EXPECT_EQ(seconds_held_by("z_min", cube), seconds_held_by("x_min", cube));
}

// Frequencies of a block meet 2 % on its first mesh; the receptance of a point of it may take a finer one.
TEST(PartForecast, ReceptancesOfAHeldPartMayTakeAFinerMesh) {
  const mesh::TetMesh row = row_of_boxes(3, {0.01, 0.01, 0.01});
  const std::string point = "[points.P]\nposition = [\"30 mm\", \"5 mm\", \"5 mm\"]\npatch_radius = \"1 mm\"\n";
  EXPECT_GT(seconds_held_by("x_min", row, point), 2.0 * seconds_held_by("x_min", row));
}

// Rows at the edges leave two orders and a fifth of a third, where short waves take four and a finer mesh.
TEST(PartForecast, AFirstMeshWithRowsAtItsEdgesTakesFewerOrders) {
  const mesh::TetMesh wall = row_of_boxes(2, {0.020, 0.002, 0.012});
  EXPECT_LT(seconds_held_by("z_min", wall, "", true), 0.5 * seconds_held_by("z_min", wall));
}

TEST(PartForecast, AReductionToAToleranceTakesAsLongAgain) {
  const mesh::TetMesh row = row_of_boxes(3, {0.01, 0.01, 0.01});
  const std::string point = "[points.P]\nposition = [\"30 mm\", \"5 mm\", \"5 mm\"]\npatch_radius = \"1 mm\"\n";
  EXPECT_DOUBLE_EQ(seconds_held_by("x_min", row, point + "[reduction]\ntolerance = 0.01\n"),
                   2.0 * seconds_held_by("x_min", row, point + "[reduction]\nup_to = \"20 kHz\"\n"));
}

}  // namespace
}  // namespace thinwall::tests::part_forecast_test
