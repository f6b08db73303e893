#include "case/checks/observed_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "learning/parameter_limit.hpp"

namespace thinwall::cases {

namespace {

/// The keys of a cut that is given by itself.
constexpr const char* needed_keys[] = {"spindle_speed", "depth", "observed"};
/// The keys by which an observed cut is judged.
constexpr const char* judged_keys[] = {"spindle_speed", "depth", "observed", "chatter_frequency"};

/// A key below an entry, and what is wrong there; an empty text: nothing.
struct CutFault {
  std::string key, text;
};

CutFault fault_beside_chart(const setup::LobesOptions& lobes, const milling::ObservedCut& cut) {
  if (cut.spindle_speed_rpm < lobes.from_rpm || cut.spindle_speed_rpm > lobes.to_rpm) {
    return {"spindle_speed", fmt::format("{:g} rpm lies outside the chart, {:g} to {:g} rpm; widen lobes.from and "
                                         "lobes.to, or remove the cut",
                                         cut.spindle_speed_rpm, lobes.from_rpm, lobes.to_rpm)};
  }
  if (cut.depth_m > lobes.depth_limit) {
    return {"depth", fmt::format("{} is deeper than the chart goes, {}; raise lobes.depth_limit (tool.length if it is "
                                 "not given), or remove the cut",
                                 core::readable_text(cut.depth_m, core::kind::length),
                                 core::readable_text(lobes.depth_limit, core::kind::length))};
  }
  return {};
}

CutFault fault_of_frequency(const setup::LobesOptions& lobes, const milling::ObservedCut& cut) {
  if (!cut.chatter_frequency_hz) return {};
  if (cut.outcome == milling::CutOutcome::stable)
    return {"chatter_frequency", "a stable cut has none; remove it, or say chatter or marginal"};
  if (lobes.modes_up_to_hz && *cut.chatter_frequency_hz > *lobes.modes_up_to_hz) {
    return {"chatter_frequency", fmt::format("{:g} Hz lies above lobes.modes_up_to, {:g} Hz, so that no mode of the "
                                             "chart can give it; raise that",
                                             *cut.chatter_frequency_hz, *lobes.modes_up_to_hz)};
  }
  return {};
}

/// The outcomes of the cuts so far, with the entries that state them, by speed and depth.
using Seen = std::map<std::pair<double, double>, std::pair<milling::CutOutcome, std::string>>;

CutFault fault_of_contradiction(const std::string& entry, const milling::ObservedCut& cut, Seen& seen) {
  const auto [place, is_new] = seen.try_emplace({cut.spindle_speed_rpm, cut.depth_m}, cut.outcome, entry);
  if (is_new || place->second.first == cut.outcome) return {};
  return {"observed",
          fmt::format("{:g} rpm, {} is {} here and {} in {}; call it marginal once, or remove one",
                      cut.spindle_speed_rpm, core::readable_text(cut.depth_m, core::kind::length),
                      core::word_of(cut.outcome), core::word_of(place->second.first), place->second.second)};
}

CutFault fault_of(const setup::LobesOptions& lobes, const std::string& entry, const milling::ObservedCut& cut,
                  Seen& seen) {
  if (CutFault fault = fault_beside_chart(lobes, cut); !fault.text.empty()) return fault;
  if (CutFault fault = fault_of_frequency(lobes, cut); !fault.text.empty()) return fault;
  return fault_of_contradiction(entry, cut, seen);
}

/// True if one of the values of an entry could not be read, which is said elsewhere: the cut cannot be judged.
bool has_unreadable(const std::string& entry, const setup::ObservedCuts& cuts, const Findings& findings) {
  if (!cuts.file.empty()) return false;
  const milling::ObservedCut& cut = cuts.cuts.front();
  if (std::isnan(cut.spindle_speed_rpm) || std::isnan(cut.depth_m) ||
      std::isnan(cut.chatter_frequency_hz.value_or(0.0)))
    return true;
  return std::ranges::any_of(judged_keys, [&](const char* key) { return findings.unreadable(entry + "." + key); });
}

bool check_entry(const std::string& entry, const setup::ObservedCuts& cuts, Findings& findings) {
  if (!cuts.file.empty()) {
    for (const char* key : judged_keys)
      if (findings.given(entry + "." + key))
        findings.report(entry + "." + key, "is in the file already; remove it, or `file`");
    return true;
  }
  bool complete = true;
  for (const char* key : needed_keys) {
    if (findings.given(entry + "." + key) || findings.unreadable(entry + "." + key)) continue;
    findings.report(entry, std::string(key) + " is missing; give spindle_speed, depth and observed, or `file`");
    complete = false;
  }
  return complete;
}

/// The next cut is for a speed of the chart.
void check_wanted_speed(const Case& source, Findings& findings) {
  const auto rpm = source.calibration->spindle_speed_rpm;
  if (!rpm || !source.lobes || std::isnan(*rpm)) return;
  if (*rpm >= source.lobes->from_rpm && *rpm <= source.lobes->to_rpm) return;
  findings.report(
      "calibration.spindle_speed",
      fmt::format("{:g} rpm lies outside the chart, {:g} to {:g} rpm; give a speed there (--speed), or widen "
                  "lobes.from and lobes.to",
                  *rpm, source.lobes->from_rpm, source.lobes->to_rpm));
}

/// The parameters of a tool alone are known before the chart; others are counted with it.
void check_parameters(const Case& source, const milling::Uncertainty& known, Findings& findings) {
  if (!source.tool || source.part || source.robot || !source.measured_part.empty()) return;
  const int of_a_mode =
      (known.frequency > 0.0 ? 1 : 0) + (known.damping_ratio > 0.0 ? 1 : 0) + (known.mass > 0.0 ? 1 : 0);
  const int parameters = static_cast<int>(source.tool->modes.size()) * of_a_mode;
  if (parameters <= learning::most_parameters) return;
  findings.report("calibration",
                  fmt::format("{} parameters of {} modes are uncertain, must be at most {}; set what is known in "
                              "[lobes.uncertainty] to 0, or give fewer modes",
                              parameters, source.tool->modes.size(), learning::most_parameters));
}

/// The calibration needs cuts to learn from, something to learn, and poles.
void check_calibration(const Case& source, Findings& findings) {
  check_wanted_speed(source, findings);
  if (source.observed.empty()) findings.report("calibration", "there are no cuts to learn from; add [[observed]]");
  const milling::Uncertainty known =
      source.lobes && source.lobes->robust ? source.lobes->robust->uncertainty : milling::Uncertainty{};
  const bool uncertain = known.frequency > 0.0 || known.damping_ratio > 0.0 || known.mass > 0.0 ||
                         known.coefficients > 0.0 || source.calibration->speed_exponent.value_or(0.0) > 0.0;
  if (!uncertain) {
    findings.report("calibration",
                    "nothing is uncertain beforehand; give [lobes.uncertainty], at least one of them above 0, or "
                    "calibration.speed_exponent");
  }
  check_parameters(source, known, findings);
  if (source.tool && setup::known_by_lines(*source.tool))
    findings.report("calibration", "needs poles, tool.measured has none; give tool.fit = true or tool.modes");
}

}  // namespace

void check_observed(const Case& source, Findings& findings) {
  if (source.calibration) check_calibration(source, findings);
  if (source.observed.empty()) return;
  if (!source.lobes) {
    findings.report("observed[0]", "there is no chart to hold it against; add [lobes]");
    return;
  }
  Seen seen;
  for (std::size_t i = 0; i < source.observed.size(); ++i) {
    const std::string entry = indexed("observed", i);
    const setup::ObservedCuts& cuts = source.observed[i];
    if (!check_entry(entry, cuts, findings) || has_unreadable(entry, cuts, findings)) continue;
    for (std::size_t c = 0; c < cuts.cuts.size(); ++c) {
      const CutFault fault = fault_of(*source.lobes, entry, cuts.cuts[c], seen);
      if (fault.text.empty()) continue;
      const bool of_file = !cuts.file.empty();
      findings.report(entry + (of_file ? ".file" : "." + fault.key),
                      of_file ? fmt::format("cut {}: {}", c + 1, fault.text) : fault.text);
      if (of_file) break;
    }
  }
}

}  // namespace thinwall::cases
