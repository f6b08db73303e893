// Checks of imported matrices, their units, and their conversion to named DOFs and back.

#include "dynamics/sparse_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/error.hpp"
#include "dynamics/beam_element.hpp"
#include "dynamics/conversion.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "dynamics/unit_system.hpp"
#include "random_models.hpp"

namespace thinwall::dynamics::sparse_model_test {
namespace {

using testing::spring_chain;

/// Two nodes with x, ry and an amplitude.
SparseModel small_model() {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(5, 5);
  K << 4, -1, -2, 0, 0.5, -1, 5, 0, 1, 0, -2, 0, 6, 1, 0, 0, 1, 1, 7, 0, 0.5, 0, 0, 0, 9;
  SparseModel model;
  model.K = K.sparseView();
  model.M = Eigen::MatrixXd((Eigen::VectorXd(5) << 2, 1, 3, 1, 1).finished().asDiagonal()).sparseView();
  model.dofs = {{11, 1}, {11, 5}, {12, 1}, {12, 5}, {1001, 0}};
  return model;
}

std::string complaint(const SparseModel& model) {
  try {
    require_plausible(model);
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(SparseModel, IsTakenAsItIsWhereNothingIsWrong) {
  EXPECT_EQ(complaint(small_model()), "");
}

TEST(SparseModel, NamesTheDofsOfAnAsymmetricPairAndItsValues) {
  SparseModel model = small_model();
  model.K.coeffRef(0, 2) = -2.5;
  const std::string message = complaint(model);
  EXPECT_TRUE(has(message, "K(node 11.x, node 12.x) = -2.5")) << message;
  EXPECT_TRUE(has(message, "K(node 12.x, node 11.x) = -2")) << message;
  model = small_model();
  model.K.coeffRef(0, 2) *= 1.0 + 1e-12;
  EXPECT_EQ(complaint(model), "") << "round-off";
  model = small_model();
  model.M.coeffRef(0, 3) = 0.1;  // its mirror image is absent
  EXPECT_TRUE(has(complaint(model), "M(node 11.x, node 12.ry) = 0.1")) << complaint(model);
}

TEST(SparseModel, NamesANegativeDiagonal) {
  SparseModel model = small_model();
  model.names[11] = "P";
  model.M.coeffRef(1, 1) = -0.3;
  EXPECT_TRUE(has(complaint(model), "M(P.ry, P.ry) = -0.3")) << complaint(model);
}

TEST(SparseModel, NamesWhatIsNotFinite) {
  SparseModel model = small_model();
  model.K.coeffRef(2, 0) = std::nan("");
  EXPECT_TRUE(has(complaint(model), "K(node 12.x, node 11.x)")) << complaint(model);
  model = small_model();
  model.positions[11] = Eigen::Vector3d(0.0, INFINITY, 0.0);
  EXPECT_TRUE(has(complaint(model), "position of node 11")) << complaint(model);
}

TEST(SparseModel, RefusesATableThatDoesNotFit) {
  SparseModel model = small_model();
  model.dofs.pop_back();
  EXPECT_TRUE(has(complaint(model), "4 rows and K 5")) << complaint(model);
  model = small_model();
  model.dofs[3] = model.dofs[0];
  EXPECT_TRUE(has(complaint(model), "rows 1 and 4 of the DOF table are both node 11.x")) << complaint(model);
  model = small_model();
  model.dofs[2].component = 7;
  EXPECT_TRUE(has(complaint(model), "component 7 of node 12")) << complaint(model);
  model = small_model();
  model.M.resize(4, 4);
  EXPECT_TRUE(has(complaint(model), "M is 4 x 4, K has 5")) << complaint(model);
}

/// A beam element along x between nodes 1 and 2, in a system of units with so many units to the metre and the kilogram.
SparseModel beam_in_units(double metre, double kilogram) {
  BeamSection section = dynamics::section(Tube{0.03, 0.02, 210e9, 0.3, 7850.0});
  section.youngs_modulus_Pa *= kilogram / metre;
  section.shear_modulus_Pa *= kilogram / metre;
  section.density_kg_m3 *= kilogram / std::pow(metre, 3);
  section.area_m2 *= std::pow(metre, 2);
  for (double* moment : {&section.I_y_m4, &section.I_z_m4, &section.J_m4}) *moment *= std::pow(metre, 4);
  SparseModel model;
  model.K = Eigen::MatrixXd(beam_stiffness(section, 0.4 * metre)).sparseView();
  model.M = Eigen::MatrixXd(beam_mass(section, 0.4 * metre)).sparseView();
  for (const int node : {1, 2})
    for (int component = 1; component <= 6; ++component) model.dofs.push_back({node, component});
  model.positions = {{1, Eigen::Vector3d::Zero()}, {2, {0.4 * metre, 0.0, 0.0}}};
  return model;
}

double largest_difference(const Eigen::SparseMatrix<double>& A, const Eigen::SparseMatrix<double>& B) {
  const Eigen::MatrixXd a(A), b(B);
  const Eigen::VectorXd scale = b.diagonal().cwiseSqrt().cwiseInverse();
  return (scale.asDiagonal() * (a - b) * scale.asDiagonal()).cwiseAbs().maxCoeff();
}

// A beam element given in other units and converted to SI equals the one given in SI, rotations included.
TEST(UnitSystem, OfAnyConsistentSystemGivesTheBeamInSi) {
  const SparseModel si = beam_in_units(1.0, 1.0);
  for (const auto& [length, mass, metre, kilogram] :
       {std::tuple{"mm", "t", 1e3, 1e-3}, {"mm", "kg", 1e3, 1.0}, {"cm", "g", 1e2, 1e3}, {"m", "kg", 1.0, 1.0}}) {
    const SparseModel converted = in_si(beam_in_units(metre, kilogram), unit_system(length, mass));
    EXPECT_LT(largest_difference(converted.K, si.K), 1e-14) << length;
    EXPECT_LT(largest_difference(converted.M, si.M), 1e-14) << length;
    EXPECT_NEAR(converted.positions.at(2).x(), 0.4, 1e-15);
  }
}

// One common factor on K and M and a change of coordinates: frequencies stay, and a mass-normalised mode stays so.
TEST(UnitSystem, LeavesFrequenciesAndAmplitudesOfModesAlone) {
  const SparseModel model = small_model();
  const SparseModel converted = in_si(model, unit_system("mm", "t"));
  EXPECT_EQ(converted.M.coeff(4, 4), 1.0);
  EXPECT_EQ(converted.K.coeff(4, 4), 9.0);
  const Eigen::VectorXd before = undamped_modes(spatial_model(model)).omega_rad_s;
  const Eigen::VectorXd after = undamped_modes(spatial_model(converted)).omega_rad_s;
  EXPECT_LT((after.cwiseQuotient(before).array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST(UnitSystem, HasNoDefaultAndTakesNoOtherDimension) {
  for (const auto& [length, mass, part] : {std::tuple{"", "t", "unit of length"},
                                           {"mm", "", "unit of mass"},
                                           {"mm", "N", "unit of mass"},
                                           {"kg", "t", "unit of length"},
                                           {"mmm", "t", "mmm"}}) {
    try {
      (void)unit_system(length, mass);
      ADD_FAILURE() << length << " " << mass;
    } catch (const core::InputError& error) {
      EXPECT_TRUE(has(error.what(), part)) << error.what();
    }
  }
  EXPECT_THROW((void)in_si(small_model(), {0.0, 1.0}), core::InputError);
  EXPECT_THROW((void)in_si(small_model(), {1.0, -1.0}), core::InputError);
}

TEST(SparseModel, OfNamedDofsAndBackIsTheSameBitByBit) {
  SpatialModel model = spring_chain(6, 3);
  model.dofs[1] = {"node 17", Eigen::Vector3d::UnitZ(), DofKind::rotation};
  model.dofs[2] = {"node 1", Eigen::Vector3d::UnitY(), DofKind::translation};
  model.dofs[4] = {"mode 1", Eigen::Vector3d::Zero(), DofKind::modal};
  model.C = 0.01 * model.K;
  const SparseModel sparse = sparse_model(model);
  EXPECT_EQ(sparse.dofs[1], (NodeDof{17, 6}));
  EXPECT_EQ(sparse.dofs[2], (NodeDof{1, 2}));
  const SpatialModel back = spatial_model(sparse);
  EXPECT_EQ(back.K, model.K);
  EXPECT_EQ(back.M, model.M);
  EXPECT_EQ(back.C, model.C);
  ASSERT_EQ(back.dofs.size(), model.dofs.size());
  for (std::size_t i = 0; i < back.dofs.size(); ++i) {
    EXPECT_EQ(name(back.dofs[i]), name(model.dofs[i]));
    EXPECT_EQ(back.dofs[i].kind, model.dofs[i].kind);
  }
}

TEST(SparseModel, RefusesWhatNodesAndComponentsDoNotSay) {
  SpatialModel oblique = spring_chain(2, 1);
  oblique.dofs[0].direction = Eigen::Vector3d(0.6, 0.8, 0.0);
  EXPECT_THROW((void)sparse_model(oblique), core::InputError);
  SpatialModel hysteretic = spring_chain(2, 1);
  hysteretic.D = hysteretic.K;
  EXPECT_THROW((void)sparse_model(hysteretic), core::InputError);
  EXPECT_THROW((void)spatial_model(small_model(), 4), core::InputError);
}

}  // namespace
}  // namespace thinwall::dynamics::sparse_model_test
