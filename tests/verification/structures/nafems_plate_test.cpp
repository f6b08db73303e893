// NAFEMS's free-vibration benchmarks of square plates, as solids: FV12 (free), FV16 (cantilever), FV52 (thick, simply
// supported). E = 200 GPa, ν = 0.3, ρ = 8000 kg/m³. Published: NAFEMS, Selected Benchmarks for Natural Frequency
// Analysis: thin-plate Ritz values for FV12 and FV16, up to 1.2 % above the solid's, and Mindlin's plate for FV52.

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "tests/mesh/kuhn_box.hpp"
#include "tests/verification/structures/prism_part.hpp"

namespace thinwall::nafems_plate_test {
namespace {

const fem::Material metal{200e9, 0.3, 8000.0};
const mesh::Prism thick = plate_prism(10.0, 10.0, 1.0);

void print(const char* name, const Solved& s) {
  std::printf("%s: %zu tets of order %d, %td DOFs, Hz:", name, s.model.mesh.tets.size(), s.model.nodes.order,
              s.model.K.rows());
  for (const double f : elastic(s.modes)) std::printf(" %.4f", f);
  std::printf("\n");
}

/// Frequencies of the square plate of thickness h, over h / 50 mm. Layers along the edges: 1 m wide and five times
/// narrower each towards them, for the corners of plate theory and the boundary layer as wide as the plate is thick.
Eigen::VectorXd scaled_frequencies(const char* name, double h, const std::vector<fem::Support>& supports, int count) {
  mesh::PrismMeshOptions options;
  options.size_m = 2.5;
  options.layers = 3;
  options.layer_width_m = 1.0;
  const Solved s = solved(mesh::mesh_prism(plate_prism(10.0, 10.0, h), options), 4, metal, supports, count);
  print(name, s);
  EXPECT_EQ(s.model.rigid_motions, supports.empty() ? 6 : 0);
  return elastic(s.modes) * (0.05 / h);
}

/// A solid differs from Kirchhoff's plate by its edges, where the twist dies out and a clamp holds the cross-section
/// within a layer as wide as the plate is thick, by a h; and by shear and rotatory inertia, b h². Three thicknesses
/// give the limit. Returns the frequencies at 50 mm.
Eigen::VectorXd with_plate_theory_as_limit(const char* name, const std::vector<fem::Support>& supports,
                                           const Eigen::VectorXd& kirchhoff) {
  const auto f = [&](double h) { return scaled_frequencies(name, h, supports, static_cast<int>(kirchhoff.size())); };
  const Eigen::VectorXd at_200 = f(0.2);
  const Eigen::VectorXd at_100 = f(0.1);
  Eigen::VectorXd at_50 = f(0.05);
  const Eigen::VectorXd limit = (8.0 * at_50 - 6.0 * at_100 + at_200) / 3.0;
  std::printf("   off plate theory by %.1e at 200 mm, %.1e at 100 mm, %.1e at 50 mm, %.1e in the limit\n",
              worst_error(at_200, kirchhoff), worst_error(at_100, kirchhoff), worst_error(at_50, kirchhoff),
              worst_error(limit, kirchhoff));
  EXPECT_LT(worst_error(limit, kirchhoff), 3e-4);
  return at_50;
}

void expect_near_published(const Eigen::VectorXd& f, const Eigen::VectorXd& published) {
  for (Eigen::Index k = 0; k < published.size(); ++k) {
    EXPECT_LT(f(k), published(k)) << "Ritz solutions of thin-plate theory lie above";
    EXPECT_GT(f(k), 0.985 * published(k));
  }
}

TEST(NafemsFV12, FreeThinSquarePlate) {
  // ω a² √(ρh/D) = 13.468, 19.596, 24.270, 34.801 (double), 61.093 (double), 63.687.
  const Eigen::VectorXd f = with_plate_theory_as_limit(
      "FV12", {}, as_vector({1.6216, 2.3595, 2.9222, 4.1902, 4.1902, 7.3559, 7.3559, 7.6682}));
  expect_near_published(f, as_vector({1.622, 2.360, 2.9225, 4.233, 4.233, 7.416}));
}

TEST(NafemsFV16, ThinSquareCantileverPlate) {
  // ω a² √(ρh/D) = 3.471, 8.507, 21.285, 27.199, 30.955, 54.186.
  const Eigen::VectorXd f = with_plate_theory_as_limit("FV16", {held_plane(0, 0.0)},
                                                       as_vector({0.41793, 1.0242, 2.5627, 3.2748, 3.7270, 6.5239}));
  expect_near_published(f, as_vector({0.421, 1.029, 2.582, 3.306, 3.753, 6.555}));
}

/// cos √x and sin(√x h)/√x as functions of x of either sign.
double cosine(double x, double h) {
  return x >= 0.0 ? std::cos(std::sqrt(x) * h) : std::cosh(std::sqrt(-x) * h);
}
double sine_over(double x, double h) {
  return x >= 0.0 ? std::sin(std::sqrt(x) * h) / std::sqrt(x) : std::sinh(std::sqrt(-x) * h) / std::sqrt(-x);
}

/// Bending waves of wave number k in a layer of thickness 2H (Lamb 1917), p² = ω²/c_p² − k², q² = ω²/c_s² − k²:
///     4k² q sin(qH) cos(pH) + (q² − k²)² sin(pH)/p cos(qH) = 0
/// which the plate with w = 0 and tangential u = 0 on its side faces follows with k² = (mπ/a)² + (nπ/b)² (Srinivas,
/// Joga Rao & Rao 1970). The lowest root, Hz, between a half and all of Kirchhoff's frequency.
double bending_frequency(const fem::Material& material, double k, double thickness) {
  const fem::Lame c = fem::lame(material);
  const double pressure2 = (c.lambda + 2 * c.mu) / material.density_kg_m3;
  const double shear2 = c.mu / material.density_kg_m3;
  const double H = 0.5 * thickness;
  const auto residual = [&](double omega) {
    const double p2 = omega * omega / pressure2 - k * k;
    const double q2 = omega * omega / shear2 - k * k;
    return 4 * k * k * q2 * sine_over(q2, H) * cosine(p2, H) +
           (q2 - k * k) * (q2 - k * k) * sine_over(p2, H) * cosine(q2, H);
  };
  const double bending = material.youngs_modulus_Pa * std::pow(thickness, 3) /
                         (12.0 * (1.0 - material.poisson_ratio * material.poisson_ratio));
  double high = k * k * std::sqrt(bending / (material.density_kg_m3 * thickness));
  double low = 0.5 * high;
  EXPECT_LT(residual(low) * residual(high), 0.0) << "one root in between";
  const bool rises = residual(high) > 0.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (residual(middle) > 0.0) == rises ? high = middle : low = middle;
  }
  return high / (2.0 * std::numbers::pi);
}

double wave_number(int m, int n, double a, double b) {
  return std::numbers::pi * std::hypot(m / a, n / b);
}

TEST(LambWaves, GiveThePublishedSimplySupportedPlate) {
  const fem::Material steel{210e9, 0.3, 7850.0};
  EXPECT_NEAR(bending_frequency(steel, wave_number(1, 1, 0.45, 0.1), 0.006), 1537.879, 1e-3);
  EXPECT_NEAR(bending_frequency(steel, wave_number(4, 1, 0.45, 0.1), 0.006), 2611.513, 1e-3);
}

std::vector<fem::Support> sides(const std::vector<int>& on_x, const std::vector<int>& on_y) {
  return {held_plane(0, 0.0, on_x), held_plane(0, 10.0, on_x), held_plane(1, 0.0, on_y), held_plane(1, 10.0, on_y)};
}

/// Mindlin's plate (1951), thickness 1 m of the metal, shear factor π²/12: the lower root ω², Hz, of
///     (ρh³/12 ω² − D k² − κGh) (ρh ω² − κGh k²) = (κGh k)²
double mindlin_frequency(double k) {
  const double shear = std::numbers::pi * std::numbers::pi / 12.0 * fem::lame(metal).mu;
  const double bending = metal.youngs_modulus_Pa / (12.0 * (1.0 - metal.poisson_ratio * metal.poisson_ratio));
  const double a = metal.density_kg_m3 * metal.density_kg_m3 / 12.0;
  const double b = metal.density_kg_m3 * (shear * k * k / 12.0 + bending * k * k + shear);
  const double c = bending * shear * std::pow(k, 4);
  return std::sqrt(2.0 * c / (b + std::sqrt(b * b - 4.0 * a * c))) / (2.0 * std::numbers::pi);
}

// Hard simple support: w = 0 and tangential u = 0 on the four side faces. Exact: bending by Lamb, and shear in the
// plane, u along y that varies as cos(πx/a), at c_s/2a.
TEST(NafemsFV52, WithTheTangentsHeldIsTheClosedForm) {
  const auto bending = [](int m, int n) { return bending_frequency(metal, wave_number(m, n, 10, 10), 1.0); };
  const double shear = std::sqrt(fem::lame(metal).mu / metal.density_kg_m3) / 20.0;
  const Eigen::VectorXd exact = as_vector({bending(1, 1), bending(1, 2), bending(2, 1), shear, shear, bending(2, 2)});
  const Solved s = solved(graded_mesh(thick, 2.5, 0), 6, metal, sides({1, 2}, {0, 2}), 6);
  print("FV52, hard support", s);
  std::printf("FV52, closed form: %.4f %.4f %.4f %.4f Hz\n", exact(0), exact(1), exact(3), exact(5));
  EXPECT_LT(worst_error(elastic(s.modes), exact), 1e-6);
  // NAFEMS's figures are those of Mindlin's plate with the same support; the plate is up to 0.6 % softer.
  const Eigen::Vector3d published(45.897, 109.44, 167.89);
  const Eigen::Vector3d solid(exact(0), exact(1), exact(5));
  const Eigen::Vector3d plate(mindlin_frequency(wave_number(1, 1, 10, 10)),
                              mindlin_frequency(wave_number(1, 2, 10, 10)),
                              mindlin_frequency(wave_number(2, 2, 10, 10)));
  std::printf("FV52, Mindlin's plate: %.4f %.4f %.4f Hz; published 45.897 109.44 167.89\n", plate(0), plate(1),
              plate(2));
  EXPECT_LT(worst_error(plate, published), 1e-4);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_GT(solid(k), plate(k));
    EXPECT_LT(solid(k), 1.006 * plate(k));
  }
}

