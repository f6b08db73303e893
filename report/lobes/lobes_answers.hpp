#pragma once
// In words: pockets, what a limit depends on, charts beside the chart.

#include <string>
#include <vector>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// A line a pocket: depth, speed, removal rate and what limits it. `label` stands before the first.
[[nodiscard]] std::string pockets_text(const std::vector<PocketSummary>& pockets, std::string label);

/// The one or two parameters that matter most, a line each: "1 % more damping of the mode at 412.0 Hz raises the limit
/// by 0.80 %". Empty where nothing is known.
[[nodiscard]] std::string sensitivities_text(const std::vector<SensitivitySummary>& sensitivities);

/// Notes for the reader of a chart of summary.json, a line each without its end: what the part's reduction and the
/// noise of measured FRFs make of the least depth, other methods, compliance without dynamics, speeds that did not
/// converge. Empty if there is nothing.
[[nodiscard]] std::vector<std::string> chart_notes(const LobesSummary& chart);

/// `robust` and `observed` of a chart and its notes, lines indented by four; empty if it has none of them.
[[nodiscard]] std::string asked_text(const LobesSummary& chart);

/// What moves a chart's limit at the case's speed most, as sentences: "Part alone: 1 % more K_t lowers the limit by
/// 1.00 %." Empty where nothing is known.
[[nodiscard]] std::vector<std::string> sensitivity_sentences(const LobesSummary& chart);

/// The text of a page below its first line, from a summary: sensitivities at the case's speed and notes of every chart,
/// as sentences.
[[nodiscard]] std::vector<std::string> answer_sentences(const Summary& summary);

}  // namespace thinwall::report
