// Lines that make the Nyquist circles of resonances round.

#include "dynamics/round_circles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <set>

namespace thinwall::dynamics::testing::round_circles_test {

namespace {

using Complex = std::complex<double>;

/// A mode with hysteretic damping, whose Nyquist curve is a circle exactly: through 0, of the diameter 1/η downwards.
struct Mode {
  double hz, loss_factor;
  [[nodiscard]] Complex at(double f) const { return 1.0 / Complex(1.0 - f * f / (hz * hz), loss_factor); }
  [[nodiscard]] double radius() const { return 0.5 / loss_factor; }
};

Eigen::MatrixXcd curve(const Mode& mode, const Eigen::VectorXd& hz) {
  return hz.unaryExpr([&](double f) { return mode.at(f); });
}

/// Largest distance of the drawn line from the circle, over its radius.
double out_of_round(const Mode& mode, const Eigen::VectorXd& hz) {
  double worst = 0.0;
  const Complex centre(0.0, -mode.radius());
  for (Eigen::Index k = 1; k < hz.size(); ++k) {
    const Complex middle = 0.5 * (mode.at(hz(k - 1)) + mode.at(hz(k)));
    worst = std::max(worst, std::abs(std::abs(middle - centre) / mode.radius() - 1.0));
  }
  return worst;
}

/// The lines with all that are asked for, at most ten times.
Eigen::VectorXd refined(const Mode& mode, Eigen::VectorXd hz, int& rounds) {
  for (rounds = 0; rounds < 10; ++rounds) {
    const auto more = lines_to_add(hz, curve(mode, hz));
    if (more.empty()) break;
    std::set<double> all(hz.begin(), hz.end());
    all.insert(more.begin(), more.end());
    hz.resize(std::ssize(all));
    std::ranges::copy(all, hz.begin());
  }
  return hz;
}

TEST(RoundCircles, AResonanceAsWideAsTwoLinesBecomesACircle) {
  const Mode mode{213.4, 5.6 / 213.4};
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(401, 0.0, 1000.0);
  EXPECT_GT(out_of_round(mode, hz), 0.1) << "2.5 Hz steps across 5.6 Hz";
  int rounds = 0;
  const Eigen::VectorXd more = refined(mode, hz, rounds);
  EXPECT_LT(out_of_round(mode, more), 0.02) << "1 − cos 10 deg is 1.5 %";
  EXPECT_LE(rounds, 4);
  EXPECT_LT(more.size() - hz.size(), 40);
}

TEST(RoundCircles, ARoundCircleAStraightLineAndWhatIsNotSeenNeedNoLines) {
  const Mode mode{500.0, 0.1};
  const Eigen::VectorXd fine = Eigen::VectorXd::LinSpaced(1001, 0.0, 1000.0);
  EXPECT_TRUE(lines_to_add(fine, curve(mode, fine)).empty());
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(11, 0.0, 10.0);
  EXPECT_TRUE(lines_to_add(hz, hz.cast<Complex>() * Complex(1.0, -2.0)).empty());
  Eigen::VectorXcd corner = hz.cast<Complex>();
  corner(5) += Complex(0.0, 5.0);
  EXPECT_EQ(lines_to_add(hz, corner), (std::vector<double>{4.5, 5.5}));
  corner(5) = Complex(5.0, 0.02);
  EXPECT_TRUE(lines_to_add(hz, corner).empty()) << "a corner too flat";
  const Mode undamped{5.2, 0.0};
  EXPECT_TRUE(lines_to_add(hz, curve(undamped, hz)).empty()) << "no circle";
}

TEST(RoundCircles, OfEveryCurveOneSuffices) {
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(11, 0.0, 10.0);
  Eigen::MatrixXcd curves = hz.cast<Complex>().replicate(1, 2);
  curves(2, 1) += Complex(0.0, 5.0);
  EXPECT_EQ(lines_to_add(hz, curves), (std::vector<double>{1.5, 2.5}));
}

}  // namespace

}  // namespace thinwall::dynamics::testing::round_circles_test
