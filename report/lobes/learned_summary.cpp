#include "report/lobes/learned_summary.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "io/results/csv_table.hpp"
#include "report/lobes/observed_summary.hpp"

namespace thinwall::report {

namespace {

std::string name_of(milling::ParameterOf of) {
  switch (of) {
    case milling::ParameterOf::frequency:
      return "frequency";
    case milling::ParameterOf::damping_ratio:
      return "damping_ratio";
    case milling::ParameterOf::mass:
      return "mass";
    case milling::ParameterOf::K_t:
      return "K_t";
    case milling::ParameterOf::K_r:
      return "K_r";
    case milling::ParameterOf::K_a:
      return "K_a";
    case milling::ParameterOf::speed_exponent:
      return "speed_exponent";
  }
  return "";
}

LearnedParameterSummary parameter_summary(const learning::LearnedParameter& p, const milling::Cut& nominal) {
  LearnedParameterSummary result{.parameter = name_of(p.parameter.of),
                                 .mode_frequency_hz = {},
                                 .before = p.before,
                                 .after = p.after,
                                 .relative_deviation_before = p.parameter.spread,
                                 .relative_deviation_after = p.parameter.spread * p.deviation,
                                 .moved = p.mean,
                                 .laplace_moved = p.laplace_mean,
                                 .laplace_narrowed = p.laplace_deviation,
                                 .r_hat = p.r_hat,
                                 .effective_size = p.effective_size};
  if (p.parameter.mode >= 0)
    result.mode_frequency_hz = std::abs(nominal.structure.poles(p.parameter.mode)) / (2.0 * std::numbers::pi);
  return result;
}

milling::Score score_after(const std::vector<learning::LearnedCut>& cuts) {
  milling::Score score;
  for (const learning::LearnedCut& cut : cuts) milling::count(score, cut.cut.outcome, cut.chatter_probability > 0.5);
  return score;
}

std::string parameter_text(const LearnedParameterSummary& p) {
  if (p.parameter == "speed_exponent") {
    return fmt::format("      {:<26} {:>11.2f} to {:>11.2f}, moved {:+.2f} deviations; {:.2f} to {:.2f}\n", p.parameter,
                       p.before, p.after, p.moved, p.relative_deviation_before, p.relative_deviation_after);
  }
  const std::string of = p.mode_frequency_hz ? fmt::format(" at {:.1f} Hz", *p.mode_frequency_hz) : "";
  return fmt::format("      {:<26} {:>11.5g} to {:>11.5g}, moved {:+.2f} deviations; {:.1f} % to {:.1f} %\n",
                     p.parameter + of, p.before, p.after, p.moved, 100.0 * p.relative_deviation_before,
                     100.0 * p.relative_deviation_after);
}

}  // namespace

LearnedSummary learned_summary(const study::LearnedChart& learned) {
  const learning::Calibration& c = learned.calibration;
  LearnedSummary result;
  for (const learning::LearnedParameter& p : c.parameters)
    result.parameters.push_back(parameter_summary(p, c.model.nominal));
  result.noise = c.noise;
  result.converged = c.likeliest.converged;
  result.steps = c.likeliest.steps;
  result.draws = std::ssize(c.draws);
  result.accepted = c.chains.accepted;
  result.worst_r_hat = c.worst_r_hat;
  result.least_effective_size = c.least_effective_size;
  if (learned.before) result.before = share_summary(*learned.before);
  result.after = share_summary(score_after(c.cuts));
  if (learned.cross_validated) result.cross_validated = share_summary(*learned.cross_validated);
  for (const learning::LearnedCut& cut : c.cuts) {
    if (!cut.contradicts) continue;
    result.contradictions.push_back(
        {cut.cut.spindle_speed_rpm, cut.cut.depth_m, cut.cut.outcome, cut.chatter_probability});
  }
  if (const auto& next = learned.next) {
    result.next_cut = {learned.next_for_rpm,      next->point.spindle_speed_rpm, next->point.depth_m,
                       next->chatter_probability, next->deviation_before,        next->deviation_after};
  }
  if (const auto& cut = learned.productive)
    result.productive_cut = {cut->point.spindle_speed_rpm, cut->point.depth_m, cut->chatter_probability};
  for (const study::LearnedChart::Row& row : learned.rows)
    result.rows.push_back({row.spindle_speed_rpm, row.before_m, row.median_m, row.stable_90_m, row.stable_95_m});
  return result;
}

void write_learned(const std::filesystem::path& file, const LearnedSummary& learned) {
  std::vector<double> speed, before, median, stable_90, stable_95;
  for (const LearnedRowSummary& row : learned.rows) {
    speed.push_back(row.spindle_speed_rpm);
    before.push_back(row.before_m);
    median.push_back(row.median_m);
    stable_90.push_back(row.stable_90_m);
    stable_95.push_back(row.stable_95_m);
  }
  io::write_csv(file,
                {{"spindle_speed_rpm", speed},
                 {"before_m", before},
                 {"median_m", median},
                 {"stable_90_m", stable_90},
                 {"stable_95_m", stable_95}},
                {"before_m: limiting depth of the case as it stands. The others: depth that is stable with 50, 90 and "
                 "95 % of what the cuts left possible"});
}

std::string learned_text(const LearnedSummary& learned) {
  std::string text = fmt::format("    learned       before {}\n                  after  {}\n",
                                 share_text(learned.before), share_text(learned.after));
  if (learned.cross_validated)
    text += fmt::format("                  unseen {}\n", share_text(*learned.cross_validated));
  text += fmt::format("                  {} draws, R-hat up to {:.3f}, effective size {:.0f} at least, noise {:.2f}\n",
                      learned.draws, learned.worst_r_hat, learned.least_effective_size, learned.noise);
  for (const LearnedParameterSummary& p : learned.parameters) text += parameter_text(p);
  for (const ContradictionSummary& cut : learned.contradictions) {
    text += fmt::format("      contradicts the others: {:.0f} rpm, {:.3f} mm, {} (chatter {:.0f} %)\n",
                        cut.spindle_speed_rpm, cut.depth_m * 1e3, core::word_of(cut.observed),
                        100.0 * cut.chatter_probability);
  }
  if (const auto& next = learned.next_cut) {
    text += fmt::format(
        "      next cut: {:.0f} rpm, {:.3f} mm (chatter {:.0f} %), narrows the relative standard deviation of the {} "
        "from {:.1f} to {:.1f} %\n",
        next->spindle_speed_rpm, next->depth_m * 1e3, 100.0 * next->chatter_probability,
        next->for_rpm ? "limit" : "best speed", 100.0 * next->deviation_before, 100.0 * next->deviation_after);
  }
  if (const auto& cut = learned.productive_cut) {
    text += fmt::format("      removes most: {:.0f} rpm, {:.3f} mm (chatter {:.0f} %)\n", cut->spindle_speed_rpm,
                        cut->depth_m * 1e3, 100.0 * cut->chatter_probability);
  }
  return text;
}

}  // namespace thinwall::report
