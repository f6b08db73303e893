#include "linalg/external_factor.hpp"

#include <utility>

namespace thinwall::linalg {

namespace {

Factoriser& factoriser_of_process() {
  static Factoriser factoriser;
  return factoriser;
}

}  // namespace

Factoriser set_factoriser(Factoriser factoriser) {
  return std::exchange(factoriser_of_process(), std::move(factoriser));
}

bool has_factoriser() {
  return static_cast<bool>(factoriser_of_process());
}

std::unique_ptr<ExternalFactor> external_factor(const SparseMatrix& A, const FactorOptions& options) {
  const Factoriser& factoriser = factoriser_of_process();
  return factoriser ? factoriser(A, options) : nullptr;
}

}  // namespace thinwall::linalg
