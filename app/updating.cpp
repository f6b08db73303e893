#include "app/updating.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "app/least_squares.hpp"
#include "app/part_stage.hpp"
#include "app/support_stage.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "fem/points.hpp"

namespace thinwall::app {

namespace {

[[noreturn]] void no_such_mode(const UpdatingTarget& target, std::size_t found) {
  throw core::InputError("updating: mode " + std::to_string(target.rank) + " at " + target.point +
                         " was asked for, but only " + std::to_string(found) +
                         " take part there; raise modes.count or modes.up_to, or choose another point");
}

double ranked(const UpdatingTarget& target, const std::vector<Participation>& modes) {
  if (static_cast<std::size_t>(target.rank) > modes.size()) no_such_mode(target, modes.size());
  return modes[static_cast<std::size_t>(target.rank) - 1].frequency_hz;
}

/// Modes of the full model that take part at "P.x" by at least a tenth of the largest share φ²/ω².
std::vector<Participation> full_participation(const Case& source, const fem::Model& model, const fem::Modes& modes,
                                              const std::string& dof) {
  const auto dot = dof.rfind('.');
  const Point& p = point(source, dof.substr(0, dot));
  const fem::NamedPoint named{p.name, position(*source.part, p), p.patch_radius, {dynamics::axis(dof.substr(dot + 1))}};
  const Eigen::VectorXd amplitude = modes.pairs.Phi.transpose() * fem::point_columns(model, named);
  std::vector<Participation> all;
  double largest = 0.0;
  for (Eigen::Index k = modes.rigid_motions; k < amplitude.size(); ++k) {
    const double share = amplitude(k) * amplitude(k) / modes.pairs.lambda(k);
    all.push_back({modes.frequency_hz(k), share});
    largest = std::max(largest, share);
  }
  std::erase_if(all, [&](const Participation& q) { return q.share < 0.1 * largest; });
  return all;
}

/// |φᵀMψ|² / (φᵀMφ ψᵀMψ) of mass-normalised shapes on one mesh: the mode most like the reference.
double most_alike(const fem::Model& model, const fem::Modes& modes, const Eigen::VectorXd& reference) {
  Eigen::Index best = 0;
  (modes.pairs.Phi.transpose() * (model.M * reference)).cwiseAbs().maxCoeff(&best);
  return modes.frequency_hz(best);
}

/// What the targets are on the part as the case now describes it.
class PartEvaluation {
 public:
  PartEvaluation(const Case& start, const Updating& updating, const mesh::TetMesh& mesh, int order)
      : updating_(updating), mesh_(mesh), order_(order), start_size_(box_size(*start.part)) {}

  Eigen::VectorXd operator()(const Case& now) {
    const fem::Model model = part_model(now, stretched(mesh_, start_size_, box_size(*now.part)), order_);
    const fem::Factored factored = fem::factorise(model);
    fem::ModeOptions options;
    options.inverse_residual = 1e-6;  // far below what a fit can tell
    options.count = 8;
    for (const auto& target : updating_.targets) options.count = std::max(options.count, target.rank + 6);
    const fem::Modes modes = fem::modes(model, factored, options);
    if (reference_.cols() == 0) reference_ = modes.pairs.Phi;
    Eigen::VectorXd values(static_cast<Eigen::Index>(updating_.targets.size()));
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const UpdatingTarget& target = updating_.targets[static_cast<std::size_t>(i)];
      const Eigen::Index number = target.rank - 1 + modes.rigid_motions;
      if (target.match == "participation") {
        values(i) = ranked(target, full_participation(now, model, modes, target.point));
      } else {
        values(i) =
            target.match == "mac" ? most_alike(model, modes, reference_.col(number)) : modes.frequency_hz(number);
      }
    }
    return values;
  }

 private:
  const Updating& updating_;
  const mesh::TetMesh& mesh_;
  int order_;
  Eigen::Vector3d start_size_;
  Eigen::MatrixXd reference_;  // shapes of the first evaluation, for MAC
};

/// `line`: of the frequency axis, for this target.
double coupled_value(const UpdatingTarget& target, const Component& part, const CouplingResult& coupled,
                     Eigen::Index line) {
  if (target.quantity == "coupled_frequency") {
    if (target.match == "participation") return ranked(target, participating_modes(*coupled.modal, target.point));
    const auto modes = dynamics::oscillating_modes(*coupled.modal);
    if (static_cast<std::size_t>(target.rank) > modes.size()) no_such_mode(target, modes.size());
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

UpdatingResult fit(Case& source, const Updating& updating,
                   const std::function<Eigen::VectorXd(const Case&)>& evaluate) {
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
    const Eigen::VectorXd values = evaluate(with_parameters(source, updating, scaled));
    Eigen::VectorXd r(values.size());
    for (Eigen::Index i = 0; i < r.size(); ++i)
      r(i) = residual(updating.targets[static_cast<std::size_t>(i)], values(i));
    return r;
  };
  const LeastSquares found = bounded_least_squares(residuals, start, 0.02, 1e-4, 12);
  result.evaluations = found.evaluations;
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

UpdatingResult update_part(Case& source, const Updating& updating, const mesh::TetMesh& mesh, int order) {
  PartEvaluation evaluation(source, updating, mesh, order);
  return fit(source, updating, [&](const Case& now) { return evaluation(now); });
}

UpdatingResult update_coupled(Case& source, const Updating& updating, const dynamics::SpatialModel& reduced) {
  return fit(source, updating, [&](const Case& now) { return evaluate_coupled(now, updating, reduced); });
}

}  // namespace thinwall::app
