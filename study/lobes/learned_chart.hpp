#pragma once
// A chart that learns from the cuts that were made.

#include <optional>
#include <vector>

#include "milling/observed/uncertain_cut.hpp"
#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The likelihood of the set-up's cuts with [lobes.uncertainty] as what is known beforehand. Throws InputError for a
/// bad uncertainty, and for more than learning::most_parameters parameters.
[[nodiscard]] learning::CutModel cut_model(const setup::CutSetup& source, const milling::Cut& nominal,
                                           const milling::StabilityOptions& options);

/// The limiting depths at one speed, m; none where the search missed a crossing.
struct LimitsAtSpeed {
  double spindle_speed_rpm = 0.0;
  std::optional<double> nominal;
  std::vector<std::optional<double>> of_draws;
};

/// The depths that are stable with 50, 90 and 95 % of the draws whose limit is known, a row for each speed at which
/// that of the nominal cut is, too, and at least half of the draws. Warns of what is left out.
[[nodiscard]] std::vector<LearnedChart::Row> answered_rows(const std::vector<LimitsAtSpeed>& limits);

/// The answer to [calibration]: the posterior, the share of cuts that are predicted rightly before and, with folds, by
/// what the others teach, the limits of the draws over the speeds of the chart, and the cuts to make next. Throws
/// InputError as learning::calibrate(). Cost: that of the posterior, and some thousand rows.
[[nodiscard]] LearnedChart learned_chart(const setup::CutSetup& source, const milling::Cut& nominal,
                                         const milling::StabilityOptions& options);

}  // namespace thinwall::study
