#include "milling/direct/critical_depths.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <utility>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "linalg/complex_eigenvalues.hpp"
#include "linalg/largest_eigenvalues.hpp"
#include "linalg/real_eigenvalues.hpp"

namespace thinwall::milling {

namespace {

using Eigen::Index;
using std::complex;

using std::numbers::pi;

void require_found(bool found) {
  if (found) return;
  throw core::NumericalError(
      "stability: eigenvalues of the loop's gain were not found; check the structure at the cut");
}

/// Eigenvalues of −Z.
Eigen::VectorXcd eigenvalues_of(const Eigen::MatrixXcd& Z, double theta) {
  constexpr Index large = 150;
  if (theta == 0.0 || theta == pi) {
    if (Z.rows() >= large) {
      const std::optional<Eigen::VectorXcd> eigenvalues = linalg::real_eigenvalues(Z.real());
      require_found(eigenvalues.has_value());
      return -*eigenvalues;
    }
    const Eigen::EigenSolver<Eigen::MatrixXd> eigen(Eigen::MatrixXd(Z.real()), false);
    require_found(eigen.info() == Eigen::Success);
    return -eigen.eigenvalues();
  }
  const std::optional<Eigen::VectorXcd> eigenvalues = linalg::complex_eigenvalues(Z);
  require_found(eigenvalues.has_value());
  return -*eigenvalues;
}

/// No eigenvalue exceeds ‖Z⁴‖^¼ (Frobenius), and it is rarely more than a fifth above the largest.
double radius_bound(const Eigen::MatrixXcd& Z) {
  const Eigen::MatrixXcd square = Z * Z;
  return std::sqrt(std::sqrt((square * square).norm()));
}

using Path = CriticalDepths::Path;

/// Pairs of eigenvalues that follow each other from one stop to the next, nearest to where the path leads first; those
/// without partner came from, or went to, values too small to matter.
struct Step {
  complex<double> from, to;
  complex<double> change;           ///< of the path's slope, rad⁻¹
  complex<double> change_of_depth;  ///< of the slope of 1/ν, m/rad
  double miss = 0.0;                ///< distance of `to` from where the path stood or led to
  double next_nearest = 0.0;        ///< the same of the second choice
  bool slope_known = false;
};

struct Matching {
  std::vector<Step> steps;
  double largest_alone = 0.0;  ///< |ν| of those without partner
};

/// `b` receives the slopes of the paths that lead to it over `length_rad`.
Matching matched(const std::vector<Path>& a, std::vector<Path>& b, double length_rad) {
  struct Candidate {
    double distance;
    std::size_t i, j;
  };
  std::vector<Candidate> candidates;
  const auto distance = [&](const Path& x, const Path& y) {
    return std::sqrt(std::min(std::norm(x.nu - y.nu), std::norm(x.nu + x.slope * length_rad - y.nu)));
  };
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) candidates.push_back({distance(a[i], b[j]), i, j});
  }
  std::sort(candidates.begin(), candidates.end(),
            [](const Candidate& x, const Candidate& y) { return x.distance < y.distance; });
  std::vector<char> used_a(a.size(), 0), used_b(b.size(), 0);
  Matching result;
  for (const Candidate& c : candidates) {
    if (used_a[c.i] != 0 || used_b[c.j] != 0) continue;
    used_a[c.i] = used_b[c.j] = 1;
    double second = INFINITY;
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (j != c.j) second = std::min(second, distance(a[c.i], b[j]));
    }
    const Path& from = a[c.i];
    Path& to = b[c.j];
    to.slope = (to.nu - from.nu) / length_rad;
    to.slope_of_depth = (1.0 / to.nu - 1.0 / from.nu) / length_rad;
    to.slope_known = true;
    result.steps.push_back({from.nu, to.nu, to.slope - from.slope, to.slope_of_depth - from.slope_of_depth, c.distance,
                            second, from.slope_known});
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (used_a[i] == 0) result.largest_alone = std::max(result.largest_alone, std::abs(a[i].nu));
  }
  for (std::size_t j = 0; j < b.size(); ++j) {
    if (used_b[j] == 0) result.largest_alone = std::max(result.largest_alone, std::abs(b[j].nu));
  }
  return result;
}

/// True if a path may bend away from its chord by more than its distance from the real axis, the lesser of its ends or,
/// where it crosses the axis, the greater: it bends by about an eighth of the change of its slope over the step, and
/// four times as much is allowed for. Towards a resonance ν grows as its inverse, whose slope hardly changes: there the
/// bend of 1/ν, which is on the axis where ν is, tells what that of ν does not.
bool may_bend_to_axis(const Step& s, double length_rad) {
  const auto is_far_enough = [length_rad](complex<double> from, complex<double> to, complex<double> change) {
    const auto [lesser, greater] = std::minmax({std::abs(from.imag()), std::abs(to.imag())});
    const bool crosses = from.imag() * to.imag() < 0.0;
    return 0.5 * std::abs(change.imag()) * length_rad <= (crosses ? greater : lesser);
  };
  return !is_far_enough(s.from, s.to, s.change) || !is_far_enough(1.0 / s.from, 1.0 / s.to, s.change_of_depth);
}

