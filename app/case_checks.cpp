#include "app/case_checks.hpp"

#include <algorithm>
#include <cmath>

#include "app/findings.hpp"
#include "app/part_checks.hpp"
#include "app/schema.hpp"
#include "core/units.hpp"

namespace thinwall::app {

namespace {

std::string indexed(const std::string& table, std::size_t index) {
  return table + "[" + std::to_string(index) + "]";
}

void check_something_to_do(const Case& source, Findings& findings) {
  const bool tool_alone = source.tool && !source.tool->modes.empty() && source.lobes;
  if (source.part || !source.measured_part.empty() || tool_alone || has_table(source.values, "part")) return;
  findings.report("part",
                  "missing; a case holds a part ([part] or [[part.measured]]), or a tool with modes and [lobes]");
}

void check_ranges(const Case& source, Findings& findings) {
  for (const auto& [a, b] :
       {std::pair{"modes.count", "modes.up_to"}, std::pair{"reduction.modes", "reduction.up_to"}}) {
    if (findings.given(a) && findings.given(b))
      findings.report(b, "give either " + std::string(a) + " or " + b + ", not both");
  }
  for (const auto& name : source.reduction.interface) {
    findings.require_known("reduction.interface", name, part_points(source), "point");
  }
}

void check_damping(const Case& source, Findings& findings) {
  const Damping& damping = source.damping;
  const auto belongs_to = [&](const char* key, const char* model, bool used) {
    if (!used || damping.model.empty() || damping.model == model) return;
    findings.report(
        key, "belongs to damping.model = \"" + std::string(model) + "\", but the model is \"" + damping.model + "\"");
  };
  belongs_to("damping.ratios", "modal", !damping.ratios.empty());
  belongs_to("damping.from_frf.file", "modal", damping.from_frf.has_value());
  belongs_to("damping.alpha", "rayleigh", damping.alpha != 0.0);
  belongs_to("damping.beta", "rayleigh", damping.beta != 0.0);
  belongs_to("damping.loss_factor", "structural", damping.loss_factor != 0.0);
  if (damping.model == "rayleigh" && damping.alpha == 0.0 && damping.beta == 0.0) {
    findings.report("damping.model", "rayleigh needs alpha or beta");
  }
}

void require_direction(const std::string& key, const std::string& dof, Findings& findings) {
  if (dof.empty() || (dof.find('.') != std::string::npos && dof.find('.') + 1 < dof.size())) return;
  findings.report(key, "\"" + dof + "\" names no direction; write for example \"" + point_of(dof) + ".x\"");
}

/// Dimension of an FRF per newton: m/N has s²/kg, a mobility s/kg, an accelerance 1/kg.
void check_measured(const std::string& key, const MeasuredFrf& frf, Findings& findings) {
  const int time = frf.quantity == "receptance" ? 2 : frf.quantity == "mobility" ? 1 : 0;
  if (!frf.unit.empty() && !frf.quantity.empty()) {
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
  require_direction(key + ".response", frf.response, findings);
  require_direction(key + ".force", frf.force, findings);
  std::error_code ignored;
  if (!frf.file.empty() && !std::filesystem::is_regular_file(frf.file, ignored)) {
    findings.report(key + ".file", "there is no file \"" + frf.file.string() + "\"");
  }
}

void check_all_measured(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.measured_part.size(); ++i) {
    check_measured(indexed("part.measured", i), source.measured_part[i], findings);
  }
  if (source.damping.from_frf) check_measured("damping.from_frf", *source.damping.from_frf, findings);
  if (!source.robot) return;
  for (std::size_t i = 0; i < source.robot->measured.size(); ++i) {
    const std::string key = indexed("robot.measured", i);
    check_measured(key, source.robot->measured[i], findings);
    findings.require_known(key + ".response", point_of(source.robot->measured[i].response), {source.robot->point},
                           "point of the robot");
  }
}

void check_robot(const Robot& robot, Findings& findings) {
  if (robot.model == "measured") {
    if (robot.measured.empty()) findings.report("robot.model", "measured needs [[robot.measured]] with a file");
    for (const auto* key :
         {"robot.frequency", "robot.mass", "robot.stiffness", "robot.damping", "robot.damping_ratio"}) {
      if (findings.given(key)) findings.report(key, "belongs to robot.model = \"one_mode\"");
    }
    return;
  }
  if (!robot.measured.empty()) findings.report("robot.measured", "belongs to robot.model = \"measured\"");
  if (!robot.stiffness) findings.report("robot.stiffness", "missing; one mode needs its stiffness at the tip");
  if (robot.mass.has_value() == robot.frequency_hz.has_value()) {
    findings.report("robot.frequency", "give either frequency or mass beside the stiffness");
  }
  if (robot.damping.has_value() == robot.damping_ratio.has_value()) {
    findings.report("robot.damping_ratio", "give either damping_ratio or damping");
  }
}

void check_contact(const Case& source, const std::string& key, const Contact& contact, Findings& findings) {
  findings.require_known(key + ".part", contact.part_point, part_points(source), "point");
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
  const ResponseOptions& response = source.response;
  if (response.from_hz >= response.to_hz)
    findings.report("response.from", "the first line must lie below the last (response.to)");
  if (response.logarithmic && response.from_hz == 0.0)
    findings.report("response.from", "a logarithmic axis cannot start at 0 Hz");
  if (!findings.given("response.points")) return;
  for (const auto& name : response.points)
    findings.require_known("response.points", name, part_points(source), "point");
}

void check_parameter(const Case& source, const std::string& key, const UpdatingParameter& parameter,
                     Findings& findings) {
  double start = 0.0;
  try {
    start = get_value(source, parameter.key);
  } catch (const core::InputError& error) {
    if (!parameter.key.empty()) findings.report(key + ".key", error.what());
    return;
  }
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

void check_target(const Case& source, const std::string& on, const std::string& key, const UpdatingTarget& target,
                  Findings& findings) {
  const bool reduction = target.quantity == "reduction_at";
  const auto points = part_points(source);
  findings.require_known(key + ".point", point_of(target.point), points, "point");
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
  if (on == "part" && (target.quantity == "coupled_frequency" || reduction)) {
    findings.report(key + ".quantity",
                    "\"" + target.quantity + "\" is a result of the coupled model; set on = \"coupled\"");
  }
}

void check_updating(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.updating.size(); ++i) {
    const std::string key = indexed("updating", i);
    const Updating& updating = source.updating[i];
    if (updating.parameters.empty()) findings.report(key + ".parameters", "missing; name at least one number to fit");
    if (updating.targets.empty()) findings.report(key + ".targets", "missing; name at least one result to fit to");
    for (std::size_t j = 0; j < updating.parameters.size(); ++j) {
      check_parameter(source, indexed(key + ".parameters", j), updating.parameters[j], findings);
    }
    for (std::size_t j = 0; j < updating.targets.size(); ++j) {
      check_target(source, updating.on, indexed(key + ".targets", j), updating.targets[j], findings);
    }
    if (updating.on == "coupled" && (!source.robot || source.contacts.empty())) {
      findings.report(key + ".on", "\"coupled\" needs [robot] and [[contacts]]");
    }
  }
}

void check_cutting(const Case& source, Findings& findings) {
  const Cutting& cutting = *source.cutting;
  if (!source.tool) {
    findings.report("cutting", "there is no cutter; add [tool]");
  } else if (cutting.radial_depth > source.tool->diameter) {
    findings.report("cutting.radial_depth", core::readable_text(cutting.radial_depth, core::kind::length) +
                                                " is more than the tool's diameter of " +
                                                core::readable_text(source.tool->diameter, core::kind::length));
  }
  if (std::abs(cutting.feed_direction.dot(cutting.tool_axis)) > 1e-9) {
    findings.report("cutting.feed_direction", "the feed must be perpendicular to cutting.tool_axis");
  }
  const auto points = part_points(source);
  if (!points.empty()) findings.require_known("cutting.at", cutting.at, points, "point");
  for (int axis = 0; axis < 3; ++axis) {
    const std::string support = clamped_by(source, cutting.at, Eigen::Vector3d::Unit(axis));
    if (support.empty()) continue;
    findings.report("cutting.at",
                    "point \"" + cutting.at + "\" is clamped by \"" + support + "\"; move it off the support");
    break;
  }
}

void check_lobes(const Case& source, Findings& findings) {
  const LobesOptions& lobes = *source.lobes;
  if (!source.cutting) findings.report("lobes", "there is no cut; add [cutting]");
  if (lobes.from_rpm >= lobes.to_rpm && lobes.count > 1)
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
  if (source.robot) check_robot(*source.robot, findings);
  check_contacts(source, findings);
  check_response(source, findings);
  check_updating(source, findings);
  if (source.cutting) check_cutting(source, findings);
  if (source.lobes) check_lobes(source, findings);
  return std::move(findings.problems);
}

}  // namespace thinwall::app
