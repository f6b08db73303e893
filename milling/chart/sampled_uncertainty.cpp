#include "milling/chart/sampled_uncertainty.hpp"

#include <cmath>
#include <random>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;
using Matrix9cd = Eigen::Matrix<complex<double>, 9, 9>;
using Vector9cd = Eigen::Matrix<complex<double>, 9, 1>;

void require_covariances(const SampleCovariance& covariance, std::size_t lines) {
  const auto fail = [](const std::string& what) { throw core::InputError("scatter of a limiting depth: " + what); };
  if (covariance.size() != lines) {
    fail(std::to_string(covariance.size()) + " covariances for " + std::to_string(lines) + " lines; give one a line");
  }
  for (std::size_t line = 0; line < lines; ++line) {
    const Matrix9cd& of = covariance[line];
    const bool well = of.allFinite() && (of - of.adjoint()).norm() <= 1e-9 * of.norm();
    if (!well) fail("the covariance of line " + std::to_string(line + 1) + " is not finite and Hermitian");
  }
}

/// F with F Fᴴ = the covariance.
Matrix9cd factor(const Matrix9cd& covariance, std::size_t line) {
  const Eigen::SelfAdjointEigenSolver<Matrix9cd> eigen(covariance);
  if (!(eigen.eigenvalues()(0) >= -1e-9 * eigen.eigenvalues()(8))) {
    throw core::InputError("scatter of a limiting depth: the covariance of line " + std::to_string(line + 1) +
                           " has a negative eigenvalue");
  }
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).cwiseSqrt().asDiagonal();
}

/// The structure with noise on its lines: the poles of the fit stay, and the remainder takes the noise.
FittedStructure drawn(FittedStructure structure, const std::vector<Matrix9cd>& factors, std::uint64_t seed) {
  SampledReceptance& remainder = structure.all.remainder;
  if (remainder.H.empty())
    remainder = {structure.lines.samples.frequency_hz, {factors.size(), Eigen::Matrix3cd::Zero()}};
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> normal(0.0, std::sqrt(0.5));
  for (std::size_t line = 0; line < factors.size(); ++line) {
    Vector9cd z;
    for (complex<double>& entry : z) {
      const double real = normal(generator);
      entry = {real, normal(generator)};
    }
    const Vector9cd v = factors[line] * z;
    remainder.H[line] += v.reshaped<Eigen::ColMajor>(3, 3);
  }
  return structure;
}

}  // namespace

double depth_deviation_m(const std::vector<Eigen::Matrix3cd>& gradient, const SampleCovariance& covariance) {
  require_covariances(covariance, gradient.size());
  double variance = 0.0;
  for (std::size_t line = 0; line < gradient.size(); ++line) {
    const Vector9cd g = gradient[line].reshaped();
    variance += 0.5 * (g.transpose() * covariance[line] * g.conjugate()).value().real();
  }
  return std::sqrt(std::max(variance, 0.0));
}

DepthScatter sampled_depths(const FittedStructure& structure, const MillingProcess& process, double spindle_speed_rpm,
                            const StabilityOptions& options, const SampleCovariance& covariance, int samples,
                            std::uint64_t seed) {
  require_covariances(covariance, structure.lines.samples.H.size());
  if (samples < 2) {
    throw core::InputError("scatter of a limiting depth: " + std::to_string(samples) + " samples; take at least 2");
  }
  std::vector<Matrix9cd> factors;
  for (std::size_t line = 0; line < covariance.size(); ++line) factors.push_back(factor(covariance[line], line));
  std::vector<LobeRow> rows(static_cast<std::size_t>(samples));
  core::Progress progress("draws of the noise", rows.size());
  core::parallel_for(rows.size(), [&](std::size_t i) {
    rows[i] = limiting_depth(drawn(structure, factors, seed + i), process, spindle_speed_rpm, options);
    progress.step();
  });
  DepthScatter scatter;
  double sum = 0.0, squares = 0.0;
  int counted = 0;
  for (const LobeRow& row : rows) {
    scatter.depth_m.push_back(row.limiting_depth_m);
    if (row.at_limit || row.status == StabilityStatus::crossing_missed) {
      ++scatter.without_limit;
      continue;
    }
    ++counted;
    const double off = row.limiting_depth_m - sum / std::max(1, counted - 1);  // Welford's recurrence
    sum += row.limiting_depth_m;
    squares += off * (row.limiting_depth_m - sum / counted);
  }
  if (counted > 0) scatter.mean_m = sum / counted;
  if (counted > 1) scatter.deviation_m = std::sqrt(squares / (counted - 1));
  return scatter;
}

}  // namespace thinwall::milling
