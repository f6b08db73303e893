#include "milling/simulation/simulation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>

#include "milling/simulation/march.hpp"

namespace thinwall::milling {

namespace {

/// The greatest value on [0, 1] of the parabola through values at 0, ½ and 1.
double parabola_peak(double a, double b, double c) {
  const double bend = 2.0 * (a - 2.0 * b + c);
  const double slope = -3.0 * a + 4.0 * b - c;
  const double ends = std::max({a, b, c});
  if (bend >= 0.0) return ends;
  const double at = -slope / (2.0 * bend);
  return at > 0.0 && at < 1.0 ? std::max(ends, a + 0.5 * slope * at) : ends;
}

/// Takes in the extremes of the parabola through a quantity of a step.
template <class Quantity>
void take_parabola(Extremes& extremes, const MarchStep& step, const Quantity& of) {
  for (int i = 0; i < 3; ++i) {
    const double a = of(step.at[0])[i], b = of(step.at[1])[i], c = of(step.at[2])[i];
    extremes.high[i] = std::max(extremes.high[i], parabola_peak(a, b, c));
    extremes.low[i] = std::min(extremes.low[i], -parabola_peak(-a, -b, -c));
  }
}

const Eigen::Vector3d& displacement(const MarchNode& node) {
  return node.displacement_m;
}
const Eigen::Vector3d& force(const MarchNode& node) {
  return node.force_n;
}

/// Samples of the parabolas of the steps at equal rotations.
class Tracer {
 public:
  Tracer(Trace& trace, const SimulationOptions& options, double rad_per_s)
      : trace_(trace), step_rad_(2.0 * std::numbers::pi / options.samples_a_turn) {
    const Eigen::Index samples = static_cast<Eigen::Index>(options.traced_turns) * options.samples_a_turn;
    trace_.step_s = step_rad_ / rad_per_s;
    trace_.displacement_m.setZero(3, samples);
    trace_.force_n.setZero(3, samples);
    trace_.torque_n_m.setZero(samples);
  }

  /// `period_start_rad`: rotation since the trace began.
  void see(const MarchStep& step, double period_start_rad) {
    for (; next_ < trace_.torque_n_m.size(); ++next_) {
      const double rotation = static_cast<double>(next_) * step_rad_ - period_start_rad;
      const double s = (rotation - step.from_rad) / step.step_rad;
      if (s >= 1.0) return;
      const double weight[3] = {(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)};
      for (std::size_t i = 0; i < 3; ++i) {
        trace_.displacement_m.col(next_) += weight[i] * step.at[i].displacement_m;
        trace_.force_n.col(next_) += weight[i] * step.at[i].force_n;
        trace_.torque_n_m(next_) += weight[i] * step.at[i].torque_n_m;
      }
    }
  }

 private:
  Trace& trace_;
  double step_rad_;
  Eigen::Index next_ = 0;
};

/// Sums over the recorded periods.
class Record {
 public:
  Record(const CircularCut& cut, const SimulationOptions& options, SimulatedCut& result)
      : cut_(cut),
        kept_(static_cast<std::size_t>(options.kept_passes)),
        result_(result),
        tracer_(result.trace, options, cut.rad_per_s) {
    int teeth = 0;
    for (const TipMoment& moment : cut.grid.tip_moments) teeth = std::max(teeth, moment.tooth + 1);
    open_.resize(static_cast<std::size_t>(teeth));
  }

  /// The period to be marched next begins at this time; `traced_rad`: rotation since the trace began, below 0 before.
  void begin_period(double time_s, double traced_rad) {
    period_start_s_ = time_s;
    traced_rad_ = traced_rad;
    next_moment_ = 0;
  }

