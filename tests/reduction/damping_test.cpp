#include "reduction/damping.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "reduction/identification.hpp"

namespace thinwall::reduction::damping_test {
namespace {

/// A chain of unequal masses and springs, tied to the ground at one end or free.
dynamics::SpatialModel chain(int n, bool free) {
  dynamics::SpatialModel model{
      Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), {}, {}};
  for (int i = 0; i < n; ++i) {
    model.M(i, i) = 1.0 + 0.3 * i;
    const double k = 1e6 * (1.0 + 0.17 * i * i);
    if (i > 0) {
      model.K(i, i) += k;
      model.K(i - 1, i - 1) += k;
      model.K(i, i - 1) -= k;
      model.K(i - 1, i) -= k;
    } else if (!free) {
      model.K(0, 0) += k;
    }
    model.dofs.push_back({"P" + std::to_string(i), Eigen::Vector3d::UnitX(), dynamics::DofKind::translation});
  }
  return model;
}

std::vector<dynamics::ModeSummary> modes_of(const dynamics::SpatialModel& model) {
  const dynamics::ModalModel modal = dynamics::to_modal(model);
  std::vector<dynamics::ModeSummary> result;
  for (const int k : dynamics::oscillating_modes(modal)) result.push_back(dynamics::summarise(modal.poles(k)));
  return result;
}

TEST(ModalDamping, ComesBackExactlyAsTheDampingOfEachMode) {
  const dynamics::SpatialModel model = chain(6, false);
  const Eigen::VectorXd omega = dynamics::undamped_modes(model).omega_rad_s;
  const std::vector<double> ratios{0.01, 0.003, 0.2};
  const auto found = modes_of(with_modal_damping(model, ratios, 0.05));
  ASSERT_EQ(found.size(), 6U);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(found[k].damping_ratio, k < 3 ? ratios[k] : 0.05, 1e-13) << "mode " << k + 1;
    EXPECT_NEAR(found[k].frequency_hz * 2 * std::numbers::pi / omega(static_cast<Eigen::Index>(k)), 1.0, 1e-13);
  }
}

TEST(ModalDamping, LeavesRigidMotionsUndampedAndTheModesWhatTheyAre) {
  const dynamics::SpatialModel model = chain(5, true);
  const dynamics::SpatialModel damped = with_modal_damping(model, {}, 0.02);
  EXPECT_LT((damped.C * Eigen::VectorXd::Ones(5)).norm(), 1e-9 * damped.C.norm()) << "a rigid motion meets no force";
  EXPECT_EQ((damped.C - damped.C.transpose()).norm(), 0.0);
  const Eigen::MatrixXd Phi = dynamics::undamped_modes(model).Phi;
  const Eigen::MatrixXd D = Phi.transpose() * damped.C * Phi;
  EXPECT_LT((D - Eigen::MatrixXd(D.diagonal().asDiagonal())).norm(), 1e-12 * D.norm());
}

TEST(RayleighDamping, GivesHalfOfAlphaOverOmegaPlusBetaOmega) {
  const dynamics::SpatialModel model = chain(6, false);
  const Eigen::VectorXd omega = dynamics::undamped_modes(model).omega_rad_s;
  const double alpha = 4.0;
  const double beta = 1e-5;
  const auto found = modes_of(with_rayleigh_damping(model, alpha, beta));
  for (std::size_t k = 0; k < 6; ++k) {
    const double w = omega(static_cast<Eigen::Index>(k));
    EXPECT_NEAR(found[k].damping_ratio, 0.5 * (alpha / w + beta * w), 1e-12);
  }
}

TEST(StructuralDamping, MakesTheStiffnessComplex) {
  const dynamics::SpatialModel model = chain(4, false);
  const double eta = 0.03;
  const auto damped =
      dynamics::direct_response(with_structural_damping(model, eta), {Eigen::VectorXd::Constant(1, 1e-6)});
  const auto undamped = dynamics::direct_response(model, {Eigen::VectorXd::Constant(1, 1e-6)});
  // Near ω = 0: H = K⁻¹ / (1 + iη).
  const Eigen::MatrixXcd expected = undamped.H[0] / std::complex<double>(1.0, eta);
  EXPECT_LT((damped.H[0] - expected).norm(), 1e-12 * expected.norm());
  EXPECT_LT(damped.H[0](0, 0).imag(), 0.0);
}

