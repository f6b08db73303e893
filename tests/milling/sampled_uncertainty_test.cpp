// How a limiting depth follows the samples of a receptance: a cut with a closed form, differences, and draws.

#include "milling/chart/sampled_uncertainty.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "core/error.hpp"
#include "single_mode.hpp"

namespace thinwall::milling::sampled_uncertainty_test {
namespace {

/// With THINWALL_SLOW=1 in the environment there are more speeds and draws.
const bool slow = std::getenv("THINWALL_SLOW") != nullptr;

using Complex = std::complex<double>;
using Matrix9cd = Eigen::Matrix<Complex, 9, 9>;
constexpr double pi = std::numbers::pi;

/// A slot by four teeth: two are always in the cut, a quarter turn apart, so that sin² + cos² = 1 makes the directional
/// matrix constant, K_r and K_t: one mode along x is a time-invariant loop, 1 = −w K_r G(iω) (1 − e^{−iωT}).
MillingProcess slot() {
  MillingProcess process;
  process.cutter.teeth = 4;
  process.cutter.diameter_m = 0.02;
  process.coefficients = {6e8, 2e8};
  process.engagement = engagement_of(process.cutter, process.cutter.diameter_m, MillingDirection::up);
  return process;
}

SampledReceptance sampled(const RelativeStructure& structure, const ToolFrame& frame, double to_hz, double step_hz) {
  const auto lines = static_cast<Eigen::Index>(to_hz / step_hz) + 1;
  SampledReceptance r{Eigen::VectorXd::LinSpaced(lines, 0.0, to_hz), {}};
  const RelativeStructure turned = in_tool_axes(structure, frame);
  for (const double hz : r.frequency_hz) r.H.push_back(receptance(turned, 2.0 * pi * hz));
  return r;
}

RelativeStructure one_mode() {
  return relative_structure(testing::modal_model({{600.0, 0.03, 0.4, Eigen::Vector3d::UnitX()}}), "P");
}

RelativeStructure skewed() {
  return relative_structure(testing::modal_model({{420.0, 0.03, 1.2, Eigen::Vector3d(1.0, 0.3, 0.0).normalized()},
                                                  {660.0, 0.02, 0.7, Eigen::Vector3d(-0.2, 1.0, 0.1).normalized()}}),
                            "P");
}

StabilityOptions fine() {
  StabilityOptions options;
  options.follow = 1.0;
  options.error_tolerance = 1e-6;
  options.depth_limit_m = 0.2;
  return options;
}

SampleCovariance relative_noise(const SampledReceptance& r, double share) {
  SampleCovariance covariance;
  for (const Eigen::Matrix3cd& H : r.H) {
    const Matrix9cd of = (2.0 * share * share * H.cwiseAbs2()).reshaped().cast<Complex>().asDiagonal();
    covariance.push_back(of);
  }
  return covariance;
}

LobePoint first_crossing_of(const LobeRow& row) {
  EXPECT_FALSE(row.crossings.empty());
  return row.crossings.front();
}

TEST(DepthGradient, OneModeInASlotHasItsClosedForm) {
  const MillingProcess process = slot();
  const SampledStructure structure{sampled(one_mode(), process.frame, 6000.0, 2.0), {}};
  for (const double rpm : {5300.0, 7000.0, 12000.0}) {
    const LobeRow row = limiting_depth(structure, process, rpm, fine());
    const LobePoint point = first_crossing_of(row);
    const auto gradient = depth_gradient(fitted_structure(structure, process.frame), process, rpm, point, fine());
    // ν = −K G (1 − e^{−iωT}) is real at ω, dν = ν dG/G, and ν' = ν (G'/G + iT e^{−iωT}/(1 − e^{−iωT})).
    const double omega = 2.0 * pi * point.chatter_frequency_hz, T = 60.0 / (4.0 * rpm), h = 1e-3;
    const auto G_at = [&](double w) { return receptance(in_tool_axes(one_mode(), process.frame), w)(0, 0); };
    const Complex G = G_at(omega), e = std::polar(1.0, -omega * T);
    const Complex slope = (G_at(omega + h) - G_at(omega - h)) / (2.0 * h) / G + Complex(0.0, T) * e / (1.0 - e);
    const Complex exact = -point.depth_m * Complex(1.0, slope.real() / slope.imag()) / G;  // dw = Re(exact dG)
    const LineWeights lines = line_weights(structure.samples, point.chatter_frequency_hz);
    Complex all = 0.0;
    for (std::size_t i = 0; i < gradient.size(); ++i) all += gradient[i](0, 0);
    EXPECT_LT(std::abs(all / exact - 1.0), 2e-3) << rpm << " rpm";
    const double sigma = 1e-9;
    Matrix9cd of_xx = Matrix9cd::Zero();
    of_xx(0, 0) = 2.0 * sigma * sigma;
    const SampleCovariance covariance(gradient.size(), of_xx);
    const double closed = sigma * std::abs(exact) * lines.weight.norm();
    EXPECT_NEAR(depth_deviation_m(gradient, covariance) / closed, 1.0, 0.02) << rpm << " rpm";
    // x moves by the force along y as well, which is K_t/K_r = 3 times that along x: H_xy counts three times as much.
    Complex by_y = 0.0;
    for (const Eigen::Matrix3cd& g : gradient) by_y += g(0, 1);
    EXPECT_NEAR(std::abs(by_y / all), 3.0, 1e-4);
  }
}

TEST(DepthGradient, ScalingTheReceptanceScalesTheDepth) {
  const MillingProcess process = slot();
  const SampledStructure structure{sampled(skewed(), process.frame, 6000.0, 2.0), {}};
  for (const double rpm : {2300.0, 4100.0, 9700.0}) {
    const LobePoint point = first_crossing_of(limiting_depth(structure, process, rpm, fine()));
    const auto gradient = depth_gradient(fitted_structure(structure, process.frame), process, rpm, point, fine());
    double sum = 0.0;
    for (std::size_t i = 0; i < gradient.size(); ++i)
      sum += gradient[i].cwiseProduct(structure.samples.H[i]).sum().real();
    EXPECT_NEAR(sum / point.depth_m, -1.0, 1e-5) << rpm;
  }
}

TEST(DepthGradient, IsTheDifferenceQuotientForAnyChangeOfTheSamples) {
  MillingProcess process = slot();
  process.cutter.teeth = 2;
  process.engagement = engagement_of(process.cutter, 3e-3, MillingDirection::up);  // harmonics, flips
  const SampledReceptance lines = sampled(skewed(), process.frame, 6000.0, 2.0);
  const RelativeStructure part =
      relative_structure(testing::modal_model({{1900.0, 0.01, 0.9, Eigen::Vector3d(0.1, 1.0, 0.0).normalized()}}), "P");
  for (const std::optional<RelativeStructure>& poles : {std::optional<RelativeStructure>{}, std::optional(part)}) {
    for (const double rpm : slow ? std::vector{2300.0, 5600.0, 9700.0} : std::vector{5600.0}) {
      const LobePoint point = first_crossing_of(limiting_depth(SampledStructure{lines, poles}, process, rpm, fine()));
      const auto gradient =
          depth_gradient(fitted_structure({lines, poles}, process.frame), process, rpm, point, fine());
      // smooth, near the chatter frequency, not symmetric, and where no poles are in a direction that was still
      const auto moved = [&](double step) {
        SampledReceptance other = lines;
        for (std::size_t i = 0; i < other.H.size(); ++i) {
          const double hz = other.frequency_hz(static_cast<Eigen::Index>(i));
          const double bell = std::exp(-std::pow((hz - point.chatter_frequency_hz) / 150.0, 2));
          Eigen::Matrix3cd change = Eigen::Matrix3cd::Zero();
          change(0, 0) = Complex(1.0, 0.5), change(0, 1) = Complex(-0.3, 0.8), change(1, 1) = 0.6;
          other.H[i] += step * 1e-7 * bell * change;
        }
        return other;
      };
      const auto depth = [&](double step) {
        return limiting_depth(SampledStructure{moved(step), poles}, process, rpm, fine()).limiting_depth_m;
      };
      const double h = 0.02;
      const double quotient = (depth(h) - depth(-h)) / (2.0 * h);
      const SampledReceptance one = moved(1.0);
      double predicted = 0.0;
      for (std::size_t i = 0; i < gradient.size(); ++i)
        predicted += gradient[i].cwiseProduct(one.H[i] - lines.H[i]).sum().real();
      EXPECT_NEAR(predicted / quotient, 1.0, 2e-4) << rpm << " rpm";
    }
  }
}

TEST(SampledDepths, DrawsScatterAsFirstOrderSaysWhereTheNoiseIsSmall) {
  const MillingProcess process = slot();
  const int n = slow ? 60 : 20;  // a deviation is known to 1/√(2n), 9 or 16 %
  struct Case {
    SampledStructure structure;
    double rpm;
  };
  for (const Case& c : {Case{{sampled(one_mode(), process.frame, 2000.0, 6.0), {}}, 7000.0},
                        Case{{sampled(skewed(), process.frame, 2000.0, 6.0), {}}, 4100.0}}) {
    StabilityOptions options;
    options.follow = 1.0;
    options.error_tolerance = 1e-3;
    const LobePoint point = first_crossing_of(limiting_depth(c.structure, process, c.rpm, options));
    const SampleCovariance covariance = relative_noise(c.structure.samples, 0.003);
    const double first_order = depth_deviation_m(
        depth_gradient(fitted_structure(c.structure, process.frame), process, c.rpm, point, options), covariance);
    const DepthScatter scatter =
        sampled_depths(fitted_structure(c.structure, process.frame), process, c.rpm, options, covariance, n, 5);
    EXPECT_EQ(scatter.without_limit, 0);
    EXPECT_NEAR(scatter.deviation_m / first_order, 1.0, 3.0 / std::sqrt(2.0 * n)) << c.rpm;
    EXPECT_NEAR(scatter.mean_m, point.depth_m, 4.0 * first_order / std::sqrt(n));
    EXPECT_GT(first_order, 5e-4 * point.depth_m);
    const DepthScatter again =
        sampled_depths(fitted_structure(c.structure, process.frame), process, c.rpm, options, covariance, 2, 5);
    EXPECT_EQ(again.depth_m[1], scatter.depth_m[1]) << "a seed is a result";
    std::printf("%g rpm: deviation %.3g sampled, %.3g first order, of %.3g mm\n", c.rpm, scatter.deviation_m * 1e3,
                first_order * 1e3, point.depth_m * 1e3);
  }
}

TEST(SampledDepths, RefusesCovariancesThatAreNone) {
  const MillingProcess process = slot();
  const SampledStructure structure{sampled(one_mode(), process.frame, 3000.0, 4.0), {}};
  const SampleCovariance good = relative_noise(structure.samples, 0.01);
  const auto with = [&](const SampleCovariance& covariance, int samples = 2) {
    (void)sampled_depths(fitted_structure(structure, process.frame), process, 7000.0, {}, covariance, samples, 1);
  };
  EXPECT_THROW(with({}), core::InputError);
  EXPECT_THROW(with(good, 1), core::InputError);
  SampleCovariance bad = good;
  bad[7](0, 0) = std::nan("");
  EXPECT_THROW(with(bad), core::InputError);
  bad = good;
  bad[7](0, 1) = 1.0;
  EXPECT_THROW(with(bad), core::InputError);
  bad = good;
  bad[7](0, 0) *= -1.0;
  EXPECT_THROW(with(bad), core::InputError);
  EXPECT_THROW((void)depth_deviation_m({}, good), core::InputError);
  StabilityOptions shallow;
  shallow.depth_limit_m = 1e-6;
  EXPECT_EQ(
      sampled_depths(fitted_structure(structure, process.frame), process, 7000.0, shallow, good, 2, 1).without_limit,
      2);
}

}  // namespace
}  // namespace thinwall::milling::sampled_uncertainty_test
