#pragma once
// The material as the paths of earlier teeth have left it, and the edges of the stock.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "milling/simulation/path_march.hpp"
#include "milling/simulation/stock.hpp"

namespace thinwall::milling {

/// The centre of the tool at the nodes of the past turns, half a step apart, and at any time between them.
class CentrePath {
 public:
  /// Before the start the tool moved along x by `feed_per_node_m` up to `start`. Keeps `nodes` nodes.
  CentrePath(double feed_per_node_m, const Eigen::Vector2d& start, std::size_t nodes)
      : feed_(feed_per_node_m), start_(start), ring_(nodes, start) {}

  /// Sets the centre at a node, which is the newest or the one before it.
  void set(long node, const Eigen::Vector2d& centre) { ring_[place(node)] = centre; }

  /// The centre, m, and the way that it moves in a node.
  struct Place {
    Eigen::Vector2d at, per_node;
  };

  /// The centre at a time in nodes since the simulation began, at least two nodes before the newest: the cubic through
  /// four nodes. NaN at a time that is not finite.
  [[nodiscard]] Place at(double time) const {
    if (!std::isfinite(time)) {
      const Eigen::Vector2d none = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
      return {none, none};
    }
    const double floor = std::floor(time);
    const double s = time - floor;
    const long i = static_cast<long>(floor);
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
};

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
      const double step = -g / slope;
      found.met = slope < 0.0 && (std::abs(step) < enough_rad || high - low < enough_rad);
      if (found.met) {
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

/// The material of path_march.hpp by the equation of exact_path.hpp.
class EarlierPaths {
 public:
  /// `radius_m` of the cutter; `feed_per_node_m` and `node_rad` of half a step; the tool has not vibrated before it is
  /// at `start`.
  EarlierPaths(Stock stock, double radius_m, double feed_per_node_m, double node_rad, const Eigen::Vector2d& start,
               std::size_t nodes)
      : stock_(std::move(stock)),
        path_(feed_per_node_m, start, nodes),
        radius_m_(radius_m),
        feed_per_node_m_(feed_per_node_m),
        node_rad_(node_rad),
        start_(start) {}

  /// Chip of a disc at a node, m. Iterations of the force move the centre by far less than a chip, and the surface
  /// that was found from the first place then lies closer by as much along n, to the second order.
  [[nodiscard]] double chip(const ToothDisc& disc, DiscRay& ray, double node, const Eigen::Vector2d& centre) const {
    const RaySpan stock = within(stock_, centre, ray.n(), disc.radius_m);
    if (stock.from_m >= stock.to_m) return 0.0;
    if (!ray.found) {
      ray.found = true;
      ray.in_cut = stock.to_m >= disc.radius_m;
      find_farthest(disc, node, centre, ray);
      ray.from = centre;
    }
    return stock.to_m - std::max(stock.from_m, ray.farthest_m - ray.n().dot(centre - ray.from));
  }

  /// Takes the centres at the middle and the end of a step into the path.
  void leave(const PathStep& step) {
    const double moved_m = (step.centre[2] - step.centre[0]).norm();
    backwards_ = moved_m >= 2.0 * node_rad_ * radius_m_;
    for (const int c : {1, 2}) {
      path_.set(step.node + c, step.centre[static_cast<std::size_t>(c)]);
      const Eigen::Vector2d fed(feed_per_node_m_ * static_cast<double>(step.node + c), 0.0);
      reach_m_ = std::max(reach_m_, (step.centre[static_cast<std::size_t>(c)] - fed - start_).norm());
    }
  }

 private:
  /// The farthest that the k-th tooth ahead can have cut on a ray, m from the centre: D·n + √(R² − (D·t)²), with D the
  /// feed f since then, which its other angle on the ray changes by a tenth at most, and two displacements that lie no
  /// farther than `reach_m_` from the start.
  [[nodiscard]] double bound(const EarlierTooth& other, const Eigen::Vector2d& n) const {
    const double feed = feed_per_node_m_ * other.ahead_rad / node_rad_;
    const double least = 0.9 * feed, most = 1.1 * feed;
    const double along = 2.0 * reach_m_ - (n.x() > 0.0 ? least : most) * n.x();
    const double across = std::max(0.0, least * std::abs(n.y()) - 2.0 * reach_m_);
    return along + std::sqrt(std::max(0.0, other.radius_m * other.radius_m - across * across));
  }

  /// Finds the farthest that earlier teeth have cut on the ray of a disc at a node. Passes that lie too far behind to
  /// be met are left out, and all further ones where the tip has nothing left to cut.
  void find_farthest(const ToothDisc& disc, double node, const Eigen::Vector2d& centre, DiscRay& ray) const {
    const Eigen::Vector2d n = ray.n(), t(n.y(), -n.x());
    const double beyond_m = 1.01 * disc.largest_radius_m;  // by more than iterations of the force move the centre
    const EarlierTooth* met = nullptr;
    ray.farthest_m = 0.0;
    for (const EarlierTooth& other : disc.earlier) {
      if (ray.farthest_m > beyond_m) break;
      if (bound(other, n) < ray.farthest_m) continue;
      const PathRay path{path_, centre, t, node - other.ahead_rad / node_rad_, node_rad_, other.radius_m};
      const PathRay::Crossing found =
          path.crossing(std::max(-0.5 * std::numbers::pi, 4.0 * node_rad_ - other.ahead_rad));
      if (!found.met) continue;
      const double farthest = found.from_centre_m.dot(n) + other.radius_m * std::cos(found.epsilon_rad);
      if (farthest <= ray.farthest_m) continue;
      ray.farthest_m = farthest;
      met = &other;
    }
    // A tip that moves backwards may cross a ray more than once; a pass that is forgotten may have cut as deep as the
    // last that is not.
    ray.lost = backwards_ || (n.x() > 0.0 && disc.earlier.size() > 1 && met == &disc.earlier.back());
  }

  Stock stock_;
  CentrePath path_;
  double radius_m_, feed_per_node_m_, node_rad_;
  Eigen::Vector2d start_;
  double reach_m_ = 0.0;    ///< the farthest that vibration has moved the tool
  bool backwards_ = false;  ///< in the last step the tool moved faster than its teeth cut
};

}  // namespace thinwall::milling
