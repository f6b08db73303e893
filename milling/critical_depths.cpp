#include "milling/critical_depths.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

constexpr double pi = std::numbers::pi;

/// The eigenvalues of −Z that a depth within four times the limit can reach.
struct Stop {
  double theta = 0.0;
  std::vector<complex<double>> nu;
};

void require_found(Eigen::ComputationInfo info) {
  if (info == Eigen::Success) return;
  throw core::NumericalError(
      "stability: eigenvalues of the loop's gain were not found; check the structure at the cut");
}

struct Search {
  const GainOnCircle& gain;
  double depth_limit_m;
  double smallest;  // |ν| that matters
  std::vector<Crossing> found{};

  Stop stop_at(double theta) const {
    const Eigen::MatrixXcd Z = gain.Z(theta);
    if (!Z.allFinite()) require_found(Eigen::NumericalIssue);
    Stop stop{theta, {}};
    const auto keep = [&](complex<double> z) {
      if (std::abs(z) > smallest) stop.nu.push_back(-z);
    };
    if (theta == 0.0 || theta == pi) {
      const Eigen::EigenSolver<Eigen::MatrixXd> eigen(Z.real(), false);
      require_found(eigen.info());
      for (const complex<double> z : eigen.eigenvalues()) keep(z);
    } else {
      const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> eigen(Z, false);
      require_found(eigen.info());
      for (const complex<double> z : eigen.eigenvalues()) keep(z);
    }
    return stop;
  }
};

/// An eigenvalue of −Z(e^{iθ}) and its vector.
struct Eigenpair {
  complex<double> nu;
  Eigen::VectorXcd right;
  bool converged = false;
};

/// The eigenvalue nearest to a guess: inverse iterations with the guess as it is, on both sides, then with the Rayleigh
/// quotients of left and right vector, which converges cubically.
Eigenpair nearest_eigenpair(const Eigen::MatrixXcd& Z, complex<double> guess) {
  const Index n = Z.rows();
  Eigen::VectorXcd right(n);
  for (Index i = 0; i < n; ++i) right(i) = {1.0, std::sin(1.0 + 2.0 * static_cast<double>(i))};
  Eigen::VectorXcd left = right;
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu(n);
  complex<double> nu = guess;
  const double off = 1e-14 * std::abs(guess);  // of the shift, so that nothing is divided by an exact zero
  for (int i = 0; i < 14; ++i) {
    if (i == 0 || i > 3) {
      Eigen::MatrixXcd shifted = -Z;
      shifted.diagonal().array() -= nu + off;
      lu.compute(shifted);
    }
    right = lu.solve(right).eval();
    left = lu.transpose().solve(left).eval();
    right.normalize();
    left.normalize();
    if (!right.allFinite() || !left.allFinite()) return {nu, right, false};
    if (i < 3) continue;  // the vectors first, so that a quotient does not lead to another eigenvalue
    const complex<double> next = -(left.transpose() * Z * right).value() / (left.transpose() * right).value();
    const double change = std::abs(next - nu);
    nu = next;
    if (change <= 1e-13 * std::abs(nu)) break;
  }
  return {nu, right, true};
}

/// Im ν(θ) = 0 by the secant rule from two points near it.
bool to_axis(const GainOnCircle& gain, double a, complex<double> nu_a, double b, complex<double> nu_b,
             Crossing& crossing) {
  constexpr double too_close = 1e-8;  // rad: differences of ν drown in its round-off
  complex<double> slope = (nu_b - nu_a) / (b - a);
  for (int i = 0; i < 20; ++i) {
    const double theta = std::clamp(b - nu_b.imag() / slope.imag(), 0.0, pi);
    const Eigenpair at = nearest_eigenpair(gain.Z(theta), nu_b + slope * (theta - b));
    if (!at.converged) return false;
    crossing.mode = at.right;
    const double step = theta - b;
    if (std::abs(step) > too_close) slope = (at.nu - nu_b) / step;
    b = theta;
    nu_b = at.nu;
    if (std::abs(step) < 1e-12 || std::abs(nu_b.imag()) < 1e-13 * std::abs(nu_b)) break;
  }
  crossing.depth_m = 1.0 / nu_b.real();
  crossing.theta_rad = b;
  crossing.unstable_change = slope.imag() < 0.0 ? 2 : -2;
  return nu_b.real() > 0.0 && std::abs(nu_b.imag()) <= 1e-10 * std::abs(nu_b);
}

