#include "case/checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "case/contact_checks.hpp"
#include "case/cutting_checks.hpp"
#include "case/findings.hpp"
#include "case/lobes_checks.hpp"
#include "case/measured_checks.hpp"
#include "case/numbers.hpp"
#include "case/part_checks.hpp"
#include "case/path_checks.hpp"
#include "case/robot_checks.hpp"
#include "case/schema.hpp"
#include "case/tool_checks.hpp"
#include "core/units.hpp"
#include "io/frf/frf_quantity.hpp"
#include "setup/measured.hpp"
#include "setup/measured_layout.hpp"
#include "setup/measured_noise.hpp"

namespace thinwall::cases {

namespace {

std::string indexed(const std::string& table, std::size_t index) {
  return table + "[" + std::to_string(index) + "]";
}

void check_something_to_do(const Case& source, Findings& findings) {
  const bool moves =
      source.tool && (!source.tool->modes.empty() || !source.tool->measured.empty() || source.tool->swap.has_value());
  const bool tool_alone = moves && source.lobes;
  if (source.part || !source.measured_part.empty() || tool_alone || source.robot || has_table(source.values, "part"))
    return;
  findings.report("part",
                  "missing; a case holds a part ([part] or [[part.measured]]), a [robot], or a tool with modes or "
                  "measured FRFs and [lobes]");
}

void check_ranges(const Case& source, Findings& findings) {
  for (const auto& [a, b] :
       {std::pair{"modes.count", "modes.up_to"}, std::pair{"reduction.modes", "reduction.up_to"},
        std::pair{"reduction.modes", "reduction.tolerance"}, std::pair{"reduction.up_to", "reduction.tolerance"}}) {
    if (findings.given(a) && findings.given(b))
      findings.report(b, "give either " + std::string(a) + " or " + b + ", not both");
  }
  for (const auto& name : source.reduction.interface) {
    findings.require_known("reduction.interface", name, part_points(source), "point");
  }
}

/// A point at which the reduced model is asked for something: known, and kept by the reduction.
void require_kept(const Case& source, const std::string& key, const std::string& name, Findings& findings) {
  const auto points = part_points(source);
  findings.require_known(key, name, points, "point");
  const auto& kept = source.reduction.interface;
  if (!source.part || std::ranges::find(points, name) == points.end() || std::ranges::count(kept, name) > 0) return;
  findings.report(key, "point \"" + name + "\" is not kept by the reduction; add it to reduction.interface");
}

void check_damping(const Case& source, Findings& findings) {
  const setup::Damping& damping = source.damping;
  const auto belongs_to = [&](const char* key, const char* model, bool used) {
    if (!used || damping.model == core::from_word<setup::DampingModel>(model) || findings.unreadable("damping.model"))
      return;
    findings.report(key, "belongs to damping.model = \"" + std::string(model) + "\", but the model is \"" +
                             core::word_of(damping.model) + "\"");
  };
  belongs_to("damping.ratios", "modal", !damping.ratios.empty());
  belongs_to("damping.from_frf.file", "modal", damping.from_frf.has_value());
  belongs_to("damping.alpha", "rayleigh", damping.alpha != 0.0);
  belongs_to("damping.beta", "rayleigh", damping.beta != 0.0);
  belongs_to("damping.loss_factor", "structural", damping.loss_factor != 0.0);
  if (!damping.ratios.empty() && damping.from_frf)
    findings.report("damping.ratios", "give either damping.ratios or damping.from_frf, not both");
  if (damping.model == setup::DampingModel::rayleigh && damping.alpha == 0.0 && damping.beta == 0.0) {
    findings.report("damping.model", "rayleigh needs alpha or beta");
  }
}

void require_direction(const std::string& key, const std::string& dof, Findings& findings) {
  if (dof.empty() || direction_of(dof)) return;
  findings.report(key, "\"" + dof + "\" names no direction; write for example \"" + setup::point_of(dof) + ".x\"");
}

/// True for every unit that the readers take, "g/N" among them.
bool is_frf_unit(const std::string& quantity, const std::string& unit) {
  try {
    (void)io::frf_format(quantity, unit, "Hz");
    return true;
  } catch (const core::InputError&) {
    return false;
  }
}

/// Dimension of an FRF per newton: m/N has s²/kg, a mobility s/kg, an accelerance 1/kg.
void check_measured(const std::string& key, const setup::MeasuredFrf& frf, Findings& findings) {
  const bool tells_itself = setup::frf_file_kind(frf.file) != setup::FrfFileKind::csv;
  if (frf.quantity.empty() && !findings.given(key + ".quantity") && !tells_itself)
    findings.report(key + ".quantity", "missing; say what was measured: receptance, mobility or accelerance");
  if (frf.unit.empty() && !findings.given(key + ".unit") && !tells_itself)
    findings.report(key + ".unit", "missing; say its unit, for example \"m/s^2/N\"");
  if (tells_itself && frf.quantity.empty() != frf.unit.empty())
    findings.report(key + (frf.unit.empty() ? ".unit" : ".quantity"),
                    "missing; give quantity and unit together, or neither where the file says them");
  if (tells_itself && frf.quantity.empty() && frf.unit.empty() && frf.frequency_unit != "Hz" &&
      !frf.frequency_unit.empty())
    findings.report(key + ".frequency_unit", "counts beside quantity and unit only; give these too, or remove it");
  const int time = frf.quantity == "receptance" ? 2 : frf.quantity == "mobility" ? 1 : 0;
  if (!frf.unit.empty() && !frf.quantity.empty() && !is_frf_unit(frf.quantity, frf.unit)) {
    try {
      if (core::parse_unit(frf.unit).dimension != core::Dimension{0, -1, time, 0, 0}) {
        findings.report(key + ".unit", "\"" + frf.unit + "\" is no unit of a " + frf.quantity +
                                           "; write for example \"" +
                                           (time == 2   ? "m/N"
                                            : time == 1 ? "m/s/N"
                                                        : "m/s^2/N") +
                                           "\"");
      }
    } catch (const core::InputError& error) {
      findings.report(key + ".unit", error.what());
    }
  }
  if (frf.noise && frf.averages) findings.report(key + ".averages", "the noise is given; keep one of the two");
  require_direction(key + ".response", frf.response, findings);
  require_direction(key + ".force", frf.force, findings);
  std::error_code ignored;
  if (!frf.file.empty() && !std::filesystem::is_regular_file(frf.file, ignored)) {
    findings.report(key + ".file", "there is no file \"" + frf.file.string() + "\"");
  } else if (frf.averages) {
    if (const std::string fault = setup::fault_of_coherence(frf); !fault.empty())
      findings.report(key + ".averages", fault);
  }
}

void require_driving_point(const std::string& key, const setup::MeasuredFrf& frf, Findings& findings) {
  if (frf.response.empty() || frf.force.empty() || frf.response == frf.force) return;
  findings.report(key + ".force", "\"" + frf.force + "\" is not the DOF that moves; only a driving point, force = \"" +
                                      frf.response + "\", serves here");
}

void check_all_measured(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.measured_part.size(); ++i) {
    check_measured(indexed("part.measured", i), source.measured_part[i], findings);
  }
  check_measured_part(source, findings);
  if (const auto& frf = source.damping.from_frf) {
    check_measured("damping.from_frf", *frf, findings);
    findings.require_known("damping.from_frf.response", setup::point_of(frf->response), part_points(source), "point");
    require_driving_point("damping.from_frf", *frf, findings);
  }
  for (std::size_t i = 0; i < source.contacts.size(); ++i) {
    const auto& measured = source.contacts[i].measured;
    for (std::size_t j = 0; j < measured.size(); ++j)
      check_measured(indexed(indexed("contacts", i) + ".measured", j), measured[j], findings);
  }
  if (source.tool) {
    for (std::size_t i = 0; i < source.tool->measured.size(); ++i)
      check_measured(indexed("tool.measured", i), source.tool->measured[i], findings);
    if (source.tool->swap) {
      for (std::size_t i = 0; i < source.tool->swap->measured.size(); ++i)
        check_measured(indexed("tool.swap.measured", i), source.tool->swap->measured[i], findings);
    }
  }
  if (!source.robot) return;
  for (std::size_t i = 0; i < source.robot->measured.size(); ++i) {
    const std::string key = indexed("robot.measured", i);
    check_measured(key, source.robot->measured[i], findings);
    findings.require_known(key + ".response", setup::point_of(source.robot->measured[i].response),
                           {source.robot->point}, "point of the robot");
  }
}

/// A contact joins what both sides can do: the part's point in its directions, the robot along its own.
void check_contact_directions(const Case& source, const std::string& key, const setup::Contact& contact,
                              Findings& findings) {
  const auto here = directions_at(source, contact.part_point);
  for (const auto& direction : contact.directions) {
    if (here.empty() || spanned(here, direction)) continue;
    findings.report(key + ".directions", "point \"" + contact.part_point +
                                             "\" is not known in all of these directions; add them to the point, or "
                                             "join fewer");
    break;
  }
  const auto tip = source.robot ? tip_directions(*source.robot) : std::vector<Eigen::Vector3d>();
  for (const auto& direction : contact.directions) {
    if (tip.empty() || spanned(tip, direction)) continue;
    findings.report(key + ".directions",
                    tip.size() == 1
                        ? "the robot resists along robot.direction only; join that direction alone, or turn the robot's"
                        : "the robot's tip is not known in all of these directions; join those that it is known in");
    break;
  }
}

void check_contact(const Case& source, const std::string& key, const setup::Contact& contact, Findings& findings) {
  require_kept(source, key + ".part", contact.part_point, findings);
  check_contact_directions(source, key, contact, findings);
  if (!source.robot) {
    findings.report(key, "there is no robot to touch the part; add [robot]");
  } else {
    findings.require_known(key + ".robot", contact.robot_point, {source.robot->point}, "point of the robot");
  }
  const CaseValue* directions = find(source.values, key + ".directions");
  if (directions != nullptr && !independent(contact.directions)) {
    findings.report(key + ".directions", "the directions must be independent, three at most");
  }
  for (const auto& [name, list] :
       {std::pair{".stiffness", &contact.stiffness}, std::pair{".damping", &contact.damping}}) {
    if (list->empty() || contact.directions.empty() || list->size() == contact.directions.size()) continue;
    findings.report(key + name, std::to_string(list->size()) + " values for " +
                                    std::to_string(contact.directions.size()) +
                                    " directions; give one, or one for each");
  }
  for (const auto& direction : contact.directions) {
    const std::string support = clamped_by(source, contact.part_point, direction);
    if (support.empty()) continue;
    findings.report(key + ".part", "point \"" + contact.part_point + "\" is clamped by \"" + support +
                                       "\", a robot there changes nothing; move the point off the support");
    break;
  }
}

void check_contacts(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.contacts.size(); ++i) {
    check_contact(source, indexed("contacts", i), source.contacts[i], findings);
  }
  if (!source.robot) return;
  const auto points = part_points(source);
  if (std::ranges::find(points, source.robot->point) != points.end()) {
    findings.report("robot.point",
                    "\"" + source.robot->point + "\" is already a point of the part; name the robot's tip otherwise");
  }
}

