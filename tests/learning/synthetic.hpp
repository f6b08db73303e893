#pragma once
// Cuts of a machine whose parameters are drawn: the truth of the tests of calibrations.

#include <cmath>
#include <random>

#include "core/draws.hpp"
#include "learning/cut_likelihood.hpp"
#include "milling/observed/multiplier_slope.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::learning::testing {

/// Two modes of the tool, two teeth, half immersion down-milling.
inline milling::Cut nominal_cut() {
  milling::Cut cut;
  cut.structure =
      milling::relative_structure(milling::testing::modal_model({{780.0, 0.0184, 0.27, Eigen::Vector3d::UnitX()},
                                                                 {750.0, 0.0186, 0.22, Eigen::Vector3d::UnitY()}}),
                                  "P");
  cut.process.cutter.teeth = 2;
  cut.process.cutter.diameter_m = 0.016;
  cut.process.coefficients = {1.1e9, 2e8};
  cut.process.engagement = milling::engagement_of(cut.process.cutter, 0.008, milling::MillingDirection::down);
  return cut;
}

/// A machine: what is known beforehand, its true parameters, and cuts whose outcomes follow from these.
struct Machine {
  CutModel model;
  Eigen::VectorXd truth;  ///< z
};

/// `cuts` cuts at drawn speeds and depths; each outcome is drawn with the probability that the likelihood gives it at
/// the true parameters, with κ = 0.1. Every second cut that chatters has its frequency, off by a hundredth. With a
/// `speed_exponent` above 0, its deviation, the coefficients fall with the speed.
inline Machine drawn_machine(unsigned seed, int cuts, double speed_exponent = 0.0) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return (static_cast<double>(random()) + 0.5) / 4294967296.0; };
  Machine machine;
  CutModel& model = machine.model;
  model.nominal = nominal_cut();
  model.parameters = milling::uncertain_parameters(model.nominal, {0.03, 0.2, 0.1, 0.15});
  if (speed_exponent > 0.0) model.parameters.push_back({milling::ParameterOf::speed_exponent, -1, speed_exponent});
  model.options.depth_limit_m = 3e-3;
  machine.truth = milling::standard_normal(std::ssize(model.parameters), random);
  for (int i = 0; i < cuts; ++i) {
    milling::ObservedCut cut{5000.0 + 8000.0 * uniform(), 2.2e-3 * uniform() + 1e-4};
    const milling::OperatingPoint at{cut.spindle_speed_rpm, cut.depth_m};
    const auto mu = milling::multiplier_slope(model.nominal, model.parameters, machine.truth, at,
                                              model.nominal.structure.poles, false);
    const bool chatters = uniform() < chatter_probability(mu.margin, 0.1);
    cut.outcome = chatters ? milling::CutOutcome::chatter : milling::CutOutcome::stable;
    const double heard = mu.frequency_hz * (1.0 + 0.01 * core::normal_draw(random));
    if (chatters && i % 2 == 0) cut.chatter_frequency_hz = heard;
    model.cuts.push_back(cut);
  }
  return machine;
}

}  // namespace thinwall::learning::testing
