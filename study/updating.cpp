#include "study/updating.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "setup/robot_tip.hpp"
#include "study/least_squares.hpp"
#include "study/part/part_damping.hpp"
#include "study/part/part_evaluation.hpp"
#include "study/part/part_stage.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

double ranked(const setup::UpdatingTarget& target, const std::vector<Participation>& modes) {
  if (static_cast<std::size_t>(target.rank) > modes.size()) throw no_such_mode(target, modes.size());
  return modes[static_cast<std::size_t>(target.rank) - 1].frequency_hz;
}

double coupled_frequency(const setup::UpdatingTarget& target, const dynamics::ModalModel& coupled) {
  if (target.match == setup::ModeMatch::participation)
    return ranked(target, participating_modes(coupled, target.point));
  const auto modes = dynamics::oscillating_modes(coupled);
  if (static_cast<std::size_t>(target.rank) > modes.size()) throw no_such_mode(target, modes.size());
  return dynamics::summarise(coupled.poles(modes[static_cast<std::size_t>(target.rank) - 1])).frequency_hz;
}

/// Frequency at which a reduction is read: the one given, or that of the part's mode.
double reading_frequency(const setup::UpdatingTarget& target, const dynamics::ModalModel& part) {
  if (target.frequency_hz > 0.0) return target.frequency_hz;
  return ranked(target, participating_modes(part, target.point));
}

/// 1 − |G|/|H| at the target's point, by receptances at one frequency.
double reduction_at(const setup::Setup& now, const setup::UpdatingTarget& target, const Component& part) {
  dynamics::FrequencyAxis line;
  line.hz = Eigen::VectorXd::Constant(1, reading_frequency(target, *part.modal));
  const dynamics::ResponseModel H = part.spatial->has_structural_damping()
                                        ? dynamics::direct_response(*part.spatial, line)
                                        : dynamics::to_response(*part.modal, line);
  const auto G = coupling::couple(H, robot_component(*now.robot, line, setup::robot_posture(now, now).posture).response,
                                  contacts_of(setup::joined_contacts(now, now)), coupling_options(now.coupling))
                     .response.H.front();
  const auto row = static_cast<Eigen::Index>(dynamics::row_of(H.responses, target.point));
  return 1.0 - std::abs(G(row, row)) / std::abs(H.H.front()(row, row));
}

void require_held(const dynamics::SpatialModel& part) {
  if (dynamics::undamped_modes(part).omega_rad_s.minCoeff() >= 1e-3 * 2.0 * std::numbers::pi) return;
  throw core::InputError("updating on = \"coupled\" needs a part that is held; add part.supports");
}

