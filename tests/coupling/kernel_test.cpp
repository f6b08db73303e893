// The reports of a coupling on its kernel: the error that the result inherits, and the parts that a regularisation
// leaves out.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "coupling/receptance.hpp"
#include "masses.hpp"
#include "tests/verification/coupling_routes/components.hpp"

namespace thinwall::coupling::kernel_test {
namespace {

using Complex = std::complex<double>;
using dynamics::ResponseModel;
const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();
constexpr double rigid = std::numeric_limits<double>::infinity();
const dynamics::FrequencyAxis axis = dynamics::linear_axis(1.0, 400.0, 100);

TEST(InheritedError, OfTwoMassesJoinedRigidlyIsTheKernelsCondition) {
  // δ(H_P H_R / (H_P + H_R)) = G² (δH_P / H_P² + δH_R / H_R²), so that |δG / G| ≤ ε (|H_P| + |H_R|) / |H_P + H_R|
  const auto part = testing::response({0.8, 3.0, 1.4e6}, "P", axis);
  const auto robot = testing::response({51.2, 373.0, 1.7e6}, "R", axis);
  const auto coupled = couple(part, robot, {{"P", "R", {{x}}}}, {.component_error = 0.01});
  const Eigen::VectorXd error = relative_error(coupled, "P.x", "P.x");
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    EXPECT_NEAR(error(line) / (0.01 * coupled.kernel_condition(line)), 1.0, 1e-10) << axis.hz(line);
  }
  EXPECT_THROW((void)relative_error(couple(part, robot, {{"P", "R", {{x}}}}), "P.x", "P.x"), core::InputError);
}

/// Three components that turn, joined in some directions of every kind.
struct Chain {
  std::vector<ResponseModel> components;
  std::vector<Contact> contacts;
  dynamics::FrequencyAxis axis = dynamics::logarithmic_axis(20.0, 1500.0, 40);

  Chain() {
    std::mt19937 random(5);
    for (const auto& [a, b] : {std::pair{"A", "B"}, std::pair{"C", "D"}, std::pair{"E", "F"}}) {
      components.push_back(dynamics::direct_response(
          testing::random_turning_component({a, b}, 2, testing::Damping::light, 3.0, random), axis));
    }
    const ContactSpring turning{z, 1e4, 0.1, 0.0, dynamics::DofKind::rotation};
    contacts = {{"B", "C", {{x}, {y, 1e6, 10.0, 0.01}, turning}}, {"D", "E", {{x, 1e7}, {z}}}};
  }
};

TEST(InheritedError, BoundsEveryEntryAndIsReached) {
  const Chain chain;
  const double epsilon = 1e-7;
  const auto coupled = couple(chain.components, chain.contacts, {.component_error = epsilon});
  const auto entries = static_cast<Eigen::Index>(coupled.response.responses.size());
  std::mt19937 random(6);
  std::uniform_real_distribution<double> phase(-3.14159, 3.14159);
  Eigen::MatrixXd largest = Eigen::MatrixXd::Zero(entries, entries);
  for (int trial = 0; trial < 50; ++trial) {
    auto disturbed = chain.components;
    for (ResponseModel& component : disturbed) {
      for (Eigen::MatrixXcd& H : component.H) {
        H = H.unaryExpr([&](const Complex& value) { return value * (1.0 + std::polar(epsilon, phase(random))); });
      }
    }
    const auto other = couple(disturbed, chain.contacts);
    for (std::size_t line = 0; line < coupled.error.size(); ++line) {
      const Eigen::MatrixXd difference = (other.response.H[line] - coupled.response.H[line]).cwiseAbs();
      const Eigen::MatrixXd share = difference.cwiseQuotient(coupled.error[line]);
      EXPECT_LT(share.maxCoeff(), 1.0 + 1e-3);
      largest = largest.cwiseMax(share);
    }
  }
  // chance never aligns all phases of 432 entries, but a bound that were far from sharp would show here
  EXPECT_GT(largest.maxCoeff(), 0.5);
  EXPECT_GT(largest.minCoeff(), 0.02);
}

TEST(InheritedError, IsReachedWhereAllErrorsFallTogether) {
  // δH_ij = ε |H_ij| times the phase that turns L_pi δH_ij R_jq to the real axis, by finite differences of G_pq
  const Chain chain;
  const double epsilon = 1e-7;
  const std::size_t line = 17;
  const auto only_line = [&](std::vector<ResponseModel> all) {
    for (ResponseModel& component : all) {
      component.H = {component.H[line]};
      component.axis.hz = chain.axis.hz.segment(static_cast<Eigen::Index>(line), 1).eval();
    }
    return all;
  };
  const auto components = only_line(chain.components);
  const auto coupled = couple(components, chain.contacts, {.component_error = epsilon});
  const Eigen::Index p = 1, q = 20;
  auto aligned = components;
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (Eigen::Index i = 0; i < components[c].H[0].rows(); ++i) {
      for (Eigen::Index j = 0; j < components[c].H[0].cols(); ++j) {
        auto one = components;
        const double size = std::abs(one[c].H[0](i, j));
        one[c].H[0](i, j) += epsilon * size;
        const Complex slope = couple(one, chain.contacts).response.H[0](p, q) - coupled.response.H[0](p, q);
        if (std::abs(slope) > 0.0) aligned[c].H[0](i, j) += epsilon * size * std::conj(slope) / std::abs(slope);
      }
    }
  }
  const Complex moved = couple(aligned, chain.contacts).response.H[0](p, q) - coupled.response.H[0](p, q);
  EXPECT_NEAR(std::abs(moved) / coupled.error[0](p, q), 1.0, 1e-3);
}

