// What is told of a depth's errors where first order has no number: nothing, and the chart is written all the same.

#include "study/lobes/structure_errors.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/milling/single_mode.hpp"

namespace thinwall::tests::structure_errors_test {

using namespace setup;
using namespace study;

namespace {

constexpr double rpm = 7000.0;

milling::MillingProcess slot() {
  milling::MillingProcess process;
  process.cutter.teeth = 4;
  process.cutter.diameter_m = 0.02;
  process.coefficients = {6e8, 2e8};
  process.engagement = milling::engagement_of(process.cutter, process.cutter.diameter_m, milling::MillingDirection::up);
  return process;
}

milling::RelativeStructure one_mode(double mass_kg) {
  return milling::relative_structure(milling::testing::modal_model({{600.0, 0.03, mass_kg, Eigen::Vector3d::UnitX()}}),
                                     "P");
}

milling::FittedStructure sampled(const milling::MillingProcess& process) {
  milling::SampledReceptance samples{Eigen::VectorXd::LinSpaced(1001, 0.0, 5000.0), {}};
  const milling::RelativeStructure turned = milling::in_tool_axes(one_mode(0.4), process.frame);
  for (const double hz : samples.frequency_hz)
    samples.H.push_back(milling::receptance(turned, 2.0 * std::numbers::pi * hz));
  return milling::fitted_structure({samples, {}}, process.frame);
}

TEST(DepthError, WhatIsNotFiniteIsUnknown) {
  const milling::MillingProcess process = slot();
  const milling::StabilityOptions options;
  const CutStructure structure = sampled(process);
  const auto& samples = std::get<milling::FittedStructure>(structure).lines.samples;
  const milling::LobeRow row =
      milling::limiting_depth(std::get<milling::FittedStructure>(structure), process, rpm, options);
  const milling::LobePoint& point = row.crossings.front();
  StructureErrors errors;
  for (const Eigen::Matrix3cd& H : samples.H) errors.truncation.emplace_back(0.01 * H);
  errors.noise.assign(samples.H.size(), 1e-20 * milling::SampleCovariance::value_type::Identity());
  const DepthError known = depth_error(structure, errors, process, row, options);
  ASSERT_TRUE(known.truncation_m && known.noise_m);
  // A model whose receptance is 1 % too large is cut 1 % too shallow.
  EXPECT_NEAR(*known.truncation_m, -0.01 * point.depth_m, 1e-4 * point.depth_m);

  errors.truncation[200].fill(std::numeric_limits<double>::quiet_NaN());
  const DepthError without_truncation = depth_error(structure, errors, process, row, options);
  EXPECT_FALSE(without_truncation.truncation_m);
  EXPECT_EQ(without_truncation.noise_m, known.noise_m);

  errors.truncation.clear();
  errors.noise.assign(samples.H.size(), 1e308 * milling::SampleCovariance::value_type::Identity());
  EXPECT_FALSE(depth_error(structure, errors, process, row, options).noise_m) << "it overflows";
}

TEST(DepthError, OfPolesThatOverflowIsUnknown) {
  const milling::MillingProcess process = slot();
  const milling::StabilityOptions options;
  const CutStructure structure = one_mode(0.4);
  const milling::LobeRow row =
      milling::limiting_depth(std::get<milling::RelativeStructure>(structure), process, rpm, options);
  const milling::LobePoint& point = row.crossings.front();
  StructureErrors errors;
  errors.richer = one_mode(0.4 / 1.01);
  const DepthError known = depth_error(structure, errors, process, row, options);
  ASSERT_TRUE(known.truncation_m);
  EXPECT_NEAR(*known.truncation_m, 0.01 * point.depth_m, 1e-4 * point.depth_m);
  errors.richer->b *= 1e308;
  errors.richer->phi *= 1e10;
  EXPECT_FALSE(depth_error(structure, errors, process, row, options).truncation_m);
}

}  // namespace
}  // namespace thinwall::tests::structure_errors_test
