// Chains and their diagnostics, against densities and processes whose figures are known.

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/draws.hpp"
#include "core/error.hpp"
#include "learning/chain_diagnostics.hpp"
#include "learning/surrogate_chains.hpp"

namespace thinwall::learning::chains_test {
namespace {

/// Chains of x_t = φ x_{t−1} + √(1 − φ²) ξ, whose draws are worth (1 − φ)/(1 + φ) independent ones each.
std::vector<Eigen::MatrixXd> correlated(double phi, Eigen::Index draws, double offset = 0.0) {
  std::mt19937 random(7);
  std::vector<Eigen::MatrixXd> chains;
  for (int c = 0; c < 4; ++c) {
    Eigen::MatrixXd chain(1, draws);
    double x = core::normal_draw(random);
    for (Eigen::Index t = 0; t < draws; ++t) {
      x = phi * x + std::sqrt(1.0 - phi * phi) * core::normal_draw(random);
      chain(0, t) = x + offset * c;
    }
    chains.push_back(chain);
  }
  return chains;
}

TEST(ChainDiagnostics, CountWhatCorrelatedDrawsAreWorth) {
  for (const double phi : {0.0, 0.5, 0.8}) {
    const ChainDiagnostics d = diagnose(correlated(phi, 4000));
    EXPECT_NEAR(d.effective_size(0) / (16000.0 * (1.0 - phi) / (1.0 + phi)), 1.0, 0.15) << phi;
    EXPECT_LT(d.r_hat(0), 1.01);
  }
}

TEST(ChainDiagnostics, TellChainsApartThatDrawFromElsewhere) {
  // Means 0, 1, 2, 3 of variance 1: their variance is 5/3, so that R̂ → √(1 + (5/3)(8/7)(3/4)) with eight halves.
  const double between = 5.0 / 3.0 * 0.75 * 8.0 / 7.0;
  EXPECT_NEAR(diagnose(correlated(0.0, 4000, 1.0)).r_hat(0), std::sqrt(1.0 + between), 0.03);
}

TEST(ChainDiagnostics, TellAnUnknownThatNeverMoved) {
  const ChainDiagnostics d = diagnose({Eigen::MatrixXd::Ones(1, 20), Eigen::MatrixXd::Ones(1, 20)});
  EXPECT_TRUE(std::isinf(d.r_hat(0)));
  EXPECT_EQ(d.effective_size(0), 1.0);
  EXPECT_THROW((void)diagnose({}), core::InputError);
  EXPECT_THROW((void)diagnose({Eigen::MatrixXd::Ones(1, 4)}), core::InputError);
}

struct Moments {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
};

Moments moments_of(const Chains& chains) {
  const Eigen::Index n = chains.draws.front().rows();
  Moments m{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n)};
  double count = 0.0;
  for (const Eigen::MatrixXd& chain : chains.draws) {
    m.mean += chain.rowwise().sum();
    m.covariance += chain * chain.transpose();
    count += static_cast<double>(chain.cols());
  }
  m.mean /= count;
  m.covariance = m.covariance / count - m.mean * m.mean.transpose();
  return m;
}

TEST(SurrogateChains, DrawFromTheDearDensityAlthoughTheCheapOneIsAnother) {
  // π is normal with mean (1, −2) and this covariance; the surrogate has another mean, and independent unknowns.
  Eigen::Matrix2d C;
  C << 1.0, 0.6, 0.6, 2.0;
  const Eigen::Vector2d mean(1.0, -2.0);
  Eigen::Matrix2d inverse;
  inverse << 2.0, -0.6, -0.6, 1.0;
  inverse /= 1.64;  // the determinant
  const LogDensity dear = [&](const Eigen::VectorXd& x) { return -0.5 * (x - mean).dot(inverse * (x - mean)); };
  const LogDensity cheap = [&](const Eigen::VectorXd& x) {
    return -0.5 * (std::pow(x(0) - 1.3, 2) / 1.2 + std::pow(x(1) + 1.8, 2) / 2.2);
  };
  ChainOptions options;
  options.draws = 4000;
  options.left_out = 200;
  const Chains chains = surrogate_chains(dear, cheap, {{mean, C}}, options);
  const Moments m = moments_of(chains);
  const ChainDiagnostics d = diagnose(chains.draws);
  for (int k = 0; k < 2; ++k) {
    EXPECT_NEAR(m.mean(k), mean(k), 4.0 * std::sqrt(C(k, k) / d.effective_size(k)));
    EXPECT_NEAR(m.covariance(k, k) / C(k, k), 1.0, 4.0 * std::sqrt(2.0 / d.effective_size(k)));
    EXPECT_LT(d.r_hat(k), 1.02);
  }
  EXPECT_NEAR(m.covariance(0, 1), 0.6, 0.12);  // four deviations of some 3000 draws
  EXPECT_GT(chains.accepted, 0.5);
}

TEST(SurrogateChains, DrawFromTheDearDensityWithFewCheapStepsAndARegionThatIsNarrow) {
  // π is standard normal. A jump that always ends the ten cheap steps makes the variance too large by 5 % here.
  constexpr Eigen::Index n = 6;
  const LogDensity dear = [](const Eigen::VectorXd& x) { return -0.5 * x.squaredNorm(); };
  const LogDensity cheap = [](const Eigen::VectorXd& x) { return -0.5 * (x.array() - 0.7).square().sum(); };
  const Region narrow{Eigen::VectorXd::Constant(n, 0.5), 0.36 * Eigen::MatrixXd::Identity(n, n)};
  ChainOptions options;
  options.draws = 20000;
  options.cheap_steps = 10;
  const Chains chains = surrogate_chains(dear, cheap, {narrow}, options);
  const Moments m = moments_of(chains);
  const double independent = n * diagnose(chains.draws).effective_size.mean();
  EXPECT_NEAR(m.mean.mean(), 0.0, 4.0 / std::sqrt(independent));
  EXPECT_NEAR(m.covariance.diagonal().mean(), 1.0, 4.0 * std::sqrt(2.0 / independent));
  // Of single cheap steps some are jumps alone, which tell no share of small steps.
  options.draws = 20;
  options.cheap_steps = 1;
  EXPECT_TRUE(std::isfinite(surrogate_chains(dear, cheap, {narrow}, options).draws[0].sum()));
}

TEST(SurrogateChains, GiveTwoMaximaApartTheirShares) {
  // Two normal distributions, eight deviations apart, of shares 0.7 and 0.3: no small step leads from one to the other.
  const Eigen::Vector2d a(-4.0, 0.0), b(4.0, 1.0);
  const LogDensity dear = [&](const Eigen::VectorXd& x) {
    return std::log(0.7 * std::exp(-0.5 * (x - a).squaredNorm()) + 0.3 * std::exp(-0.5 * (x - b).squaredNorm()));
  };
  const LogDensity cheap = [&](const Eigen::VectorXd& x) { return dear(x) + 0.3 * std::sin(x(0)); };
  ChainOptions options;
  options.draws = 500;
  const Chains chains =
      surrogate_chains(dear, cheap, {{a, Eigen::Matrix2d::Identity()}, {b, Eigen::Matrix2d::Identity()}}, options);
  double right = 0.0;
  for (const Eigen::MatrixXd& chain : chains.draws) right += (chain.row(0).array() > 0.0).count();
  const ChainDiagnostics d = diagnose(chains.draws);
  EXPECT_NEAR(right / 2000.0, 0.3, 4.0 * std::sqrt(0.21 / d.effective_size(0)));
  EXPECT_GT(d.effective_size(0), 400.0);
  EXPECT_LT(d.r_hat(0), 1.02);
}

TEST(SurrogateChains, AcceptEveryProposalWhereTheCheapDensityIsTheDearOne) {
  const LogDensity density = [](const Eigen::VectorXd& x) { return -0.5 * x.squaredNorm(); };
  ChainOptions options;
  options.draws = 300;
  const Chains chains =
      surrogate_chains(density, density, {{Eigen::VectorXd::Zero(3), Eigen::MatrixXd::Identity(3, 3)}}, options);
  EXPECT_EQ(chains.accepted, 1.0);
  EXPECT_NEAR(chains.cheap_accepted, 0.33, 0.1);
  const Chains again =
      surrogate_chains(density, density, {{Eigen::VectorXd::Zero(3), Eigen::MatrixXd::Identity(3, 3)}}, options);
  EXPECT_EQ(chains.draws[2], again.draws[2]);
}

TEST(SurrogateChains, RefuseWhatCannotBe) {
  const LogDensity density = [](const Eigen::VectorXd& x) { return -0.5 * x.squaredNorm(); };
  const Region mixed{Eigen::VectorXd::Zero(3), Eigen::MatrixXd::Identity(2, 2)};
  const Region negative{Eigen::VectorXd::Zero(2), -Eigen::MatrixXd::Identity(2, 2)};
  EXPECT_THROW((void)surrogate_chains(density, density, {mixed}, {}), core::InputError);
  EXPECT_THROW((void)surrogate_chains(density, density, {negative}, {}), core::InputError);
  EXPECT_THROW((void)surrogate_chains(density, density, {}, {}), core::InputError);
}

}  // namespace
}  // namespace thinwall::learning::chains_test
