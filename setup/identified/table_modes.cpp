#include "setup/identified/table_modes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "core/units.hpp"
#include "identification/fitted_model.hpp"
#include "io/frf/modal_table_csv.hpp"
#include "robot/freed_table.hpp"
#include "robot/modal_table.hpp"

namespace thinwall::setup {

namespace {

identification::FittedMode mode_of(const dynamics::ModalTableRow& row) {
  identification::FittedMode mode;
  mode.frequency_hz = row.frequency_hz;
  mode.damping_ratio = row.damping_ratio;
  mode.residue = row.right * row.left.transpose();
  Eigen::Index largest = 0;
  row.left.cwiseAbs().maxCoeff(&largest);
  const std::complex<double> scale = row.left(largest);
  mode.left = row.left / scale;
  mode.right = row.right * scale;
  return mode;
}

TipTable without_sensors(dynamics::ModalTable table, const TabledRobot& robot, const std::string& file) {
  TipTable tip{std::move(table)};
  for (const Sensor& sensor : robot.sensors) {
    if (!std::isfinite(sensor.mass)) continue;  // a fault of the case that is told by itself
    try {
      robot::FreedTable freed = robot::without_point_mass(tip.table, sensor.point, sensor.mass);
      tip.table = std::move(freed.table);
      tip.condition *= freed.condition;
    } catch (const core::InputError& error) {
      throw TabledRobotError("sensors", core::InputError(file + ": " + error.what()));
    }
  }
  return tip;
}

}  // namespace

TipTable read_tip_table(const std::filesystem::path& file, const TabledRobot& robot) {
  dynamics::ModalTable table =
      io::read_modal_table(file, {io::modal_unit(robot.left_unit), io::modal_unit(robot.right_unit), {}});
  std::vector<std::string> points;
  for (const dynamics::Dof& dof : table.dofs) {
    if (std::ranges::count(points, dof.point) == 0) points.push_back(dof.point);
  }
  if (std::ranges::count(points, robot.table_point) == 0)
    throw TabledRobotError("table_point",
                           core::InputError("\"" + robot.table_point + "\" is no point of " + file.string() +
                                            "; it has \"" + fmt::format("{}", fmt::join(points, "\", \"")) + "\""));
  for (dynamics::ModalTableRow& row : table.rows)
    row.place_m(dynamics::rows_of_point(table.dofs, robot.table_point)).setZero();
  return without_sensors(std::move(table), robot, file.string());
}

dynamics::ModalTable used_part(const TabledRobot& robot, const dynamics::ModalTable& table) {
  std::vector<int> dofs = dynamics::rows_of_point(table.dofs, robot.table_point);
  if (robot.up) {
    for (const int row : dynamics::rows_of_point(table.dofs, robot.up->name)) dofs.push_back(row);
    std::erase_if(dofs, [&](int row) {
      const dynamics::Dof& dof = table.dofs[static_cast<std::size_t>(row)];
      return dof.kind != dynamics::DofKind::translation ||
             std::abs(dof.direction.dot(robot.up->from_tip)) > 1e-6 * robot.up->from_tip.norm();
    });
  }
  return robot::at_dofs(table, dofs);
}

std::string doubt_about_sensors(double condition, const std::string& where) {
  constexpr double most = 10.0;
  if (condition <= most) return "";
  return "the mass of the sensors is most of what moves: without it, errors of the modes grow " +
         core::number_text(condition, 2) + " times " + where + "; tap with lighter sensors";
}

std::vector<identification::FittedMode> modes_of(const dynamics::ModalTable& table, const std::string& file) {
  std::vector<identification::FittedMode> modes;
  for (const dynamics::ModalTableRow& row : table.rows) {
    if (row.left.isZero(0.0) || row.right.isZero(0.0))
      throw core::DataError(file + ": the mode at " + core::number_text(row.frequency_hz, 5) +
                            " Hz has a vector of zeros, which moves nothing; remove its line");
    modes.push_back(mode_of(row));
  }
  return modes;
}

dynamics::ModalTable table_of(std::vector<identification::FittedMode> modes, const dynamics::DofTable& dofs) {
  identification::ModalFit fit;
  fit.modes = std::move(modes);
  for (identification::FittedMode& mode : fit.modes) mode.right = mode.left = {};  // all of the residue, if of more
  dynamics::ModalTable table = identification::modal_table(fit, dofs, dofs);
  for (dynamics::ModalTableRow& row : table.rows) row.place_m = Eigen::VectorXd::Zero(std::ssize(table.dofs));
  return table;
}

}  // namespace thinwall::setup