void check_response(const Case& source, Findings& findings) {
  const setup::ResponseOptions& response = source.response;
  if (response.from_hz >= response.to_hz)
    findings.report("response.from", "the first line must lie below the last (response.to)");
  if (response.logarithmic && response.from_hz == 0.0)
    findings.report("response.from", "a logarithmic axis cannot start at 0 Hz");
  if (!findings.given("response.points")) return;
  for (const auto& name : response.points) require_kept(source, "response.points", name, findings);
}

/// Part fits keep the mesh and stretch it; coupled fits keep the reduced part: other keys would change nothing.
void require_effect(setup::FitOf on, const std::string& key, const setup::UpdatingParameter& parameter,
                    Findings& findings) {
  const auto starts = [&](const char* prefix) { return parameter.key.starts_with(prefix); };
  const bool on_part = parameter.key == "part.length" || parameter.key == "part.height" ||
                       parameter.key == "part.thickness" || starts("part.material.");
  const bool on_coupled = starts("robot.") || starts("damping.") || starts("contacts[");
  if (on == setup::FitOf::part && !on_part) {
    findings.report(key + ".key", parameter.key +
                                      " does not move the modes of the part; with on = \"part\" fit part.length, "
                                      "part.height, part.thickness or part.material.*");
  }
  if (on == setup::FitOf::coupled && !on_coupled) {
    findings.report(key + ".key", parameter.key +
                                      " does not change the reduced part; with on = \"coupled\" fit robot.*, "
                                      "damping.* or contacts[].*");
  }
}

