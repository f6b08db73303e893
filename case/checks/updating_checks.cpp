#include "case/checks/updating_checks.hpp"

#include <algorithm>

#include "case/checks/kept_points.hpp"
#include "case/checks/part_checks.hpp"
#include "case/numbers.hpp"
#include "case/schema/schema.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::cases {

namespace {

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
  if (parameter.key.ends_with(".record")) {
    findings.report(key + ".key", "says how a file is read, which happens once, before a fit; fit another number");
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
  if (source.robot && setup::is_measured(*source.robot))
    findings.report(key + ".on", "\"coupled\" needs a robot that is modelled, not a measured one; set robot.model");
  if (!setup::may_be_held(*source.part))
    findings.report(key + ".on", "\"coupled\" needs a part that is held; add [[part.supports]]");
}

}  // namespace

void check_updating(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.updating.size(); ++i) {
    const std::string key = indexed("updating", i);
    const setup::Updating& updating = source.updating[i];
    if (!source.part ||
        (updating.on == setup::FitOf::part && setup::kind(*source.part) == setup::ShapeKind::matrices)) {
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

}  // namespace thinwall::cases