/// Pairs of eigenvalues that follow each other from one stop to the next, nearest first; those without partner came
/// from, or went to, values too small to matter.
struct Step {
  complex<double> from, to;
  double next_nearest = 0.0;  ///< distance of `from` to the second choice
};

struct Matching {
  std::vector<Step> steps;
  double largest_alone = 0.0;  ///< |ν| of those without partner
};

Matching matched(const Stop& a, const Stop& b) {
  struct Candidate {
    double distance;
    std::size_t i, j;
  };
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < a.nu.size(); ++i) {
    for (std::size_t j = 0; j < b.nu.size(); ++j) candidates.push_back({std::abs(a.nu[i] - b.nu[j]), i, j});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& x, const Candidate& y) { return x.distance < y.distance; });
  std::vector<char> used_a(a.nu.size(), 0), used_b(b.nu.size(), 0);
  Matching result;
  for (const Candidate& c : candidates) {
    if (used_a[c.i] != 0 || used_b[c.j] != 0) continue;
    used_a[c.i] = used_b[c.j] = 1;
    double second = INFINITY;
    for (std::size_t j = 0; j < b.nu.size(); ++j) {
      if (j != c.j) second = std::min(second, std::abs(a.nu[c.i] - b.nu[j]));
    }
    result.steps.push_back({a.nu[c.i], b.nu[c.j], second});
  }
  for (std::size_t i = 0; i < a.nu.size(); ++i) {
    if (used_a[i] == 0) result.largest_alone = std::max(result.largest_alone, std::abs(a.nu[i]));
  }
  for (std::size_t j = 0; j < b.nu.size(); ++j) {
    if (used_b[j] == 0) result.largest_alone = std::max(result.largest_alone, std::abs(b.nu[j]));
  }
  return result;
}

/// Whether a step between stops may hide something: a match that is not clear, or a path near the positive real axis
/// that could cross it twice.
bool unclear(const Step& s, double smallest) {
  const double jump = std::abs(s.to - s.from);
  const double size = std::max(std::abs(s.from), std::abs(s.to));
  if (std::max(s.from.real(), s.to.real()) <= 0.0) return false;
  if (size < 3.0 * smallest) return false;
  if (jump > 0.5 * s.next_nearest && jump > 0.1 * size) return true;
  const bool crosses = s.from.imag() * s.to.imag() < 0.0;
  const double off_axis = std::min(std::abs(s.from.imag()), std::abs(s.to.imag()));
  if (crosses) return jump > 0.8 * size;
  return jump > 1.5 * off_axis && jump > 0.02 * size;
}

/// The crossings of steps between two stops; nothing if one could not be brought to the axis between them.
std::optional<std::vector<Crossing>> crossings_of(const Search& search, const Stop& a, const Stop& b,
                                                  const std::vector<Step>& steps) {
  std::vector<Crossing> crossings;
  for (const Step& s : steps) {
    if (s.from.imag() * s.to.imag() >= 0.0) continue;
    const double share = s.from.imag() / (s.from.imag() - s.to.imag());
    const double real = s.from.real() + share * (s.to.real() - s.from.real());
    if (real <= 0.5 / search.depth_limit_m) continue;
    Crossing crossing;
    if (!to_axis(search.gain, a.theta, s.from, b.theta, s.to, crossing) || crossing.theta_rad < a.theta ||
        crossing.theta_rad > b.theta) {
      return std::nullopt;
    }
    if (crossing.depth_m <= search.depth_limit_m) crossings.push_back(std::move(crossing));
  }
  return crossings;
}

