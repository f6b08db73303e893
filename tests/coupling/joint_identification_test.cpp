// A contact is identified from the responses that it produces, without noise and with it.

#include "coupling/joint_identification.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <limits>

#include "core/error.hpp"
#include "coupling/receptance.hpp"
#include "masses.hpp"
#include "tests/verification/coupling_routes/components.hpp"

namespace thinwall::coupling::joint_identification_test {
namespace {

using Complex = std::complex<double>;
using dynamics::DofKind;
using dynamics::ResponseModel;
using testing::Damping;
const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(), z = Eigen::Vector3d::UnitZ();

/// A part with P and Q, a robot with R, and the assembly.
struct Experiment {
  dynamics::FrequencyAxis axis;
  ResponseModel part, robot, coupled;

  Experiment(const Contact& contact, const dynamics::FrequencyAxis& lines, unsigned seed, bool turning = false)
      : axis(lines) {
    std::mt19937 random(seed);
    const auto response = [&](const std::vector<std::string>& points, int size, double mass) {
      dynamics::SpatialModel model = turning
                                         ? testing::random_turning_component(points, 4, Damping::light, mass, random)
                                         : testing::random_component(size, points, Damping::light, mass, random).model;
      model.C *= 10.0;  // 1 %
      return dynamics::direct_response(model, axis);
    };
    part = response({"P", "Q"}, 10, 0.5);
    robot = response({"R"}, 5, 20.0);
    coupled = couple(part, robot, {contact}).response;
  }
};

Contact spring(double K, double C, double eta) {
  return {"P", "R", {{x, K, C, eta}}};
}

const Contact along_x{"P", "R", {{x}}};

TEST(JointIdentification, WithoutNoiseGivesTheSpringBack) {
  const auto axis = dynamics::linear_axis(20.0, 1200.0, 300);
  double worst = 0.0;
  for (const double K : {1e4, 1e6, 1e8}) {
    const double C = 2e-5 * K, eta = 0.08;
    const Experiment viscous(spring(K, C, 0.0), axis, 1), both(spring(K, C, eta), axis, 2);
    for (const char* response : {"", "Q"}) {
      for (const char* force : {"", "Q"}) {
        IdentificationOptions options{.response_point = response, .force_point = force};
        const IdentifiedJoint v = identify_joint(viscous.part, viscous.robot, viscous.coupled, along_x, options);
        options.structural = true;
        const IdentifiedJoint b = identify_joint(both.part, both.robot, both.coupled, along_x, options);
        for (const auto& [found, exact] : {std::pair{v.joint.K(0, 0), K}, std::pair{v.joint.C(0, 0), C},
                                           std::pair{b.joint.K(0, 0), K}, std::pair{b.joint.C(0, 0), C},
                                           std::pair{b.joint.D(0, 0), eta * K}, std::pair{b.loss_factor(0, 0), eta}}) {
          EXPECT_NEAR(found / exact, 1.0, 1e-8) << K << " " << response << force;
          worst = std::max(worst, std::abs(found / exact - 1.0));
        }
        EXPECT_EQ(v.status, IdentificationStatus::identified);
        EXPECT_LT(v.chi_squared, 1e-10);
      }
    }
  }
  std::cout << "spring without noise: largest relative error " << worst << '\n';
}

TEST(JointIdentification, WithoutNoiseGivesMatricesOverDisplacementsAndTurnsBack) {
  const auto axis = dynamics::linear_axis(20.0, 1200.0, 150);
  Contact contact{"P", "R", {{x}, {y}, {z, std::numeric_limits<double>::infinity(), 0, 0, DofKind::rotation}}};
  const Contact sought = contact;
  Eigen::Matrix3d K;
  K << 3e6, 4e5, 2e4, 4e5, 1e6, -1e4, 2e4, -1e4, 4e3;
  contact.matrices = {K, 3e-5 * K, 0.05 * K};
  const Experiment experiment(contact, axis, 3, true);
  const IdentifiedJoint found =
      identify_joint(experiment.part, experiment.robot, experiment.coupled, sought, {.structural = true});
  const Eigen::ArrayXXd size = (K.diagonal() * K.diagonal().transpose()).cwiseSqrt();
  EXPECT_LT(((found.joint.K - K).array() / size).abs().maxCoeff(), 1e-8);
  EXPECT_LT(((found.joint.C - contact.matrices.C).array() / (3e-5 * size)).abs().maxCoeff(), 1e-8);
  EXPECT_LT(((found.joint.D - contact.matrices.D).array() / (0.05 * size)).abs().maxCoeff(), 1e-8);
  std::cout << "matrices without noise: largest relative error of K "
            << ((found.joint.K - K).array() / size).abs().maxCoeff() << '\n';
}

TEST(JointIdentification, OneLineHasItsClosedForm) {
  const auto axis = dynamics::linear_axis(20.0, 1200.0, 60);
  const Experiment e(spring(1e6, 30.0, 0.0), axis, 4);
  const auto found = identify_joint(e.part, e.robot, e.coupled, along_x);
  for (std::size_t line = 0; line < found.Z.size(); ++line) {
    const Complex P = e.part.H[line](0, 0), R = e.robot.H[line](0, 0), G = e.coupled.H[line](0, 0);
    const Complex Z = found.Z[line](0, 0);
    EXPECT_LT(std::abs(Z * (P * P / (P - G) - P - R) - 1.0), 1e-9);
    // Eq. 17 for one direction, by hand
    const Complex exact(1e6, axis.omega_rad_s(static_cast<Eigen::Index>(line)) * 30.0);
    const double X = std::abs(P / (P - G)), X_1 = std::abs(G / (P - G));
    const double by_hand = 0.01 * std::norm(exact) *
                           std::sqrt(std::pow(X_1, 4) * std::norm(P) + std::pow(X, 4) * std::norm(G) + std::norm(R));
    EXPECT_NEAR(found.spread[line](0, 0) / by_hand, 1.0, 1e-6);
  }
}

/// Independent circular noise, `relative` of every value.
ResponseModel noisy(ResponseModel model, double relative, std::mt19937& random) {
  std::normal_distribution<double> normal(0.0, relative / std::sqrt(2.0));
  for (Eigen::MatrixXcd& H : model.H) {
    H = H.unaryExpr([&](const Complex& value) { return value * (1.0 + Complex(normal(random), normal(random))); });
  }
  return model;
}

/// The share of intervals that contain the truth, and the deviation of the mean in its own standard deviations.
struct Trials {
  int runs = 0, inside = 0;
  double sum = 0.0, squares = 0.0;

