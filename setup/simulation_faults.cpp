#include "setup/simulation_faults.hpp"

#include <cmath>
#include <variant>

#include "setup/contact_model.hpp"

namespace thinwall::setup {

std::vector<CutOn> simulated_structures(const Setup& source) {
  if (!source.simulation->structures.empty()) return source.simulation->structures;
  if (source.simulation->robot == CarrierMotion::multibody) return {CutOn::carried};
  std::vector<CutOn> all;
  const bool part = source.part || !source.measured_part.empty();
  if (part) all.push_back(CutOn::part);
  if (part && source.robot && !source.contacts.empty()) all.push_back(CutOn::supported);
  if (carries_tool(source.robot)) all.push_back(CutOn::carried);
  if (all.empty()) all.push_back(CutOn::tool);
  return all;
}

std::string fault_of_structure(const Setup& source, CutOn structure) {
  const std::string unfitted =
      "the robot is known by measured FRFs alone, and a simulation needs poles; fit modes to "
      "them and give robot.modes";
  switch (structure) {
    case CutOn::part:
      if (source.part && may_be_held(*source.part)) return "";
      return "a simulation needs a part that is held and modelled; describe it with [[part.supports]]";
    case CutOn::supported:
      if (!source.robot || source.contacts.empty()) return "no robot holds the part; add [robot] and [[contacts]]";
      return is_measured(*source.robot) ? unfitted + ", or take simulation.structures = \"part\"" : "";
    case CutOn::tool:
      return source.part ? "the tool cuts a part, not a rigid block; take \"part\" or \"supported\"" : "";
    case CutOn::carried:
      if (!carries_tool(source.robot)) return "no robot carries the tool; give robot.carries = \"tool\"";
      return std::holds_alternative<MeasuredRobot>(source.robot->model) ? unfitted : "";  // a table of modes has poles
  }
  return "";
}

std::string fault_of_opening(const Setup& source) {
  if (source.simulation->support != SupportSides::one_sided) return "";
  if (source.contacts.size() != 1 || !source.robot)
    return std::to_string(source.contacts.size()) +
           " contacts of a robot, must be one that opens; give one, or \"two_sided\"";
  const SupportContact& contact = source.contacts.front();
  const auto* springs = std::get_if<SpringContact>(&contact.model);
  if (springs != nullptr && !springs->stiffness.empty() && !std::isfinite(springs->stiffness.front()))
    return "a rigid contact does not open; give contacts.stiffness, or contacts.model = \"hertz\"";
  if (!measured_assembly(contact).empty())
    return "a contact that is found from FRFs has no side that opens; give contacts.stiffness, or \"two_sided\"";
  if (!preload_of(source, contact)) return "nothing presses the contact that may open; give robot.preload";
  if (contact.directions.size() > 1)
    return std::to_string(contact.directions.size()) +
           " directions of the contact, must be one, its normal, for the others do not open; give one";
  if (source.robot->preload.dot(contact.directions.front()) == 0.0)
    return "the side on which the robot stands is told by the sign of robot.preload along the contact's direction; "
           "give it";
  return "";
}

std::string fault_of_arm(const Setup& source) {
  const Simulation& wanted = *source.simulation;
  if (wanted.robot != CarrierMotion::multibody) return "";
  if (!carries_tool(source.robot) || !std::holds_alternative<JointedRobot>(source.robot->model))
    return "a multibody arm must be one of flexible joints that carries the tool; give robot.model = "
           "\"flexible_joints\" and robot.carries = \"tool\", or take \"linear\"";
  if (source.part || !source.measured_part.empty())
    return "a multibody arm is known to cut rigid parts only; leave the part out, or take \"linear\"";
  if (source.tool && (!source.tool->modes.empty() || !source.tool->measured.empty() || source.tool->swap))
    return "a multibody arm is known to carry rigid tools only; leave tool.modes out, or take \"linear\"";
  if (wanted.paths != ToothPaths::exact || wanted.start != CutStart::border)
    return "a multibody arm feeds through a border; give simulation.paths = \"exact\" and simulation.start = "
           "\"border\", or take \"linear\"";
  for (const CutOn of : wanted.structures) {
    if (of != CutOn::carried) return "a multibody arm has no structure but \"carried\"; name that, or none";
  }
  if (wanted.map) return "a map is that of the linear robot; leave it out, or take \"linear\"";
  return "";
}

}  // namespace thinwall::setup
