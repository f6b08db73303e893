// Components that are coupled and removed again, and the removal of an accelerometer's mass.

#include "coupling/decoupling.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "coupling/spatial.hpp"
#include "masses.hpp"
#include "tests/verification/coupling_routes/components.hpp"

namespace thinwall::coupling::decoupling_test {
namespace {

using Complex = std::complex<double>;
using dynamics::DofKind;
using dynamics::ResponseModel;
using testing::Damping;
const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
constexpr double rigid = std::numeric_limits<double>::infinity();

/// A0–A1 joined to B0–B1 by A1–B0, in some of six directions.
struct Pair {
  dynamics::FrequencyAxis axis = dynamics::logarithmic_axis(10.0, 2000.0, 150);
  ResponseModel A, B, assembly;

  Pair(double K, int directions, Damping damping, unsigned seed) {
    std::mt19937 random(seed);
    A = dynamics::direct_response(testing::random_turning_component({"A0", "A1"}, 3, damping, 2.0, random), axis);
    B = dynamics::direct_response(testing::random_turning_component({"B0", "B1"}, 4, damping, 5.0, random), axis);
    Contact contact{"A1", "B0", {}};
    for (int i = 0; i < directions; ++i) {
      const bool turns = i >= 3;
      const double k = turns ? K * testing::turning_length * testing::turning_length : K;
      contact.springs.push_back({Eigen::Vector3d::Unit(i % 3), k, K == rigid ? 0.0 : 1e-5 * k, 0.0,
                                 turns ? DofKind::rotation : DofKind::translation});
    }
    assembly = couple(A, B, {contact}).response;
  }
};

/// The rows and columns of two points of a table.
ResponseModel at(const ResponseModel& model, const std::vector<std::string>& points) {
  std::vector<int> rows;
  ResponseModel part{model.axis, {}, {}, {}};
  for (const std::string& point : points) {
    for (const int row : dynamics::rows_of_point(model.responses, point)) {
      rows.push_back(row);
      part.responses.push_back(model.responses[static_cast<std::size_t>(row)]);
    }
  }
  part.forces = part.responses;
  for (const auto& H : model.H) part.H.emplace_back(H(rows, rows));
  return part;
}

TEST(Decoupling, GivesBackWhatWasCoupled) {
  double worst = 0.0, condition = 0.0;
  for (const Damping damping : {Damping::light, Damping::heavy, Damping::structural}) {
    for (const double K : {1e5, 1e7, 1e9, rigid}) {
      for (unsigned seed = 1; seed <= 4; ++seed) {
        const Pair pair(K, 6, damping, seed);
        const CoupledResponse rest = decouple(pair.assembly, pair.A, {"A1"});
        const double difference = testing::difference_by_kind(pair.B, at(rest.response, {"B0", "B1"}));
        EXPECT_LT(difference, 1e-8) << "K " << K << ", seed " << seed;
        EXPECT_FALSE(rest.dropped.any());
        worst = std::max(worst, difference);
        condition = std::max(condition, rest.kernel_condition.maxCoeff());
        // the other one taken out
        const auto other = decouple(pair.assembly, pair.B, {"B0"});
        EXPECT_LT(testing::difference_by_kind(pair.A, at(other.response, {"A0", "A1"})), 1e-8) << K << ", " << seed;
      }
    }
  }
  std::cout << "couple, then decouple: " << worst << ", kernel's condition up to " << condition << '\n';
}

TEST(Decoupling, WhereFewerDirectionsAreJoinedTheOthersAreDroppedAndTheResultHolds) {
  for (const double K : {1e7, rigid}) {
    const Pair pair(K, 4, Damping::light, 9);
    const CoupledResponse rest = decouple(pair.assembly, pair.A, {"A1"});
    EXPECT_TRUE((rest.dropped.array() == 2).all());
    EXPECT_EQ(rest.status, KernelStatus::regularised);
    EXPECT_LT(testing::difference_by_kind(pair.B, at(rest.response, {"B0", "B1"})), 1e-8) << K;
    EXPECT_LT(rest.compatibility_residual.maxCoeff(), 1.0 + 1e-9);
  }
}

TEST(Decoupling, AnExtendedInterfaceHasTheRankOfTheTrueOne) {
  for (const double K : {1e7, rigid}) {
    const Pair pair(K, 6, Damping::light, 10);
    const CoupledResponse rest = decouple(pair.assembly, pair.A, {"A1", "A0"});
    EXPECT_TRUE((rest.dropped.array() == 6).all());
    EXPECT_LT(testing::difference_by_kind(pair.B, at(rest.response, {"B0", "B1"})), 1e-8) << K;
    EXPECT_THROW((void)decouple(pair.assembly, pair.A, {"A1", "A0"}, {}), core::NumericalError);
  }
}

TEST(Decoupling, WhereTheKnownComponentDoesNotMoveTheRestIsHeldAndThatIsSaid) {
  // A moves along n only and is joined rigidly in three directions: of B it shows what B does with its other two held
  const auto axis = dynamics::linear_axis(5.0, 600.0, 60);
  std::mt19937 random(3);
  const auto B =
      dynamics::direct_response(testing::random_component(8, {"B0", "B1"}, Damping::light, 3.0, random).model, axis);
  const Eigen::Vector3d n(0.48, 0.6, 0.64);
  const auto scalar = testing::response({2.0, 30.0, 4e6}, "A", axis);
  ResponseModel A{axis, dynamics::translations("A"), dynamics::translations("A"), {}};
  for (const auto& H : scalar.H) A.H.emplace_back(H(0, 0) * (n * n.transpose()).cast<Complex>());
  const auto assembly = couple(A, B, {{"A", "B0", {{x}, {y}, {z}}}}).response;
  const CoupledResponse rest = decouple(assembly, A, {"A"});
  EXPECT_EQ(rest.status, KernelStatus::regularised);
  EXPECT_TRUE((rest.dropped.array() == 2).all());
  Eigen::MatrixXd held(3, 2);  // orthogonal to n and to each other
  held << 0.8, -0.36, 0.0, 0.8, -0.6, -0.48;
  for (std::size_t line = 0; line < B.H.size(); ++line) {
    const Eigen::MatrixXcd& H = B.H[line];
    const Eigen::MatrixXcd H_0h = H.leftCols(3) * held, S = held.transpose() * H.topLeftCorner(3, 3) * held;
    const Eigen::MatrixXcd exact = H - H_0h * S.inverse() * (held.transpose() * H.topRows(3));
    const Eigen::MatrixXcd found = rest.response.H[line].bottomRightCorner(H.rows(), H.cols());
    EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-9 * H.cwiseAbs().maxCoeff());
  }
}

TEST(Decoupling, InverseRcsaGivesTheBaseWithItsJointAtAPointThatWasNotMeasured) {
  const Pair pair(1e7, 6, Damping::light, 12);  // A: the tool, tip A0, root A1; B: the base
  const ResponseModel tip = at(pair.assembly, {"A0"});
  const CoupledResponse base = decouple(tip, pair.A, {"A0"});
  EXPECT_EQ(base.response.responses.front().point, "A0");
  const ResponseModel root = at(base.response, {"A1"});
  const ResponseModel B = at(pair.B, {"B0"});
  double worst = 0.0;
  for (std::size_t line = 0; line < B.H.size(); ++line) {
    const double omega = pair.axis.omega_rad_s(static_cast<Eigen::Index>(line));
    Eigen::MatrixXcd exact = B.H[line];
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double k = i < 3 ? 1e7 : 1e7 * testing::turning_length * testing::turning_length;
      exact(i, i) += 1.0 / Complex(k, omega * 1e-5 * k);
    }
    // Lei 2022, Eq. 4, as it is printed
    const Eigen::MatrixXcd &H = pair.A.H[line], &G = tip.H[line];
    const Eigen::MatrixXcd printed =
        H.block(6, 0, 6, 6) * (H.block(0, 0, 6, 6) - G).inverse() * H.block(0, 6, 6, 6) - H.block(6, 6, 6, 6);
    const double size = exact.topLeftCorner(3, 3).cwiseAbs().maxCoeff();
    EXPECT_LT((printed - root.H[line]).topLeftCorner(3, 3).cwiseAbs().maxCoeff(), 1e-8 * size);
    worst = std::max(worst, (exact - root.H[line]).topLeftCorner(3, 3).cwiseAbs().maxCoeff() / size);
  }
  EXPECT_LT(worst, 1e-8);
  std::cout << "inverse RCSA: " << worst << '\n';
}

