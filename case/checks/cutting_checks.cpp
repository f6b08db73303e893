#include "case/checks/cutting_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/units.hpp"
#include "setup/materials/cut_materials.hpp"
#include "setup/materials/specific_forces.hpp"
#include "setup/milling_process.hpp"

namespace thinwall::cases {

namespace {

constexpr double degree = std::numbers::pi / 180.0;

void check_end(const setup::Tool& tool, Findings& findings) {
  if (tool.end == setup::ToolEnd::bull_nose && tool.corner_radius == 0.0)
    findings.report("tool.end", "a bull nose needs tool.corner_radius above 0");
  if (tool.end == setup::ToolEnd::bull_nose && tool.corner_radius > 0.5 * tool.diameter) {
    findings.report("tool.corner_radius", core::readable_text(tool.corner_radius, core::kind::length) +
                                              " is more than half the tool's diameter of " +
                                              core::readable_text(tool.diameter, core::kind::length));
    return;
  }
  if (!(tool.diameter > 0.0) || !(tool.length > 0.0)) return;
  for (const auto& violation : milling::validate(setup::cutter_of(tool).envelope, tool.diameter))
    findings.report("tool.end", violation);
}

void check_angles(const setup::Cutting& cutting, Findings& findings) {
  if (cutting.entry_angles.size() != cutting.exit_angles.size()) {
    findings.report("cutting.exit_angle", fmt::format("{} exits for {} entries; give one of each an arc",
                                                      cutting.exit_angles.size(), cutting.entry_angles.size()));
    return;
  }
  std::vector<milling::Engagement> arcs;
  for (std::size_t i = 0; i < cutting.entry_angles.size(); ++i) {
    arcs.push_back({cutting.entry_angles[i], cutting.exit_angles[i]});
    const double arc = arcs.back().arc_rad();
    if (std::isnan(arc)) return;  // unreadable, reported
    if (arc > 0.0 && arc <= 360.0 * degree + 1e-9) continue;
    findings.report("cutting.exit_angle",
                    fmt::format("exit at {:g} deg, entry at {:g} deg: the exit must follow "
                                "within a turn; add 360 deg where the arc passes 0",
                                cutting.exit_angles[i] / degree, cutting.entry_angles[i] / degree));
    return;
  }
  for (const auto& violation : milling::validate(arcs)) findings.report("cutting.entry_angle", violation);
}

void require_feed(const Case& source, const std::string& key, const std::string& why, Findings& findings) {
  const setup::Cutting& c = *source.cutting;
  if (c.feed_per_tooth || (c.feed_rate && c.spindle_speed_rpm)) return;
  findings.report(key, why +
                           " depends on the feed; give cutting.feed_per_tooth, or cutting.feed_rate and "
                           "cutting.spindle_speed");
}

/// A k_1.1 belongs to the exponent with which it was published.
void check_own_exponents(const Case& source, const std::string& material, Findings& findings) {
  const auto middle = setup::power_law_of(material);
  if (source.cutting->law != setup::ForceLawKind::power || !middle) return;
  if (!findings.written("cutting.exponents") || findings.written("cutting.Kt")) return;
  findings.report("cutting.exponents",
                  fmt::format("the Kt of {} at a chip of 1 mm belongs to its exponent of {:.3f}; leave the exponents "
                              "out, or give cutting.Kt, too",
                              material, middle->exponent));
}

/// A material of which the linear law has no coefficients, where the case asks for that law.
void check_cut_material(const Case& source, Findings& findings) {
  const CaseValue* given = find(source.values, "cutting.material");
  const auto* material = given ? std::get_if<std::string>(&given->value) : nullptr;
  if (!material) return;
  check_own_exponents(source, *material, findings);
  if (source.cutting->law != setup::ForceLawKind::linear) return;
  if (setup::coefficients_of(*material) || !setup::power_law_of(*material)) return;
  findings.report("cutting.material", *material +
                                          " is published for the power law only; write cutting.law = \"power\", "
                                          "where Kt is that at a chip of 1 mm, or leave the material out");
}

}  // namespace

void check_tool(const setup::Tool& tool, Findings& findings) {
  const auto as_many = [&](const char* key, const std::vector<double>& values) {
    if (values.empty() || values.size() == static_cast<std::size_t>(tool.teeth)) return true;
    findings.report(
        key, std::to_string(values.size()) + " values for " + std::to_string(tool.teeth) + " teeth; give one a tooth");
    return false;
  };
  (void)as_many("tool.helices", tool.helices);
  (void)as_many("tool.runout", tool.runout);
  check_end(tool, findings);
  if (!as_many("tool.pitches", tool.pitches) || tool.pitches.empty()) return;
  const double sum = std::accumulate(tool.pitches.begin(), tool.pitches.end(), 0.0) / degree;
  if (std::abs(sum - 360.0) > 1e-4) {
    findings.report("tool.pitches", "the pitches come to " + fmt::format("{:g}", sum) +
                                        " deg together; they must make a full turn of 360 deg");
  }
}

void check_engagement(const Case& source, Findings& findings) {
  const setup::Cutting& cutting = *source.cutting;
  const bool angles = !cutting.entry_angles.empty() || !cutting.exit_angles.empty();
  if (cutting.radial_depth && angles)
    findings.report("cutting.radial_depth", "give either the radial depth or entry and exit angles, not both");
  if (!cutting.radial_depth && !angles)
    findings.report("cutting.radial_depth", "missing; or give cutting.entry_angle and cutting.exit_angle");
  if (angles) check_angles(cutting, findings);
  if (cutting.radial_depth && source.tool) {
    const setup::Tool& tool = *source.tool;
    const bool round_end = tool.end != setup::ToolEnd::flat;
    if (*cutting.radial_depth > tool.diameter) {
      findings.report("cutting.radial_depth", core::readable_text(*cutting.radial_depth, core::kind::length) +
                                                  " is more than the tool's diameter of " +
                                                  core::readable_text(tool.diameter, core::kind::length));
    } else if (round_end && *cutting.radial_depth < tool.diameter) {
      findings.report("cutting.radial_depth",
                      "the arc of a tool whose radius changes along it does not follow from the radial depth; give "
                      "cutting.entry_angle and cutting.exit_angle, or a full slot");
    }
  }
  if (std::abs(cutting.feed_direction.dot(cutting.tool_axis)) > 1e-9)
    findings.report("cutting.feed_direction", "the feed must be perpendicular to cutting.tool_axis");
}

void check_force_law(const Case& source, Findings& findings) {
  const setup::Cutting& c = *source.cutting;
  check_cut_material(source, findings);
  const bool curved = c.law == setup::ForceLawKind::power || c.law == setup::ForceLawKind::fractional;
  const bool unreadable = c.exponents.empty();  // reported
  if (c.law == setup::ForceLawKind::power && c.exponents.size() != 3 && !unreadable)
    findings.report("cutting.exponents", "the power law needs one exponent, or three for Kt, Kr, Ka");
  if (curved && findings.written("cutting.law"))
    require_feed(source, "cutting.law", "a law that is not linear", findings);
  else if (curved)
    require_feed(source, "cutting.material", "the power law, which alone is published of this material,", findings);
  if (!source.tool) return;
  if (!source.tool->runout.empty()) require_feed(source, "tool.runout", "what runout does", findings);
  if (curved && source.tool->end != setup::ToolEnd::flat) {
    // A law that nobody wrote is that of the material.
    const bool own_law = findings.written("cutting.law");
    findings.report(own_law ? "cutting.law" : "cutting.material",
                    std::string("only the linear law serves a tool whose chip thins towards the tip; ") +
                        (own_law ? "" : "leave the material out and ") + "give Kt, Kr and Ka for its mean chip");
  }
  if (c.process_damping > 0.0 && source.tool->end != setup::ToolEnd::flat)
    findings.report("cutting.process_damping", "is known for flat ends only; leave it out");
}

}  // namespace thinwall::cases