/// True if a step between stops may hide something: a match that is not clear, or a path near the positive real axis
/// that could cross it once more than its ends tell.
bool unclear(const Step& s, double length_rad, double smallest) {
  constexpr double far = 5.0;  // a path that bends by half a radian in a step leaves its chord by an eighth of that
  const double jump = std::abs(s.to - s.from);
  const double size = std::max(std::abs(s.from), std::abs(s.to));
  if (std::max(s.from.real(), s.to.real()) <= 0.0) return false;
  if (size < 1.5 * smallest) return false;
  const bool crosses = s.from.imag() * s.to.imag() < 0.0;
  const double off_axis = std::min(std::abs(s.from.imag()), std::abs(s.to.imag()));
  if (!crosses && jump <= off_axis) return false;  // any other partner as near lies on the same side of the axis
  if (s.miss > 0.5 * s.next_nearest && s.miss > 0.1 * size) return true;
  if (crosses && jump > 0.8 * size) return true;
  if ((!crosses && jump <= 1.5 * off_axis) || jump <= 0.02 * size) return false;
  if (!crosses && jump > far * off_axis) return true;
  return !s.slope_known || may_bend_to_axis(s, length_rad);
}

/// The crossings of steps between two stops; nothing if one could not be brought to the axis between them.
std::optional<std::vector<Crossing>> crossings_of(const GainOnCircle& gain, double from_rad, double to_rad,
                                                  const std::vector<Step>& steps, double depth_limit_m) {
  std::vector<Crossing> crossings;
  for (const Step& s : steps) {
    if (s.from.imag() * s.to.imag() >= 0.0) continue;
    const double share = s.from.imag() / (s.from.imag() - s.to.imag());
    const double real = s.from.real() + share * (s.to.real() - s.from.real());
    if (real <= 0.5 / depth_limit_m) continue;
    Crossing crossing{0.0, from_rad + share * (to_rad - from_rad), 0, {}};
    if (!to_axis(gain, real, crossing) || crossing.theta_rad < from_rad || crossing.theta_rad > to_rad) {
      return std::nullopt;
    }
    if (std::abs(1.0 / crossing.depth_m - real) > 0.5 * std::abs(s.to - s.from)) return std::nullopt;  // another path's
    if (crossing.depth_m <= depth_limit_m) crossings.push_back(std::move(crossing));
  }
  return crossings;
}

/// Real eigenvalues at the ends of the half circle, where a multiplier is −1 or 1.
void add_at_end(const GainOnCircle& gain, double theta, const std::vector<Path>& values, double depth_limit_m,
                std::vector<Crossing>& found) {
  for (const auto& [nu, slope, slope_of_depth, slope_known] : values) {
    if (nu.imag() != 0.0 || nu.real() * depth_limit_m < 1.0) continue;
    Crossing crossing{0.0, theta, 0, {}};
    if (to_axis(gain, nu, crossing)) found.push_back(std::move(crossing));
  }
}

}  // namespace

CriticalDepths::CriticalDepths(GainOnCircle gain, Eigenvalues of_large) : gain_(std::move(gain)), of_large_(of_large) {}

double CriticalDepths::none_below_m() {
  std::vector<Stop*> stops;
  for (const double theta : gain_.stops) stops.push_back(&at(theta));
  // A bound costs two products and never exceeds the norm: where the norm is no more than the largest bound so far,
  // none is needed.
  std::ranges::sort(stops, std::ranges::greater{}, &Stop::norm);
  double largest = 0.0;
  for (Stop* stop : stops) {
    if (stop->norm <= largest) break;
    largest = std::max(largest, bound_of(*stop));
  }
  return 0.75 / largest;
}

CriticalDepths::Stop& CriticalDepths::at(double theta_rad) {
  core::check_interrupt();
  const auto [place, is_new] = stops_.try_emplace(theta_rad);
  Stop& stop = place->second;
  if (is_new) {
    stop.Z = gain_.Z(theta_rad);
    require_found(stop.Z.allFinite());
    stop.norm = stop.Z.norm();
  }
  return stop;
}

double CriticalDepths::bound_of(Stop& stop) {
  if (stop.bound) return *stop.bound;
  core::check_interrupt();  // two products of a large Z take tenths of a second, and there are many stops
  stop.bound = radius_bound(stop.Z);
  return *stop.bound;
}

/// True if the largest eigenvalues of Z do and are found in less time than all of them.
bool CriticalDepths::finds_largest_only(const Stop& stop) const {
  constexpr Index large = 60;
  return of_large_ != Eigenvalues::all && stop.Z.rows() >= large;
}

/// False if no eigenvalue can be larger than `smallest`. Two products tell more than the norm, at a third of the time
/// of all eigenvalues, and are worth it where the norm is not far above; the largest eigenvalues of a large Z take
/// less.
bool CriticalDepths::reaches(Stop& stop, double smallest) const {
  if (stop.norm <= smallest || (stop.bound && *stop.bound <= smallest)) return false;
  return stop.norm > 2.0 * smallest || finds_largest_only(stop) || bound_of(stop) > smallest;
}

