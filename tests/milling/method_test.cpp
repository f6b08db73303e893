// The parts of the semi-discretization: structure, step, eigenvalue, and its order.

#include <gtest/gtest.h>

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "core/error.hpp"
#include "milling/dominant_eigenvalue.hpp"
#include "milling/semi_discretization.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling {
namespace {

using testing::modal_model;

const std::vector<testing::Mode> three_modes{{212.0, 0.01, 0.5, Eigen::Vector3d(1.0, 0.2, 0.1)},
                                             {567.0, 0.02, 0.3, Eigen::Vector3d(0.8, -0.3, 0.0)},
                                             {1800.0, 0.01, 0.2, Eigen::Vector3d(0.5, 0.9, 0.4)}};

MillingProcess wall_cut() {
  MillingProcess process;
  process.cutter = {6, 0.016};
  process.coefficients = {2e9, 0.8e9, 0.3e9, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.2e-3, MillingDirection::down);
  return process;
}

Eigen::MatrixXd state_matrix(const ContactState& state) {
  const Eigen::Index n = state.decay.size();
  Eigen::MatrixXd Lambda = Eigen::MatrixXd::Zero(state.size(), state.size());
  Lambda.topLeftCorner(n, n).diagonal() = state.decay;
  Lambda.block(n, n, n, n).diagonal() = state.decay;
  Lambda.topRightCorner(state.size(), state.size() - n).leftCols(n).topRows(n).diagonal() = -state.frequency;
  Lambda.block(n, 0, n, n).diagonal() = state.frequency;
  return Lambda;
}

TEST(RelativeStructure, ReceptanceIsThatOfTheOscillator) {
  const RelativeStructure s =
      relative_structure(modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d(0.6, 0.8, 0.0)}}), "P");
  const double w0 = 2.0 * std::numbers::pi * 100.0;
  const double w = 700.0;
  const std::complex<double> h = 1.0 / (2.0 * std::complex<double>(w0 * w0 - w * w, 2.0 * 0.03 * w0 * w));
  EXPECT_LT(std::abs(receptance(s, w)(0, 1) - 0.48 * h), 1e-12 * std::abs(h));
}

TEST(RelativeStructure, PartAndToolReceptancesAdd) {
  const RelativeStructure part = relative_structure(modal_model(three_modes), "P");
  const RelativeStructure tool = relative_structure(modal_model({three_modes[1]}), "P");
  const Eigen::Matrix3cd G = receptance(part, 3000.0) + receptance(tool, 3000.0);
  EXPECT_LT((receptance(sum(part, tool), 3000.0) - G).norm(), 1e-14 * G.norm());
}

TEST(RelativeStructure, SaysWhatShareOfTheComplianceIsLeftOut) {
  dynamics::ModalModel model = modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d::UnitX()}});
  EXPECT_EQ(residual_share(relative_structure(model, "P")), 0.0);
  const double static_compliance = 1.0 / (2.0 * std::pow(2.0 * std::numbers::pi * 100.0, 2));
  model.residual = Eigen::Matrix3d::Zero();
  model.residual(0, 0) = static_compliance / 3.0;
  EXPECT_NEAR(residual_share(relative_structure(model, "P")), 0.25, 1e-12);
}

TEST(RelativeStructure, RefusesWhatDoesNotDecayOrIsNotPaired) {
  dynamics::ModalModel model = modal_model(three_modes);
  EXPECT_THROW((void)relative_structure(model, "Q"), core::InputError);
  dynamics::ModalModel undamped = model;
  undamped.poles(0).real(0.0);
  EXPECT_THROW((void)relative_structure(undamped, "P"), core::InputError);
  dynamics::ModalModel unpaired = model;
  unpaired.poles(1) = unpaired.poles(3);
  EXPECT_THROW((void)relative_structure(unpaired, "P"), core::InputError);
  dynamics::ModalModel broken = model;
  broken.right(0, 0) = std::nan("");
  EXPECT_THROW((void)relative_structure(broken, "P"), core::DataError);
}

