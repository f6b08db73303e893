// Tables of modes that were found with a mass on the structure, freed of it.

#include "robot/freed_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <string>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "robot/modal_table.hpp"
#include "tests/robot/modes_of_matrices.hpp"

namespace thinwall::robot::freed_table_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using tests::Matrices;
using tests::table_of;
using tests::two_points;

Eigen::MatrixXcd residue(const dynamics::ModalTableRow& row) {
  return row.right * row.left.transpose();
}

void expect_equal(const dynamics::ModalTable& found, const dynamics::ModalTable& truth) {
  ASSERT_EQ(found.rows.size(), truth.rows.size());
  for (std::size_t k = 0; k < truth.rows.size(); ++k) {
    EXPECT_NEAR(found.rows[k].frequency_hz / truth.rows[k].frequency_hz, 1.0, 1e-10);
    EXPECT_NEAR(found.rows[k].damping_ratio / truth.rows[k].damping_ratio, 1.0, 1e-10);
    const Eigen::MatrixXcd R = residue(found.rows[k]), exact = residue(truth.rows[k]);
    EXPECT_LT((R - exact).norm(), 1e-10 * exact.norm()) << k;
  }
}

/// The mass in the matrix comes off again, at either point, with and without reciprocity.
TEST(FreedTable, IsThatOfTheMatricesWithoutTheMass) {
  for (const double servo : {0.0, 1.0}) {
    const Matrices bare = two_points(servo);
    for (const double mass : {0.02, 0.5, 5.0}) {
      for (const int at : {0, 2}) {
        Matrices loaded = bare;
        loaded.M(at, at) += mass;
        loaded.M(at + 1, at + 1) += mass;
        expect_equal(without_point_mass(table_of(loaded), at == 0 ? "1" : "a", mass).table, table_of(bare));
      }
    }
  }
}

/// Of both points one after the other, in either order.
TEST(FreedTable, IsFreedOfSeveralMassesInAnyOrder) {
  const Matrices bare = two_points(1.0);
  Matrices loaded = bare;
  loaded.M += MatrixXd(Eigen::Vector4d(0.3, 0.3, 0.1, 0.1).asDiagonal());
  const dynamics::ModalTable with = table_of(loaded);
  expect_equal(without_point_mass(without_point_mass(with, "1", 0.3).table, "a", 0.1).table, table_of(bare));
  expect_equal(without_point_mass(without_point_mass(with, "a", 0.1).table, "1", 0.3).table, table_of(bare));
}

/// Of one mass m + M the share M/(m + M) stays: 1 − m φ², φ² = 1/(m + M).
TEST(FreedTable, TellsHowMuchOfTheInertiaStays) {
  const Matrices bare = two_points(0.0);
  Matrices loaded = bare;
  const double mass = 12.0;
  loaded.M(0, 0) += mass;
  loaded.M(1, 1) += mass;
  const FreedTable freed = without_point_mass(table_of(loaded), "1", mass);
  EXPECT_NEAR(freed.condition, (mass + 3.0) / 3.0, 1e-8);  // of x; of y (12 + 4)/4
}

/// A table with few modes has the receptance of its own sum, freed line by line.
TEST(FreedTable, HasTheReceptanceOfTheSumWithoutTheMass) {
  const Matrices bare = two_points(1.0);
  Matrices loaded = bare;
  loaded.M(0, 0) += 0.3;
  loaded.M(1, 1) += 0.3;
  dynamics::ModalTable with = table_of(loaded);
  with.rows.resize(2);
  const auto axis = dynamics::linear_axis(5.0, 150.0, 50);
  const auto G = dynamics::to_response(modal_model(with), axis),
             H = dynamics::to_response(modal_model(without_point_mass(with, "1", 0.3).table), axis);
  for (Index line = 0; line < axis.size(); ++line) {
    const Eigen::MatrixXcd &of = G.H[static_cast<std::size_t>(line)], &free = H.H[static_cast<std::size_t>(line)];
    const double omega = axis.omega_rad_s(line);
    Eigen::MatrixXcd kernel = Eigen::MatrixXcd::Identity(4, 4);
    kernel.leftCols(2) += omega * omega * 0.3 * of.leftCols(2);
    const Eigen::MatrixXcd exact = kernel.partialPivLu().solve(of);
    EXPECT_LT((free - exact).norm(), 1e-2 * exact.norm())
        << axis.hz(line);  // the sum's C B is not 0 but 2 % of its size
  }
}

TEST(FreedTable, RefusesAMassThatIsMoreThanAllThatMoves) {
  const dynamics::ModalTable table = table_of(two_points(0.0));
  const auto told = [&](const std::string& point, double mass) {
    try {
      (void)without_point_mass(table, point, mass);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(told("1", 3.5).find("3.5 kg is more than moves at \"1\""), std::string::npos) << told("1", 3.5);
  EXPECT_EQ(told("1", 2.9), "");
  EXPECT_NE(told("1", 0.0).find("above 0"), std::string::npos);
  EXPECT_NE(told("b", 0.1).find("\"b\""), std::string::npos) << told("b", 0.1);
}

}  // namespace
}  // namespace thinwall::robot::freed_table_test
