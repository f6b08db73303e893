#include "fem/modes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "fem/error/error_of_orders.hpp"
#include "fem/free_motions.hpp"
#include "linalg/substructures/substructured_eigenpairs.hpp"

namespace thinwall::fem {

namespace {

/// Frequency in Hz of an eigenvalue in rad²/s²; 0 for a negative one, which is round-off of a rigid motion.
double hertz(double lambda) {
  return std::sqrt(std::max(lambda, 0.0)) / (2.0 * std::numbers::pi);
}

double lambda_of(double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  return omega * omega;
}

linalg::Eigenpairs by_block_lanczos(const Model& model, const Factored& factored, const ModeOptions& options,
                                    const Eigen::MatrixXd& start = {}) {
  if (options.up_to_hz)
    return linalg::eigenpairs_up_to(model.K, model.M, inverse_of(factored), lambda_of(*options.up_to_hz));
  return linalg::lowest_eigenpairs(model.K, model.M, inverse_of(factored), options.count + model.rigid_motions,
                                   options.inverse_residual, start);
}

/// Tells the number of substructures and the estimated error.
void tell(const linalg::SubstructuredPairs& found) {
  core::inform(fmt::format(
      "modes from {} substructures: {} modes of their own, {} of the {} rows between them, {} inverse iterations; "
      "frequencies are right to {:.1e} by estimate",
      found.domains, found.inner_modes, found.interface_modes, found.interface, found.steps,
      found.error.size() > 0 ? found.error.maxCoeff() : 0.0));
}

/// The pairs from substructures, or by block Lanczos where these do not give them: the factor is there.
linalg::Eigenpairs from_substructures(const Model& model, const Factored& factored, const ModeOptions& options) {
  linalg::SubstructureOptions wanted;
  wanted.count = options.count + model.rigid_motions;
  wanted.lambda_max = lambda_of(options.up_to_hz.value_or(0.0));
  wanted.domains = options.substructures;
  wanted.tolerance = substructures_error;
  if (!options.up_to_hz && 2 * static_cast<Eigen::Index>(wanted.count) > model.K.rows()) {
    core::inform(
        fmt::format("modes.substructures is left out at {} degrees of freedom, which are fewer than twice {} modes",
                    model.K.rows(), wanted.count));
    return by_block_lanczos(model, factored, options);
  }
  linalg::SubstructuredPairs found = linalg::substructured_eigenpairs(model.K, model.M, inverse_of(factored), wanted);
  if (found.pairs.status == linalg::EigenStatus::converged) {
    tell(found);
    return std::move(found.pairs);
  }
  core::warn(
      fmt::format("modes from {} substructures did not converge in {} inverse iterations; they are found by block "
                  "Lanczos, as without modes.substructures",
                  found.domains, found.steps));
  return by_block_lanczos(model, factored, options);
}

linalg::Eigenpairs solve(const Model& model, const Factored& factored, const ModeOptions& options,
                         const Eigen::MatrixXd& start) {
  return options.substructures > 0 ? from_substructures(model, factored, options)
                                   : by_block_lanczos(model, factored, options, start);
}

/// The round-off of eigenvalues, ε tr K / tr M, rad²/s². The entries of K are rounded at ε of those of the stiffest
/// elements, and so are the Rayleigh quotients of motions without stiffness: on free plates 100 to 800 times as wide as
/// thick, of orders 3 to 6, these are 0.4 to 0.9 of this bound.
double round_off(const Model& model) {
  return std::numeric_limits<double>::epsilon() * model.spectrum_rad2_s2;
}

/// The round-off of eigenvalues, ε tr K / tr M, with attachments included: the entries of a stiff clamp are rounded
/// too, and their round-off acts on motions that slide along it.
double round_off_attached(const Model& model) {
  return std::numeric_limits<double>::epsilon() * model.K.diagonal().sum() / model.M.diagonal().sum();
}

/// Throws NumericalError unless the number of modes without stiffness equals the number of free rigid motions. `noise`,
/// rad²/s², separates motions without stiffness from elastic ones.
void require_rigid_modes(const Model& model, const Eigen::VectorXd& lambda, double noise) {
  const Eigen::Index rigid = model.rigid_motions;
  const double largest = rigid > 0 ? lambda.head(rigid).cwiseAbs().maxCoeff() : 0.0;
  const double of_rigid = std::max({1e-6 * lambda(rigid), noise, 10.0 * round_off_attached(model)});
  if (largest <= of_rigid && lambda(rigid) > noise) return;
  throw core::NumericalError(
      (rigid > 0
           ? "a part that is free in " + std::to_string(rigid) + " rigid motions (" + listed(model.free_motions) + ")"
           : std::string("a part that is held")) +
      " shows modes that are neither rigid nor elastic, one at " + std::to_string(hertz(lambda(rigid))) +
      " Hz: the mesh may have pieces that hang together at a point or edge only, elements too thin for double "
      "precision, or materials of too unlike stiffness");
}

/// The result for converged pairs: frequencies, residuals, and the error that round-off of K may cause.
Modes described(const Model& model, linalg::Eigenpairs&& pairs) {
  Modes result;
  result.rigid_motions = model.rigid_motions;
  result.pairs = std::move(pairs);
  const auto& lambda = result.pairs.lambda;
  const int rigid = result.rigid_motions;
  const double noise = round_off(model);
  require_rigid_modes(model, lambda, 10.0 * noise);
  result.round_off = 0.5 * noise / lambda(rigid);
  result.residual = linalg::residuals(model.K, model.M, result.pairs);
  result.residual.head(rigid).setZero();
  result.frequency_hz = lambda.unaryExpr(&hertz);
  result.frequency_hz.head(rigid).setZero();
  return result;
}

}  // namespace

Modes modes(const Model& model, const Factored& factored, const ModeOptions& options, const Eigen::MatrixXd& start) {
  linalg::Eigenpairs pairs = solve(model, factored, options, start);
  if (pairs.status != linalg::EigenStatus::converged) {
    throw core::NumericalError("the part's modes did not converge (" + std::to_string(pairs.lambda.size()) +
                               " found): ask for fewer modes, or mesh more evenly");
  }
  if (pairs.lambda.size() <= model.rigid_motions) {
    throw core::InputError("no elastic mode lies below the frequency that was asked for; raise modes.up_to");
  }
  return described(model, std::move(pairs));
}

}  // namespace thinwall::fem
