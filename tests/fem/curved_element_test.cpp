#include "fem/curved_element.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "core/error.hpp"
#include "fem/assembly.hpp"
#include "fem/quadrature.hpp"
#include "fem/reference_element.hpp"
#include "fem/rigid_body.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::curved_element_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};
const Eigen::Vector3d size(0.3, 0.2, 0.15);

TEST(ShapeSlopes, AreTheDifferencesOfTheShapeFunctions) {
  std::mt19937 random(2);
  std::exponential_distribution<double> share(1.0);
  const double h = 1e-5;
  for (int p = 1; p <= 6; ++p) {
    for (int sample = 0; sample < 10; ++sample) {
      Eigen::Vector4d lambda(share(random), share(random), share(random), share(random));
      lambda /= lambda.sum();
      const Eigen::MatrixX3d slopes = shape_slopes(p, lambda);
      EXPECT_LT(slopes.colwise().sum().cwiseAbs().maxCoeff(), 1e-12) << "the functions sum to one";
      for (Eigen::Index k = 0; k < 3; ++k) {
        Eigen::Vector4d step = Eigen::Vector4d::Zero();
        step(k + 1) = h;
        step(0) = -h;
        const Eigen::VectorXd difference =
            (shape_functions(p, lambda + step) - shape_functions(p, lambda - step)) / (2.0 * h);
        // h² N'''/6 with N''' up to p³ times a hundred.
        EXPECT_LT((slopes.col(k) - difference).cwiseAbs().maxCoeff(), 1e-7 * std::max(1.0, slopes.norm())) << p;
      }
    }
  }
}

/// The matrices of one straight tetrahedron in the element's own numbering, by the reference matrices.
struct Straight {
  Eigen::Matrix<double, Eigen::Dynamic, 3> nodes;
  Eigen::MatrixXd K;
  Eigen::MatrixXd M;
};

Straight straight_element(const mesh::TetMesh& tet, int order) {
  const auto nodes = mesh::lagrange_nodes(tet, order);
  const Assembled part = assemble(nodes, steel);
  const Eigen::MatrixXd K = part.K;
  const Eigen::MatrixXd M = part.node_mass;
  const Eigen::VectorXi number = nodes.elements.row(0).transpose();
  std::vector<int> rows;
  for (const int node : number) rows.insert(rows.end(), {3 * node, 3 * node + 1, 3 * node + 2});
  EXPECT_EQ(part.curved_elements, 0);
  return {nodes.positions(number, Eigen::all), K(rows, rows), M(number, number)};
}

TEST(CurvedElement, OfFlatFacesHasTheMatricesOfTheStraightOne) {
  mesh::TetMesh tet;
  tet.vertices = {{0.1, 0.2, -0.1}, {1.2, 0.1, 0.2}, {0.4, 0.9, 0.1}, {0.2, 0.5, 0.3}};
  tet.tets = {{0, 1, 2, 3}};
  ASSERT_GT(mesh::volume(tet), 0.0);
  for (int p = 1; p <= 6; ++p) {
    const Straight straight = straight_element(tet, p);
    const CurvedElement curved = curved_element(curved_reference(p), straight.nodes, lame(steel), steel.density_kg_m3);
    const double k = (curved.K - straight.K).cwiseAbs().maxCoeff() / straight.K.cwiseAbs().maxCoeff();
    const double m = (curved.M - straight.M).cwiseAbs().maxCoeff() / straight.M.cwiseAbs().maxCoeff();
    std::printf("order %d: quadrature against exact integrals: K %.1e, M %.1e\n", p, k, m);
    EXPECT_LT(k, 1e-12) << p;
    EXPECT_LT(m, 1e-12) << p;
    EXPECT_NEAR(curved.least_jacobian, 1.0, 1e-12) << p;
  }
}

TEST(CurvedElement, OrdersOutsideOneToSixAreRefused) {
  EXPECT_THROW((void)curved_reference(0), core::InputError);
  EXPECT_THROW((void)curved_reference(7), core::InputError);
}

bool inside(const Eigen::Vector3d& x) {
  return (x.array() > 1e-9).all() && (x.array() < size.array() - 1e-9).all();
}

/// A block whose nodes are moved smoothly inside, by up to a seventh of a cell, and not at all on its faces.
mesh::LagrangeNodes wavy_block(int order) {
  auto nodes = mesh::lagrange_nodes(mesh::kuhn_box(size, {2, 2, 2}), order);
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    const Eigen::Vector3d x = nodes.positions.row(i);
    const Eigen::Array3d s = (std::numbers::pi * x.cwiseQuotient(size)).array().sin();
    nodes.positions.row(i) += (s.prod() * Eigen::Vector3d(0.02, -0.015, 0.01)).transpose();
  }
  return nodes;
}

