#include "study/part/part_evaluation.hpp"

#include <algorithm>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "fem/points.hpp"
#include "linalg/tall.hpp"
#include "setup/part_geometry.hpp"
#include "study/part/part_model.hpp"
#include "study/part/part_stage.hpp"

namespace thinwall::study {

namespace {

/// The rank-th mode that takes part at "P.x" by at least a tenth of the largest share φ²/ω².
Eigen::Index participating_mode(const setup::PartSetup& source, const Solution& part,
                                const setup::UpdatingTarget& target) {
  const auto dot = target.point.rfind('.');
  fem::NamedPoint named = setup::named_point(source, target.point.substr(0, dot));
  named.directions = {dynamics::axis(target.point.substr(dot + 1))};
  const Eigen::Index rigid = part.modes.rigid_motions;
  const Eigen::VectorXd amplitude = part.modes.pairs.Phi.transpose() * fem::point_columns(part.model, named);
  const Eigen::ArrayXd share =
      (amplitude.array().square() / part.modes.pairs.lambda.array()).tail(amplitude.size() - rigid);
  int rank = 0;
  for (Eigen::Index k = 0; k < share.size(); ++k) {
    if (share(k) < 0.1 * share.maxCoeff()) continue;
    if (++rank == target.rank) return k + rigid;
  }
  throw no_such_mode(target, static_cast<std::size_t>(rank));
}

/// |φᵀMψ|² / (φᵀMφ ψᵀMψ) of mass-normalised shapes on one mesh: the elastic mode most like the reference.
Eigen::Index most_alike(const Solution& part, const Eigen::VectorXd& reference) {
  const Eigen::Index rigid = part.modes.rigid_motions;
  const Eigen::VectorXd likeness = part.modes.pairs.Phi.transpose() * (part.model.M * reference);
  Eigen::Index best = 0;
  likeness.tail(likeness.size() - rigid).cwiseAbs().maxCoeff(&best);
  return best + rigid;
}

}  // namespace

core::InputError no_such_mode(const setup::UpdatingTarget& target, std::size_t found) {
  return core::InputError("updating: mode " + std::to_string(target.rank) + " at " + target.point +
                          " was asked for, but only " + std::to_string(found) +
                          " take part there; raise modes.count or modes.up_to, or choose another point");
}

PartEvaluation::PartEvaluation(const setup::Variation& variation, const setup::PartSetup& start,
                               const setup::Updating& updating, const mesh::TetMesh& mesh, int order)
    : variation_(variation),
      updating_(updating),
      mesh_(mesh),
      order_(order),
      start_size_(setup::box_size(*start.part)) {}

Eigen::VectorXd PartEvaluation::operator()(const setup::VariedSetup& now) {
  latest_.reset();  // its memory first
  fem::Model part = model(now);
  fem::Factored factored = fem::factorise(part, core::available_memory_bytes());
  latest_.emplace(Solution{std::move(part), std::move(factored), {}});
  latest_->modes = modes(now);
  if (reference_.cols() == 0) reference_ = latest_->modes.pairs.Phi;
  parameters_ = parameters(now);
  chosen_.clear();
  for (const setup::UpdatingTarget& target : updating_.targets) chosen_.push_back(mode_of(now, target));
  return latest_->modes.frequency_hz(chosen_);
}

fem::Model PartEvaluation::model(const setup::VariedSetup& now) const {
  return part_model(now.setup, stretched(mesh_, start_size_, setup::box_size(*now.setup.part)), order_);
}

fem::Modes PartEvaluation::modes(const setup::VariedSetup& now) {
  int needed = 8;
  for (const setup::UpdatingTarget& target : updating_.targets) needed = std::max(needed, target.rank + 6);
  fem::ModeOptions enough;
  enough.count = needed;
  enough.inverse_residual = 1e-6;  // far below what a fit can tell
  const fem::ModeOptions asked = setup::mode_options(now.setup);
  const bool first = reference_.cols() == 0;
  as_asked_ = !first && asked_suffices_ && (asked.up_to_hz || asked.count >= needed);
  if (!as_asked_) return fem::modes(latest_->model, latest_->factored, enough);
  fem::Modes found = fem::modes(latest_->model, latest_->factored, asked);
  if (found.frequency_hz.size() >= needed + found.rigid_motions) return found;
  as_asked_ = asked_suffices_ = false;
  return fem::modes(latest_->model, latest_->factored, enough);
}

Eigen::Index PartEvaluation::mode_of(const setup::VariedSetup& now, const setup::UpdatingTarget& target) const {
  const Eigen::Index number = target.rank - 1 + latest_->modes.rigid_motions;
  if (target.match == setup::ModeMatch::participation) return participating_mode(now.setup, *latest_, target);
  return target.match == setup::ModeMatch::mac ? most_alike(*latest_, reference_.col(number)) : number;
}

std::vector<double> PartEvaluation::parameters(const setup::VariedSetup& now) const {
  std::vector<double> values;
  values.reserve(updating_.parameters.size());
  for (const setup::UpdatingParameter& p : updating_.parameters)
    values.push_back(setup::value_of(variation_, now, p.key));
  return values;
}

PartEvaluation::Neighbour PartEvaluation::neighbour(const setup::VariedSetup& now,
                                                    const setup::UpdatingParameter& p) const {
  // The step as a share of the range. The neglected term is of the order h (length / thickness)², for a bending shape
  // that is carried along by a stretched mesh shears it; round-off still leaves some five digits.
  constexpr double step = 1e-5;
  const double value = setup::value_of(variation_, now, p.key);
  const double inwards = value + step * (p.upper - p.lower) <= p.upper ? step : -step;
  for (const double h : {inwards, -inwards}) {
    const setup::VariedSetup moved = setup::with_value(variation_, now, p.key, value + h * (p.upper - p.lower));
    Neighbour there{model(moved), h};
    if (there.model.free_rows == latest_->model.free_rows) return there;
  }
  throw core::InputError("updating: with " + p.key + " just off " + std::to_string(value) +
                         " the supports hold other nodes, and the frequencies jump; give the supports' selections "
                         "room around the nodes that they hold");
}

Eigen::MatrixXd PartEvaluation::slopes(const setup::VariedSetup& now) const {
  const Eigen::MatrixXd Phi = latest_->modes.pairs.Phi(Eigen::all, chosen_);
  const Eigen::VectorXd lambda = latest_->modes.pairs.lambda(chosen_);
  const Eigen::ArrayXd hz = latest_->modes.frequency_hz(chosen_);
  const auto unbalanced = [&](const fem::Model& at) -> Eigen::MatrixXd {
    return linalg::symmetric_product(at.K, Phi) - linalg::symmetric_product(at.M, Phi) * lambda.asDiagonal();
  };
  const Eigen::MatrixXd here = unbalanced(latest_->model);
  Eigen::MatrixXd result(hz.size(), static_cast<Eigen::Index>(updating_.parameters.size()));
  for (Eigen::Index k = 0; k < result.cols(); ++k) {
    const Neighbour there = neighbour(now, updating_.parameters[static_cast<std::size_t>(k)]);
    const Eigen::MatrixXd change = unbalanced(there.model) - here;
    result.col(k) = Phi.cwiseProduct(change).colwise().sum().transpose().array() /
                    (there.h * 8.0 * std::numbers::pi * std::numbers::pi * hz);
  }
  return result;
}

std::optional<Solution> PartEvaluation::take(const setup::VariedSetup& now) {
  if (!latest_ || !as_asked_ || parameters(now) != parameters_) return std::nullopt;
  return std::exchange(latest_, std::nullopt);
}

}  // namespace thinwall::study