TEST(ContactState, ReproducesTheInPlaneReceptance) {
  const RelativeStructure s = relative_structure(modal_model(three_modes), "P");
  const ToolFrame frame{Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  const ContactState state = contact_state(s, frame);
  const std::complex<double> i_omega(0.0, 2500.0);
  const Eigen::MatrixXcd resolvent =
      (i_omega * Eigen::MatrixXcd::Identity(state.size(), state.size()) - state_matrix(state)).inverse();
  const Eigen::MatrixXcd found = state.in_plane * state.C * resolvent * state.B;
  const Eigen::MatrixXcd expected =
      frame.rotation().leftCols<2>().transpose() * receptance(s, 2500.0) * frame.rotation();
  EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm());
}

TEST(ContactState, FollowsOnlyTheDirectionsThatMove) {
  const RelativeStructure s = relative_structure(modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d(1, 1, 0)}}), "P");
  EXPECT_EQ(contact_state(s, {}).directions(), 1);
  const RelativeStructure axial = relative_structure(modal_model({{100.0, 0.03, 2.0, Eigen::Vector3d::UnitZ()}}), "P");
  EXPECT_THROW((void)contact_state(axial, {}), core::InputError);
}

// x' = L x + U d(t), d linear from d0 to d1, by the exponential of the augmented matrix (Van Loan 1978).
Eigen::VectorXd step_by_matrix_exponential(const ContactState& state, const Eigen::MatrixXd& D, double depth, double dt,
                                           const Eigen::VectorXd& x, const Eigen::VectorXd& d0,
                                           const Eigen::VectorXd& d1) {
  const Eigen::Index n = state.size();
  const Eigen::Index p = state.directions();
  const Eigen::MatrixXd U = depth * state.B * D;
  Eigen::MatrixXd Z = Eigen::MatrixXd::Zero(n + 2 * p, n + 2 * p);
  Z.topLeftCorner(n, n) = state_matrix(state) - U * state.C;
  Z.block(0, n, n, p) = U;
  Z.block(n, n + p, p, p).setIdentity();
  Eigen::VectorXd v(n + 2 * p);
  v << x, d0, (d1 - d0) / dt;
  return ((Z * dt).exp() * v).head(n);
}

TEST(CutStep, EqualsTheExponentialOfTheCurrentStateMatrix) {
  const ContactState state = contact_state(relative_structure(modal_model(three_modes), "P"), {});
  const MillingProcess process = wall_cut();
  for (const double dt : {5e-5, 2e-4, 4e-4}) {
    const Eigen::MatrixXd D =
        directional_matrix(process.coefficients, process.engagement.entry_rad + 0.1) * Eigen::MatrixXd(state.in_plane);
    const double depth = 5e-3;
    // The step's fastest rate: the highest pole and the contact, √(w ‖D‖ Σ 1/m).
    const double rate = std::hypot(2.0 * std::numbers::pi * 1800.0, std::sqrt(depth * D.norm() * 10.0));
    const CutStep step = cut_step(state, dt, nodes_of_step(rate * dt));
    const Eigen::Index n = step.node.size();
    const Eigen::Index p = state.directions();
    const Eigen::VectorXd x0 = Eigen::VectorXd::LinSpaced(state.size(), -1.0, 2.0);
    const Eigen::VectorXd d0 = Eigen::Vector2d(0.4, -0.3);
    const Eigen::VectorXd d1 = Eigen::Vector2d(-0.2, 0.9);
    Eigen::MatrixXd system = Eigen::MatrixXd::Identity(p * n, p * n);
    Eigen::VectorXd rhs = step.E * x0;
    for (Eigen::Index j = 0; j < n; ++j) {
      system.middleCols(p * j, p) += depth * step.K.middleCols(3 * j, 3) * D;
      rhs.segment(p * j, p) -= (1.0 - step.node(j)) * d0 + step.node(j) * d1;
    }
    const Eigen::VectorXd y = system.partialPivLu().solve(rhs);
    Eigen::VectorXd g(3 * n);
    for (Eigen::Index j = 0; j < n; ++j) g.segment(3 * j, 3) = D * y.segment(p * j, p);
    Eigen::VectorXd x = x0;
    advance(step.flight, x);
    x -= depth * step.L * g;
    const Eigen::VectorXd exact = step_by_matrix_exponential(state, D, depth, dt, x0, d0, d1);
    EXPECT_LT((x - exact).norm(), 1e-8 * exact.norm()) << "step " << dt << " s, " << n << " nodes";
  }
}

