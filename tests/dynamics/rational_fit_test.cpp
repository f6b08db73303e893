// Partial fractions from lines: structures whose poles are known, between their lines and beyond them.

#include "dynamics/rational_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "core/error.hpp"

namespace thinwall::dynamics::rational_fit_test {
namespace {

using std::complex;
using std::numbers::pi;

/// Modes of unit residue matrices, in Hz.
struct Modes {
  Eigen::VectorXd hz, damping, mass;
  Eigen::Matrix3Xd shape;
};

double uniform(std::mt19937_64& random, double from, double to) {
  return std::uniform_real_distribution<double>(from, to)(random);
}

Modes random_modes(std::mt19937_64& random, int count) {
  Modes modes{Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::VectorXd(count), Eigen::Matrix3Xd(3, count)};
  for (int k = 0; k < count; ++k) {
    modes.hz(k) = uniform(random, 100.0, 1000.0);
    modes.damping(k) = std::pow(10.0, uniform(random, -2.5, -1.3));
    modes.mass(k) = std::pow(10.0, uniform(random, -1.0, 1.0));
    for (double& component : modes.shape.col(k)) component = uniform(random, -1.0, 1.0);
    modes.shape.col(k).normalize();
  }
  return modes;
}

Eigen::MatrixXcd receptance(const Modes& modes, double hz) {
  Eigen::Matrix3cd H = Eigen::Matrix3cd::Zero();
  const double omega = 2.0 * pi * hz;
  for (Eigen::Index k = 0; k < modes.hz.size(); ++k) {
    const double natural = 2.0 * pi * modes.hz(k);
    const complex<double> stiffness(natural * natural - omega * omega, 2.0 * modes.damping(k) * natural * omega);
    H += modes.shape.col(k) * modes.shape.col(k).transpose() / (modes.mass(k) * stiffness);
  }
  return H;
}

std::vector<Eigen::MatrixXcd> lines_of(const Modes& modes, const Eigen::VectorXd& hz) {
  std::vector<Eigen::MatrixXcd> H;
  for (const double at : hz) H.push_back(receptance(modes, at));
  return H;
}

double peak(const Modes& modes) {
  double largest = 0.0;
  for (const double hz : modes.hz) largest = std::max(largest, receptance(modes, hz).norm());
  return largest;
}

/// Differences on a fine axis, over the peak.
struct Error {
  double largest = 0.0, mean_square = 0.0;
};

Error error(const PartialFractions& fit, const Modes& modes, double from_hz, double to_hz) {
  Error error;
  for (const double hz : Eigen::VectorXd::LinSpaced(3001, from_hz, to_hz)) {
    const double off = (value(fit, 2.0 * pi * hz) - receptance(modes, hz)).norm() / peak(modes);
    error.largest = std::max(error.largest, off);
    error.mean_square += off * off / 3001.0;
  }
  return error;
}

/// Lines from below the lowest mode to beyond the highest, `spacing` half widths of the sharpest apart.
Eigen::VectorXd axis_of(const Modes& modes, double spacing, double to_hz) {
  const double step = spacing * modes.hz.cwiseProduct(modes.damping).minCoeff();
  const double from = 0.5 * modes.hz.minCoeff();
  const auto lines = std::max<Eigen::Index>(2, static_cast<Eigen::Index>((to_hz - from) / step)) + 1;
  return Eigen::VectorXd::LinSpaced(lines, from, to_hz);
}

TEST(RationalFit, FindsRandomStructuresBetweenTheirLinesAndBeyondThem) {
  std::mt19937_64 random(7);
  int systems = 0;
  while (systems < 40) {
    const int count = static_cast<int>(uniform(random, 1.0, 7.0));
    const Modes modes = random_modes(random, count);
    const Eigen::VectorXd hz = axis_of(modes, std::pow(10.0, uniform(random, -0.5, 0.5)), 1300.0);
    if (hz.size() > 1500 || hz.size() < 8 * (2 * count + 3)) continue;
    ++systems;
    const PartialFractions fit = rational_fit(hz, lines_of(modes, hz));
    EXPECT_LT(error(fit, modes, hz(0), 1300.0).largest, 1e-9) << count << " modes, " << hz.size() << " lines";
    EXPECT_LT(error(fit, modes, 1300.0, 8000.0).largest, 1e-9) << count << " modes, " << hz.size() << " lines";
  }
}

/// A pair more lowers what is left of many modes by a few hundredths, as it does to noise, which these are not.
TEST(RationalFit, FindsManyModesOfOneSize) {
  std::mt19937_64 random(7);
  constexpr int count = 32;
  Modes modes = random_modes(random, count);
  modes.hz = Eigen::VectorXd::LinSpaced(count, 150.0, 7900.0);
  modes.damping.setConstant(0.01);
  modes.mass = modes.hz.array().square().inverse() * 1e4;  // peaks of one height
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(4000, 2.0, 8000.0);
  const Error off = error(rational_fit(hz, lines_of(modes, hz)), modes, 2.0, 8000.0);
  std::printf("%d modes of one size: off by %.1e at most\n", count, off.largest);
  EXPECT_LT(off.largest, 1e-5);
}

/// Not all of many lines are looked at to see how many modes there are. Here every fifth alone would be 5 Hz apart,
/// where the half widths of the lowest modes are from 0.15 to 0.9 Hz.
TEST(RationalFit, FindsSharpModesAmongManyLines) {
  std::mt19937_64 random(8);
  constexpr int wide = 24, sharp = 9, count = wide + sharp;
  Modes modes = random_modes(random, count);
  modes.hz << Eigen::VectorXd::LinSpaced(sharp, 10.3, 60.7), Eigen::VectorXd::LinSpaced(wide, 300.0, 9900.0);
  modes.damping.setConstant(0.015);
  modes.mass = modes.hz.array().square().inverse() * 1e4;  // peaks of one height
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(9999, 2.0, 10000.0);
  const Error off = error(rational_fit(hz, lines_of(modes, hz)), modes, 2.0, 100.0);
  std::printf("sharp modes among many lines: off by %.1e at most\n", off.largest);
  EXPECT_LT(off.largest, 1e-3);
}

TEST(RationalFit, FindsAModeBeyondTheLines) {
  std::mt19937_64 random(3);
  Modes modes = random_modes(random, 3);
  modes.hz << 300.0, 520.0, 1400.0;
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(401, 100.0, 900.0);
  EXPECT_LT(error(rational_fit(hz, lines_of(modes, hz)), modes, 100.0, 3000.0).largest, 1e-6);
}

TEST(RationalFit, AveragesNoise) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 10; ++i) {
    SCOPED_TRACE(i);
    const Modes modes = random_modes(random, 2);
    const Eigen::VectorXd hz = axis_of(modes, 0.3, 1300.0);
    std::vector<Eigen::MatrixXcd> H = lines_of(modes, hz);
    const double noise = 1e-3 * peak(modes);
    for (Eigen::MatrixXcd& at : H) {
      for (complex<double>& entry : at.reshaped()) entry += noise * complex<double>(normal(random), normal(random));
    }
    const Error off = error(rational_fit(hz, H), modes, hz(0), 1300.0);
    EXPECT_LT(std::sqrt(off.mean_square), 0.4 * std::sqrt(18.0) * 1e-3);
    EXPECT_LT(off.largest, 2.0 * std::sqrt(18.0) * 1e-3);
  }
}

