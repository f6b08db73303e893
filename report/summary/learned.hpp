#pragma once
// Sections of summary.json on what the cuts that were made taught.

#include <optional>
#include <string>
#include <vector>

#include "report/summary/field.hpp"
#include "report/summary/observed.hpp"

namespace thinwall::report {

/// An uncertain parameter, beforehand and after.
struct LearnedParameterSummary {
  std::string parameter;
  std::optional<double> mode_frequency_hz;
  double before = 0.0, after = 0.0, relative_deviation_before = 0.0, relative_deviation_after = 0.0;
  double moved = 0.0, laplace_moved = 0.0, laplace_narrowed = 0.0, r_hat = 0.0, effective_size = 0.0;
};

template <class Visitor, Either<LearnedParameterSummary> Section>
void fields(Visitor& visit, Section& entry) {
  visit(Field{"parameter", Kind::text,
              "\"frequency\", \"damping_ratio\", \"mass\" of a mode, a coefficient, or \"speed_exponent\" of these"},
        entry.parameter);
  visit(Field{"mode_frequency_hz", Kind::frequency, "the mode's own frequency beforehand; null of a coefficient",
              Presence::or_null},
        entry.mode_frequency_hz);
  visit(Field{"before", Kind::ratio, "value beforehand: Hz, 1, share of the modal mass, N/m^2"}, entry.before);
  visit(Field{"after", Kind::ratio, "mean of the posterior, likewise"}, entry.after);
  visit(Field{"relative_deviation_before", Kind::ratio,
              "standard deviation beforehand over the value, of the speed exponent itself"},
        entry.relative_deviation_before);
  visit(Field{"relative_deviation_after", Kind::ratio, "the same of the posterior"}, entry.relative_deviation_after);
  visit(Field{"moved", Kind::ratio, "by how many of its standard deviations beforehand it moved"}, entry.moved);
  visit(Field{"laplace_moved", Kind::ratio, "the same by the likeliest parameters"}, entry.laplace_moved);
  visit(Field{"laplace_narrowed", Kind::ratio,
              "standard deviation of the normal distribution about these over that beforehand"},
        entry.laplace_narrowed);
  visit(Field{"r_hat", Kind::ratio, "split R-hat of the chains: 1 where they have forgotten their start"}, entry.r_hat);
  visit(Field{"effective_size", Kind::ratio, "independent draws that would tell the mean as well"},
        entry.effective_size);
}

/// A cut after the calibration that contradicts it.
struct ContradictionSummary {
  double spindle_speed_rpm = 0.0, depth_m = 0.0;
  milling::CutOutcome observed = milling::CutOutcome::stable;
  double chatter_probability = 0.0;
};

template <class Visitor, Either<ContradictionSummary> Section>
void fields(Visitor& visit, Section& cut) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, cut.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, cut.depth_m);
  visit(Field{"observed", Kind::text, "as it was seen"}, cut.observed);
  visit(Field{"chatter_probability", Kind::ratio, "probability of chatter by all cuts together"},
        cut.chatter_probability);
}

/// The cut to make next.
struct NextCutSummary {
  std::optional<double> for_rpm;
  double spindle_speed_rpm = 0.0, depth_m = 0.0, chatter_probability = 0.0;
  double deviation_before = 0.0, deviation_after = 0.0;
};

template <class Visitor, Either<NextCutSummary> Section>
void fields(Visitor& visit, Section& cut) {
  visit(
      Field{"for_rpm", Kind::spindle_speed,
            "the speed whose limit it narrows; null: it narrows the speed at which most is removed", Presence::or_null},
      cut.for_rpm);
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, cut.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, cut.depth_m);
  visit(Field{"chatter_probability", Kind::ratio, "probability that it chatters"}, cut.chatter_probability);
  visit(Field{"deviation_before", Kind::ratio, "standard deviation of ln of the limit, or of the best speed"},
        cut.deviation_before);
  visit(Field{"deviation_after", Kind::ratio, "what is expected of it once the outcome is known"}, cut.deviation_after);
}

