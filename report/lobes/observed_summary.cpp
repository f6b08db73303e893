#include "report/lobes/observed_summary.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/median.hpp"
#include "io/results/csv_table.hpp"
#include "report/finite_number.hpp"
#include "study/lobes/observed_cuts.hpp"

namespace thinwall::report {

namespace {

using milling::CutOutcome;

std::optional<double> nearest_speed(const milling::OperatingPoint& point, const milling::SpeedMargin& margin) {
  std::optional<double> nearest;
  for (const std::optional<double>& boundary : {margin.below_rpm, margin.above_rpm}) {
    if (!boundary) continue;
    const double distance = std::abs(*boundary - point.spindle_speed_rpm);
    nearest = nearest ? std::min(*nearest, distance) : distance;
  }
  return nearest;
}

ObservedCutSummary cut_summary(const study::JudgedCut& cut) {
  const study::PointStability& predicted = cut.predicted;
  ObservedCutSummary result{.spindle_speed_rpm = cut.observed.spindle_speed_rpm,
                            .depth_m = cut.observed.depth_m,
                            .observed = cut.observed.outcome,
                            .predicted_stable = predicted.stable,
                            .right = study::is_right(cut),
                            .depth_margin_m = predicted.depth.margin_m,
                            .depth_margin_relative = predicted.depth.margin_m / cut.observed.depth_m,
                            .depth_margin_at_limit = predicted.depth.at_limit,
                            .speed_margin_rpm = nearest_speed(predicted.point, predicted.speed),
                            .multiplier_modulus = {},
                            .chatter_probability = cut.chatter_probability,
                            .certainty = cut.certainty,
                            .textbook_stable = cut.textbook_stable,
                            .heard_frequency_hz = cut.observed.chatter_frequency_hz,
                            .predicted_frequency_hz = {},
                            .status = milling::name(predicted.status)};
  if (!predicted.multiplier) return result;
  result.multiplier_modulus = predicted.multiplier->modulus;
  result.predicted_frequency_hz = finite(predicted.multiplier->chatter_frequency_hz);
  return result;
}

void count(const ObservedCutSummary& cut, ObservedSummary& summary) {
  if (cut.observed == CutOutcome::marginal) ++summary.marginal;
  else if (!cut.right) summary.doubtful = summary.doubtful.value_or(0) + 1;
  else if (cut.observed == CutOutcome::stable) ++(*cut.right ? summary.stable_right : summary.stable_wrong);
  else ++(*cut.right ? summary.chatter_right : summary.chatter_wrong);
}

void count_certainty(const ObservedCutSummary& cut, CertaintySummary& summary) {
  const bool chattered = cut.observed == CutOutcome::chatter;
  switch (*cut.certainty) {
    case study::Certainty::certainly_stable:
      ++summary.certainly_stable;
      summary.certainly_stable_that_chattered += chattered ? 1 : 0;
      break;
    case study::Certainty::open:
      ++summary.open;
      break;
    case study::Certainty::certainly_unstable:
      ++summary.certainly_unstable;
      summary.certainly_unstable_that_were_stable += chattered ? 0 : 1;
      break;
  }
}

void add_frequencies(ObservedSummary& summary) {
  std::vector<double> differences;
  for (const ObservedCutSummary& cut : summary.cuts) {
    if (!cut.heard_frequency_hz || !cut.predicted_frequency_hz) continue;
    differences.push_back(std::abs(*cut.predicted_frequency_hz / *cut.heard_frequency_hz - 1.0));
  }
  summary.frequencies_heard = static_cast<int>(differences.size());
  if (!differences.empty()) summary.median_frequency_difference_relative = core::median(std::move(differences));
}

std::string wrong_text(const ObservedCutSummary& cut) {
  std::string text = fmt::format("      {:.0f} rpm, {:.3f} mm: {}, predicted {}; boundary {:+.3f} mm",
                                 cut.spindle_speed_rpm, cut.depth_m * 1e3, core::word_of(cut.observed),
                                 cut.predicted_stable ? "stable" : "chatter", cut.depth_margin_m * 1e3);
  if (cut.speed_margin_rpm) text += fmt::format(" or {:.0f} rpm away", *cut.speed_margin_rpm);
  if (cut.certainty) text += cut.certainty == study::Certainty::open ? ", open" : ", though certain";
  return text + "\n";
}

}  // namespace

ShareSummary share_summary(const milling::Score& score) {
  const milling::ShareInterval interval = milling::wilson_interval(score);
  return {score.right, score.of, score.of > 0 ? milling::share(score) : 0.0, interval.low, interval.high};
}

ObservedSummary observed_summary(const std::vector<study::JudgedCut>& cuts) {
  ObservedSummary summary;
  milling::Score prediction, textbook;
  bool with_textbook = false;
  for (const study::JudgedCut& judged : cuts) {
    const ObservedCutSummary& cut = summary.cuts.emplace_back(cut_summary(judged));
    count(cut, summary);
    with_textbook = with_textbook || cut.textbook_stable;
    if (!cut.right) continue;
    milling::count(prediction, cut.observed, !cut.predicted_stable);
    if (cut.textbook_stable) milling::count(textbook, cut.observed, !*cut.textbook_stable);
    if (!cut.certainty) continue;
    if (!summary.certainty) summary.certainty.emplace();
    count_certainty(cut, *summary.certainty);
  }
  summary.prediction = share_summary(prediction);
  if (with_textbook) summary.textbook = share_summary(textbook);
  add_frequencies(summary);
  return summary;
}

void write_observed(const std::filesystem::path& file, const ObservedSummary& observed) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> speed, depth, margin, speed_margin, modulus, probability, heard, predicted_hz;
  std::vector<std::string> outcome, predicted, right;
  for (const ObservedCutSummary& cut : observed.cuts) {
    speed.push_back(cut.spindle_speed_rpm);
    depth.push_back(cut.depth_m);
    outcome.push_back(core::word_of(cut.observed));
    predicted.emplace_back(cut.predicted_stable ? "stable" : "chatter");
    right.emplace_back(!cut.right ? "not_counted" : *cut.right ? "right" : "wrong");
    margin.push_back(cut.depth_margin_m);
    speed_margin.push_back(cut.speed_margin_rpm.value_or(none));
    modulus.push_back(cut.multiplier_modulus.value_or(none));
    probability.push_back(cut.chatter_probability.value_or(none));
    heard.push_back(cut.heard_frequency_hz.value_or(none));
    predicted_hz.push_back(cut.predicted_frequency_hz.value_or(none));
  }
  io::write_csv(
      file,
      {{"spindle_speed_rpm", speed},
       {"depth_m", depth},
       {"observed", outcome},
       {"predicted", predicted},
       {"verdict", right},
       {"depth_margin_m", margin},
       {"speed_margin_rpm", speed_margin, true},
       {"multiplier_modulus", modulus, true},
       {"chatter_probability", probability, true},
       {"heard_frequency_hz", heard, true},
       {"predicted_frequency_hz", predicted_hz, true}},
      {"depth_margin_m: to the boundary in depth, negative where the cut is too deep; to the depth limit where "
       "there is none. chatter_probability: by draws of lobes.uncertainty"});
}