/// The error of a fit at even frequencies, of the receptance there, root mean square.
double relative_error(const PartialFractions& fit, const Modes& modes, double from_hz, double to_hz, double step_hz) {
  double squares = 0.0;
  int lines = 0;
  for (double at = from_hz; at <= to_hz; at += step_hz, ++lines) {
    const Eigen::MatrixXcd exact = receptance(modes, at);
    squares += (value(fit, 2.0 * pi * at) - exact).squaredNorm() / exact.squaredNorm();
  }
  return std::sqrt(squares / lines);
}

/// Modes of which two, at 1801 and 2157 Hz, are a hundredth as high as their neighbours: in the noise of a line they
/// are not seen, but a chart of stability is 3 % off without them.
Modes hidden_modes() {
  Modes modes{Eigen::VectorXd(8), Eigen::VectorXd(8), Eigen::VectorXd(8), Eigen::Matrix3Xd::Zero(3, 8)};
  modes.hz << 148.4, 838.5, 1304.2, 1801.3, 2065.3, 2105.6, 2156.9, 2234.8;
  modes.damping << 0.0072, 0.0076, 0.0074, 0.0427, 0.0079, 0.0470, 0.0430, 0.0205;
  const Eigen::ArrayXd stiffness{{4.138e7, 2.240e7, 2.026e7, 4.661e7, 1.269e6, 3.132e6, 2.331e7, 9.816e6}};
  modes.mass = stiffness / (2.0 * pi * modes.hz.array()).square();
  const double along_x[] = {-0.638, -0.612, 0.795, 0.589, 0.999, 0.881, 0.032, -0.530};
  for (int k = 0; k < 8; ++k) modes.shape.col(k) << along_x[k], std::sqrt(1.0 - along_x[k] * along_x[k]), 0.0;
  return modes;
}

