#include "setup/milling_process.hpp"

#include "milling/cut/chip_load.hpp"
#include "milling/cut/oblique_cutting.hpp"

namespace thinwall::setup {

namespace {

milling::CuttingCoefficients oblique(const Cutting& c, double helix) {
  const OrthogonalData& o = c.orthogonal;
  const double friction = o.friction_angle.value_or(0.0);
  const double rake = o.rake_angle.value_or(0.0);
  const double shear = o.shear_angle.value_or(milling::merchant_shear_angle(friction, rake));
  auto k = milling::oblique_coefficients({o.shear_stress.value_or(0.0), shear, friction, rake, c.Kte, c.Kre}, helix);
  k.K_ae = c.Kae;
  return k;
}

/// Helices that differ give each tooth its own coefficients.
void set_oblique(const Cutting& c, milling::MillingProcess& process) {
  const auto& helices = process.cutter.helices_rad;
  process.coefficients = oblique(c, helices.empty() ? 0.0 : helices.front());
  if (process.cutter.equal_teeth()) return;
  for (const double helix : helices) process.tooth_coefficients.push_back(oblique(c, helix));
}

void set_force(const CutSetup& source, milling::MillingProcess& process) {
  const Cutting& c = *source.cutting;
  if (c.law == ForceLawKind::oblique) set_oblique(c, process);
  else if (c.law == ForceLawKind::linear) process.coefficients = {c.Kt, c.Kr, c.Ka, c.Kte, c.Kre, c.Kae};
  else milling::set_force_law(process, force_law(c, process), feed_per_tooth(source).value_or(0.0));
}

}  // namespace

milling::ForceLaw force_law(const Cutting& c, const milling::MillingProcess& process) {
  if (c.law == ForceLawKind::power)
    return milling::PowerLaw{c.Kt, c.Kr, c.Ka, c.exponents[0], c.exponents[1], c.exponents[2]};
  if (c.law == ForceLawKind::fractional)
    return milling::FractionalLaw{c.Kt, c.Kr, c.Ka, c.chip_scale.value_or(0.0), c.stiffness_ratio.value_or(0.0)};
  return process.coefficients;
}

milling::Cutter cutter_of(const Tool& tool) {
  milling::Cutter cutter{tool.teeth, tool.diameter, tool.pitches, tool.helices, {}, tool.runout};
  if (tool.end == ToolEnd::ball) cutter.envelope = milling::ball_end(tool.diameter);
  else if (tool.end == ToolEnd::bull_nose) cutter.envelope = milling::bull_nose(tool.diameter, tool.corner_radius);
  else if (tool.end == ToolEnd::general)
    cutter.envelope = {tool.corner_radius, tool.corner_radial, tool.corner_axial, tool.tip_angle, tool.taper};
  cutter.envelope.height_m = tool.length;
  return cutter;
}

std::optional<double> feed_per_tooth(const CutSetup& source) {
  const Cutting& c = *source.cutting;
  if (c.feed_per_tooth) return c.feed_per_tooth;
  if (!c.feed_rate || !c.spindle_speed_rpm || !source.tool) return std::nullopt;
  return milling::feed_per_tooth_m(cutter_of(*source.tool), *c.feed_rate, *c.spindle_speed_rpm);
}

std::vector<milling::Engagement> engagement_arcs(const Cutting& c, const milling::Cutter& cutter) {
  if (c.radial_depth) {
    const auto direction = c.down_milling ? milling::MillingDirection::down : milling::MillingDirection::up;
    return {milling::engagement_of(cutter, *c.radial_depth, direction)};
  }
  std::vector<milling::Engagement> arcs;
  for (std::size_t i = 0; i < c.entry_angles.size() && i < c.exit_angles.size(); ++i)
    arcs.push_back({c.entry_angles[i], c.exit_angles[i]});
  return arcs;
}

milling::MillingProcess milling_process(const CutSetup& source) {
  const Cutting& c = *source.cutting;
  milling::MillingProcess process;
  process.cutter = cutter_of(*source.tool);
  const std::vector<milling::Engagement> arcs = engagement_arcs(c, process.cutter);
  if (!arcs.empty()) {
    process.engagement = arcs.front();
    process.further_engagements.assign(arcs.begin() + 1, arcs.end());
  }
  process.frame = milling::leaning({c.feed_direction, c.tool_axis}, c.lead_angle);
  set_force(source, process);
  process.damping = {c.process_damping, c.process_damping_friction};
  return process;
}

}  // namespace thinwall::setup