TEST(Damping, RefusesWhatNoStructureHas) {
  const dynamics::SpatialModel model = chain(3, false);
  EXPECT_THROW((void)with_modal_damping(model, {0.01, 1.0}, 0.0), core::InputError);
  EXPECT_THROW((void)with_modal_damping(model, {}, -0.01), core::InputError);
  EXPECT_THROW((void)with_modal_damping(model, {std::nan("")}, 0.0), core::InputError);
  EXPECT_THROW((void)with_rayleigh_damping(model, -1.0, 0.0), core::InputError);
  EXPECT_THROW((void)with_rayleigh_damping(model, 0.0, std::nan("")), core::InputError);
  EXPECT_THROW((void)with_structural_damping(model, -0.1), core::InputError);
}

struct Mode {
  double hz;
  double zeta;
  double mass;
};

const std::vector<Mode> three{{212.0, 0.008, 1.3}, {567.0, 0.004, 0.9}, {1150.0, 0.012, 1.1}};

Eigen::VectorXcd receptance(const std::vector<Mode>& modes, const dynamics::FrequencyAxis& axis) {
  Eigen::VectorXcd H = Eigen::VectorXcd::Zero(axis.size());
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double w = axis.omega_rad_s(line);
    for (const Mode& mode : modes) {
      const double r = 2.0 * std::numbers::pi * mode.hz;
      H(line) += 1.0 / (mode.mass * std::complex<double>(r * r - w * w, 2.0 * mode.zeta * r * w));
    }
  }
  return H;
}

/// Largest |ζ − ζ_exact| / ζ_exact; every mode must be there and no other.
double worst_damping(const std::vector<IdentifiedMode>& found, const std::vector<Mode>& exact) {
  EXPECT_EQ(found.size(), exact.size());
  double worst = 0.0;
  for (std::size_t k = 0; k < std::min(found.size(), exact.size()); ++k) {
    EXPECT_NEAR(found[k].frequency_hz / exact[k].hz, 1.0, 1e-3);
    worst = std::max(worst, std::abs(found[k].damping_ratio / exact[k].zeta - 1.0));
  }
  return worst;
}

TEST(Identification, IsExactForOneMode) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(50.0, 400.0, 1401);
  const std::vector<Mode> one{three[0]};
  const auto found = identify_modes(axis, receptance(one, axis));
  EXPECT_LT(worst_damping(found, one), 1e-9);
  EXPECT_LT(found[0].relative_misfit, 1e-10);
}

TEST(Identification, FindsTheDampingOfThreeModes) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(50.0, 1500.0, 5801);
  const auto found = identify_modes(axis, receptance(three, axis));
  double worst = 0.0;
  for (std::size_t k = 0; k < found.size(); ++k)
    worst = std::max(worst, std::abs(found[k].damping_ratio - three[k].zeta));
  std::printf("identification of three modes: damping within %.1e (%.1e of itself)\n", worst,
              worst_damping(found, three));
  EXPECT_LT(worst, 1e-6);
}

TEST(Identification, StandsNoise) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(50.0, 1500.0, 5801);
  double worst = 0.0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Eigen::VectorXcd H = receptance(three, axis);
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, 0.01 / std::sqrt(2.0));
    for (auto& h : H) h += std::abs(h) * std::complex<double>(noise(random), noise(random));
    worst = std::max(worst, worst_damping(identify_modes(axis, H), three));
  }
  std::printf("identification with 1 %% noise on every line, ten seeds: damping within %.2f %% of itself\n",
              100 * worst);
  EXPECT_LT(worst, 0.03);
}

TEST(Identification, WithoutAPeakIsAnError) {
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(300.0, 450.0, 601);
  EXPECT_THROW((void)identify_modes(axis, receptance(three, axis)), core::InputError) << "between two modes";
  EXPECT_THROW((void)identify_modes(axis, Eigen::VectorXcd::Ones(601)), core::InputError);
  const dynamics::FrequencyAxis half = dynamics::linear_axis(100.0, 212.0, 601);
  EXPECT_THROW((void)identify_modes(half, receptance(three, half)), core::InputError) << "half a peak";
}

}  // namespace
}  // namespace thinwall::reduction::damping_test
