#include "identification/fit_response.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/error.hpp"
#include "dynamics/frf_checks.hpp"

namespace thinwall::identification {

namespace {

constexpr Eigen::Index fewest_lines = 10;

std::string text(const char* format, double a, double b = 0.0) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, a, b);
  return buffer;
}

bool is_used(double hz, const ResponseFitOptions& options) {
  if (!(hz > 0.0) || hz < options.band.from_hz || hz > options.band.to_hz) return false;
  return std::ranges::none_of(options.left_out, [&](const Band& b) { return hz >= b.from_hz && hz <= b.to_hz; });
}

/// The lines without their variances. Throws InputError where an entry is zero on all of them.
MeasuredLines lines_of(const dynamics::ResponseModel& measured, const std::vector<std::size_t>& used) {
  MeasuredLines lines;
  lines.hz.resize(static_cast<Eigen::Index>(used.size()));
  Eigen::MatrixXd size = Eigen::MatrixXd::Zero(measured.H[0].rows(), measured.H[0].cols());
  for (std::size_t i = 0; i < used.size(); ++i) {
    lines.hz(static_cast<Eigen::Index>(i)) = measured.axis.hz(static_cast<Eigen::Index>(used[i]));
    lines.H.push_back(measured.H[used[i]]);
    size += measured.H[used[i]].cwiseAbs();
  }
  Eigen::Index row = 0, column = 0;
  if (size.minCoeff(&row, &column) > 0.0) return lines;
  throw core::InputError(dynamics::name(measured.responses[static_cast<std::size_t>(row)]) + "/" +
                         dynamics::name(measured.forces[static_cast<std::size_t>(column)]) +
                         " is 0 on every line of the band; leave the file out, or look at it");
}

std::vector<Eigen::MatrixXcd> values_of(const ModalFit& fit, const Eigen::VectorXd& hz) {
  std::vector<Eigen::MatrixXcd> values;
  values.reserve(static_cast<std::size_t>(hz.size()));
  for (const double f : hz) values.push_back(value(fit, f));
  return values;
}

std::vector<Eigen::MatrixXcd> difference(std::vector<Eigen::MatrixXcd> a, const std::vector<Eigen::MatrixXcd>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}

/// The variances by what was fitted, empty before the first fit.
std::vector<Eigen::MatrixXd> variances(const ResponseFit& fit, const std::vector<Eigen::MatrixXd>& coherence,
                                       const std::vector<Eigen::MatrixXcd>& fitted, const ResponseFitOptions& options) {
  constexpr double least_share = 1e-6;
  const std::vector<Eigen::MatrixXcd>& sizes = fitted.empty() ? fit.lines.H : fitted;
  if (fit.weights == Weights::scatter) {
    const auto rest = fitted.empty() ? fit.lines.H : difference(fit.lines.H, fitted);
    return variance_from_scatter(fit.lines.hz, rest, sizes, least_share);
  }
  std::vector<Eigen::MatrixXd> result;
  if (fit.weights == Weights::coherence) result = variance_of(sizes, coherence, options.averages);
  const Eigen::Index rows = sizes.front().rows(), columns = sizes.front().cols();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (fit.weights == Weights::noise)
      result.emplace_back(2.0 * spread_over(options.noise, rows, columns, "noise").square() * sizes[i].array().abs2());
    // Positive also where an entry is zero or known without error.
    const double floor = std::max(1e-300, std::pow(least_share * sizes[i].cwiseAbs().maxCoeff(), 2));
    result[i] = result[i].cwiseMax(floor);
  }
  return result;
}

Eigen::MatrixXd misfit_of(const MeasuredLines& lines, const std::vector<Eigen::MatrixXcd>& fitted) {
  Eigen::MatrixXd off = Eigen::MatrixXd::Zero(lines.responses(), lines.references()), all = off;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    off += (lines.H[i] - fitted[i]).cwiseAbs2();
    all += lines.H[i].cwiseAbs2();
  }
  return (off.array() / all.array().max(1e-300)).sqrt();
}

/// Σ |H − fit|² over half of the variance, which real and imaginary part have each.
double chi2_of(const MeasuredLines& lines, const std::vector<Eigen::MatrixXcd>& fitted) {
  double sum = 0.0;
  for (std::size_t i = 0; i < fitted.size(); ++i)
    sum += 2.0 * ((lines.H[i] - fitted[i]).cwiseAbs2().array() / lines.variance[i].array()).sum();
  return sum;
}

