// The order of convergence, where the solution is smooth: a block that slides without friction in six rigid walls.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <vector>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::roller_box_test {
namespace {

const fem::Material steel{210e9, 0.3, 7850.0};
const mesh::Box box{{1.0, 0.8, 0.6}};

/// Exact eigenvalues (2π f)², f = c |k| / 2 with k = (i/a, j/b, l/h): for each k one pressure mode and as many shear
/// modes as k has non-zero indices, less one.
std::vector<double> exact_eigenvalues(std::size_t count) {
  const fem::Lame c = fem::lame(steel);
  const double pressure = (c.lambda + 2 * c.mu) / steel.density_kg_m3;
  const double shear = c.mu / steel.density_kg_m3;
  std::vector<double> lambda;
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      for (int l = 0; l <= 4; ++l) {
        const int waves = (i > 0 ? 1 : 0) + (j > 0 ? 1 : 0) + (l > 0 ? 1 : 0);
        if (waves == 0) continue;
        const double k2 =
            std::pow(std::numbers::pi, 2) * Eigen::Vector3d(i, j, l).cwiseQuotient(box.size).squaredNorm();
        lambda.push_back(pressure * k2);
        lambda.insert(lambda.end(), static_cast<std::size_t>(waves - 1), shear * k2);
      }
    }
  }
  std::sort(lambda.begin(), lambda.end());
  lambda.resize(count);
  return lambda;
}

/// Relative error of the sum of the first four eigenvalues (three shear modes and a pressure mode). A sum, because on
/// coarse meshes the pressure mode and its neighbour, 4 % apart, change places; four, because the fifth lies 11 %
/// above.
double error(int order, int cells) {
  const auto exact = exact_eigenvalues(4);
  std::vector<fem::Support> walls;
  for (std::size_t face = 0; face < 6; ++face) {
    const auto& name = mesh::face_names()[face];
    walls.push_back({name, mesh::face_of(box, name), {static_cast<int>(face / 2)}});
  }
  const auto model = fem::supported_model(mesh::kuhn_box(box.size, {cells, cells, cells}), order, steel, walls);
  const auto factored = fem::factorise(model);
  const auto modes = fem::modes(model, factored, {.count = 4, .up_to_hz = {}});
  const double relative = modes.pairs.lambda.sum() / std::accumulate(exact.begin(), exact.end(), 0.0) - 1.0;
  EXPECT_GT(relative, 0.0) << "eigenvalues converge from above";
  return relative;
}

/// Slope of the least-squares line through log(error) over log(cell size), all meshes counting alike.
double slope(int order, const std::vector<int>& cells) {
  std::vector<double> x;
  std::vector<double> y;
  for (const int n : cells) {
    x.push_back(-std::log(n));
    y.push_back(std::log(error(order, n)));
  }
  const auto count = static_cast<double>(x.size());
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    sx += x[i];
    sy += y[i];
    sxx += x[i] * x[i];
    sxy += x[i] * y[i];
  }
  const double result = (count * sxy - sx * sy) / (count * sxx - sx * sx);
  std::printf("roller box order %d: slope %.2f over", order, result);
  for (std::size_t i = 0; i < x.size(); ++i)
    std::printf(" %d cells: %.2e%s", cells[i], std::exp(y[i]), i + 1 < x.size() ? "," : "\n");
  return result;
}

TEST(RollerBox, HasTheFrequenciesOfItsClosedForm) {
  const auto lambda = exact_eigenvalues(6);
  const double published[] = {2567.380, 3000.490, 3117.284, 3341.311, 3706.296, 3706.296};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(std::sqrt(lambda[k]) / (2 * std::numbers::pi), published[k], 1e-3);
}

// The theory says 2p for the eigenvalue. Sizes: fine enough to be asymptotic, coarse enough that the finest error stays
// far above the round-off of the eigenvalue, about 1e-12.
TEST(RollerBox, LinearElementsConvergeWithOrderTwo) {
  EXPECT_GE(slope(1, {8, 12, 16, 20}), 1.8);
}
TEST(RollerBox, QuadraticElementsConvergeWithOrderFour) {
  EXPECT_GE(slope(2, {6, 8, 10}), 3.6);
}
TEST(RollerBox, CubicElementsConvergeWithOrderSix) {
  EXPECT_GE(slope(3, {3, 4, 5, 6}), 5.5);
}
TEST(RollerBox, QuarticElementsConvergeWithOrderEight) {
  EXPECT_GE(slope(4, {2, 3, 4}), 7.3);
}
TEST(RollerBox, QuinticElementsConvergeWithOrderTen) {
  EXPECT_GE(slope(5, {2, 3}), 9.3);
}
TEST(RollerBox, SexticElementsConvergeWithOrderTwelve) {
  EXPECT_GE(slope(6, {2, 3}), 11.0);
}

}  // namespace
}  // namespace thinwall::roller_box_test