TEST(ToothPeriodMap, WithoutDepthTheMultiplierIsTheSlowestFreeDecay) {
  const ContactState state = contact_state(relative_structure(modal_model(three_modes), "P"), {});
  const MillingProcess process = wall_cut();
  ToothPeriodMap map(state, process, 1900.0, {10, 1}, 2e4);
  map.set_depth(0.0);
  const auto eigen = dominant_eigenvalue([&](const auto& in, auto out) { map.apply(in, out); }, map.size(), 1e-10);
  ASSERT_TRUE(eigen.converged);
  const double slowest = 0.01 * 2.0 * std::numbers::pi * 212.0;
  EXPECT_NEAR(std::abs(eigen.value), std::exp(-slowest * tooth_period_s(process.cutter, 1900.0)), 1e-10);
}

TEST(ToothPeriodMap, RefusesTeethThatItWouldTakeForEqualOnes) {
  const ContactState state = contact_state(relative_structure(modal_model(three_modes), "P"), {});
  MillingProcess process = wall_cut();
  process.cutter.helices_rad.assign(6, 0.5);
  EXPECT_THROW(ToothPeriodMap(state, process, 1900.0, {10, 1}, 2e4), core::InputError);
  process.cutter.helices_rad.clear();
  process.cutter.pitches_rad = {1.0, 1.0, 1.0, 1.0, 1.0, 2.0 * std::numbers::pi - 5.0};
  EXPECT_THROW(ToothPeriodMap(state, process, 1900.0, {10, 1}, 2e4), core::InputError);
}

TEST(ToothPeriodMap, ConvergesWithTheSecondOrderOfTheMethod) {
  const ContactState state = contact_state(relative_structure(modal_model(three_modes), "P"), {});
  MillingProcess process = wall_cut();
  // A short cut, and one with two and three teeth in turn.
  for (const double radial : {0.2e-3, 9e-3}) {
    process.engagement = engagement_of(process.cutter, radial, MillingDirection::down);
    std::vector<double> modulus;
    for (const int division : {1, 2, 4, 8}) {
      ToothPeriodMap map(state, process, 3000.0, {16, division}, 2e4);
      map.set_depth(2e-4);
      modulus.push_back(std::abs(
          dominant_eigenvalue([&](const auto& in, auto out) { map.apply(in, out); }, map.size(), 1e-11).value));
    }
    const double order = std::log2((modulus[1] - modulus[2]) / (modulus[2] - modulus[3]));
    EXPECT_NEAR(order, 2.0, 0.1) << "radial depth " << radial;
  }
}

TEST(DominantEigenvalue, KrylovAndDenseAgreeOnTheSameMap) {
  const ContactState state = contact_state(relative_structure(modal_model(three_modes), "P"), {});
  const MillingProcess process = wall_cut();
  for (const double depth : {1e-4, 1e-3, 5e-3, 2e-2}) {
    ToothPeriodMap map(state, process, 1500.0, {40, 1}, 2e4);
    map.set_depth(depth);
    const LinearMap apply = [&](const auto& in, auto out) { map.apply(in, out); };
    const auto dense = dominant_eigenvalue_dense(apply, map.size(), 1e-8);
    const auto krylov = dominant_eigenvalue_arnoldi(apply, map.size(), 1e-8);
    ASSERT_TRUE(dense.converged && krylov.converged);
    EXPECT_LT(std::abs(dense.value - krylov.value), 1e-7 * std::abs(dense.value)) << depth;
    Eigen::VectorXd re(map.size());
    Eigen::VectorXd im(map.size());
    map.apply(krylov.vector.real(), re);
    map.apply(krylov.vector.imag(), im);
    const Eigen::VectorXcd image = re.cast<std::complex<double>>() + std::complex<double>(0, 1) * im;
    EXPECT_LT((image - krylov.value * krylov.vector).norm(), 2e-8 * std::abs(krylov.value) * krylov.vector.norm());
  }
}

TEST(DominantEigenvalue, SaysSoWhenItDoesNotConverge) {
  // A shift has every root of unity for an eigenvalue: no basis short of the whole space can tell which is largest.
  const LinearMap shift = [](const auto& in, auto out) {
    out.head(in.size() - 1) = in.tail(in.size() - 1);
    out(in.size() - 1) = in(0);
  };
  EXPECT_FALSE(dominant_eigenvalue_arnoldi(shift, 1000, 1e-10).converged);
}

}  // namespace
}  // namespace thinwall::milling
