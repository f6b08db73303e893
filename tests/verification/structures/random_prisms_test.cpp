// Properties that hold for every part, on random ones: seeded, few and small.

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

#include "tests/mesh/plane_shapes.hpp"
#include "tests/verification/structures/prism_part.hpp"

namespace thinwall::random_prisms_test {
namespace {

struct Part {
  mesh::Prism prism;
  mesh::TetMesh mesh;
  std::vector<fem::Support> supports;
};

/// A rectangular, turned or polygonal plate, with or without a pocket or a hole, clamped on its lower face where x is
/// least or along its first edge; random grading.
Part random_part(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const double length = between(0.08, 0.3);
  const double width = length * between(0.4, 1.0);
  const double thickness = length * between(0.02, 0.08);
  Part part;
  part.prism = plate_prism(length, width, thickness);
  if (seed % 3 == 1) {
    part.prism.zones.push_back(
        {mesh::rectangle(0.3 * length, 0.25 * width, 0.7 * length, 0.7 * width), 0.0, thickness * between(0.4, 0.7)});
  }
  if (seed % 3 == 2) {
    // One corner cut off: no tensor grid any more.
    part.prism.outline = {
        {0, 0}, {length, 0}, {length, between(0.4, 0.7) * width}, {between(0.4, 0.7) * length, width}, {0, width}};
  }
  part.supports = {held_plane(0, 0.0)};
  mesh::PrismMeshOptions options;
  options.size_m = length * between(0.4, 0.6);
  options.layers = seed % 3 == 1 ? 0 : static_cast<int>(seed % 2);
  options.layer_factor = between(0.15, 0.4);
  part.mesh = mesh::mesh_prism(part.prism, options);
  return part;
}

constexpr unsigned seeds = 6;
constexpr int count = 5;

Eigen::VectorXd frequencies(const mesh::TetMesh& mesh, int order, const fem::Material& material,
                            const std::vector<fem::Support>& supports) {
  return elastic(solved(mesh, order, material, supports, count).modes);
}

// The space of an order on straight elements holds that of every lower one, so that by Ritz and Courant each frequency
// falls with the order and stays above the limit.
TEST(RandomPrisms, FrequenciesFallWithTheOrderTowardsAConvergedReferenceAndNeverBelow) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Part part = random_part(seed);
    const Eigen::VectorXd reference = frequencies(part.mesh, 6, steel_part, part.supports);
    Eigen::VectorXd last = Eigen::VectorXd::Constant(count, HUGE_VAL);
    for (int order = 1; order <= 4; ++order) {
      const Eigen::VectorXd f = frequencies(part.mesh, order, steel_part, part.supports);
      EXPECT_TRUE((f.array() <= last.array() * (1.0 + 1e-10)).all()) << "seed " << seed << ", order " << order;
      EXPECT_TRUE((f.array() >= reference.array() * (1.0 - 1e-10)).all())
          << "seed " << seed << ", order " << order << ": " << (f.cwiseQuotient(reference)).transpose();
      last = f;
    }
    std::printf("random part %u: %zu tets, first mode %.1f Hz, order 4 within %.1e of the reference\n", seed,
                part.mesh.tets.size(), reference(0), worst_error(last, reference));
    EXPECT_LT(worst_error(last, reference), 0.02) << "seed " << seed;
  }
}

// Powers of two change no digit of any number on the way, so that nothing but a bound in the units of somebody's part
// could tell a plate from one of a kilometre: no round-off to allow for.
TEST(RandomPrisms, FrequenciesScaleWithSizeStiffnessAndDensityToTheLastDigit) {
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const Part part = random_part(seed);
    const Eigen::VectorXd f = frequencies(part.mesh, 2, steel_part, part.supports);
    mesh::TetMesh enlarged = part.mesh;
    for (auto& x : enlarged.vertices) x *= 1024.0;
    const double by_size = worst_error(1024.0 * frequencies(enlarged, 2, steel_part, part.supports), f);
    const fem::Material other{steel_part.youngs_modulus_Pa / 4096.0, steel_part.poisson_ratio,
                              steel_part.density_kg_m3 * 16.0};
    const double by_material = worst_error(256.0 * frequencies(part.mesh, 2, other, part.supports), f);
    std::printf("random part %u: scaled by size %.1e off, by material %.1e\n", seed, by_size, by_material);
    EXPECT_LT(by_size, 1e-13) << "f ∝ 1/L";
    EXPECT_LT(by_material, 1e-13) << "f ∝ √(E/ρ)";
  }
}

}  // namespace
}  // namespace thinwall::random_prisms_test
