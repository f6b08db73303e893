#include "case/checks/doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "case/checks/material_doubts.hpp"
#include "core/units.hpp"
#include "milling/cut/chip_load.hpp"
#include "setup/identified/posture_tables.hpp"
#include "setup/milling_process.hpp"
#include "setup/simulation_options.hpp"

namespace thinwall::cases {

namespace {

/// Walls of machined parts are thinner, and their other extents shorter: what is more, and was written without a unit,
/// may have been meant in millimetres.
constexpr double doubtful_wall = 0.5, doubtful_extent = 20.0;

/// Beside a metal, soft rubber is 2e5 times softer.
constexpr double doubtful_ratio = 1e6;

/// A machine's damping ratio is a hundred times larger.
constexpr double doubtful_damping = 1e-4;

std::string length(double value) {
  return core::readable_text(value, core::kind::length);
}

/// "part.thickness is 2 m: did you mean 2 mm? …", of a key that is given.
std::string asked(const CaseValue& value, double metres, const std::string& remedy) {
  return value.key + " is " + length(metres) + ": did you mean \"" + core::number_text(metres) + " mm\"? " + remedy;
}

/// Lengths without a unit, which are taken in metres. Who writes the unit is not asked.
void ask_about_bare_lengths(const Case& source, std::vector<std::string>& doubts) {
  for (const CaseValue& value : source.values) {
    const auto* metres = std::get_if<double>(&value.value);
    if (metres == nullptr || !value.bare) continue;
    const bool wall =
        value.key == "part.thickness" || (value.key.starts_with("part.zones[") && value.key.ends_with("].thickness"));
    const bool extent = value.key == "part.length" || value.key == "part.height";
    if ((wall && *metres >= doubtful_wall) || (extent && *metres >= doubtful_extent))
      doubts.push_back(asked(value, *metres, "A number without a unit is in metres; write the unit"));
  }
}

/// A wall of metres that is more than length and height.
void ask_about_wall(const Case& source, std::vector<std::string>& doubts) {
  const auto* box = source.part ? std::get_if<setup::BoxShape>(&source.part->shape) : nullptr;
  const CaseValue* thickness = find(source.values, "part.thickness");
  if (box == nullptr || thickness == nullptr || thickness->bare) return;
  if (!(box->thickness >= doubtful_wall && box->thickness > std::max(box->length, box->height))) return;
  doubts.push_back(asked(*thickness, box->thickness,
                         "The part is " + length(box->length) + " by " + length(box->height) +
                             " otherwise; if it is so, name its largest extent part.length"));
}

/// Patches that reach beyond the part on all sides: no contact is as large.
void ask_about_patches(const Case& source, std::vector<std::string>& doubts) {
  const auto* box = source.part ? std::get_if<setup::BoxShape>(&source.part->shape) : nullptr;
  if (box == nullptr) return;
  const double largest = std::max({box->length, box->height, box->thickness});
  for (const setup::Point& point : source.points) {
    if (2.0 * point.patch_radius <= largest) continue;
    doubts.push_back("points." + point.name + ".patch_radius is " + length(point.patch_radius) +
                     ", wider than the part of " + length(largest) +
                     ": it is the radius of the area that a cutter or a robot touches, a millimetre or some");
  }
}

void ask_about_materials(const Case& source, std::vector<std::string>& doubts) {
  if (!source.part) return;
  std::vector<std::pair<double, std::string>> moduli;
  if (std::isfinite(source.part->material.youngs_modulus))
    moduli.emplace_back(source.part->material.youngs_modulus, "part.material");
  for (const setup::MaterialRegion& region : source.part->materials)
    moduli.emplace_back(region.material.youngs_modulus, "the material of \"" + region.on + "\"");
  if (moduli.size() < 2) return;
  const auto [softest, stiffest] = std::ranges::minmax_element(moduli);
  if (!(stiffest->first >= doubtful_ratio * softest->first)) return;
  const auto stress = [](double value) { return core::readable_text(value, core::kind::stress); };
  doubts.push_back(stiffest->second + " has " + stress(stiffest->first) + " and " + softest->second + " " +
                   stress(softest->first) + ", a factor of " + core::number_text(stiffest->first / softest->first, 1) +
                   ": is a unit wrong? Steel has 210 GPa, rubber 5 MPa. The modes will be those of the soft one alone, "
                   "and their digits fewer");
}

/// A robot that nothing joins to the part: it changes nothing.
void ask_about_loose_robot(const Case& source, std::vector<std::string>& doubts) {
  const bool part = source.part || !source.measured_part.empty();
  if (!part || !source.robot || setup::carries_tool(source.robot) || !source.contacts.empty()) return;
  doubts.push_back("no [[contacts]] join the robot to the part, which is computed alone; add one, or remove [robot]");
}

/// A robot whose coefficient of damping is next to none, as where a ratio was meant. One without damping may say so.
void ask_about_robot_damping(const Case& source, std::vector<std::string>& doubts) {
  const auto* robot = source.robot ? std::get_if<setup::OneModeRobot>(&source.robot->model) : nullptr;
  if (robot == nullptr || !robot->damping || *robot->damping == 0.0) return;
  const double omega = 2.0 * std::numbers::pi * robot->frequency_hz.value_or(0.0);
  const double k = robot->stiffness.value_or(robot->mass.value_or(0.0) * omega * omega);
  const double m = robot->mass.value_or(k / (omega * omega));
  const double ratio = *robot->damping / (2.0 * std::sqrt(k * m));
  if (!(ratio < doubtful_damping)) return;
  const std::string written = core::number_text(*robot->damping, 3);
  doubts.push_back("robot.damping is " + written + " N s/m, a damping ratio of " + core::number_text(ratio, 1) +
                   ": did you mean damping_ratio = " + written + "?");
}

/// Coefficients that were measured with thicker chips.
void ask_about_thin_chips(const Case& source, std::vector<std::string>& doubts) {
  const CaseValue* given = find(source.values, "cutting.thinnest_chip");
  const auto* thinnest = given ? std::get_if<double>(&given->value) : nullptr;
  if (!thinnest || !source.tool || !source.cutting) return;
  const auto feed = setup::feed_per_tooth(source);
  const milling::Cutter cutter = setup::cutter_of(*source.tool);
  const auto arcs = setup::engagement_arcs(*source.cutting, cutter);
  if (!feed || arcs.empty()) return;
  double mean = *thinnest;
  for (const milling::ChipLoad& load : milling::chip_loads(cutter, arcs, *feed))
    if (load.mean_thickness_m > 0.0) mean = std::min(mean, load.mean_thickness_m);
  if (!(mean < *thinnest * (1.0 - 1e-5))) return;  // the mean is integrated by steps
  const bool curved = source.cutting->law == setup::ForceLawKind::power;
  doubts.push_back("the mean chip is " + core::readable_text(mean, core::kind::length) +
                   " thick, thinner than cutting.thinnest_chip, " + core::readable_text(*thinnest, core::kind::length) +
                   ", at which the coefficients were measured; " +
                   (curved ? "the law is extrapolated there" : "thin chips take more force per area"));
}

/// Teeth that runout keeps from a part of their arcs: what one misses is cut with the delay of two pitches.
void ask_about_missed_chips(const Case& source, std::vector<std::string>& doubts) {
  if (!source.tool || !source.cutting || source.tool->runout.empty()) return;
  const auto feed = setup::feed_per_tooth(source);
  const milling::Cutter cutter = setup::cutter_of(*source.tool);
  const auto arcs = setup::engagement_arcs(*source.cutting, cutter);
  if (!feed || arcs.empty()) return;
  double least = 1.0;
  for (const milling::ChipLoad& load : milling::chip_loads(cutter, arcs, *feed))
    least = std::min(least, load.share_in_cut);
  if (least >= 1.0) return;
  doubts.push_back(fmt::format(
      "runout lets a tooth cut in {:.1f} % of its arc only; what it misses the next one cuts with the delay of both "
      "pitches, which the stability analysis does not follow",
      100.0 * least));
}

/// More turns than the part is long.
void ask_about_turns(const Case& source, std::vector<std::string>& doubts) {
  if (!source.simulation || !source.part || !source.cutting || !source.tool || source.simulation->length_m) return;
  const auto feed = setup::feed_per_tooth(source);
  if (!feed) return;
  const double feed_a_turn = *feed * source.tool->teeth;
  const double extent = setup::box_size(*source.part).dot(source.cutting->feed_direction.cwiseAbs());
  const int turns = setup::simulation_options(*source.simulation, *feed, source.tool->teeth).recorded_turns;
  if (!(turns * feed_a_turn > extent) || !(extent > 0.0)) return;
  doubts.push_back("the " + std::to_string(turns) + " turns that a simulation records feed " +
                   core::readable_text(turns * feed_a_turn, core::kind::length) + ", and the part is " +
                   core::readable_text(extent, core::kind::length) +
                   " long along the feed; take fewer by simulation.turns");
}

/// A trace of more turns than are recorded, other than the usual one, which is no one's wish.
void ask_about_trace(const Case& source, std::vector<std::string>& doubts) {
  if (!source.simulation) return;
  const setup::Simulation& asked = *source.simulation;
  const bool other_count = asked.start == setup::CutStart::border || asked.length_m.has_value();
  if (other_count || asked.traced_turns <= asked.turns || asked.traced_turns == setup::Simulation{}.traced_turns)
    return;
  doubts.push_back(fmt::format(
      "simulation.trace is {} turns, and {} are recorded, which are all that is traced; give simulation.turns as many",
      asked.traced_turns, asked.turns));
}

}  // namespace

std::vector<std::string> doubts_about(const Case& source) {
  std::vector<std::string> doubts;
  ask_about_bare_lengths(source, doubts);
  ask_about_wall(source, doubts);
  ask_about_patches(source, doubts);
  ask_about_materials(source, doubts);
  ask_about_robot_damping(source, doubts);
  ask_about_loose_robot(source, doubts);
  ask_about_turns(source, doubts);
  ask_about_trace(source, doubts);
  ask_about_cut_material(source, doubts);
  ask_about_thin_chips(source, doubts);
  ask_about_missed_chips(source, doubts);
  if (const setup::TabledRobot* robot = setup::tabled_robot(source.robot)) {
    const std::vector<std::string> of_postures = setup::doubts_about(*robot);
    doubts.insert(doubts.end(), of_postures.begin(), of_postures.end());
  }
  if (source.urdf_arm) doubts.insert(doubts.end(), source.urdf_arm->assumed.begin(), source.urdf_arm->assumed.end());
  return doubts;
}

}  // namespace thinwall::cases
