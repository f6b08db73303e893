#include "study/lobes/observed_cuts.hpp"

#include <cmath>
#include <map>

#include "core/parallel.hpp"
#include "milling/chart/lobe_method.hpp"
#include "setup/observed.hpp"

namespace thinwall::study {

namespace {

/// Draws of the parameters; their share tells a probability of a few hundredths to one.
constexpr int judged_draws = 200;

}  // namespace

std::vector<double> chatter_probabilities(const setup::CutSetup& source, const milling::Cut& nominal,
                                          const milling::StabilityOptions& options) {
  const std::vector<milling::ObservedCut> cuts = setup::all_cuts(source.observed);
  if (!source.lobes->robust || cuts.empty()) return {};
  const auto draws = milling::drawn_cuts(nominal, source.lobes->robust->uncertainty, judged_draws,
                                         static_cast<unsigned>(source.lobes->seed));
  std::vector<milling::OperatingPoint> points;
  points.reserve(cuts.size());
  for (const milling::ObservedCut& cut : cuts) points.push_back({cut.spindle_speed_rpm, cut.depth_m});
  return milling::chatter_probabilities(draws, points, options);
}

std::vector<bool> textbook_verdicts(const setup::CutSetup& source, const milling::Cut& nominal,
                                    const milling::MethodOptions& options) {
  const std::vector<milling::ObservedCut> cuts = setup::all_cuts(source.observed);
  if (cuts.empty() || !milling::objection(milling::Method::zeroth_order, nominal.process).empty()) return {};
  const auto textbook =
      milling::lobe_method(milling::Method::zeroth_order, nominal.structure, nominal.process, options);
  std::vector<char> stable(cuts.size());  // threads write to places of their own
  core::parallel_for(cuts.size(), [&](std::size_t i) {
    stable[i] = milling::stable_at(textbook->limiting_depth(cuts[i].spindle_speed_rpm), cuts[i].depth_m) ? 1 : 0;
  });
  return {stable.begin(), stable.end()};
}

Certainty certainty_of(double chatter_probability, double confidence) {
  const double beyond = 0.5 * std::erfc(confidence / std::sqrt(2.0));
  if (chatter_probability <= beyond) return Certainty::certainly_stable;
  return chatter_probability >= 1.0 - beyond ? Certainty::certainly_unstable : Certainty::open;
}

std::optional<bool> is_right(const JudgedCut& cut) {
  using Status = milling::StabilityStatus;
  if (cut.observed.outcome == milling::CutOutcome::marginal) return std::nullopt;
  for (const Status doubtful : {Status::node_limit_reached, Status::data_insufficient, Status::crossing_missed})
    if (cut.predicted.status == doubtful) return std::nullopt;
  return cut.predicted.stable == (cut.observed.outcome == milling::CutOutcome::stable);
}

}  // namespace thinwall::study