TEST(Decoupling, RefusesAnInterfaceThatIsNotThere) {
  const Pair pair(1e7, 3, Damping::heavy, 13);
  EXPECT_THROW((void)decouple(pair.assembly, pair.A, {}), core::InputError);
  EXPECT_THROW((void)decouple(pair.assembly, pair.A, {"A2"}), core::InputError);
  EXPECT_THROW((void)decouple(at(pair.assembly, {"B0"}), pair.A, {"A1"}), core::InputError);
  ResponseModel translations_only = between(pair.assembly, "A1", "A1");
  try {
    (void)decouple(translations_only, pair.A, {"A1"});
    FAIL() << "rotations that were not measured were taken for granted";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("needs A1.rx"), std::string::npos) << error.what();
  }
}

TEST(PointMass, OfOneMassIsTakenOffAndPutOn) {
  const auto axis = dynamics::linear_axis(0.0, 400.0, 101);
  const double m = 0.02;
  const auto bare = testing::response({0.8, 3.0, 1.4e6}, "P", axis);
  const auto loaded = testing::response({0.8 + m, 3.0, 1.4e6}, "P", axis);
  const CoupledResponse rest = remove_point_mass(loaded, "P", m);
  const auto again = remove_point_mass(bare, "P", -m).response;
  for (std::size_t line = 0; line < bare.H.size(); ++line) {
    const double omega = axis.omega_rad_s(static_cast<Eigen::Index>(line));
    const Complex accelerance = -omega * omega * loaded.H[line](0, 0);
    EXPECT_LT(std::abs(rest.response.H[line](0, 0) / bare.H[line](0, 0) - 1.0), 1e-11);
    EXPECT_LT(std::abs(again.H[line](0, 0) / loaded.H[line](0, 0) - 1.0), 1e-11);
    const Complex corrected = accelerance / (1.0 - m * accelerance);
    EXPECT_LE(std::abs(-omega * omega * rest.response.H[line](0, 0) - corrected), 1e-11 * std::abs(corrected));
  }
}