void between(Search& search, const Stop& a, const Stop& b, int halvings) {
  const auto [steps, largest_alone] = matched(a, b);
  const bool clear = halvings == 0 || (largest_alone < 3.0 * search.smallest &&
                                       std::none_of(steps.begin(), steps.end(),
                                                    [&](const Step& s) { return unclear(s, search.smallest); }));
  if (clear) {
    auto crossings = crossings_of(search, a, b, steps);
    if (crossings || halvings == 0) {
      if (crossings) std::move(crossings->begin(), crossings->end(), std::back_inserter(search.found));
      return;
    }
  }
  const Stop middle = search.stop_at(0.5 * (a.theta + b.theta));
  between(search, a, middle, halvings - 1);
  between(search, middle, b, halvings - 1);
}

/// Of a real eigenvalue at an end of the half circle: one multiplier leaves or returns.
int change_at_end(const GainOnCircle& gain, double theta, double nu) {
  constexpr double inward = 1e-5;
  const double imaginary = nearest_eigenpair(gain.Z(theta == 0.0 ? inward : theta - inward), nu).nu.imag();
  const double slope = theta == 0.0 ? imaginary : -imaginary;
  return slope < 0.0 ? 1 : -1;
}

/// Real eigenvalues at the ends of the half circle, where a multiplier is −1 or 1.
void at_end(Search& search, const Stop& stop) {
  for (const complex<double> nu : stop.nu) {
    if (nu.imag() != 0.0 || nu.real() * search.depth_limit_m < 1.0) continue;
    search.found.push_back({1.0 / nu.real(), stop.theta, change_at_end(search.gain, stop.theta, nu.real()),
                            nearest_eigenpair(search.gain.Z(stop.theta), nu).right});
  }
}

}  // namespace

std::vector<Crossing> critical_depths(const GainOnCircle& gain, double depth_limit_m) {
  Search search{gain, depth_limit_m, 0.25 / depth_limit_m};
  Stop last = search.stop_at(gain.stops.front());
  at_end(search, last);
  for (std::size_t i = 1; i < gain.stops.size(); ++i) {
    Stop next = search.stop_at(gain.stops[i]);
    between(search, last, next, 10);
    last = std::move(next);
  }
  at_end(search, last);
  std::sort(search.found.begin(), search.found.end(),
            [](const Crossing& a, const Crossing& b) { return a.depth_m < b.depth_m; });
  return std::move(search.found);
}

bool refine(const GainOnCircle& gain, Crossing& crossing) {
  const double before = crossing.depth_m;
  const complex<double> guess(1.0 / before, 0.0);
  const Eigenpair at = nearest_eigenpair(gain.Z(crossing.theta_rad), guess);
  if (!at.converged) return false;
  if (crossing.theta_rad == 0.0 || crossing.theta_rad == pi) {
    crossing.depth_m = 1.0 / at.nu.real();
    crossing.mode = at.right;
    if (crossing.unstable_change == 0) crossing.unstable_change = change_at_end(gain, crossing.theta_rad, at.nu.real());
  } else {
    const double beside = crossing.theta_rad + (crossing.theta_rad > 0.5 * pi ? -1e-5 : 1e-5);
    const complex<double> nu = nearest_eigenpair(gain.Z(beside), at.nu).nu;
    crossing.mode = at.right;
    if (!to_axis(gain, beside, nu, crossing.theta_rad, at.nu, crossing)) return false;
  }
  return std::abs(crossing.depth_m - before) <= 0.1 * before;
}

std::vector<double> stops_between(const Eigen::VectorXcd& flow) {
  std::vector<double> stops{0.0};
  while (stops.back() < pi) {
    const complex<double> at = std::polar(1.0, stops.back());
    double step = 0.35;
    for (const complex<double> f : flow) {
      step = std::min(step, 0.6 * std::abs(at - f));
      step = std::min(step, 0.6 * std::abs(at - std::conj(f)));
    }
    stops.push_back(stops.back() + std::max(step, 1e-4));
  }
  stops.back() = pi;
  return stops;
}

}  // namespace thinwall::milling
