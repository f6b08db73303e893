#include "study/error_budget.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "coupling/error_budget.hpp"
#include "setup/measured_noise.hpp"
#include "study/part/part_damping.hpp"
#include "study/part/part_stage.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

/// Model less truth, line by line.
std::vector<Eigen::MatrixXcd> difference(const dynamics::ResponseModel& model, const dynamics::ResponseModel& truth) {
  std::vector<Eigen::MatrixXcd> list;
  list.reserve(model.H.size());
  for (std::size_t line = 0; line < model.H.size(); ++line) list.emplace_back(model.H[line] - truth.H[line]);
  return list;
}

/// The deviation of a component by its files' noise; none where a sensor's mass was taken off, which changes the noise,
/// too.
coupling::Deviations noise_of(const std::string& whose, const std::vector<setup::MeasuredFrf>& files,
                              const std::vector<setup::Sensor>& sensors, const dynamics::ResponseModel& response) {
  if (sensors.empty() || !setup::any_noise(files)) return setup::measured_deviations(files, response);
  core::warn(fmt::format("the noise of the {}'s FRFs is not followed: a sensor's mass was taken off them", whose));
  return {};
}

/// Noise of both components into the coupled response, whose kernel is not regularised; empty if neither is noisy.
coupling::Deviations coupled_noise(const Results& results, const ErrorBudget& budget) {
  if (budget.part.noise.empty() && budget.robot.noise.empty()) return {};
  return coupling::error_budget({results.part->response, results.robot->response}, contacts_of(results.contacts),
                                {{budget.part.noise}, {budget.robot.noise}})
      .noise;
}

/// The part with what its reduction left out (reduction/trust/truncation.hpp), damped as the part is. None of a
/// measured part, or where nothing was left out.
std::optional<Component> richer_part(const setup::Damping& damping, const Results& results,
                                     const dynamics::FrequencyAxis& axis) {
  if (!results.finite_elements || !results.finite_elements->damped) return std::nullopt;
  const reduction::CraigBampton& reduced = *results.finite_elements->reduced;
  const dynamics::SpatialModel richer = reduction::with_left_out(reduced.model, *results.finite_elements->truncation);
  if (richer.size() == reduced.model.size()) return std::nullopt;
  auto identified = results.finite_elements->identified;
  return component(damped(damping, richer, identified), axis);
}

void add_coupled_truncation(const coupling::CouplingOptions& options, const Results& results, ErrorBudget& budget) {
  const Component& richer = *budget.richer_part;
  const auto contacts = contacts_of(results.contacts);
  budget.coupled.truncation =
      difference(results.coupled->receptance.response,
                 coupling::couple(richer.response, results.robot->response, contacts, options).response);
  if (results.coupled->modal)
    budget.richer_coupled = modes_of(coupling::couple(*richer.spatial, *results.robot->spatial, contacts));
}

}  // namespace

ErrorBudget error_budget(const BudgetInput& input, const Results& results) {
  ErrorBudget budget;
  if (results.part) {
    budget.richer_part = richer_part(input.damping, results, results.part->response.axis);
    if (budget.richer_part) budget.part.truncation = difference(results.part->response, budget.richer_part->response);
    budget.part.noise = noise_of("part", input.measured_part, input.part_sensors, results.part->response);
  }
  if (const auto* robot = input.robot ? std::get_if<setup::MeasuredRobot>(&input.robot->model) : nullptr)
    budget.robot.noise = noise_of("robot", robot->measured, robot->sensors, results.robot->response);
  const bool exact = !budget.richer_part && budget.part.noise.empty() && budget.robot.noise.empty();
  if (!results.coupled || exact) return budget;
  const coupling::CouplingOptions options = coupling_options(input.coupling);
  if (options.regularisation != coupling::Regularisation::none) {
    core::warn("no error budget of the coupled response: its kernel is regularised");
    return budget;
  }
  budget.coupled.noise = coupled_noise(results, budget);
  if (budget.richer_part) add_coupled_truncation(options, results, budget);
  return budget;
}

}  // namespace thinwall::study
