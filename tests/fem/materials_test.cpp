// A part of several materials.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "fem/assembly.hpp"
#include "fem/model.hpp"
#include "mesh/planar/bend.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::materials_test {
namespace {

const Eigen::Vector3d size(0.4, 0.1, 0.06);
const mesh::TetMesh bar = mesh::kuhn_box(size, {4, 2, 2});

/// Index 0 for x < 0.2, else 1.
std::vector<int> halves() {
  std::vector<int> of_tet;
  for (const auto& tet : bar.tets) {
    double x = 0.0;
    for (const int v : tet) x += 0.25 * bar.vertices[static_cast<std::size_t>(v)].x();
    of_tet.push_back(x < 0.2 ? 0 : 1);
  }
  return of_tet;
}

const Material light{70e9, 0.0, 2700.0};
const Material heavy{210e9, 0.0, 7850.0};

// Springs in series: F L (1/E₁ + 1/E₂) / 2A, without contraction exact for every order.
TEST(Materials, StretchABarAsTheirSpringsInSeries) {
  for (const int order : {1, 2, 3}) {
    const auto nodes = mesh::lagrange_nodes(bar, order);
    std::vector<int> foot;
    for (int i = 0; i < static_cast<int>(nodes.positions.rows()); ++i) {
      if (nodes.positions(i, 0) < 1e-12) foot.push_back(i);
    }
    const Model model = build_model(bar, nodes, Materials{{light, heavy}, halves()}, rows_of(foot, {0, 1, 2}));
    Eigen::VectorXd stretch(model.K.rows());  // the field that the closed form says
    for (Eigen::Index i = 0; i < stretch.size(); ++i) {
      const int row = model.free_rows[static_cast<std::size_t>(i)];
      const double x = nodes.positions(row / 3, 0);
      stretch(i) = row % 3 == 0 ? std::min(x, 0.2) / 70e9 + std::max(x - 0.2, 0.0) / 210e9 : 0.0;
    }
    const Eigen::VectorXd force = model.K * stretch;  // a traction of 1 Pa on the end, nothing inside
    double total = 0.0;
    for (Eigen::Index i = 0; i < force.size(); ++i) {
      const int row = model.free_rows[static_cast<std::size_t>(i)];
      if (nodes.positions(row / 3, 0) > 0.4 - 1e-12 && row % 3 == 0) {
        total += force(i);
      } else {
        EXPECT_NEAR(force(i), 0.0, 1e-12);
      }
    }
    EXPECT_NEAR(total, 0.1 * 0.06, 1e-12);
  }
}

TEST(Materials, GiveMassCentreAndInertiaOfTheirPieces) {
  const Model model = build_model(bar, mesh::lagrange_nodes(bar, 2), Materials{{light, heavy}, halves()}, {});
  const double m1 = 2700.0 * 0.2 * 0.1 * 0.06;
  const double m2 = 7850.0 * 0.2 * 0.1 * 0.06;
  const double centre = (0.1 * m1 + 0.3 * m2) / (m1 + m2);
  EXPECT_NEAR(model.mass.mass_kg, m1 + m2, 1e-12 * (m1 + m2));
  EXPECT_NEAR(model.mass.centre_m.x(), centre, 1e-13);
  const double about_z =
      (m1 + m2) * (0.2 * 0.2 + 0.1 * 0.1) / 12.0 + m1 * std::pow(centre - 0.1, 2) + m2 * std::pow(0.3 - centre, 2);
  EXPECT_NEAR(model.mass.inertia_kg_m2(2, 2), about_z, 1e-12 * about_z);
}

// K and M are linear in the materials: (2, 1) and (1, 2) add up to (3, 3), curved elements included.
TEST(Materials, AddUpElementByElement) {
  const Material one{200e9, 0.3, 7800.0};
  const Material two{400e9, 0.3, 15600.0};
  const Material three{600e9, 0.3, 23400.0};
  for (const bool curved : {false, true}) {
    auto nodes = mesh::lagrange_nodes(bar, 3);
    if (curved) mesh::bend({0.3, 0, 2, 0.0, 0.03}, nodes.positions);
    const auto a = assemble(nodes, Materials{{two, one}, halves()});
    const auto b = assemble(nodes, Materials{{one, two}, halves()});
    const auto c = assemble(nodes, three);
    EXPECT_EQ(a.curved_elements > 0, curved);
    EXPECT_LT(linalg::combine(1.0, linalg::combine(1.0, a.K, 1.0, b.K), -1.0, c.K).norm(), 1e-13 * c.K.norm());
    EXPECT_LT(linalg::combine(1.0, linalg::combine(1.0, a.M, 1.0, b.M), -1.0, c.M).norm(), 1e-13 * c.M.norm());
    EXPECT_GT(linalg::combine(1.0, a.K, -1.0, b.K).norm(), 0.1 * c.K.norm());
    const auto same = assemble(nodes, Materials{{one, three}, std::vector<int>(bar.tets.size(), 1)});
    EXPECT_EQ(linalg::combine(1.0, same.K, -1.0, c.K).norm(), 0.0);
  }
}

TEST(Materials, ThatDoNotFitTheMeshAreAnError) {
  const auto message = [](const Materials& materials) -> std::string {
    try {
      (void)build_model(bar, mesh::lagrange_nodes(bar, 1), materials, {});
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message({{}, {}}).find("needs a material"), std::string::npos);
  EXPECT_NE(message({{light}, {0, 0}}).find("for 2 tetrahedra, and the mesh has 96"), std::string::npos);
  std::vector<int> wrong(bar.tets.size(), 0);
  wrong[7] = 2;
  EXPECT_NE(message({{light, heavy}, wrong}).find("tetrahedron 7 is of material 2"), std::string::npos);
  wrong[7] = -1;
  EXPECT_NE(message({{light, heavy}, wrong}).find("tetrahedron 7 is of material -1"), std::string::npos);
  EXPECT_NE(message({{light, {1e9, 0.5, 1.0}}, {}}).find("material 1: Poisson's ratio"), std::string::npos);
}

}  // namespace
}  // namespace thinwall::fem::materials_test
