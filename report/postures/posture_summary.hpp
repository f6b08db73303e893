#pragma once
// postures.json as types: what is known of a robot that was learned over its postures.

#include <optional>
#include <string>
#include <vector>

#include "posture/shared_tasks.hpp"
#include "report/summary/field.hpp"
#include "study/postures/posture_study.hpp"

namespace thinwall::report {

/// The errors of one number of a mode at postures that were held out.
struct NumberErrorSummary {
  std::string number;
  double median_error = 0.0, largest_error = 0.0;
  std::string worst_posture{};
  std::optional<double> R2{};
  double covered = 0.0;
};

template <class Visitor, Either<NumberErrorSummary> Section>
void fields(Visitor& visit, Section& error) {
  visit(Field{"number", Kind::text, "ln_frequency, ln_damping_ratio, or a part of an entry of the residue"},
        error.number);
  visit(Field{"median_error", Kind::ratio, "median of the errors: relative of logarithms, 1/kg of residues"},
        error.median_error);
  visit(Field{"largest_error", Kind::ratio, "the largest of the errors"}, error.largest_error);
  visit(Field{"worst_posture", Kind::text, "the posture of the largest error"}, error.worst_posture);
  visit(
      Field{"r2", Kind::ratio, "coefficient of determination over all postures; null: no variation", Presence::or_null},
      error.R2);
  visit(Field{"covered", Kind::ratio, "share of the postures within the interval of 95 %"}, error.covered);
}

/// A mode over the postures.
struct FollowedModeSummary {
  int mode = 0;
  int postures = 0;
  double least_frequency_hz = 0.0, largest_frequency_hz = 0.0;
  std::vector<NumberErrorSummary> numbers;
};

template <class Visitor, Either<FollowedModeSummary> Section>
void fields(Visitor& visit, Section& mode) {
  visit(Field{"mode", Kind::count, "its number, from 1 on"}, mode.mode);
  visit(Field{"postures", Kind::count, "postures that have seen it"}, mode.postures);
  visit(Field{"least_frequency_hz", Kind::frequency, "least of its frequencies"}, mode.least_frequency_hz);
  visit(Field{"largest_frequency_hz", Kind::frequency, "largest of its frequencies"}, mode.largest_frequency_hz);
  visit(Field{"numbers", Kind::section, "errors of its numbers at postures that were held out; absent: not asked for",
              Presence::if_any},
        mode.numbers);
}

/// Errors of limiting depths at postures that were held out.
struct DepthErrorSummary {
  double median_error = 0.0, ninetieth_error = 0.0, largest_error = 0.0;
  std::string worst_posture{};
  double covered = 0.0;
};

template <class Visitor, Either<DepthErrorSummary> Section>
void fields(Visitor& visit, Section& error) {
  visit(Field{"median_error", Kind::ratio, "median of the relative errors"}, error.median_error);
  visit(Field{"ninetieth_error", Kind::ratio, "nine in ten relative errors are below"}, error.ninetieth_error);
  visit(Field{"largest_error", Kind::ratio, "the largest of the relative errors"}, error.largest_error);
  visit(Field{"worst_posture", Kind::text, "the posture of the largest error"}, error.worst_posture);
  visit(Field{"covered", Kind::ratio, "share of the depths within their bands of 95 %"}, error.covered);
}

/// Medians of the errors at postures that were not learned from, over the number of others.
struct LearningPointSummary {
  int postures = 0;
  double frequency_error = 0.0;
  std::optional<double> depth_error{};
};

template <class Visitor, Either<LearningPointSummary> Section>
void fields(Visitor& visit, Section& point) {
  visit(Field{"postures", Kind::count, "postures that are learned from"}, point.postures);
  visit(Field{"frequency_error", Kind::ratio, "median relative error of a frequency"}, point.frequency_error);
  visit(Field{"depth_error", Kind::ratio, "median relative error of a limiting depth; absent: no cut by the robot"},
        point.depth_error);
}

/// The learning curves.
struct LearningCurveSummary {
  int tested = 0;
  std::vector<LearningPointSummary> plain{}, with_arm{};
};

template <class Visitor, Either<LearningCurveSummary> Section>
void fields(Visitor& visit, Section& curve) {
  visit(Field{"tested", Kind::count, "postures that are never learned from"}, curve.tested);
  visit(Field{"plain", Kind::section, "errors by number of postures, of plain processes"}, curve.plain);
  visit(Field{"with_arm", Kind::section, "with an arm as the mean, calibrated on the same postures; absent: no arm",
              Presence::if_any},
        curve.with_arm);
}

/// Numbers of a mode that are learned alone and together.
struct SharedTasksSummary {
  int mode = 0;
  posture::NumberGroup group = posture::NumberGroup::frequency_and_damping;
  posture::Sharing sharing = posture::Sharing::none;
  double R2_alone = 0.0, R2_together = 0.0;
  double ln_p_alone = 0.0, ln_p_together = 0.0;
};

template <class Visitor, Either<SharedTasksSummary> Section>
void fields(Visitor& visit, Section& tasks) {
  visit(Field{"mode", Kind::count, "its number, from 1 on"}, tasks.mode);
  visit(Field{"group", Kind::text, "the numbers"}, tasks.group);
  visit(Field{"sharing", Kind::text, "the effect of learning them together on what was held out"}, tasks.sharing);
  visit(Field{"r2_alone", Kind::ratio, "mean coefficient of determination, each learned alone"}, tasks.R2_alone);
  visit(Field{"r2_together", Kind::ratio, "the same, learned together"}, tasks.R2_together);
  visit(Field{"ln_likelihood_alone", Kind::ratio, "sum of the logarithms of the likelihoods, alone"}, tasks.ln_p_alone);
  visit(Field{"ln_likelihood_together", Kind::ratio, "logarithm of the likelihood together"}, tasks.ln_p_together);
}

/// The extremes of the map.
struct WorkspaceMapSummary {
  int places = 0;
  double least_first_hz = 0.0, largest_first_hz = 0.0;
  std::optional<double> least_depth_m, least_depth_low_m, least_depth_high_m, largest_depth_m;
  std::vector<double> least_depth_at;
};

template <class Visitor, Either<WorkspaceMapSummary> Section>
void fields(Visitor& visit, Section& map) {
  visit(Field{"places", Kind::count, "places of the grid within the hull of the postures"}, map.places);
  visit(Field{"least_first_hz", Kind::frequency, "least frequency of the first mode"}, map.least_first_hz);
  visit(Field{"largest_first_hz", Kind::frequency, "largest frequency of the first mode"}, map.largest_first_hz);
  visit(Field{"least_depth_m", Kind::length, "least of the stable depths; absent: no cut by the robot"},
        map.least_depth_m);
  visit(Field{"least_depth_low_m", Kind::length, "lower end of its band of 95 %"}, map.least_depth_low_m);
  visit(Field{"least_depth_high_m", Kind::length, "upper end of its band"}, map.least_depth_high_m);
  visit(Field{"largest_depth_m", Kind::length, "largest of the stable depths"}, map.largest_depth_m);
  visit(Field{"least_depth_at", Kind::ratio, "its place, as the columns have it", Presence::if_any},
        map.least_depth_at);
}

/// The envelope over low and high modes at the posture that is asked for.
struct EnvelopeSummary {
  double split_hz = 0.0;
  double least_low_m = 0.0, least_high_m = 0.0, least_together_m = 0.0;
};

template <class Visitor, Either<EnvelopeSummary> Section>
void fields(Visitor& visit, Section& envelope) {
  visit(Field{"split_hz", Kind::frequency, "low modes are below"}, envelope.split_hz);
  visit(Field{"least_low_m", Kind::length, "least depth of the chart with the low modes alone"}, envelope.least_low_m);
  visit(Field{"least_high_m", Kind::length, "with the high modes alone; null: none"}, envelope.least_high_m);
  visit(Field{"least_together_m", Kind::length, "with all modes"}, envelope.least_together_m);
}

/// The posture to tap next.
struct NextPostureSummary {
  std::vector<double> at;
  double reduction = 0.0;
  bool of_depth = false;
};

template <class Visitor, Either<NextPostureSummary> Section>
void fields(Visitor& visit, Section& next) {
  visit(Field{"at", Kind::ratio, "its place, as the columns have it"}, next.at);
  visit(Field{"reduction", Kind::ratio, "share of the variance along the path that a test there is expected to take"},
        next.reduction);
  visit(Field{"of_depth", Kind::truth, "variance of the logarithm of the limiting depth; false: of frequencies"},
        next.of_depth);
}

/// All of it.
struct LearnedRobotSummary {
  int postures = 0;
  std::vector<std::string> over;
  std::optional<double> spindle_speed_rpm;
  std::vector<FollowedModeSummary> modes{};
  std::optional<DepthErrorSummary> depths{};
  std::optional<LearningCurveSummary> curve{};
  std::vector<SharedTasksSummary> shared{};
  std::optional<WorkspaceMapSummary> map{};
  std::optional<EnvelopeSummary> envelope{};
  std::optional<NextPostureSummary> next{};
  std::vector<std::string> doubts{}, notes{};
};

template <class Visitor, Either<LearnedRobotSummary> Section>
void fields(Visitor& visit, Section& robot) {
  visit(Field{"postures", Kind::count, "postures at which the robot was tapped"}, robot.postures);
  visit(Field{"over", Kind::text, "columns over which is learned"}, robot.over);
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "speed of the depths; absent: no cut by the robot"},
        robot.spindle_speed_rpm);
  visit(Field{"modes", Kind::section, "modes over the postures"}, robot.modes);
  visit(
      Field{"depths", Kind::section, "errors of limiting depths at postures that were held out; absent: not asked for"},
      robot.depths);
  visit(Field{"curve", Kind::section, "errors over the number of postures; absent: not asked for"}, robot.curve);
  visit(Field{"shared", Kind::section, "numbers learned alone and together; absent: not asked for", Presence::if_any},
        robot.shared);
  visit(Field{"map", Kind::section, "the map over the workspace; absent: not asked for"}, robot.map);
  visit(Field{"envelope", Kind::section, "low and high modes at robot.at; absent: not asked for"}, robot.envelope);
  visit(Field{"next", Kind::section, "the posture to tap next; absent: not asked for"}, robot.next);
  visit(Field{"doubts", Kind::sentence, "sentences on what speaks against the results"}, robot.doubts);
  visit(Field{"notes", Kind::sentence, "sentences on how to read them"}, robot.notes);
}

/// The figures of a study.
[[nodiscard]] LearnedRobotSummary summary_of(const study::PostureStudy& study);

/// The name of the t-th number of a mode (posture::targets_of()): "ln_frequency", "re_1.x_1.y".
[[nodiscard]] std::string number_name(Eigen::Index t, const std::vector<std::string>& dofs);

}  // namespace thinwall::report
