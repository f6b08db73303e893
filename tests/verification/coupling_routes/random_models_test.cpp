// Spatial coupling against receptance coupling over random stable components. Up to the two component models the routes
// share nothing: one sums modes and solves in the joint's space, the other assembles and factors the whole.

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>

#include "components.hpp"
#include "core/dense_factorisations.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"

namespace thinwall::coupling::random_models_test {
namespace {

using testing::Component;
using testing::Damping;
using Complex = std::complex<double>;
constexpr double rigid = std::numeric_limits<double>::infinity();

struct Assembly {
  Component part, robot;
  std::vector<Contact> contacts;
};

/// Contacts P-R and, if the components are large enough, Q-S, each in up to three random directions.
Assembly random_assembly(int part_size, int robot_size, Damping part_damping, Damping robot_damping, unsigned seed) {
  std::mt19937 random(seed);
  Assembly assembly{testing::random_component(part_size, {"P", "Q"}, part_damping, 0.5, random),
                    testing::random_component(robot_size, {"R", "S"}, robot_damping, 20.0, random),
                    {{"P", "R", {}}}};
  const bool two_points = part_size >= 8 && robot_size >= 6;
  if (two_points) assembly.contacts.push_back({"Q", "S", {}});
  const int directions = std::min({3, part_size - 1, robot_size});
  for (Contact& contact : assembly.contacts) {
    for (const auto& direction : testing::random_directions(directions, random)) contact.springs.push_back({direction});
  }
  return assembly;
}

std::vector<Contact> with_stiffness(std::vector<Contact> contacts, double K) {
  for (Contact& contact : contacts) {
    for (ContactSpring& spring : contact.springs) {
      spring.stiffness = K;
      if (K == rigid) continue;
      spring.damping = 1e-5 * K;
      spring.loss_factor = 0.02;
    }
  }
  return contacts;
}

/// Exactly on the resonances of both components and of the assembly, and between them.
dynamics::FrequencyAxis axis_of(const Assembly& assembly, const std::vector<Contact>& contacts) {
  std::vector<double> hz{0.5, 5.0, 5000.0};
  for (const Component* component : {&assembly.part, &assembly.robot}) {
    for (const double omega : component->omega) {
      hz.push_back(omega / (2.0 * std::numbers::pi));
      hz.push_back(1.013 * hz.back());
    }
  }
  const dynamics::SpatialModel coupled = couple(assembly.part.model, assembly.robot.model, contacts);
  for (const double omega : dynamics::undamped_modes(coupled).omega_rad_s) {
    hz.push_back(omega / (2.0 * std::numbers::pi));
  }
  std::sort(hz.begin(), hz.end());
  hz.erase(std::unique(hz.begin(), hz.end()), hz.end());
  return {Eigen::Map<const Eigen::VectorXd>(hz.data(), static_cast<Eigen::Index>(hz.size()))};
}

/// Σ φ φᵀ / (ω_r² (1 + iη) − ω²): the exact response of a component whose structural damping is ηK.
dynamics::ResponseModel hysteretic_response(const Component& component, const dynamics::FrequencyAxis& axis) {
  std::vector<int> rows;
  dynamics::DofTable dofs;
  for (int i = 0; i < static_cast<int>(component.model.dofs.size()); ++i) {
    if (component.model.dofs[static_cast<std::size_t>(i)].kind == dynamics::DofKind::modal) continue;
    rows.push_back(i);
    dofs.push_back(component.model.dofs[static_cast<std::size_t>(i)]);
  }
  const Eigen::MatrixXcd Phi = component.Phi(rows, Eigen::all).cast<Complex>();
  dynamics::ResponseModel response{axis, dofs, dofs, {}};
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double w = axis.omega_rad_s(line);
    const Eigen::VectorXcd weight =
        (component.omega.array().square() * Complex(1.0, component.loss_factor) - w * w).inverse().matrix();
    response.H.emplace_back(Phi * weight.asDiagonal() * Phi.transpose());
  }
  return response;
}

dynamics::ResponseModel modal_response(const Component& component, const dynamics::FrequencyAxis& axis) {
  if (component.loss_factor > 0.0) return hysteretic_response(component, axis);
  return dynamics::to_response(dynamics::to_modal(component.model), axis);
}

double asymmetry(const dynamics::ResponseModel& model) {
  double largest = 0.0;
  for (const auto& G : model.H) {
    largest = std::max(largest, (G - G.transpose()).cwiseAbs().maxCoeff() / G.cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Largest Im G_ii / |G_ii|; negative for a structure that dissipates at every point.
double largest_loss(const dynamics::ResponseModel& model) {
  double largest = -1.0;
  for (const auto& G : model.H) {
    largest = std::max(largest, (G.diagonal().imag().array() / G.diagonal().cwiseAbs().array()).maxCoeff());
  }
  return largest;
}

struct Comparison {
  double difference = 0.0;
  double spatial_asymmetry = 0.0, receptance_asymmetry = 0.0, kernel_allows = 0.0;
  double loss = -1.0;
};

Comparison compare(const Assembly& assembly, double K) {
  const auto contacts = with_stiffness(assembly.contacts, K);
  const auto axis = axis_of(assembly, contacts);
  const auto spatial = direct_response(couple(assembly.part.model, assembly.robot.model, contacts), axis);
  const CoupledResponse coupled =
      couple(modal_response(assembly.part, axis), modal_response(assembly.robot, axis), contacts);
  const auto& receptance = coupled.response;
  // G_ij and G_ji, summed in different orders, each err by up to m ε κ through a kernel of m directions and of Skeel's
  // condition κ (Higham 2002, section 7.2): two contacts of an 8 + 6 model reach κ = 6e5.
  Eigen::Index directions = 0;
  for (const Contact& contact : contacts) directions += static_cast<Eigen::Index>(contact.springs.size());
  const double allowed = 2.0 * static_cast<double>(directions) * std::numeric_limits<double>::epsilon() *
                         coupled.kernel_condition.maxCoeff();
  return {route_difference(spatial, receptance).max_relative, asymmetry(spatial), asymmetry(receptance), allowed,
          std::max(largest_loss(spatial), largest_loss(receptance))};
}

struct Sizes {
  int part, robot;
};

class RandomModels : public ::testing::TestWithParam<Sizes> {};

TEST_P(RandomModels, RoutesAgreeWithEveryDampingAndStiffness) {
  const auto [part_size, robot_size] = GetParam();
  unsigned seed = 1000U * static_cast<unsigned>(part_size) + static_cast<unsigned>(robot_size);
  Comparison worst, stiffest;
  for (const Damping part : {Damping::light, Damping::heavy, Damping::dashpot, Damping::structural}) {
    for (const Damping robot : {Damping::light, Damping::heavy, Damping::structural}) {
      const Assembly assembly = random_assembly(part_size, robot_size, part, robot, ++seed);
      for (const double K : {1e3, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e12, rigid}) {
        const Comparison comparison = compare(assembly, K);
        const double bar = K == 1e12 ? 1e-8 : 1e-9;
        EXPECT_LT(comparison.difference, bar) << "K " << K << ", seed " << seed;
        EXPECT_LT(comparison.spatial_asymmetry, 1e-10) << "K " << K << ", seed " << seed;
        EXPECT_LT(comparison.receptance_asymmetry, std::max(1e-10, comparison.kernel_allows))
            << "K " << K << ", seed " << seed;
        EXPECT_LE(comparison.loss, 0.0) << "K " << K << ", seed " << seed;
        Comparison& record = K == 1e12 ? stiffest : worst;
        record.difference = std::max(record.difference, comparison.difference);
        record.spatial_asymmetry = std::max(record.spatial_asymmetry, comparison.spatial_asymmetry);
        record.receptance_asymmetry = std::max(record.receptance_asymmetry, comparison.receptance_asymmetry);
        record.loss = std::max(record.loss, comparison.loss);
      }
    }
  }
  std::cout << "sizes " << part_size << " + " << robot_size << ": largest difference " << worst.difference
            << ", with 1e12 N/m " << stiffest.difference << ", asymmetry " << worst.spatial_asymmetry << " and "
            << worst.receptance_asymmetry << ", largest Im/|G| " << worst.loss << '\n';
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomModels,
                         ::testing::Values(Sizes{2, 1}, Sizes{3, 2}, Sizes{6, 1}, Sizes{8, 6}, Sizes{15, 3},
                                           Sizes{24, 12}, Sizes{40, 1}, Sizes{40, 20}),
                         [](const auto& sizes) {
                           return std::to_string(sizes.param.part) + "And" + std::to_string(sizes.param.robot) + "Dofs";
                         });

TEST(RandomModels, AMeasuredRobotGivesWhatItsModelGives) {
  for (const double K : {1e5, 1e8, rigid}) {
    const Assembly assembly = random_assembly(24, 12, Damping::light, Damping::heavy, 77);
    const auto contacts = with_stiffness(assembly.contacts, K);
    const auto axis = axis_of(assembly, contacts);
    const auto robot = modal_response(assembly.robot, axis);
    const auto mixed = direct_response(assembly.part.model, robot, contacts, axis);
    const auto spatial = direct_response(couple(assembly.part.model, assembly.robot.model, contacts), axis);
    EXPECT_LT(route_difference(between(spatial, "P", "Q"), between(mixed, "P", "Q")).max_relative, 1e-9) << K;
    EXPECT_LT(route_difference(between(spatial, "Q", "Q"), between(mixed, "Q", "Q")).max_relative, 1e-9) << K;
  }
}

TEST(RandomModels, ARobotOfRankOneHoldsThreeRigidDirections) {
  const Assembly assembly = random_assembly(12, 4, Damping::light, Damping::light, 78);
  Component robot = assembly.robot;
  for (int i : {0, 1, 2}) robot.model.dofs[static_cast<std::size_t>(i)].kind = dynamics::DofKind::modal;
  for (int i : {0, 1, 2}) robot.model.dofs[static_cast<std::size_t>(i)].point = "amplitude " + std::to_string(i);
  robot.model.dofs[3] = {"R", Eigen::Vector3d(0.48, 0.6, 0.64), dynamics::DofKind::translation};
  const auto contacts = with_stiffness(assembly.contacts, rigid);
  ASSERT_EQ(contacts[0].springs.size(), 3U);
  const dynamics::FrequencyAxis axis = dynamics::logarithmic_axis(5.0, 2000.0, 300);
  const auto spatial = direct_response(couple(assembly.part.model, robot.model, contacts), axis);
  const auto part = modal_response(assembly.part, axis), tip = modal_response(robot, axis);
  EXPECT_LT(route_difference(spatial, couple(part, tip, contacts).response).max_relative, 1e-9);
  const auto mixed = direct_response(assembly.part.model, tip, contacts, axis);
  EXPECT_LT(route_difference(between(spatial, "P", "P"), between(mixed, "P", "P")).max_relative, 1e-9);
}

TEST(RandomModels, NearlyParallelDirectionsCostNoMoreThanTheKernelConditionSays) {
  Assembly assembly = random_assembly(9, 3, Damping::light, Damping::light, 81);
  double previous = 0.0;
  for (const double angle : {1.0, 1e-1, 1e-2, 1e-3}) {
    const Eigen::Vector3d n(0.6, 0.48, 0.64), m = Eigen::Vector3d(0.8, -0.36, -0.48).normalized();
    assembly.contacts = {{"P", "R", {{n}, {std::cos(angle) * n + std::sin(angle) * m}}}};
    const auto axis = axis_of(assembly, assembly.contacts);
    const auto spatial = direct_response(couple(assembly.part.model, assembly.robot.model, assembly.contacts), axis);
    const CoupledResponse receptance =
        couple(modal_response(assembly.part, axis), modal_response(assembly.robot, axis), assembly.contacts);
    const double condition = receptance.kernel_condition.maxCoeff();
    // light components on a resonance are themselves good to ε κ(K) / 2ζ = 1e-13 or better
    EXPECT_LT(route_difference(spatial, receptance.response).max_relative, 1e-13 * condition) << angle;
    EXPECT_GT(condition, previous);
    EXPECT_EQ(receptance.status == KernelStatus::ill_conditioned, condition > 1e8);
    previous = condition;
  }
  EXPECT_GT(previous, 1e6);
}

TEST(RandomModels, ModesOfTheAssemblySumToItsDirectResponse) {
  for (const double K : {1e6, rigid}) {
    const Assembly assembly = random_assembly(15, 3, Damping::light, Damping::heavy, 79);
    auto contacts = with_stiffness(assembly.contacts, K);
    for (Contact& contact : contacts) {
      for (ContactSpring& spring : contact.springs) spring.loss_factor = 0.0;  // poles exist for viscous damping only
    }
    const dynamics::SpatialModel coupled = couple(assembly.part.model, assembly.robot.model, contacts);
    const auto axis = axis_of(assembly, contacts);
    const auto direct = direct_response(coupled, axis);
    const auto modal = dynamics::to_response(to_modal(coupled), axis);
    EXPECT_LT(route_difference(direct, modal).max_relative, 1e-9) << K;
  }
}

/// Eq. 18 as it is printed: k_u added to the components' own entries, in numbers of type Real.
template <typename Real>
dynamics::ResponseModel assembled_as_printed(const Assembly& assembly, const std::vector<Contact>& contacts,
                                             const dynamics::FrequencyAxis& axis) {
  using Matrix = Eigen::Matrix<std::complex<Real>, Eigen::Dynamic, Eigen::Dynamic>;
  const auto& part = assembly.part.model;
  const auto& robot = assembly.robot.model;
  const Eigen::Index n = part.size() + robot.size();
  dynamics::DofTable dofs = part.dofs;
  dofs.insert(dofs.end(), robot.dofs.begin(), robot.dofs.end());
  dynamics::ResponseModel response{axis, dofs, dofs, {}};
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const Real w = axis.omega_rad_s(line);
    const std::complex<Real> iw(0, w), w2(w * w, 0);
    Matrix Z = Matrix::Zero(n, n);
    const auto stiffness = [&](const dynamics::SpatialModel& model) {
      return Matrix(model.K.cast<std::complex<Real>>() + iw * model.C.cast<std::complex<Real>>() -
                    w2 * model.M.cast<std::complex<Real>>());
    };
    Z.topLeftCorner(part.size(), part.size()) = stiffness(part);
    Z.bottomRightCorner(robot.size(), robot.size()) = stiffness(robot);
    for (const Contact& contact : contacts) {
      for (const ContactSpring& spring : contact.springs) {
        Eigen::VectorXd b(n);
        b << dynamics::displacement_row(part.dofs, contact.point_a, spring.direction),
            -dynamics::displacement_row(robot.dofs, contact.point_b, spring.direction);
        const auto b_real = b.cast<std::complex<Real>>();
        const Real K = spring.stiffness;
        Z += std::complex<Real>(K, K * spring.loss_factor + w * spring.damping) * Matrix(b_real * b_real.transpose());
      }
    }
    response.H.emplace_back(Z.partialPivLu().inverse().template cast<Complex>());
  }
  return response;
}

TEST(StiffSprings, DigitsAreLostByAddingThemToTheComponentsAndOnlyByThat) {
  // A sum k_part + K keeps k_part to ε K. So Eq. 18 as printed loses digits in proportion to K, and in longer numbers
  // it does not; with the springs' openings as coordinates nothing is added to K, and the receptance route adds 1/K to
  // a receptance: neither loses anything at any K.
  const Assembly assembly = random_assembly(7, 3, Damping::light, Damping::light, 80);
  std::vector<double> printed;
  for (const double K : {1e11, 1e12, 1e13}) {
    const auto contacts = with_stiffness(assembly.contacts, K);
    const auto axis = axis_of(assembly, contacts);
    const auto difference_at_P = [&, reference = assembled_as_printed<long double>(assembly, contacts, axis)](
                                     const dynamics::ResponseModel& model) {
      return route_difference(reference, model, "P", "P").max_relative;
    };
    const auto openings = direct_response(couple(assembly.part.model, assembly.robot.model, contacts), axis);
    const auto receptance =
        couple(modal_response(assembly.part, axis), modal_response(assembly.robot, axis), contacts).response;
    printed.push_back(difference_at_P(assembled_as_printed<double>(assembly, contacts, axis)));
    const double own = difference_at_P(openings), by_receptance = difference_at_P(receptance);
    std::cout << "K " << K << ": Eq. 18 as printed " << printed.back() << ", with openings " << own << ", receptance "
              << by_receptance << '\n';
    EXPECT_LT(own, 1e-10) << K;
    EXPECT_LT(by_receptance, 1e-10) << K;
  }
  // a hundred times the stiffness, a hundred times the error, give or take ten for the chance in single roundings
  EXPECT_GT(printed[2] / printed[0], 10.0);
  EXPECT_LT(printed[2] / printed[0], 1000.0);
  EXPECT_GT(printed[2], 1e-9);
}

}  // namespace
}  // namespace thinwall::coupling::random_models_test
