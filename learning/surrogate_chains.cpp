#include "learning/surrogate_chains.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "core/dense_factorisations.hpp"
#include "core/draws.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"

namespace thinwall::learning {

namespace {

using Eigen::Index;

/// Of small steps that are taken, to which their size adapts.
constexpr double wanted_share = 0.33;

/// A uniform number in (0, 1), the same on every machine.
double uniform(std::mt19937& random) {
  return (static_cast<double>(random()) + 0.5) / (static_cast<double>(std::mt19937::max()) + 1.0);
}

/// A place with both densities.
struct Place {
  Eigen::VectorXd x;
  double dear = 0.0, cheap = 0.0;
};

/// Normal distributions, each with the same share.
class Mixture {
 public:
  explicit Mixture(const std::vector<Region>& regions) {
    for (const Region& region : regions) {
      const Eigen::LLT<Eigen::MatrixXd> factors(region.covariance);
      if (factors.info() != Eigen::Success) throw core::InputError("chains: a covariance is not positive definite");
      parts_.push_back({region.mean, factors.matrixL()});
    }
  }

  /// L ξ of the part with that number.
  [[nodiscard]] Eigen::VectorXd step(std::size_t part, std::mt19937& random) const {
    Eigen::VectorXd xi(parts_[part].mean.size());
    for (double& entry : xi) entry = core::normal_draw(random);
    return parts_[part].L * xi;
  }

  [[nodiscard]] Eigen::VectorXd around(std::size_t part, double wider, std::mt19937& random) const {
    return parts_[part].mean + wider * step(part, random);
  }

  [[nodiscard]] std::size_t some_part(std::mt19937& random) const {
    return std::min(parts_.size() - 1, static_cast<std::size_t>(uniform(random) * static_cast<double>(parts_.size())));
  }

  /// ln of the density with deviations that are wider, up to a constant.
  [[nodiscard]] double log_density(const Eigen::VectorXd& x, double wider) const {
    std::vector<double> terms;
    for (const Part& part : parts_) {
      const Eigen::VectorXd y = part.L.triangularView<Eigen::Lower>().solve(x - part.mean) / wider;
      terms.push_back(-0.5 * y.squaredNorm() - part.L.diagonal().array().log().sum());
    }
    const double most = *std::ranges::max_element(terms);
    double sum = 0.0;
    for (const double term : terms) sum += std::exp(term - most);
    return most + std::log(sum);
  }

 private:
  struct Part {
    Eigen::VectorXd mean;
    Eigen::MatrixXd L;
  };
  std::vector<Part> parts_;
};

/// One chain on its way.
struct Chain {
  const LogDensity& dear;
  const LogDensity& cheap;
  const Mixture& mixture;
  std::mt19937 random;
  double scale = 0.0;
  Place at = {};
  long cheap_tried = 0, cheap_taken = 0, tried = 0, taken = 0;

  [[nodiscard]] Eigen::VectorXd small_step() { return scale * mixture.step(mixture.some_part(random), random); }

  [[nodiscard]] bool accept(double log_ratio) { return std::log(uniform(random)) < log_ratio; }

  /// A step to a draw of the mixture; true if it was taken.
  bool jump(Place& place) {
    constexpr double wider = 1.2;
    const Eigen::VectorXd x = mixture.around(mixture.some_part(random), wider, random);
    const double there = cheap(x);
    if (!accept(there - place.cheap + mixture.log_density(place.x, wider) - mixture.log_density(x, wider)))
      return false;
    place = {x, place.dear, there};
    return true;
  }

  /// A step of random-walk Metropolis on the cheap density; true if it was taken.
  bool walk(Place& place) {
    const Eigen::VectorXd x = place.x + small_step();
    const double there = cheap(x);
    if (!accept(there - place.cheap)) return false;
    place = {x, place.dear, there};
    return true;
  }

