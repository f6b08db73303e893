#pragma once
// The path of the centre of a tool that is remembered, and where a ray meets the tips that moved along it.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace thinwall::milling {

/// The centre of the tool at the nodes of the past turns, half a step apart, and at any time between them.
class CentrePath {
 public:
  /// Before the start the tool moved along x by `feed_per_node_m` up to `start`. Keeps `nodes` nodes.
  CentrePath(double feed_per_node_m, const Eigen::Vector2d& start, std::size_t nodes)
      : feed_(feed_per_node_m), start_(start), ring_(nodes, start) {}

  /// Sets the centre at a node, which is the newest or the one before it.
  void set(long node, const Eigen::Vector2d& centre) {
    ring_[place(node)] = centre;
    newest_ = std::max(newest_, node);
  }

  /// The centre, m, and the way that it moves in a node.
  struct Place {
    Eigen::Vector2d at, per_node;
  };

  /// The centre at a time in nodes since the simulation began, up to the newest: the cubic through the four nodes about
  /// it, or the last four. NaN at a time that is not finite.
  [[nodiscard]] Place at(double time) const {
    if (!std::isfinite(time)) {
      const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
      return {none, none};
    }
    const long i = std::min(static_cast<long>(std::floor(time)), newest_ - 2);
    const double s = time - static_cast<double>(i);
    const Eigen::Vector2d a = node(i - 1), b = node(i), c = node(i + 1), d = node(i + 2);
    const Eigen::Vector2d slope = -a / 3.0 - b / 2.0 + c - d / 6.0;  // of the cubic at b
    const Eigen::Vector2d bend = 0.5 * (a - 2.0 * b + c);
    const Eigen::Vector2d twist = (d - 3.0 * c + 3.0 * b - a) / 6.0;
    return {b + s * (slope + s * (bend + s * twist)), slope + s * (2.0 * bend + 3.0 * s * twist)};
  }

 private:
  [[nodiscard]] Eigen::Vector2d node(long i) const {
    return i < 0 ? Eigen::Vector2d(start_ + Eigen::Vector2d(feed_ * static_cast<double>(i), 0.0)) : ring_[place(i)];
  }
  [[nodiscard]] std::size_t place(long node) const { return static_cast<std::size_t>(node) % ring_.size(); }

  double feed_;
  Eigen::Vector2d start_;
  std::vector<Eigen::Vector2d> ring_;
  long newest_ = 0;
};

/// The farthest that a tooth can have cut on the ray along the unit vector n, D·n + √(R² − (D·t)²), where its centre
/// lay at D, an x from `least_x_m` to `most_x_m` and off that by `off_m` in any direction.
inline double farthest_cut_m(double radius_m, const Eigen::Vector2d& n, double least_x_m, double most_x_m,
                             double off_m) {
  const double nearest_x = std::max({0.0, least_x_m, -most_x_m});
  const double along = off_m + std::max(least_x_m * n.x(), most_x_m * n.x());
  const double across = std::max(0.0, nearest_x * std::abs(n.y()) - off_m);
  return along + std::sqrt(std::max(0.0, radius_m * radius_m - across * across));
}

/// The ray from a centre and the path of an earlier tooth, which it meets where
///
///     g(ε) = D·t − R sin ε = 0,     D = C(t − (P + ε)/Ω) − C(t),     g' = −C'·t/Ω − R cos ε
struct PathRay {
  const CentrePath& path;
  Eigen::Vector2d centre;  ///< C(t)
  Eigen::Vector2d t;       ///< unit vector across the ray
  double node = 0.0;       ///< time at which the tooth ahead had the angle of the ray, in nodes
  double node_rad = 0.0;   ///< rotation from node to node
  double radius_m = 0.0;   ///< of the earlier tooth

  /// The place of the earlier tooth on the ray.
  struct Crossing {
    Eigen::Vector2d from_centre_m = Eigen::Vector2d::Zero();  ///< D
    double epsilon_rad = 0.0;
    bool met = false;  ///< the ray crosses the path; not where it passes by or along it
  };

  /// Newton's method from ε = 0, kept between `low_rad` and π/2 by bisection: as long as the tool has moved by less
  /// than the radius, g changes its sign there. Two or three iterations where vibration is slow against the cutting
  /// speed.
  [[nodiscard]] Crossing crossing(double low_rad) const {
    constexpr int most = 60;
    constexpr double enough_rad = 1e-7;  // Newton's next step is of the order of its square
    double low = low_rad, high = 0.5 * std::numbers::pi, epsilon = 0.0;
    Crossing found;
    for (int pass = 0; pass < most; ++pass) {
      const CentrePath::Place place = path.at(node - epsilon / node_rad);
      found.from_centre_m = place.at - centre;
      found.epsilon_rad = epsilon;
      const double g = found.from_centre_m.dot(t) - radius_m * std::sin(epsilon);
      if (pass == 0 && std::abs(g) >= radius_m) return found;
      (g > 0.0 ? low : high) = epsilon;
      const double slope = -place.per_node.dot(t) / node_rad - radius_m * std::cos(epsilon);
      double step = -g / slope;
      found.met = slope < 0.0 && (std::abs(step) < enough_rad || high - low < enough_rad);
      if (found.met) {
        if (std::abs(step) >= enough_rad) step = 0.0;  // the ray touches the path, along which Newton's step leads away
        found.from_centre_m -= step / node_rad * place.per_node;
        found.epsilon_rad += step;
        return found;
      }
      epsilon += step;
      if (!(epsilon > low && epsilon < high)) epsilon = 0.5 * (low + high);
    }
    return found;
  }
};

}  // namespace thinwall::milling
