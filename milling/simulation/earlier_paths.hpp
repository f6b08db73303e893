#pragma once
// The material as the paths of earlier teeth have left it, and the edges of the stock.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "milling/simulation/centre_path.hpp"
#include "milling/simulation/cleared_area.hpp"
#include "milling/simulation/path_march.hpp"
#include "milling/simulation/stock.hpp"

namespace thinwall::milling {

/// How far apart displacements of the tool lie within its last turns, so that neither a mean deflection nor the
/// beginning of a simulation counts for good.
class RecentReach {
 public:
  /// Of the last `nodes` nodes and up to a turn more. The tool has been at `start` before.
  RecentReach(std::size_t nodes, double node_rad, const Eigen::Vector2d& start)
      : nodes_a_turn_(std::max(1L, std::lround(2.0 * std::numbers::pi / node_rad))),
        turns_(nodes / static_cast<std::size_t>(nodes_a_turn_) + 1, Box(start)),
        earlier_(start) {}

  /// Takes in the displacement at a node, one after the other.
  void take(long node, const Eigen::Vector2d& displacement_m) {
    now_.extend(displacement_m);
    if (node % nodes_a_turn_ != 0) return;
    turns_[next_++ % turns_.size()] = now_;
    earlier_ = now_;
    for (const Box& turn : turns_) earlier_.extend(turn);
    now_ = Box();
  }

  /// Half of the diagonal of the box about them, m: two of them lie no farther than twice this apart.
  [[nodiscard]] double reach_m() const { return 0.5 * earlier_.merged(now_).diagonal().norm(); }

 private:
  using Box = Eigen::AlignedBox2d;

  long nodes_a_turn_;
  std::vector<Box> turns_;  ///< the last ones that are whole
  std::size_t next_ = 0;    ///< over which the next one is written, but for whole rounds
  Box earlier_, now_;       ///< of these turns, and of the one that is not whole
};

/// The material of path_march.hpp by the equation of exact_path.hpp.
class EarlierPaths {
 public:
  /// Remembers that many nodes. The tool has not vibrated before it is at the cut's start. Keeps a reference to the
  /// cut.
  EarlierPaths(Stock stock, const PathCut& cut, std::size_t nodes)
      : stock_(std::move(stock)),
        path_(cut.feed_per_node_m, cut.start_m.head<2>(), nodes),
        cleared_(cut, stock_),
        radius_m_(cut.radius_m),
        feed_per_node_m_(cut.feed_per_node_m),
        node_rad_(cut.node_rad),
        reach_(nodes, cut.node_rad, cut.start_m.head<2>()),
        newest_{0, cut.start_m.head<2>(), 0.0} {}

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
      reach_.take(step.node + c, step.centre[static_cast<std::size_t>(c)] - fed);
    }
    reach_m_ = reach_.reach_m();
    newest_ = {step.node + 2, step.centre[2], reach_m_};
    cleared_.pass(path_, newest_);
  }

  /// The area that the teeth have cleared, up to a constant.
  [[nodiscard]] std::optional<double> cleared_m2() const { return cleared_.area_m2(path_, newest_); }

 private:
  /// The farthest that the k-th tooth ahead can have cut on a ray, m from the centre: the tool was behind by the feed
  /// since then, which its other angle on the ray changes by a tenth at most, and by two displacements that lie no
  /// farther than twice `reach_m_` apart.
  [[nodiscard]] double bound(const EarlierTooth& other, const Eigen::Vector2d& n) const {
    const double feed = feed_per_node_m_ * other.ahead_rad / node_rad_;
    return farthest_cut_m(other.radius_m, n, -1.1 * feed, -0.9 * feed, 2.0 * reach_m_);
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
  ClearedArea cleared_;
  double radius_m_, feed_per_node_m_, node_rad_;
  RecentReach reach_;
  ClearedArea::Moment newest_;
  double reach_m_ = 0.0;    ///< of the passes that are remembered
  bool backwards_ = false;  ///< in the last step the tool moved faster than its teeth cut
};

}  // namespace thinwall::milling
