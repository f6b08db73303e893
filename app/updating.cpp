#include "app/updating.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "app/least_squares.hpp"
#include "app/part_evaluation.hpp"
#include "app/part_stage.hpp"
#include "app/support_stage.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::app {

namespace {

double ranked(const UpdatingTarget& target, const std::vector<Participation>& modes) {
  if (static_cast<std::size_t>(target.rank) > modes.size()) throw no_such_mode(target, modes.size());
  return modes[static_cast<std::size_t>(target.rank) - 1].frequency_hz;
}

/// `line`: of the frequency axis, for this target.
double coupled_value(const UpdatingTarget& target, const Component& part, const CouplingResult& coupled,
                     Eigen::Index line) {
  if (target.quantity == "coupled_frequency") {
    if (target.match == "participation") return ranked(target, participating_modes(*coupled.modal, target.point));
    const auto modes = dynamics::oscillating_modes(*coupled.modal);
    if (static_cast<std::size_t>(target.rank) > modes.size()) throw no_such_mode(target, modes.size());
    return dynamics::summarise(coupled.modal->poles(modes[static_cast<std::size_t>(target.rank) - 1])).frequency_hz;
  }
  const auto row = static_cast<Eigen::Index>(dynamics::row_of(part.response.responses, target.point));
  const auto at = static_cast<std::size_t>(line);
  return 1.0 - std::abs(coupled.receptance.response.H[at](row, row)) / std::abs(part.response.H[at](row, row));
}

/// Frequency at which a reduction is read: the one given, or that of the part's mode.
double reading_frequency(const UpdatingTarget& target, const dynamics::ModalModel& part) {
  if (target.quantity != "reduction_at") return 1.0;
  if (target.frequency_hz > 0.0) return target.frequency_hz;
  return ranked(target, participating_modes(part, target.point));
}

/// The frequencies that the targets are read at, rising, each once.
dynamics::FrequencyAxis axis_of(const std::vector<double>& reading_hz) {
  const std::set<double> lines(reading_hz.begin(), reading_hz.end());
  dynamics::FrequencyAxis axis;
  axis.hz.resize(static_cast<Eigen::Index>(lines.size()));
  std::copy(lines.begin(), lines.end(), axis.hz.begin());
  return axis;
}

Eigen::VectorXd evaluate_coupled(const Case& now, const Updating& updating, const dynamics::SpatialModel& reduced) {
  std::vector<reduction::IdentifiedMode> identified;
  const dynamics::SpatialModel matrices = damped(now, reduced, identified);
  Component part = component(matrices, axis_of({1.0}));
  if (!part.modal) throw core::InputError("updating on = \"coupled\" needs a part that is held; add part.supports");
  std::vector<double> reading_hz;
  reading_hz.reserve(updating.targets.size());
  for (const UpdatingTarget& target : updating.targets) reading_hz.push_back(reading_frequency(target, *part.modal));
  const dynamics::FrequencyAxis axis = axis_of(reading_hz);
  part.response = matrices.has_structural_damping() ? dynamics::direct_response(matrices, axis)
                                                    : dynamics::to_response(*part.modal, axis);
  const Component robot = robot_component(now, axis);
  if (!robot.spatial) throw core::InputError("updating on = \"coupled\" needs a robot of one mode, not a measured one");
  const CouplingResult coupled = couple(now, part, robot);
  Eigen::VectorXd values(static_cast<Eigen::Index>(updating.targets.size()));
  for (std::size_t i = 0; i < updating.targets.size(); ++i) {
    const auto line = std::lower_bound(axis.hz.begin(), axis.hz.end(), reading_hz[i]) - axis.hz.begin();
    values(static_cast<Eigen::Index>(i)) = coupled_value(updating.targets[i], part, coupled, line);
  }
  return values;
}

double residual(const UpdatingTarget& target, double value) {
  if (target.quantity == "reduction_at") return target.weight * std::log((1.0 - value) / (1.0 - target.value));
  return target.weight * (value - target.value) / target.value;
}

Case with_parameters(const Case& source, const Updating& updating, const Eigen::VectorXd& scaled) {
  Case now = source;
  for (std::size_t k = 0; k < updating.parameters.size(); ++k) {
    const auto& p = updating.parameters[k];
    set_value(now, p.key, p.lower + scaled(static_cast<Eigen::Index>(k)) * (p.upper - p.lower));
  }
  return now;
}

/// `slopes`: ∂ values / ∂ scaled parameters of the case evaluated last; empty: by differences.
UpdatingResult fit(Case& source, const Updating& updating, const std::function<Eigen::VectorXd(const Case&)>& evaluate,
                   const std::function<Eigen::MatrixXd(const Case&)>& slopes) {
  Eigen::VectorXd start(static_cast<Eigen::Index>(updating.parameters.size()));
  UpdatingResult result;
  result.name = updating.name;
  for (Eigen::Index k = 0; k < start.size(); ++k) {
    const auto& p = updating.parameters[static_cast<std::size_t>(k)];
    const double value = get_value(source, p.key);
    start(k) = (value - p.lower) / (p.upper - p.lower);
    result.parameters.push_back({p.key, value, 0.0, p.lower, p.upper, false});
  }
  const auto residuals = [&](const Eigen::VectorXd& scaled) {
    ++result.evaluations;
    const Eigen::VectorXd values = evaluate(with_parameters(source, updating, scaled));
    Eigen::VectorXd r(values.size());
    for (Eigen::Index i = 0; i < r.size(); ++i)
      r(i) = residual(updating.targets[static_cast<std::size_t>(i)], values(i));
    return r;
  };
  const auto relative_slopes = [&](const Eigen::VectorXd& scaled, const Eigen::VectorXd&) {
    Eigen::MatrixXd jacobian = slopes(with_parameters(source, updating, scaled));
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
      const UpdatingTarget& target = updating.targets[static_cast<std::size_t>(i)];
      jacobian.row(i) *= target.weight / target.value;
    }
    return jacobian;
  };
  const LeastSquares found = bounded_least_squares(
      residuals, slopes ? JacobianAt(relative_slopes) : forward_differences(residuals, 0.02), start, 1e-4, 12);
  result.converged = found.converged;
  source = with_parameters(source, updating, found.parameters);
  for (Eigen::Index k = 0; k < start.size(); ++k) {
    auto& p = result.parameters[static_cast<std::size_t>(k)];
    p.fitted = get_value(source, p.key);
    p.at_bound = found.parameters(k) <= 0.0 || found.parameters(k) >= 1.0;
  }
  for (Eigen::Index i = 0; i < found.residuals.size(); ++i) {
    const UpdatingTarget& target = updating.targets[static_cast<std::size_t>(i)];
    UpdatingResult::Target reached{target.quantity, target.value, 0.0, {}};
    const double r = found.residuals(i) / target.weight;
    const bool remains = target.quantity == "reduction_at";
    reached.reached = remains ? 1.0 - (1.0 - target.value) * std::exp(r) : target.value * (1.0 + r);
    for (Eigen::Index k = 0; k < start.size(); ++k) {
      const auto& p = result.parameters[static_cast<std::size_t>(k)];
      const double relative = found.jacobian(i, k) / target.weight * p.fitted / (p.upper - p.lower);
      reached.sensitivity.push_back(remains ? relative : relative * target.value / reached.reached);
    }
    result.targets.push_back(std::move(reached));
  }
  return result;
}

}  // namespace

PartUpdating update_part(Case& source, const Updating& updating, const mesh::TetMesh& mesh, int order) {
  PartEvaluation evaluation(source, updating, mesh, order);
  PartUpdating result{fit(
                          source, updating, [&](const Case& now) { return evaluation(now); },
                          [&](const Case& now) { return evaluation.slopes(now); }),
                      {}};
  result.solved = evaluation.take(source);
  return result;
}

UpdatingResult update_coupled(Case& source, const Updating& updating, const dynamics::SpatialModel& reduced) {
  return fit(source, updating, [&](const Case& now) { return evaluate_coupled(now, updating, reduced); }, {});
}

}  // namespace thinwall::app
