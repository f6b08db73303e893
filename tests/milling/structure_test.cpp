// The structure at the cut, as poles and as real first-order equations.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "core/error.hpp"
#include "milling/structure/contact_state.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::structure_test {
namespace {

using testing::modal_model;

const std::vector<testing::Mode> three_modes{{212.0, 0.01, 0.5, Eigen::Vector3d(1.0, 0.2, 0.1)},
                                             {567.0, 0.02, 0.3, Eigen::Vector3d(0.8, -0.3, 0.0)},
                                             {1800.0, 0.01, 0.2, Eigen::Vector3d(0.5, 0.9, 0.4)}};

TEST(RelativeStructure, ReceptanceIsThatOfTheOscillator) {
  const RelativeStructure s =
      relative_structure(modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d(0.6, 0.8, 0.0)}}), "P");
  const double w0 = 2.0 * std::numbers::pi * 100.0;
  const double w = 700.0;
  const std::complex<double> h = 1.0 / (2.0 * std::complex<double>(w0 * w0 - w * w, 2.0 * 0.03 * w0 * w));
  EXPECT_LT(std::abs(receptance(s, w)(0, 1) - 0.48 * h), 1e-12 * std::abs(h));
}

TEST(RelativeStructure, PartAndToolReceptancesAdd) {
  const RelativeStructure part = relative_structure(modal_model(three_modes), "P");
  const RelativeStructure tool = relative_structure(modal_model({three_modes[1]}), "P");
  const Eigen::Matrix3cd G = receptance(part, 3000.0) + receptance(tool, 3000.0);
  EXPECT_LT((receptance(sum(part, tool), 3000.0) - G).norm(), 1e-14 * G.norm());
}

TEST(RelativeStructure, SaysWhatShareOfTheComplianceIsLeftOut) {
  dynamics::ModalModel model = modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d::UnitX()}});
  EXPECT_EQ(residual_share(relative_structure(model, "P")), 0.0);
  const double static_compliance = 1.0 / (2.0 * std::pow(2.0 * std::numbers::pi * 100.0, 2));
  model.residual = Eigen::Matrix3d::Zero();
  model.residual(0, 0) = static_compliance / 3.0;
  EXPECT_NEAR(residual_share(relative_structure(model, "P")), 0.25, 1e-12);
}

TEST(RelativeStructure, RefusesWhatDoesNotDecayOrIsNotPaired) {
  dynamics::ModalModel model = modal_model(three_modes);
  EXPECT_THROW((void)relative_structure(model, "Q"), core::InputError);
  dynamics::ModalModel undamped = model;
  undamped.poles(0).real(0.0);
  EXPECT_THROW((void)relative_structure(undamped, "P"), core::InputError);
  dynamics::ModalModel unpaired = model;
  unpaired.poles(1) = unpaired.poles(3);
  EXPECT_THROW((void)relative_structure(unpaired, "P"), core::InputError);
  dynamics::ModalModel broken = model;
  broken.right(0, 0) = std::nan("");
  EXPECT_THROW((void)relative_structure(broken, "P"), core::DataError);
}

TEST(ContactState, ReproducesTheInPlaneReceptance) {
  const RelativeStructure s = relative_structure(modal_model(three_modes), "P");
  const ToolFrame frame{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const ContactState state = contact_state(s, frame);
  const std::complex<double> i_omega(0.0, 2500.0);
  const Eigen::MatrixXcd resolvent =
      (i_omega * Eigen::MatrixXcd::Identity(state.size(), state.size()) - state_matrix(state)).inverse();
  const Eigen::MatrixXcd found = state.in_plane * state.C * resolvent * state.B;
  const Eigen::MatrixXcd expected =
      frame.rotation().leftCols<2>().transpose() * receptance(s, 2500.0) * frame.rotation();
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
}

TEST(ContactState, FollowsOnlyTheDirectionsThatMove) {
  const RelativeStructure s = relative_structure(modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d(1, 1, 0)}}), "P");
  EXPECT_EQ(contact_state(s, {}).directions(), 1);
  const RelativeStructure axial = relative_structure(modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d::UnitZ()}}), "P");
  EXPECT_THROW((void)contact_state(axial, {}), core::InputError);
}

}  // namespace
}  // namespace thinwall::milling::structure_test
