#pragma once
// Sections of summary.json on what was fitted and what was expected.

#include <string>
#include <vector>

#include "report/summary/field.hpp"

namespace thinwall::report {

/// A number that a fit could change.
struct FittedParameterSummary {
  std::string key, unit;
  double start = 0.0, fitted = 0.0, lower = 0.0, upper = 0.0;
  bool at_bound = false;
};

template <class Visitor, Either<FittedParameterSummary> Section>
void fields(Visitor& visit, Section& parameter) {
  visit(Field{"key", Kind::text, "key of the case"}, parameter.key);
  visit(Field{"unit", Kind::text, "unit of the numbers that follow; empty: a plain number"}, parameter.unit);
  visit(Field{"start", Kind::of_quantity, "value that the case gives"}, parameter.start);
  visit(Field{"fitted", Kind::of_quantity, "value that was found"}, parameter.fitted);
  visit(Field{"lower", Kind::of_quantity, "lower bound"}, parameter.lower);
  visit(Field{"upper", Kind::of_quantity, "upper bound"}, parameter.upper);
  visit(Field{"at_bound", Kind::truth, "true if the fit ended at a bound"}, parameter.at_bound);
}

/// A known result that a fit came near to.
struct FitTargetSummary {
  std::string quantity;
  double wanted = 0.0, reached = 0.0;
  std::vector<double> sensitivity;
};

template <class Visitor, Either<FitTargetSummary> Section>
void fields(Visitor& visit, Section& target) {
  visit(Field{"quantity", Kind::text, "name of the quantity"}, target.quantity);
  visit(Field{"wanted", Kind::of_quantity, "value that the case wants"}, target.wanted);
  visit(Field{"reached", Kind::of_quantity, "value that was reached"}, target.reached);
  visit(Field{"sensitivity", Kind::ratio, "relative change of the quantity over that of each parameter"},
        target.sensitivity);
}

/// One fit of model updating.
struct UpdatingSummary {
  std::string name;
  int evaluations = 0;
  bool converged = false;
  std::vector<FittedParameterSummary> parameters;
  std::vector<FitTargetSummary> targets;
};

template <class Visitor, Either<UpdatingSummary> Section>
void fields(Visitor& visit, Section& fit) {
  visit(Field{"name", Kind::text, "name of the fit"}, fit.name);
  visit(Field{"evaluations", Kind::count, "evaluations of the model"}, fit.evaluations);
  visit(Field{"converged", Kind::truth, "true if the fit converged"}, fit.converged);
  visit(Field{"parameters", Kind::section, "numbers that were fitted", Presence::if_any}, fit.parameters);
  visit(Field{"targets", Kind::section, "known results that were fitted to", Presence::if_any}, fit.targets);
}

/// An expectation of the case (expected.toml) beside what the run gave.
struct CheckSummary {
  std::string name, quantity, origin;
  bool ok = false;
  std::optional<double> value, expected, tolerance, at_least, at_most;
};

template <class Visitor, Either<CheckSummary> Section>
void fields(Visitor& visit, Section& check) {
  visit(Field{"name", Kind::text, "name of the expectation"}, check.name);
  visit(Field{"quantity", Kind::text, "path of the number in this summary"}, check.quantity);
  visit(Field{"origin", Kind::text, "where the expected value comes from"}, check.origin);
  visit(Field{"ok", Kind::truth, "true if the expectation holds"}, check.ok);
  visit(Field{"value", Kind::of_quantity, "value of the run; null: the summary has no such number", Presence::or_null},
        check.value);
  visit(Field{"expected", Kind::of_quantity, "value that is expected; null: bounds only", Presence::or_null},
        check.expected);
  visit(Field{"tolerance", Kind::of_quantity, "distance that is allowed"}, check.tolerance);
  visit(Field{"at_least", Kind::of_quantity, "lower bound"}, check.at_least);
  visit(Field{"at_most", Kind::of_quantity, "upper bound"}, check.at_most);
}

}  // namespace thinwall::report
