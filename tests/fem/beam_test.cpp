#include "fem/beam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::fem::beam_test {
namespace {

using dynamics::BeamSection;
using dynamics::Matrix6;
using dynamics::SpatialModel;
using dynamics::Tube;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
constexpr double pi = std::numbers::pi;

constexpr double E = 210e9, nu = 0.3, rho = 7850.0, G = E / (2.0 * (1.0 + nu));

BeamFrame cantilever(const BeamSection& section, double length, int elements) {
  return {.nodes = {{Vector3d::Zero(), "", true}, {{length, 0.0, 0.0}, "tip"}},
          .segments = {{0, 1, section, elements}}};
}

/// A section without shear flexibility, with a bending plane x-z far stiffer than x-y; r: radius of gyration over the
/// length 1 m.
BeamSection slender(double r) {
  const double infinite = std::numeric_limits<double>::infinity();
  return {E, G, rho, 1e-4, r * r, 1e-4 * r * r, r * r, infinite, infinite};
}

BeamSection round_bar(double diameter, double inner = 0.0) {
  return dynamics::section(Tube{diameter, inner, E, nu, rho});
}

VectorXd omega(const SpatialModel& model) {
  return dynamics::undamped_modes(model).omega_rad_s;
}

/// Static motion of the named nodes by forces on them: T K⁻¹ Tᵀ.
MatrixXd static_compliance(const SpatialModel& model) {
  return model.T * model.K.ldlt().solve(model.T.transpose());
}

// ---- slender limits ----------------------------------------------------------------------------------------------

/// Relative errors of the lowest bending frequencies with β known, with so many elements.
VectorXd slender_errors(BeamFrame frame, int elements, const VectorXd& beta, Eigen::Index rigid) {
  const double r = 1e-5;
  frame.segments[0] = {0, 1, slender(r), elements, Vector3d::UnitY()};
  const VectorXd found = omega(spatial_model(frame)).segment(rigid, beta.size());
  const VectorXd exact = beta.cwiseAbs2() * std::sqrt(E / rho) * r;
  return found.cwiseQuotient(exact).array() - 1.0;
}

TEST(SlenderBeam, ClampedAndFreeConvergesAsTheFourthPowerOfTheElement) {
  const VectorXd beta = Eigen::Vector3d(1.8751040687119611, 4.6940911329741746, 7.8547574382376126);
  for (const int elements : {4, 8, 16}) {
    const VectorXd errors = slender_errors(cantilever({}, 1.0, 1), elements, beta, 0);
    const VectorXd predicted = (beta / elements).array().pow(4.0) / 1440.0;
    std::printf("clamped-free, %2d elements: errors %.2e %.2e %.2e\n", elements, errors(0), errors(1), errors(2));
    for (Eigen::Index k = 1; k < 3; ++k) EXPECT_NEAR(errors(k) / predicted(k), 1.0, elements == 4 ? 0.3 : 0.1) << k;
    EXPECT_LT(errors(0), 2.0 * predicted(0) + 1e-8);
  }
}

TEST(SlenderBeam, FreeAtBothEndsConvergesAsTheFourthPowerOfTheElement) {
  const VectorXd beta = Eigen::Vector2d(4.7300407448627040, 7.8532046240958376);
  BeamFrame frame = cantilever({}, 1.0, 1);
  frame.nodes[0].clamped = false;
  for (const int elements : {8, 16}) {
    const VectorXd errors = slender_errors(frame, elements, beta, 6);
    const VectorXd predicted = (beta / elements).array().pow(4.0) / 1440.0;
    for (Eigen::Index k = 0; k < 2; ++k) EXPECT_NEAR(errors(k) / predicted(k), 1.0, 0.15) << k;
  }
}

// ---- Timoshenko --------------------------------------------------------------------------------------------------

/// The lower root of EI k⁴ − (ρA + (ρI + ρA EI/κGA) k²) ω² + (ρI ρA/κGA) ω⁴ = 0, k = nπ/L: a beam on two pins (Huang
/// 1961, case 1).
double pinned_omega(const BeamSection& s, double L, int n) {
  const double k2 = std::pow(n * pi / L, 2.0);
  const double EI = s.youngs_modulus_Pa * s.I_z_m4, GA = s.shear_y * s.shear_modulus_Pa * s.area_m2;
  const double m = s.density_kg_m3 * s.area_m2, j = s.density_kg_m3 * s.I_z_m4;
  const double b = m + (j + m * EI / GA) * k2;
  return std::sqrt(2.0 * EI * k2 * k2 / (b + std::sqrt(b * b - 4.0 * j * m / GA * EI * k2 * k2)));
}

/// Pins about z between two clamped nodes. Stiff in x-z, so that the lowest modes are those of x-y.
VectorXd pinned(const BeamSection& s, double L, int elements) {
  const BeamFrame frame{
      .nodes = {{Vector3d::Zero(), "", true}, {Vector3d::Zero(), "left"}, {{L, 0, 0}, "right"}, {{L, 0, 0}, "", true}},
      .segments = {{1, 2, s, elements, Vector3d::UnitY()}},
      .bodies = {},
      .springs = {},
      .hinges = {{0, 1, Vector3d::UnitZ()}, {3, 2, Vector3d::UnitZ()}}};
  // A beam whose ends are both carried by clamped nodes.
  return omega(spatial_model(frame)).head(3);
}

TEST(TimoshenkoBeam, OnTwoPinsHasHuangsFrequencies) {
  BeamSection s = round_bar(0.1);
  s.I_y_m4 *= 1e3;
  s.J_m4 *= 1e3;
  s.shear_z *= 1e3;
  const double L = 0.8;  // eight diameters: shear and rotary inertia take 7 % off the third frequency
  const double shear_wave_speed = std::sqrt(s.shear_y * G / rho);
  for (int n = 1; n <= 3; ++n) {
    const double exact = pinned_omega(s, L, n);
    double previous = 0.0;
    for (const int elements : {8, 16, 32}) {
      const double error = pinned(s, L, elements)(n - 1) / exact - 1.0;
      const double predicted = std::pow(exact * L / elements / shear_wave_speed, 2.0) / 24.0;
      std::printf("Huang, mode %d, %2d elements: error %.2e, of which %.2e by shear\n", n, elements, error, predicted);
      // The rest: bending's (βh)⁴/1440, and the rotary share of the kinetic energy, 4 % of the third mode.
      EXPECT_NEAR(error / predicted, 1.0, elements == 8 ? 0.1 : 0.04) << n;
      if (previous > 0.0) {
        EXPECT_NEAR(std::log2(previous / error), 2.0, 0.1) << n;
      }
      previous = error;
    }
  }
  BeamSection thin = s;
  thin.shear_y = std::numeric_limits<double>::infinity();
  EXPECT_GT(pinned_omega(thin, L, 3), 1.05 * pinned_omega(s, L, 3)) << "what is tested matters here";
}

// ---- statics -----------------------------------------------------------------------------------------------------

// Castigliano: ∫ M²/EI + ∫ V²/κGA step by step.
TEST(SteppedCantilever, BendsUnderATipForceAsTheIntegralsSay) {
  const BeamSection thick = round_bar(0.06), thin = round_bar(0.02, 0.008);
  const double a = 0.05, b = 0.08;
  for (const int elements : {1, 3}) {
    const BeamFrame frame{.nodes = {{Vector3d::Zero(), "", true}, {{0, a, 0}, ""}, {{0, a + b, 0}, "tip"}},
                          .segments = {{0, 1, thick, elements}, {1, 2, thin, elements}}};
    const MatrixXd S = static_compliance(spatial_model(frame));
    const auto EI = [](const BeamSection& s) { return E * s.I_z_m4; };
    const auto GA = [](const BeamSection& s) { return s.shear_y * G * s.area_m2; };
    const double bent = (std::pow(a + b, 3.0) - b * b * b) / (3.0 * EI(thick)) + b * b * b / (3.0 * EI(thin));
    const double sheared = a / GA(thick) + b / GA(thin);
    const double turned = (std::pow(a + b, 2.0) - b * b) / (2.0 * EI(thick)) + b * b / (2.0 * EI(thin));
    EXPECT_NEAR(S(0, 0), bent + sheared, 1e-12 * S(0, 0));
    EXPECT_NEAR(S(2, 2), bent + sheared, 1e-12 * S(0, 0));
    EXPECT_NEAR(S(1, 1), a / (E * thick.area_m2) + b / (E * thin.area_m2), 1e-12 * S(1, 1));
    EXPECT_NEAR(S(5, 0), -turned, 1e-12 * turned) << "along y, a force along x turns about −z";
    EXPECT_NEAR(S(3, 2), turned, 1e-12 * turned);
    EXPECT_NEAR(S(4, 4), a / (G * thick.J_m4) + b / (G * thin.J_m4), 1e-12 * S(4, 4));
  }
}

// A clamped beam carries by a hinge the end of one on a pin: the force on the hinge is shared by the pin's lever.
TEST(Hinge, PassesForcesAndNoTorque) {
  const BeamSection s = round_bar(0.02);
  const double a = 0.4, b = 0.6;
  BeamFrame frame{.nodes = {{Vector3d::Zero(), "", true},
                            {{a, 0, 0}, ""},
                            {{a, 0, 0}, ""},
                            {{a + b, 0, 0}, "tip"},
                            {{a + b, 0, 0}, "", true}},
                  .segments = {{0, 1, s, 1}, {2, 3, s, 1}},
                  .bodies = {},
                  .springs = {},
                  .hinges = {{1, 2, Vector3d::UnitZ()}, {4, 3, Vector3d::UnitZ()}}};
  frame.nodes[2].name = "middle";
  const MatrixXd S = static_compliance(spatial_model(frame));
  const double exact = a * a * a / (3.0 * E * s.I_z_m4) + a / (s.shear_y * G * s.area_m2);
  EXPECT_NEAR(S(1, 1), exact, 1e-11 * exact);  // all of it on the cantilever
  EXPECT_NEAR(S(5, 1), -exact / b, 1e-11 * exact / b) << "the other beam turns as a rigid one";
  frame.hinges[0].stiffness = 1e15;  // welded, the pin at the end bears some
  frame.hinges[1].stiffness = 1e15;
  const double welded = static_compliance(spatial_model(frame))(1, 1);
  const double both_clamped = std::pow(a * b, 3.0) / (3.0 * E * s.I_z_m4 * std::pow(a + b, 3.0));
  EXPECT_NEAR(welded, both_clamped, 0.01 * both_clamped) << "but for shear";
}

TEST(NodeSpring, ToTheGroundBearsAlongItsDirections) {
  const BeamSection s = round_bar(0.02);
  BeamFrame frame = cantilever(s, 0.5, 2);
  const double free = static_compliance(spatial_model(frame))(1, 1);
  NodeSpring spring{.node = 1};
  spring.stiffness(1, 1) = 3e5;
  frame.springs = {spring};
  EXPECT_NEAR(static_compliance(spatial_model(frame))(1, 1), free / (1.0 + 3e5 * free), 1e-12 * free);
}

// ---- frames that nothing holds -----------------------------------------------------------------------------------

/// Three steps, a hollow one among them, every node named: y are the nodes' motions in the table's order.
const std::vector<CylinderStep> three_steps{{0.04, {0.016, 0.0, 600e9, 0.22, 14500.0}, 1},
                                            {0.05, {0.05, 0.02, E, nu, rho}, 1},
                                            {0.03, {0.063, 0.0, E, nu, rho}, 1}};

TEST(ToolBeam, HasSixRigidMotionsAndTheMassOfItsCylinders) {
  const SpatialModel tool = tool_beam(three_steps, {"1", "2", "3", "4"}, Vector3d::UnitZ());
  ASSERT_TRUE(tool.T.isIdentity());
  const VectorXd w = omega(tool);
  EXPECT_EQ((w.array() == 0.0).count(), 6);
  EXPECT_GT(w(6), 1e3);
  MatrixXd rigid(24, 6);
  const double places[] = {0.0, 0.04, 0.09, 0.12};
  for (Eigen::Index node = 0; node < 4; ++node)
    rigid.middleRows<6>(6 * node) = dynamics::transport({0.0, 0.0, places[node]});
  EXPECT_LT((tool.K * rigid).cwiseAbs().maxCoeff(), 1e-12 * tool.K.cwiseAbs().maxCoeff());
  Matrix6 expected = Matrix6::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Tube& tube = three_steps[i].tube;
    const double D2 = tube.outer_diameter_m * tube.outer_diameter_m, d2 = tube.inner_diameter_m * tube.inner_diameter_m;
    const double L = three_steps[i].length_m;
    const double m = tube.density_kg_m3 * pi / 4.0 * (D2 - d2) * L;
    const double across = m * ((D2 + d2) / 16.0 + L * L / 12.0);
    expected += dynamics::mass_matrix(
        {m, {0.0, 0.0, places[i] + L / 2.0}, Vector3d(across, across, m * (D2 + d2) / 8.0).asDiagonal()});
  }
  EXPECT_LT((rigid.transpose() * tool.M * rigid - expected).cwiseAbs().maxCoeff(), 1e-13 * expected(0, 0));
}

