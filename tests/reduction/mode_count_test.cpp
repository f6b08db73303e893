#include "reduction/trust/mode_count.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "reduction/methods/free_interface.hpp"
#include "reduction/methods/held_interface.hpp"
#include "tests/reduction/reducible_part.hpp"

namespace thinwall::reduction::mode_count_test {
namespace {

/// A block or plate of random size with two or three random patches; every fourth one is free.
Reducible random_part(int seed) {
  std::mt19937 generator(static_cast<unsigned>(seed));
  const auto random = [&](double from, double to) { return std::uniform_real_distribution(from, to)(generator); };
  const bool held = seed % 4 != 3;
  const Eigen::Vector3d size(random(0.15, 0.4), random(0.1, 0.3), random(0.01, 0.06));
  const fem::Model model = block(size, {3, 2, 1}, 2, held);
  std::vector<fem::NamedPoint> points;
  const int count = held ? 1 + seed % 3 : 3;
  for (int i = 0; i < count; ++i) {
    // Thirds of the length, so that patches of a free part restrain it.
    const Eigen::Vector3d x(size.x() * (i + random(0.3, 1.0)) / count, size.y() * random(0.0, 1.0), size.z());
    points.push_back({"P" + std::to_string(i), x, seed % 2 == 0 ? 0.02 : 0.0, xyz});
  }
  return reducible(model, points);
}

/// The true errors of a model cut to 0, 1, 2 … modes, up to the first within `tolerance` and beyond it to
/// `least_counts`, against the full model's modal sum on a finer grid.
std::vector<double> true_errors(const Reducible& part, const Band& band, double tolerance, int least_counts) {
  Band fine = band;
  fine.lines = 3 * band.lines + 1;
  const BandTruth truth = band_truth(part.full, part.interface, fine);
  const linalg::SparseCholesky factor = held_by_interface(part.full, part.interface);
  const linalg::ShiftedInverse inverse{
      [&](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd { return factor.solve(B); }, 0.0};
  const auto nb = part.interface.W.cols(), inner = part.full.K.rows() - nb;
  const CraigBampton all = craig_bampton(part.full.K, part.full.M, inverse, part.interface,
                                         {.modes = static_cast<int>(inner), .up_to_hz = {}});
  std::vector<double> errors;
  bool met = false;
  for (Eigen::Index modes = 0; modes <= inner && (!met || modes <= least_counts); ++modes) {
    dynamics::SpatialModel model = all.model;
    for (auto* matrix : {&model.M, &model.C, &model.K}) matrix->conservativeResize(nb + modes, nb + modes);
    model.dofs.resize(static_cast<std::size_t>(nb + modes));
    errors.push_back(max_receptance_error(model, truth));
    met = met || errors.back() <= tolerance;
  }
  return errors;
}

/// A band over the first five elastic modes.
Band band_of(const Reducible& part) {
  const StaticFlexibility flexibility(part.full);
  const PartModes modes = free_modes(part.full, flexibility, 6);
  const Eigen::VectorXd hz = modes.lambda.tail(6).cwiseSqrt() / (2.0 * std::numbers::pi);
  return {0.2 * hz(0), 0.5 * (hz(4) + hz(5)), 60, 0.02};
}

// Twenty parts with THINWALL_SLOW=1 in the environment, the first six without: each tolerance held and free, in both
// orders of the elements.
TEST(ModeCount, OfRandomPartsKeepsTheToleranceWithHardlyMoreThanTheLeastModes) {
  const int parts = std::getenv("THINWALL_SLOW") != nullptr ? 20 : 6;
  double worst_error = 0.0, worst_size = 0.0;
  for (int seed = 0; seed < parts; ++seed) {
    const Reducible part = random_part(seed);
    const Band band = band_of(part);
    const double tolerance = std::array{0.1, 0.03, 0.01}[static_cast<std::size_t>(seed % 3)];
    const ChosenModes chosen = modes_for_tolerance(part.full, part.interface, {.tolerance = tolerance, .band = band});
    EXPECT_EQ(chosen.status, ModeCountStatus::met)
        << seed << ": estimate " << chosen.estimated_error << " of " << chosen.reference_modes
        << " modes, reference within " << chosen.reference_error;
    const std::vector<double> errors = true_errors(part, band, tolerance, chosen.modes);
    const auto least = std::find_if(errors.begin(), errors.end(), [&](double e) { return e <= tolerance; });
    ASSERT_NE(least, errors.end()) << seed;
    const auto nb = part.interface.W.cols();
    const double error = errors[static_cast<std::size_t>(chosen.modes)] / tolerance;
    const double size = static_cast<double>(nb + chosen.modes) / static_cast<double>(nb + (least - errors.begin()));
    std::printf(
        "part %2d, %s, %td interface DOFs: %2d modes for %.2f, least %2td; true error %.3f of it; reference of "
        "%d modes within %.1e\n",
        seed, part.full.rigid.cols() > 0 ? "free" : "held", nb, chosen.modes, tolerance, least - errors.begin(), error,
        chosen.reference_modes, chosen.reference_error);
    EXPECT_LE(error, 2.0) << seed;
    EXPECT_LE(size, 1.3) << seed;
    worst_error = std::max(worst_error, error);
    worst_size = std::max(worst_size, size);
  }
  std::printf("%d parts: true error at most %.3f of the tolerance, size at most %.3f of the smallest\n", parts,
              worst_error, worst_size);
}

/// Of this free part round-off in what was left out would take more mass than its interface has.
TEST(ModeCount, RoundOffInWhatWasLeftOutTakesNoMoreMassThanThereIs) {
  const Reducible part = random_part(15);
  const ChosenModes chosen = modes_for_tolerance(part.full, part.interface, {.tolerance = 0.1, .band = band_of(part)});
  EXPECT_EQ(chosen.status, ModeCountStatus::met);
  EXPECT_LT(chosen.reference_error, 1e-3);
}

/// Estimates against the full model, count by count.
TEST(ModeCount, EstimatesAreTheTrueErrors) {
  const Reducible part = random_part(5);
  const Band band = band_of(part);
  const ChosenModes chosen = modes_for_tolerance(part.full, part.interface, {.tolerance = 0.001, .band = band});
  const std::vector<double> errors = true_errors(part, band, 0.001, chosen.modes);
  int compared_counts = 0;
  for (int modes = 0; modes <= chosen.modes; ++modes) {
    const auto k = static_cast<std::size_t>(modes);
    // The truth's lines lie denser, and a resonance in the wrong place is a peak between them.
    if (errors[k] >= 0.3) continue;
    EXPECT_NEAR(chosen.errors[k] / errors[k], 1.0, 0.1) << modes;
    ++compared_counts;
  }
  EXPECT_GT(compared_counts, 5);
  EXPECT_EQ(chosen.reduced.T.cols(), chosen.reduced.model.size());
  EXPECT_EQ(chosen.reduced.fixed_interface_hz.size(), chosen.modes);
  EXPECT_EQ(std::ssize(chosen.reduced.model.dofs), chosen.reduced.model.size());
}

/// The cut model's truncation is that of a reduction that was made with so many modes.
TEST(ModeCount, TheModelThatIsCutIsTheModelOfSoManyModes) {
  const Reducible part = random_part(4);
  const ChosenModes chosen = modes_for_tolerance(part.full, part.interface, {.tolerance = 0.01, .band = band_of(part)});
  const linalg::SparseCholesky factor = held_by_interface(part.full, part.interface);
  const linalg::ShiftedInverse inverse{
      [&](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd { return factor.solve(B); }, 0.0};
  const CraigBampton expected =
      craig_bampton(part.full.K, part.full.M, inverse, part.interface, {.modes = chosen.modes, .up_to_hz = {}});
  const Truncation left_out = truncation(expected, part.full.M, inverse, part.interface);
  EXPECT_LT((chosen.truncation.A - left_out.A).norm(), 1e-9 * left_out.A.norm());
  EXPECT_LT((chosen.truncation.B - left_out.B).norm(), 1e-9 * left_out.B.norm());
  EXPECT_LT((chosen.reduced.model.K - expected.model.K).norm(), 1e-9 * expected.model.K.norm());
}

/// More than 600 rows: Lanczos for the modes, a sparse factorisation for the direct solves.
TEST(ModeCount, OfALargerPartIsVerifiedToo) {
  for (const bool held : {true, false}) {
    const Reducible part = larger_part(held);
    const Band band = band_of(part);
    const ChosenModes chosen = modes_for_tolerance(part.full, part.interface, {.tolerance = 0.02, .band = band});
    ASSERT_EQ(chosen.status, ModeCountStatus::met);
    const double error = max_receptance_error(chosen.reduced.model, band_truth(part.full, part.interface, band));
    EXPECT_LE(error, 2.0 * 0.02);
    EXPECT_GE(error, 0.5 * chosen.estimated_error);
  }
}

TEST(ModeCount, BadInputIsRefusedAndAnUnreachableToleranceIsAStatus) {
  const Reducible part = random_part(0);
  const Band band = band_of(part);
  EXPECT_THROW((void)modes_for_tolerance(part.full, part.interface, {.tolerance = 0.0, .band = band}),
               core::InputError);
  EXPECT_THROW((void)modes_for_tolerance(part.full, part.interface, {.tolerance = 0.01, .band = {}}), core::InputError);
  EXPECT_THROW(
      (void)modes_for_tolerance(part.full, part.interface, {.tolerance = 0.01, .band = band, .verified_lines = 0}),
      core::InputError);
  const ChosenModes stopped =
      modes_for_tolerance(part.full, part.interface, {.tolerance = 1e-8, .band = band, .rounds = 1});
  EXPECT_NE(stopped.status, ModeCountStatus::met);
}

TEST(ModeCount, ATruthThatIsNoNumberSomewhereVerifiesNothing) {
  const Reducible part = random_part(0);
  const Band band = band_of(part);
  BandTruth truth = band_truth(part.full, part.interface, band);
  const ModeCountOptions options{.tolerance = 0.1, .band = band, .rounds = 3};
  ASSERT_EQ(modes_for_tolerance(part.full, part.interface, options, truth).status, ModeCountStatus::met);
  truth.H.front()(0, 0) = std::numeric_limits<double>::quiet_NaN();
  const ChosenModes chosen = modes_for_tolerance(part.full, part.interface, options, truth);
  EXPECT_EQ(chosen.status, ModeCountStatus::not_verified);
  EXPECT_TRUE(std::isnan(chosen.reference_error));
  EXPECT_TRUE(std::isnan(max_receptance_error(chosen.reduced.model, truth)));
}

TEST(ModeCount, OfAFreePartNeedsABandAboveZero) {
  const Reducible part = random_part(3);
  Band band = band_of(part);
  band.from_hz = 0.0;
  for (const bool truth : {true, false}) {
    try {
      if (truth) (void)band_truth(part.full, part.interface, band);
      if (!truth) (void)modes_for_tolerance(part.full, part.interface, {.tolerance = 0.01, .band = band});
      FAIL() << "a free part has no static receptance";
    } catch (const core::InputError& error) {
      EXPECT_NE(std::string(error.what()).find("from_hz"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace thinwall::reduction::mode_count_test
