// Semi- and full-discretization against the exact values of the benchmark, closed forms, and their orders.

#include <gtest/gtest.h>

#include <cmath>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "milling/classical/uniform_step_stability.hpp"
#include "milling/direct/stability.hpp"
#include "tests/milling/benchmark.hpp"

namespace thinwall::milling::uniform_step_test {
namespace {

using testing::benchmark_process;
using testing::benchmark_structure;
using testing::modal_model;
using testing::Reference;
using testing::references;

const std::vector<testing::Mode> three_modes{{212.0, 0.01, 0.5, Eigen::Vector3d(1.0, 0.2, 0.1)},
                                             {567.0, 0.02, 0.3, Eigen::Vector3d(0.8, -0.3, 0.0)},
                                             {1800.0, 0.01, 0.2, Eigen::Vector3d(0.5, 0.9, 0.4)}};

const std::vector<StepRule> all_rules{semi_discretization(0), semi_discretization(1), semi_discretization(2),
                                      full_discretization(1), full_discretization(2), full_discretization(3)};

std::string name_of(StepRule rule) {
  return rule.full ? "full-discretization of order " + std::to_string(rule.state_order)
                   : "semi-discretization of order " + std::to_string(rule.delayed_order);
}

MillingProcess wall_cut() {
  MillingProcess process;
  process.cutter = {6, 0.016};
  process.coefficients = {2e9, 0.8e9, 0.3e9, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, 0.2e-3, MillingDirection::down);
  return process;
}

UniformStepMap map_at(const RelativeStructure& structure, const MillingProcess& process, double rpm, double depth_m,
                      int steps, StepRule rule) {
  const ContactState state = contact_state(structure, process.frame);
  UniformStepMap map(state, steps, tooth_period_s(process.cutter, rpm), rule);
  map.set_depth(depth_m, step_coefficients(process, state.in_plane, steps, rule, depth_m));
  return map;
}

double modulus(const UniformStepMap& map) {
  return std::abs(map.dominant().value);
}

bool first_order(StepRule rule) {
  return !rule.full && rule.delayed_order == 0;
}

/// Errors at m, 2m and 4m: the order between the last two, and the limit of a Richardson ladder through all three for
/// errors of orders `order` and the next.
struct Ladder {
  double order = 0.0;
  double limit = 0.0;
};

template <class OfSteps>
Ladder ladder(int steps, int order, double exact, const OfSteps& of_steps) {
  const double a = of_steps(steps);
  const double b = of_steps(2 * steps);
  const double c = of_steps(4 * steps);
  const double first = std::exp2(order);
  const double ab = (first * b - a) / (first - 1.0);
  const double bc = (first * c - b) / (first - 1.0);
  return {std::log2(std::abs((b - exact) / (c - exact))), (2.0 * first * bc - ab) / (2.0 * first - 1.0)};
}

TEST(UniformStepMap, WithoutDepthTheMultiplierIsTheSlowestFreeDecay) {
  const RelativeStructure structure = relative_structure(modal_model(three_modes), "P");
  const double slowest = 0.01 * 2.0 * std::numbers::pi * 212.0;
  const double exact = std::exp(-slowest * tooth_period_s(wall_cut().cutter, 1900.0));
  for (const StepRule rule : all_rules) {
    EXPECT_NEAR(modulus(map_at(structure, wall_cut(), 1900.0, 0.0, 40, rule)), exact, 1e-10) << name_of(rule);
  }
}

TEST(UniformStepMap, OrderOnTheSlotAndTheExactLimit) {
  // The slot of two teeth has a smooth directional matrix, so that nothing but the rule limits the order. Held over a
  // step the delayed term is of first order (Insperger, Stepan & Turi 2008, order 0). The others are of second order:
  // the semi-discretizations because the directional matrix is replaced by its mean, whatever the delayed term, the
  // full-discretizations because it and the delayed term are linear, whatever the state.
  for (const Reference& row : references("rho")) {
    if (row.immersion != 1.0 || row.rpm < 8000.0) continue;
    for (const StepRule rule : all_rules) {
      SCOPED_TRACE(row.where() + ", " + name_of(rule));
      const int order = first_order(rule) ? 1 : 2;
      // The quadratic delayed term leaves so little to the mean that the third order hides the second up to some
      // thousand steps.
      const int steps = !rule.full && rule.delayed_order == 2 ? 1280 : 160;
      const Ladder found = ladder(steps, order, row.modulus, [&, rule = rule](int m) {
        return modulus(map_at(benchmark_structure(), benchmark_process(1.0), row.rpm, row.depth_m, m, rule));
      });
      EXPECT_NEAR(found.order, order, 0.15);
      EXPECT_NEAR(found.limit / row.modulus, 1.0, first_order(rule) ? 1e-5 : 1e-7);
    }
  }
}

// K = 2 K_r along x at any angle: four teeth in full immersion without tangential force, which is turning.
MillingProcess turning() {
  MillingProcess process;
  process.cutter = {4, 0.01};
  process.coefficients = {0.0, 3e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = {0.0, 2.0 * std::numbers::pi};
  return process;
}

TEST(UniformStepMap, WithAConstantCoefficientTheOrderIsThatOfThePolynomials) {
  // What held the orders down in the slot is gone, so each polynomial shows its own: one more than its degree. At the
  // closed form of turning (docs/theory/lobes.md) the multiplier is 1.
  const double zeta = 0.02;
  const double hz = 150.0;
  const double mass = 0.8;
  const double r = 1.05;
  const double stiffness = mass * std::pow(2.0 * std::numbers::pi * hz, 2);
  const double depth = stiffness * (std::pow(1.0 - r * r, 2) + 4.0 * zeta * zeta * r * r) / (2.0 * (r * r - 1.0)) / 6e8;
  const double delay_rate =
      hz * r * std::numbers::pi / (std::numbers::pi - std::atan((r * r - 1.0) / (2.0 * zeta * r)));
  const RelativeStructure structure =
      relative_structure(modal_model({{hz, zeta, mass, Eigen::Vector3d::UnitX()}}), "P");
  const std::vector<std::pair<StepRule, int>> rules{
      {semi_discretization(0), 1}, {semi_discretization(1), 2}, {semi_discretization(2), 3},
      {full_discretization(1), 2}, {full_discretization(2), 2}, {full_discretization(3), 2},
      {{true, 1, 3}, 2},           {{true, 2, 3}, 3},           {{true, 3, 3}, 4}};
  for (const auto& [rule, order] : rules) {
    SCOPED_TRACE(name_of(rule) + ", delayed " + std::to_string(rule.delayed_order));
    const Ladder found = ladder(24, order, 1.0, [&, rule = rule](int steps) {
      return modulus(map_at(structure, turning(), delay_rate * 15.0, depth, steps, rule));
    });
    EXPECT_NEAR(found.order, order, 0.15);
  }
}

TEST(UniformStepMap, DelaysBetweenStepsKeepTheOrder) {
  // Turning again, in a period that has nothing to do with the delay: 0.737 of it, never whole steps. |μ| is 1 there,
  // too. The rules' orders are as with a delay of whole steps.
  const double zeta = 0.02;
  const double r = 1.05;
  const double omega = 2.0 * std::numbers::pi * 150.0;
  const double per_stiffness = (std::pow(1.0 - r * r, 2) + 4.0 * zeta * zeta * r * r) / (2.0 * (r * r - 1.0));
  const double delay =
      2.0 / (omega * r) * (std::numbers::pi - std::atan((r * r - 1.0) / (2.0 * zeta * r)));  // first lobe
  const ContactState state =
      contact_state(relative_structure(modal_model({{150.0, zeta, 1.0, Eigen::Vector3d::UnitX()}}), "P"), {});
  const Eigen::MatrixXd unit = omega * omega * per_stiffness * Eigen::Vector3d::UnitX() * state.in_plane.row(0);
  const std::vector<std::pair<StepRule, int>> rules{{semi_discretization(0), 1}, {semi_discretization(1), 2},
                                                    {semi_discretization(2), 3}, {full_discretization(1), 2},
                                                    {full_discretization(2), 2}, {full_discretization(3), 2}};
  for (const auto& [rule, order] : rules) {
    SCOPED_TRACE(name_of(rule));
    const Ladder found = ladder(40, order, 1.0, [&, rule = rule](int steps) {
      const std::vector<Eigen::MatrixXd> same(static_cast<std::size_t>(rule.full ? 2 * steps : steps), unit);
      UniformStepMap map(state, steps, delay / 0.737, rule);
      map.set_depth(1.0, {same, {{0.737 * steps, same}}});
      return modulus(map);
    });
    EXPECT_NEAR(found.order, order, 0.15);
    EXPECT_NEAR(found.limit, 1.0, 1e-4);
  }
}

/// x'' + c x' + k x = −(δ − k + ε cos t) x + b x(t − 2π) as a map of its period 2π, with k = δ, or 1 where that is
/// negative.
UniformStepMap mathieu(double damping, double delta, double epsilon, double b, int steps, StepRule rule) {
  const double stiffness = delta > 0.0 ? delta : 1.0;
  RelativeStructure oscillator;
  oscillator.poles.resize(1);
  oscillator.poles(0) = {-0.5 * damping, std::sqrt(stiffness - 0.25 * damping * damping)};
  oscillator.phi = Eigen::Vector3cd(1.0, 0.0, 0.0);
  oscillator.b = Eigen::Vector3cd(1.0, 0.0, 0.0) / std::complex<double>(0.0, 2.0 * oscillator.poles(0).imag());
  const double step = 2.0 * std::numbers::pi / steps;
  const auto add = [&](double cosine, StepCoefficients& c) {
    c.present.emplace_back(Eigen::Vector3d(delta - stiffness + epsilon * cosine, 0.0, 0.0));
    c.delayed[0].coefficient.emplace_back(Eigen::Vector3d(b, 0.0, 0.0));
  };
  StepCoefficients c;
  c.delayed.push_back({static_cast<double>(steps), {}});
  for (int i = 0; i < steps; ++i) {
    if (rule.full) {
      add(std::cos(i * step), c);
      add(std::cos((i + 1) * step), c);
    } else {
      add((std::sin((i + 1) * step) - std::sin(i * step)) / step, c);
    }
  }
  UniformStepMap map(contact_state(oscillator, {}), steps, 2.0 * std::numbers::pi, rule);
  map.set_depth(1.0, c);
  return map;
}

TEST(UniformStepMap, DelayedMathieuEquationWithDamping) {
  // Values computed outside of this project, by Chebyshev collocation.
  for (const auto& [epsilon, exact] : {std::pair{0.2, 0.35141726095}, std::pair{2.0, 0.512052284098}}) {
    for (const StepRule rule : all_rules) {
      SCOPED_TRACE(name_of(rule) + ", epsilon " + std::to_string(epsilon));
      const int order = first_order(rule) ? 1 : 2;
      const Ladder found =
          ladder(first_order(rule) ? 2560 : 160, order, exact, [&, rule = rule, epsilon = epsilon](int m) {
            return std::abs(mathieu(0.1, 3.0, epsilon, -0.15, m, rule).dominant().value);
          });
      // At small ε the mean's second-order error, of the size of ε², hides behind the third order of the quadratic.
      const bool hidden = !rule.full && rule.delayed_order == 2 && epsilon < 1.0;
      if (!hidden) {
        EXPECT_NEAR(found.order, order, 0.15);
      }
      EXPECT_NEAR(found.limit, exact, 1e-7);
    }
  }
}

TEST(UniformStepMap, DelayedMathieuBoundariesAreStraightLines) {
  // Without damping a multiplier is 1 where δ − b is a characteristic value of Mathieu's equation, a_2k/4 or b_2k/4 at
  // q = 2ε, and −1 where δ + b is one of odd order (Insperger & Stepan 2002): ε = 1.
  const double b = 0.2;
  const std::vector<std::pair<double, double>> delta_and_multiplier{
      {-0.3784892213 + b, 1.0}, {0.9180581766 + b, 1.0},  {1.2931662833 + b, 1.0}, {-0.3476691253 - b, -1.0},
      {0.5947999701 - b, -1.0}, {2.2851569344 - b, -1.0}, {2.3425806209 - b, -1.0}};
  for (const auto& [delta, multiplier] : delta_and_multiplier) {
    SCOPED_TRACE(delta);
    const auto nearest = [&, delta = delta, multiplier = multiplier](int steps) {
      const UniformStepMap map = mathieu(0.0, delta, 1.0, b, steps, semi_discretization(2));
      Eigen::MatrixXd M(map.size(), map.size());
      for (Eigen::Index k = 0; k < map.size(); ++k) map.apply(Eigen::VectorXd::Unit(map.size(), k), M.col(k));
      return (Eigen::EigenSolver<Eigen::MatrixXd>(M, false).eigenvalues().array() - multiplier).abs().minCoeff();
    };
    EXPECT_LT(nearest(160), 1e-3);
    EXPECT_NEAR(std::log2(nearest(40) / nearest(80)), 2.0, 0.2);
  }
}

TEST(UniformStepMap, TwoDirectionsAndShortCutsConvergeToTheExactMultiplier) {
  const RelativeStructure structure = relative_structure(modal_model(three_modes), "P");
  for (const double radial : {0.2e-3, 9e-3}) {
    MillingProcess process = wall_cut();
    process.engagement = engagement_of(process.cutter, radial, MillingDirection::down);
    const double exact = multiplier_at(structure, process, 3000.0, 2e-4, {}).modulus;
    for (const StepRule rule : all_rules) {
      // The worst of four, since the place of a jump in its step changes with their number.
      const auto worst_from = [&, rule = rule](int first) {
        double worst = 0.0;
        for (int steps = first; steps < first + 4; ++steps) {
          const double found = modulus(map_at(structure, process, 3000.0, 2e-4, steps, rule));
          worst = std::max(worst, std::abs(found - exact));
        }
        return worst;
      };
      const double coarse = worst_from(100);
      const double fine = worst_from(800);
      EXPECT_LT(fine, (first_order(rule) ? 4e-4 : 2e-4) * exact) << name_of(rule) << ", radial depth " << radial;
      // A line over a step that holds a jump of the directional matrix is off by a share of the step: first order. The
      // mean over it is not.
      const bool second_order = !rule.full && !first_order(rule);
      EXPECT_LT(fine, (second_order ? 1.0 / 40.0 : 1.0 / 4.0) * coarse) << name_of(rule) << ", radial depth " << radial;
    }
  }
}

TEST(UniformStepMap, RefusesDelaysOfLessThanThreeStepsAndChipsThatSeeTheAxis) {
  MillingProcess process = wall_cut();
  const RelativeStructure structure = relative_structure(modal_model(three_modes), "P");
  EXPECT_THROW((void)map_at(structure, process, 3000.0, 1e-4, 2, semi_discretization(1)), core::InputError);
  process.cutter.envelope.taper_rad = 0.1;
  EXPECT_THROW((void)map_at(structure, process, 3000.0, 1e-4, 40, semi_discretization(1)), core::InputError);
  process = wall_cut();
  process.damping.C = 1e5;
  EXPECT_THROW((void)map_at(structure, process, 3000.0, 1e-4, 40, full_discretization(1)), core::InputError);
}

TEST(UniformSteps, CriticalDepthsAreWithinTheirEstimateOfTheExactOnes) {
  for (const Reference& row : references("wcrit_mm")) {
    if (row.rpm != 8000.0 && row.rpm != 16000.0) continue;
    for (const StepRule rule : all_rules) {
      SCOPED_TRACE(row.where() + ", " + name_of(rule));
      StabilityOptions options;
      options.follow = 1.0;
      const MillingProcess process = benchmark_process(row.immersion);
      const CutAtSpeed cut = cut_at_speed(benchmark_structure(), process, row.rpm);
      const FoundCrossings found = uniform_step_crossings(cut, rule, 80, options);
      ASSERT_EQ(found.points.size(), 1u);
      EXPECT_NEAR(row.depth_m / found.points.front().depth_m, 1.0, found.points.front().error_estimate);
      EXPECT_LT(found.points.front().error_estimate, 0.25);  // and says something: order 0 is 11 % off
      EXPECT_EQ(found.points.front().kind, row.bifurcation());
    }
  }
}

TEST(DominantEigenvalue, KrylovAndDenseAgreeOnTheSameMap) {
  const RelativeStructure structure = relative_structure(modal_model(three_modes), "P");
  for (const double depth : {1e-4, 1e-3, 5e-3, 2e-2}) {
    const UniformStepMap map = map_at(structure, wall_cut(), 1500.0, depth, 80, semi_discretization(1));
    const LinearMap apply = [&](const auto& in, auto out) { map.apply(in, out); };
    const auto dense = dominant_eigenvalue_dense(apply, map.size(), 1e-8);
    const auto krylov = dominant_eigenvalue_arnoldi(apply, map.size(), 1e-8);
    ASSERT_TRUE(dense.converged && krylov.converged);
    EXPECT_LT(std::abs(dense.value - krylov.value), 1e-7 * std::abs(dense.value)) << depth;
    Eigen::VectorXd re(map.size());
    Eigen::VectorXd im(map.size());
    map.apply(krylov.vector.real(), re);
    map.apply(krylov.vector.imag(), im);
    const Eigen::VectorXcd image = re.cast<std::complex<double>>() + std::complex<double>(0, 1) * im;
    EXPECT_LT((image - krylov.value * krylov.vector).norm(), 2e-8 * std::abs(krylov.value) * krylov.vector.norm());
  }
}

TEST(DominantEigenvalue, SaysSoWhenItDoesNotConverge) {
  // A shift has every root of unity for an eigenvalue: no basis short of the whole space can tell which is largest.
  const LinearMap shift = [](const auto& in, auto out) {
    out.head(in.size() - 1) = in.tail(in.size() - 1);
    out(in.size() - 1) = in(0);
  };
  EXPECT_FALSE(dominant_eigenvalue_arnoldi(shift, 1000, 1e-10).converged);
}

}  // namespace
}  // namespace thinwall::milling::uniform_step_test
