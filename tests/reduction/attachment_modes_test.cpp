#include "reduction/methods/attachment_modes.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "tests/reduction/solid_part.hpp"

namespace thinwall::reduction::attachment_modes_test {
namespace {

/// A plate on its foot, its reduction at one corner, and the place to which the interface moves: two patches.
struct Moved {
  fem::Model model = block({0.3, 0.2, 0.02}, {3, 2, 1}, 2, true);
  Interface corner = interface_at(model, {{"P", {0.3, 0.0, 0.02}, 0.0, xyz}});
  Interface place = interface_at(
      model, {{"A", {0.29, 0.12, 0.02}, 0.01, xyz}, {"B", {0.22, 0.12, 0.0}, 0.01, {Eigen::Vector3d::UnitZ()}}});
  StaticInverse inverse{model.K, model.node_of_row};

  [[nodiscard]] PartModes modes(int count) const {
    return part_modes(craig_bampton(model.K, model.M, inverse.action(), corner, {.modes = count, .up_to_hz = {}}),
                      model.M, inverse.action());
  }
  [[nodiscard]] dynamics::SpatialModel at_place(int count) const {
    return with_attachment_modes(modes(count), model.M, inverse.action(), place);
  }
};

/// Wᵀ (K − ω²M)⁻¹ W of matrices, W: rows of the first DOFs or any.
Eigen::MatrixXd receptance(const Eigen::MatrixXd& K, const Eigen::MatrixXd& M, const Eigen::MatrixXd& W, double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  return W.transpose() * Eigen::MatrixXd(K - omega * omega * M).ldlt().solve(W);
}

Eigen::MatrixXd receptance(const dynamics::SpatialModel& model, Eigen::Index interface, double hz) {
  return receptance(model.K, model.M, Eigen::MatrixXd::Identity(model.size(), interface), hz);
}

double difference(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found - expected).norm() / expected.norm();
}

TEST(AttachmentModes, StaticReceptancesAreThoseOfTheFullModel) {
  const Moved part;
  const Eigen::MatrixXd exact = receptance(part.model.K, part.model.M, part.place.W, 0.0);
  for (const int count : {0, 5, 20}) {
    const auto model = part.at_place(count);
    ASSERT_EQ(model.size(), 4 + count);
    EXPECT_LT(difference(receptance(model, 4, 0.0), exact), 1e-9) << count << " modes";
  }
}

/// The modes left out lie above the last one kept, and their compliance and inertia are in the attachment modes to
/// first order: the error is Σ φ² ω⁴/λ³ over the modes left out, and falls with the fourth power of the last frequency
/// or faster.
TEST(AttachmentModes, ReceptancesConvergeToTheFullModelsWithExactModes) {
  const Moved part;
  const auto all = linalg::dense_eigenpairs(part.model.K, part.model.M, Eigen::MatrixXd(part.model.K.rows(), 0));
  const double hz = 0.5 * (std::sqrt(all.lambda(2)) + std::sqrt(all.lambda(3))) / (2.0 * std::numbers::pi);
  const Eigen::MatrixXd exact = receptance(part.model.K, part.model.M, part.place.W, hz);
  const auto error = [&](Eigen::Index kept) {
    const PartModes modes{all.lambda.head(kept), all.Phi.leftCols(kept)};
    return difference(receptance(with_attachment_modes(modes, part.model.M, part.inverse.action(), part.place), 4, hz),
                      exact);
  };
  const double few = error(8), many = error(24);
  std::printf("attachment modes: receptance between modes 3 and 4 off by %.1e with 8 modes, %.1e with 24\n", few, many);
  EXPECT_LT(few, 1e-2);
  EXPECT_LT(many, few * std::pow(all.lambda(8) / all.lambda(24), 2.0));
}

TEST(AttachmentModes, ModesOfAReducedPartAreFreedFromItsInterface) {
  const Moved part;
  const auto exact = linalg::dense_eigenpairs(part.model.K, part.model.M, Eigen::MatrixXd(part.model.K.rows(), 0));
  const PartModes modes = part.modes(24);
  EXPECT_LT((modes.Phi.transpose() * part.model.M * modes.Phi - Eigen::MatrixXd::Identity(24, 24)).norm(), 1e-9);
  for (Eigen::Index k = 0; k < 24; ++k)
    EXPECT_GE(modes.lambda(k), exact.lambda(k) * (1.0 - 1e-9)) << "Rayleigh and Ritz";
  for (Eigen::Index k = 0; k < 8; ++k) EXPECT_NEAR(modes.lambda(k) / exact.lambda(k), 1.0, 1e-6) << "mode " << k + 1;
  const auto found = dynamics::undamped_modes(part.at_place(24)).omega_rad_s;
  for (Eigen::Index k = 0; k < 8; ++k) EXPECT_NEAR(found(k) / std::sqrt(exact.lambda(k)), 1.0, 1e-6) << k + 1;
}

TEST(AttachmentModes, WhereTheInterfaceWasReducedItIsAsNearToTheFullModelAsCraigBampton) {
  const Moved part;
  const CraigBampton reduced =
      craig_bampton(part.model.K, part.model.M, part.inverse.action(), part.corner, {.modes = 24, .up_to_hz = {}});
  const auto model = with_attachment_modes(part_modes(reduced, part.model.M, part.inverse.action()), part.model.M,
                                           part.inverse.action(), part.corner);
  EXPECT_EQ(dynamics::name(model.dofs.front()), "P.x");
  for (const double hz : {0.0, 100.0, 1000.0}) {
    const Eigen::MatrixXd exact = receptance(part.model.K, part.model.M, part.corner.W, hz);
    EXPECT_LE(difference(receptance(model, 3, hz), exact), difference(receptance(reduced.model, 3, hz), exact) + 1e-9);
    EXPECT_LT(difference(receptance(model, 3, hz), exact), 1e-5) << hz << " Hz";
  }
}

TEST(AttachmentModes, CoincidingPointsAndShiftedInversesAreRefused) {
  const Moved part;
  const auto twice = interface_at(part.model, {{"A", {0.3, 0.1, 0.02}, 0.0, xyz}, {"B", {0.3, 0.1, 0.02}, 0.0, xyz}});
  EXPECT_THROW((void)with_attachment_modes(part.modes(5), part.model.M, part.inverse.action(), twice),
               core::InputError);
  auto shifted = part.inverse.action();
  shifted.sigma = 1.0;
  EXPECT_THROW((void)with_attachment_modes(part.modes(5), part.model.M, shifted, part.place), core::NumericalError);
}

}  // namespace
}  // namespace thinwall::reduction::attachment_modes_test
