#include "robot/modal_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "robot/one_mode.hpp"

namespace thinwall::robot::modal_table_test {
namespace {

using dynamics::ModalTable;
using dynamics::ModalTableRow;
using Eigen::Vector3d;
using Complex = std::complex<double>;

const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();

Eigen::VectorXcd entries(std::initializer_list<Complex> values) {
  Eigen::VectorXcd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

/// Points "1" and "a" along x and y; a second mode measured elsewhere.
ModalTable two_modes(double place_of_first, double place_of_second) {
  const auto translation = dynamics::DofKind::translation;
  const auto row = [](const char* mode, double hz, double zeta, double place) {
    return ModalTableRow{mode,
                         hz,
                         zeta,
                         1e-7 * entries({{19.0, -8.0}, {-2.0, 5.0}, {17.9, -8.6}, {-2.3, 5.4}}),
                         entries({{1.5, -1.1}, {0.5, 0.7}, {0.2, -1.8}, {1.0, 0.0}}),
                         Eigen::Vector4d(0.0, 0.0, place, place)};
  };
  return {{{"1", x, translation}, {"1", y, translation}, {"a", x, translation}, {"a", y, translation}},
          {row("3", 15.0, 0.02, place_of_first), row("6", 840.0, 0.1, place_of_second)}};
}

// m x'' + c x' + k x = f has λ and the residue 1/(2 i m ω_d): R L of its row.
TEST(ModalTable, OfOneMassIsThatMass) {
  const OneMode mass = one_mode(29.0, 0.05, 1.7e6, x);
  const double damped = 2.0 * std::numbers::pi * 29.0 * std::sqrt(1.0 - 0.05 * 0.05);
  const Complex residue = 1.0 / Complex(0.0, 2.0 * mass.mass * damped);
  const ModalTable table{{{"R", x, dynamics::DofKind::translation}},
                         {{"1", 29.0, 0.05, entries({residue / 3.0}), entries({3.0}), Eigen::VectorXd::Zero(1)}}};
  const auto axis = dynamics::linear_axis(0.0, 60.0, 61);
  const auto found = dynamics::entry(dynamics::to_response(modal_model(table), axis), "R.x", "R.x");
  const auto expected = dynamics::entry(dynamics::direct_response(spatial_model({mass}, "R"), axis), "R.x", "R.x");
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-13 * expected.cwiseAbs().maxCoeff());
}

TEST(ModalTable, WithOnePointAtTwoPlacesIsRefusedUnlessAsked) {
  const ModalTable mixed = two_modes(0.0334, 0.020);
  try {
    (void)modal_model(mixed);
    FAIL() << "two points under one name were taken for one";
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* words : {"point \"a\"", "33.4 mm in the modes 3", "20 mm in the modes 6", "take the tip alone"})
      EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  }
  EXPECT_EQ(modal_model(mixed, PointPlaces::may_differ).poles.size(), 4);
  EXPECT_EQ(modal_model(two_modes(0.02, 0.02)).poles.size(), 4);
  EXPECT_EQ(modal_model(at_point(mixed, "1")).dofs.size(), 2U);
  const ModalTable low = with_point_at(mixed, "a", 0.0334);
  ASSERT_EQ(low.rows.size(), 1U);
  EXPECT_EQ(low.rows[0].mode, "3");
  EXPECT_NO_THROW((void)modal_model(low));
  EXPECT_THROW((void)with_point_at(mixed, "a", 0.03), core::InputError);
  dynamics::ModalTable untold = mixed;
  for (dynamics::ModalTableRow& row : untold.rows) row.place_m.setConstant(std::nan(""));
  EXPECT_THROW((void)modal_model(untold), core::InputError) << "nobody tells where its points lay";
  EXPECT_THROW((void)at_point(mixed, "b"), core::InputError);
}

TEST(ModalTable, WithoutCrossTermsTheDirectOnesStayAsTheyAre) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(1.0, 200.0, 50);
  const dynamics::ModalModel model = modal_model(at_point(two_modes(0.02, 0.02), "1"));
  const auto all = dynamics::to_response(model, axis), direct = dynamics::to_response(without_cross_terms(model), axis);
  for (std::size_t line = 0; line < all.H.size(); ++line) {
    EXPECT_LT((direct.H[line].diagonal() - all.H[line].diagonal()).norm(), 1e-14 * all.H[line].norm());
    EXPECT_EQ(direct.H[line](0, 1), 0.0);
    EXPECT_NE(all.H[line](0, 1), 0.0);
  }
}

TEST(ModalTable, OfTheTipIsPartOfTheWhole) {
  const ModalTable table = two_modes(0.02, 0.02);
  const auto axis = dynamics::linear_axis(1.0, 1000.0, 40);
  const auto all = dynamics::to_response(modal_model(table), axis);
  const auto tip = dynamics::to_response(modal_model(at_point(table, "1")), axis);
  for (std::size_t line = 0; line < tip.H.size(); ++line)
    EXPECT_LT((tip.H[line] - all.H[line].topLeftCorner<2, 2>()).norm(), 1e-14 * tip.H[line].norm());
}