  void add(double found, double half_width, double exact) {
    ++runs;
    inside += std::abs(found - exact) <= half_width ? 1 : 0;
    sum += found / exact - 1.0;
    squares += std::pow(found / exact - 1.0, 2);
  }
  [[nodiscard]] double share() const { return static_cast<double>(inside) / runs; }
  [[nodiscard]] double deviation() const { return std::sqrt(squares / runs); }
  [[nodiscard]] double bias() const { return sum / runs; }
  [[nodiscard]] double bias_in_deviations() const { return std::abs(bias()) / (deviation() / std::sqrt(runs)); }
};

std::ostream& operator<<(std::ostream& out, const Trials& trials) {
  return out << 100.0 * trials.share() << " % inside, relative deviation " << trials.deviation() << ", bias "
             << trials.bias() << " (" << trials.bias_in_deviations() << " deviations of the mean)";
}

TEST(JointIdentification, WithNoiseTheTruthLiesInTheIntervalAsOftenAsItSays) {
  const auto axis = dynamics::linear_axis(20.0, 1200.0, 100);
  for (const double K : {1e5, 1e6, 1e7}) {
    const double C = 5e-5 * K;
    const Experiment e(spring(K, C, 0.0), axis, 5);
    Trials stiffness, damping, at_Q;
    double chi_squared = 0.0;
    for (unsigned seed = 1; seed <= 300; ++seed) {
      std::mt19937 random(seed);
      const auto part = noisy(e.part, 0.01, random), robot = noisy(e.robot, 0.01, random),
                 coupled = noisy(e.coupled, 0.01, random);
      const auto found = identify_joint(part, robot, coupled, along_x);
      ASSERT_EQ(found.status, IdentificationStatus::identified);
      stiffness.add(found.joint.K(0, 0), found.half_width.K(0, 0), K);
      damping.add(found.joint.C(0, 0), found.half_width.C(0, 0), C);
      chi_squared += found.chi_squared / 300.0;
      const auto from_Q = identify_joint(part, robot, coupled, along_x, {.response_point = "Q", .force_point = "Q"});
      at_Q.add(from_Q.joint.K(0, 0), from_Q.half_width.K(0, 0), K);
    }
    std::cout << "K " << K << " with 1 %: K " << stiffness << "\n  C " << damping << "\n  K from Q " << at_Q
              << "\n  chi squared " << chi_squared << '\n';
    for (const Trials& trials : {stiffness, damping, at_Q}) {
      EXPECT_GE(trials.share(), 0.90) << K;
      EXPECT_LE(trials.share(), 0.99) << K;
      EXPECT_LT(trials.bias_in_deviations(), 4.0) << K;
    }
    EXPECT_NEAR(chi_squared, 1.0, 0.15) << K;
  }
}

TEST(JointIdentification, WithNoiseALossFactorLiesInItsInterval) {
  const auto axis = dynamics::linear_axis(20.0, 1200.0, 200);
  const double K = 1e6, eta = 0.1;
  const Experiment e(spring(K, 0.0, eta), axis, 6);
  Trials loss;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const auto part = noisy(e.part, 0.01, random), robot = noisy(e.robot, 0.01, random),
               coupled = noisy(e.coupled, 0.01, random);
    const auto found = identify_joint(part, robot, coupled, along_x, {.viscous = false, .structural = true});
    loss.add(found.loss_factor(0, 0), found.loss_factor_half_width(0, 0), eta);
  }
  std::cout << "loss factor with 1 %: " << loss << '\n';
  EXPECT_GE(loss.share(), 0.90);
  EXPECT_LE(loss.share(), 0.99);
}

TEST(JointIdentification, LargerResidualsThanTheNoiseSaysWidenTheInterval) {
  const auto axis = dynamics::linear_axis(20.0, 1200.0, 200);
  const Experiment e(spring(1e6, 50.0, 0.0), axis, 7);
  std::mt19937 random(8);
  const auto part = noisy(e.part, 0.003, random), robot = noisy(e.robot, 0.003, random),
             coupled = noisy(e.coupled, 0.003, random);
  const auto noise = [](double level) {
    const Eigen::VectorXd one = Eigen::VectorXd::Constant(1, level);
    return RelativeNoise{one, one, one};
  };
  const auto right = identify_joint(part, robot, coupled, along_x, {.noise = noise(0.003)});
  const auto hopeful = identify_joint(part, robot, coupled, along_x, {.noise = noise(0.001)});
  EXPECT_NEAR(right.chi_squared, 1.0, 0.3);
  EXPECT_NEAR(hopeful.chi_squared / right.chi_squared, 9.0, 0.5);
  EXPECT_NEAR(hopeful.half_width.K(0, 0) / right.half_width.K(0, 0), std::min(1.0, std::sqrt(right.chi_squared)), 0.01);
}

TEST(JointIdentification, LinesWithoutInformationAreLeftOutAndCounted) {
  const auto axis = dynamics::linear_axis(20.0, 1200.0, 200);
  std::mt19937 random(9);
  const Experiment soft(spring(1e6, 50.0, 0.0), axis, 7);
  // half the band drowned in noise
  IdentificationOptions options;
  options.noise.coupled = Eigen::VectorXd::Constant(200, 0.01);
  options.noise.coupled.tail(100).setConstant(1e6);
  const auto half = identify_joint(soft.part, soft.robot, soft.coupled, along_x, options);
  EXPECT_EQ(half.status, IdentificationStatus::identified);
  EXPECT_GT(half.lines_used(0, 0), 20);
  EXPECT_LE(half.lines_used(0, 0), 100);
  EXPECT_NEAR(half.joint.K(0, 0) / 1e6, 1.0, 1e-8);
  // a joint that is far stiffer than both sides: only its compliance's absence can be seen
  const Experiment stiff(spring(1e14, 0.0, 0.0), axis, 7);
  const auto found = identify_joint(noisy(stiff.part, 0.01, random), noisy(stiff.robot, 0.01, random),
                                    noisy(stiff.coupled, 0.01, random), along_x);
  EXPECT_EQ(found.status, IdentificationStatus::no_information);
  EXPECT_TRUE(std::isnan(found.joint.K(0, 0)));
  // no contact at all: H - G is zero
  const auto none = identify_joint(soft.part, soft.robot, soft.part, along_x);
  EXPECT_EQ(none.status, IdentificationStatus::no_information);
}

TEST(JointIdentification, NoiseFollowsFromTheCoherence) {
  Eigen::VectorXd coherence(3);
  coherence << 1.0, 0.99, 0.5;
  const Eigen::VectorXd noise = noise_from_coherence(coherence, 25);
  EXPECT_EQ(noise(0), 1e-6);
  EXPECT_NEAR(noise(1), std::sqrt(0.01 / (0.99 * 25.0)), 1e-15);
  EXPECT_NEAR(noise(2), 0.2, 1e-15);
  EXPECT_THROW((void)noise_from_coherence(coherence, 0), core::InputError);
  coherence(1) = 1.1;
  EXPECT_THROW((void)noise_from_coherence(coherence, 25), core::InputError);
  coherence(1) = std::nan("");
  EXPECT_THROW((void)noise_from_coherence(coherence, 25), core::InputError);
}

TEST(JointIdentification, RefusesWhatCannotBeMeant) {
  const Experiment e(spring(1e6, 50.0, 0.0), dynamics::linear_axis(20.0, 1200.0, 20), 7);
  const Experiment other(spring(1e6, 50.0, 0.0), dynamics::linear_axis(2000.0, 3000.0, 20), 7);
  const auto refused = [&](const Experiment& with, const Contact& contact, const IdentificationOptions& options) {
    try {
      (void)identify_joint(e.part, with.robot, e.coupled, contact, options);
    } catch (const core::InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto says = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << part << " in: " << message;
  };
  says(refused(other, along_x, {}), "they do not overlap");
  says(refused(e, {"P", "X", {{x}}}, {}), "\"X\"");
  says(refused(e, along_x, {.response_point = "Z"}), "\"Z\"");
  says(refused(e, along_x, {.largest_spread = 1.5}), "largest_spread is 1.5");
  IdentificationOptions options;
  options.noise.robot = Eigen::VectorXd::Constant(7, 0.0);
  says(refused(e, along_x, options), "has 7 values for 20 lines");
  says(refused(e, along_x, options), "is not positive");
}

}  // namespace
}  // namespace thinwall::coupling::joint_identification_test
