#include "reduction/trust/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "reduction/symmetric_part.hpp"

namespace thinwall::reduction {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;

/// The real eigenvalues μ of (K + αM)⁻¹ M that are not round-off of 0, with the symmetric parts of K and M.
std::vector<double> inverse_eigenvalues(const dynamics::SpatialModel& model, double alpha) {
  MatrixXd B = symmetric_part(model.K + alpha * model.M);
  const Eigen::VectorXd scale = B.cwiseAbs().rowwise().maxCoeff().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return {};  // a coordinate has neither mass nor stiffness
  B = (scale.asDiagonal() * B * scale.asDiagonal()).eval();
  const MatrixXd M = scale.asDiagonal() * symmetric_part(model.M) * scale.asDiagonal();
  std::vector<double> mu;
  // For λ ≥ 0 the largest possible μ is 1/α; smaller than 1e-13 of it are the μ of coordinates without mass, which are
  // zero but for round-off.
  const double zero = 1e-13 / alpha;
  const bool definite = B.llt().info() == Eigen::Success;
  if (definite) {
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(M, B, Eigen::EigenvaluesOnly);
    for (const double value : eigen.eigenvalues()) {
      if (std::abs(value) > zero) mu.push_back(value);
    }
    return mu;
  }
  const Eigen::EigenSolver<MatrixXd> eigen(MatrixXd(B.partialPivLu().solve(M)), false);
  for (const std::complex<double> value : eigen.eigenvalues()) {
    if (std::abs(value) > zero && std::abs(value.imag()) <= 1e-6 * std::abs(value)) mu.push_back(value.real());
  }
  return mu;
}

std::vector<double> squared_frequencies(const ReducedModel& model, double alpha) {
  std::vector<double> lambda;
  if (const auto* modal = std::get_if<dynamics::ModalModel>(&model)) {
    for (const int k : dynamics::oscillating_modes(*modal)) lambda.push_back(std::norm(modal->poles(k)));
  } else {
    for (const double mu : inverse_eigenvalues(std::get<dynamics::SpatialModel>(model), alpha))
      lambda.push_back(1.0 / mu - alpha);
  }
  return lambda;
}

double frequency_error(const Eigen::VectorXd& found, const Eigen::VectorXd& expected) {
  if (found.size() < expected.size()) return std::numeric_limits<double>::infinity();
  if (expected.size() == 0) return 0.0;
  return (found.head(expected.size()) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff();
}

}  // namespace

Eigen::VectorXd natural_frequencies_hz(const ReducedModel& model, int rigid, double about_hz) {
  const double omega = 2.0 * std::numbers::pi * about_hz;
  std::vector<double> lambda = squared_frequencies(model, omega * omega);
  std::sort(lambda.begin(), lambda.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  lambda.erase(lambda.begin(), lambda.begin() + std::min<std::ptrdiff_t>(rigid, std::ssize(lambda)));
  std::erase_if(lambda, [](double value) { return !(value > 0.0); });
  Eigen::VectorXd hz(static_cast<Index>(lambda.size()));
  for (Index k = 0; k < hz.size(); ++k)
    hz(k) = std::sqrt(lambda[static_cast<std::size_t>(k)]) / (2.0 * std::numbers::pi);
  return hz;
}

ComparisonRow compared(const Reduction& reduction, const BandTruth& truth, const Band& band) {
  const Eigen::VectorXd found = natural_frequencies_hz(reduction.model, truth.rigid_motions, band.to_hz);
  return {reduction.method,
          size(reduction),
          reduction.modes,
          frequency_error(found, truth.natural_hz),
          max_receptance_error(reduction.model, truth),
          reduction.seconds,
          reduction.status};
}

std::vector<ComparisonRow> compare(const FullModel& full, const Interface& interface, const Band& band, int size,
                                   const ReductionOptions& options) {
  const BandTruth truth = band_truth(full, interface, band);
  const int nb = static_cast<int>(interface.W.cols());
  ReductionOptions each = options;
  each.characteristic = std::min(options.characteristic, nb);
  std::vector<ComparisonRow> rows;
  for (const Method method : all_methods()) {
    if (method == Method::modal_truncation && truth.rigid_motions > 0) continue;
    each.modes =
        method == Method::guyan ? 0 : modes_for_size(method, size, nb, truth.rigid_motions, each.characteristic);
    if (each.modes < 0) continue;
    rows.push_back(compared(reduce(method, full, interface, each), truth, band));
  }
  return rows;
}

std::string text(const std::vector<ComparisonRow>& rows) {
  std::string table = "method                           size  modes  frequencies  receptance  seconds\n";
  for (const ComparisonRow& row : rows) {
    char line[160];
    const bool converged = row.status == linalg::EigenStatus::converged;
    std::snprintf(line, sizeof line, "%-31s %5d  %5d  %11.1e  %10.1e  %7.3f%s\n", name(row.method).c_str(), row.size,
                  row.modes, row.max_relative_frequency_error, row.max_relative_receptance_error, row.seconds,
                  converged ? "" : "  modes not converged");
    table += line;
  }
  return table;
}

}  // namespace thinwall::reduction
