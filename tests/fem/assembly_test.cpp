#include "fem/assembly.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "core/error.hpp"
#include "fem/model.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::assembly_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};
const Eigen::Vector3d size(0.3, 0.2, 0.15);

/// A block whose inner vertices are moved by up to a fifth of a cell: every tetrahedron is another.
mesh::TetMesh distorted_block() {
  mesh::TetMesh mesh = mesh::kuhn_box(size, {3, 3, 3});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> share(-0.2, 0.2);
  for (auto& x : mesh.vertices) {
    const Eigen::Vector3d move(share(random), share(random), share(random));
    const bool inside = (x.array() > 1e-9).all() && (x.array() < size.array() - 1e-9).all();
    if (inside) x += move.cwiseProduct(size) / 3.0;
  }
  return mesh;
}

/// The nodal vector of a field of the position.
template <class Field>
Eigen::VectorXd nodal(const mesh::LagrangeNodes& nodes, Field field) {
  Eigen::VectorXd u(3 * nodes.positions.rows());
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i)
    u.segment<3>(3 * i) = field(Eigen::Vector3d(nodes.positions.row(i)));
  return u;
}

Eigen::Matrix3d some_gradient() {
  Eigen::Matrix3d A;
  A << 1.0, -0.4, 0.3, 0.7, -0.5, 0.2, 0.1, 0.6, 0.8;
  return A;
}

/// σ:ε of a displacement gradient.
double twice_energy_density(const Eigen::Matrix3d& gradient) {
  const Lame c = lame(steel);
  const Eigen::Matrix3d strain = 0.5 * (gradient + gradient.transpose());
  return c.lambda * strain.trace() * strain.trace() + 2.0 * c.mu * strain.squaredNorm();
}

TEST(PatchTest, ALinearFieldOnDistortedTetsNeedsNoInnerForcesAndHasTheExactEnergy) {
  const mesh::TetMesh mesh = distorted_block();
  const Eigen::Matrix3d A = some_gradient();
  for (int p = 1; p <= 6; ++p) {
    const auto nodes = mesh::lagrange_nodes(mesh, p);
    const Assembled part = assemble(nodes, steel);
    const Eigen::VectorXd u = nodal(nodes, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(A * x); });
    const Eigen::VectorXd force = part.K * u;
    double inner = 0.0;
    for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
      const Eigen::Vector3d x = nodes.positions.row(i);
      if ((x.array() > 1e-9).all() && (x.array() < size.array() - 1e-9).all()) {
        inner = std::max(inner, force.segment<3>(3 * i).cwiseAbs().maxCoeff());
      }
    }
    // Round-off is relative to the forces that cancel at a node: |K| |u|.
    const double scale = (part.K.cwiseAbs() * u.cwiseAbs()).maxCoeff();
    const double expected = twice_energy_density(A) * size.prod();
    std::printf("patch test order %d: inner force %.1e, energy error %.1e\n", p, inner / scale,
                u.dot(force) / expected - 1.0);
    EXPECT_LT(inner / scale, 1e-13) << "order " << p;
    EXPECT_NEAR(u.dot(force) / expected, 1.0, 1e-11) << "order " << p;
  }
}

// Complete polynomials of the order, not only linear ones: their energies are one-dimensional integrals over the unit
// cube.
TEST(Assembly, PolynomialsUpToTheOrderHaveTheirExactEnergyAndMass) {
  const mesh::TetMesh mesh = mesh::kuhn_box({1, 1, 1}, {1, 2, 1});
  const Lame c = lame(steel);
  for (int p = 1; p <= 6; ++p) {
    const auto nodes = mesh::lagrange_nodes(mesh, p);
    const Assembled part = assemble(nodes, steel);
    const double slope_squared = p * p / (2.0 * p - 1.0);  // ∫ (p s^{p−1})² ds
    const auto stretch =
        nodal(nodes, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(std::pow(x.x(), p), 0, 0); });
    EXPECT_NEAR(stretch.dot(part.K * stretch) / ((c.lambda + 2 * c.mu) * slope_squared), 1.0, 1e-11) << "order " << p;
    EXPECT_NEAR(stretch.dot(part.M * stretch) / (7850.0 / (2 * p + 1)), 1.0, 1e-12) << "order " << p;
    const auto shear =
        nodal(nodes, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(0, 0, std::pow(x.y(), p)); });
    EXPECT_NEAR(shear.dot(part.K * shear) / (c.mu * slope_squared), 1.0, 1e-11) << "order " << p;
    if (p < 3) continue;
    // u = (x y z^{p−2}, 0, 0) = x y g: ε_xx = y g, γ_xy = x g, γ_xz = x y g'.
    const auto mixed = nodal(
        nodes, [&](const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x() * x.y() * std::pow(x.z(), p - 2), 0, 0); });
    const double g2 = 1.0 / (2 * p - 3);
    const double dg2 = (p - 2.0) * (p - 2.0) / (2 * p - 5);
    const double expected = (c.lambda + 2 * c.mu) * g2 / 3 + c.mu * (g2 / 3 + dg2 / 9);
    EXPECT_NEAR(mixed.dot(part.K * mixed) / expected, 1.0, 1e-11) << "order " << p;
    EXPECT_NEAR(mixed.dot(part.M * mixed) / (7850.0 * g2 / 9), 1.0, 1e-11) << "order " << p;
  }
}

