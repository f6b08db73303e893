#include "report/validation/validation_page.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "report/lobes/observed_summary.hpp"

namespace thinwall::report {

namespace {

constexpr auto opening =
    "# Held against experiments\n\n"
    "Cutting tests of the literature, and what the program predicts for them from parameters as they were published. "
    "No\n"
    "parameter was moved to fit the cuts; what a publication does not say is listed as assumed or missing. This page "
    "is\n"
    "written by `thinwall validate`; each cut is in `lobes/*_observed.csv` of its case's results and on the chart of "
    "its\n"
    "report.\n\n"
    "Right means that a cut which was stable was predicted stable, or one that chattered to chatter; marginal cuts, "
    "and "
    "those\n"
    "whose prediction did not converge, do not count. Intervals are those of Wilson (1927) with 95 %. *Zeroth order* "
    "is the "
    "textbook's method (Altintas & Budak\n"
    "1995). *Certain* are cuts of which hardly any of 200 draws of the parameters, within their uncertainty, say the "
    "opposite:\n"
    "at most the share that the case's `lobes.uncertainty.confidence` leaves, 2.3 % at its usual two standard "
    "deviations.\n\n";

std::string percent_text(const ShareSummary& share) {
  return fmt::format("{} of {}, {:.0f} % ({:.0f} to {:.0f} %)", share.right, share.of, 100.0 * share.share,
                     100.0 * share.low, 100.0 * share.high);
}

/// The paragraph of a text that begins with a word in bold; empty if there is none.
std::string paragraph(const std::string& text, const std::string& word) {
  const std::size_t begin = text.find("**" + word + ".**");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find("\n\n", begin) - begin) + "\n\n";
}

milling::Score& operator+=(milling::Score& sum, const ShareSummary& share) {
  sum.right += share.right;
  sum.of += share.of;
  return sum;
}

/// The sums over all cases.
struct Totals {
  milling::Score prediction, textbook;
  CertaintySummary certain;
};

void add(const ObservedSummary& observed, Totals& totals) {
  totals.prediction += observed.prediction;
  if (observed.textbook) totals.textbook += *observed.textbook;
  if (!observed.certainty) return;
  const CertaintySummary& c = *observed.certainty;
  totals.certain.certainly_stable += c.certainly_stable;
  totals.certain.certainly_stable_that_chattered += c.certainly_stable_that_chattered;
  totals.certain.open += c.open;
  totals.certain.certainly_unstable += c.certainly_unstable;
  totals.certain.certainly_unstable_that_were_stable += c.certainly_unstable_that_were_stable;
}

std::string certain_cells(const CertaintySummary& c) {
  return fmt::format("{} ({}) | {} ({}) | {}", c.certainly_stable, c.certainly_stable_that_chattered,
                     c.certainly_unstable, c.certainly_unstable_that_were_stable, c.open);
}

std::string totals_row(const std::string& name, const ShareSummary& prediction,
                       const std::optional<ShareSummary>& textbook, const std::optional<CertaintySummary>& certain) {
  return fmt::format("| {} | {} | {} | {} |\n", name, percent_text(prediction),
                     textbook ? percent_text(*textbook) : "cannot take the cut",
                     certain ? certain_cells(*certain) : "– | – | –");
}

std::string table_of_all(const std::vector<ValidatedCase>& cases) {
  std::string text =
      "| case | the chart is right | zeroth order | certainly stable (of which chattered) | certainly chatters (of "
      "which "
      "were stable) | open |\n|---|---|---|---|---|---|\n";
  Totals totals;
  for (const ValidatedCase& one : cases) {
    const ObservedSummary* observed = observed_of(one);
    if (observed == nullptr) continue;
    add(*observed, totals);
    text += totals_row(fmt::format("[{}](../cases/{}/README.md)", one.name, one.name), observed->prediction,
                       observed->textbook, observed->certainty);
  }
  return text + totals_row("all", share_summary(totals.prediction), share_summary(totals.textbook), totals.certain) +
         "\n";
}

std::string wrong_row(const ObservedCutSummary& cut) {
  return fmt::format("| {:.0f} | {:.2f} | {} | {} | {:+.2f} mm | {} | {} |\n", cut.spindle_speed_rpm, cut.depth_m * 1e3,
                     core::word_of(cut.observed), cut.predicted_stable ? "stable" : "chatter", cut.depth_margin_m * 1e3,
                     cut.speed_margin_rpm ? fmt::format("{:.0f} rpm", *cut.speed_margin_rpm) : "none in the chart",
                     !cut.certainty                             ? "–"
                     : *cut.certainty == study::Certainty::open ? "open"
                                                                : "certain");
}

std::string wrong_table(const ObservedSummary& observed) {
  std::string rows;
  for (const ObservedCutSummary& cut : observed.cuts)
    if (cut.right && !*cut.right) rows += wrong_row(cut);
  if (rows.empty()) return "";
  return "| speed, rpm | depth, mm | seen | predicted | boundary in depth | in speed | by the uncertainty "
         "|\n|---|---|---|---|---|---|---|\n" +
         rows + "\n";
}

/// A paragraph on marginal cuts and heard frequencies; "" if there are none.
std::string remarks(const ObservedSummary& observed) {
  std::string text;
  if (observed.marginal == 1) text = "One cut was marginal.";
  if (observed.marginal > 1) text = fmt::format("{} cuts were marginal.", observed.marginal);
  if (const auto& difference = observed.median_frequency_difference_relative) {
    text +=
        fmt::format("{}{} chatter frequencies were heard; the median difference from the predicted one is {:.1f} %.",
                    text.empty() ? "" : " ", observed.frequencies_heard, 100.0 * *difference);
  }
  return text.empty() ? "" : text + "\n\n";
}

std::string section_of(const ValidatedCase& one) {
  const ObservedSummary* observed = observed_of(one);
  if (observed == nullptr) return "";
  std::string text = fmt::format("## {}\n\n![Chart with the cuts](pictures/{})\n\n",
                                 one.summary.title.empty() ? one.name : one.summary.title, chart_name(one));
  for (const char* word : {"Published", "Assumed", "Missing"}) text += paragraph(one.readme, word);
  text += fmt::format(
      "| | predicted stable | predicted to chatter |\n|---|---|---|\n| was stable | {} | {} |\n| chattered | {} | {} "
      "|\n\n",
      observed->stable_right, observed->stable_wrong, observed->chatter_wrong, observed->chatter_right);
  return text + remarks(*observed) + wrong_table(*observed);
}

}  // namespace

const ObservedSummary* observed_of(const ValidatedCase& one) {
  if (one.summary.lobes.empty() || !one.summary.lobes.back().observed) return nullptr;
  return &*one.summary.lobes.back().observed;
}

std::string chart_name(const ValidatedCase& one) {
  return "validation-" + one.name + ".svg";
}

std::string validation_page(const std::vector<ValidatedCase>& cases) {
  std::string text = opening + table_of_all(cases);
  for (const ValidatedCase& one : cases) text += section_of(one);
  while (text.ends_with("\n\n")) text.pop_back();
  return text;
}

}  // namespace thinwall::report
