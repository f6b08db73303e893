// Rotations from displacements against bodies and beams whose rotations are known.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "coupling/finite_difference_rotations.hpp"
#include "dynamics/conversion.hpp"
#include "fem/beam.hpp"

namespace thinwall::coupling::finite_difference_test {
namespace {

using Complex = std::complex<double>;
using dynamics::ResponseModel;
using Eigen::Vector3d;

const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();

/// The displacements of both points along x and y, in the order of Lei 2022, Eq. 5.
dynamics::DofTable two_points() {
  return {{"1", x, dynamics::DofKind::translation},
          {"1", y, dynamics::DofKind::translation},
          {"1a", x, dynamics::DofKind::translation},
          {"1a", y, dynamics::DofKind::translation}};
}

ResponseModel one_line(double hz, const Eigen::MatrixXcd& H) {
  return {{Eigen::VectorXd::Constant(1, hz)}, two_points(), two_points(), {H}};
}

/// H = φ φᵀ with φ_i = shape(s_i) along x, nothing along y but a unit compliance.
ResponseModel single_mode(const std::function<double(double)>& shape, double S) {
  const Eigen::Vector4d phi(shape(0.0), 0.0, shape(S), 0.0);
  return one_line(100.0, (phi * phi.transpose()).cast<Complex>());
}

TEST(FiniteDifference, RotationsOfARigidBodyAreExactInEveryDirectionAndSign) {
  // Any rigid motion u + θ × r of a body of mass m and inertia I, hit anywhere: H = (−1/ω²) J M⁻¹ Jᵀ. An axis that is
  // none of x, y, z and directions of the measurement's own: the DOF table alone says what is what.
  const Vector3d axis = Vector3d(1.0, 2.0, -2.0) / 3.0, e1 = Vector3d(2.0, 1.0, 2.0) / 3.0, e2 = axis.cross(e1);
  const double S = 0.04;
  const dynamics::RigidBody body{0.3, {0.02, -0.01, 0.05}, Vector3d(3e-4, 4e-4, 2e-4).asDiagonal()};
  const dynamics::Matrix6 inverse_M = dynamics::mass_matrix(body).inverse();
  const double omega = 2.0 * std::numbers::pi * 100.0;
  dynamics::DofTable dofs;
  Eigen::Matrix<double, 4, 6> J;
  for (const Vector3d& e : {e1, e2}) {
    for (const std::string& point : {std::string("1"), std::string("1a")}) {
      const auto row = static_cast<Eigen::Index>(dofs.size());
      dofs.push_back({point, e, dynamics::DofKind::translation});
      J.row(row) =
          e.transpose() * dynamics::transport(point == "1" ? Vector3d::Zero() : Vector3d(S * axis)).topRows<3>();
    }
  }
  const auto response = [&](const Eigen::MatrixXd& rows) {
    return Eigen::MatrixXcd((-1.0 / (omega * omega)) * rows * inverse_M * rows.transpose());
  };
  const TipReceptance tip = finite_difference_rotations(
      {{Eigen::VectorXd::Constant(1, 100.0)}, dofs, dofs, {response(J)}}, {"1", "1a", S, axis, {e1, e2}});
  Eigen::Matrix<double, 4, 6> J_tip = Eigen::Matrix<double, 4, 6>::Zero();
  for (Eigen::Index i = 0; i < 4; ++i) {
    const dynamics::Dof& dof = tip.T.responses[static_cast<std::size_t>(i)];
    J_tip.row(i).segment<3>(dof.kind == dynamics::DofKind::rotation ? 3 : 0) = dof.direction.transpose();
  }
  const Eigen::MatrixXcd exact = response(J_tip);
  EXPECT_LT(((tip.T.H[0] - exact).array() / exact.array().abs().maxCoeff()).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(tip.T.forces[3].kind, dynamics::DofKind::rotation);
}

TEST(FiniteDifference, RotationsAreNamedAfterPositiveAxes) {
  const auto names = [](const Vector3d& axis) {
    const TipReceptance tip =
        finite_difference_rotations(one_line(10.0, Eigen::Matrix4cd::Identity()), {"1", "1a", 0.02, axis});
    std::string all;
    for (const auto& dof : tip.T.responses) all += dynamics::name(dof) + " ";
    return all;
  };
  EXPECT_EQ(names(z), "1.x 1.ry 1.y 1.rx ");
  EXPECT_EQ(names(-z), "1.x 1.ry 1.y 1.rx ");
  // unit compliances of four displacements: du_x/dz = +ry, du_y/dz = −rx
  const double S = 0.02;
  const Eigen::MatrixXcd T =
      finite_difference_rotations(one_line(10.0, Eigen::Matrix4cd::Identity()), {"1", "1a", S, z}).T.H[0];
  EXPECT_NEAR(T(1, 0).real(), -1.0 / S, 1e-10);
  EXPECT_NEAR(T(3, 2).real(), 1.0 / S, 1e-10);
  EXPECT_NEAR(T(1, 1).real(), 2.0 / (S * S), 1e-8);
  EXPECT_NEAR(T(3, 3).real(), 2.0 / (S * S), 1e-8);
  EXPECT_EQ(T(1, 3), 0.0);
}

TEST(FiniteDifference, ALinearModeIsExactByBothRulesAndAQuadraticOneIsOffByItsCurvature) {
  const double S = 0.03, a = -7.0, b = 40.0;
  const auto by = [&](const ResponseModel& H, RotationRule rule) {
    return finite_difference_rotations(H, {"1", "1a", S}, {rule}).T.H[0];
  };
  for (const RotationRule rule : {RotationRule::second_difference, RotationRule::rank_one}) {
    const Eigen::MatrixXcd linear = by(single_mode([&](double s) { return 1.0 + a * s; }, S), rule);
    EXPECT_NEAR(linear(1, 0).real(), a, 1e-12);
    EXPECT_NEAR(linear(0, 1).real(), a, 1e-12);
    EXPECT_NEAR(linear(1, 1).real(), a * a, 1e-10);
    const Eigen::MatrixXcd quadratic = by(single_mode([&](double s) { return 1.0 + a * s + b * s * s; }, S), rule);
    EXPECT_NEAR(quadratic(1, 0).real() - a, b * S, 1e-12);
    EXPECT_NEAR(quadratic(1, 1).real(), (a + b * S) * (a + b * S), 1e-10);
    EXPECT_EQ(quadratic(3, 3), 0.0) << "nothing moves along y: no 0/0";
  }
}

TEST(FiniteDifference, RankOneLosesOneOfARigidBodysTwoMotions) {
  // Free body: −ω² H(s, s') = 1/m + (s − c)(s' − c)/I. P = 1/I, but N L/H = (c/I)²/(1/m + c²/I).
  const double m = 0.4, I = 6e-4, c = 0.05, S = 0.02, w2 = std::pow(2.0 * std::numbers::pi * 100.0, 2);
  const auto H = [&](double s, double t) { return -(1.0 / m + (s - c) * (t - c) / I) / w2; };
  Eigen::Matrix4cd four = Eigen::Matrix4cd::Zero();
  four(0, 0) = H(0, 0), four(0, 2) = H(0, S), four(2, 0) = H(S, 0), four(2, 2) = H(S, S);
  const auto exact = finite_difference_rotations(one_line(100.0, four), {"1", "1a", S});
  const auto rank_one = finite_difference_rotations(one_line(100.0, four), {"1", "1a", S}, {RotationRule::rank_one});
  const double P = -1.0 / I / w2, P_rank_one = -(c * c / I / I) / (1.0 / m + c * c / I) / w2;
  EXPECT_NEAR(exact.T.H[0](1, 1).real() / P, 1.0, 1e-12);
  EXPECT_NEAR(rank_one.T.H[0](1, 1).real() / P_rank_one, 1.0, 1e-12);
  EXPECT_NEAR(exact.errors.rank_one[0](1, 1) / std::abs(P - P_rank_one), 1.0, 1e-11);
  EXPECT_EQ(rank_one.errors.rank_one[0](1, 0), 0.0);
}

const dynamics::Tube rod{0.016, 0.0, 210e9, 0.3, 7850.0};

/// A clamped rod of 90 mm, points at the tip, at S and at 2S.
dynamics::SpatialModel cantilever(double S, const dynamics::Tube& tube = rod) {
  fem::BeamFrame frame;
  frame.nodes = {{Vector3d::Zero(), "1"}, {S * z, "1a"}, {2.0 * S * z, "1b"}, {0.09 * z, "", true}};
  const auto section = dynamics::section(tube);
  frame.segments = {{0, 1, section, 6}, {1, 2, section, 6}, {2, 3, section, 6}};
  return fem::spatial_model(frame);
}

/// The tip's own DOFs in the order of the differences.
Eigen::MatrixXcd exact_tip(const ResponseModel& H, std::size_t line) {
  std::vector<int> rows;
  for (const char* name : {"1.x", "1.ry", "1.y", "1.rx"}) rows.push_back(dynamics::row_of(H.responses, name));
  return H.H[line](rows, rows);
}

TEST(FiniteDifference, StaticTruncationOfABeamIsItsClosedForm) {
  for (const double S : {0.01, 0.02, 0.0334}) {
    const ResponseModel H = dynamics::direct_response(cantilever(S), dynamics::linear_axis(0.0, 1.0, 2));
    const auto plain = finite_difference_rotations(H, {"1", "1a", S}, {RotationRule::second_difference, rod});
    const auto corrected = finite_difference_rotations(H, {"1", "1a", S}, {RotationRule::corrected, rod});
    const Eigen::MatrixXcd exact = exact_tip(H, 0);
    const Eigen::MatrixXcd off = plain.T.H[0] - exact;
    const dynamics::BeamSection b = dynamics::section(rod);
    const double EI = b.youngs_modulus_Pa * b.I_y_m4, kGA = b.shear_y * b.shear_modulus_Pa * b.area_m2;
    EXPECT_NEAR(off(1, 0).real(), S * S / (6.0 * EI) - 1.0 / kGA, 1e-9 * std::abs(exact(1, 0)));
    EXPECT_NEAR(off(3, 2).real(), -S * S / (6.0 * EI) + 1.0 / kGA, 1e-9 * std::abs(exact(3, 2)));
    EXPECT_NEAR(off(1, 1).real(), -2.0 * S / (3.0 * EI) + 1.0 / (kGA * S), 1e-9 * std::abs(exact(1, 1)));
    for (Eigen::Index i = 0; i < 4; ++i) {
      for (Eigen::Index j = 0; j < 4; ++j) {
        const double scale = std::sqrt(std::abs(exact(i, i)) * std::abs(exact(j, j)));
        EXPECT_LT(std::abs(off(i, j) - plain.errors.truncation[0](i, j)), 1e-9 * scale);
        EXPECT_LT(std::abs(corrected.T.H[0](i, j) - exact(i, j)), 1e-9 * scale);
      }
    }
  }
}

TEST(FiniteDifference, WhatACorrectionLeavesFallsWithAHigherPowerOfTheDistance) {
  // In motion the leading terms leave products of themselves.
  const auto axis = dynamics::linear_axis(600.0, 4800.0, 15);
  double previous = 0.0;
  for (const double S : {0.032, 0.016, 0.008}) {
    const ResponseModel H = dynamics::direct_response(cantilever(S), axis);
    const auto plain = finite_difference_rotations(H, {"1", "1a", S}, {RotationRule::second_difference, rod});
    const auto corrected = finite_difference_rotations(H, {"1", "1a", S}, {RotationRule::corrected, rod});
    double left = 0.0, before = 0.0;
    for (std::size_t line = 0; line < H.H.size(); ++line) {
      const Eigen::MatrixXcd exact = exact_tip(H, line);
      left = std::max(left, std::abs(corrected.T.H[line](1, 1) / exact(1, 1) - 1.0));
      before = std::max(before, std::abs(plain.T.H[line](1, 1) / exact(1, 1) - 1.0));
      EXPECT_LT(std::abs(plain.T.H[line](1, 1) - exact(1, 1)),
                1.3 * std::abs(plain.errors.truncation[line](1, 1)) + 1e-6 * std::abs(exact(1, 1)));
    }
    EXPECT_LT(left, 0.1 * before);
    if (previous > 0.0) {
      EXPECT_LT(left, previous / 3.0) << S;
    }
    previous = left;
  }
}

TEST(FiniteDifference, ASecondDistanceSeesWhatFallsWithTheDistance) {
  // Without shear the static bias of P is −2S/3EI, which Richardson finds exactly, that of N, S²/6EI, threefold.
  fem::BeamFrame frame;
  const double S = 0.02;
  frame.nodes = {{Vector3d::Zero(), "1"}, {S * z, "1a"}, {2.0 * S * z, "1b"}, {0.09 * z, "", true}};
  dynamics::BeamSection section = dynamics::section(rod);
  section.shear_y = section.shear_z = std::numeric_limits<double>::infinity();
  frame.segments = {{0, 1, section, 2}, {1, 2, section, 2}, {2, 3, section, 2}};
  const ResponseModel H = dynamics::direct_response(fem::spatial_model(frame), dynamics::linear_axis(0.0, 1.0, 2));
  const ResponseModel near = finite_difference_rotations(H, {"1", "1a", S}).T;
  const ResponseModel far = finite_difference_rotations(H, {"1", "1b", 2.0 * S}).T;
  const auto estimate = truncation_by_distance(near, S, far, 2.0 * S);
  const Eigen::MatrixXcd off = near.H[0] - exact_tip(H, 0);
  EXPECT_NEAR((estimate[0](1, 1) / off(1, 1)).real(), 1.0, 1e-7);
  EXPECT_NEAR((estimate[0](1, 0) / off(1, 0)).real(), 3.0, 1e-6);
  EXPECT_THROW((void)truncation_by_distance(near, 2.0 * S, far, S), core::InputError);
}

TEST(FiniteDifference, NoiseOfEveryEntryIsThatOfASample) {
  const double S = 0.02;
  const ResponseModel H =
      dynamics::direct_response(cantilever(S), dynamics::FrequencyAxis{Eigen::VectorXd::Constant(1, 700.0)});
  const Deviations sigma = relative_deviations(H, 1e-4);
  for (const RotationRule rule : {RotationRule::second_difference, RotationRule::rank_one, RotationRule::corrected}) {
    RotationOptions options{rule, rod, 0.1, sigma};
    const TipReceptance clean = finite_difference_rotations(H, {"1", "1a", S}, options);
    options.noise.clear();
    constexpr int samples = 4000;
    Eigen::Matrix4d square = Eigen::Matrix4d::Zero();
    for (int i = 0; i < samples; ++i) {
      const auto noisy =
          finite_difference_rotations(with_noise(H, sigma, 100U + static_cast<unsigned>(i)), {"1", "1a", S}, options);
      square += (noisy.T.H[0] - clean.T.H[0]).cwiseAbs2();
    }
    const Eigen::Matrix4d scatter = (square / (2.0 * samples)).cwiseSqrt();
    for (const auto& [i, j] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 3}, {3, 3}}) {
      // a standard deviation from 2 · 4000 squares is known to 1/√(4 · 4000) = 0.8 %: four of them
      EXPECT_NEAR(scatter(i, j) / clean.errors.noise[0](i, j), 1.0, 0.035) << i << j << static_cast<int>(rule);
    }
  }
  // equal σ everywhere: √2 σ/S and 2 σ/S²
  const RotationOptions equal{
      RotationRule::second_difference, {}, 0.1, Deviations(1, Eigen::MatrixXd::Constant(18, 18, 3e-9))};
  ASSERT_EQ(H.responses.size(), 18U);
  const Eigen::MatrixXd noise = finite_difference_rotations(H, {"1", "1a", S}, equal).errors.noise[0];
  EXPECT_NEAR(noise(1, 0) / (std::sqrt(2.0) * 3e-9 / S), 1.0, 1e-12);
  EXPECT_NEAR(noise(1, 1) / (2.0 * 3e-9 / (S * S)), 1.0, 1e-12);
}

template <typename Call>
std::string refusal(Call call) {
  try {
    call();
  } catch (const core::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(FiniteDifference, RefusesWhatCannotBeDifferenced) {
  const ResponseModel good = one_line(10.0, Eigen::Matrix4cd::Identity());
  const std::string all = refusal([&] {
    (void)finite_difference_rotations(good, {"1", "1b", 0.0, 2.0 * z, {x, x + y}}, {RotationRule::corrected});
  });
  for (const char* part :
       {"distance S (m) 0", "the tool's axis is not a unit vector", "a direction is not a unit vector",
        "the response 1b.x is missing", "the force 1b.x is missing", "section between both points is missing"}) {
    EXPECT_NE(all.find(part), std::string::npos) << part << " in " << all;
  }
  ResponseModel fifteen = good;
  fifteen.forces.pop_back();
  fifteen.H[0].conservativeResize(4, 3);
  EXPECT_NE(refusal([&] {
              (void)finite_difference_rotations(fifteen, {"1", "1a", 0.02});
            }).find("the force 1a.y is missing"),
            std::string::npos);
  ResponseModel bad = good;
  bad.H[0](2, 1) = std::nan("");
  EXPECT_NE(refusal([&] { (void)finite_difference_rotations(bad, {"1", "1a", 0.02}); }), "");
  EXPECT_NE(refusal([&] { (void)finite_difference_rotations(good, {"1", "1a", std::nan("")}); }), "");
  RotationOptions options;
  options.noise = Deviations(1, Eigen::MatrixXd::Constant(3, 3, 1e-9));
  EXPECT_NE(refusal([&] { (void)finite_difference_rotations(good, {"1", "1a", 0.02}, options); }), "");
  EXPECT_NE(
      refusal([&] {
        (void)error_bound(finite_difference_rotations(good, {"1", "1a", 0.02}).errors, RotationRule::rank_one, 2.0);
      }).find("truncation is not known"),
      std::string::npos);
  // H_11 = 0 but N and L are not: rank one divides by nothing
  Eigen::Matrix4cd H = Eigen::Matrix4cd::Identity();
  H(0, 0) = 0.0, H(0, 2) = H(2, 0) = 1.0;
  EXPECT_THROW((void)finite_difference_rotations(one_line(10.0, H), {"1", "1a", 0.02}, {RotationRule::rank_one}),
               core::NumericalError);
  EXPECT_NO_THROW((void)finite_difference_rotations(one_line(10.0, H), {"1", "1a", 0.02}));
}

TEST(FrfNoise, DeviationsComeFromCoherenceOrAsStated) {
  const ResponseModel model = one_line(10.0, Complex(3e-6, -4e-6) * Eigen::Matrix4cd::Ones());
  EXPECT_NEAR(relative_deviations(model, 0.02)[0](2, 1), 1e-7, 1e-20);
  const std::vector<Eigen::MatrixXd> coherence{Eigen::MatrixXd::Constant(4, 4, 0.8)};
  EXPECT_NEAR(deviations_from_coherence(model, coherence, 5)[0](0, 3), 5e-6 * std::sqrt(0.2 / 8.0), 1e-18);
  EXPECT_EQ(deviations_from_coherence(model, {Eigen::MatrixXd::Ones(4, 4)}, 5)[0](0, 3), 0.0);
  const auto bad = [&](double gamma2, int n) {
    return refusal([&] { (void)deviations_from_coherence(model, {Eigen::MatrixXd::Constant(4, 4, gamma2)}, n); });
  };
  EXPECT_NE(bad(0.0, 5).find("the coherence at 10 Hz is 0"), std::string::npos);
  EXPECT_NE(bad(1.1, 5), "");
  EXPECT_NE(bad(std::nan(""), 5), "");
  EXPECT_NE(bad(0.9, 0).find("0 averages"), std::string::npos);
  EXPECT_NE(refusal([&] { (void)deviations_from_coherence(model, {}, 5); }), "");
  EXPECT_NE(refusal([&] { (void)relative_deviations(model, -0.1); }), "");
  EXPECT_NE(refusal([&] { (void)with_noise(model, {Eigen::MatrixXd::Constant(4, 4, -1.0)}, 1); }), "");
}

TEST(FrfNoise, AnAveragedEstimateScattersAsItsCoherenceSays) {
  // H₁ = Σ X* Y / Σ |X|² of n spectra, noise on the response: γ² = |H|² Sxx/(|H|² Sxx + Snn).
  std::mt19937_64 generator(3);
  std::normal_distribution<double> normal;
  const auto draw = [&] {
    const double a = normal(generator);
    return Complex(a, normal(generator));
  };
  const Complex H(1.2, -0.7);
  const double noise = 0.4;
  constexpr int n = 40, samples = 4000;
  const double gamma2 = std::norm(H) / (std::norm(H) + noise * noise);
  double radial = 0.0, tangential = 0.0;
  for (int i = 0; i < samples; ++i) {
    Complex cross = 0.0;
    double power = 0.0;
    for (int k = 0; k < n; ++k) {
      const Complex X = draw(), Y = H * X + noise * draw();
      cross += std::conj(X) * Y;
      power += std::norm(X);
    }
    const Complex off = cross / power / H - 1.0;
    radial += off.real() * off.real();
    tangential += off.imag() * off.imag();
  }
  const ResponseModel model = one_line(10.0, H * Eigen::Matrix4cd::Ones());
  const double sigma =
      deviations_from_coherence(model, {Eigen::MatrixXd::Constant(4, 4, gamma2)}, n)[0](0, 0) / std::abs(H);
  // the leading order is off by 1/2n itself; the sample by 1/√(2 · 4000) = 1.1 %
  EXPECT_NEAR(std::sqrt(radial / samples) / sigma, 1.0, 0.05);
  EXPECT_NEAR(std::sqrt(tangential / samples) / sigma, 1.0, 0.05);
}

}  // namespace
}  // namespace thinwall::coupling::finite_difference_test
