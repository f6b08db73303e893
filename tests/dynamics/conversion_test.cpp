#include "dynamics/conversion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "core/error.hpp"
#include "random_models.hpp"
#include "tests/processor_time.hpp"

namespace thinwall::dynamics::conversion_test {
namespace {

using testing::semidefinite;
using testing::spring_chain;
using Complex = std::complex<double>;

/// Largest |a − b| of any line, relative to the largest |b| of that line.
double difference(const ResponseModel& a, const ResponseModel& b) {
  double largest = 0.0;
  for (std::size_t line = 0; line < b.H.size(); ++line) {
    largest = std::max(largest, (a.H[line] - b.H[line]).cwiseAbs().maxCoeff() / b.H[line].cwiseAbs().maxCoeff());
  }
  return largest;
}

/// Largest |H_ij − H_ji| / √|H_ii H_jj|: an entry between distant points may lie below the round-off of the sums that
/// make it, so the driving points set the scale.
double asymmetry(const ResponseModel& model) {
  double largest = 0.0;
  for (const auto& H : model.H) {
    const Eigen::VectorXd scale = H.diagonal().cwiseAbs().cwiseSqrt();
    largest =
        std::max(largest, ((H - H.transpose()).cwiseAbs().array() / (scale * scale.transpose()).array()).maxCoeff());
  }
  return largest;
}

double largest_driving_imaginary(const ResponseModel& model) {
  double largest = -1.0;
  for (const auto& H : model.H) largest = std::max(largest, H.diagonal().imag().maxCoeff());
  return largest;
}

/// An axis through all resonances of the model and between them.
FrequencyAxis axis_through_resonances(const SpatialModel& model) {
  const Eigen::VectorXd omega = undamped_modes(model).omega_rad_s;
  FrequencyAxis axis{Eigen::VectorXd(2 * omega.size())};
  for (Eigen::Index r = 0; r < omega.size(); ++r) {
    const double hz = omega(r) / (2.0 * std::numbers::pi);
    axis.hz.segment<2>(2 * r) << 0.97 * hz, hz;
  }
  std::sort(axis.hz.begin(), axis.hz.end());
  return axis;
}

SpatialModel one_mass(double m, double c, double k) {
  const auto scalar = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  return {scalar(m), scalar(c), scalar(k), {}, {{"P", Eigen::Vector3d::UnitX(), DofKind::translation}}};
}

TEST(UndampedModes, FixedFixedChainOfEqualMassesHasItsClosedForm) {
  // n equal masses between n + 1 equal springs: ω_r = 2 √(k/m) sin(rπ / (2(n+1))) (Meirovitch 2001, section 7.4)
  const int n = 12;
  const double k = 3e6, m = 0.7;
  SpatialModel model = spring_chain(n, 1);
  model.M = m * Eigen::MatrixXd::Identity(n, n);
  model.K.setZero();
  model.K.diagonal().setConstant(2 * k);
  model.K.diagonal(1).setConstant(-k);
  model.K.diagonal(-1).setConstant(-k);
  const UndampedModes modes = undamped_modes(model);
  for (int r = 1; r <= n; ++r) {
    const double omega = 2.0 * std::sqrt(k / m) * std::sin(r * std::numbers::pi / (2.0 * (n + 1)));
    EXPECT_NEAR(modes.omega_rad_s(r - 1) / omega, 1.0, 1e-13) << r;
  }
}

TEST(UndampedModes, AreMassNormalisedAndDiagonaliseTheStiffness) {
  const SpatialModel model = spring_chain(20, 2);
  const UndampedModes modes = undamped_modes(model);
  const Eigen::MatrixXd M = modes.Phi.transpose() * model.M * modes.Phi;
  const Eigen::MatrixXd K = modes.Phi.transpose() * model.K * modes.Phi;
  EXPECT_LT((M - Eigen::MatrixXd::Identity(20, 20)).norm(), 1e-12);
  EXPECT_LT((K - Eigen::MatrixXd(modes.omega_rad_s.cwiseAbs2().asDiagonal())).norm(), 1e-12 * K.norm());
  for (const auto shape : modes.Phi.colwise()) EXPECT_EQ(shape.maxCoeff(), shape.cwiseAbs().maxCoeff());
}

TEST(UndampedModes, LowModeKeepsItsDigitsBesideAnInterfaceThatIsAMillionTimesStiffer) {
  // two masses m on ground springs k, joined by a spring s: ω₁² = k/m exactly, ω₂² = (k + 2s)/m
  const double m = 0.3, k = 1e5, s = 1e11;
  SpatialModel model = spring_chain(2, 3);
  model.M = m * Eigen::MatrixXd::Identity(2, 2);
  model.K << k + s, -s, -s, k + s;
  const UndampedModes modes = undamped_modes(model);
  // the entries k + s hold k to eps s / k = 2e-10 only; k + s was chosen representable, so half of it is the bound
  EXPECT_NEAR(modes.omega_rad_s(0) / std::sqrt(k / m), 1.0, 1e-10);
  EXPECT_NEAR(modes.omega_rad_s(1) / std::sqrt((k + 2 * s) / m), 1.0, 1e-14);
}

TEST(UndampedModes, FreeChainHasOneRigidModeAtExactlyZero) {
  SpatialModel model = spring_chain(8, 4);
  for (int i = 0; i < 8; ++i) model.K(i, i) -= model.K.row(i).sum();
  const UndampedModes modes = undamped_modes(model);
  EXPECT_EQ(modes.omega_rad_s(0), 0.0);
  EXPECT_GT(modes.omega_rad_s(1), 10.0);
  EXPECT_NEAR(modes.Phi.col(0).minCoeff(), 1.0 / std::sqrt(model.M.trace()), 1e-10);
  EXPECT_NEAR(modes.Phi.col(0).maxCoeff(), 1.0 / std::sqrt(model.M.trace()), 1e-10);
}

TEST(UndampedModes, RefusesMasslessDofsAndIndefiniteStiffness) {
  SpatialModel model = spring_chain(3, 5);
  model.M(1, 1) = 0.0;
  EXPECT_THROW((void)undamped_modes(model), core::NumericalError);
  model = spring_chain(3, 5);
  model.K(1, 1) = -1e5;
  EXPECT_THROW((void)undamped_modes(model), core::NumericalError);
  model = spring_chain(3, 5);
  model.K(1, 1) = std::nan("");
  EXPECT_THROW((void)undamped_modes(model), core::InputError);
}

TEST(ToModal, OneMassHasItsClosedFormFromUndampedToOverdamped) {
  const double m = 2.0, k = 8e5;
  for (const double zeta : {0.0, 1e-3, 0.7, 3.0}) {
    const double omega = std::sqrt(k / m), c = 2.0 * zeta * omega * m;
    const ModalModel modal = to_modal(one_mass(m, c, k));
    EXPECT_NEAR(std::abs(modal.poles(0) * modal.poles(1) / (omega * omega)), 1.0, 1e-14) << zeta;
    EXPECT_NEAR(std::abs(modal.poles(0) + modal.poles(1) + c / m), 0.0, 1e-12 * omega) << zeta;
    const FrequencyAxis axis = linear_axis(0.0, 200.0, 21);
    const ResponseModel response = to_response(modal, axis);
    for (Eigen::Index line = 0; line < axis.size(); ++line) {
      const double w = axis.omega_rad_s(line);
      const Complex exact = 1.0 / Complex(k - w * w * m, w * c);
      EXPECT_LT(std::abs(response.H[static_cast<std::size_t>(line)](0, 0) / exact - 1.0), 1e-13) << zeta << " " << line;
    }
  }
}

TEST(ToModal, SumEqualsTheDirectSolutionOnResonancesWithEveryKindOfDamping) {
  for (const int n : {2, 7, 20, 46}) {
    SpatialModel model = spring_chain(n, static_cast<unsigned>(n));
    const FrequencyAxis axis = axis_through_resonances(model);
    for (const Eigen::MatrixXd& C :
         {Eigen::MatrixXd(2e-6 * model.K + 0.3 * model.M), semidefinite(n, n, 20.0, 7), semidefinite(n, n, 3000.0, 8),
          Eigen::MatrixXd(1e-6 * model.K + semidefinite(n, 1, 5e4, 9))}) {
      model.C = C;
      const ResponseModel modal = to_response(to_modal(model), axis);
      // on a resonance both carry n ε κ(K) / 2ζ, here up to 46 · 2e-16 · 1e2 / 1e-2
      EXPECT_LT(difference(modal, direct_response(model, axis)), 1e-10) << n;
      EXPECT_LT(asymmetry(modal), 1e-10) << n;
      EXPECT_LE(largest_driving_imaginary(modal), 0.0) << n;
    }
  }
}

TEST(ToModal, PolesComeInPairsAndSolveTheQuadraticProblem) {
  SpatialModel model = spring_chain(10, 11);
  model.C = 1e-5 * model.K + semidefinite(10, 2, 1e4, 12);
  const ModalModel modal = to_modal(model);
  ASSERT_EQ(modal.poles.size(), 20);
  for (Eigen::Index k = 0; k < 20; ++k) {
    const Complex s = modal.poles(k);
    EXPECT_LT(s.real(), 0.0);
    if (s.imag() > 0.0) {
      EXPECT_EQ(modal.poles(k + 1), std::conj(s));
    }
    const Eigen::VectorXcd phi = modal.right.col(k);
    const Eigen::VectorXcd force = (s * s * model.M + s * model.C + model.K) * phi;
    EXPECT_LT(force.norm(), 1e-10 * (model.K * phi).norm());
  }
}

TEST(ToModal, AFreeMassWithAGroundedDamperHasAPoleAtZeroAndAnInfiniteStaticResponse) {
  const ModalModel modal = to_modal(one_mass(2.0, 30.0, 0.0));
  const ResponseModel response = to_response(modal, linear_axis(1.0, 10.0, 2));
  const double w = response.axis.omega_rad_s(0);
  EXPECT_LT(std::abs(response.H[0](0, 0) * Complex(-w * w * 2.0, w * 30.0) - 1.0), 1e-13);
  EXPECT_THROW((void)to_response(modal, linear_axis(0.0, 10.0, 2)), core::NumericalError);
}

TEST(ToModal, AFreeChainWithOneGroundedDamperMatchesTheDirectSolution) {
  SpatialModel model = spring_chain(6, 13);
  for (int i = 0; i < 6; ++i) model.K(i, i) -= model.K.row(i).sum();
  model.C(2, 2) = 400.0;
  const FrequencyAxis axis = linear_axis(1.0, 700.0, 300);
  EXPECT_LT(difference(to_response(to_modal(model), axis), direct_response(model, axis)), 1e-10);
}

TEST(ToModal, AFreeMassIsItsInertia) {
  const ResponseModel response = to_response(to_modal(one_mass(2.0, 0.0, 0.0)), linear_axis(1.0, 10.0, 2));
  for (Eigen::Index line = 0; line < 2; ++line) {
    const double w = response.axis.omega_rad_s(line);
    EXPECT_LT(std::abs(response.H[static_cast<std::size_t>(line)](0, 0) * (-w * w * 2.0) - 1.0), 1e-6);
  }
}

// A spring with a damper between the masses is not proportional damping, and does no work in the rigid motion.
TEST(ToModal, FreeMotionsBesideDampedModesMatchTheDirectSolution) {
  SpatialModel model = spring_chain(6, 13);
  for (int i = 0; i < 6; ++i) model.K(i, i) -= model.K.row(i).sum();
  // Without the spring between the third and the fourth mass there are two rigid motions.
  const double cut = -model.K(2, 3);
  model.K(2, 3) = model.K(3, 2) = 0.0;
  model.K(2, 2) -= cut;
  model.K(3, 3) -= cut;
  model.C.setZero();
  for (const auto& [i, j, c] : {std::tuple{0, 1, 40.0}, std::tuple{4, 5, 300.0}}) {
    model.C(i, i) += c;
    model.C(j, j) += c;
    model.C(i, j) -= c;
    model.C(j, i) -= c;
  }
  const FrequencyAxis axis = linear_axis(1.0, 700.0, 300);
  const double lowest = undamped_modes(model).omega_rad_s(2);
  // The suspension that stands for the double pole changes the first line by (ε / ω)².
  const double bound = 2.0 * std::pow(1e-6 * lowest / axis.omega_rad_s(0), 2);
  EXPECT_LT(bound, 1e-6);
  EXPECT_LT(difference(to_response(to_modal(model), axis), direct_response(model, axis)), bound);
}

TEST(ToModal, RefusesWhatHasNoSimplePoles) {
  EXPECT_THROW((void)to_modal(one_mass(1.0, 2.0, 1.0)), core::NumericalError);
  SpatialModel hysteretic = spring_chain(3, 14);
  hysteretic.D = 0.01 * hysteretic.K;
  EXPECT_THROW((void)to_modal(hysteretic), core::InputError);
}

TEST(Truncate, KeptStaticTermMakesTheSumExactAtZeroAndCloserBelowTheCut) {
  SpatialModel model = spring_chain(15, 15);
  model.C = 2e-6 * model.K;
  const ModalModel all = to_modal(model);
  const double cut = std::abs(all.poles(9)) * 1.001;
  const ModalModel bare = truncate(all, cut, false);
  const ModalModel with_static = truncate(all, cut, true);
  EXPECT_EQ(bare.poles.size(), 10);
  EXPECT_EQ(oscillating_modes(bare).size(), 5U);
  const FrequencyAxis zero = linear_axis(0.0, cut / (8.0 * std::numbers::pi), 2);
  const ResponseModel exact = to_response(all, zero);
  const ResponseModel cheap = to_response(bare, zero);
  const ResponseModel better = to_response(with_static, zero);
  EXPECT_LT((better.H[0] - exact.H[0]).norm(), 1e-13 * exact.H[0].norm());
  EXPECT_LT((better.H[1] - exact.H[1]).norm(), 0.1 * (cheap.H[1] - exact.H[1]).norm());
}

TEST(EquivalentViscous, HasTheSameLossAtEachResonance) {
  SpatialModel model = spring_chain(6, 16);
  const double eta = 0.01;
  model.D = eta * model.K;
  const ModalModel modal = to_modal(equivalent_viscous(model));
  for (const int mode : oscillating_modes(modal))
    EXPECT_NEAR(summarise(modal.poles(mode)).damping_ratio, eta / 2, 1e-13);
}

TEST(DirectResponse, StructuralDampingHasItsClosedForm) {
  SpatialModel model = one_mass(2.0, 5.0, 8e5);
  model.D = Eigen::MatrixXd::Constant(1, 1, 4e3);
  const FrequencyAxis axis = linear_axis(0.0, 200.0, 50);
  const ResponseModel response = direct_response(model, axis);
  for (Eigen::Index line = 0; line < axis.size(); ++line) {
    const double w = axis.omega_rad_s(line);
    const Complex stiffness(8e5 - 2.0 * w * w, 4e3 + 5.0 * w);
    EXPECT_LT(std::abs(response.H[static_cast<std::size_t>(line)](0, 0) * stiffness - 1.0), 1e-14);
  }
}

TEST(DirectResponse, LeavesModalAmplitudesOutOfItsTable) {
  SpatialModel model = spring_chain(5, 17);
  model.C = 1e-5 * model.K;
  const FrequencyAxis axis = linear_axis(10.0, 400.0, 20);
  const ResponseModel all = direct_response(model, axis);
  model.dofs[1] = {"mode 1", Eigen::Vector3d::Zero(), DofKind::modal};
  const ResponseModel direct = direct_response(model, axis);
  ASSERT_EQ(direct.responses.size(), 4U);
  EXPECT_EQ(name(direct.forces[1]), "p2.x");
  EXPECT_LT(std::abs(direct.H[7](0, 3) - all.H[7](0, 4)), 1e-14 * std::abs(all.H[7](0, 4)));
  EXPECT_LT(difference(to_response(to_modal(model), axis), direct), 1e-12);
}

TEST(DirectResponse, NamesTheFrequencyAtWhichAFreePartHasNoResponse) {
  SpatialModel model = spring_chain(3, 18);
  for (int i = 0; i < 3; ++i) model.K(i, i) -= model.K.row(i).sum();
  try {
    (void)direct_response(model, linear_axis(0.0, 100.0, 11));
    FAIL() << "a free part responded at 0 Hz";
  } catch (const core::NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("at 0 Hz"), std::string::npos) << error.what();
  }
}

TEST(DirectResponse, TwoThousandLinesOfFortySixDofsTakeLessThanASecondOnTwoCores) {
  SpatialModel model = spring_chain(46, 19);
  model.C = 1e-6 * model.K;
  for (int i = 9; i < 46; ++i) model.dofs[static_cast<std::size_t>(i)].kind = DofKind::modal;
  const double start = tests::processor_seconds();
  const ResponseModel response = direct_response(model, linear_axis(0.5, 5000.0, 2000));
  const double seconds = tests::processor_seconds() - start;
  RecordProperty("processor_seconds", std::to_string(seconds));
  EXPECT_EQ(response.H[0].rows(), 9);
#ifdef NDEBUG
  EXPECT_LT(seconds, 4.0) << "two, and as much again for a core that is shared";
#endif
}

TEST(ResponseModel, EntryAndBetweenPickByName) {
  SpatialModel model = spring_chain(4, 20);
  model.C = 1e-5 * model.K;
  const ResponseModel response = direct_response(model, linear_axis(1.0, 100.0, 5));
  EXPECT_EQ(entry(response, "p1.x", "p3.x")(2), response.H[2](1, 3));
  const ResponseModel pair = between(response, "p2", "p0");
  ASSERT_EQ(pair.H[4].size(), 1);
  EXPECT_EQ(pair.H[4](0, 0), response.H[4](2, 0));
  EXPECT_THROW((void)entry(response, "p9.x", "p3.x"), core::InputError);
  EXPECT_THROW((void)between(response, "p9", "p3"), core::InputError);
}

}  // namespace
}  // namespace thinwall::dynamics::conversion_test
