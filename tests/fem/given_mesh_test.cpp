// Meshes that are given: the error by one order more, against much finer ones.

#include <gtest/gtest.h>

#include <cmath>

#include "fem/to_tolerance.hpp"
#include "mesh/solid/solid_mesh.hpp"
#include "tests/mesh/labelled_grids.hpp"

namespace thinwall::fem {
namespace {

const Material steel{210e9, 0.3, 7850.0};

/// A block of hexahedra of 20 nodes, split into tetrahedra of order 2.
mesh::SolidMesh block(const std::array<int, 3>& cells, const Eigen::Vector3d& size) {
  const mesh::PointMap map = [size](const Eigen::Vector3d& x) -> Eigen::Vector3d { return x.cwiseProduct(size); };
  return mesh::solid_mesh(mesh::LabelledGrid(cells, mesh::CellShape::hexahedron, 20, map).mesh);
}

/// The block held at x = 0, by the nodes of the file's set, with elements of that order.
Model held(const mesh::SolidMesh& solid, int order) {
  const mesh::LagrangeNodes nodes = mesh::nodes_of_order(solid.mesh, solid.nodes, order);
  const auto& set = mesh::node_set(solid, "LEFT", "grid").nodes;
  return build_model(solid.mesh, nodes, steel, rows_of(mesh::set_of_order(solid.nodes, set, nodes), {0, 1, 2}));
}

struct Judged {
  double error = 0.0;     ///< largest of the frequencies, against the finer mesh
  double estimate = 0.0;  ///< by one order more
};

Judged judged(const std::array<int, 3>& cells, const std::array<int, 3>& finer, const Eigen::Vector3d& size) {
  ToleranceOptions options;
  options.modes.count = 6;
  options.reentrant_edges = true;
  const mesh::SolidMesh solid = block(cells, size);
  const Model model = held(solid, 2);
  const Factored factored = factorise(model);
  const Modes found = modes(model, factored, options.modes);
  const Model fine = held(block(finer, size), 5);
  const Modes exact = modes(fine, factorise(fine), options.modes);
  return {(found.frequency_hz.array() / exact.frequency_hz.array() - 1.0).abs().maxCoeff(),
          estimate_by_next_order(model, factored, found, held(solid, 3), options).frequency};
}

void expect_honest(const Judged& judged, const char* what) {
  std::printf("%s: off by %.2e, estimate %.2e\n", what, judged.error, judged.estimate);
  EXPECT_GE(judged.estimate, judged.error) << what;
  EXPECT_LE(judged.estimate, 4.0 * judged.error) << what << ": not bought by shouting";
}

// One hexahedron through the thickness, which is what a user meshes a plate with: from 1 to tens of percent.
TEST(GivenMesh, TheEstimateOfHexahedraOfOrder2IsNotTooSmall) {
  const Judged plate = judged({8, 4, 1}, {10, 5, 1}, {0.2, 0.1, 0.004});
  EXPECT_GT(plate.error, 0.01);
  expect_honest(plate, "plate 8 x 4 x 1");
  expect_honest(judged({4, 2, 1}, {10, 5, 1}, {0.2, 0.1, 0.004}), "plate 4 x 2 x 1");
  expect_honest(judged({3, 2, 2}, {5, 3, 3}, {0.12, 0.06, 0.05}), "block 3 x 2 x 2");
}

// A rod held on a face that may slide has its closed form: f = c / (4 L) √(E/ρ) with ν = 0.
TEST(GivenMesh, ARodAgainstItsClosedForm) {
  const Material rod{210e9, 0.0, 7850.0};
  const mesh::SolidMesh solid = block({1, 1, 1}, {0.5, 0.02, 0.02});
  const auto with_order = [&](int order) {
    const mesh::LagrangeNodes nodes = mesh::nodes_of_order(solid.mesh, solid.nodes, order);
    std::vector<int> rows;  // motion along x only
    for (int node = 0; node < static_cast<int>(nodes.positions.rows()); ++node) {
      rows.push_back(3 * node + 1);
      rows.push_back(3 * node + 2);
      if (nodes.positions(node, 0) < 1e-9) rows.push_back(3 * node);
    }
    return build_model(solid.mesh, nodes, rod, rows);
  };
  ToleranceOptions options;
  options.modes.count = 1;
  const Model model = with_order(2);
  const Factored factored = factorise(model);
  const Modes found = modes(model, factored, options.modes);
  const double exact = std::sqrt(210e9 / 7850.0) / (4.0 * 0.5);
  const double error = found.frequency_hz(0) / exact - 1.0;
  const Estimate estimate = estimate_by_next_order(model, factored, found, with_order(3), options);
  EXPECT_GT(error, 1e-3);
  EXPECT_GE(estimate.frequency, error);
  EXPECT_LE(estimate.frequency, 2.1 * error);
  ASSERT_EQ(estimate.steps.size(), 2U);
  EXPECT_EQ(estimate.steps.back().order, 3);
  EXPECT_NEAR(*estimate.steps.back().frequency_change, estimate.frequency / 2.0, 1e-12);
}

}  // namespace
}  // namespace thinwall::fem