TEST(ToolBeam, KeepsTheNamesAndLeavesTheRestInside) {
  const SpatialModel tool = tool_beam(three_steps, {"tip", "", "", "root"}, Vector3d::UnitZ(), 0.01);
  EXPECT_EQ(tool.size(), 24);
  ASSERT_EQ(tool.dofs.size(), 12U);
  EXPECT_EQ(dynamics::name(tool.dofs[0]), "tip.x");
  EXPECT_EQ(dynamics::name(tool.dofs[10]), "root.ry");
  EXPECT_NO_THROW(dynamics::require_consistent(tool));
  EXPECT_TRUE(tool.D.isApprox(0.01 * tool.K, 1e-15));
  // The receptance of a model with one named node equals that of the model with all nodes named.
  const SpatialModel all = tool_beam(three_steps, {"tip", "a", "b", "root"}, Vector3d::UnitZ(), 0.01);
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(100.0, 5000.0, 5);
  const auto few = dynamics::direct_response(tool, axis), many = dynamics::direct_response(all, axis);
  for (const char* force : {"tip.x", "root.ry"}) {
    const Eigen::VectorXcd found = dynamics::entry(few, "tip.x", force);
    EXPECT_LT((found - dynamics::entry(many, "tip.x", force)).norm(), 1e-12 * found.norm());
  }
}

