// Walls bent to a cylinder: the in-plane modes of a sector in closed form, and a clamped bent plate.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "mesh/planar/bend.hpp"
#include "tests/mesh/kuhn_box.hpp"
#include "tests/verification/structures/prism_part.hpp"

namespace thinwall::curved_wall_test {
namespace {

fem::Shaping bending(const mesh::Bend& bend) {
  return [bend](mesh::LagrangeNodes& nodes) { mesh::bend(bend, nodes.positions); };
}

/// A Bessel function of either kind with its first two derivatives by r, of order n at κr.
struct Radial {
  double f = 0.0;
  double d = 0.0;
  double dd = 0.0;
};

Radial radial(bool second_kind, double n, double kappa, double r) {
  const double x = kappa * r;
  const auto bessel = [&](double order) {
    return second_kind ? std::cyl_neumann(order, x) : std::cyl_bessel_j(order, x);
  };
  Radial b{bessel(n), 0.0, 0.0};
  b.d = n / r * b.f - kappa * bessel(n + 1);
  b.dd = -b.d / r - (kappa * kappa - n * n / (r * r)) * b.f;
  return b;
}

/// A ring r_i ≤ r ≤ r_o in plane strain: u = ∇φ + ∇×ψ with φ = f(r) cos nθ, ψ = g(r) sin nθ, f and g Bessel functions
/// at ω/c_p and ω/c_s (Gazis 1958, for an infinite cylinder without axial waves). The columns of the matrix are the
/// four of them, its rows σ_rr and σ_rθ, over μ, on the two faces; free faces need a vanishing determinant.
struct Ring {
  double inner = 0.0;
  double outer = 0.0;
  fem::Material material;

  [[nodiscard]] double determinant(double n, double omega) const {
    const fem::Lame c = fem::lame(material);
    const double pressure = omega / std::sqrt((c.lambda + 2 * c.mu) / material.density_kg_m3);
    const double shear = omega / std::sqrt(c.mu / material.density_kg_m3);
    Eigen::Matrix4d A;
    for (int face = 0; face < 2; ++face) {
      const double r = face == 0 ? inner : outer;
      for (int kind = 0; kind < 2; ++kind) {
        const Radial f = radial(kind == 1, n, pressure, r);
        const Radial g = radial(kind == 1, n, shear, r);
        A(2 * face, kind) = -c.lambda / c.mu * pressure * pressure * f.f + 2.0 * f.dd;
        A(2 * face + 1, kind) = 2.0 * n * (f.f / (r * r) - f.d / r);
        A(2 * face, 2 + kind) = 2.0 * n * (g.d / r - g.f / (r * r));
        A(2 * face + 1, 2 + kind) = -n * n / (r * r) * g.f - g.dd + g.d / r;
      }
    }
    for (auto column : A.colwise()) column.normalize();
    return A.determinant();
  }