  void operator()(const MarchStep& step) {
    take_parabola(result_.displacement_m, step, displacement);
    take_parabola(result_.force_n, step, force);
    if (traced_rad_ >= 0.0) tracer_.see(step, traced_rad_);
    if (step.first_node < 0) return;
    for (std::size_t i = 0; i < 3; ++i) {
      const MarchNode& node = step.at[i];
      result_.peak_force_n = std::max(result_.peak_force_n, node.force_n.norm());
      result_.peak_torque_n_m = std::max(result_.peak_torque_n_m, node.torque_n_m);
      result_.thickest_chip_m = std::max(result_.thickest_chip_m, node.thickest_chip_m);
      take_passes(step, i);
    }
    impulse_ += step.integral([](const MarchNode& n) { return Eigen::Vector3d(n.force_n); });
    work_ += step.integral([](const MarchNode& n) { return n.torque_n_m; });
    within_ += step.integral([](const MarchNode& n) { return static_cast<double>(n.points); });
    without_contact_ += step.integral([](const MarchNode& n) { return static_cast<double>(n.without_contact); });
  }

  void finish(double recorded_rad) {
    result_.mean_force_n = impulse_ / recorded_rad;
    result_.mean_torque_n_m = work_ / recorded_rad;
    result_.mean_power_w = result_.mean_torque_n_m * cut_.rad_per_s;
    result_.share_without_contact = within_ > 0.0 ? without_contact_ / within_ : 0.0;
    result_.passes.assign(passes_.begin(), passes_.end());
  }

 private:
  void take_passes(const MarchStep& step, std::size_t i) {
    const auto& moments = cut_.grid.tip_moments;
    const MarchNode& node = step.at[i];
    const int number = step.first_node + static_cast<int>(i);
    for (; next_moment_ < moments.size() && moments[next_moment_].node == number; ++next_moment_) {
      const TipMoment& moment = moments[next_moment_];
      std::optional<ToothPass>& pass = open_[static_cast<std::size_t>(moment.tooth)];
      if (moment.entry) {
        const double time = period_start_s_ + step.rotation_rad(static_cast<int>(i)) / cut_.rad_per_s;
        pass = ToothPass{moment.tooth, time, node.displacement_m, node.slope * cut_.rad_per_s, {}};
      } else if (pass) {
        pass->exit_m = node.displacement_m;
        passes_.push_back(*pass);
        pass.reset();
        if (passes_.size() > kept_) passes_.pop_front();
      }
    }
  }