/// Reports a stiffness that the contact does not read because it follows from the preload.
bool unread_stiffness(const Case& source, const std::string& key, const setup::UpdatingParameter& parameter,
                      Findings& findings) {
  for (std::size_t i = 0; i < source.contacts.size(); ++i) {
    const setup::ContactModel model = source.contacts[i].model;
    if (model == setup::ContactModel::springs || !parameter.key.starts_with(indexed("contacts", i) + ".stiffness"))
      continue;
    findings.report(key + ".key", parameter.key + " is not read with model = \"" + core::word_of(model) +
                                      "\"; fit the contact's preload or ball, or take \"springs\"");
    return true;
  }
  return false;
}

void check_parameter(const Case& source, setup::FitOf on, const std::string& key,
                     const setup::UpdatingParameter& parameter, Findings& findings) {
  double start = 0.0;
  try {
    start = get_value(source, parameter.key);
  } catch (const core::InputError& error) {
    if (!parameter.key.empty()) findings.report(key + ".key", error.what());
    return;
  }
  require_effect(on, key, parameter, findings);
  if (unread_stiffness(source, key, parameter, findings)) return;
  const Key* described = find_key(case_schema(), pattern_of(case_schema(), parameter.key));
  for (const auto* bound : {".lower", ".upper"}) {
    const CaseValue* written = find(source.values, key + bound);
    if (written == nullptr || described == nullptr || std::get<std::string>(written->value).empty()) continue;
    try {
      require_within_bounds(*described, core::parse_quantity(std::get<std::string>(written->value), described->kind));
    } catch (const core::InputError& error) {
      findings.report(key + bound, error.what());
    }
  }
  if (parameter.lower >= parameter.upper) findings.report(key + ".lower", "lower must lie below upper");
  if (start < parameter.lower || start > parameter.upper) {
    const auto& kind = described == nullptr ? core::kind::number : described->kind;
    findings.report(key + ".key", "the case starts " + parameter.key + " at " + core::readable_text(start, kind) +
                                      ", outside lower and upper");
  }
}