TEST(CurvedPatchTest, ALinearFieldNeedsNoInnerForcesAndHasTheExactEnergyAndVolume) {
  Eigen::Matrix3d A;
  A << 1.0, -0.4, 0.3, 0.7, -0.5, 0.2, 0.1, 0.6, 0.8;
  const Eigen::Matrix3d strain = 0.5 * (A + A.transpose());
  const Lame c = lame(steel);
  const double energy = (c.lambda * strain.trace() * strain.trace() + 2.0 * c.mu * strain.squaredNorm()) * size.prod();
  for (int p = 2; p <= 6; ++p) {
    const auto nodes = wavy_block(p);
    const Assembled part = assemble(nodes, steel);
    EXPECT_GT(part.curved_elements, 40) << "nearly all of the 48";
    EXPECT_LT(part.least_jacobian, 0.9);
    EXPECT_GT(part.least_jacobian, 0.0);
    Eigen::VectorXd u(3 * nodes.positions.rows());
    for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i)
      u.segment<3>(3 * i) = A * nodes.positions.row(i).transpose();
    const Eigen::VectorXd force = part.K * u;
    double inner = 0.0;
    for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
      if (inside(nodes.positions.row(i))) inner = std::max(inner, force.segment<3>(3 * i).cwiseAbs().maxCoeff());
    }
    const double scale = (part.K.cwiseAbs() * u.cwiseAbs()).maxCoeff();
    const double mass = part.node_mass.sum() / (steel.density_kg_m3 * size.prod()) - 1.0;
    std::printf("curved patch test order %d: %d curved, det J down to %.2f, inner force %.1e, energy %.1e, mass %.1e\n",
                p, part.curved_elements, part.least_jacobian, inner / scale, u.dot(force) / energy - 1.0, mass);
    EXPECT_LT(inner / scale, 1e-13) << "order " << p;
    EXPECT_NEAR(u.dot(force) / energy, 1.0, 1e-11) << "order " << p;
    EXPECT_NEAR(mass, 0.0, 1e-12) << "order " << p;
  }
}

TEST(CurvedAssembly, IsSymmetricAndRigidMotionsCostNoEnergy) {
  for (int p = 2; p <= 6; ++p) {
    const auto nodes = wavy_block(p);
    const Assembled part = assemble(nodes, steel);
    const linalg::SparseMatrix Kt = part.K.transpose();
    EXPECT_LT(linalg::combine(1.0, part.K, -1.0, Kt).coeffs().cwiseAbs().maxCoeff(),
              1e-14 * part.K.diagonal().maxCoeff())
        << "order " << p;
    const Eigen::MatrixXd R = rigid_body_motions(nodes);
    const double scale = (part.K.cwiseAbs() * R.cwiseAbs()).maxCoeff();
    EXPECT_LT((part.K * R).cwiseAbs().maxCoeff() / scale, 1e-13) << "order " << p;
  }
}

// The field x² lies in the space of straight elements, not of curved ones: its energy ∫ (λ+2μ) (2x)² dV comes out
// better with every order, odd and even ones by different factors (3 to 26).
TEST(CurvedAssembly, ReproducesAQuadraticFieldBetterWithEveryOrder) {
  const Lame c = lame(steel);
  const double exact = (c.lambda + 2 * c.mu) * 4.0 / 3.0 * std::pow(size.x(), 3) * size.y() * size.z();
  double last = 1.0;
  for (int p = 2; p <= 6; ++p) {
    const auto nodes = wavy_block(p);
    const Assembled part = assemble(nodes, steel);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(3 * nodes.positions.rows());
    for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) u(3 * i) = nodes.positions(i, 0) * nodes.positions(i, 0);
    const double error = std::abs(u.dot(part.K * u) / exact - 1.0);
    std::printf("curved elements of order %d: energy of a quadratic field to %.1e\n", p, error);
    EXPECT_LT(error, last / 2.0) << "order " << p;
    last = error;
  }
  EXPECT_LT(last, 1e-6);
}

TEST(CurvedAssembly, AnElementTurnedInsideOutIsNamed) {
  auto nodes = mesh::lagrange_nodes(mesh::kuhn_box(size, {2, 2, 2}), 4);
  constexpr Eigen::Index victim = 17;
  // The node with α = (1, 1, 1, 1) belongs to this element alone.
  const auto alphas = mesh::lattice(4);
  const auto centre = std::find(alphas.begin(), alphas.end(), std::array{1, 1, 1, 1}) - alphas.begin();
  nodes.positions.row(nodes.elements(victim, centre)) += Eigen::RowVector3d(0.06, 0.0, 0.0);
  try {
    (void)assemble(nodes, steel);
    FAIL() << "accepted";
  } catch (const core::NumericalError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("curved tetrahedron 17 is turned inside out"), std::string::npos) << message;
    EXPECT_NE(message.find("smaller elements"), std::string::npos) << message;
  }
  nodes.positions.row(nodes.elements(victim, centre)) -= Eigen::RowVector3d(0.059, 0.0, 0.0);
  const Assembled part = assemble(nodes, steel);
  EXPECT_EQ(part.curved_elements, 1) << "moved by a millimetre it is curved, and fine";
}

TEST(CurvedAssembly, APositionThatIsNoNumberIsAnError) {
  auto nodes = mesh::lagrange_nodes(mesh::kuhn_box(size, {1, 1, 1}), 3);
  nodes.positions(nodes.positions.rows() - 1, 1) = std::nan("");
  EXPECT_THROW((void)assemble(nodes, steel), core::NumericalError) << "inside an element";
  nodes = mesh::lagrange_nodes(mesh::kuhn_box(size, {1, 1, 1}), 3);
  nodes.positions(0, 2) = HUGE_VAL;
  EXPECT_THROW((void)assemble(nodes, steel), core::NumericalError) << "a vertex";
}

}  // namespace
}  // namespace thinwall::fem::curved_element_test