std::string share_text(const ShareSummary& share) {
  if (share.of == 0) return "none to count";
  return fmt::format("{} of {} right ({:.0f} %, 95 % interval {:.0f} to {:.0f} %)", share.right, share.of,
                     100.0 * share.share, 100.0 * share.low, 100.0 * share.high);
}

std::string observed_text(const ObservedSummary& observed) {
  std::string text = fmt::format("    cuts made     {}", share_text(observed.prediction));
  if (observed.marginal > 0) text += fmt::format("; {} marginal", observed.marginal);
  if (observed.doubtful) text += fmt::format("; {} doubtful: the prediction did not converge", *observed.doubtful);
  text += "\n";
  if (observed.textbook) text += fmt::format("    zeroth order  {}\n", share_text(*observed.textbook));
  if (const auto& c = observed.certainty) {
    text += fmt::format(
        "    certain       stable {}, of which {} chattered; chatter {}, of which {} were stable; {} open\n",
        c->certainly_stable, c->certainly_stable_that_chattered, c->certainly_unstable,
        c->certainly_unstable_that_were_stable, c->open);
  }
  if (const auto& difference = observed.median_frequency_difference_relative)
    text += fmt::format("    heard         {} frequencies, median difference {:.1f} %\n", observed.frequencies_heard,
                        100.0 * *difference);
  if (observed.prediction.right < observed.prediction.of) text += "    wrong\n";
  for (const ObservedCutSummary& cut : observed.cuts)
    if (cut.right && !*cut.right) text += wrong_text(cut);
  return text;
}

}  // namespace thinwall::report
