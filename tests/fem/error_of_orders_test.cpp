// The estimated error of orders against errors that are known because they were made up, and against a finer mesh.

#include "fem/error/error_of_orders.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "fem/closed_part.hpp"
#include "mesh/box.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::error_of_orders_test {
namespace {

const Exponents regular{{1.0, 1.0}, {1.0, 1.0}};
const Exponents reentrant{{0.544, 1.0}, {0.544, 1.0}};

/// The steps of orders 3 to `last` of a quantity whose error is e(p).
template <class Error>
std::vector<RefinementStep> steps_of(const Error& e, int last) {
  std::vector<RefinementStep> steps{{0, 3, 1, {}, {}}};
  for (int p = 4; p <= last; ++p) steps.push_back({0, p, 1, e(p - 1) - e(p), e(p - 1) - e(p)});
  return steps;
}

/// Aitken's rule is exact for errors that fall by one ratio, and the estimate is never below them where it is smaller.
TEST(ErrorOfOrders, OfAGeometricErrorIsThatErrorWhereItFallsSlowly) {
  for (const Exponents& exponents : {regular, reentrant}) {
    for (const double q : {0.1, 0.3, 0.5, 0.72, 0.8, 0.89}) {
      const auto e = [q](int p) { return 0.1 * std::pow(q, p); };
      for (const int last : {5, 6}) {
        const auto [lower, higher] = errors_of_last_two(steps_of(e, last), exponents, {0.5, 4});
        EXPECT_GE(higher.frequency, 0.999 * e(last)) << q;
        EXPECT_GE(lower.receptance, 0.999 * e(last - 1)) << q;
        if (q < 0.71) continue;
        EXPECT_NEAR(higher.frequency / e(last), 1.0, 1e-9) << q;
        EXPECT_NEAR(lower.frequency / e(last - 1), 1.0, 1e-9) << q;
      }
    }
  }
}

TEST(ErrorOfOrders, ChangesThatDoNotFallAreNineTimesTheLastOne) {
  std::vector<RefinementStep> steps = steps_of([](int p) { return 1.0 - 0.01 * p; }, 6);
  EXPECT_NEAR(errors_of_last_two(steps, regular, {0.5, 4}).second.frequency, 0.09, 1e-12);
  steps.back().frequency_change = 0.02;
  EXPECT_NEAR(errors_of_last_two(steps, regular, {0.5, 4}).second.frequency, 0.18, 1e-12);
}

/// With rows at its edges an error of a singular share, which falls by the law of the edge, and a smooth one, which
/// falls by ten, is met exactly, unless it is below the last change, which is taken at least.
TEST(ErrorOfOrders, WithRowsAtTheEdgesOfTwoSharesIsTheirSum) {
  const double law = std::pow(4.5 / 5.5, 4.0 * 0.544);
  for (const double share : {0.5, 0.97, 0.99}) {
    const auto e = [&](int p) {
      return share * std::pow(law, p) + (1.0 - share) * std::pow(0.1, p) * std::pow(10 * law, 5);
    };
    const auto error = errors_of_last_two(steps_of(e, 5), reentrant, {0.5, 4, true}).second.frequency;
    EXPECT_NEAR(error, std::max(e(5), e(4) - e(5)), 1e-9 * e(5)) << share;
    const auto before = errors_of_last_two(steps_of(e, 4), reentrant, {0.5, 4, true}).second.frequency;
    EXPECT_NEAR(before, e(3) - e(4), 1e-9 * e(4)) << "one change tells no law";
    EXPECT_LT(error, errors_of_last_two(steps_of(e, 5), reentrant, {0.5, 4}).second.frequency);
  }
}

/// One change tells nothing of the ratio, so that an error that falls by the ratio that is taken is met exactly.
TEST(ErrorOfOrders, BeforeTwoChangesAreKnownTheRatioIsTheOneThatIsGiven) {
  const auto e = [](int p) { return std::pow(2.0 / 3.0, p); };
  const auto first = steps_of(e, 4);
  EXPECT_NEAR(errors_of_last_two(first, regular, {2.0 / 3.0, 4}).second.frequency / e(4), 1.0, 1e-12);
  EXPECT_NEAR(errors_of_last_two(first, regular, {0.5, 4}).second.frequency / e(4), 0.5, 1e-12);
  // Orders below the usual one tell nothing either.
  EXPECT_NEAR(errors_of_last_two(steps_of(e, 5), regular, {2.0 / 3.0, 5}).second.frequency / e(5), 1.0, 1e-12);
}

/// The torsion of a strip that one element spans converges slowly: at order 4 the error is 1.6 times the change.
TEST(ErrorOfOrders, OfAStripIsWithinItsEstimate) {
  const Material aluminium{70e9, 0.33, 2700.0};
  const mesh::Box strip{{0.4, 0.012, 0.0015}};
  ClosedPartOptions options;
  options.modes.count = 12;
  const ClosedPart part = refine_closed_part(mesh::triangulated(mesh::surface(strip)), aluminium, options);
  ASSERT_TRUE(part.met);
  const Model finer = supported_model(mesh::kuhn_box(strip.size, {40, 4, 1}), 4, aluminium, {});
  const Modes exact = modes(finer, factorise(finer), options.modes);
  const Modes& found = part.refined.modes;
  ASSERT_EQ(found.rigid_motions, 6);
  const Eigen::Index elastic = std::min(found.frequency_hz.size(), exact.frequency_hz.size()) - 6;
  const double error =
      (found.frequency_hz.segment(6, elastic).array() / exact.frequency_hz.segment(6, elastic).array() - 1.0)
          .abs()
          .maxCoeff();
  std::printf("strip: order %d, estimate %.1e, error %.1e\n", part.refined.model.nodes.order, part.frequency_error,
              error);
  EXPECT_LT(error, part.frequency_error);
}

}  // namespace
}  // namespace thinwall::fem::error_of_orders_test
