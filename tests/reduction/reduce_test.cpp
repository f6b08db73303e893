#include "reduction/methods/reduce.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "reduction/methods/free_interface.hpp"
#include "reduction/methods/static_flexibility.hpp"
#include "reduction/trust/band.hpp"
#include "reduction/trust/comparison.hpp"
#include "tests/reduction/reducible_part.hpp"

namespace thinwall::reduction::reduce_test {
namespace {

using Eigen::MatrixXcd;
using Eigen::MatrixXd;

/// The number of elastic modes that makes a method complete.
int all_modes(Method method, const Reducible& part) {
  const auto inner = part.full.K.rows() - part.interface.W.cols();
  return static_cast<int>(holds_the_interface(method) ? inner : part.full.K.rows() - part.full.rigid.cols());
}

MatrixXcd direct(const Reducible& part, std::complex<double> z) {
  const MatrixXcd W = MatrixXd(part.interface.W).cast<std::complex<double>>();
  const MatrixXcd Z = MatrixXd(part.full.K).cast<std::complex<double>>() - z * MatrixXd(part.full.M);
  return W.transpose() * Z.partialPivLu().solve(W);
}

TEST(Reduce, EveryMethodWithAllModesKeptIsTheFullModel) {
  for (const bool held : {true, false}) {
    const Reducible part = small_part(held);
    const Band band{200.0, 20000.0, 7, 0.02};
    for (const Method method : all_methods()) {
      if (method == Method::guyan || (method == Method::modal_truncation && !held)) continue;
      const Reduction all =
          reduce(method, part.full, part.interface,
                 {.modes = all_modes(method, part), .characteristic = static_cast<int>(part.interface.W.cols())});
      double worst = 0.0;
      for (const auto z : squares(band, {})) {
        const MatrixXcd expected = direct(part, z);
        const MatrixXcd found = receptance_at(all.model, expected.rows(), z);
        worst = std::max(worst, (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff());
      }
      std::printf("%-5s %-31s %3d modes of %3td rows: receptances within %.1e\n", held ? "held" : "free",
                  name(method).c_str(), all.modes, part.full.K.rows(), worst);
      EXPECT_LT(worst, 1e-9) << name(method);
    }
  }
}

TEST(Reduce, GuyanWithEveryDofKeptIsTheFullModel) {
  Reducible part = small_part(true);
  part.interface = every_row(part.full);
  const Reduction all = reduce(Method::guyan, part.full, part.interface);
  const auto& model = std::get<dynamics::SpatialModel>(all.model);
  EXPECT_LT((model.K - MatrixXd(part.full.K)).cwiseAbs().maxCoeff(), 1e-9 * model.K.cwiseAbs().maxCoeff());
  EXPECT_LT((model.M - MatrixXd(part.full.M)).cwiseAbs().maxCoeff(), 1e-9 * model.M.cwiseAbs().maxCoeff());
}

/// Rubin's interface coordinates exist as long as the modes leave something out everywhere.
TEST(Reduce, FreeInterfaceModelsHaveTheInterfaceAsCoordinates) {
  const Reducible part = small_part(false);
  for (const Method method : {Method::rubin, Method::macneal, Method::dual_craig_bampton}) {
    const Reduction reduced = reduce(method, part.full, part.interface, {.modes = 10});
    const auto& model = std::get<dynamics::SpatialModel>(reduced.model);
    EXPECT_FALSE(model.has_own_coordinates()) << name(method);
    EXPECT_EQ(dynamics::name(model.dofs[3]), dynamics::name(part.interface.dofs[3]));
    EXPECT_EQ(dynamics::name(model.dofs[static_cast<std::size_t>(part.interface.W.cols())]), "mode 1");
    dynamics::require_consistent(model);
  }
}

TEST(Reduce, RubinAndCraigChangAnswerAlikeAndDualCraigBamptonToTheFirstOrder) {
  for (const bool held : {true, false}) {
    const Reducible part = small_part(held);
    const auto model = [&](Method method) { return reduce(method, part.full, part.interface, {.modes = 10}).model; };
    const auto rubin = model(Method::rubin), chang = model(Method::craig_chang),
               dual = model(Method::dual_craig_bampton), macneal = model(Method::macneal);
    const Eigen::Index nb = part.interface.W.cols();
    // H_dual − H_rubin = O(z²), H_macneal − H_rubin = O(z): halving z quarters the one and halves the other.
    double before_dual = 0.0, before_macneal = 0.0;
    for (const double hz : {2000.0, 2000.0 / std::sqrt(2.0)}) {
      const double z = std::pow(2.0 * std::numbers::pi * hz, 2);
      const MatrixXcd H = receptance_at(rubin, nb, z);
      EXPECT_LT((receptance_at(chang, nb, z) - H).norm(), 1e-9 * H.norm());
      const double off_dual = (receptance_at(dual, nb, z) - H).norm();
      const double off_macneal = (receptance_at(macneal, nb, z) - H).norm();
      if (before_dual > 0.0) {
        EXPECT_NEAR(before_dual / off_dual, 4.0, 0.2);
        EXPECT_NEAR(before_macneal / off_macneal, 2.0, 0.1);
      }
      before_dual = off_dual;
      before_macneal = off_macneal;
    }
  }
}

TEST(Reduce, LanczosOnTheElasticFlexibilityOfAFreePartFindsItsModes) {
  const Reducible part = larger_part(false);
  ASSERT_GT(part.full.K.rows(), 600) << "or the small path is taken";
  const StaticFlexibility flexibility(part.full);
  const PartModes modes = free_modes(part.full, flexibility, 10);
  const auto expected =
      linalg::dense_eigenpairs(part.full.K, part.full.M, MatrixXd(part.full.M * flexibility.rigid_modes()));
  ASSERT_EQ(modes.lambda.size(), 16);
  EXPECT_EQ(modes.lambda.head(6).norm(), 0.0);
  for (Eigen::Index k = 0; k < 10; ++k) EXPECT_NEAR(modes.lambda(6 + k) / expected.lambda(k), 1.0, 1e-9) << k;
  const MatrixXd gram = modes.Phi.transpose() * (part.full.M * modes.Phi);
  EXPECT_LT((gram - MatrixXd::Identity(16, 16)).cwiseAbs().maxCoeff(), 1e-8);
}

TEST(StaticFlexibility, OfAFreePartIsTheSumOverItsElasticModes) {
  const Reducible part = small_part(false);
  const StaticFlexibility flexibility(part.full);
  const auto elastic =
      linalg::dense_eigenpairs(part.full.K, part.full.M, MatrixXd(part.full.M * flexibility.rigid_modes()));
  const MatrixXd seen = part.interface.W.transpose() * elastic.Phi;
  const MatrixXd expected = seen * elastic.lambda.cwiseInverse().asDiagonal() * seen.transpose();
  const MatrixXd found = part.interface.W.transpose() * flexibility.action().apply(MatrixXd(part.interface.W));
  EXPECT_LT((found - expected).norm(), 1e-9 * expected.norm());
}

TEST(RigidBodyModes, AreFoundFromTheMatricesAlone) {
  EXPECT_EQ(
      rigid_body_modes(small_part(true).full.K, small_part(true).full.M, small_part(true).full.node_of_row).cols(), 0);
  for (const Reducible& part : {small_part(false), larger_part(false)}) {
    const MatrixXd found = rigid_body_modes(part.full.K, part.full.M, part.full.node_of_row);
    ASSERT_EQ(found.cols(), 6);
    const MatrixXd expected = StaticFlexibility(part.full).rigid_modes();
    // Two M-orthonormal bases of one space: their products are orthogonal.
    const MatrixXd product = expected.transpose() * (part.full.M * found);
    EXPECT_LT((product * product.transpose() - MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-6);
  }
}

/// All methods at one size, over a band up to a share of the last mode that Rubin's model keeps.
std::vector<ComparisonRow> side_by_side(bool held, double share) {
  const Reducible part = larger_part(held);
  const int size = 40, modes = modes_for_size(Method::rubin, size, 9, held ? 0 : 6, 9);
  const PartModes kept = free_modes(part.full, StaticFlexibility(part.full), modes);
  const double last = std::sqrt(kept.lambda.tail(1)(0)) / (2 * std::numbers::pi);
  const Band band{0.05 * last, share * last, 100, 0.02};
  auto rows = compare(part.full, part.interface, band, size);
  std::printf("%s part of %td rows, %td interface DOFs, %.0f to %.0f Hz, %.1f of the last mode's frequency\n%s",
              held ? "held" : "free", part.full.K.rows(), part.interface.W.cols(), band.from_hz, band.to_hz, share,
              text(rows).c_str());
  EXPECT_EQ(rows.size(), held ? 8U : 7U);
  return rows;
}

/// Rubin, Craig-Chang and dual Craig-Bampton err in the second order of ω² over the first λ left out, MacNeal in the
/// first: a band to nearly the last mode kept holds them together, in a lower one MacNeal must stay behind.
TEST(Comparison, FreeInterfaceMethodsAtEqualSizeAreWithinTenTimesTheBest) {
  for (const bool held : {true, false}) {
    for (const double share : {0.9, 0.5}) {
      const auto rows = side_by_side(held, share);
      double best = 1e9;
      for (const auto& row : rows) best = std::min(best, row.max_relative_receptance_error);
      for (const auto& row : rows) {
        EXPECT_EQ(row.status, linalg::EigenStatus::converged);
        EXPECT_EQ(row.size, row.method == Method::guyan ? 9 : 40) << name(row.method);
        const bool second_order = row.method == Method::rubin || row.method == Method::craig_chang ||
                                  row.method == Method::dual_craig_bampton;
        if (!second_order && row.method != Method::macneal) continue;
        EXPECT_LT(row.max_relative_frequency_error, 1e-8) << name(row.method) << ": the modes kept are exact";
        const double bar = second_order || share > 0.5 ? 10.0 : 30.0;
        EXPECT_LE(row.max_relative_receptance_error, bar * best) << name(row.method) << " " << share;
      }
    }
  }
}

/// A line of nine nodes: all 27 amplitudes are Craig-Bampton, fewer a Ritz model in it, whose frequencies fall towards
/// Craig-Bampton's as amplitudes are added.
TEST(CharacteristicConstraintModes, OfALineOfPointsFallTowardsCraigBamptonFromAbove) {
  const fem::Model model = block({0.3, 0.2, 0.03}, {6, 4, 1}, 2, true);
  std::vector<fem::NamedPoint> line;
  for (int i = 0; i <= 8; ++i) line.push_back({"L" + std::to_string(i), {0.3, 0.025 * i, 0.03}, 0.0, xyz});
  const Reducible part = reducible(model, line);
  const auto hz = [&](Method method, int characteristic) -> Eigen::VectorXd {
    const Reduction reduced =
        reduce(method, part.full, part.interface, {.modes = 20, .characteristic = characteristic});
    return natural_frequencies_hz(reduced.model, 0, 2000.0).head(4);
  };
  const Eigen::VectorXd whole = hz(Method::craig_bampton, 1);
  Eigen::VectorXd before = Eigen::VectorXd::Constant(4, 1e12);
  for (const int amplitudes : {2, 4, 8, 16, 27}) {
    const Eigen::VectorXd found = hz(Method::characteristic_constraint_modes, amplitudes);
    EXPECT_TRUE((found.array() <= before.array() * (1.0 + 1e-9)).all()) << amplitudes;
    EXPECT_TRUE((found.array() >= whole.array() * (1.0 - 1e-9)).all()) << amplitudes;
    std::printf("line of 27 DOFs, %2d amplitudes: four frequencies within %.1e of Craig-Bampton's\n", amplitudes,
                (found.array() / whole.array() - 1.0).abs().maxCoeff());
    before = found;
  }
  EXPECT_LT((before.array() / whole.array() - 1.0).abs().maxCoeff(), 1e-9);
}

/// Metres and radians: an interface with rotations is measured in one unit.
TEST(Band, RotationsAreBroughtToTheSizeOfTranslations) {
  dynamics::DofTable dofs = dynamics::six_dofs("A");
  dofs.resize(4);  // x, y, z, rx
  MatrixXcd H = MatrixXcd::Zero(4, 4);
  H.diagonal() << 1e-6, 2e-6, 3e-6, 3e-2;
  const Eigen::VectorXd units = common_units(dofs, {H});
  EXPECT_NEAR(units(0), 1.0, 1e-15);
  EXPECT_NEAR(units(3), 1e-2, 1e-12);
  MatrixXcd other = H;
  other(3, 3) *= 1.5;
  EXPECT_NEAR(relative_error(other, H, units), 0.5, 1e-12);
  other = H;
  other(0, 0) *= 1.5;
  EXPECT_NEAR(relative_error(other, H, units), 0.5 / 3.0, 1e-12);
}

TEST(Comparison, ATruthIsTheDirectSolutionOfTheDampedFullModel) {
  for (const bool held : {true, false}) {
    const Reducible part = small_part(held);
    const Band band{500.0, 9000.0, 5, 0.02};
    const BandTruth truth = band_truth(part.full, part.interface, band);
    EXPECT_GT(truth.natural_hz.size(), 2);
    EXPECT_EQ(truth.rigid_motions, held ? 0 : 6);
    for (std::size_t i = 0; i < truth.z.size(); ++i)
      EXPECT_LT(relative_error(truth.H[i], direct(part, truth.z[i]), truth.units), 1e-8)
          << frequency_hz(band, truth.z[i]);
  }
}

TEST(Reduce, BadInputIsRefusedWithWhatToDo) {
  const Reducible held = small_part(true), free = small_part(false);
  const auto message = [](const auto& call) -> std::string {
    try {
      call();
    } catch (const core::Error& error) {
      return error.what();
    }
    return "nothing thrown";
  };
  const auto contains = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  contains(message([] { (void)method_named("craig_bamton"); }), "craig_bampton");
  EXPECT_EQ(method_named("dual_craig_bampton"), Method::dual_craig_bampton);
  contains(message([&] { (void)reduce(Method::modal_truncation, free.full, free.interface); }), "double poles");
  contains(message([&] { (void)reduce(Method::rubin, held.full, held.interface, {.modes = 100000}); }),
           "the model has");
  contains(message([&] { (void)reduce(Method::rubin, held.full, held.interface, {.modes = -1}); }), "0 or more");
  contains(message([&] {
             (void)reduce(Method::characteristic_constraint_modes, held.full, held.interface, {.characteristic = 99});
           }),
           "ask for 1 to");
  contains(message([&] { (void)reduce(Method::modal_truncation, held.full, held.interface, {.damping_ratio = 2.0}); }),
           "damping ratio");
  FullModel wrong = held.full;
  wrong.rigid = MatrixXd::Ones(wrong.K.rows(), 1);
  contains(message([&] { (void)reduce(Method::rubin, wrong, held.interface); }), "is held");
  wrong.rigid = MatrixXd::Ones(3, 1);
  contains(message([&] { (void)reduce(Method::rubin, wrong, held.interface); }), "3 rows");
  wrong = free.full;
  wrong.rigid.rightCols(1) = wrong.rigid.leftCols(1);
  contains(message([&] { (void)reduce(Method::rubin, wrong, free.interface); }), "depend on each other");
  Reducible one_point = small_part(false, 1);
  contains(message([&] { (void)reduce(Method::craig_bampton, one_point.full, one_point.interface, {.modes = 5}); }),
           "hold 3 of the 6 rigid motions");
  EXPECT_EQ(size(reduce(Method::rubin, one_point.full, one_point.interface, {.modes = 5})), 14);
  contains(message([&] { validate({.from_hz = -1.0, .to_hz = -2.0, .lines = 1, .loss_factor = 0.0}); }), "lines");
}

}  // namespace
}  // namespace thinwall::reduction::reduce_test
