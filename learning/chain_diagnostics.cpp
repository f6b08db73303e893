#include "learning/chain_diagnostics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;

/// The halves of the chains of one unknown, a column each.
Eigen::MatrixXd halves_of(const std::vector<Eigen::MatrixXd>& chains, Index unknown) {
  const Index half = chains.front().cols() / 2;
  Eigen::MatrixXd halves(half, 2 * std::ssize(chains));
  for (std::size_t c = 0; c < chains.size(); ++c) {
    const auto k = 2 * static_cast<Index>(c);
    halves.col(k) = chains[c].row(unknown).head(half).transpose();
    halves.col(k + 1) = chains[c].row(unknown).tail(half).transpose();
  }
  return halves;
}

/// Mean over the sequences of the squared difference of draws t apart: their variogram.
double variogram(const Eigen::MatrixXd& sequences, Index t) {
  const Index n = sequences.rows();
  return (sequences.bottomRows(n - t) - sequences.topRows(n - t)).squaredNorm() /
         static_cast<double>(sequences.cols() * (n - t));
}

struct OneUnknown {
  double r_hat = std::numeric_limits<double>::infinity();
  double effective_size = 1.0;
};

OneUnknown diagnose_one(const Eigen::MatrixXd& sequences) {
  const Index rows = sequences.rows();
  const auto n = static_cast<double>(rows);
  const auto m = static_cast<double>(sequences.cols());
  const Eigen::RowVectorXd means = sequences.colwise().mean();
  const double within = (sequences.rowwise() - means).squaredNorm() / (m * (n - 1.0));
  const double between = (means.array() - means.mean()).square().sum() / (m - 1.0);  // B/n
  if (!(within > 0.0)) return {};
  const double variance = (n - 1.0) / n * within + between;
  double pairs = 0.0;
  const auto correlation = [&](Index t) { return 1.0 - variogram(sequences, t) / (2.0 * variance); };
  // Sums of two neighbours, the first of them at 0, are positive and fall for every reversible chain (Geyer 1992).
  for (Index t = 0; t + 1 < rows; t += 2) {
    const double pair = (t == 0 ? 1.0 : correlation(t)) + correlation(t + 1);
    if (pair < 0.0) break;
    pairs += pair;
  }
  // A single negative pair at once would be a size above that of independent draws, which is the most here.
  const double time = std::max(1.0, 2.0 * pairs - 1.0);
  return {std::sqrt(variance / within), m * n / time};
}

}  // namespace

ChainDiagnostics diagnose(const std::vector<Eigen::MatrixXd>& chains) {
  const bool alike = !chains.empty() && std::ranges::all_of(chains, [&](const Eigen::MatrixXd& chain) {
    return chain.rows() == chains.front().rows() && chain.cols() == chains.front().cols();
  });
  if (!alike || chains.front().cols() < 8)
    throw core::InputError("diagnosis of chains: they must be of one shape and have 8 draws at least; draw more");
  const Index unknowns = chains.front().rows();
  ChainDiagnostics result{Eigen::VectorXd(unknowns), Eigen::VectorXd(unknowns)};
  for (Index k = 0; k < unknowns; ++k) {
    const OneUnknown one = diagnose_one(halves_of(chains, k));
    result.r_hat(k) = one.r_hat;
    result.effective_size(k) = one.effective_size;
  }
  return result;
}

}  // namespace thinwall::learning
