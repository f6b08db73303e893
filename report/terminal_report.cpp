#include "report/terminal_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <vector>

#include "report/contact_report.hpp"
#include "report/lobes_answers.hpp"
#include "report/lobes_report.hpp"
#include "report/lobes_words.hpp"
#include "report/path_report.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

/// "1.72 mm", or "over 20.0 mm" where the chart ends.
std::string depth(const json& row) {
  const double mm = row["limiting_depth_m"].get<double>() * 1e3;
  return row["at_depth_limit"].get<bool>() ? fmt::format("over {:.1f} mm", mm) : fmt::format("{:.2f} mm", mm);
}

std::string minimum(const json& lobes) {
  const double mm = lobes["minimum_depth_m"].get<double>() * 1e3;
  if (lobes["speeds_stable_to_depth_limit"] == lobes["speeds"])
    return fmt::format("over {:.1f} mm at every speed of the chart", mm);
  return fmt::format("{:.2f} mm at {:.0f} rpm", mm, lobes["at_spindle_speed_rpm"].get<double>());
}

void answer(std::string& out, const json& summary) {
  for (const json& lobes : summary["lobes"]) {
    if (!lobes.contains("at_case_speed")) continue;
    const json& row = lobes["at_case_speed"];
    out += fmt::format("  {:<15} stable up to {} at {:.0f} rpm", chart_title(lobes["name"]), depth(row),
                       row["spindle_speed_rpm"].get<double>());
    if (!row["at_depth_limit"].get<bool>())
      out += fmt::format(", chatter at {:.1f} Hz ({})", row["chatter_frequency_hz"].get<double>(),
                         row["bifurcation"].get<std::string>());
    out += '\n' + sensitivities_text(row["sensitivities"]);
  }
  if (summary.contains("coupling")) {
    for (const json& r : summary["coupling"]["reductions"]) {
      out += fmt::format("  vibration at {} falls by {:.2f} % at {:.1f} Hz ({:.3g} to {:.3g} um/N)\n",
                         r["dof"].get<std::string>(), r["reduction"].get<double>() * 100.0,
                         r["frequency_hz"].get<double>(), r["alone_m_per_n"].get<double>() * 1e6,
                         r["supported_m_per_n"].get<double>() * 1e6);
    }
  }
  if (!out.empty()) out += '\n';
}

/// ": translation along x, rotation about y", the ways in which the part moves rigidly.
std::string free_motions(const json& part) {
  std::string words;
  for (const json& motion : part.value("free_motions", json::array()))
    words += (words.empty() ? ": " : ", ") + motion.get<std::string>();
  return words;
}

/// Frequencies and damping ratios in two lines; rigid-body modes are counted, with `words` of them.
void modes(std::string& out, const std::string& title, const json& list, std::size_t most,
           const std::string& words = "") {
  std::vector<const json*> elastic;
  for (const json& mode : list) {
    if (!mode.contains("rigid_body")) elastic.push_back(&mode);
  }
  if (elastic.size() < list.size())
    out += fmt::format("  {:<22}{:>9}{}\n", "rigid-body modes", list.size() - elastic.size(), words);
  if (elastic.empty()) return;
  const std::size_t shown = std::min(most, elastic.size());
  std::string frequencies;
  std::string ratios;
  bool damped = false;
  for (std::size_t k = 0; k < shown; ++k) {
    const json& given = (*elastic[k])["damping_ratio"];
    const double ratio = given.is_null() ? 0.0 : given.get<double>();
    frequencies += fmt::format(" {:>8.2f}", (*elastic[k])["frequency_hz"].get<double>());
    ratios += fmt::format("{:>9.2f}", ratio * 100.0);
    damped = damped || ratio > 0.0;
  }
  out += fmt::format("  {:<22}{}  Hz{}\n", title, frequencies, elastic.size() > shown ? " …" : "");
  if (damped) out += fmt::format("  {:<22}{}  %\n", "  damping", ratios);
}

void charts(std::string& out, const json& summary) {
  if (summary["lobes"].empty()) return;
  out += "\n  stability chart        least depth anywhere                   deepest pocket            error est.\n";
  for (const json& lobes : summary["lobes"]) {
    const json& best = lobes["maximum"];
    const json& error = lobes["error_estimate_relative"];
    const std::string estimate = error.is_null() ? "unknown" : fmt::format("{:.2f} %", error.get<double>() * 100.0);
    out += fmt::format("  {:<22} {:<38} {:<25} {}\n", chart_title(lobes["name"]), minimum(lobes),
                       fmt::format("{} at {:.0f} rpm", depth(best), best["spindle_speed_rpm"].get<double>()), estimate);
    out += asked_text(lobes);
  }
}

void updating(std::string& out, const json& summary) {
  for (const json& fit : summary["updating"]) {
    out += fmt::format("  fitted: {}\n", fit["name"].get<std::string>());
    for (const json& p : fit["parameters"]) {
      const std::string key = p["key"];
      out += fmt::format("    {:<28} {:>12.6g} {:<6} (from {:.6g}; bounds {:.6g} to {:.6g}{})\n", key,
                         p["fitted"].get<double>(), p.value("unit", std::string()), p["start"].get<double>(),
                         p["lower"].get<double>(), p["upper"].get<double>(),
                         p["at_bound"].get<bool>() ? "; at a bound" : "");
    }
    for (const json& t : fit["targets"]) {
      const std::string quantity = t["quantity"];
      out += fmt::format("    {:<28} {:>12.6g} {:<6} (wanted {:.6g})\n", quantity, t["reached"].get<double>(),
                         quantity.ends_with("_frequency") ? "Hz" : "", t["wanted"].get<double>());
    }
    if (!fit["converged"].get<bool>()) out += "    did not converge\n";
  }
}

