#include "study/identification_forecast.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/parallel.hpp"
#include "setup/identified/identify.hpp"
#include "setup/measured.hpp"

namespace thinwall::study {

namespace {

/// The numbers that are learned: two a mode, and the real and imaginary parts of its residue at the tip.
double learned_numbers(const setup::TabledRobot& robot) {
  const dynamics::ModalTable& first = robot.tapped->tables.front();
  const auto dofs = static_cast<double>(
      std::ranges::count(first.dofs, robot.table_point, [](const dynamics::Dof& dof) { return dof.point; }));
  return static_cast<double>(first.rows.size()) * (2.0 + 2.0 * dofs * dofs);
}

/// One process: sweeps of slice sampling over its hyper-parameters, some five likelihoods each (averaged_process.hpp).
double process_s(double postures, double columns) {
  const double samples = std::min(80.0, std::max(12.0, 1500.0 / postures));
  const double likelihoods = (12.0 + 2.0 * samples) * (columns + 2.0) * 5.0;
  return likelihoods * (2e-10 * std::pow(postures, 3) + 5e-9 * std::pow(postures, 2) + 2e-6);
}

double learning_s(const setup::SupportSetup& source) {
  if (!setup::awaits_learning(source)) return 0.0;
  const auto& robot = std::get<setup::TabledRobot>(source.robot->model);
  if (!robot.tapped) return 0.0;
  return learned_numbers(robot) *
         process_s(static_cast<double>(robot.tapped->names.size()), static_cast<double>(robot.postures->over.size()));
}

double fitting_s(const setup::CutSetup& source) {
  constexpr double a_line = 4e-3;  // of an entry: the search for poles, and the draws over two threads
  if (!setup::awaits_fit(source)) return 0.0;
  double lines = 0.0;
  for (const setup::MeasuredFrf& file : source.tool->measured)
    lines += static_cast<double>(setup::receptance_of(file).axis.size()) * (file.response == file.force ? 1.0 : 2.0);
  return lines * a_line;
}

}  // namespace

double forecast_identification(const setup::Setup& source) {
  return learning_s(source) / core::thread_count() + fitting_s(source);
}

}  // namespace thinwall::study