// ω = (k π/L) c with c² = E/ρ, G/ρ of a bar with free ends; linear shapes err by (kh)²/24.
TEST(RoundBar, StretchesAndTwistsAtItsWaveSpeeds) {
  const double L = 0.3;
  for (const int elements : {10, 20}) {
    const SpatialModel bar = tool_beam({{L, {0.002, 0.0, E, nu, rho}, elements}}, {"a", "b"}, Vector3d::UnitX());
    const dynamics::UndampedModes modes = dynamics::undamped_modes(bar);
    const VectorXd axial = bar.T.row(0) * modes.Phi, torsion = bar.T.row(3) * modes.Phi;
    const auto first = [&](const VectorXd& at_a) {
      for (Eigen::Index k = 6; k < at_a.size(); ++k) {
        if (std::abs(at_a(k)) > 0.5 * at_a.cwiseAbs().maxCoeff()) return modes.omega_rad_s(k);
      }
      return 0.0;
    };
    const double predicted = std::pow(pi / elements, 2.0) / 24.0;
    EXPECT_NEAR((first(axial) / (pi / L * std::sqrt(E / rho)) - 1.0) / predicted, 1.0, 0.02) << elements;
    EXPECT_NEAR((first(torsion) / (pi / L * std::sqrt(G / rho)) - 1.0) / predicted, 1.0, 0.02) << elements;
  }
}

