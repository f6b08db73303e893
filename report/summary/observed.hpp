#pragma once
// Sections of summary.json on cuts that were made, held against a chart.

#include <optional>
#include <string>
#include <vector>

#include "milling/observed/observed_cut.hpp"
#include "report/summary/field.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// One cut, and what the chart says of it.
struct ObservedCutSummary {
  double spindle_speed_rpm = 0.0, depth_m = 0.0;
  milling::CutOutcome observed = milling::CutOutcome::stable;
  bool predicted_stable = false;
  std::optional<bool> right;
  double depth_margin_m = 0.0, depth_margin_relative = 0.0;
  bool depth_margin_at_limit = false;
  std::optional<double> speed_margin_rpm, multiplier_modulus, chatter_probability;
  std::optional<study::Certainty> certainty;
  std::optional<bool> textbook_stable;
  std::optional<double> heard_frequency_hz, predicted_frequency_hz;
  std::string status;
};

template <class Visitor, Either<ObservedCutSummary> Section>
void fields(Visitor& visit, Section& cut) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, cut.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, cut.depth_m);
  visit(Field{"observed", Kind::text, "\"stable\", \"chatter\" or \"marginal\", as it was seen"}, cut.observed);
  visit(Field{"predicted_stable", Kind::truth, "true if the chart predicts a stable cut"}, cut.predicted_stable);
  visit(Field{"right", Kind::truth,
              "true if that was seen; null of a marginal cut, and where the prediction did not converge",
              Presence::or_null},
        cut.right);
  visit(Field{"depth_margin_m", Kind::length, "depth that may be added; negative: how much is too deep"},
        cut.depth_margin_m);
  visit(Field{"depth_margin_relative", Kind::ratio, "depth_margin_m over depth_m"}, cut.depth_margin_relative);
  visit(Field{"depth_margin_at_limit", Kind::truth, "true if no limit was found: the margin is the least"},
        cut.depth_margin_at_limit);
  visit(Field{"speed_margin_rpm", Kind::spindle_speed,
              "distance in speed to the nearest change of stability at this depth; null: none in the chart",
              Presence::or_null},
        cut.speed_margin_rpm);
  visit(Field{"multiplier_modulus", Kind::ratio, "modulus of the largest Floquet multiplier; null from samples",
              Presence::or_null},
        cut.multiplier_modulus);
  visit(Field{"chatter_probability", Kind::ratio,
              "share of the draws of lobes.uncertainty that chatter; absent: nothing is uncertain"},
        cut.chatter_probability);
  visit(Field{"certainty", Kind::text, "\"certainly_stable\", \"open\" or \"certainly_unstable\", by that share"},
        cut.certainty);
  visit(Field{"textbook_stable", Kind::truth,
              "true if the zeroth-order method predicts a stable cut; absent: it cannot take the cut"},
        cut.textbook_stable);
  visit(Field{"heard_frequency_hz", Kind::frequency, "chatter frequency that was heard"}, cut.heard_frequency_hz);
  visit(Field{"predicted_frequency_hz", Kind::frequency, "that of the largest multiplier; absent: not known"},
        cut.predicted_frequency_hz);
  visit(Field{"status", Kind::text,
              "\"converged\", \"stable_to_depth_limit\", \"data_limited\", or why the answer is not to be trusted"},
        cut.status);
}

/// A share with its interval.
struct ShareSummary {
  int right = 0, of = 0;
  double share = 0.0, low = 0.0, high = 1.0;
};

template <class Visitor, Either<ShareSummary> Section>
void fields(Visitor& visit, Section& share) {
  visit(Field{"right", Kind::count, "cuts that were predicted rightly"}, share.right);
  visit(Field{"of", Kind::count, "cuts that were stable or chattered"}, share.of);
  visit(Field{"share", Kind::ratio, "the one over the other"}, share.share);
  visit(Field{"low", Kind::ratio, "lower end of its 95 % interval (Wilson 1927)"}, share.low);
  visit(Field{"high", Kind::ratio, "upper end"}, share.high);
}

/// The worth of a prediction with its uncertainty.
struct CertaintySummary {
  int certainly_stable = 0, certainly_stable_that_chattered = 0;
  int open = 0;
  int certainly_unstable = 0, certainly_unstable_that_were_stable = 0;
};

template <class Visitor, Either<CertaintySummary> Section>
void fields(Visitor& visit, Section& certainty) {
  visit(Field{"certainly_stable", Kind::count, "cuts, marginal ones left out, that are certainly stable"},
        certainty.certainly_stable);
  visit(Field{"certainly_stable_that_chattered", Kind::count, "those of them that chattered"},
        certainty.certainly_stable_that_chattered);
  visit(Field{"open", Kind::count, "cuts of which the uncertainty leaves both open"}, certainty.open);
  visit(Field{"certainly_unstable", Kind::count, "cuts that certainly chatter"}, certainty.certainly_unstable);
  visit(Field{"certainly_unstable_that_were_stable", Kind::count, "those of them that were stable"},
        certainty.certainly_unstable_that_were_stable);
}

/// All cuts that were made, held against a chart.
struct ObservedSummary {
  ShareSummary prediction;
  int stable_right = 0, stable_wrong = 0, chatter_right = 0, chatter_wrong = 0, marginal = 0;
  std::optional<int> doubtful;
  std::optional<ShareSummary> textbook;
  std::optional<CertaintySummary> certainty;
  int frequencies_heard = 0;
  std::optional<double> median_frequency_difference_relative;
  std::vector<ObservedCutSummary> cuts;
};

template <class Visitor, Either<ObservedSummary> Section>
void fields(Visitor& visit, Section& observed) {
  visit(Field{"prediction", Kind::section, "share of the cuts that the chart predicts rightly"}, observed.prediction);
  visit(Field{"stable_right", Kind::count, "cuts that were stable, predicted stable"}, observed.stable_right);
  visit(Field{"stable_wrong", Kind::count, "cuts that were stable, predicted to chatter"}, observed.stable_wrong);
  visit(Field{"chatter_right", Kind::count, "cuts that chattered, predicted to chatter"}, observed.chatter_right);
  visit(Field{"chatter_wrong", Kind::count, "cuts that chattered, predicted stable"}, observed.chatter_wrong);
  visit(Field{"marginal", Kind::count, "cuts that were neither, and are not counted"}, observed.marginal);
  visit(Field{"doubtful", Kind::count,
              "other cuts whose prediction did not converge, and that are not counted; absent: none"},
        observed.doubtful);
  visit(Field{"textbook", Kind::section, "the same share of the zeroth-order method; absent: it cannot take the cut"},
        observed.textbook);
  visit(Field{"certainty", Kind::section, "what lobes.uncertainty leaves certain; absent: nothing is uncertain"},
        observed.certainty);
  visit(Field{"frequencies_heard", Kind::count, "cuts whose chatter frequency was heard, and is predicted"},
        observed.frequencies_heard);
  visit(Field{"median_frequency_difference_relative", Kind::ratio,
              "median of |predicted - heard|/heard of these; absent: there are none"},
        observed.median_frequency_difference_relative);
  visit(Field{"cuts", Kind::section, "every cut, in the order of the case"}, observed.cuts);
}

}  // namespace thinwall::report