TEST(RationalFit, HasModesThatTheNoiseOfALineHidesAndNoneOfTheNoise) {
  const Modes modes = hidden_modes();
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(6000, 100.0, 3800.0);
  constexpr double noise = 0.01;  // of an entry, root mean square
  std::mt19937_64 random(12);
  std::normal_distribution<double> normal(0.0, noise / std::sqrt(2.0));
  std::vector<Eigen::MatrixXcd> H = lines_of(modes, hz);
  for (Eigen::MatrixXcd& at : H) {
    for (complex<double>& entry : at.reshaped()) entry *= complex<double>(1.0 + normal(random), normal(random));
  }
  const PartialFractions fit = rational_fit(hz, H);
  const double off = relative_error(fit, modes, 1700.0, 2300.0, 1.0);
  std::printf("hidden modes: %zu poles, off by %.1e of a line\n", fit.residues.size(), off);
  // Five modes have ten numbers each (pole and residue), and the 970 lines here four complex entries each: least
  // squares leave √(50/7780) of the noise, and twice as much is not exceeded.
  EXPECT_LT(off, 2.0 * noise * std::sqrt(50.0 / 7780.0));
  EXPECT_EQ(fit.residues.size(), 8U);
  for (const complex<double> pole : fit.poles) EXPECT_LT(pole.real(), -2.0 * pi * (hz(1) - hz(0))) << pole;
}

// Noise of a swapped tool is larger by orders where the rigid tool hides the holder. Quiet lines are fitted within
// their own noise.
TEST(RationalFit, LoudLinesDoNotSpoilQuietOnes) {
  const Modes modes = hidden_modes();
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(1200, 100.0, 3800.0);
  constexpr double loud = 1e-2, quiet = 1e-5;  // of an entry, root mean square, below and above 600 Hz
  std::mt19937_64 random(13);
  std::normal_distribution<double> normal(0.0, 1.0 / std::sqrt(2.0));
  std::vector<Eigen::MatrixXcd> H = lines_of(modes, hz);
  for (std::size_t i = 0; i < H.size(); ++i) {
    const double noise = hz(static_cast<Eigen::Index>(i)) < 600.0 ? loud : quiet;
    for (complex<double>& entry : H[i].reshaped())
      entry *= complex<double>(1.0 + noise * normal(random), noise * normal(random));
  }
  const PartialFractions fit = rational_fit(hz, H);
  const double off = relative_error(fit, modes, 700.0, 3700.0, 5.0);
  std::printf("loud lines: %zu poles, off by %.1e of a quiet line\n", fit.residues.size(), off);
  EXPECT_LT(off, quiet);
}

// Computed or smoothed lines that replace those below what a hammer excites have no noise, but are 2 % too large. By
// their scatter they would have all the weight, and the error elsewhere would be sixteen times that without them.
TEST(RationalFit, SmoothLinesThatAreSlightlyOffDoNotSpoilOthers) {
  Modes modes{Eigen::Vector3d(420.0, 900.0, 1700.0), Eigen::Vector3d(0.03, 0.02, 0.03), {}, Eigen::Matrix3Xd(3, 3)};
  modes.mass = Eigen::Array3d(2e7, 8e6, 2e7) / (2.0 * pi * modes.hz.array()).square();
  modes.shape << 1.0, 0.8, 0.6, 0.0, 0.6, -0.8, 0.0, 0.0, 0.0;
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(1491, 20.0, 3000.0);
  constexpr Eigen::Index smooth = 66;  // up to 150 Hz
  std::mt19937_64 random(14);
  std::normal_distribution<double> normal(0.0, 0.01 / std::sqrt(2.0));
  std::vector<Eigen::MatrixXcd> H = lines_of(modes, hz);
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    for (complex<double>& entry : H[static_cast<std::size_t>(i)].reshaped())
      entry *= i < smooth ? 1.02 : complex<double>(1.0 + normal(random), normal(random));
  }
  const double with = relative_error(rational_fit(hz, H), modes, 700.0, 2990.0, 5.0);
  const PartialFractions others = rational_fit(hz.tail(hz.size() - smooth), {H.begin() + smooth, H.end()});
  const double without = relative_error(others, modes, 700.0, 2990.0, 5.0);
  std::printf("smooth lines that are off: error %.1e, without them %.1e\n", with, without);
  EXPECT_LT(with, 3.0 * without);
}

