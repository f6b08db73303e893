// NAFEMS LE10: a quarter of a thick plate between two ellipses under pressure; σ_yy at D = (2, 0, top) is −5.38 MPa
// (NAFEMS, The Standard NAFEMS Benchmarks, 1990). Curved elements, and a stress, which is a derivative.
//
// Inner ellipse 2 × 1 m, outer 3.25 × 2.75 m, 0.6 m thick; E = 210 GPa, ν = 0.3; 1 MPa on the upper face. Held: v = 0
// on the face y = 0, u = 0 on the face x = 0, u = v = 0 on the outer curved face, w = 0 along its line at half height.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cstdio>
#include <numbers>

#include "fem/curved_element.hpp"
#include "fem/reference_element.hpp"
#include "tests/mesh/kuhn_box.hpp"
#include "tests/verification/structures/prism_part.hpp"

namespace thinwall::nafems_le10_test {
namespace {

const fem::Material steel{210e9, 0.3, 7850.0};
constexpr double thickness = 0.6;
constexpr double pressure = 1e6;

/// The map from the block (s, t, z) ∈ [0, 1]² × [0, thickness] to the plate, s outwards and t around; cells of equal
/// size in the block shrink towards D, where s = t = 0.
Eigen::Vector3d onto_plate(const Eigen::Vector3d& x) {
  const double s = x.x() * (0.4 + 0.6 * x.x());
  const double angle = 0.5 * std::numbers::pi * x.y() * (0.4 + 0.6 * x.y());
  return {(2.0 + 1.25 * s) * std::cos(angle), (1.0 + 1.75 * s) * std::sin(angle), x.z()};
}

struct Plate {
  fem::Model model;
  int corner = 0;  // the node D
};

Plate elliptic_plate(int order) {
  mesh::TetMesh block = mesh::kuhn_box({1, 1, thickness}, {3, 5, 2});
  mesh::LagrangeNodes nodes = mesh::lagrange_nodes(block, order);
  Plate plate;
  std::vector<int> fixed;
  const auto at = [](double value, double place) { return std::abs(value - place) < 1e-9; };
  for (int i = 0; i < static_cast<int>(nodes.positions.rows()); ++i) {
    const Eigen::Vector3d x = nodes.positions.row(i);
    if (at(x.y(), 0) || at(x.x(), 1)) fixed.push_back(3 * i + 1);
    if (at(x.y(), 1) || at(x.x(), 1)) fixed.push_back(3 * i);
    if (at(x.x(), 1) && at(x.z(), 0.5 * thickness)) fixed.push_back(3 * i + 2);
    if (x.norm() > 0.0 && at(x.x(), 0) && at(x.y(), 0) && at(x.z(), thickness)) plate.corner = i;
    nodes.positions.row(i) = onto_plate(x).transpose();
  }
  plate.model = fem::build_model(std::move(block), std::move(nodes), steel, fixed);
  return plate;
}

Eigen::Matrix<double, Eigen::Dynamic, 3> element_nodes(const mesh::LagrangeNodes& nodes, Eigen::Index e) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> x(nodes.elements.cols(), 3);
  for (Eigen::Index a = 0; a < x.rows(); ++a) x.row(a) = nodes.positions.row(nodes.elements(e, a));
  return x;
}

/// ∫ N_a dA over the upper face z = h for every node, as ∫ ∂/∂z (N_a z / h) dV: the divergence theorem with a field
/// that vanishes on the lower face and runs along the sides.
Eigen::VectorXd upper_face_areas(const mesh::LagrangeNodes& nodes) {
  const fem::CurvedReference& reference = fem::curved_reference(nodes.order);
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(nodes.positions.rows());
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
    const auto x = element_nodes(nodes, e);
    for (Eigen::Index q = 0; q < reference.weight.size(); ++q) {
      Eigen::Matrix<double, Eigen::Dynamic, 3> slopes(x.rows(), 3);
      for (std::size_t k = 0; k < 3; ++k) slopes.col(static_cast<Eigen::Index>(k)) = reference.slopes[k].col(q);
      const Eigen::Matrix3d J = x.transpose() * slopes;
      const Eigen::VectorXd along_z = slopes * J.inverse().col(2);
      const double z = reference.values.col(q).dot(x.col(2));
      const double volume = reference.weight(q) * J.determinant() / 6.0;
      for (Eigen::Index a = 0; a < x.rows(); ++a)
        areas(nodes.elements(e, a)) += volume * (along_z(a) * z + reference.values(a, q)) / thickness;
    }
  }
  return areas;
}