/// Finds the eigenvalues above `smallest`; those of a large Z down to a part of it where the search goes on deeper.
void CriticalDepths::find_above(Stop& stop, double theta_rad, double smallest) {
  constexpr double part = 0.4;
  constexpr Index looks_before = 12;  // two looks before the steps that the last stop has taken
  // Values are followed from stop to stop, over changes of a hundredth and more; to_axis() finds them again to
  // round-off where a path crosses the axis.
  constexpr double to_follow = 1e-5;
  const bool is_real = theta_rad == 0.0 || theta_rad == pi;
  if (!is_real && finds_largest_only(stop)) {
    const double least = of_large_ == Eigenvalues::deeper ? part * smallest : smallest;
    if (const auto largest = linalg::largest_eigenvalues(stop.Z, least, steps_ - looks_before, to_follow)) {
      stop.nu = -largest->values;
      stop.known_above = least;
      steps_ = largest->steps;
      return;
    }
  }
  stop.nu = eigenvalues_of(stop.Z, theta_rad);
  stop.known_above = 0.0;
}

std::vector<Path> CriticalDepths::reached_at(double theta_rad, double depth_limit_m) {
  const double smallest = 0.5 / depth_limit_m;
  Stop& stop = at(theta_rad);
  std::vector<Path> reached;
  if (smallest < stop.known_above) {
    if (!reaches(stop, smallest)) return reached;
    find_above(stop, theta_rad, smallest);
  }
  for (const complex<double> nu : stop.nu) {
    if (std::norm(nu) > smallest * smallest) reached.push_back({nu});
  }
  return reached;
}

void CriticalDepths::between(double from_rad, const std::vector<Path>& from, double to_rad, std::vector<Path>& to,
                             int halvings, double depth_limit_m) {
  const double smallest = 0.5 / depth_limit_m;
  const double length = to_rad - from_rad;
  const auto [steps, largest_alone] = matched(from, to, length);
  const bool clear =
      halvings == 0 || (largest_alone < 1.5 * smallest && std::none_of(steps.begin(), steps.end(), [&](const Step& s) {
                          return unclear(s, length, smallest);
                        }));
  if (clear) {
    auto crossings = crossings_of(gain_, from_rad, to_rad, steps, depth_limit_m);
    if (crossings || halvings == 0) {
      if (crossings) std::move(crossings->begin(), crossings->end(), std::back_inserter(found_));
      return;
    }
  }
  const double middle_rad = 0.5 * (from_rad + to_rad);
  std::vector<Path> middle = reached_at(middle_rad, depth_limit_m);
  between(from_rad, from, middle_rad, middle, halvings - 1, depth_limit_m);
  between(middle_rad, middle, to_rad, to, halvings - 1, depth_limit_m);
}

std::vector<Crossing> CriticalDepths::up_to(double depth_limit_m) {
  found_.clear();
  double last_rad = gain_.stops.front();
  std::vector<Path> last = reached_at(last_rad, depth_limit_m);
  add_at_end(gain_, last_rad, last, depth_limit_m, found_);
  for (std::size_t i = 1; i < gain_.stops.size(); ++i) {
    const double next_rad = gain_.stops[i];
    std::vector<Path> next = reached_at(next_rad, depth_limit_m);
    between(last_rad, last, next_rad, next, 10, depth_limit_m);
    last_rad = next_rad;
    last = std::move(next);
  }
  add_at_end(gain_, last_rad, last, depth_limit_m, found_);
  std::sort(found_.begin(), found_.end(), [](const Crossing& a, const Crossing& b) { return a.depth_m < b.depth_m; });
  return std::exchange(found_, {});
}

std::vector<CriticalDepths::NearAxis> CriticalDepths::near_axis(double depth_m, double share) const {
  std::vector<NearAxis> near;
  for (const auto& [theta_rad, stop] : stops_) {
    for (const complex<double> nu : stop.nu) {
      if (nu.real() * depth_m > 1.0 && std::abs(nu.imag()) <= share * nu.real()) near.push_back({theta_rad, nu});
    }
  }
  return near;
}

double least_real_depth_m(const GainOnCircle& gain) {
  double largest = 0.0;
  for (const double theta : {0.0, pi}) {
    for (const complex<double> nu : eigenvalues_of(gain.Z(theta), theta))
      if (nu.imag() == 0.0) largest = std::max(largest, nu.real());
  }
  return 1.0 / largest;
}

std::vector<double> stops_between(const Eigen::VectorXcd& flow) {
  std::vector<double> stops{0.0};
  while (stops.back() < pi) {
    const complex<double> at = std::polar(1.0, stops.back());
    double square = INFINITY;  // of the distance to the nearest
    for (const complex<double> f : flow) square = std::min({square, std::norm(at - f), std::norm(at - std::conj(f))});
    const double step = std::min(0.35, 0.6 * std::sqrt(square));
    stops.push_back(stops.back() + std::max(step, 1e-4));
  }
  stops.back() = pi;
  return stops;
}

}  // namespace thinwall::milling
