#include "identification/identify.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace thinwall::identification {

namespace {

Eigen::VectorXcd with(const Eigen::VectorXcd& poles, std::complex<double> another) {
  Eigen::VectorXcd all(poles.size() + 1);
  all << poles, another;
  return all;
}

Eigen::VectorXcd without(const Eigen::VectorXcd& poles, Eigen::Index left_out) {
  Eigen::VectorXcd rest(poles.size() - 1);
  rest << poles.head(left_out), poles.tail(poles.size() - left_out - 1);
  return rest;
}

constexpr double chance_of_modes = 10.0, chance_of_powers = 3.0;  // χ² that chance takes from an unknown, at most

/// True if `richer`, which has more unknowns, is better than by chance.
bool better(const ModalFit& richer, const ModalFit& poorer, double chance = chance_of_modes) {
  const double unknowns = poorer.degrees_of_freedom - richer.degrees_of_freedom;
  return richer.converged && poorer.chi2 - richer.chi2 > chance * unknowns * std::max(1.0, richer.chi2_per_dof());
}

std::complex<double> pole(double omega, double zeta) {
  return {-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta)};
}

/// The pole whose residue is farthest from rank one, moved by half its width; none of a single reference.
std::optional<std::complex<double>> beside_the_least_simple(const ModalFit& fit) {
  const auto least = std::max_element(fit.modes.begin(), fit.modes.end(), [](const FittedMode& a, const FittedMode& b) {
    return a.second_singular < b.second_singular;
  });
  if (!(least->second_singular > 0.0)) return std::nullopt;
  const double omega = 2.0 * std::numbers::pi * least->frequency_hz;
  return pole(omega * (1.0 + least->damping_ratio), least->damping_ratio);
}

/// A pole at the line around which the fit is worst.
std::complex<double> at_the_worst_line(const MeasuredLines& measured, const ModalFit& fit) {
  const Eigen::Index lines = measured.lines(), around = std::max<Eigen::Index>(2, lines / 100);
  Eigen::VectorXd misfit(lines);
  for (Eigen::Index i = 0; i < lines; ++i) {
    const auto at = static_cast<std::size_t>(i);
    misfit(i) = ((measured.H[at] - value(fit, measured.hz(i))).array().abs2() / measured.variance[at].array()).mean();
  }
  Eigen::Index worst = 0;
  double largest = -1.0;
  for (Eigen::Index i = around; i + around < lines; ++i) {
    const double mean = misfit.segment(i - around, 2 * around + 1).mean();
    if (mean <= largest) continue;
    largest = mean;
    worst = i;
  }
  constexpr double usual_damping = 0.02;
  return pole(2.0 * std::numbers::pi * measured.hz(worst), usual_damping);
}

/// True if all modes lie in the band, ring, and are not narrower than what lines can tell: what else lowers χ² stands
/// for modes outside, as the residual terms do, or for the noise of a line.
bool all_in_band(const MeasuredLines& measured, const ModalFit& fit) {
  constexpr double heaviest = 0.5, narrowest = 0.25;  // the half width, in distances between lines
  const double distance =
      (measured.hz(measured.lines() - 1) - measured.hz(0)) / static_cast<double>(measured.lines() - 1);
  return std::all_of(fit.modes.begin(), fit.modes.end(), [&](const FittedMode& mode) {
    return mode.frequency_hz >= measured.hz(0) && mode.frequency_hz <= measured.hz(measured.lines() - 1) &&
           mode.damping_ratio < heaviest && mode.damping_ratio * mode.frequency_hz > narrowest * distance;
  });
}

/// Fits with a pole more until none is better than by chance.
int add_modes(const MeasuredLines& measured, const ModalFitOptions& options, ModalFit& fit) {
  constexpr int most = 12;
  int added = 0;
  while (added < most && fit.chi2_per_dof() > 1.0) {
    std::vector<std::complex<double>> candidates;
    if (const auto beside = beside_the_least_simple(fit)) candidates.push_back(*beside);
    candidates.push_back(at_the_worst_line(measured, fit));
    bool found = false;
    for (const std::complex<double>& candidate : candidates) {
      ModalFit richer = modal_fit(measured, with(poles_of(fit), candidate), options);
      if (!better(richer, fit) || !all_in_band(measured, richer)) continue;
      fit = std::move(richer);
      found = true;
      ++added;
      break;
    }
    if (!found) break;
  }
  return added;
}

