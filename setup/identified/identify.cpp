#include "setup/identified/identify.hpp"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "setup/identified/arm_mean.hpp"
#include "setup/identified/fitted_tip.hpp"
#include "setup/identified/learned_modes.hpp"
#include "setup/identified/table_modes.hpp"
#include "setup/robot_tip.hpp"

namespace thinwall::setup {

namespace {

std::size_t draws_of_robot(const SupportSetup& source) {
  const auto* robot = tabled_robot(source.robot);
  return robot != nullptr && robot->learned ? robot->learned->drawn.size() : 0;
}

std::size_t draws_of_tool(const CutSetup& source) {
  return source.tool && source.tool->fitted ? source.tool->fitted->drawn.size() : 0;
}

}  // namespace

Eigen::VectorXd asked_joints(const Setup& source, const TabledRobot& robot) {
  if (!robot.mean) return {};
  Eigen::VectorXd q = joints_from_columns(robot);
  return q.size() > 0 ? q : wished_joints(source, source, *robot.mean);
}

bool awaits_fit(const CutSetup& source) {
  return source.tool && source.tool->fit && !source.tool->fitted;
}

bool awaits_learning(const SupportSetup& source) {
  const auto* robot = tabled_robot(source.robot);
  return robot != nullptr && robot->postures && !robot->table_modes;
}

dynamics::ModalTable modes_for_swap(const TabledRobot& robot, const dynamics::ModalTable& modes, const ToolSwap& swap) {
  dynamics::ModalTable table = used_part(robot, modes);
  Eigen::VectorXd place = Eigen::VectorXd::Zero(std::ssize(table.dofs));
  for (std::size_t i = 0; i < table.dofs.size(); ++i) {
    dynamics::Dof& dof = table.dofs[i];
    const bool at_tip = dof.point == robot.table_point;
    if (!at_tip) place(static_cast<Eigen::Index>(i)) = swap.distance;
    dof = {at_tip ? swap.tip : swap.up, robot.base.linear() * dof.direction, dof.kind};
  }
  for (dynamics::ModalTableRow& row : table.rows) row.place_m = place;
  return table;
}

void give_modes_to_swap(CutSetup& cut, const SupportSetup& support) {
  const TabledRobot* robot = tabled_robot(support.robot);
  if (!cut.tool || !swapped_on_robot(*cut.tool) || robot == nullptr || !robot->table_modes || !robot->up) return;
  cut.tool->swap->table =
      std::make_shared<const dynamics::ModalTable>(modes_for_swap(*robot, *robot->table_modes, *cut.tool->swap));
}

void identify(Setup& source) {
  if (awaits_fit(source)) {
    try {
      source.tool->fitted = std::make_shared<const FittedTip>(fitted_tip(*source.tool));
    } catch (const core::InputError& error) {
      throw core::InputError(std::string("tool.fit: ") + error.what());
    }
  }
  if (awaits_learning(source)) {
    TabledRobot& robot = *tabled_robot(source.robot);
    LearnedModes modes = learned_modes(robot, asked_joints(source, robot));
    robot.table_modes = std::make_shared<const dynamics::ModalTable>(std::move(modes.table));
    robot.learned = std::make_shared<const LearnedPostures>(std::move(modes.learned));
  }
  give_modes_to_swap(source, source);
}

void tell_of_identified(const Setup& source) {
  if (const auto* robot = tabled_robot(source.robot); robot != nullptr && robot->learned)
    core::inform(robot->learned->summary);
  if (!source.tool || !source.tool->fitted) return;
  for (const std::string& note : source.tool->fitted->notes) core::inform(note);
  for (const std::string& warning : source.tool->fitted->warnings) core::warn(warning);
}

std::size_t draws_of(const Setup& source) {
  return std::max(draws_of_tool(source), draws_of_robot(source));
}

void take_draw(std::size_t i, CutSetup& cut, SupportSetup& support) {
  if (i < draws_of_tool(cut)) {
    auto tip = std::make_shared<FittedTip>();
    tip->model = cut.tool->fitted->drawn[i];
    cut.tool->fitted = std::move(tip);
  }
  if (i >= draws_of_robot(support)) return;
  TabledRobot& robot = *tabled_robot(support.robot);
  robot.table_modes = std::make_shared<const dynamics::ModalTable>(robot.learned->drawn[i]);
  give_modes_to_swap(cut, support);
}

}  // namespace thinwall::setup
