#include "case/checks/checks.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "case/alternatives.hpp"
#include "case/checks/contact_checks.hpp"
#include "case/checks/cutting_checks.hpp"
#include "case/checks/findings.hpp"
#include "case/checks/kept_points.hpp"
#include "case/checks/lobes_checks.hpp"
#include "case/checks/measured_checks.hpp"
#include "case/checks/observed_checks.hpp"
#include "case/checks/part_checks.hpp"
#include "case/checks/path_checks.hpp"
#include "case/checks/robot_checks.hpp"
#include "case/checks/simulation_checks.hpp"
#include "case/checks/tool_checks.hpp"
#include "case/checks/updating_checks.hpp"
#include "case/numbers.hpp"
#include "case/schema/schema.hpp"
#include "core/overloaded.hpp"
#include "core/units.hpp"
#include "io/frf/frf_quantity.hpp"
#include "setup/measured.hpp"
#include "setup/measured_layout.hpp"
#include "setup/measured_noise.hpp"

namespace thinwall::cases {

namespace {

void check_something_to_do(const Case& source, Findings& findings) {
  const bool moves =
      source.tool && (!source.tool->modes.empty() || !source.tool->measured.empty() || source.tool->swap.has_value());
  const bool tool_alone = moves && (source.lobes || source.simulation);
  if (source.part || !source.measured_part.empty() || tool_alone || source.robot || has_table(source.values, "part"))
    return;
  findings.report("part",
                  "missing; a case holds a part ([part] or [[part.measured]]), a [robot], or a tool with modes or "
                  "measured FRFs and [lobes] or [simulation]");
}

/// A folder holds no data, and a pipe is waited for without end. Where the name of a posture is put in there are
/// several.
void check_named_files(const Case& source, Findings& findings) {
  for (const CaseValue& value : source.values) {
    const auto* name = std::get_if<std::string>(&value.value);
    if (name == nullptr || name->empty() || !value.from_file) continue;
    const Key* key = find_key(case_schema(), pattern_of(case_schema(), value.key));
    if (key == nullptr || key->type != Type::file) continue;
    std::error_code ignored;
    const auto status = std::filesystem::status(source.folder / *name, ignored);
    if (std::filesystem::is_regular_file(status) || name->find('{') != std::string::npos ||
        findings.reported(value.key))
      continue;
    if (!std::filesystem::exists(status)) {
      findings.report(value.key, "there is no file \"" + (source.folder / *name).string() + "\"");
      continue;
    }
    findings.report(value.key, "\"" + *name + "\" is " +
                                   (std::filesystem::is_directory(status) ? "a folder; name a file in it"
                                                                          : "a pipe or a device; name a plain file"));
  }
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

void check_damping(const Case& source, Findings& findings) {
  const auto* modal = std::get_if<setup::ModalDamping>(&source.damping);
  if (modal != nullptr && !modal->ratios.empty() && modal->from_frf)
    findings.report("damping.ratios", "give either damping.ratios or damping.from_frf, not both");
  const auto* rayleigh = std::get_if<setup::RayleighDamping>(&source.damping);
  if (rayleigh != nullptr && rayleigh->alpha == 0.0 && rayleigh->beta == 0.0)
    findings.report("damping.model", "rayleigh needs alpha or beta");
}

/// The readers' message about a unit that does not fit the quantity; empty if they accept the unit.
std::string fault_of_unit(io::FrfQuantity quantity, const std::string& unit) {
  try {
    (void)io::frf_format(quantity, unit, "Hz");
    return "";
  } catch (const core::InputError& error) {
    return error.what();
  }
}

void check_measured(const std::string& key, const setup::MeasuredFrf& frf, Findings& findings) {
  const bool tells_itself = setup::tells_quantity(setup::frf_file_kind(frf.file)) && frf.variable.empty();
  if (frf.variable.empty() != frf.frequency_variable.empty())
    findings.report(key + (frf.variable.empty() ? ".variable" : ".frequency_variable"),
                    "missing; variable and frequency_variable together tell where a MAT file of another program has "
                    "its FRF");
  if (!frf.quantity && !findings.given(key + ".quantity") && !tells_itself)
    findings.report(key + ".quantity", "missing; say what was measured: receptance, mobility or accelerance");
  if (frf.unit.empty() && !findings.given(key + ".unit") && !tells_itself)
    findings.report(key + ".unit", "missing; say its unit, for example \"m/s^2/N\"");
  if (tells_itself && frf.quantity.has_value() == frf.unit.empty())
    findings.report(key + (frf.unit.empty() ? ".unit" : ".quantity"),
                    "missing; give quantity and unit together, or neither where the file says them");
  if (tells_itself && !frf.quantity && frf.unit.empty() && frf.frequency_unit != "Hz" && !frf.frequency_unit.empty())
    findings.report(key + ".frequency_unit", "counts beside quantity and unit only; give these too, or remove it");
  if (frf.quantity && !frf.unit.empty()) {
    if (const std::string fault = fault_of_unit(*frf.quantity, frf.unit); !fault.empty())
      findings.report(key + ".unit", fault);
  }
  if (frf.noise && frf.averages) findings.report(key + ".averages", "the noise is given; keep one of the two");
  if (frf.from_hz && frf.to_hz && *frf.from_hz >= *frf.to_hz)
    findings.report(key + ".from", "the first line must lie below the last (" + key + ".to)");
  require_direction(key + ".response", frf.response, findings);
  require_direction(key + ".force", frf.force, findings);
  if (frf.averages && frf.content) {
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
  if (const auto* modal = std::get_if<setup::ModalDamping>(&source.damping); modal != nullptr && modal->from_frf) {
    const auto& frf = modal->from_frf;
    check_measured("damping.from_frf", *frf, findings);
    findings.require_known("damping.from_frf.response", setup::point_of(frf->response), part_points(source), "point");
    require_driving_point("damping.from_frf", *frf, findings);
  }
  for (std::size_t i = 0; i < source.contacts.size(); ++i) {
    const auto measured = setup::measured_assembly(source.contacts[i]);
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
  const auto* robot = source.robot ? std::get_if<setup::MeasuredRobot>(&source.robot->model) : nullptr;
  if (robot == nullptr) return;
  for (std::size_t i = 0; i < robot->measured.size(); ++i) {
    const std::string key = indexed("robot.measured", i);
    check_measured(key, robot->measured[i], findings);
    findings.require_known(key + ".response", setup::point_of(robot->measured[i].response), {source.robot->point},
                           "point of the robot");
  }
}

/// A contact joins what both sides can do: the part's point in its directions, the robot along its own.
void check_contact_directions(const Case& source, const std::string& key, const setup::SupportContact& contact,
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

/// Lists of a contact have a value for each of its directions.
void check_one_a_direction(const std::string& key, const setup::SupportContact& contact, Findings& findings) {
  const auto check = [&](const char* name, const std::vector<double>& list) {
    if (list.empty() || contact.directions.empty() || list.size() == contact.directions.size()) return;
    findings.report(key + name, std::to_string(list.size()) + " values for " +
                                    std::to_string(contact.directions.size()) +
                                    " directions; give one, or one for each");
  };
  std::visit(core::overloaded{[&](const setup::SpringContact& springs) {
                                check(".stiffness", springs.stiffness);
                                check(".damping", springs.damping);
                              },
                              [](const setup::TabledContact&) {},
                              [&](const auto& pressed) { check(".damping", pressed.damping); }},
             contact.model);
}

void check_contact(const Case& source, const std::string& key, const setup::SupportContact& contact,
                   Findings& findings) {
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
  check_one_a_direction(key, contact, findings);
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
  for (const auto& [key, text] : faults_of_alternatives(case_schema(), source.values)) findings.report(key, text);
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
  if (source.tool && (source.lobes || source.simulation || setup::swapped_on_robot(*source.tool)) &&
      (!source.tool->measured.empty() || source.tool->swap || source.tool->fit))
    check_measured_tool(source, findings);
  if (source.lobes) check_lobes(source, findings);
  check_observed(source, findings);
  if (source.machine) check_machine(source, findings);
  if (source.path) check_path(source, findings);
  if (source.simulation) check_simulation(source, findings);
  check_named_files(source, findings);
  return std::move(findings.problems);
}

}  // namespace thinwall::cases