/// The cut that removes most at a bounded risk.
struct ProductiveCutSummary {
  double spindle_speed_rpm = 0.0, depth_m = 0.0, chatter_probability = 0.0;
};

template <class Visitor, Either<ProductiveCutSummary> Section>
void fields(Visitor& visit, Section& cut) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, cut.spindle_speed_rpm);
  visit(Field{"depth_m", Kind::length, "axial depth of cut"}, cut.depth_m);
  visit(Field{"chatter_probability", Kind::ratio, "probability that it chatters, at most calibration.risk"},
        cut.chatter_probability);
}

/// The limit at a speed, beforehand and after.
struct LearnedRowSummary {
  double spindle_speed_rpm = 0.0, before_m = 0.0, median_m = 0.0, stable_90_m = 0.0, stable_95_m = 0.0;
};

template <class Visitor, Either<LearnedRowSummary> Section>
void fields(Visitor& visit, Section& row) {
  visit(Field{"spindle_speed_rpm", Kind::spindle_speed, "spindle speed"}, row.spindle_speed_rpm);
  visit(Field{"before_m", Kind::length, "limiting depth of the case as it stands"}, row.before_m);
  visit(Field{"median_m", Kind::length, "depth that is stable with 50 % of the posterior"}, row.median_m);
  visit(Field{"stable_90_m", Kind::length, "with 90 %"}, row.stable_90_m);
  visit(Field{"stable_95_m", Kind::length, "with 95 %"}, row.stable_95_m);
}

/// The lesson of the cuts.
struct LearnedSummary {
  std::vector<LearnedParameterSummary> parameters;
  double noise = 0.0;
  bool converged = false;
  int steps = 0;
  long draws = 0;
  double accepted = 0.0, worst_r_hat = 0.0, least_effective_size = 0.0;
  ShareSummary before, after;
  std::optional<ShareSummary> cross_validated;
  std::vector<ContradictionSummary> contradictions;
  std::optional<NextCutSummary> next_cut;
  std::optional<ProductiveCutSummary> productive_cut;
  std::vector<LearnedRowSummary> rows;
};

template <class Visitor, Either<LearnedSummary> Section>
void fields(Visitor& visit, Section& learned) {
  visit(Field{"parameters", Kind::section, "every uncertain parameter"}, learned.parameters);
  visit(Field{"noise", Kind::ratio, "margin, in shares of the free decay, over which outcomes are mixed"},
        learned.noise);
  visit(Field{"converged", Kind::truth, "true if the likeliest parameters were found"}, learned.converged);
  visit(Field{"steps", Kind::count, "steps that it took"}, learned.steps);
  visit(Field{"draws", Kind::count, "draws of all chains"}, learned.draws);
  visit(Field{"accepted", Kind::ratio, "share of their proposals that were accepted"}, learned.accepted);
  visit(Field{"worst_r_hat", Kind::ratio, "largest split R-hat"}, learned.worst_r_hat);
  visit(Field{"least_effective_size", Kind::ratio, "least effective sample size"}, learned.least_effective_size);
  visit(Field{"before", Kind::section, "cuts that the case as it stands predicts rightly"}, learned.before);
  visit(Field{"after", Kind::section, "cuts that the posterior predicts rightly, which were used to find it"},
        learned.after);
  visit(Field{"cross_validated", Kind::section,
              "cuts that are predicted rightly by what the others teach; absent without calibration.folds"},
        learned.cross_validated);
  visit(Field{"contradictions", Kind::section, "cuts of which the other outcome had more than 95 %", Presence::if_any},
        learned.contradictions);
  visit(Field{"next_cut", Kind::section,
              "the cut that is expected to tell most; absent where none is proposed, which a warning explains"},
        learned.next_cut);
  visit(Field{"productive_cut", Kind::section, "the cut that removes most at calibration.risk; absent without that"},
        learned.productive_cut);
  visit(Field{"rows", Kind::section, "limits over the speeds"}, learned.rows);
}

}  // namespace thinwall::report