/// Modes of part and robot joined only if a target asks for them, and receptances likewise.
Eigen::VectorXd evaluate_coupled(const setup::Setup& now, const setup::Updating& updating,
                                 const dynamics::SpatialModel& reduced) {
  const auto is_frequency = [](const setup::UpdatingTarget& target) {
    return target.quantity == setup::FittedQuantity::coupled_frequency;
  };
  std::vector<reduction::IdentifiedMode> identified;
  Component part;
  part.spatial = damped(now.damping, reduced, identified);
  require_held(*part.spatial);
  if (!std::ranges::all_of(updating.targets, is_frequency)) part.modal = modes_of(*part.spatial);
  dynamics::ModalModel coupled;
  if (std::ranges::any_of(updating.targets, is_frequency))
    coupled = modes_of(coupling::couple(*part.spatial, setup::robot_matrices(now, now),
                                        contacts_of(setup::joined_contacts(now, now))));
  Eigen::VectorXd values(static_cast<Eigen::Index>(updating.targets.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const setup::UpdatingTarget& target = updating.targets[static_cast<std::size_t>(i)];
    values(i) = is_frequency(target) ? coupled_frequency(target, coupled) : reduction_at(now, target, part);
  }
  return values;
}

double residual(const setup::UpdatingTarget& target, double value) {
  if (target.quantity == setup::FittedQuantity::reduction_at)
    return target.weight * std::log((1.0 - value) / (1.0 - target.value));
  return target.weight * (value - target.value) / target.value;
}

setup::VariedSetup with_parameters(const setup::Variation& variation, const setup::VariedSetup& source,
                                   const setup::Updating& updating, const Eigen::VectorXd& scaled) {
  setup::NamedValues values = source.values;
  for (std::size_t k = 0; k < updating.parameters.size(); ++k) {
    const auto& p = updating.parameters[k];
    values[p.key] = p.lower + scaled(static_cast<Eigen::Index>(k)) * (p.upper - p.lower);
  }
  return {variation.with(values), values};
}

/// `slopes`: ∂ values / ∂ scaled parameters of the case evaluated last; empty: by differences.
UpdatingResult fit(const setup::Variation& variation, setup::VariedSetup& source, const setup::Updating& updating,
                   const std::function<Eigen::VectorXd(const setup::VariedSetup&)>& evaluate,
                   const std::function<Eigen::MatrixXd(const setup::VariedSetup&)>& slopes) {
  Eigen::VectorXd start(static_cast<Eigen::Index>(updating.parameters.size()));
  UpdatingResult result;
  result.name = updating.name;
  for (Eigen::Index k = 0; k < start.size(); ++k) {
    const auto& p = updating.parameters[static_cast<std::size_t>(k)];
    const double value = setup::value_of(variation, source, p.key);
    start(k) = (value - p.lower) / (p.upper - p.lower);
    result.parameters.push_back({p.key, p.unit, value, 0.0, p.lower, p.upper, false});
  }
  const auto residuals = [&](const Eigen::VectorXd& scaled) {
    ++result.evaluations;
    const Eigen::VectorXd values = evaluate(with_parameters(variation, source, updating, scaled));
    Eigen::VectorXd r(values.size());
    for (Eigen::Index i = 0; i < r.size(); ++i)
      r(i) = residual(updating.targets[static_cast<std::size_t>(i)], values(i));
    return r;
  };
  const auto relative_slopes = [&](const Eigen::VectorXd& scaled, const Eigen::VectorXd&) {
    Eigen::MatrixXd jacobian = slopes(with_parameters(variation, source, updating, scaled));
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i) {
      const setup::UpdatingTarget& target = updating.targets[static_cast<std::size_t>(i)];
      jacobian.row(i) *= target.weight / target.value;
    }
    return jacobian;
  };
  const LeastSquares found = bounded_least_squares(
      residuals, slopes ? JacobianAt(relative_slopes) : forward_differences(residuals, 0.02), start, 1e-4, 12);
  result.converged = found.converged;
  source = with_parameters(variation, source, updating, found.parameters);
  for (Eigen::Index k = 0; k < start.size(); ++k) {
    auto& p = result.parameters[static_cast<std::size_t>(k)];
    p.fitted = setup::value_of(variation, source, p.key);
    p.at_bound = found.parameters(k) <= 0.0 || found.parameters(k) >= 1.0;
  }
  for (Eigen::Index i = 0; i < found.residuals.size(); ++i) {
    const setup::UpdatingTarget& target = updating.targets[static_cast<std::size_t>(i)];
    UpdatingResult::Target reached{core::word_of(target.quantity), target.value, 0.0, {}};
    const double r = found.residuals(i) / target.weight;
    const bool remains = target.quantity == setup::FittedQuantity::reduction_at;
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

PartUpdating update_part(const setup::Variation& variation, setup::VariedSetup& source, const setup::Updating& updating,
                         const mesh::TetMesh& mesh, int order) {
  PartEvaluation evaluation(variation, source.setup, updating, mesh, order);
  PartUpdating result{fit(
                          variation, source, updating, [&](const setup::VariedSetup& now) { return evaluation(now); },
                          [&](const setup::VariedSetup& now) { return evaluation.slopes(now); }),
                      {}};
  result.solved = evaluation.take(source);
  return result;
}

UpdatingResult update_coupled(const setup::Variation& variation, setup::VariedSetup& source,
                              const setup::Updating& updating, const dynamics::SpatialModel& reduced) {
  return fit(variation, source, updating,
             [&](const setup::VariedSetup& now) { return evaluate_coupled(now.setup, updating, reduced); }, {});
}

}  // namespace thinwall::study
