// A plate bent to a cylinder sector has the mass and inertia of the closed form, and is as free as a flat one.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>
#include <string>

#include "core/error.hpp"
#include "fem/mode_check.hpp"
#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "mesh/planar/bend.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::curved_wall_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};
const mesh::Box wall{{0.2, 0.08, 0.006}};
/// 115 degrees, its middle at x = 0.1 m.
const mesh::Bend sector{0.1, 0, 2, 0.1, 0.003};

Shaping bending(const mesh::Bend& bend) {
  return [bend](mesh::LagrangeNodes& nodes) { mesh::bend(bend, nodes.positions); };
}

/// Mass properties of the sector r_i ≤ r ≤ r_o, −φ ≤ angle ≤ φ, with the density of steel: with I_n = ∫ rⁿ dr, ∫ dA =
/// 2φ I₁, ∫ ζ dA = 2 sin φ I₂, ∫ ξ² dA = (φ − sin 2φ / 2) I₃, ∫ ζ² dA = (φ + sin 2φ / 2) I₃.
MassProperties sector_mass_properties() {
  const double half = 0.5 * wall.size.z();
  const double inner = sector.radius_m - half;
  const double outer = sector.radius_m + half;
  const auto moment = [&](int n) { return (std::pow(outer, n + 1) - std::pow(inner, n + 1)) / (n + 1); };
  const double phi = 0.5 * wall.size.x() / sector.radius_m;
  const double b = wall.size.y();
  const double rho = steel.density_kg_m3;
  MassProperties p;
  p.mass_kg = rho * b * 2.0 * phi * moment(1);
  const double zeta = rho * b * 2.0 * std::sin(phi) * moment(2) / p.mass_kg;
  p.centre_m = {sector.start_m, 0.5 * b, sector.middle_m - sector.radius_m + zeta};
  const double xx = rho * b * (phi - 0.5 * std::sin(2 * phi)) * moment(3);
  const double zz = rho * b * (phi + 0.5 * std::sin(2 * phi)) * moment(3) - p.mass_kg * zeta * zeta;
  const double yy = p.mass_kg * b * b / 12.0;
  p.inertia_kg_m2 = Eigen::Vector3d(yy + zz, xx + zz, xx + yy).asDiagonal();
  return p;
}

TEST(BentPlate, HasTheVolumeMassCentreAndInertiaOfTheSectorWithEveryOrderBetter) {
  const MassProperties exact = sector_mass_properties();
  EXPECT_NEAR(exact.mass_kg, steel.density_kg_m3 * wall.size.prod(), 1e-12) << "bending about the middle keeps it";
  double last = 1.0;
  for (int p = 1; p <= 6; ++p) {
    const Model model = supported_model(mesh::kuhn_box(wall.size, {5, 2, 1}), p, steel, {}, bending(sector));
    const double error = relative_difference(model.mass, exact);
    std::printf("bent plate order %d: mass %.1e, mass properties %.1e, det J down to %.2f\n", p,
                model.mass.mass_kg / exact.mass_kg - 1.0, error, model.least_jacobian);
    EXPECT_LT(error, last / 3.0) << "order " << p;
    EXPECT_EQ(model.curved_elements > 0, p > 1) << "order 1 has flat faces wherever its nodes are";
    last = error;
  }
  EXPECT_LT(last, 1e-8);
}

/// Slope of the error of the mass over the size of the elements.
TEST(BentPlate, MassConvergesWithTheOrderOfTheGeometry) {
  const double exact = sector_mass_properties().mass_kg;
  for (const int p : {1, 2, 3, 4}) {
    const auto error = [&](int cells) {
      auto nodes = mesh::lagrange_nodes(mesh::kuhn_box(wall.size, {cells, 1, 1}), p);
      mesh::bend(sector, nodes.positions);
      return std::abs(assemble(nodes, steel).node_mass.sum() / exact - 1.0);
    };
    const double rate = std::log2(error(4) / error(8));
    std::printf("bent plate order %d: mass to %.1e with 8 cells, rate %.2f\n", p, error(8), rate);
    // Interpolation gives p + 1; an even order gains one by symmetry.
    EXPECT_GT(rate, (p % 2 == 0 ? p + 2 : p + 1) - 0.4) << p;
  }
}

Eigen::VectorXd elastic_frequencies(const mesh::TetMesh& mesh, int order, const Material& material,
                                    const Shaping& shape) {
  const Model model = supported_model(mesh, order, material, {}, shape);
  EXPECT_EQ(model.rigid_motions, 6);
  const Factored factored = factorise(model);
  const Modes found = modes(model, factored, {.count = 6, .up_to_hz = {}});
  EXPECT_EQ(check_modes(model, factored, found).status, linalg::EigenCheckStatus::agrees);
  EXPECT_LT(found.pairs.lambda.head(6).cwiseAbs().maxCoeff(), 1e-6 * found.pairs.lambda(6));
  return found.frequency_hz.tail(6);
}

double difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a - b).cwiseQuotient(b).cwiseAbs().maxCoeff();
}

const mesh::TetMesh wall_mesh = mesh::kuhn_box(wall.size, {4, 2, 1});