void check_coupled_target(const Case& source, const std::string& key, const setup::UpdatingTarget& target,
                          Findings& findings) {
  if (target.quantity == setup::FittedQuantity::part_frequency) {
    findings.report(key + ".quantity",
                    "\"part_frequency\" is a result of the part alone; set on = \"part\", or fit coupled_frequency");
  }
  if (target.match == setup::ModeMatch::mac)
    findings.report(key + ".match", "\"mac\" compares shapes of the part alone; take participation or number");
  const auto directions = directions_at(source, setup::point_of(target.point));
  const auto direction = direction_of(target.point);
  if (direction && !directions.empty() && std::ranges::count(directions, *direction) == 0)
    findings.report(key + ".point", "\"" + target.point + "\" is none of the point's directions; add it to the point");
}

void check_target(const Case& source, setup::FitOf on, const std::string& key, const setup::UpdatingTarget& target,
                  Findings& findings) {
  const bool reduction = target.quantity == setup::FittedQuantity::reduction_at;
  if (on == setup::FitOf::coupled) {
    require_kept(source, key + ".point", setup::point_of(target.point), findings);
  } else {
    findings.require_known(key + ".point", setup::point_of(target.point), part_points(source), "point");
  }
  require_direction(key + ".point", target.point, findings);
  if (reduction && (target.value <= 0.0 || target.value >= 1.0))
    findings.report(key + ".value", "a reduction lies between 0 and 1");
  if (!reduction && target.value <= 0.0) findings.report(key + ".value", "a frequency lies above 0 Hz");
  const CaseValue* written = find(source.values, key + ".value");
  if (written != nullptr && !std::get<std::string>(written->value).empty()) {
    try {
      (void)core::parse_quantity(std::get<std::string>(written->value),
                                 reduction ? core::kind::number : core::kind::frequency);
    } catch (const core::InputError& error) {
      findings.report(key + ".value", error.what());
    }
  }
  if (on == setup::FitOf::part && (target.quantity == setup::FittedQuantity::coupled_frequency || reduction)) {
    findings.report(key + ".quantity", "\"" + core::word_of(target.quantity) +
                                           "\" is a result of the coupled model; set on = \"coupled\"");
  }
  if (on == setup::FitOf::coupled) check_coupled_target(source, key, target, findings);
}