TEST(RationalFit, TakesAStaticPartAndAPoleThatDoesNotOscillate) {
  const PartialFractions exact{
      Eigen::Vector2cd(complex<double>(-900.0, 0.0), complex<double>(-40.0, 2500.0)),
      {Eigen::MatrixXcd::Constant(1, 1, 2e-5), Eigen::MatrixXcd::Constant(1, 1, {3e-6, -4e-4})},
      Eigen::MatrixXd::Constant(1, 1, 1e-8)};
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(200, 0.0, 700.0);
  std::vector<Eigen::MatrixXcd> H;
  for (const double at : hz) H.push_back(value(exact, 2.0 * pi * at));
  const PartialFractions fit = rational_fit(hz, H);
  for (const double at : {0.0, 17.3, 399.0, 650.1, 2000.0}) {
    const complex<double> wanted = value(exact, 2.0 * pi * at)(0, 0);
    EXPECT_LT(std::abs(value(fit, 2.0 * pi * at)(0, 0) - wanted), 1e-8 * std::abs(value(exact, 2500.0)(0, 0))) << at;
  }
}

TEST(RationalFit, StaysWhereItIsExactWhateverOtherPolesDo) {
  std::mt19937_64 random(19);
  for (int i = 0; i < 20; ++i) {
    const Modes modes = random_modes(random, 3);
    const Eigen::VectorXd hz = axis_of(modes, 1.0, 1300.0);
    Eigen::VectorXcd poles(5);
    for (int k = 0; k < 3; ++k) {
      const double natural = 2.0 * pi * modes.hz(k), damping = modes.damping(k);
      poles(k) = natural * complex<double>(-damping, std::sqrt(1.0 - damping * damping));
    }
    poles(3) = -uniform(random, 100.0, 5000.0);
    poles(4) = 2.0 * pi * uniform(random, 100.0, 2000.0) * complex<double>(-0.1, 1.0);
    const PartialFractions fit = vector_fit(hz, lines_of(modes, hz), poles);
    EXPECT_LT(error(fit, modes, hz(0), 1300.0).largest, 1e-9) << i;
  }
}

TEST(RationalFit, OfASpringIsItsCompliance) {
  const Eigen::VectorXd hz = Eigen::VectorXd::LinSpaced(40, 1.0, 100.0);
  const PartialFractions fit =
      rational_fit(hz, std::vector<Eigen::MatrixXcd>(40, Eigen::MatrixXcd::Constant(1, 1, 2e-6)));
  for (const double at : {0.0, 33.3, 100.0}) EXPECT_LT(std::abs(value(fit, 2.0 * pi * at)(0, 0) - 2e-6), 1e-14) << at;
}

TEST(RationalFit, TellsOfAnUndampedPoleOnALine) {
  std::mt19937_64 random(20);
  const Modes modes = random_modes(random, 2);
  const Eigen::VectorXd hz = axis_of(modes, 1.0, 1300.0);
  const Eigen::VectorXcd on_a_line = Eigen::VectorXcd::Constant(1, complex<double>(0.0, 2.0 * pi * hz(hz.size() - 1)));
  EXPECT_THROW((void)vector_fit(hz, lines_of(modes, hz), on_a_line), core::NumericalError);
}

TEST(RationalFit, RefusesWhatCannotBeFitted) {
  const Eigen::VectorXd five = Eigen::VectorXd::LinSpaced(5, 1.0, 5.0);
  const std::vector<Eigen::MatrixXcd> ones(5, Eigen::MatrixXcd::Ones(1, 1));
  EXPECT_THROW((void)rational_fit(five, ones), core::InputError);
  const Eigen::VectorXd ten = Eigen::VectorXd::LinSpaced(10, 1.0, 10.0);
  EXPECT_THROW((void)rational_fit(ten, ones), core::InputError);
  std::vector<Eigen::MatrixXcd> zeros(10, Eigen::MatrixXcd::Zero(1, 1));
  EXPECT_THROW((void)rational_fit(ten, zeros), core::InputError);
  zeros[3](0, 0) = NAN;
  EXPECT_THROW((void)rational_fit(ten, zeros), core::InputError);
  EXPECT_THROW((void)vector_fit(ten, std::vector<Eigen::MatrixXcd>(10, Eigen::MatrixXcd::Ones(1, 1)),
                                Eigen::VectorXcd::Constant(3, complex<double>(-1.0, 100.0))),
               core::InputError);
}

}  // namespace
}  // namespace thinwall::dynamics::rational_fit_test