/// Other numbers for the vertices, another order of the elements.
mesh::TetMesh renumbered(const mesh::TetMesh& mesh) {
  mesh::TetMesh shuffled = mesh;
  std::mt19937 random(11);
  std::vector<std::size_t> number(mesh.vertices.size());
  std::iota(number.begin(), number.end(), 0U);
  std::shuffle(number.begin(), number.end(), random);
  for (std::size_t v = 0; v < number.size(); ++v) shuffled.vertices[number[v]] = mesh.vertices[v];
  for (auto& tet : shuffled.tets) {
    for (int& v : tet) v = static_cast<int>(number[static_cast<std::size_t>(v)]);
  }
  std::shuffle(shuffled.tets.begin(), shuffled.tets.end(), random);
  return shuffled;
}

TEST(FreeBentPlate, HasSixRigidModesAndTheSameOthersTurnedRenumberedOrInMillimetres) {
  const Eigen::VectorXd expected = elastic_frequencies(wall_mesh, 3, steel, bending(sector));
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
  const auto turned = [&](mesh::LagrangeNodes& nodes) {
    mesh::bend(sector, nodes.positions);
    nodes.positions = (nodes.positions * Q.transpose()).eval();
    nodes.positions.rowwise() += Eigen::RowVector3d(2, -1, 0.5);
  };
  const double by_turning = difference(elastic_frequencies(wall_mesh, 3, steel, turned), expected);
  const double by_numbers = difference(elastic_frequencies(renumbered(wall_mesh), 3, steel, bending(sector)), expected);
  // Millimetres, newtons, tonnes: 1 MPa = 1 N/mm², 1 t/mm³ = 1e12 kg/m³.
  const Material in_mm{steel.youngs_modulus_Pa * 1e-6, steel.poisson_ratio, steel.density_kg_m3 * 1e-12};
  const auto enlarged = [&](mesh::LagrangeNodes& nodes) {
    mesh::bend(sector, nodes.positions);
    nodes.positions *= 1e3;
  };
  const double by_units = difference(elastic_frequencies(wall_mesh, 3, in_mm, enlarged), expected);
  std::printf("free bent plate: first %.3f Hz; turned %.1e, renumbered %.1e, in mm %.1e\n", expected(0), by_turning,
              by_numbers, by_units);
  // The rigid modes need a shift, which leaves some ten digits.
  EXPECT_LT(by_turning, 1e-9);
  EXPECT_LT(by_numbers, 1e-9);
  EXPECT_LT(by_units, 1e-9);
}

// The integrand of a curved element's stiffness is rational, and the conical product rule treats its first corner as
// the apex: with other corners first the error of the integration is another. It has to be small beside that of the
// order itself.
TEST(FreeBentPlate, OrderOfTheCornersMovesTheFrequenciesFarLessThanTheOrderOfTheElements) {
  mesh::TetMesh other = wall_mesh;
  for (auto& tet : other.tets) tet = {tet[1], tet[2], tet[0], tet[3]};
  for (const int p : {2, 3, 4}) {
    const Eigen::VectorXd expected = elastic_frequencies(wall_mesh, p, steel, bending(sector));
    const double corners = difference(elastic_frequencies(other, p, steel, bending(sector)), expected);
    const double order = difference(elastic_frequencies(wall_mesh, p + 1, steel, bending(sector)), expected);
    std::printf("free bent plate order %d: other corners first %.1e, next order %.1e\n", p, corners, order);
    EXPECT_LT(corners, 1e-2 * order) << p;
  }
}

/// Puts the vertices and the inner face's nodes onto the bent wall and leaves all others on the straight lattice
/// between the vertices, as a projection of one face does.
Shaping projecting_the_inner_face(const mesh::Bend& bend) {
  return [bend](mesh::LagrangeNodes& nodes) {
    const mesh::Positions flat = nodes.positions;
    mesh::Positions round = flat;
    mesh::bend(bend, round);
    const auto alphas = mesh::lattice(nodes.order);
    for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
      for (std::size_t a = 0; a < alphas.size(); ++a) {
        const int node = nodes.elements(e, static_cast<Eigen::Index>(a));
        nodes.positions.row(node).setZero();
        for (std::size_t k = 0; k < 4; ++k) {
          const int vertex = nodes.elements(e, static_cast<Eigen::Index>(k));
          nodes.positions.row(node) += double(alphas[a][k]) / nodes.order * round.row(vertex);
        }
        if (std::abs(flat(node, 2)) < 1e-12) nodes.positions.row(node) = round.row(node);
      }
    }
  };
}

// The arc of the inner face bulges over its chord by about s²/8R: 50 mm with one cell, 0.35 mm with twelve; the wall is
// 6 mm thick.
TEST(ProjectedWall, AnElementThatTheProjectionTurnsInsideOutIsNamed) {
  try {
    (void)supported_model(mesh::kuhn_box(wall.size, {1, 1, 1}), 2, steel, {}, projecting_the_inner_face(sector));
    FAIL() << "accepted";
  } catch (const core::NumericalError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("curved tetrahedron "), std::string::npos) << message;
    EXPECT_NE(message.find(" is turned inside out (det J falls to -"), std::string::npos) << message;
    EXPECT_NE(message.find("use smaller elements"), std::string::npos) << message;
  }
  const Model fine =
      supported_model(mesh::kuhn_box(wall.size, {12, 2, 1}), 2, steel, {}, projecting_the_inner_face(sector));
  std::printf("inner face projected, 12 cells: det J down to %.2f\n", fine.least_jacobian);
  EXPECT_GT(fine.least_jacobian, 0.5);
}

}  // namespace
}  // namespace thinwall::fem::curved_wall_test