/// The weighted size of a mode's share of the lines: an upper bound of what χ² rises by without it is not known before
/// a fit, but what is small here cannot raise it much.
double share(const MeasuredLines& measured, const FittedMode& mode) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < measured.lines(); ++i) {
    const std::complex<double> s(0.0, 2.0 * std::numbers::pi * measured.hz(i));
    const auto at = static_cast<std::size_t>(i);
    const Eigen::MatrixXcd H =
        mode.residue / (s - mode.pole()) + mode.residue.conjugate() / (s - std::conj(mode.pole()));
    sum += (H.array().abs2() / measured.variance[at].array()).sum();
  }
  return sum;
}

/// True if another pole lies within a quarter of the mode's half width: two may stand for one, with residues that
/// nearly cancel.
bool is_crowded(const ModalFit& fit, std::size_t mode) {
  const std::complex<double> here = fit.modes[mode].pole();
  for (std::size_t i = 0; i < fit.modes.size(); ++i) {
    if (i != mode && std::abs(fit.modes[i].pole() - here) < 0.25 * std::abs(here.real())) return true;
  }
  return false;
}

/// Leaves out modes that do no more than chance; only those of a small share, crowded ones, and those outside of the
/// band are tried.
int leave_modes_out(const MeasuredLines& measured, const ModalFitOptions& options, ModalFit& fit) {
  constexpr double small = 100.0;  // times the entries
  int left_out = 0;
  for (std::size_t i = 0; i < fit.modes.size() && fit.modes.size() > 1;) {
    const double entries = static_cast<double>(fit.modes[i].residue.size());
    const bool doubtful =
        fit.modes[i].damping_ratio > 0.3 || is_crowded(fit, i) || share(measured, fit.modes[i]) < small * entries ||
        fit.modes[i].frequency_hz < measured.hz(0) || fit.modes[i].frequency_hz > measured.hz(measured.lines() - 1);
    if (doubtful) {
      ModalFit poorer = modal_fit(measured, without(poles_of(fit), static_cast<Eigen::Index>(i)), options);
      if (!better(fit, poorer)) {
        fit = std::move(poorer);
        ++left_out;
        continue;
      }
    }
    ++i;
  }
  return left_out;
}

/// Adds powers of s as long as they do more than chance.
void add_powers(const MeasuredLines& measured, ModalFitOptions& options, ModalFit& fit) {
  constexpr int most = 5;
  while (options.terms.highest_power < most) {
    ModalFitOptions more = options;
    ++more.terms.highest_power;
    ModalFit richer = modal_fit(measured, poles_of(fit), more);
    if (!better(richer, fit, chance_of_powers)) return;
    options = more;
    fit = std::move(richer);
  }
}

/// The given poles, or the stable ones of the diagram.
Eigen::VectorXcd start_of(const MeasuredLines& measured, const IdentifyOptions& options, Identification& result) {
  if (options.poles.size() > 0) return options.poles;
  if (options.start.size() > 0) return options.start;
  const auto most = static_cast<int>(measured.lines() / 4);
  result.diagram = plscf(measured, std::min(options.highest_order, most));
  result.stable = stable_poles(result.diagram);
  if (result.stable.empty()) {
    throw core::InputError(
        "identification: no pole stays over the orders of the stabilisation diagram; widen the band, or name poles");
  }
  Eigen::VectorXcd start(static_cast<Eigen::Index>(result.stable.size()));
  for (std::size_t i = 0; i < result.stable.size(); ++i) start(static_cast<Eigen::Index>(i)) = result.stable[i].pole;
  return start;
}

}  // namespace

Identification identify(const MeasuredLines& measured, const IdentifyOptions& options) {
  Identification result;
  const Eigen::VectorXcd start = start_of(measured, options, result);
  ModalFitOptions fit_options;
  fit_options.residues = Residues::free;
  fit_options.coarse = true;
  if (options.terms) fit_options.terms = *options.terms;
  result.fit = modal_fit(measured, start, fit_options);
  if (!options.terms) add_powers(measured, fit_options, result.fit);
  if (options.poles.size() == 0) {
    result.added = add_modes(measured, fit_options, result.fit);
    result.left_out = leave_modes_out(measured, fit_options, result.fit);
  }
  if (!options.terms && result.added + result.left_out > 0) add_powers(measured, fit_options, result.fit);
  result.terms = fit_options.terms;
  if (options.coarse) return result;
  fit_options.coarse = false;
  fit_options.residues = options.residues;
  result.fit = modal_fit(measured, poles_of(result.fit), fit_options);
  return result;
}

}  // namespace thinwall::identification