/// σ_yy at a corner node of the mesh from the displacement gradient, one value for each element that meets there.
std::vector<double> stress_yy(const Plate& plate, const Eigen::VectorXd& free) {
  const auto u = fem::displacements(plate.model, free);
  const mesh::LagrangeNodes& nodes = plate.model.nodes;
  const fem::Lame c = fem::lame(steel);
  std::vector<double> stresses;
  for (Eigen::Index e = 0; e < nodes.elements.rows(); ++e) {
    for (Eigen::Index corner = 0; corner < 4; ++corner) {
      if (nodes.elements(e, corner) != plate.corner) continue;
      const auto slopes = fem::shape_slopes(nodes.order, Eigen::Vector4d::Unit(corner));
      const Eigen::Matrix3d J = element_nodes(nodes, e).transpose() * slopes;
      Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
      for (Eigen::Index a = 0; a < slopes.rows(); ++a)
        gradient += u.row(nodes.elements(e, a)).transpose() * slopes.row(a);
      gradient *= J.inverse();
      stresses.push_back(c.lambda * gradient.trace() + 2.0 * c.mu * gradient(1, 1));
    }
  }
  return stresses;
}

TEST(NafemsLE10, StressAtTheInnerCornerOfTheEllipticPlateIsThePublishedOne) {
  double last = 0.0;
  for (const int order : {4, 5, 6}) {
    const Plate plate = elliptic_plate(order);
    EXPECT_EQ(plate.model.rigid_motions, 0);
    const double volume = 0.25 * std::numbers::pi * (3.25 * 2.75 - 2.0) * thickness;
    EXPECT_NEAR(plate.model.mass.mass_kg / (7850.0 * volume), 1.0, order < 6 ? 1e-6 : 1e-8);
    const Eigen::VectorXd areas = upper_face_areas(plate.model.nodes);
    EXPECT_NEAR(areas.sum() * thickness / volume, 1.0, order < 6 ? 1e-6 : 1e-8);
    Eigen::VectorXd load = Eigen::VectorXd::Zero(plate.model.K.rows());
    for (std::size_t row = 0; row < plate.model.free_rows.size(); ++row) {
      const int dof = plate.model.free_rows[row];
      if (dof % 3 == 2) load(static_cast<Eigen::Index>(row)) = -pressure * areas(dof / 3);
    }
    const Eigen::VectorXd u = fem::factorise(plate.model).factor.solve(load);
    EXPECT_LT((plate.model.K * u - load).norm(), 1e-9 * load.norm());
    const auto stresses = stress_yy(plate, u);
    double mean = 0.0;
    for (const double s : stresses) mean += s / static_cast<double>(stresses.size());
    const auto [least, largest] = std::minmax_element(stresses.begin(), stresses.end());
    std::printf("LE10, order %d: %td DOFs, σ_yy at D %.4f MPa (elements %.4f to %.4f), det J down to %.2f\n", order,
                plate.model.K.rows(), mean * 1e-6, *least * 1e-6, *largest * 1e-6, plate.model.least_jacobian);
    if (order == 6) {
      EXPECT_NEAR(mean, -5.38e6, 0.01 * 5.38e6);
      EXPECT_NEAR(mean, last, 2e-3 * 5.38e6) << "orders 5 and 6 agree";
      EXPECT_LT(*largest - *least, 0.01 * 5.38e6) << "the elements at D agree";
    }
    last = mean;
  }
}

}  // namespace
}  // namespace thinwall::nafems_le10_test