  /// Steps on the cheap density, each a jump with a probability of one in ten, so that any sequence of them is as
  /// likely as its reverse, as acceptance needs; the share of the others that was taken.
  double wander(Place& place, int steps) {
    int moved = 0, walked = 0;
    for (int i = 0; i < steps; ++i) {
      if (uniform(random) < 0.1) {
        jump(place);
        continue;
      }
      ++walked;
      if (walk(place)) ++moved;
    }
    cheap_tried += walked;
    cheap_taken += moved;
    return walked > 0 ? static_cast<double>(moved) / walked : wanted_share;
  }

  /// A step of random-walk Metropolis on the dear density.
  void step_dear() {
    Place proposed{at.x + small_step(), 0.0, 0.0};
    proposed.dear = dear(proposed.x);
    proposed.cheap = cheap(proposed.x);
    if (accept(proposed.dear - at.dear)) at = proposed;
  }

  /// One draw; the share of cheap steps that were taken.
  double advance(int steps) {
    Place proposed = at;
    const double share = wander(proposed, steps);
    if (proposed.x == at.x) return share;
    ++tried;
    proposed.dear = dear(proposed.x);
    if (accept(proposed.dear - at.dear + at.cheap - proposed.cheap)) {
      at = proposed;
      ++taken;
    }
    return share;
  }
};

void require_usable(const std::vector<Region>& regions, const ChainOptions& options) {
  const bool well = options.chains > 0 && options.draws > 0 && options.left_out >= 0 && options.cheap_steps > 0;
  if (!well) throw core::InputError("chains: their number, draws and steps must be above 0; raise them");
  if (regions.empty()) throw core::InputError("chains: there is no region to begin in; give one at least");
  const Index n = regions.front().mean.size();
  for (const Region& region : regions)
    if (region.mean.size() != n || region.covariance.rows() != n || region.covariance.cols() != n)
      throw core::InputError("chains: means and covariances must have as many rows and columns as there are unknowns");
}

}  // namespace

Chains surrogate_chains(const LogDensity& dear, const LogDensity& cheap, const std::vector<Region>& regions,
                        const ChainOptions& options) {
  constexpr int plain_every = 4;
  require_usable(regions, options);
  const Mixture mixture(regions);
  const Index n = regions.front().mean.size();
  const auto count = static_cast<std::size_t>(options.chains);
  Chains result{std::vector<Eigen::MatrixXd>(count, Eigen::MatrixXd(n, options.draws)), 0.0, 0.0};
  std::vector<double> accepted(count), cheap_accepted(count);
  core::Progress progress("draws of the posterior", count * static_cast<std::size_t>(options.draws + options.left_out));
  core::parallel_for(count, [&](std::size_t c) {
    Chain chain{dear, cheap, mixture, std::mt19937(options.seed + static_cast<unsigned>(c)),
                2.4 / std::sqrt(static_cast<double>(n))};
    const Eigen::VectorXd start = mixture.around(c % regions.size(), 1.5, chain.random);
    chain.at = {start, dear(start), cheap(start)};
    for (int i = -options.left_out; i < options.draws; ++i) {
      if (i % plain_every == 0) chain.step_dear();
      const double share = chain.advance(options.cheap_steps);
      if (i < 0) chain.scale *= std::exp(0.5 * (share - wanted_share));
      if (i == 0) chain.tried = chain.taken = 0;
      if (i >= 0) result.draws[c].col(i) = chain.at.x;
      progress.step();
    }
    accepted[c] = static_cast<double>(chain.taken) / static_cast<double>(std::max(1L, chain.tried));
    cheap_accepted[c] = static_cast<double>(chain.cheap_taken) / static_cast<double>(std::max(1L, chain.cheap_tried));
  });
  for (std::size_t c = 0; c < count; ++c) {
    result.accepted += accepted[c] / static_cast<double>(count);
    result.cheap_accepted += cheap_accepted[c] / static_cast<double>(count);
  }
  return result;
}

}  // namespace thinwall::learning