  /// Frequencies below `up_to_hz` and above a hundredth of it, by the changes of sign. Nearer to zero the Bessel
  /// functions of both waves are the same powers of r, and the sign of the determinant is round-off.
  [[nodiscard]] std::vector<double> frequencies(double n, double up_to_hz) const {
    std::vector<double> found;
    const double step = 2.0 * std::numbers::pi * up_to_hz / 2000.0;
    for (int i = 20; i < 2000; ++i) {
      double low = i * step;
      double high = low + step;
      const bool rises = determinant(n, high) > 0.0;
      if ((determinant(n, low) > 0.0) == rises) continue;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (determinant(n, middle) > 0.0) == rises ? high = middle : low = middle;
      }
      found.push_back(high / (2.0 * std::numbers::pi));
    }
    return found;
  }
};

// A quarter of the ring between rollers: u·n = 0 on the flat end faces and on the two faces across the axis. The end
// faces are the lines sin nθ = 0 of the modes with nΦ = mπ, so that its modes are the ring's with n = 0, 2, 4 …: exact
// for a curved solid, shear and rotatory inertia and all. The frequency of n = 2 rests on bending of the curved wall,
// that of n = 0 on stretching along the arc.
TEST(CylinderSector, BetweenRollersHasTheFrequenciesOfTheRingInClosedForm) {
  constexpr double radius = 0.1;
  constexpr double thickness = 0.012;
  constexpr double width = 0.008;
  const double arc = 0.5 * std::numbers::pi * radius;
  const Ring ring{radius - 0.5 * thickness, radius + 0.5 * thickness, steel_part};
  std::vector<double> exact;
  for (int m = 0; m <= 5; ++m) {
    const auto of_n = ring.frequencies(2.0 * m, 25e3);
    exact.insert(exact.end(), of_n.begin(), of_n.end());
  }
  std::sort(exact.begin(), exact.end());
  ASSERT_GE(exact.size(), 4U);
  exact.resize(4);
  // The arc starts along x; at its end it runs along −z.
  const std::vector<fem::Support> rollers{held_plane(0, 0.0, {0}), held_plane(0, arc, {2}), held_plane(1, 0.0, {1}),
                                          held_plane(1, width, {1})};
  const mesh::TetMesh mesh = mesh::kuhn_box({arc, width, thickness}, {6, 1, 1});
  double last = 1.0;
  for (int order = 3; order <= 6; ++order) {
    const Solved s = solved(mesh, order, steel_part, rollers, 4, bending({radius, 0, 2, 0.0, 0.5 * thickness}));
    EXPECT_EQ(s.model.rigid_motions, 0);
    const double error = worst_error(elastic(s.modes), as_vector(exact));
    std::printf("cylinder sector, order %d: %td DOFs, %.2f %.2f %.2f %.2f Hz, worst error %.1e\n", order,
                s.model.K.rows(), elastic(s.modes)(0), elastic(s.modes)(1), elastic(s.modes)(2), elastic(s.modes)(3),
                error);
    EXPECT_LT(error, last / 5.0) << "order " << order;
    last = error;
  }
  std::printf("cylinder sector, closed form: %.2f %.2f %.2f %.2f Hz\n", exact[0], exact[1], exact[2], exact[3]);
  EXPECT_LT(last, 1e-6);
}

const mesh::Prism plate = plate_prism(0.45, 0.1, 0.006);
const std::vector<fem::Support> both_ends{held_plane(0, 0.0), held_plane(0, 0.45)};

TEST(BentClampedPlate, OrdersFiveAndSixAgreeAndQuadraticElementsComeFromAbove) {
  const fem::Shaping bend = bending({0.3, 0, 2, 0.225, 0.003});
  const mesh::TetMesh graded = graded_mesh(plate, 0.05, 1);
  const Eigen::VectorXd five = elastic(solved(graded, 5, steel_part, both_ends, 7, bend).modes);
  const Solved six = solved(graded, 6, steel_part, both_ends, 7, bend);
  const double agreement = worst_error(five, elastic(six.modes));
  std::printf("bent clamped plate: %td DOFs, det J down to %.3f, orders 5 and 6 differ by %.1e; Hz:",
              six.model.K.rows(), six.model.least_jacobian, agreement);
  for (const double f : elastic(six.modes)) std::printf(" %.2f", f);
  std::printf("\n");
  EXPECT_LT(agreement, 1e-4);
  double last = 1.0;
  for (const int cells : {18, 36}) {
    const mesh::TetMesh even = mesh::kuhn_box({0.45, 0.1, 0.006}, {cells, cells / 4, 1});
    const Solved s = solved(even, 2, steel_part, both_ends, 7, bend);
    const Eigen::VectorXd off = elastic(s.modes).cwiseQuotient(elastic(six.modes)).array() - 1.0;
    std::printf("bent clamped plate, tet10 with %d cells along: %td DOFs, %.2f to %.2f %% above\n", cells,
                s.model.K.rows(), 100 * off.minCoeff(), 100 * off.maxCoeff());
    EXPECT_GT(off.minCoeff(), 0.0);
    EXPECT_LT(off.maxCoeff(), last / 3.0);
    last = off.maxCoeff();
  }
}

// Frequencies are even in the curvature, as a plate bent up is a plate bent down: f(R) = f(∞) + c/R² for R t ≫ L².
TEST(BentClampedPlate, BecomesTheFlatOneWithTheSquareOfTheCurvature) {
  const mesh::TetMesh mesh = graded_mesh(plate, 0.075, 1);
  const auto frequencies = [&](double radius) {
    const fem::Shaping bend = radius == 0.0 ? fem::Shaping{} : bending({radius, 0, 2, 0.225, 0.003});
    return Eigen::VectorXd(elastic(solved(mesh, 4, steel_part, both_ends, 3, bend).modes));
  };
  const Eigen::VectorXd flat = frequencies(0.0);
  const Eigen::VectorXd wide = frequencies(200.0);
  const Eigen::VectorXd wider = frequencies(400.0);
  const double ratio = (wide(0) - flat(0)) / (wider(0) - flat(0));
  std::printf("bent clamped plate, first mode: %.5f Hz flat, %.5f at R = 400 m, %.5f at 200 m: ratio %.3f\n", flat(0),
              wider(0), wide(0), ratio);
  EXPECT_NEAR(ratio, 4.0, 0.1);
  // The diagonals of the mesh are not even in z, so that a hundredth of the effect may be odd.
  EXPECT_LT(worst_error(frequencies(-200.0), wide), 0.01 * std::abs(wide(0) / flat(0) - 1.0));
  EXPECT_LT(worst_error(frequencies(1e6), flat), 1e-8);
}

}  // namespace
}  // namespace thinwall::curved_wall_test