/// χ² a degree of freedom of the residues as they were fitted, before passivity moved them.
double chi2_as_fitted(const ResponseFit& fit) {
  const ModalFit& found = fit.found.fit;
  return (fit.passive ? fit.passive->chi2_before : found.chi2) / found.degrees_of_freedom;
}

std::string name_of_entry(const dynamics::DofTable& responses, const dynamics::DofTable& forces, Eigen::Index row,
                          Eigen::Index column) {
  return dynamics::name(responses[static_cast<std::size_t>(row)]) + "/" +
         dynamics::name(forces[static_cast<std::size_t>(column)]);
}

/// The place where the lines are farthest from the fit: over a twentieth of them, of one entry.
std::string worst_place(const ResponseFit& fit, const dynamics::DofTable& responses, const dynamics::DofTable& forces) {
  const Eigen::Index lines = fit.lines.lines(), width = std::max<Eigen::Index>(3, lines / 20);
  double worst = -1.0;
  std::string place;
  for (Eigen::Index first = 0; first + width <= lines; first += std::max<Eigen::Index>(1, width / 2)) {
    Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(fit.lines.responses(), fit.lines.references());
    for (Eigen::Index i = first; i < first + width; ++i) {
      const auto at = static_cast<std::size_t>(i);
      sum += ((fit.lines.H[at] - value(fit.found.fit, fit.lines.hz(i))).cwiseAbs2().array() /
              fit.lines.variance[at].array())
                 .matrix();
    }
    Eigen::Index row = 0, column = 0;
    if (sum.maxCoeff(&row, &column) <= worst) continue;
    worst = sum(row, column);
    place = text("%.5g to %.5g Hz", fit.lines.hz(first), fit.lines.hz(first + width - 1)) + " in " +
            name_of_entry(responses, forces, row, column);
  }
  return place;
}

/// A sentence on χ², and on the terms that would lower it where they were given.
void doubt_misfit(const ResponseFit& fit, const dynamics::DofTable& responses, const dynamics::DofTable& forces,
                  const ResponseFitOptions& options, std::vector<std::string>& doubts) {
  constexpr double much = 1.3;
  const double chi2 = chi2_as_fitted(fit);
  if (chi2 < much) return;
  std::string doubt = "chi2 a degree of freedom is " + text("%.3g", chi2) + " where 1 is right: most is at " +
                      worst_place(fit, responses, forces);
  if (options.identify.terms) {
    ResponseFitOptions free = options;
    free.identify.terms.reset();
    free.identify.poles = poles_of(fit.found.fit);
    free.identify.residues = Residues::free;
    const Identification better = identify(fit.lines, free.identify);
    if (better.fit.chi2_per_dof() < 0.7 * chi2) {
      doubts.push_back(doubt + "; terms are missing: with them up to the power " +
                       std::to_string(better.terms.highest_power) + " of s it is " +
                       text("%.3g", better.fit.chi2_per_dof()) + "; leave out --terms");
      return;
    }
  }
  doubts.push_back(doubt + "; a mode, a quantity or a unit may be wrong there, or the noise larger than it says");
}

/// Sentences on the form of the residues.
void doubt_residues(const ResponseFit& fit, const ResponseFitOptions& options, std::vector<std::string>& doubts) {
  const ModalFit& found = fit.found.fit;
  if (options.identify.residues == Residues::symmetric) {
    const ModalFit free = modal_fit(fit.lines, poles_of(found), {fit.found.terms, Residues::rank_one});
    const double chi2 = chi2_as_fitted(fit);
    if (chi2 > 1.3 * free.chi2_per_dof())
      doubts.push_back(
          "symmetric residues do not fit: chi2 a degree of freedom is " +
          text("%.3g with them and %.3g", chi2, free.chi2_per_dof()) +
          " with left and right vectors of their own; the structure is not reciprocal, or a sensor is turned");
  }
  if (options.identify.residues == Residues::free) return;
  for (const FittedMode& mode : found.modes) {
    if (mode.second_singular > 0.2)
      doubts.push_back("the mode at " + text("%.5g", mode.frequency_hz) +
                       " Hz is not of one shape (second singular value " + text("%.2g", mode.second_singular) +
                       " of the first): another mode may be close, see --residues free");
  }
}