/// Two unlike bars at an angle, a body off its node, a spring to a distant node, a hinge that gives.
BeamFrame crooked(const Eigen::Matrix3d& R) {
  BeamSection s = round_bar(0.05);
  s.I_y_m4 *= 3.0;
  s.shear_z *= 0.7;
  const Matrix6 turned = dynamics::turned(R);
  BeamFrame frame{
      .nodes = {{R * Vector3d(0.1, 0.2, 0.3), "P"},
                {R * Vector3d(0.5, -0.2, 0.4)},
                {R * Vector3d(0.5, -0.2, 0.4)},
                {R * Vector3d(0.6, 0.3, 0.9), "Q"}},
      .segments = {{0, 1, s, 2, R * Vector3d(0.1, 0.1, 1.0)}, {2, 3, round_bar(0.04, 0.02), 2}},
      .bodies = {{3,
                  {4.0, R * Vector3d(0.05, 0.02, 0.1), R * Vector3d(0.03, 0.04, 0.05).asDiagonal() * R.transpose()}}},
      .springs = {},
      .hinges = {{1, 2, R * Vector3d(0.6, 0.0, 0.8), 4e4, 3.0}}};
  Eigen::Vector<double, 6> k;
  k << 1e6, 2e6, 5e5, 1e4, 2e4, 3e4;
  frame.springs.push_back({.node = 3, .other = 0, .stiffness = turned * k.asDiagonal() * turned.transpose()});
  return frame;
}

