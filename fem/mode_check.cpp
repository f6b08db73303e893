#include "fem/mode_check.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::fem {

namespace {

using linalg::EigenCheckStatus;

std::string in_hertz(double lambda) {
  return core::number_text(std::sqrt(std::max(lambda, 0.0)) / (2.0 * std::numbers::pi), 8) + " Hz";
}

std::string missed_or_too_many(const linalg::EigenpairCheck& check) {
  return std::to_string(check.below) + " modes were found below " + in_hertz(check.shift) +
         ", where the Sturm count of K - sM shows " + std::to_string(check.counted) + ": ask for a few more modes";
}

std::string apart(const linalg::EigenpairCheck& check) {
  const std::string mode = "mode " + std::to_string(check.pair + 1) + " at " + in_hertz(check.lambda);
  const std::string other = in_hertz(check.other_lambda);
  return (check.second_alone ? "Spectra's Lanczos finds a mode at " + other + ", to which the nearest is " + mode
                             : mode + " is not confirmed by Spectra's Lanczos, whose nearest is at " + other) +
         ": the eigenvalues differ by " + core::number_text(check.largest_difference, 2) + " relative, more than " +
         core::number_text(check.tolerance, 2);
}

std::string fault(const linalg::EigenpairCheck& check) {
  switch (check.status) {
    case EigenCheckStatus::count_differs:
      return missed_or_too_many(check);
    case EigenCheckStatus::values_differ:
      return apart(check);
    case EigenCheckStatus::ill_conditioned:
      return "ill-conditioned: no shift near the last mode gave a factor whose pivots can be counted; ask for another "
             "number of modes";
    case EigenCheckStatus::not_finite:
      return "an eigenvalue is not a finite number; look for material constants that are far out of scale";
    case EigenCheckStatus::not_converged:
      return "Spectra's Lanczos did not converge; ask for fewer modes";
    case EigenCheckStatus::agrees:
      break;
  }
  return "";
}

}  // namespace

linalg::EigenpairCheck check_modes(const Model& model, const Factored& factored, const Modes& modes) {
  return linalg::check_eigenpairs(model.K, model.M, inverse_of(factored), modes.pairs, model.node_of_row);
}

void require_agreement(const linalg::EigenpairCheck& check) {
  if (check.status == EigenCheckStatus::agrees) return;
  throw core::NumericalError("the check of the part's modes (modes.verify) fails: " + fault(check));
}

void verify(const Model& model, const Factored& factored, Modes& modes) {
  const linalg::EigenpairCheck check = check_modes(model, factored, modes);
  require_agreement(check);
  modes.check = check;
}

}  // namespace thinwall::fem