void check_coupled_fit(const Case& source, const std::string& key, Findings& findings) {
  if (!source.robot || source.contacts.empty() || source.points.empty())
    findings.report(key + ".on", "\"coupled\" needs [robot], [[contacts]] and [points]");
  if (source.robot &&
      (source.robot->model == setup::RobotModel::measured || source.robot->model == setup::RobotModel::modal_table))
    findings.report(key + ".on", "\"coupled\" needs a robot that is modelled, not a measured one; set robot.model");
  if (!setup::may_be_held(*source.part))
    findings.report(key + ".on", "\"coupled\" needs a part that is held; add [[part.supports]]");
}

void check_updating(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.updating.size(); ++i) {
    const std::string key = indexed("updating", i);
    const setup::Updating& updating = source.updating[i];
    if (!source.part || (updating.on == setup::FitOf::part && source.part->shape == setup::PartShape::matrices)) {
      findings.report(key, "there is no modelled part to fit; add part.length, part.height, part.thickness");
      continue;
    }
    if (updating.parameters.empty()) findings.report(key + ".parameters", "missing; name at least one number to fit");
    if (updating.targets.empty()) findings.report(key + ".targets", "missing; name at least one result to fit to");
    for (std::size_t j = 0; j < updating.parameters.size(); ++j) {
      check_parameter(source, updating.on, indexed(key + ".parameters", j), updating.parameters[j], findings);
    }
    for (std::size_t j = 0; j < updating.targets.size(); ++j) {
      check_target(source, updating.on, indexed(key + ".targets", j), updating.targets[j], findings);
    }
    if (updating.on == setup::FitOf::coupled) check_coupled_fit(source, key, findings);
  }
}

void check_cutting(const Case& source, Findings& findings) {
  const setup::Cutting& cutting = *source.cutting;
  if (!source.tool) findings.report("cutting", "there is no cutter; add [tool]");
  check_engagement(source, findings);
  check_force_law(source, findings);
  if (source.part || !part_points(source).empty()) {
    if (!findings.given("cutting.at")) findings.report("cutting.at", "missing; name the point of the part that is cut");
    require_kept(source, "cutting.at", cutting.at, findings);
  }
  const auto here = directions_at(source, cutting.at);
  if (source.part && !here.empty() && here.size() < 3) {
    findings.report("cutting.at", "the cut loads point \"" + cutting.at + "\" in x, y and z; leave out points." +
                                      cutting.at + ".directions, or give all three");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const std::string support = clamped_by(source, cutting.at, Eigen::Vector3d::Unit(axis));
    if (support.empty()) continue;
    findings.report("cutting.at",
                    "point \"" + cutting.at + "\" is clamped by \"" + support + "\"; move it off the support");
    break;
  }
}

void check_lobes(const Case& source, Findings& findings) {
  const setup::LobesOptions& lobes = *source.lobes;
  if (source.tool && (!source.tool->measured.empty() || source.tool->swap)) check_measured_tool(*source.tool, findings);
  if (!source.cutting) findings.report("lobes", "there is no cut; add [cutting]");
  check_chart_choices(source, findings);
  if (source.part ? !setup::may_be_held(*source.part) : !source.measured_part.empty()) {
    findings.report("lobes", "lobes need a part that is held and modelled; " +
                                 std::string(source.part ? "add [[part.supports]]" : "describe it (part.length …)") +
                                 ", or remove [lobes]");
  }
  if (lobes.from_rpm >= lobes.to_rpm)
    findings.report("lobes.from", "the lowest speed must lie below the highest (lobes.to)");
  if (source.tool && lobes.depth_limit > source.tool->length) {
    findings.report("lobes.depth_limit", core::readable_text(lobes.depth_limit, core::kind::length) +
                                             " is more than the tool's length of " +
                                             core::readable_text(source.tool->length, core::kind::length));
  }
}

}  // namespace

std::vector<Problem> check_case(const Case& source) {
  Findings findings{source.values, {}};
  check_something_to_do(source, findings);
  check_part(source, findings);
  check_ranges(source, findings);
  check_damping(source, findings);
  check_all_measured(source, findings);
  if (source.robot) check_robot(source, findings);
  check_contacts(source, findings);
  check_contact_models(source, findings);
  check_coupling(source, findings);
  check_response(source, findings);
  check_updating(source, findings);
  if (source.tool) check_tool(*source.tool, findings);
  if (source.cutting) check_cutting(source, findings);
  if (source.lobes) check_lobes(source, findings);
  if (source.machine) check_machine(source, findings);
  if (source.path) check_path(source, findings);
  return std::move(findings.problems);
}

}  // namespace thinwall::cases