/// The phase of 2iω_d R at the driving points, weighed by size: 0 of a receptance, ±90° of a mobility, 180° of an
/// accelerance or a sensor that is turned.
void doubt_quantity(const ResponseFit& fit, const dynamics::DofTable& responses, const dynamics::DofTable& forces,
                    std::vector<std::string>& doubts) {
  const dynamics::ResponseModel fitted = fitted_response(fit.found.fit, {fit.lines.hz}, responses, forces);
  for (const dynamics::Collocated& at : dynamics::driving_points(fitted)) {
    std::complex<double> sum = 0.0;
    for (const FittedMode& mode : fit.found.fit.modes) {
      const std::complex<double> A =
          at.sign * std::complex<double>(0.0, 2.0 * mode.pole().imag()) * mode.residue(at.row, at.column);
      sum += A * std::abs(mode.pole());  // by |H| at resonance, but for damping
    }
    const double degrees = std::arg(sum) * 180.0 / std::numbers::pi;
    if (std::abs(degrees) < 45.0) continue;
    doubts.push_back(
        name_of_entry(responses, forces, at.row, at.column) + " has modes of a phase of " + text("%.0f", degrees) +
        " degrees, where a receptance's have 0: it looks like " +
        (std::abs(degrees) > 135.0 ? "an accelerance, or a sensor or force that is turned" : "a mobility") +
        "; check quantity and direction");
  }
}

/// Sentences on energy that the model gives, and on what passivity cost where it was asked for.
void doubt_passivity(const ResponseFit& fit, const dynamics::DofTable& responses, const dynamics::DofTable& forces,
                     std::vector<std::string>& doubts) {
  constexpr double much = 1.3;
  const double chi2 = fit.found.fit.chi2_per_dof();
  if (fit.passive && chi2 > much * std::max(1.0, chi2_as_fitted(fit)))
    doubts.push_back("chi2 a degree of freedom is " +
                     text("%.3g of the passive model and %.3g", chi2, chi2_as_fitted(fit)) +
                     " without --passive: the lines themselves give energy by more than their noise; a quantity, a "
                     "direction or the phase of a sensor may be wrong");
  const dynamics::ResponseModel fitted = fitted_response(fit.found.fit, {fit.lines.hz}, responses, forces);
  if (fit.passive && fit.passive->after > 0.0)
    doubts.push_back("the model could not be made passive: it gives energy by " +
                     text("%.2g", 100.0 * fit.passive->after) +
                     " % of its size at a line; ask for fewer terms, or for symmetric residues");
  else if (const auto check = dynamics::passivity(fitted); check && !check->holds)
    doubts.push_back("the model gives energy at " + text("%.5g", check->frequency_hz) + " Hz, by " +
                     text("%.0f", 100.0 * check->figure) +
                     " % of its size, which no passive structure does; see --passive");
}

/// True if free residues are better than those of rank one by more than chance: noise gives a weak mode a second
/// singular value, too.
bool free_are_better(const ResponseFit& fit) {
  constexpr double chance = 3.0;  // χ² that an unknown takes from noise, at most
  const ModalFit& one = fit.found.fit;
  const ModalFit free = modal_fit(fit.lines, poles_of(one), {fit.found.terms, Residues::free});
  const double unknowns = one.degrees_of_freedom - free.degrees_of_freedom;
  return one.chi2 - free.chi2 > chance * unknowns * std::max(1.0, free.chi2_per_dof());
}

}  // namespace

std::vector<std::size_t> used_lines(const dynamics::ResponseModel& measured, const ResponseFitOptions& options) {
  std::vector<std::size_t> lines;
  for (Eigen::Index i = 0; i < measured.axis.size(); ++i) {
    if (is_used(measured.axis.hz(i), options)) lines.push_back(static_cast<std::size_t>(i));
  }
  if (lines.size() < fewest_lines)
    throw core::InputError(
        "the band holds " + std::to_string(lines.size()) + " lines above 0 Hz, must be at least 10; " +
        (measured.axis.size() == 0
             ? std::string("the file has none: measure again")
             : "widen it: the file has " + std::to_string(measured.axis.size()) + " from " +
                   text("%.6g to %.6g Hz", measured.axis.hz(0), measured.axis.hz(measured.axis.size() - 1))));
  return lines;
}

ResponseFit fit_of_any_rank(const dynamics::ResponseModel& measured, const std::vector<Eigen::MatrixXd>& coherence,
                            ResponseFitOptions& options) {
  constexpr double double_pole = 0.05;
  options.identify.residues = Residues::rank_one;
  ResponseFit fit = fit_response(measured, coherence, options);
  const bool simple = std::ranges::all_of(fit.found.fit.modes,
                                          [](const FittedMode& mode) { return mode.second_singular < double_pole; });
  if (simple || !free_are_better(fit)) return fit;
  options.identify.residues = Residues::free;
  return fit_response(measured, coherence, options);
}