  const CircularCut& cut_;
  std::size_t kept_;
  SimulatedCut& result_;
  Tracer tracer_;
  std::vector<std::optional<ToothPass>> open_;  ///< of each tooth, between entry and exit
  std::deque<ToothPass> passes_;
  std::size_t next_moment_ = 0;
  double period_start_s_ = 0.0, traced_rad_ = -1.0;
  Eigen::Vector3d impulse_ = Eigen::Vector3d::Zero();
  double work_ = 0.0, within_ = 0.0, without_contact_ = 0.0;
};

/// Displacement and velocity at the entries of the first tooth, a column each: once a period.
Eigen::MatrixXd entries_of_first_tooth(const SimulatedCut& cut, double rad_per_s) {
  std::vector<const ToothPass*> of_first;
  for (const ToothPass& pass : cut.passes) {
    if (pass.tooth == 0) of_first.push_back(&pass);
  }
  Eigen::MatrixXd samples(6, static_cast<Eigen::Index>(of_first.size()));
  for (std::size_t i = 0; i < of_first.size(); ++i)
    samples.col(static_cast<Eigen::Index>(i)) << of_first[i]->entry_m, of_first[i]->entry_m_s / rad_per_s;
  return samples;
}

bool within_radius(const CutState& state, double radius_m) {
  // Modes are scaled to their displacement at the cut. NaN fails the comparison.
  return state.modes.cwiseAbs().maxCoeff() < radius_m;
}

template <class ChipForce>
SimulatedCut run(const CircularCut& cut, const ChipForce& force, double radius_m, const SimulationOptions& options,
                 const TurnObserver& after_turn) {
  SimulatedCut result;
  Record record(cut, options, result);
  March march(cut, force);
  CutState state = at_rest(cut);
  const int turns = options.settling_turns + options.recorded_turns;
  const int settling = options.settling_turns * cut.grid.periods_a_turn;
  const int untraced = (turns - options.traced_turns) * cut.grid.periods_a_turn;
  const Unseen unseen;
  long unsettled = 0;
  int period = 0;
  for (int turn = 0; turn < turns && result.status == SimulationStatus::completed; ++turn) {
    for (int i = 0; i < cut.grid.periods_a_turn; ++i, ++period) {
      record.begin_period(period * cut.period_s(), (period - untraced) * cut.grid.period_rad);
      unsettled += period < settling ? march.over_period(state, unseen) : march.over_period(state, record);
    }
    result.simulated_s = period * cut.period_s();
    if (!within_radius(state, radius_m)) result.status = SimulationStatus::overflowed;
    if (after_turn) after_turn((turn + 1.0) / turns);
  }
  if (1000 * unsettled > static_cast<long>(period) * cut.grid.nodes() && result.status == SimulationStatus::completed)
    result.status = SimulationStatus::unsettled;
  result.trace.start_s = untraced * cut.period_s();
  record.finish(std::max(1, period - settling) * cut.grid.period_rad);
  const Eigen::MatrixXd samples = entries_of_first_tooth(result, cut.rad_per_s);
  if (samples.cols() >= 2) result.motion = motion_kind(samples, result.displacement_m.range().maxCoeff());
  if (result.status == SimulationStatus::overflowed) result.motion = {Motion::growing, 0, 0.0};
  return result;
}

std::vector<CuttingCoefficients> coefficients_of_teeth(const MillingProcess& process) {
  std::vector<CuttingCoefficients> of_tooth;
  for (int j = 0; j < process.cutter.teeth; ++j) of_tooth.push_back(coefficients(process, j));
  return of_tooth;
}

}  // namespace

std::string name(SimulationStatus status) {
  constexpr std::array<const char*, 3> names{"completed", "overflowed", "unsettled"};
  return names[static_cast<std::size_t>(status)];
}

std::vector<std::string> validate(const SimulationOptions& options) {
  std::vector<std::string> violations = validate(options.steps);
  const auto require = [&](bool holds, const char* what, int value, int least) {
    if (holds) return;
    violations.push_back("simulation: " + std::to_string(value) + " " + what + ", must be at least " +
                         std::to_string(least) + "; correct it");
  };
  require(options.settling_turns >= 0, "turns to settle", options.settling_turns, 0);
  require(options.recorded_turns >= 1, "turns to record", options.recorded_turns, 1);
  require(options.kept_passes >= 2, "passes of teeth to keep", options.kept_passes, 2);
  require(options.samples_a_turn >= 2, "samples a turn", options.samples_a_turn, 2);
  if (options.traced_turns < 0 || options.traced_turns > options.recorded_turns) {
    violations.push_back("simulation: " + std::to_string(options.traced_turns) + " turns to trace, must be 0 to the " +
                         std::to_string(options.recorded_turns) + " that are recorded; correct it");
  }
  return violations;
}

SimulatedCut simulate(const RelativeStructure& structure, const MillingProcess& process, const ForceLaw& law,
                      const SimulatedPoint& point, const SimulationOptions& options, const TurnObserver& after_turn) {
  require_valid(validate(options));
  require_valid(validate(law));
  const CircularCut cut =
      circular_cut(structure, process, point.spindle_speed_rpm, point.depth_m, point.feed_per_tooth_m, options.steps);
  const CuttingCoefficients damping = per_slope(process.damping, process.cutter);
  const double radius_m = 0.5 * process.cutter.diameter_m;
  const auto with = [&](const auto& force) { return run(cut, force, radius_m, options, after_turn); };
  if (std::holds_alternative<CuttingCoefficients>(law))
    return with(LinearContact{coefficients_of_teeth(process), damping});
  if (const auto* power = std::get_if<PowerLaw>(&law)) return with(NonlinearContact<PowerLaw>{*power, damping});
  return with(NonlinearContact<FractionalLaw>{std::get<FractionalLaw>(law), damping});
}

}  // namespace thinwall::milling
