#pragma once
// Cuts that were made, held against a chart.

#include <vector>

#include "milling/observed/chatter_probability.hpp"
#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The word of the draws of [lobes.uncertainty] on every cut, in their order: the share of `judged_draws` of them that
/// chatter (milling/observed/chatter_probability.hpp). Empty where nothing is uncertain or there are no cuts.
[[nodiscard]] std::vector<double> chatter_probabilities(const setup::CutSetup& source, const milling::Cut& nominal,
                                                        const milling::StabilityOptions& options);

/// The word of the textbook's method, milling::Method::zeroth_order, on every cut, in their order: true if it is
/// stable. Empty where that method cannot take the cut, or there are no cuts. Cost: a row for each speed.
[[nodiscard]] std::vector<bool> textbook_verdicts(const setup::CutSetup& source, const milling::Cut& nominal,
                                                  const milling::MethodOptions& options);

/// The verdict of a probability of chatter at a confidence of k standard deviations: a cut is certainly stable up to
/// 1 − Φ(k), certainly unstable from Φ(k), open between.
[[nodiscard]] Certainty certainty_of(double chatter_probability, double confidence);

/// True if the prediction is what was seen; none of a marginal cut, and where the prediction did not
/// converge.
[[nodiscard]] std::optional<bool> is_right(const JudgedCut& cut);

}  // namespace thinwall::study