// Soft simple support: w = 0 on the side faces and nothing else, so that the plate slides and turns in its plane. A
// boundary layer of twist makes it 3.7 % lower than the figure of plate theory.
TEST(NafemsFV52, WithTheDeflectionOfTheSideFacesHeldConvergesToFortyFourPointTwo) {
  double last = 1e9;
  for (const int order : {3, 4, 5}) {
    const Solved s = solved(graded_mesh(thick, 2.5, 2), order, metal, sides({2}, {2}), 4);
    print("FV52, w = 0 on the side faces", s);
    EXPECT_EQ(s.model.rigid_motions, 3);
    EXPECT_LT(elastic(s.modes)(0), last) << "from above";
    last = elastic(s.modes)(0);
  }
  EXPECT_NEAR(last, 44.178, 2e-4 * 44.178);
}

/// Rows of cells that end at 0, each next one towards it `factor` as high: 0, factor^(n − 1) …, factor, 1 times `size`.
std::vector<double> towards_nought(int rows, double factor, double size) {
  std::vector<double> places{0.0};
  for (int i = rows - 1; i >= 0; --i) places.push_back(size * std::pow(factor, i));
  return places;
}

/// The thick plate's quarter, 0 ≤ x, y ≤ 5, with cells that shrink towards the edges x = 0, y = 0 and the face z = 0.
mesh::TetMesh quarter_graded_to_the_lower_edges(int rows) {
  const std::vector<double> plane = towards_nought(rows + 1, 0.2, 5.0);
  const std::vector<double> height = towards_nought(rows, 0.2, 1.0);
  mesh::TetMesh mesh = mesh::kuhn_box({rows + 1.0, rows + 1.0, rows + 0.0}, {rows + 1, rows + 1, rows});
  for (auto& x : mesh.vertices) {
    x = {plane[static_cast<std::size_t>(std::lround(x.x()))], plane[static_cast<std::size_t>(std::lround(x.y()))],
         height[static_cast<std::size_t>(std::lround(x.z()))]};
  }
  return mesh;
}