TEST(Regularisation, TruncationSolvesADirectionThatIsNamedTwice) {
  const auto part = testing::response({0.8, 3.0, 1.4e6}, "P", axis);
  const auto robot = testing::response({51.2, 373.0, 1.7e6}, "R", axis);
  const auto once = couple(part, robot, {{"P", "R", {{x}}}});
  const std::vector<Contact> twice{{"P", "R", {{x}, {x}}}};
  EXPECT_THROW((void)couple(part, robot, twice), core::NumericalError);
  const auto truncated = couple(part, robot, twice, {.regularisation = Regularisation::truncated});
  EXPECT_EQ(truncated.status, KernelStatus::regularised);
  EXPECT_TRUE((truncated.dropped.array() == 1).all());
  EXPECT_LT(truncated.compatibility_residual.maxCoeff(), 1e-12);  // nothing is left open
  for (std::size_t line = 0; line < once.response.H.size(); ++line) {
    EXPECT_LT((truncated.response.H[line] - once.response.H[line]).norm(), 1e-12 * once.response.H[line].norm());
  }
  EXPECT_FALSE(once.dropped.any());
  EXPECT_EQ(once.status, KernelStatus::well_conditioned);
}

TEST(Regularisation, WhatIsTruncatedStaysOpenAndIsSaid) {
  // along y both are a thousand times as stiff: a threshold of a hundredth leaves y open and joins x
  const std::vector<testing::Mass> soft_and_stiff{{1.0, 5.0, 1e6}, {1.0, 5.0, 1e9}};
  const auto low = dynamics::linear_axis(1.0, 50.0, 20);
  const auto part = dynamics::direct_response(testing::model(soft_and_stiff, "P"), low);
  const auto robot = dynamics::direct_response(testing::model(soft_and_stiff, "R"), low);
  const auto coupled =
      couple(part, robot, {{"P", "R", {{x}, {y}}}}, {.regularisation = Regularisation::truncated, .threshold = 0.01});
  const auto along_x = couple(part, robot, {{"P", "R", {{x}}}});
  EXPECT_EQ(coupled.status, KernelStatus::regularised);
  for (Eigen::Index line = 0; line < low.size(); ++line) {
    const auto i = static_cast<std::size_t>(line);
    EXPECT_EQ(coupled.dropped(line), 1);
    EXPECT_NEAR(coupled.compatibility_residual(line), 1.0, 1e-12);  // a force along y: the whole gap stays
    EXPECT_LT((coupled.response.H[i] - along_x.response.H[i]).norm(), 1e-12 * along_x.response.H[i].norm());
  }
}

TEST(Regularisation, TikhonovHasItsClosedFormForOneDirection) {
  // S⁺ = S⁻¹ / (1 + t²), the gap t² / (1 + t²)
  const double t = 0.1;
  const auto part = testing::response({0.8, 3.0, 1.4e6}, "P", axis);
  const auto robot = testing::response({51.2, 373.0, 1.7e6}, "R", axis);
  const auto coupled =
      couple(part, robot, {{"P", "R", {{x}}}}, {.regularisation = Regularisation::tikhonov, .threshold = t});
  for (std::size_t line = 0; line < part.H.size(); ++line) {
    const Complex P = part.H[line](0, 0), R = robot.H[line](0, 0);
    const Complex exact = P - P * P / ((P + R) * (1.0 + t * t));
    EXPECT_LT(std::abs(coupled.response.H[line](0, 0) - exact), 1e-12 * std::abs(P));
    EXPECT_NEAR(coupled.compatibility_residual(static_cast<Eigen::Index>(line)), t * t / (1.0 + t * t), 1e-12);
  }
}

TEST(Regularisation, AWellConditionedKernelIsLeftAsItIs) {
  const Chain chain;
  const auto plain = couple(chain.components, chain.contacts);
  const auto truncated = couple(chain.components, chain.contacts, {.regularisation = Regularisation::truncated});
  EXPECT_FALSE(truncated.dropped.any());
  EXPECT_EQ(truncated.status, KernelStatus::well_conditioned);
  EXPECT_LT(testing::difference_by_kind(plain.response, truncated.response), 1e-10);
  EXPECT_LT(truncated.compatibility_residual.maxCoeff(), 1e-10);
}

TEST(Kernel, ARowOfZerosIsSingularWhereverItStands) {
  for (Eigen::Index zero = 0; zero < 3; ++zero) {
    Eigen::MatrixXcd S = Eigen::Matrix3cd::Random() + 3.0 * Eigen::Matrix3cd::Identity();
    S.row(zero).setZero();
    S.col(zero).setZero();
    Kernel kernel(Regularisation::none, 0.5);
    EXPECT_TRUE(std::isinf(kernel.solve(S, S.cwiseAbs(), Eigen::Matrix3cd::Identity()).condition)) << zero;
  }
}

TEST(Regularisation, FaultyOptionsAreAllReportedAtOnce) {
  const CouplingOptions faulty{.length = 0.0, .threshold = 1.0, .component_error = -1.0};
  try {
    require_valid(faulty);
    FAIL() << "faulty options were accepted";
  } catch (const core::InputError& error) {
    const std::string message = error.what();
    for (const char* part : {"rotations (m) is 0", "singular values is 1", "components is -1"}) {
      EXPECT_NE(message.find(part), std::string::npos) << part << " in " << message;
    }
  }
  EXPECT_THROW(require_valid(CouplingOptions{.length = std::nan("")}), core::InputError);
}

}  // namespace
}  // namespace thinwall::coupling::kernel_test
