#include "case/checks/lobes_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <initializer_list>

#include "milling/chart/lobe_method.hpp"
#include "milling/chart/robust_lobes.hpp"
#include "setup/measured_noise.hpp"
#include "setup/milling_process.hpp"

namespace thinwall::cases {

namespace {

/// Reports a key that none of the methods reads by which the charts are computed.
void check_method_key(const setup::LobesOptions& lobes, const std::string& key,
                      std::initializer_list<milling::Method> readers, const char* which, Findings& findings) {
  const auto used = [&](milling::Method method) {
    return method == lobes.method || std::ranges::count(lobes.compare, method) > 0;
  };
  if (!findings.given(key) || findings.unreadable("lobes.method") || std::ranges::any_of(readers, used)) return;
  findings.report(key, fmt::format("belongs to {}, but lobes.method is \"{}\"; remove it, or set lobes.method or "
                                   "lobes.compare",
                                   which, milling::name(lobes.method)));
}

void check_method_keys(const setup::LobesOptions& lobes, Findings& findings) {
  using enum milling::Method;
  check_method_key(lobes, "lobes.steps_per_period",
                   {semi_discretization_0, semi_discretization_1, semi_discretization_2, full_discretization_1,
                    full_discretization_2, full_discretization_3},
                   "semi_discretization and full_discretization", findings);
  check_method_key(lobes, "lobes.harmonics", {multi_frequency, zeroth_order}, "multi_frequency and zeroth_order",
                   findings);
}

/// The cut as far as it matters for what a method can take.
milling::MillingProcess outline_of(const Case& source) {
  milling::MillingProcess process;
  if (source.tool) process.cutter = setup::cutter_of(*source.tool);
  if (!source.cutting) return process;
  const std::size_t arcs = source.cutting->entry_angles.size();
  process.further_engagements.resize(arcs > 1 ? arcs - 1 : 0);
  process.damping.C = source.cutting->process_damping;
  const bool linear =
      source.cutting->law == setup::ForceLawKind::linear || source.cutting->law == setup::ForceLawKind::oblique;
  const bool own_chips = source.tool && !linear && !source.tool->runout.empty();
  if (own_chips) process.tooth_coefficients.resize(source.tool->runout.size());  // by a law of the chip, each its own
  return process;
}

void check_method(const Case& source, const std::string& key, milling::Method method, Findings& findings) {
  if (method == milling::Method::direct) return;
  if (source.tool && setup::known_by_lines(*source.tool)) {
    findings.report(
        key, "\"" + milling::name(method) +
                 "\" needs poles, tool.measured has none; take \"direct\", or give tool.fit = true or tool.modes");
    return;
  }
  const std::string why = milling::objection(method, outline_of(source));
  if (!why.empty()) findings.report(key, why);
}

void check_compared(const Case& source, Findings& findings) {
  const auto& methods = source.lobes->compare;
  for (std::size_t i = 0; i < methods.size(); ++i) {
    const std::string name = milling::name(methods[i]);
    if (methods[i] == source.lobes->method) {
      findings.report("lobes.compare", "\"" + name + "\" is lobes.method itself; name others");
    } else if (std::ranges::count(methods.begin(), methods.begin() + static_cast<std::ptrdiff_t>(i), methods[i]) > 0) {
      findings.report("lobes.compare", "\"" + name + "\" is there twice; name each once");
    } else {
      check_method(source, "lobes.compare", methods[i], findings);
    }
  }
}

void check_robust(const setup::LobesOptions& lobes, Findings& findings) {
  const milling::Uncertainty& u = lobes.robust->uncertainty;
  if (u.frequency == 0.0 && u.damping_ratio == 0.0 && u.mass == 0.0 && u.coefficients == 0.0)
    findings.report("lobes.uncertainty",
                    "nothing is uncertain; give frequency, damping_ratio, receptance or "
                    "coefficients above 0, or remove the table");
  if (!(lobes.robust->confidence > 0.0)) return;  // reported
  const double reach = milling::two_sided_coverage(lobes.robust->confidence) * u.frequency;
  if (reach > milling::most_reach) {
    findings.report("lobes.uncertainty.frequency",
                    fmt::format("{:g} at a confidence of {:g} moves lobes by {:.0f} % of their speed, at most {:.0f} % "
                                "can be followed; lower one of the two",
                                u.frequency, lobes.robust->confidence, 100.0 * reach, 100.0 * milling::most_reach));
  }
}

void check_noise_samples(const Case& source, Findings& findings) {
  if (source.cutting && !source.cutting->spindle_speed_rpm)
    findings.report("lobes.noise_samples", "draws are made at the case's own speed; give cutting.spindle_speed");
  const auto* robot = source.robot ? std::get_if<setup::MeasuredRobot>(&source.robot->model) : nullptr;
  const bool noisy = (source.tool && setup::known_by_lines(*source.tool) && any_noise(source.tool->measured)) ||
                     setup::any_noise(source.measured_part) || (robot != nullptr && any_noise(robot->measured));
  if (!noisy)
    findings.report("lobes.noise_samples",
                    "nothing is noisy; give noise or averages of measured FRFs of tool, part or robot, or remove it");
}

}  // namespace

void check_chart_choices(const Case& source, Findings& findings) {
  const setup::LobesOptions& lobes = *source.lobes;
  check_method_keys(lobes, findings);
  check_method(source, "lobes.method", lobes.method, findings);
  check_compared(source, findings);
  if (source.tool && setup::known_by_lines(*source.tool)) {
    for (const char* key : {"lobes.map_depths", "lobes.uncertainty"}) {
      if (findings.given(key) || has_table(findings.values, key))
        findings.report(key, "needs poles, tool.measured has none; remove it, or give tool.fit = true or tool.modes");
    }
  }
  if (lobes.robust) check_robust(lobes, findings);
  if (lobes.noise_samples) check_noise_samples(source, findings);
}

void check_machine(const Case& source, Findings& findings) {
  const milling::MachineLimits& machine = *source.machine;
  if (machine.min_spindle_speed_rpm >= machine.max_spindle_speed_rpm)
    findings.report("machine.min_spindle_speed",
                    "the lowest speed must lie below the highest (machine.max_spindle_speed)");
  if (source.lobes && (machine.min_spindle_speed_rpm > source.lobes->to_rpm ||
                       machine.max_spindle_speed_rpm < source.lobes->from_rpm)) {
    findings.report("machine", fmt::format("its speeds lie beside the chart, {:g} to {:g} rpm; change lobes.from and "
                                           "lobes.to, or the machine's",
                                           source.lobes->from_rpm, source.lobes->to_rpm));
  }
  const bool flat = !source.tool || source.tool->end == setup::ToolEnd::flat;
  const bool feed = !source.cutting || source.cutting->feed_per_tooth ||
                    (source.cutting->feed_rate && source.cutting->spindle_speed_rpm);
  for (const char* key : {"machine.max_power", "machine.max_torque", "machine.max_feed_rate"}) {
    if (!findings.given(key)) continue;
    if (!feed)
      findings.report(key,
                      "depends on the feed; give cutting.feed_per_tooth, or cutting.feed_rate and "
                      "cutting.spindle_speed");
    else if (!flat) findings.report(key, "is known for flat ends only; leave it out");
  }
}

}  // namespace thinwall::cases