TEST(PointMass, LoadsAllDirectionsAndAllOtherPoints) {
  std::mt19937 random(14);
  const auto axis = dynamics::logarithmic_axis(10.0, 2000.0, 100);
  dynamics::SpatialModel model = testing::random_turning_component({"P", "Q"}, 4, Damping::light, 1.0, random);
  const auto bare = dynamics::direct_response(model, axis);
  model.M.topLeftCorner(3, 3) += 0.05 * Eigen::Matrix3d::Identity();
  const auto loaded = dynamics::direct_response(model, axis);
  EXPECT_GT(testing::difference_by_kind(bare, loaded), 0.01);
  EXPECT_LT(testing::difference_by_kind(bare, remove_point_mass(loaded, "P", 0.05).response), 1e-9);
}

TEST(PointMass, IsRefusedWhereItCannotBeMeant) {
  const auto axis = dynamics::linear_axis(1.0, 10.0, 5);
  auto model = testing::response({0.8, 3.0, 1.4e6}, "P", axis);
  EXPECT_THROW((void)remove_point_mass(model, "P", 0.0), core::InputError);
  EXPECT_THROW((void)remove_point_mass(model, "P", std::nan("")), core::InputError);
  EXPECT_THROW((void)remove_point_mass(model, "Q", 0.1), core::InputError);
  model.forces[0].point = "Q";  // P was not excited
  EXPECT_THROW((void)remove_point_mass(model, "P", 0.1), core::InputError);
}

}  // namespace
}  // namespace thinwall::coupling::decoupling_test
