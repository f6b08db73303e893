// Both routes over chains and rings of two to five random components that also turn, some of them with tips of too low
// a rank.

#include <gtest/gtest.h>

#include <iostream>
#include <limits>

#include "components.hpp"
#include "coupling/receptance.hpp"
#include "coupling/spatial.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::coupling::many_components_test {
namespace {

using dynamics::DofKind;
using dynamics::ResponseModel;
using dynamics::SpatialModel;
using testing::Damping;
constexpr double rigid = std::numeric_limits<double>::infinity();

struct Assembly {
  std::vector<SpatialModel> components;
  std::vector<Contact> contacts;
};

std::string point(int component, char side) {
  return std::string(1, static_cast<char>('A' + component)) + side;
}

/// Up to three translations and three rotations, oblique, of one stiffness (a rotation's at 50 mm).
std::vector<ContactSpring> random_springs(int translations, int rotations, double K, std::mt19937& random) {
  std::vector<ContactSpring> springs;
  const auto add = [&](int count, DofKind kind, double stiffness) {
    for (const auto& direction : testing::random_directions(count, random)) {
      springs.push_back({direction, stiffness, K == rigid ? 0.0 : 1e-5 * stiffness, K == rigid ? 0.0 : 0.02, kind});
    }
  };
  add(translations, DofKind::translation, K);
  if (rotations > 0) add(rotations, DofKind::rotation, K * testing::turning_length * testing::turning_length);
  return springs;
}

/// A0 –A1 B0–B1 C0–…: every second component has a tip of rank four. Three components or more are closed to a ring by
/// one direction.
Assembly random_assembly(int count, double K, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> some(1, 3);
  Assembly assembly;
  for (int c = 0; c < count; ++c) {
    const std::vector<std::string> points{point(c, '0'), point(c, '1')};
    const Damping damping = std::array{Damping::light, Damping::heavy, Damping::structural}[(seed + c) % 3U];
    const double mass = c % 2 == 0 ? 0.5 : 20.0;
    assembly.components.push_back(c % 2 == 0
                                      ? testing::random_turning_component(points, some(random), damping, mass, random)
                                      : testing::random_rank_deficient_component(points, 4, damping, mass, random));
    if (c > 0) {
      // rigid: no more than both sides can follow
      const int rotations = K == rigid && c + 1 < count ? 1 : some(random) - (K == rigid ? 1 : 0);
      assembly.contacts.push_back(
          {point(c - 1, '1'), point(c, '0'), random_springs(K == rigid ? 2 : some(random), rotations, K, random)});
    }
  }
  if (count > 2) {
    assembly.contacts.push_back({point(0, '0'), point(count - 1, '1'), random_springs(1, 0, 1e6, random)});
  }
  return assembly;
}

std::vector<ResponseModel> responses(const Assembly& assembly, const dynamics::FrequencyAxis& axis) {
  std::vector<ResponseModel> all;
  for (const SpatialModel& component : assembly.components) all.push_back(dynamics::direct_response(component, axis));
  return all;
}

/// The assembly's own resonances and some lines between.
dynamics::FrequencyAxis axis_of(const SpatialModel& coupled) {
  std::vector<double> hz{0.5, 5.0, 77.7, 1234.5, 5000.0};
  for (const double omega : dynamics::undamped_modes(coupled).omega_rad_s) {
    if (omega < 1e5) hz.push_back(omega / (2.0 * std::numbers::pi));
  }
  std::sort(hz.begin(), hz.end());
  return {Eigen::Map<const Eigen::VectorXd>(hz.data(), static_cast<Eigen::Index>(hz.size()))};
}

class ManyComponents : public ::testing::TestWithParam<int> {};

TEST_P(ManyComponents, RoutesAgree) {
  double worst = 0.0, condition = 0.0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    for (const double K : {1e3, 1e5, 1e7, 1e9, rigid}) {
      const Assembly assembly = random_assembly(GetParam(), K, 100U * static_cast<unsigned>(GetParam()) + seed);
      const SpatialModel coupled = couple(assembly.components, assembly.contacts);
      const auto axis = axis_of(coupled);
      const auto spatial = dynamics::direct_response(coupled, axis);
      const CoupledResponse receptance = couple(responses(assembly, axis), assembly.contacts);
      const double difference = testing::difference_by_kind(spatial, receptance.response);
      EXPECT_LT(difference, 1e-9) << "K " << K << ", seed " << seed;
      worst = std::max(worst, difference);
      condition = std::max(condition, receptance.kernel_condition.maxCoeff());
    }
  }
  std::cout << GetParam() << " components: routes differ by " << worst << ", kernel's condition up to " << condition
            << '\n';
}