TEST(Assembly, OneLinearTetHasTheStiffnessWorkedByHand) {
  mesh::TetMesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  const Eigen::MatrixXd K = assemble(mesh::lagrange_nodes(mesh, 1), steel).K;
  const Lame c = lame(steel);
  const Eigen::Vector3d g[] = {{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int a = 0; a < 4; ++a) {
    for (int b = 0; b < 4; ++b) {
      const Eigen::Matrix3d block = (c.lambda * g[a] * g[b].transpose() + c.mu * g[b] * g[a].transpose() +
                                     c.mu * g[a].dot(g[b]) * Eigen::Matrix3d::Identity()) /
                                    6.0;
      EXPECT_LT((K.block<3, 3>(3 * a, 3 * b) - block).cwiseAbs().maxCoeff(), 1e-14 * c.mu) << a << ' ' << b;
    }
  }
  EXPECT_NEAR(K(0, 0), (c.lambda + 4 * c.mu) / 6, 1e-14 * c.mu);
  EXPECT_NEAR(K(0, 3), -(c.lambda + 2 * c.mu) / 6, 1e-14 * c.mu);
  EXPECT_NEAR(K(3, 7), c.lambda / 6, 1e-14 * c.mu) << "σ_xx by ε_yy";
  EXPECT_NEAR(K(4, 6), c.mu / 6, 1e-14 * c.mu) << "shear";
}

TEST(Assembly, MatricesAreSymmetricAndRigidMotionsCostNoEnergy) {
  const mesh::TetMesh mesh = distorted_block();
  for (int p = 1; p <= 6; ++p) {
    const auto nodes = mesh::lagrange_nodes(mesh, p);
    const Assembled part = assemble(nodes, steel);
    const linalg::SparseMatrix Kt = part.K.transpose();
    const linalg::SparseMatrix Mt = part.M.transpose();
    const double k = part.K.diagonal().maxCoeff();
    EXPECT_LT(linalg::combine(1.0, part.K, -1.0, Kt).coeffs().cwiseAbs().maxCoeff(), 1e-14 * k) << "order " << p;
    EXPECT_LT(linalg::combine(1.0, part.M, -1.0, Mt).coeffs().cwiseAbs().maxCoeff(),
              1e-14 * part.M.diagonal().maxCoeff());
    const Eigen::MatrixXd R = rigid_body_motions(nodes);
    const double scale = (part.K.cwiseAbs() * R.cwiseAbs()).maxCoeff();
    EXPECT_LT((part.K * R).cwiseAbs().maxCoeff() / scale, 1e-13) << "order " << p;
  }
}

TEST(Assembly, MassCentreAndInertiaAreTheBlocks) {
  for (int p = 1; p <= 6; ++p) {
    const mesh::TetMesh mesh = distorted_block();
    const auto nodes = mesh::lagrange_nodes(mesh, p);
    const MassProperties found = mass_properties(assemble(nodes, steel).node_mass, nodes);
    const MassProperties exact = box_mass_properties(size, 7850.0);
    EXPECT_NEAR(exact.mass_kg, 7850.0 * 0.009, 1e-10);
    EXPECT_NEAR(exact.inertia_kg_m2(2, 2), exact.mass_kg * (0.09 + 0.04) / 12, 1e-12);
    EXPECT_LT(relative_difference(found, exact), 1e-12) << "order " << p;
  }
}

TEST(Assembly, AnElementTurnedInsideOutIsAnError) {
  mesh::TetMesh mesh = mesh::kuhn_box(size, {1, 1, 1});
  std::swap(mesh.tets[4][2], mesh.tets[4][3]);
  EXPECT_THROW((void)assemble(mesh::lagrange_nodes(mesh, 1), steel), core::NumericalError);
}

TEST(Material, RefusesWhatNoSolidIs) {
  const Lame c = lame(steel);
  EXPECT_NEAR(c.mu, 210e9 / 2.6, 1e-3);
  EXPECT_NEAR(c.lambda, 210e9 * 0.3 / (1.3 * 0.4), 1e-3);
  for (const Material& bad :
       {Material{0, 0.3, 7850}, Material{210e9, 0.5, 7850}, Material{210e9, -0.1, 7850}, Material{210e9, 0.3, 0},
        Material{std::nan(""), 0.3, 7850}, Material{210e9, std::nan(""), 7850}}) {
    EXPECT_THROW((void)lame(bad), core::InputError);
  }
}

}  // namespace
}  // namespace thinwall::fem::assembly_test
