#pragma once
// Sections of summary.json on errors: of receptances, and of limiting depths by them.

#include <vector>

#include "report/summary/field.hpp"

namespace thinwall::report {

/// The largest error of a response over its lines.
struct LargestErrorSummary {
  double largest_relative = 0.0, at_frequency_hz = 0.0;
};

template <class Visitor, Either<LargestErrorSummary> Section>
void fields(Visitor& visit, Section& error) {
  visit(Field{"largest_relative", Kind::error_estimate, "largest error over the largest entry of its line"},
        error.largest_relative);
  visit(Field{"at_frequency_hz", Kind::frequency, "line of that"}, error.at_frequency_hz);
}

/// The errors of a response; what is not known to be wrong is absent.
struct ResponseErrorsSummary {
  std::optional<LargestErrorSummary> truncation, noise;
};

template <class Visitor, Either<ResponseErrorsSummary> Section>
void fields(Visitor& visit, Section& errors) {
  visit(Field{"truncation", Kind::section, "what the part's reduction leaves out"}, errors.truncation);
  visit(Field{"noise", Kind::section, "standard deviation by the noise of measured FRFs"}, errors.noise);
}

/// The errors of all components; what is not known to be wrong is absent.
struct ErrorBudgetSummary {
  std::optional<ResponseErrorsSummary> part, robot, coupled;
};

template <class Visitor, Either<ErrorBudgetSummary> Section>
void fields(Visitor& visit, Section& budget) {
  visit(Field{"part", Kind::section, "of the part's receptance"}, budget.part);
  visit(Field{"robot", Kind::section, "of the robot's receptance"}, budget.robot);
  visit(Field{"coupled", Kind::section, "of the coupled receptance"}, budget.coupled);
}

/// The scatter of limiting depths over drawn samples of the noise.
struct SampledDepthSummary {
  long draws = 0;
  int seed = 0;
  std::optional<double> mean_m, deviation_m;
  int without_limit = 0;
};

template <class Visitor, Either<SampledDepthSummary> Section>
void fields(Visitor& visit, Section& sampled) {
  visit(Field{"draws", Kind::count, "draws"}, sampled.draws);
  visit(Field{"seed", Kind::count, "seed of the first draw"}, sampled.seed);
  visit(Field{"mean_m", Kind::length, "mean of the depths with a limit; null: there is none", Presence::or_null},
        sampled.mean_m);
  visit(Field{"deviation_m", Kind::length, "standard deviation of these; null: fewer than two", Presence::or_null},
        sampled.deviation_m);
  visit(Field{"without_limit", Kind::count, "draws without a limit, or whose search did not converge"},
        sampled.without_limit);
}

/// The range in which a limiting depth lies by the uncertainty of what was identified.
struct DepthRangeSummary {
  double low_m = 0.0, high_m = 0.0;
};

template <class Visitor, Either<DepthRangeSummary> Section>
void fields(Visitor& visit, Section& range) {
  visit(Field{"low_m", Kind::length, "2.5 % of the limits lie below"}, range.low_m);
  visit(Field{"high_m", Kind::length, "2.5 % of the limits lie above; the depth limit if they are stable up to it"},
        range.high_m);
}

/// The errors of a limiting depth by errors of the structure.
struct DepthErrorsSummary {
  std::optional<double> truncation_m, noise_deviation_m;
  std::optional<DepthRangeSummary> identification;
  std::optional<SampledDepthSummary> sampled;
};

template <class Visitor, Either<DepthErrorsSummary> Section>
void fields(Visitor& visit, Section& errors) {
  visit(Field{"truncation_m", Kind::length,
              "this depth less that with what the part's reduction leaves out; null: not known", Presence::or_null},
        errors.truncation_m);
  visit(Field{"noise_deviation_m", Kind::length,
              "standard deviation by the noise of what was measured, first order; null: not known", Presence::or_null},
        errors.noise_deviation_m);
  visit(Field{"identification", Kind::section,
              "95 % of the limits lie between, by the uncertainty of a fitted tool or a learned robot; absent: neither "
              "is there, or it is not known"},
        errors.identification);
  visit(Field{"sampled", Kind::section, "the noise by drawn samples, where they were asked for"}, errors.sampled);
}

/// The errors of a chart by errors of the structure.
struct ChartErrorsSummary {
  std::optional<double> largest_truncation_relative, largest_noise_relative, largest_identification_relative;
  std::optional<DepthErrorsSummary> at_minimum;
};

template <class Visitor, Either<ChartErrorsSummary> Section>
void fields(Visitor& visit, Section& errors) {
  visit(Field{"largest_truncation_relative", Kind::error_estimate,
              "largest truncation of a row over its depth; null: not known", Presence::or_null},
        errors.largest_truncation_relative);
  visit(Field{"largest_noise_relative", Kind::error_estimate,
              "largest standard deviation of a row over its depth; null: not known", Presence::or_null},
        errors.largest_noise_relative);
  visit(Field{"largest_identification_relative", Kind::error_estimate,
              "largest distance of a depth from an end of its range of 95 % by what was identified, over the depth; "
              "absent: nothing was identified"},
        errors.largest_identification_relative);
  visit(Field{"at_minimum", Kind::section, "of the row of least depth"}, errors.at_minimum);
}

}  // namespace thinwall::report