/// The difference of both routes. Where a kernel was regularised they differ by what that changed, and are not called
/// agreeing.
void routes(std::string& out, const json& coupling) {
  const json& difference = coupling["route_difference"];
  const json& regularised = coupling["regularisation"];
  const bool changed = !regularised.is_null() &&
                       (regularised["lines_with_dropped"].get<int>() > 0 || regularised["method"] == "tikhonov");
  if (difference.is_null()) {
    out += coupling.contains("no_spatial_route") ? "  routes      receptance only: the matrices cannot be joined so\n"
                                                 : "  routes      receptance only: neither component has matrices\n";
  } else {
    out += fmt::format("  routes      spatial and receptance coupling {} {:.1e} (largest at {:.1f} Hz, entry {})\n",
                       changed ? "differ by" : "agree to", difference["max_relative"].get<double>(),
                       difference["at_frequency_hz"].get<double>(), difference["entry"].get<std::string>());
  }
  if (regularised.is_null()) return;
  out +=
      fmt::format("  kernel      {}: {} of {} lines with dropped values, up to {}; gaps up to {:.2g} of an opening\n",
                  regularised["method"].get<std::string>(), regularised["lines_with_dropped"].get<int>(),
                  regularised["lines"].get<int>(), regularised["most_dropped"].get<int>(),
                  regularised["compatibility_residual_max"].get<double>());
}

void trust(std::string& out, const json& summary) {
  if (summary.contains("geometry")) {
    const json& geometry = summary["geometry"];
    out +=
        fmt::format("  part        {}: {}\n", geometry["file"].get<std::string>(), geometry["read"].get<std::string>());
  }
  if (summary.contains("mesh")) {
    out += fmt::format("  mesh        {} tetrahedra of order {}, {} degrees of freedom, lowest quality {:.2f}\n",
                       summary["mesh"]["elements"].get<int>(), summary["mesh"]["order"].get<int>(),
                       summary["mesh"]["dofs"].get<int>(), summary["mesh"]["min_quality"].get<double>());
    if (const json& estimate = summary["mesh"]["error_estimate"]; estimate.is_object())
      out += fmt::format("    by estimate frequencies within {:.1e}, receptances within {:.1e}; asked for {:g}{}\n",
                         estimate["max_relative_frequency_error"].get<double>(),
                         estimate["max_relative_receptance_error"].get<double>(), estimate["tolerance"].get<double>(),
                         estimate["met"].get<bool>() ? "" : ", NOT MET: see run.log");
  }
  if (summary.contains("reduction")) {
    const json& r = summary["reduction"];
    out +=
        fmt::format("  reduction   {} to {} degrees of freedom, frequencies within {:.1e}", r["full_dofs"].get<int>(),
                    r["size"].get<int>(), r["max_relative_frequency_error"].get<double>());
    if (!r["max_relative_receptance_error"].is_null())
      out += fmt::format(", receptances within {:.1e}", r["max_relative_receptance_error"].get<double>());
    out += r["max_relative_receptance_error"].is_null() ? " of the full model; receptances not checked\n"
                                                        : " of the full model\n";
  }
  if (summary.contains("coupling")) routes(out, summary["coupling"]);
}

void checks(std::string& out, const json& summary) {
  if (summary["checks"].empty()) return;
  out += "\n  expected                                             found      wanted\n";
  for (const json& c : summary["checks"]) {
    std::string wanted = c["expected"].is_null() ? "" : fmt::format("{:.6g}", c["expected"].get<double>());
    if (c.contains("tolerance")) wanted += fmt::format(" ± {:.3g}", c["tolerance"].get<double>());
    if (c.contains("at_least")) wanted += fmt::format(" ≥ {:.6g}", c["at_least"].get<double>());
    if (c.contains("at_most")) wanted += fmt::format(" ≤ {:.6g}", c["at_most"].get<double>());
    out += fmt::format("  {} {:<46} {:>11}  {}\n", c["ok"].get<bool>() ? "ok  " : "MISS", c["name"].get<std::string>(),
                       c["value"].is_null() ? "absent" : fmt::format("{:.6g}", c["value"].get<double>()), wanted);
  }
}

}  // namespace

std::string terminal_report(const json& summary, const std::string& result_folder) {
  std::string out;
  answer(out, summary);
  const std::string title = summary["title"].get<std::string>();
  out.insert(0, "\n" + (title.empty() ? summary["case"].get<std::string>() : title) + "\n\n");
  if (summary.contains("part"))
    modes(out, "modes of the part", summary["part"]["modes"], 6, free_motions(summary["part"]));
  if (summary.contains("robot")) modes(out, "modes of the robot", summary["robot"]["modes"], 6);
  if (summary.contains("coupling")) {
    const json& coupling = summary["coupling"];
    modes(out, "part with robot", coupling["modes"].empty() ? coupling["main_modes"] : coupling["modes"], 6);
  }
  charts(out, summary);
  out += '\n';
  if (const std::string path = path_text(summary); !path.empty()) out += path + '\n';
  if (const std::string points = operating_points_text(summary); !points.empty()) out += points + '\n';
  updating(out, summary);
  out += contacts_text(summary);
  trust(out, summary);
  checks(out, summary);
  out += fmt::format("\n  {:.1f} s; results in {}\n", summary["timings_s"].value("total", 0.0), result_folder);
  return out;
}

}  // namespace thinwall::report