// The finite differences of Lei, Hou & Ding 2022, A.1-A.12, with S one for all modes; the second difference is the
// consistent one. About y a point up the tool moves along x, about x against y.
TEST(ModalTable, RotationsAreTheFiniteDifferencesOfBothPoints) {
  const double S = 0.02;
  const ModalTable table = two_modes(S, S);
  const auto axis = dynamics::linear_axis(1.0, 1000.0, 40);
  const auto both = dynamics::to_response(modal_model(table), axis);
  const auto tip = dynamics::to_response(modal_model(with_rotations(table, "1", "a", z)), axis);
  ASSERT_EQ(tip.responses.size(), 4U);
  EXPECT_EQ(dynamics::name(tip.responses[2]), "1.ry");
  EXPECT_EQ(dynamics::name(tip.responses[3]), "1.rx");
  const auto H = [&](const char* row, const char* column) { return dynamics::entry(both, row, column); };
  const auto expect = [&](const char* row, const char* column, const Eigen::VectorXcd& expected) {
    EXPECT_LT((dynamics::entry(tip, row, column) - expected).norm(), 1e-12 * expected.norm()) << row << " " << column;
  };
  expect("1.x", "1.y", H("1.x", "1.y"));
  expect("1.ry", "1.x", (H("a.x", "1.x") - H("1.x", "1.x")) / S);
  expect("1.x", "1.ry", (H("1.x", "a.x") - H("1.x", "1.x")) / S);
  expect("1.rx", "1.x", (H("1.y", "1.x") - H("a.y", "1.x")) / S);
  expect("1.ry", "1.ry", (H("1.x", "1.x") - H("a.x", "1.x") - H("1.x", "a.x") + H("a.x", "a.x")) / (S * S));
  expect("1.rx", "1.ry", -(H("1.y", "1.x") - H("a.y", "1.x") - H("1.y", "a.x") + H("a.y", "a.x")) / (S * S));
}

/// Rigid body of the tool: its points' motions follow from the tip's, whatever the distance of the sensor. A table made
/// from a symmetric model with two distances must give back that model's rotations.
TEST(ModalTable, RotationsComeRightWhereTheSensorMoved) {
  const auto row = [](const char* mode, double hz, Complex u, Complex v, Complex rx, Complex ry, double S) {
    // Up the tool along −x: r × S up, of rotations about y and z.
    const Eigen::VectorXcd at = entries({u, v, u + S * rx, v + S * ry});
    return ModalTableRow{mode, hz, 0.03, at, 2.0 * at, Eigen::Vector4d(0.01, 0.01, 0.01 + S, 0.01 + S)};
  };
  const auto translation = dynamics::DofKind::translation;
  const Vector3d up = -x;
  // up × z = y, up × y = −z
  const ModalTable table{{{"t", z, translation}, {"t", y, translation}, {"b", z, translation}, {"b", y, translation}},
                         {row("1", 10.0, {1, 2}, {0.3, -1}, {4, 1}, {2, 2}, 0.0334),
                          row("2", 800.0, {-1, 1}, {2, 0.1}, {-3, 0.5}, {1, -7}, 0.02)}};
  const ModalTable tip = with_rotations(table, "t", "b", up);
  EXPECT_EQ(dynamics::name(tip.dofs[2]), "t.ry");
  EXPECT_EQ(dynamics::name(tip.dofs[3]), "t.rz");
  const Complex about_y[] = {{4, 1}, {-3, 0.5}}, against_z[] = {{2, 2}, {1, -7}};
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(std::abs(tip.rows[k].right(2) - about_y[k]), 1e-12);
    EXPECT_LT(std::abs(tip.rows[k].left(2) - 2.0 * about_y[k]), 1e-12);
    EXPECT_LT(std::abs(tip.rows[k].right(3) + against_z[k]), 1e-12);
  }
  EXPECT_NO_THROW((void)modal_model(tip));
  EXPECT_THROW((void)with_rotations(table, "b", "t", up), core::InputError) << "the wrong way round";
  EXPECT_THROW((void)with_rotations(table, "t", "b", z), core::InputError) << "z is not across the tool";
  EXPECT_THROW((void)with_rotations(table, "t", "b", 2.0 * up), core::InputError);
  EXPECT_THROW((void)with_rotations(at_point(table, "t"), "t", "b", up), core::InputError);
}

TEST(ModalTable, ThatCannotBeIsRefusedRowByRow) {
  ModalTable table = two_modes(0.02, 0.02);
  table.rows[0].frequency_hz = -15.0;
  table.rows[0].damping_ratio = 2.0;
  table.rows[1].right(2) = {std::nan(""), 0.0};
  try {
    (void)modal_model(table);
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* words : {"mode 3 has the frequency", "mode 3 has the damping ratio 2", "mode 6 holds a number"})
      EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  }
  ModalTable shorter = two_modes(0.02, 0.02);
  shorter.rows[1].left.conservativeResize(3);
  EXPECT_THROW((void)modal_model(shorter), core::InputError);
  EXPECT_THROW((void)modal_model(ModalTable{}), core::InputError);
  ModalTable undamped = two_modes(0.02, 0.02);
  undamped.rows[0].damping_ratio = 0.0;
  EXPECT_THROW((void)modal_model(undamped), core::InputError);
}

}  // namespace
}  // namespace thinwall::robot::modal_table_test
