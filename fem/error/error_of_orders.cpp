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

/// The error of the last order over the last change: r / (1 − r) by the law of error_ratio(). Beside a re-entrant edge
/// the last two changes on one mesh may have a ratio q below r. Then the change has a smooth share, too, which falls by
/// ρ = 1/30 an order, the most that was seen, where the singular one falls by r (docs/theory/elements.md): of the last
/// change the share s = r (q − ρ) / (q (r − ρ)) is singular, and the error is s r / (1 − r) + (1 − s) ρ / (1 − ρ), at
/// least as the other edges have it. Changes of orders below `usual_order` do not tell q, for at the lowest orders thin
/// walls are locked.
double error_over_change(const std::vector<RefinementStep>& steps, std::optional<double> RefinementStep::*change,
                         const Exponent& exponent, int usual_order) {
  constexpr double smooth = 1.0 / 30.0;
  const RefinementStep& last = steps.back();
  const double r = error_ratio(last.order, exponent.least), others = error_ratio(last.order, exponent.otherwise);
  const double singular = r / (1.0 - r);
  const RefinementStep* lower = usual_step_before(steps, usual_order);
  const double before = lower != nullptr ? (lower->*change).value_or(0.0) : 0.0;
  const double q = before > 0.0 ? (last.*change).value_or(0.0) / before : r;
  const double share = q > smooth ? std::min(1.0, r * (q - smooth) / (q * (r - smooth))) : 0.0;
  const double error = share * singular + (1.0 - share) * smooth / (1.0 - smooth);
  return std::max(error, std::min(singular, others / (1.0 - others)));
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
                                             int usual_order) {
  const RefinementStep& last = steps.back();
  const double f = error_over_change(steps, &RefinementStep::frequency_change, exponent.frequency, usual_order);
  const double r = error_over_change(steps, &RefinementStep::receptance_change, exponent.receptance, usual_order);
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