std::vector<OrderPoles> stabilisation_diagram(const dynamics::ResponseModel& measured,
                                              const ResponseFitOptions& options) {
  dynamics::require_complete(measured);
  MeasuredLines lines = lines_of(measured, used_lines(measured, options));
  lines.variance = variance_from_scatter(lines.hz, lines.H, lines.H);
  const auto most = static_cast<int>(lines.lines() / 4);
  return plscf(lines, std::min(options.identify.highest_order, most));
}

ResponseFit fit_response(const dynamics::ResponseModel& measured, const std::vector<Eigen::MatrixXd>& coherence,
                         const ResponseFitOptions& options) {
  constexpr int passes = 3;
  dynamics::require_complete(measured);
  for (const double noise : options.noise.reshaped()) {
    if (!(noise > 0.0 && noise < 1.0))
      throw core::InputError("noise is " + text("%.3g", noise) +
                             ", must be above 0 and below 1; give it relative to |H|, 0.01 for 1 %");
  }
  const std::vector<std::size_t> used = used_lines(measured, options);
  ResponseFit result;
  result.lines = lines_of(measured, used);
  std::vector<Eigen::MatrixXd> of_lines;
  if (!coherence.empty()) {
    for (const std::size_t line : used) of_lines.push_back(coherence.at(line));
  }
  if (options.noise.size() > 0) result.weights = Weights::noise;
  else if (options.averages.size() > 0 && !coherence.empty()) result.weights = Weights::coherence;
  std::vector<Eigen::MatrixXcd> fitted;
  for (int pass = 0; pass < passes; ++pass) {
    result.lines.variance = variances(result, of_lines, fitted, options);
    IdentifyOptions of_pass = options.identify;
    of_pass.coarse = pass + 1 < passes;
    if (pass > 0) of_pass.start = poles_of(result.found.fit);
    Identification found = identify(result.lines, of_pass);
    if (pass > 0) {
      found.diagram = std::move(result.found.diagram);
      found.stable = std::move(result.found.stable);
      found.added += result.found.added;
      found.left_out += result.found.left_out;
    }
    result.found = std::move(found);
    fitted = values_of(result.found.fit, result.lines.hz);
  }
  if (options.passive) {
    PassiveFit passive =
        made_passive(result.found.fit, result.lines, measured.responses, measured.forces, options.identify.residues);
    result.found.fit = std::move(passive.fit);
    result.passive = passive.change;
    fitted = values_of(result.found.fit, result.lines.hz);
    result.found.fit.chi2 = chi2_of(result.lines, fitted);
  }
  result.misfit = misfit_of(result.lines, fitted);
  return result;
}

std::vector<std::string> doubts_about(const ResponseFit& fit, const dynamics::DofTable& responses,
                                      const dynamics::DofTable& forces, const ResponseFitOptions& options) {
  constexpr double uncertain = 0.2;
  std::vector<std::string> doubts;
  if (!fit.found.fit.converged) doubts.emplace_back("the search did not converge; narrow the band, or name the poles");
  doubt_misfit(fit, responses, forces, options, doubts);
  doubt_residues(fit, options, doubts);
  doubt_quantity(fit, responses, forces, doubts);
  doubt_passivity(fit, responses, forces, doubts);
  for (const FittedMode& mode : fit.found.fit.modes) {
    if (!std::isfinite(mode.sd_ln_frequency) || !std::isfinite(mode.sd_ln_damping)) {
      doubts.push_back(
          "the mode at " + text("%.5g", mode.frequency_hz) +
          " Hz has no interval: the lines do not tell it from another one; leave one of them out by --poles");
    } else if (1.96 * mode.sd_ln_damping > uncertain) {
      doubts.push_back("the damping of the mode at " + text("%.5g", mode.frequency_hz) + " Hz is known to " +
                       text("%.0f", 196.0 * mode.sd_ln_damping) + " % only");
    }
  }
  return doubts;
}

dynamics::ResponseModel fitted_response(const ModalFit& fit, const dynamics::FrequencyAxis& axis,
                                        const dynamics::DofTable& responses, const dynamics::DofTable& forces) {
  return {axis, responses, forces, values_of(fit, axis.hz)};
}

}  // namespace thinwall::identification
