#include "milling/simulation/growth.hpp"

#include <algorithm>
#include <cmath>

#include "milling/direct/dominant_eigenvalue.hpp"
#include "milling/simulation/march.hpp"
#include "milling/simulation/simulation.hpp"

namespace thinwall::milling {

namespace {

constexpr double eigenvalue_tolerance = 1e-10;
constexpr double any_feed_m = 1e-4;  // drops out

/// Without an estimate.
SimulatedGrowth growth_with(const RelativeStructure& structure, MillingProcess process, double rpm, double depth_m,
                            const StepOptions& options) {
  process.cutter.runout_m.clear();  // drops out as well, and would make the period a turn
  const CircularCut cut = circular_cut(structure, process, rpm, depth_m, any_feed_m, options);
  const LinearVariation force{coefficients_of_teeth(process), per_slope(process.damping, process.cutter)};
  March march(cut, force);
  CutState state = at_rest(cut);
  const Eigen::Index modes = state.modes.size();
  const auto surfaces = static_cast<Eigen::Index>(state.surface_m.size());
  const Unseen unseen;
  bool settled = true;
  const LinearMap period = [&](const Eigen::Ref<const Eigen::VectorXd>& in, Eigen::Ref<Eigen::VectorXd> out) {
    state.modes = in.head(modes);
    std::copy_n(in.data() + modes, surfaces, state.surface_m.data());
    settled = march.over_period(state, unseen) == 0 && settled;
    out.head(modes) = state.modes;
    std::copy_n(state.surface_m.data(), surfaces, out.data() + modes);
  };
  const DominantEigenvalue mu = dominant_eigenvalue(period, modes + surfaces, eigenvalue_tolerance);
  SimulatedGrowth growth;
  growth.multiplier = mu.value;
  growth.modulus = std::abs(mu.value);
  growth.residual = mu.residual;
  growth.steps = cut.grid.steps();
  growth.converged = mu.converged && settled && std::isfinite(growth.modulus);
  return growth;
}

}  // namespace

SimulatedGrowth simulated_growth(const RelativeStructure& structure, const MillingProcess& process,
                                 double spindle_speed_rpm, double depth_m, const StepOptions& options) {
  require_usable(process, process.coefficients, {spindle_speed_rpm, depth_m, any_feed_m}, {options});
  SimulatedGrowth growth = growth_with(structure, process, spindle_speed_rpm, depth_m, options);
  StepOptions coarse = options;
  coarse.steps_in_cut = std::max(4, options.steps_in_cut / 2);
  coarse.discs = std::max(1, options.discs / 2);
  const SimulatedGrowth before = growth_with(structure, process, spindle_speed_rpm, depth_m, coarse);
  growth.converged = growth.converged && before.converged;
  growth.error_estimate = std::abs(growth.modulus - before.modulus) / growth.modulus;
  if (coarse.steps_in_cut > options.steps_in_cut / 2) growth.error_estimate = 1.0;  // nothing coarser to compare with
  return growth;
}

}  // namespace thinwall::milling
