#include "report/postures/posture_summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "regression/cross_validation.hpp"

namespace thinwall::report {

namespace {

using posture::HeldOutMode;

/// The value below which a share of all lie; NaN of none.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)))];
}

NumberErrorSummary number_errors(const study::PostureStudy& study, const std::vector<HeldOutMode>& modes,
                                 Eigen::Index t) {
  Eigen::VectorXd measured(std::ssize(modes)), predicted(std::ssize(modes));
  for (std::size_t i = 0; i < modes.size(); ++i) {
    measured(static_cast<Eigen::Index>(i)) = modes[i].measured(t);
    predicted(static_cast<Eigen::Index>(i)) = modes[i].predicted(t);
  }
  const Eigen::VectorXd error = (measured - predicted).cwiseAbs();
  Eigen::Index worst = 0;
  NumberErrorSummary summary{number_name(t, study.dofs), quantile({error.begin(), error.end()}, 0.5),
                             error.maxCoeff(&worst)};
  summary.worst_posture = study.names[modes[static_cast<std::size_t>(worst)].posture];
  const double R2 = regression::coefficient_of_determination(measured, predicted);
  if (std::isfinite(R2)) summary.R2 = R2;
  summary.covered = posture::covered(modes, t);
  return summary;
}

/// The predictions of each label.
std::map<int, std::vector<HeldOutMode>> by_label(const study::PostureStudy& study) {
  std::map<int, std::vector<HeldOutMode>> modes;
  if (!study.held_out) return modes;
  for (const HeldOutMode& mode : study.held_out->modes) modes[mode.label].push_back(mode);
  return modes;
}

std::vector<FollowedModeSummary> followed_modes(const study::PostureStudy& study) {
  std::map<int, FollowedModeSummary> modes;
  for (const posture::TappedPosture& posture : study.postures) {
    for (std::size_t k = 0; k < posture.modes.size(); ++k) {
      const double hz = posture.modes[k].frequency_hz;
      FollowedModeSummary& mode =
          modes.try_emplace(posture.label[k], FollowedModeSummary{posture.label[k] + 1, 0, hz, hz, {}}).first->second;
      ++mode.postures;
      mode.least_frequency_hz = std::min(mode.least_frequency_hz, hz);
      mode.largest_frequency_hz = std::max(mode.largest_frequency_hz, hz);
    }
  }
  for (const auto& [label, held_out] : by_label(study)) {
    for (Eigen::Index t = 0; t < held_out.front().measured.size(); ++t)
      modes[label].numbers.push_back(number_errors(study, held_out, t));
  }
  std::vector<FollowedModeSummary> result;
  result.reserve(modes.size());
  for (auto& [label, mode] : modes) result.push_back(std::move(mode));
  return result;
}

std::optional<DepthErrorSummary> depth_errors(const study::PostureStudy& study) {
  if (!study.held_out || study.held_out->depths.empty()) return std::nullopt;
  std::vector<double> errors;
  DepthErrorSummary summary;
  for (const posture::HeldOutDepths& at : study.held_out->depths) {
    const double error = (at.predicted.array() / at.measured.array() - 1.0).abs().maxCoeff();
    errors.push_back(error);
    if (error < summary.largest_error) continue;
    summary.largest_error = error;
    summary.worst_posture = study.names[at.posture];
  }
  summary.median_error = quantile(errors, 0.5);
  summary.ninetieth_error = quantile(errors, 0.9);
  summary.covered = posture::covered(study.held_out->depths);
  return summary;
}

std::vector<LearningPointSummary> points_of(const std::vector<posture::LearningPoint>& curve) {
  std::vector<LearningPointSummary> points;
  points.reserve(curve.size());
  for (const posture::LearningPoint& at : curve) points.push_back({at.postures, at.frequency_error, at.depth_error});
  return points;
}

std::vector<double> row_of(const Eigen::MatrixXd& places, Eigen::Index row) {
  const Eigen::RowVectorXd place = places.row(row);
  return {place.begin(), place.end()};
}

std::optional<WorkspaceMapSummary> map_extremes(const study::PostureStudy& study) {
  if (study.map.empty()) return std::nullopt;
  const auto first_hz = [](const posture::MappedPlace& at) { return at.first_hz.value; };
  const auto depth = [](const posture::MappedPlace& at) { return at.depth->depth_m.value; };
  const auto [slow, fast] = std::ranges::minmax_element(study.map, {}, first_hz);
  WorkspaceMapSummary summary{static_cast<int>(study.map.size()), first_hz(*slow), first_hz(*fast), {}, {}, {}, {}, {}};
  if (!study.map.front().depth) return summary;
  const auto [least, largest] = std::ranges::minmax_element(study.map, {}, depth);
  summary.least_depth_m = depth(*least);
  summary.least_depth_low_m = least->depth->depth_m.low;
  summary.least_depth_high_m = least->depth->depth_m.high;
  summary.largest_depth_m = depth(*largest);
  summary.least_depth_at = row_of(study.mapped_at, least - study.map.begin());
  return summary;
}

}  // namespace

std::string number_name(Eigen::Index t, const std::vector<std::string>& dofs) {
  if (t < 2) return t == 0 ? "ln_frequency" : "ln_damping_ratio";
  const Eigen::Index n = std::ssize(dofs), entry = (t - 2) % (n * n);
  return (t - 2 < n * n ? "re_" : "im_") + dofs[static_cast<std::size_t>(entry % n)] + "_" +
         dofs[static_cast<std::size_t>(entry / n)];
}

LearnedRobotSummary summary_of(const study::PostureStudy& study) {
  LearnedRobotSummary summary{static_cast<int>(study.names.size()), study.over, study.spindle_speed_rpm};
  summary.modes = followed_modes(study);
  summary.depths = depth_errors(study);
  if (study.curves)
    summary.curve = {study.curves->tested, points_of(study.curves->plain), points_of(study.curves->with_arm)};
  for (const posture::SharedTasks& tasks : study.shared)
    summary.shared.push_back({tasks.label + 1, tasks.group, tasks.sharing(), tasks.R2_alone.mean(),
                              tasks.R2_together.mean(), tasks.ln_p_alone, tasks.ln_p_together});
  summary.map = map_extremes(study);
  if (study.envelope)
    summary.envelope = {study.envelope->split_hz, study.envelope->low.minCoeff(), study.envelope->high.minCoeff(),
                        study.envelope->together.minCoeff()};
  if (study.next)
    summary.next = {row_of(study.candidates, study.next->best), study.next->reduction(study.next->best),
                    study.spindle_speed_rpm.has_value()};
  summary.doubts = study.doubts;
  summary.notes = study.notes;
  return summary;
}

}  // namespace thinwall::report