TEST(Frame, HasTheSameFrequenciesHoweverItIsTurned) {
  const Eigen::Matrix3d R = Eigen::AngleAxisd(1.1, Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const SpatialModel straight = spatial_model(crooked(Eigen::Matrix3d::Identity()));
  const SpatialModel turned = spatial_model(crooked(R));
  const VectorXd a = omega(straight), b = omega(turned);
  EXPECT_EQ((a.array() == 0.0).count(), 6) << "a spring between distant nodes bears no rigid motion";
  EXPECT_LT((b - a).cwiseAbs().maxCoeff(), 1e-10 * a.maxCoeff());
  for (Eigen::Index k = 6; k < 12; ++k) EXPECT_NEAR(b(k) / a(k), 1.0, 1e-9);
  const dynamics::FrequencyAxis axis = dynamics::linear_axis(20.0, 900.0, 3);
  MatrixXd both = MatrixXd::Zero(12, 12);
  both.topLeftCorner<6, 6>() = both.bottomRightCorner<6, 6>() = dynamics::turned(R);
  const auto H = dynamics::direct_response(straight, axis).H, H_turned = dynamics::direct_response(turned, axis).H;
  for (std::size_t line = 0; line < H.size(); ++line)
    EXPECT_LT((both * H[line] * both.transpose() - H_turned[line]).norm(), 1e-8 * H[line].norm());
}

// ---- refusals ----------------------------------------------------------------------------------------------------

TEST(ToolBeam, ThatCannotBeIsRefused) {
  const Tube tube{0.02, 0.0, E, nu, rho};
  const auto refused = [](const CylinderStep& step) {
    EXPECT_THROW((void)tool_beam({step}, {"tip", "root"}, Vector3d::UnitZ()), core::InputError);
  };
  refused({0.0, tube});
  refused({-0.1, tube});
  refused({std::nan(""), tube});
  refused({0.1, {0.02, 0.02, E, nu, rho}});
  refused({0.1, {0.02, 0.0, E, 0.5, rho}});
  refused({0.1, tube, 0});
  EXPECT_THROW((void)tool_beam({}, {"tip"}, Vector3d::UnitZ()), core::InputError);
  EXPECT_THROW((void)tool_beam({{0.1, tube}}, {"tip"}, Vector3d::UnitZ()), core::InputError);
  EXPECT_THROW((void)tool_beam({{0.1, tube}}, {"tip", "tip"}, Vector3d::UnitZ()), core::InputError);
  EXPECT_THROW((void)tool_beam({{0.1, tube}}, {"", ""}, Vector3d::UnitZ()), core::InputError);
  EXPECT_THROW((void)tool_beam({{0.1, tube}}, {"tip", "root"}, Vector3d(0, 0, 2)), core::InputError);
  EXPECT_THROW((void)tool_beam({{0.1, tube}}, {"tip", "root"}, Vector3d::UnitZ(), -0.1), core::InputError);
  EXPECT_THROW((void)tool_beam({{0.1, tube}}, {"tip", "root"}, Vector3d::UnitZ(), std::nan("")), core::InputError);
}

TEST(Frame, ThatCannotBeIsRefusedWithAllItsFaults) {
  const BeamSection s = round_bar(0.02);
  BeamFrame frame = cantilever(s, 0.5, 1);
  frame.nodes.push_back({{1.0, 0.0, 0.0}, "loose"});
  frame.bodies = {{7, {1.0}}, {1, {-1.0}}};
  frame.springs = {{.node = 1, .stiffness = -Matrix6::Identity()}};
  frame.hinges = {{0, 1, Vector3d::UnitZ()}};
  try {
    (void)spatial_model(frame);
    FAIL();
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    for (const char* words : {"node 3 (loose) carries no mass", "body 1 is at node 8 of 3", "body 2 has the mass",
                              "spring 1 has a stiffness", "hinge 1 has the distance"})
      EXPECT_NE(text.find(words), std::string::npos) << words << " in " << text;
  }
  BeamFrame flat = cantilever(s, 0.5, 1);
  flat.segments[0].section.I_y_m4 *= 2.0;
  EXPECT_THROW((void)spatial_model(flat), core::InputError) << "whose y axis?";
  flat.segments[0].y = Vector3d::UnitX();
  EXPECT_THROW((void)spatial_model(flat), core::InputError) << "along the beam";
  flat.segments[0].y = Vector3d::UnitY();
  EXPECT_NO_THROW((void)spatial_model(flat));
  BeamFrame held = cantilever(s, 0.5, 1);
  held.nodes[1].clamped = true;
  EXPECT_THROW((void)spatial_model(held), core::InputError);
  BeamFrame nowhere = cantilever(s, 0.5, 1);
  nowhere.nodes[1].position_m.x() = std::nan("");
  EXPECT_THROW((void)spatial_model(nowhere), core::InputError);
  BeamFrame none = cantilever(s, 0.0, 1);
  EXPECT_THROW((void)spatial_model(none), core::InputError);
}

}  // namespace
}  // namespace thinwall::fem::beam_test
