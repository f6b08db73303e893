#pragma once
// The material as the paths of earlier teeth have left it, and the edges of the stock.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
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

  /// The centre at a time in nodes since the simulation began, at least two nodes before the newest: the cubic through
  /// four nodes. NaN at a time that is not finite.
  [[nodiscard]] Eigen::Vector2d at(double time) const {
    if (!std::isfinite(time)) return Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());
    const double floor = std::floor(time);
    const double s = time - floor;
    const long i = static_cast<long>(floor);
    return (-s * (s - 1.0) * (s - 2.0) / 6.0) * node(i - 1) + ((s + 1.0) * (s - 1.0) * (s - 2.0) / 2.0) * node(i) +
           (-(s + 1.0) * s * (s - 2.0) / 2.0) * node(i + 1) + ((s + 1.0) * s * (s - 1.0) / 6.0) * node(i + 2);
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

/// The material of path_march.hpp by the equation of exact_path.hpp.
class EarlierPaths {
 public:
  /// `feed_per_node_m` and `node_rad` of half a step; the tool has not vibrated before it is at `start`.
  EarlierPaths(Stock stock, double feed_per_node_m, double node_rad, const Eigen::Vector2d& start, std::size_t nodes)
      : stock_(std::move(stock)),
        path_(feed_per_node_m, start, nodes),
        feed_per_node_m_(feed_per_node_m),
        node_rad_(node_rad),
        start_(start) {}

  /// Chip of a disc at a node, m. Iterations of the force move the centre by far less than a chip, and the surface
  /// that was found from the first place then lies closer by as much along n, to the second order.
  [[nodiscard]] double chip(const ToothDisc& disc, DiscRay& ray, double node, const Eigen::Vector2d& centre) const {
    const RaySpan stock = within(stock_, centre, ray.n(), disc.radius_m);
    if (stock.from_m >= stock.to_m) return 0.0;
    if (!ray.found) {
      ray.found = ray.in_cut = true;
      ray.farthest_m = farthest_cut(disc, node, centre, ray.n());
      ray.from = centre;
    }
    return stock.to_m - std::max(stock.from_m, ray.farthest_m - ray.n().dot(centre - ray.from));
  }

  /// Takes the centres at the middle and the end of a step into the path.
  void leave(const PathStep& step) {
    for (const int c : {1, 2}) {
      path_.set(step.node + c, step.centre[static_cast<std::size_t>(c)]);
      const Eigen::Vector2d fed(feed_per_node_m_ * static_cast<double>(step.node + c), 0.0);
      reach_m_ = std::max(reach_m_, (step.centre[static_cast<std::size_t>(c)] - fed - start_).norm());
    }
  }

 private:
  /// The farthest that earlier teeth have cut on the ray of a disc at a node, m from the centre. Passes that lie too
  /// far behind to be met are left out: where the tool has moved no more than `reach_m_` from its start, the k-th tooth
  /// ahead is below R_k − f_k sin φ + 2 reach, with a tenth of the feed f_k since then for its other angle.
  [[nodiscard]] double farthest_cut(const ToothDisc& disc, double node, const Eigen::Vector2d& centre,
                                    const Eigen::Vector2d& n) const {
    const Eigen::Vector2d t(n.y(), -n.x());
    double farthest = 0.0;
    for (const EarlierTooth& other : disc.earlier) {
      const double feed = feed_per_node_m_ * other.ahead_rad / node_rad_;
      if (disc.largest_radius_m - 0.9 * feed * n.x() + 2.0 * reach_m_ < farthest) break;
      double epsilon = 0.0;
      Eigen::Vector2d D = Eigen::Vector2d::Zero();
      for (int pass = 0; pass < 3; ++pass) {
        D = path_.at(node - (other.ahead_rad + epsilon) / node_rad_) - centre;
        epsilon = std::asin(std::clamp(D.dot(t) / other.radius_m, -1.0, 1.0));
      }
      farthest = std::max(farthest, D.dot(n) + other.radius_m * std::cos(epsilon));
    }
    return farthest;
  }

  Stock stock_;
  CentrePath path_;
  double feed_per_node_m_, node_rad_;
  Eigen::Vector2d start_;
  double reach_m_ = 0.0;  ///< the farthest that vibration has moved the tool
};

}  // namespace thinwall::milling
