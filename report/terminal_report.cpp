#include "report/terminal_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>
#include <vector>

#include "report/contact_report.hpp"
#include "report/lobes/lobes_answers.hpp"
#include "report/lobes/lobes_report.hpp"
#include "report/lobes/lobes_words.hpp"
#include "report/mesh_answer.hpp"
#include "report/page/limit_text.hpp"
#include "report/path_report.hpp"
#include "report/simulation/simulation_report.hpp"

namespace thinwall::report {

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// "1.72 mm", or "over 20.0 mm" where the chart ends.
std::string depth(const RowSummary& row) {
  const double mm = row.limiting_depth_m * 1e3;
  return row.at_depth_limit ? fmt::format("over {:.1f} mm", mm) : fmt::format("{:.2f} mm", mm);
}

std::string minimum(const LobesSummary& lobes) {
  const double mm = lobes.minimum_depth_m * 1e3;
  if (lobes.speeds_stable_to_depth_limit == lobes.speeds)
    return fmt::format("over {:.1f} mm at every speed of the chart", mm);
  return fmt::format("{:.2f} mm at {:.0f} rpm", mm, lobes.at_spindle_speed_rpm);
}

std::string best(const LobesSummary& lobes) {
  if (!lobes.best_pocket) return "none";
  const double mm = lobes.best_pocket->depth_m * 1e3;
  const std::string depth =
      lobes.best_pocket->at_depth_limit ? fmt::format("over {:.1f}", mm) : fmt::format("{:.2f}", mm);
  return fmt::format("{} mm at {:.0f} rpm{}", depth, lobes.best_pocket->spindle_speed_rpm,
                     lobes.best_pocket->at_chart_edge ? " (edge)" : "");
}

void answer(std::string& out, const Summary& summary) {
  if (const std::string text = tolerance_not_met(summary); !text.empty()) out += "  " + text + '\n';
  for (const LobesSummary& lobes : summary.lobes) {
    if (!lobes.at_case_speed) continue;
    const CaseSpeedSummary& row = *lobes.at_case_speed;
    out += fmt::format("  {:<15} stable up to {} at {:.0f} rpm{}", chart_title(lobes.name), depth(row),
                       row.spindle_speed_rpm, range_text(row.error_budget));
    if (!row.at_depth_limit)
      out +=
          fmt::format(", chatter at {:.1f} Hz ({})", row.chatter_frequency_hz.value_or(not_a_number), row.bifurcation);
    out += '\n';
    if (row.contact && row.contact->lost_above_m)
      out += fmt::format("    if the contact holds; it is lost above {:.3g} mm ({:.4g} N of preload)\n",
                         *row.contact->lost_above_m * 1e3, row.contact->preload_n);
    out += sensitivities_text(row.sensitivities);
  }
  if (summary.coupling) {
    for (const AmplitudeReductionSummary& r : summary.coupling->reductions) {
      out += fmt::format("  vibration at {} falls by {:.2f} % at {:.1f} Hz ({:.3g} to {:.3g} um/N)\n", r.dof,
                         r.reduction * 100.0, r.frequency_hz, r.alone_m_per_n * 1e6, r.supported_m_per_n * 1e6);
    }
  }
  if (!out.empty()) out += '\n';
}

/// ": translation along x, rotation about y", the ways in which the part moves rigidly.
std::string free_motions(const PartSummary& part) {
  std::string words;
  for (const std::string& motion : part.free_motions.value_or(std::vector<std::string>()))
    words += (words.empty() ? ": " : ", ") + motion;
  return words;
}

/// Frequencies and damping ratios of the first elastic modes in two lines.
void modes(std::string& out, const std::string& title, const std::vector<ModeSummary>& elastic) {
  constexpr std::size_t most = 6;
  if (elastic.empty()) return;
  const std::size_t shown = std::min(most, elastic.size());
  std::string frequencies;
  std::string ratios;
  bool damped = false;
  for (std::size_t k = 0; k < shown; ++k) {
    const double ratio = elastic[k].damping_ratio.value_or(0.0);
    frequencies += fmt::format(" {:>8.2f}", elastic[k].frequency_hz);
    ratios += fmt::format("{:>9.2f}", ratio * 100.0);
    damped = damped || ratio > 0.0;
  }
  out += fmt::format("  {:<22}{}  Hz{}\n", title, frequencies, elastic.size() > shown ? " …" : "");
  if (damped) out += fmt::format("  {:<22}{}  %\n", "  damping", ratios);
}

/// The modes of the part; rigid-body modes are counted and named.
void part_modes(std::string& out, const PartSummary& part) {
  std::vector<ModeSummary> elastic;
  for (const PartModeSummary& mode : part.modes) {
    if (!mode.rigid_body) elastic.push_back({mode.frequency_hz, mode.damping_ratio});
  }
  if (elastic.size() < part.modes.size())
    out += fmt::format("  {:<22}{:>9}{}\n", "rigid-body modes", part.modes.size() - elastic.size(), free_motions(part));
  modes(out, "modes of the part", elastic);
}

void coupled_modes(std::string& out, const CouplingSummary& coupling) {
  std::vector<ModeSummary> list = coupling.modes;
  if (list.empty()) {
    for (const MainModeSummary& mode : coupling.main_modes)
      list.push_back({mode.frequency_hz, mode.damping_ratio.value_or(std::nullopt)});
  }
  modes(out, "part with robot", list);
}

/// "0.35 %", "below 0.01 %" or "unknown".
std::string error_in_percent(const std::optional<double>& error) {
  if (!error) return "unknown";
  return *error < 5e-5 ? "below 0.01 %" : fmt::format("{:.2f} %", *error * 100.0);
}

void charts(std::string& out, const Summary& summary) {
  if (summary.lobes.empty()) return;
  out += "\n  stability chart        least depth anywhere                   best pocket               error est.\n";
  for (const LobesSummary& lobes : summary.lobes) {
    const auto& error = lobes.error_estimate_relative;
    out += fmt::format("  {:<22} {:<38} {:<25} {}\n", chart_title(lobes.name), minimum(lobes), best(lobes),
                       error_in_percent(error));
    if (const auto& pocket = lobes.best_pocket)
      out += fmt::format("    {}: nine tenths of its depth at {}, limited by {}\n", best_pocket_title(lobes),
                         width_text(*pocket), in_words(pocket->limited_by));
    out += asked_text(lobes);
  }
}

void updating(std::string& out, const Summary& summary) {
  for (const UpdatingSummary& fit : summary.updating) {
    out += fmt::format("  fitted: {}\n", fit.name);
    for (const FittedParameterSummary& p : fit.parameters) {
      out += fmt::format("    {:<28} {:>12.6g} {:<6} (from {:.6g}; bounds {:.6g} to {:.6g}{})\n", p.key, p.fitted,
                         p.unit, p.start, p.lower, p.upper, p.at_bound ? "; at a bound" : "");
    }
    for (const FitTargetSummary& t : fit.targets) {
      out += fmt::format("    {:<28} {:>12.6g} {:<6} (wanted {:.6g})\n", t.quantity, t.reached,
                         t.quantity.ends_with("_frequency") ? "Hz" : "", t.wanted);
    }
    if (!fit.converged) out += "    did not converge\n";
  }
}

/// The difference of both routes. Where a kernel was regularised they differ by what that changed, and are not called
/// agreeing.
void routes(std::string& out, const CouplingSummary& coupling) {
  const auto& regularised = coupling.regularisation;
  const bool changed = regularised && (regularised->lines_with_dropped > 0 || regularised->method == "tikhonov");
  if (const auto& difference = coupling.route_difference) {
    out += fmt::format("  routes      spatial and receptance coupling {} {:.1e} (largest at {:.1f} Hz, entry {})\n",
                       changed ? "differ by" : "agree to", difference->max_relative, difference->at_frequency_hz,
                       difference->entry);
  } else {
    out += coupling.no_spatial_route ? "  routes      receptance only: the matrices cannot be joined so\n"
                                     : "  routes      receptance only: neither component has matrices\n";
  }
  if (!regularised) return;
  out +=
      fmt::format("  kernel      {}: {} of {} lines with dropped values, up to {}; gaps up to {:.2g} of an opening\n",
                  regularised->method, regularised->lines_with_dropped, regularised->lines, regularised->most_dropped,
                  regularised->compatibility_residual_max.value_or(not_a_number));
}

void mesh(std::string& out, const MeshSummary& mesh) {
  out += fmt::format("  mesh        {} tetrahedra of order {}, {} degrees of freedom, lowest quality {:.2f}\n",
                     mesh.elements, mesh.order, mesh.dofs, mesh.min_quality);
  if (const auto& estimate = mesh.error_estimate)
    out += fmt::format("    by estimate frequencies within {:.1e}{}; {}{}\n", estimate->max_relative_frequency_error,
                       estimate->max_relative_receptance_error > 0.0
                           ? fmt::format(", receptances within {:.1e} of the largest ({} within {:.1e} of itself)",
                                         estimate->max_relative_receptance_error, estimate->worst_receptance,
                                         estimate->max_relative_entry_error)
                           : "",  // no points
                       estimate->tolerance ? fmt::format("asked for {:g}", *estimate->tolerance)
                                           : "the mesh was given, one order more was tried",
                       estimate->met ? "" : ", NOT MET: see run.log");
}

void reduction(std::string& out, const ReductionSummary& r) {
  out += fmt::format("  reduction   {} to {} degrees of freedom, frequencies within {:.1e}", r.full_dofs, r.size,
                     r.max_relative_frequency_error);
  if (const auto& error = r.max_relative_receptance_error) out += fmt::format(", receptances within {:.1e}", *error);
  out += r.max_relative_receptance_error ? " of the full model\n" : " of the full model; receptances not checked\n";
}

/// The distance of the simulation from lobes and closed form, each at the point where it is farthest.
void consistency(std::string& out, const SimulationSummary& simulation) {
  const auto tell = [&out](const char* what, const std::optional<LargestDifferenceSummary>& largest) {
    if (!largest) return;
    out += fmt::format("  simulation  {} {:.1e} (largest at {:.0f} rpm, {:.3f} mm, {})\n", what, largest->max_relative,
                       largest->spindle_speed_rpm, largest->depth_m * 1e3, chart_title(largest->chart));
  };
  tell("growth and lobes agree to", simulation.growth_difference);
  tell("periodic motion and closed form agree to", simulation.forced_difference);
}

void trust(std::string& out, const Summary& summary) {
  if (const auto& geometry = summary.geometry)
    out += fmt::format("  part        {}: {}\n", geometry->file, geometry->read);
  if (summary.mesh) mesh(out, *summary.mesh);
  if (summary.reduction) reduction(out, *summary.reduction);
  if (summary.coupling) routes(out, *summary.coupling);
  if (summary.simulation) consistency(out, *summary.simulation);
}

void checks(std::string& out, const Summary& summary) {
  if (summary.checks.empty()) return;
  out += "\n  expected                                             found      wanted\n";
  for (const CheckSummary& c : summary.checks) {
    std::string wanted = c.expected ? fmt::format("{:.6g}", *c.expected) : "";
    if (c.tolerance) wanted += fmt::format(" ± {:.3g}", *c.tolerance);
    if (c.at_least) wanted += fmt::format(" ≥ {:.6g}", *c.at_least);
    if (c.at_most) wanted += fmt::format(" ≤ {:.6g}", *c.at_most);
    out += fmt::format("  {} {:<46} {:>11}  {}\n", c.ok ? "ok  " : "MISS", c.name,
                       c.value ? fmt::format("{:.6g}", *c.value) : "absent", wanted);
  }
}

}  // namespace

std::string terminal_report(const Summary& summary, const std::string& result_folder) {
  std::string out;
  answer(out, summary);
  out.insert(0, "\n" + (summary.title.empty() ? summary.case_name : summary.title) + "\n\n");
  if (summary.part) part_modes(out, *summary.part);
  if (summary.robot) modes(out, "modes of the robot", summary.robot->modes);
  if (summary.coupling) coupled_modes(out, *summary.coupling);
  charts(out, summary);
  out += '\n';
  if (const std::string path = path_text(summary); !path.empty()) out += path + '\n';
  if (const std::string points = operating_points_text(summary); !points.empty()) out += points + '\n';
  if (const std::string points = simulation_text(summary); !points.empty()) out += points + '\n';
  updating(out, summary);
  out += contacts_text(summary);
  trust(out, summary);
  checks(out, summary);
  out += fmt::format("\n  {:.1f} s; results in {}\n", total_seconds(summary), result_folder);
  return out;
}

}  // namespace thinwall::report
