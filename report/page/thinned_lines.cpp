#include "report/page/thinned_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace thinwall::report {

namespace {

/// |H_dd| of all responses at a line.
Eigen::VectorXd diagonal(const std::vector<const dynamics::ResponseModel*>& responses, std::size_t line) {
  std::vector<double> sizes;
  for (const auto* response : responses) {
    const Eigen::VectorXd own = response->H[line].diagonal().cwiseAbs();
    sizes.insert(sizes.end(), own.begin(), own.end());
  }
  return Eigen::VectorXd::Map(sizes.data(), std::ssize(sizes));
}

/// The lines of the stretch at which an entry is largest and smallest beside its mean.
std::pair<std::size_t, std::size_t> extremes(const std::vector<const dynamics::ResponseModel*>& responses,
                                             std::size_t from, std::size_t to) {
  Eigen::VectorXd mean = diagonal(responses, from);
  for (std::size_t line = from + 1; line < to; ++line) mean += diagonal(responses, line);
  mean = (mean / static_cast<double>(to - from)).cwiseMax(1e-300);
  std::pair<std::size_t, std::size_t> found{from, from};
  double highest = 0.0, lowest = INFINITY;
  for (std::size_t line = from; line < to; ++line) {
    const Eigen::VectorXd share = diagonal(responses, line).cwiseQuotient(mean);
    if (share.maxCoeff() > highest) {
      highest = share.maxCoeff();
      found.first = line;
    }
    if (share.minCoeff() < lowest) {
      lowest = share.minCoeff();
      found.second = line;
    }
  }
  return found;
}

}  // namespace

std::vector<std::size_t> thinned_lines(const std::vector<const dynamics::ResponseModel*>& responses, std::size_t most) {
  const std::size_t lines = responses.front()->H.size();
  std::vector<std::size_t> all(lines);
  std::iota(all.begin(), all.end(), std::size_t{0});
  if (lines <= std::max<std::size_t>(4, most)) return all;
  const std::size_t stretches = (std::max<std::size_t>(4, most) - 2) / 2;
  std::set<std::size_t> kept{0, lines - 1};
  for (std::size_t i = 0; i < stretches; ++i) {
    const auto [high, low] = extremes(responses, i * lines / stretches, (i + 1) * lines / stretches);
    kept.insert({high, low});
  }
  return {kept.begin(), kept.end()};
}

}  // namespace thinwall::report
