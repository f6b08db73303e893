#include "reduction/trust/truncation.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "tests/reduction/solid_part.hpp"

namespace thinwall::reduction::truncation_test {
namespace {

using Eigen::MatrixXd;

constexpr double pi = std::numbers::pi;

/// A clamped block with two patches and all modes of its inside.
struct Part {
  fem::Model model = block({0.3, 0.2, 0.1}, {2, 2, 1}, 2, true);
  Interface interface = interface_at(model, {{"P", {0.3, 0.11, 0.05}, 0.03, xyz}, {"Q", {0.1, 0.2, 0.05}, 0.02, xyz}});
  StaticInverse inverse{model.K, model.node_of_row};
  linalg::Eigenpairs inner = linalg::dense_eigenpairs(model.K, model.M, interface.W);

  [[nodiscard]] CraigBampton reduced(int modes) const {
    return craig_bampton(model.K, model.M, inverse.action(), interface, {.modes = modes, .up_to_hz = {}});
  }
  [[nodiscard]] Truncation left_out(const CraigBampton& model_reduced) const {
    return truncation(model_reduced, model.M, inverse.action(), interface);
  }
  [[nodiscard]] MatrixXd full_receptance(double omega) const {
    const MatrixXd W = interface.W;
    return W.transpose() * (MatrixXd(model.K) - omega * omega * MatrixXd(model.M)).partialPivLu().solve(W);
  }
};

MatrixXd receptance(const dynamics::SpatialModel& model, double omega, Eigen::Index interface) {
  return (model.K - omega * omega * model.M).partialPivLu().inverse().topLeftCorner(interface, interface);
}

Eigen::VectorXd frequencies(const dynamics::SpatialModel& model) {
  return dynamics::undamped_modes(model).omega_rad_s;
}

TEST(Truncation, IsTheSumOverTheModesThatWereLeftOut) {
  const Part part;
  for (const int kept : {0, 5, 20}) {
    const CraigBampton reduced = part.reduced(kept);
    const MatrixXd L = reduced.T.leftCols(6).transpose() * part.model.M * part.inner.Phi;
    const Eigen::Index out = part.inner.lambda.size() - kept;
    const Eigen::VectorXd lambda = part.inner.lambda.tail(out);
    const MatrixXd Lo = L.rightCols(out);
    const MatrixXd A = Lo * lambda.cwiseInverse().asDiagonal() * Lo.transpose();
    const MatrixXd B = Lo * lambda.cwiseAbs2().cwiseInverse().asDiagonal() * Lo.transpose();
    const Truncation found = part.left_out(reduced);
    EXPECT_LT((found.A - A).norm(), 1e-9 * A.norm()) << kept;
    EXPECT_LT((found.B - B).norm(), 1e-9 * B.norm()) << kept;
  }
}

TEST(Truncation, TellsTheErrorOfAReceptanceWithoutTheFullModel) {
  const Part part;
  for (const int kept : {3, 10, 30}) {
    const CraigBampton reduced = part.reduced(kept);
    const dynamics::SpatialModel better = with_left_out(reduced.model, part.left_out(reduced));
    const double first_left_out = std::sqrt(part.inner.lambda(kept));
    double worst = 0.0;
    for (const double share : {0.05, 0.13, 0.21, 0.3, 0.4, 0.5}) {
      const double omega = share * first_left_out;
      const MatrixXd H = receptance(reduced.model, omega, 6);
      const MatrixXd truth = H - part.full_receptance(omega), estimate = H - receptance(better, omega, 6);
      // The first two moments are right, so the estimate lacks the fourth power of the share, and round-off of H.
      const double off = (estimate - truth).norm() - 1e-10 * H.norm();
      EXPECT_LT(off, 2.0 * std::pow(share, 4) * truth.norm()) << kept << " modes, " << share;
      worst = std::max(worst, off / truth.norm());
    }
    std::printf("%2d modes kept: error of the receptance known to %.1f %% up to half the first frequency left out\n",
                kept, 100.0 * worst);
  }
}

TEST(Truncation, AddsARitzModelBetweenTheReducedAndTheFull) {
  const Part part;
  const Eigen::VectorXd full = frequencies(dense(part.model.K, part.model.M)).head(6);
  const CraigBampton reduced = part.reduced(8);
  const Eigen::VectorXd before = frequencies(reduced.model).head(6);
  const dynamics::SpatialModel better = with_left_out(reduced.model, part.left_out(reduced));
  const Eigen::VectorXd after = frequencies(better).head(6);
  EXPECT_EQ(better.size(), reduced.model.size() + 6);
  for (Eigen::Index k = 0; k < 6; ++k) {
    EXPECT_LT(after(k), before(k)) << k;
    EXPECT_GT(after(k), full(k) * (1.0 - 1e-10)) << k;
    EXPECT_LT(after(k) - full(k), 0.1 * (before(k) - full(k))) << k;
  }
  EXPECT_LT((receptance(better, 0.0, 6) - receptance(reduced.model, 0.0, 6)).norm(),
            1e-12 * receptance(better, 0.0, 6).norm())
      << "statics were right before";
}

TEST(Truncation, OfAFreePartIsSeenThroughItsInterface) {
  const fem::Model model = block({0.3, 0.2, 0.1}, {2, 2, 1}, 2, false);
  const Interface interface = interface_at(
      model, {{"P", {0.3, 0.0, 0.0}, 0.03, xyz}, {"Q", {0.0, 0.2, 0.0}, 0.03, xyz}, {"R", {0.0, 0.0, 0.1}, 0.03, xyz}});
  const StaticInverse inverse(restrained(model.K, interface), model.node_of_row);
  const CraigBampton reduced =
      craig_bampton(model.K, model.M, inverse.action(), interface, {.modes = 10, .up_to_hz = {}});
  const dynamics::SpatialModel better =
      with_left_out(reduced.model, truncation(reduced, model.M, inverse.action(), interface));
  const double omega = 2.0 * pi * 0.4 * reduced.fixed_interface_hz(9);
  const MatrixXd W = interface.W;
  const MatrixXd full = W.transpose() * (MatrixXd(model.K) - omega * omega * MatrixXd(model.M)).partialPivLu().solve(W);
  const MatrixXd H = receptance(reduced.model, omega, 9);
  EXPECT_LT((receptance(better, omega, 9) - full).norm(), 0.05 * (H - full).norm());
}

TEST(Truncation, OfAllModesIsNothing) {
  const Part part;
  const int all = static_cast<int>(part.inner.lambda.size());
  const CraigBampton reduced = part.reduced(all);
  EXPECT_EQ(with_left_out(reduced.model, part.left_out(reduced)).size(), reduced.model.size());
}

TEST(Truncation, OfAnotherModelIsRefused) {
  const Part part;
  const CraigBampton reduced = part.reduced(4);
  Truncation other = part.left_out(reduced);
  other.B.resize(3, 3);
  EXPECT_THROW((void)with_left_out(reduced.model, other), core::InputError);
  const Interface one = interface_at(part.model, {{"P", {0.3, 0.11, 0.05}, 0.03, xyz}});
  EXPECT_THROW((void)truncation(reduced, part.model.M, part.inverse.action(), one), core::InputError);
}

}  // namespace
}  // namespace thinwall::reduction::truncation_test
