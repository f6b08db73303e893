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

void identify(Setup& source) {
  if (awaits_fit(source)) {
    try {
      source.tool->fitted = std::make_shared<const FittedTip>(fitted_tip(*source.tool));
    } catch (const core::InputError& error) {
      throw core::InputError(std::string("tool.fit: ") + error.what());
    }
  }
  if (!awaits_learning(source)) return;
  TabledRobot& robot = *tabled_robot(source.robot);
  LearnedModes modes = learned_modes(robot, asked_joints(source, robot));
  robot.table_modes = std::make_shared<const dynamics::ModalTable>(std::move(modes.table));
  robot.learned = std::make_shared<const LearnedPostures>(std::move(modes.learned));
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
}

}  // namespace thinwall::setup
