#include "io/frf/frf_csv.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/frf/resample.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::frf_csv_test {

namespace {

using Complex = std::complex<double>;

class MeasuredFrfFile : public ScratchFolder {};

/// A one-mode receptance, m/N: 200 Hz, 2 %, 0.5 kg.
Complex receptance(double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  const double omega_0 = 2.0 * std::numbers::pi * 200.0;
  return 1.0 / (0.5 * Complex(omega_0 * omega_0 - omega * omega, 2.0 * 0.02 * omega_0 * omega));
}

Complex accelerance(double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  return -omega * omega * receptance(hz);
}

Complex mobility(double hz) {
  return Complex(0.0, 2.0 * std::numbers::pi * hz) * receptance(hz);
}

std::string line(double frequency, Complex value, const std::string& separator) {
  return core::number_text(frequency) + separator + core::number_text(value.real()) + separator +
         core::number_text(value.imag()) + "\n";
}

void expect_the_receptance(const MeasuredFrf& frf, double tolerance) {
  ASSERT_EQ(frf.axis.size(), 40);
  for (Eigen::Index i = 0; i < frf.axis.size(); ++i) {
    const double hz = 10.0 * static_cast<double>(i + 1);
    EXPECT_NEAR(frf.axis.hz(i), hz, 1e-12 * hz);
    EXPECT_LE(std::abs(frf.H(i) - receptance(hz)), tolerance * std::abs(receptance(hz))) << hz << " Hz";
  }
}

const FrfFormat metres_per_newton = frf_format("receptance", "m/N", "Hz");

MeasuredFrf measured(double from_hz, double spacing_hz, int lines) {
  MeasuredFrf frf;
  frf.source = "hammer.csv";
  frf.axis.hz = Eigen::VectorXd::LinSpaced(lines, from_hz, from_hz + spacing_hz * (lines - 1));
  frf.H = frf.axis.hz.unaryExpr([](double hz) { return receptance(hz); });
  return frf;
}

double largest_error(const MeasuredFrf& frf, const dynamics::FrequencyAxis& axis) {
  const Eigen::VectorXcd exact = axis.hz.unaryExpr([](double hz) { return receptance(hz); });
  return (resample(frf, axis) - exact).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_F(MeasuredFrfFile, GivesTheSameReceptanceFromEveryQuantityUnitAndSeparator) {
  std::string in_um = "# hammer test\r\nfrequency,real,imaginary\r\n";
  std::string in_mm_s = "Frequency / rad/s;Re;Im\n";
  std::string in_g;
  for (int i = 1; i <= 40; ++i) {
    const double hz = 10.0 * i;
    in_um += line(hz, receptance(hz) / 1e-6, ",");
    in_mm_s += line(2.0 * std::numbers::pi * hz, mobility(hz) / 1e-3, ";");
    in_g += line(hz / 1e3, accelerance(hz) / 9.80665, "\t");
  }
  constexpr double round_off = 1e-14;
  expect_the_receptance(read_frf(write("a.csv", in_um), frf_format("receptance", "um/N", "Hz")), round_off);
  expect_the_receptance(read_frf(write("b.csv", in_mm_s), frf_format("mobility", "mm/s/N", "rad/s")), round_off);
  expect_the_receptance(read_frf(write("c.csv", "\xEF\xBB\xBF" + in_g), frf_format("accelerance", "g/N", "kHz")),
                        round_off);
}

TEST_F(MeasuredFrfFile, IsRefusedWithFileLineAndCause) {
  struct Fault {
    std::string content;
    std::string place;
    std::string cause;
  };
  const std::vector<Fault> faults{
      {"1,2,3\n3,2,1\n2,1,1\n", ":3:", "follows 3; sort"},
      {"1,2,3\n2,2,1\n2,1,1\n", ":3:", "stands on line 2 already"},
      {"# c\n\n1,2,3\n2,nan,1\n", ":4:", "not finite"},
      {"1,2,3\n2,1,-inf\n", ":2:", "not finite"},
      {"1,2,3\n2,1e400,0\n", ":2:", "beyond the range"},
      {"1;2;3\n1,5;2;3\n", ":2:", "decimal comma"},
      {"1,5;2,0;3,0\n2,5;2,0;3,0\n", ":1:", "decimal comma"},
      {"10,5,2,0,3,0\n11,5,2,0,3,0\n", ":1:", "write decimal points"},
      {"1,2,3\n2,1\n", ":2:", "2 columns where 3 are expected"},
      {"1 2 3\n2 1 0\n", ":2:", "separated by comma, semicolon or tab"},
      {"1,2,3\n2,one,0\n", ":2:", "\"one\" is not a number"},
      {"1,2,3\n2,1.5e,0\n", ":2:", "is not a number"},
      {"-1,2,3\n2,1,0\n", ":1:", "is negative"},
      {"1,2,3\n2,\"1,0\n", ":2:", "not closed"},
      {"f,re,im\n1,2,3\n", "", "two at least"},
      {std::string("1,2,3\n2,1\0,0\n", 13), ": byte 9", "is 0, which no text has"},
      {"# nothing\nf,re,im\n", "", "no line of data"},
      {"", "", "no line of data"},
  };
  for (const Fault& fault : faults) {
    const auto file = write("frf.csv", fault.content);
    const std::string message = message_of<core::DataError>([&] { (void)read_frf(file, metres_per_newton); });
    EXPECT_NE(message.find(file.string() + fault.place), std::string::npos) << message;
    EXPECT_NE(message.find(fault.cause), std::string::npos) << message << "\n instead of: " << fault.cause;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_THROW((void)read_frf(path("absent.csv"), metres_per_newton), core::DataError);
}

TEST_F(MeasuredFrfFile, MayStartAtZeroHertzOnlyAsReceptance) {
  const auto file = write("frf.csv", "0,2,0\n1,2,0\n");
  EXPECT_EQ(read_frf(file, metres_per_newton).H(0), Complex(2.0, 0.0));
  for (const auto& format : {frf_format("mobility", "m/s/N", "Hz"), frf_format("accelerance", "m/s^2/N", "Hz")}) {
    const std::string message = message_of<core::DataError>([&] { (void)read_frf(file, format); });
    EXPECT_NE(message.find(":1: frequency 0 has no receptance"), std::string::npos) << message;
  }
}

TEST(FrfFormat, RefusesWordsThatDoNotFitTogether) {
  const auto refusal = [](const std::string& quantity, const std::string& unit, const std::string& frequency) {
    return message_of<core::InputError>([&] { (void)frf_format(quantity, unit, frequency); });
  };
  EXPECT_NE(refusal("mobillity", "m/s/N", "Hz").find("did you mean \"mobility\""), std::string::npos);
  EXPECT_NE(refusal("receptance", "m/s/N", "Hz").find("is a unit of mobility"), std::string::npos);
  EXPECT_NE(refusal("receptance", "g/N", "Hz").find("no unit of receptance"), std::string::npos);
  EXPECT_NE(refusal("receptance", "N/m", "Hz").find("no unit of receptance"), std::string::npos);
  EXPECT_NE(refusal("receptance", "m/N", "1/s").find("Hz, kHz, rad/s"), std::string::npos);
  EXPECT_DOUBLE_EQ(frf_format("accelerance", "1/kg", "Hz").unit_in_si, 1.0);
}

TEST(ResampledFrf, IsUntouchedOnAnEqualAxis) {
  const MeasuredFrf frf = measured(100.0, 0.7, 301);
  EXPECT_EQ(resample(frf, frf.axis), frf.H);
}

TEST(ResampledFrf, IsExactForCubics) {
  MeasuredFrf frf = measured(0.0, 1.0, 12);
  const auto cubic = [](double x) { return Complex(1.0 - x + 0.1 * x * x * x, 2.0 * x * x); };
  frf.axis.hz(5) += 0.3;  // uneven spacing
  frf.H = frf.axis.hz.unaryExpr(cubic);
  const auto axis = dynamics::linear_axis(0.0, 11.0, 101);
  const Eigen::VectorXcd exact = axis.hz.unaryExpr(cubic);
  EXPECT_LE((resample(frf, axis) - exact).cwiseAbs().maxCoeff(), 1e-13 * exact.cwiseAbs().maxCoeff());
}

TEST(ResampledFrf, HasTheResonanceBetweenLinesThatStepOverIt) {
  constexpr double half_width = 0.02 * 200.0;
  const double peak = std::abs(receptance(200.0));
  const auto axis = dynamics::linear_axis(150.0, 250.0, 4001);
  for (const double spacing : {0.1 * half_width, half_width, 2.5 * half_width}) {
    const MeasuredFrf frf = measured(120.0, spacing, static_cast<int>(160.0 / spacing) + 1);
    EXPECT_LE(largest_error(frf, axis), 1e-9 * peak) << spacing;
  }
}

TEST(ResampledFrf, DoesNotAmplifyNoise) {
  MeasuredFrf frf = measured(120.0, 1.0, 161);
  const double noise = 1e-3 * std::abs(receptance(200.0));
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0.0, noise);
  for (Complex& H : frf.H) {
    const double real = normal(random);
    H += Complex(real, normal(random));
  }
  const auto axis = dynamics::linear_axis(125.0, 275.0, 3001);
  double squares = 0.0;
  const Eigen::VectorXcd between = resample(frf, axis);
  for (Eigen::Index i = 0; i < axis.size(); ++i) squares += std::norm(between(i) - receptance(axis.hz(i)));
  EXPECT_LT(std::sqrt(squares / static_cast<double>(axis.size())), 1.2 * std::sqrt(2.0) * noise);
}

TEST(ResampledFrf, NeverExtrapolates) {
  const MeasuredFrf frf = measured(100.0, 1.0, 101);
  const std::string message =
      message_of<core::DataError>([&] { (void)resample(frf, dynamics::linear_axis(150.0, 250.0, 11)); });
  EXPECT_NE(message.find("hammer.csv: measured from 100 to 200 Hz, asked for 150 to 250 Hz"), std::string::npos)
      << message;
  EXPECT_THROW((void)resample(frf, dynamics::linear_axis(99.9, 150.0, 11)), core::DataError);
}

TEST(ResampledCoherence, IsStraightBetweenItsLines) {
  MeasuredFrf frf = measured(10.0, 10.0, 2);
  EXPECT_EQ(coherence_on(frf, {Eigen::VectorXd::Constant(1, 15.0)}).size(), 0) << "it has none";
  frf.coherence = Eigen::VectorXd{{0.8, 1.0}};
  EXPECT_EQ(coherence_on(frf, frf.axis), frf.coherence);
  const Eigen::VectorXd between = coherence_on(frf, {Eigen::VectorXd{{10.0, 12.5, 15.0}}});
  EXPECT_LT((between - Eigen::Vector3d(0.8, 0.85, 0.9)).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_THROW((void)coherence_on(frf, {Eigen::VectorXd{{15.0, 21.0}}}), core::DataError);
}

TEST_F(MeasuredFrfFile, MayHaveItsCoherenceInAFourthColumnThatSaysSo) {
  const std::string lines = "10,1e-6,-2e-7,0.5\n20,2e-6,-3e-7,1\n";
  const MeasuredFrf frf = read_frf(write("frf.csv", "Hz,re,im,Coherence\n" + lines), metres_per_newton);
  EXPECT_EQ(frf.coherence, Eigen::Vector2d(0.5, 1.0));
  EXPECT_EQ(frf.H(1), Complex(2e-6, -3e-7));
  EXPECT_EQ(read_frf(write("none.csv", "10,1e-6,0\n20,2e-6,0\n"), metres_per_newton).coherence.size(), 0);
  for (const std::string& header : {std::string(), std::string("Hz,re,im,phase\n")}) {
    const auto file = write("unnamed.csv", header + lines);
    EXPECT_THROW((void)read_frf(file, metres_per_newton), core::DataError) << "a fourth column is not guessed";
  }
  const auto file = write("wrong.csv", "Hz,re,im,coherence\n10,1e-6,0,0.5\n20,2e-6,0,1.5\n");
  const std::string message = message_of<core::DataError>([&] { (void)read_frf(file, metres_per_newton); });
  EXPECT_NE(message.find("wrong.csv:3: the coherence 1.5 lies outside"), std::string::npos) << message;
}

TEST_F(MeasuredFrfFile, MayHaveItsCoherenceInAFileOfItsOwn) {
  MeasuredFrf frf = read_frf(write("frf.csv", "10,1e-6,0\n20,2e-6,0\n"), metres_per_newton);
  add_coherence(frf, write("coherence.csv", "f,gamma2\n0.01,0.5\n0.02,0.25\n"), 1e3);
  EXPECT_EQ(frf.coherence, Eigen::Vector2d(0.5, 0.25));
  for (const char* other : {"10,0.5\n", "10,0.5\n21,0.5\n", "10,0.5\n20,-0.5\n", "10,0.5,1\n20,0.5,1\n"}) {
    EXPECT_THROW(add_coherence(frf, write("other.csv", other), 1.0), core::DataError) << other;
  }
}

}  // namespace thinwall::io::test::frf_csv_test
