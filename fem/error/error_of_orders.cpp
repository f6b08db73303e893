#include "fem/error/error_of_orders.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace thinwall::fem {

namespace {

/// The ratio r of the error at `order` to the error at the order below it (docs/theory/elements.md). Beside an edge of
/// exponent λ the error is that of the squares of the coefficients above the order p, Σ_{k>p} k^(−4λ−1), which is (p +
/// ½)^−4λ up to a factor. The law holds for high orders only; its values below 1/2 are not trusted.
double error_ratio(int order, double exponent) {
  return std::max(0.5, std::pow((order - 0.5) / (order + 0.5), 4.0 * exponent));
}

/// The largest ratio of two changes that is taken for that of the errors. No edge is known whose law is above 0.72 at
/// order 6 (λ = 1/2, a crack), so that beyond 0.9 the changes follow none; nine times the last one is then the error.
constexpr double largest_ratio = 0.9;

/// The ratio q of the last two changes on one mesh; none where one of them is not known. Changes of orders below
/// `usual_order` do not tell it, for at the lowest orders thin walls are locked.
std::optional<double> ratio_of_changes(const std::vector<RefinementStep>& steps,
                                       std::optional<double> RefinementStep::*change, int usual_order) {
  const RefinementStep* lower = usual_step_before(steps, usual_order);
  const double before = lower != nullptr ? (lower->*change).value_or(0.0) : 0.0;
  if (!(before > 0.0)) return {};
  return (steps.back().*change).value_or(0.0) / before;
}

/// The error of the last order over the last change: r / (1 − r) by the law of error_ratio(), where the last two
/// changes on one mesh have no other ratio q. A q above r is taken for that of the errors (Aitken 1926): the law is
/// then that of something slower, such as the torsion of a strip that one element spans. Beside a re-entrant edge q may
/// be below r. Then the change has a smooth share, too, which falls by ρ = 1/30 an order, the most that was seen, where
/// the singular one falls by r (docs/theory/elements.md): of the last change the share s = r (q − ρ) / (q (r − ρ)) is
/// singular, and the error is s r / (1 − r) + (1 − s) ρ / (1 − ρ), at least as the other edges have it. Before q is
/// known, r is at least that of `untold`. On a mesh with rows at its edges the smooth share leads at first: r is that
/// of the other edges there, and ρ is 1/10, for its elements are no longer large beside an edge.
double error_over_change(const std::vector<RefinementStep>& steps, std::optional<double> RefinementStep::*change,
                         const Exponent& exponent, const Untold& untold) {
  const double smooth = untold.has_rows ? 1.0 / 10.0 : 1.0 / 30.0;
  const RefinementStep& last = steps.back();
  const double r = error_ratio(last.order, exponent.least), others = error_ratio(last.order, exponent.otherwise);
  const auto of_ratio = [](double ratio) { return ratio / (1.0 - ratio); };
  const std::optional<double> told = ratio_of_changes(steps, change, untold.usual_order);
  if (!told) return of_ratio(std::max(untold.has_rows ? others : r, untold.ratio));
  const double q = *told;
  if (q > r) return of_ratio(std::max(r, std::min(q, largest_ratio)));
  const double share = q > smooth ? r * (q - smooth) / (q * (r - smooth)) : 0.0;
  const double error = share * of_ratio(r) + (1.0 - share) * of_ratio(smooth);
  return std::max(error, std::min(of_ratio(r), of_ratio(others)));
}

/// The factor by which the levels left reduce an error at best, q²ⁿ with q ≤ 1 the ratio of the last change to that of
/// the same order on the level before; 0, for all is open, if that order was not solved there.
double factor_of_levels(const std::vector<RefinementStep>& steps, std::optional<double> RefinementStep::*change,
                        int left) {
  const RefinementStep& last = steps.back();
  const auto before = std::ranges::find_if(
      steps, [&](const RefinementStep& s) { return s.level == last.level - 1 && s.order == last.order && s.*change; });
  if (before == steps.end() || !(last.*change)) return 0.0;
  return std::pow(std::min(1.0, *(last.*change) / *((*before).*change)), 2 * left);
}

}  // namespace

const RefinementStep* usual_step_before(const std::vector<RefinementStep>& steps, int usual_order) {
  if (steps.size() < 2) return nullptr;
  const RefinementStep& before = steps[steps.size() - 2];
  return before.level == steps.back().level && before.order >= usual_order ? &before : nullptr;
}

std::pair<Errors, Errors> errors_of_last_two(const std::vector<RefinementStep>& steps, const Exponents& exponent,
                                             const Untold& untold) {
  const RefinementStep& last = steps.back();
  const double f = error_over_change(steps, &RefinementStep::frequency_change, exponent.frequency, untold);
  const double r = error_over_change(steps, &RefinementStep::receptance_change, exponent.receptance, untold);
  const double frequency = last.frequency_change.value_or(0.0), receptance = last.receptance_change.value_or(0.0);
  const double entry = last.entry_change.value_or(0.0);
  return {{(1.0 + f) * frequency, (1.0 + r) * receptance, (1.0 + r) * entry, last.worst_receptance},
          {f * frequency, r * receptance, r * entry, last.worst_receptance}};
}

double error_after(int left, const Errors& errors, const std::vector<RefinementStep>& steps) {
  return std::max(errors.frequency * factor_of_levels(steps, &RefinementStep::frequency_change, left),
                  errors.receptance * factor_of_levels(steps, &RefinementStep::receptance_change, left));
}

}  // namespace thinwall::fem
