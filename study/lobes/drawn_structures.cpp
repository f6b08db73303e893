#include "study/lobes/drawn_structures.hpp"

#include <numbers>
#include <optional>
#include <utility>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "coupling/receptance.hpp"
#include "setup/identified/identify.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/tool_swap.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

bool robot_is_learned(const setup::SupportSetup& source) {
  const setup::TabledRobot* robot = setup::tabled_robot(source.robot);
  return robot != nullptr && robot->learned;
}

/// Tool and robot by a draw.
struct Drawn {
  setup::CutSetup cut;
  setup::SupportSetup support;
};

Drawn drawn(const setup::Setup& source, std::size_t i) {
  Drawn result{source, source};
  setup::take_draw(i, result.cut, result.support);
  return result;
}

/// The receptance of the tool's tip, which is known by its modes, in part axes; zero of a rigid one.
Eigen::Matrix3cd tool_receptance(const setup::CutSetup& cut, double hz) {
  const auto poles = cut_poles(cut, nullptr);
  return poles ? milling::receptance(*poles, 2.0 * std::numbers::pi * hz) : Eigen::Matrix3cd::Zero();
}

}  // namespace

std::vector<milling::RelativeStructure> drawn_poles(const setup::Setup& source, ChartOf of,
                                                    const dynamics::ModalModel* part, const Results& results) {
  const bool of_robot = of == ChartOf::carried && robot_is_learned(source);
  if (!of_robot && !source.tool->fitted) return {};
  std::vector<milling::RelativeStructure> structures;
  for (std::size_t i = 0; i < setup::draws_of(source); ++i) {
    const Drawn there = drawn(source, i);
    std::optional<Component> carrier;
    if (of == ChartOf::carried)
      carrier = robot_component(*there.support.robot, {Eigen::VectorXd::Ones(1)}, results.robot_posture->posture);
    structures.push_back(*cut_poles(there.cut, part, carrier ? &carrier_modes(*carrier) : nullptr));
  }
  return structures;
}

std::vector<std::vector<Eigen::Matrix3cd>> drawn_swaps(const setup::Setup& source, const milling::ToolFrame& frame) {
  if (!robot_is_learned(source)) return {};
  std::vector<dynamics::ModalTable> tables{*source.tool->swap->table};
  for (std::size_t i = 0; i < setup::draws_of(source); ++i) tables.push_back(*drawn(source, i).cut.tool->swap->table);
  const std::vector<SwappedTip> tips = swapped_tips(source, tables);
  const Eigen::Matrix3d R = frame.rotation();
  std::vector<std::vector<Eigen::Matrix3cd>> changes;
  for (std::size_t i = 1; i < tips.size(); ++i) {
    std::vector<Eigen::Matrix3cd>& of_draw = changes.emplace_back();
    for (std::size_t line = 0; line < tips[i].tip.H.size(); ++line)
      of_draw.emplace_back(R.transpose() * (tips[i].tip.H[line] - tips[0].tip.H[line]) * R);
  }
  return changes;
}

std::vector<std::vector<Eigen::Matrix3cd>> drawn_changes(const setup::Setup& source, const milling::ToolFrame& frame,
                                                         const Results& results) {
  std::vector<std::vector<Eigen::Matrix3cd>> changes(setup::draws_of(source));
  if (changes.empty()) return changes;
  const dynamics::ResponseModel& expected = results.coupled->receptance.response;
  const std::string& at = source.cutting->at;
  const dynamics::DofTable dofs = dynamics::between(expected, at, at).responses;
  const Eigen::Matrix3d R = frame.rotation();
  const Eigen::Matrix3Xd E = R.transpose() * dynamics::displacement_matrix(dofs, at);
  const auto contacts = contacts_of(results.contacts);
  const auto samples_of = [&](const dynamics::ResponseModel& coupled, const setup::CutSetup& cut) {
    const dynamics::ResponseModel there = dynamics::between(coupled, at, at);
    std::vector<Eigen::Matrix3cd> lines;
    for (std::size_t line = 0; line < there.H.size(); ++line)
      lines.emplace_back(E * there.H[line] * E.transpose() +
                         R.transpose() * tool_receptance(cut, there.axis.hz(static_cast<Eigen::Index>(line))) * R);
    return lines;
  };
  const std::vector<Eigen::Matrix3cd> mean = samples_of(expected, source);
  core::Progress progress("draws of the support", changes.size());
  core::parallel_for(changes.size(), [&](std::size_t i) {
    const Drawn there = drawn(source, i);
    const Component robot = robot_component(*there.support.robot, expected.axis, results.robot_posture->posture);
    const dynamics::ResponseModel coupled =
        coupling::couple(results.part->response, robot.response, contacts, coupling_options(source.coupling)).response;
    changes[i] = samples_of(coupled, there.cut);
    for (std::size_t line = 0; line < mean.size(); ++line) changes[i][line] -= mean[line];
    progress.step();
  });
  return changes;
}

}  // namespace thinwall::study