// The benchmark as it is often read, w = 0 along the four edges of the lower face, has no limit: a line has no capacity
// in three dimensions. The compliance of a load on a line of width ε is a + b log(1/ε), so that with elements that
// shrink by a factor towards the edges, 1/f² rises by the same amount with each row of them.
TEST(NafemsFV52, WithTheLowerEdgesHeldHasNoLimit) {
  std::vector<double> compliance;
  for (int rows = 1; rows <= 5; ++rows) {
    const mesh::TetMesh mesh = quarter_graded_to_the_lower_edges(rows);
    const mesh::LagrangeNodes nodes = mesh::lagrange_nodes(mesh, 3);
    std::vector<int> fixed;
    for (int i = 0; i < static_cast<int>(nodes.positions.rows()); ++i) {
      const Eigen::Vector3d x = nodes.positions.row(i);
      const auto at = [](double value, double place) { return std::abs(value - place) < 1e-9; };
      if (at(x.z(), 0) && (at(x.x(), 0) || at(x.y(), 0))) fixed.push_back(3 * i + 2);
      if (at(x.x(), 5)) fixed.push_back(3 * i);  // symmetry
      if (at(x.y(), 5)) fixed.push_back(3 * i + 1);
    }
    const Solved s = solved(fem::build_model(mesh, nodes, metal, fixed), 1);
    print("FV52, w = 0 on the lower edges", s);
    EXPECT_EQ(s.model.rigid_motions, 0);
    compliance.push_back(1.0 / std::pow(elastic(s.modes)(0), 2));
  }
  for (std::size_t i = 2; i + 1 < compliance.size(); ++i) {
    const double rise = (compliance[i + 1] - compliance[i]) / (compliance[i] - compliance[i - 1]);
    std::printf("   1/f² rises by %.2f of the rise before\n", rise);
    EXPECT_NEAR(rise, 1.0, 0.1) << "a convergent sequence would rise by ever less";
  }
}

}  // namespace
}  // namespace thinwall::nafems_plate_test