INSTANTIATE_TEST_SUITE_P(Count, ManyComponents, ::testing::Values(2, 3, 4, 5));

TEST(Assemblies, ResultsDoNotDependOnTheLengthThatScalesRotations) {
  for (const double K : {1e6, rigid}) {
    const Assembly assembly = random_assembly(3, K, 7);
    const SpatialModel reference = couple(assembly.components, assembly.contacts);
    const auto axis = axis_of(reference);
    const auto H = responses(assembly, axis);
    const CoupledResponse G = couple(H, assembly.contacts);
    for (const double length : {1e-3, 1.0, 30.0}) {
      const CoupledResponse other = couple(H, assembly.contacts, {.length = length});
      EXPECT_LT(testing::difference_by_kind(G.response, other.response), 1e-10) << K << ", " << length;
      EXPECT_LT(((other.kernel_condition - G.kernel_condition).array() / G.kernel_condition.array()).abs().maxCoeff(),
                1e-6);
      const auto spatial = dynamics::direct_response(couple(assembly.components, assembly.contacts, length), axis);
      EXPECT_LT(testing::difference_by_kind(G.response, spatial), 1e-9) << K << ", " << length;
    }
  }
}

TEST(Assemblies, TheOrderOfTheComponentsDoesNotMatter) {
  const Assembly assembly = random_assembly(4, 1e7, 11);
  const auto axis = dynamics::logarithmic_axis(5.0, 2000.0, 60);
  std::vector<ResponseModel> H = responses(assembly, axis);
  const auto G = couple(H, assembly.contacts, {.points = {"A0", "C1"}}).response;
  std::reverse(H.begin(), H.end());
  const auto back = couple(H, assembly.contacts, {.points = {"A0", "C1"}}).response;
  for (const char* a : {"A0", "C1"}) {
    for (const char* b : {"A0", "C1"}) {
      EXPECT_LT(testing::difference_by_kind(between(G, a, b), between(back, a, b)), 1e-10) << a << b;
    }
  }
}

/// Σ over the directions of a contact as a joint's matrices, with directions that act on each other.
TEST(Assemblies, RoutesAgreeForJointsWhoseDirectionsActOnEachOther) {
  double worst = 0.0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    for (const double K : {1e5, 1e8, 1e11}) {
      Assembly assembly = random_assembly(3, K, 50 + seed);
      std::mt19937 random(seed);
      for (Contact& contact : assembly.contacts) {
        const auto n = static_cast<Eigen::Index>(contact.springs.size());
        Eigen::VectorXd unit = Eigen::VectorXd::Ones(n);
        for (Eigen::Index i = 0; i < n; ++i) {
          ContactSpring& spring = contact.springs[static_cast<std::size_t>(i)];
          if (spring.kind == DofKind::rotation) unit(i) = testing::turning_length;
          spring = {spring.direction, rigid, 0.0, 0.0, spring.kind};
        }
        const Eigen::MatrixXd A = testing::random_matrix(n, n, random);
        const Eigen::MatrixXd S = A * A.transpose() + Eigen::MatrixXd::Identity(n, n);
        contact.matrices.K = K * unit.asDiagonal() * S * unit.asDiagonal();
        contact.matrices.C = 1e-5 * contact.matrices.K;
        contact.matrices.D = 0.02 * contact.matrices.K;
      }
      const SpatialModel coupled = couple(assembly.components, assembly.contacts);
      const auto axis = axis_of(coupled);
      const auto spatial = dynamics::direct_response(coupled, axis);
      const auto receptance = couple(responses(assembly, axis), assembly.contacts).response;
      worst = std::max(worst, testing::difference_by_kind(spatial, receptance));
      EXPECT_LT(testing::difference_by_kind(spatial, receptance), 1e-9) << "K " << K << ", seed " << seed;
    }
  }
  std::cout << "joints with matrices: routes differ by " << worst << '\n';
}

}  // namespace
}  // namespace thinwall::coupling::many_components_test
