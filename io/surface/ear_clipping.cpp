#include "io/surface/ear_clipping.hpp"

#include <algorithm>

namespace thinwall::io {

namespace {

using EarCorners = std::vector<Eigen::Vector2d>;

/// Twice the area of a triangle, positive if it turns to the left.
double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const Eigen::Vector2d u = b - a, v = c - a;
  return u.x() * v.y() - u.y() * v.x();
}

/// Twice the area of the polygon.
double double_area(const EarCorners& corners) {
  double sum = 0.0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) sum += turn(corners[0], corners[k], corners[k + 1]);
  return sum;
}

/// The rest of a polygon while ears are cut off.
class Outline {
 public:
  explicit Outline(const EarCorners& corners) : x_(corners), flat_(1e-12 * double_area(corners)) {
    for (std::size_t k = 0; k < x_.size(); ++k) left_.push_back(k);
    shape_.assign(x_.size(), 0.0);
  }

  [[nodiscard]] std::size_t size() const { return left_.size(); }

  /// Judges every corner anew.
  void judge_all() {
    for (std::size_t i = 0; i < left_.size(); ++i) judge(i);
  }

  /// The place of the best-shaped ear; failing that, of a corner on the line of its neighbours; size() if there is
  /// none.
  [[nodiscard]] std::size_t best() const {
    std::size_t best = size();
    for (std::size_t i = 0; i < size(); ++i)
      if (shape_[left_[i]] > (best == size() ? 0.0 : shape_[left_[best]])) best = i;
    for (std::size_t i = 0; i < size() && best == size(); ++i)
      if (std::abs(turn(at(i + size() - 1), at(i), at(i + 1))) <= flat_) best = i;
    return best;
  }

  /// The triangle of a corner and its neighbours.
  [[nodiscard]] std::array<std::size_t, 3> triangle(std::size_t i) const {
    return {left_[(i + size() - 1) % size()], left_[i], left_[(i + 1) % size()]};
  }

  /// Cuts the corner off. Only its neighbours are judged anew, since a corner that blocks another ear is no ear itself.
  void cut(std::size_t i) {
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(i));
    judge((i + size() - 1) % size());
    judge(i % size());
  }

 private:
  [[nodiscard]] const Eigen::Vector2d& at(std::size_t i) const { return x_[left_[i % size()]]; }

  /// Sets the shape of a corner: its area over its longest side squared if it is an ear, 0 otherwise.
  void judge(std::size_t i) {
    const Eigen::Vector2d &a = at(i + size() - 1), &b = at(i), &c = at(i + 1);
    const double doubled = turn(a, b, c);
    shape_[left_[i]] = 0.0;
    if (!(doubled > flat_)) return;
    for (const std::size_t k : left_) {
      const Eigen::Vector2d& p = x_[k];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= -flat_ && turn(b, c, p) >= -flat_ && turn(c, a, p) >= -flat_) return;
    }
    shape_[left_[i]] = doubled / std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
  }

  const EarCorners& x_;
  double flat_ = 0.0;              ///< twice the area below which three corners lie on a line
  std::vector<std::size_t> left_;  ///< the corners that are left, in their order
  std::vector<double> shape_;      ///< of each corner
};

}  // namespace

std::vector<std::array<std::size_t, 3>> clipped_ears(const std::vector<Eigen::Vector2d>& corners) {
  // A simple polygon never lacks an ear; round-off of nearly flat corners may hide one until all are judged anew.
  constexpr int most_judgements = 8;
  std::vector<std::array<std::size_t, 3>> triangles;
  if (corners.size() < 3 || !(double_area(corners) > 0.0)) return triangles;
  Outline outline(corners);
  outline.judge_all();
  for (int judgements = 1; outline.size() > 3;) {
    const std::size_t ear = outline.best();
    if (ear < outline.size()) {
      triangles.push_back(outline.triangle(ear));
      outline.cut(ear);
    } else if (judgements++ < most_judgements) {
      outline.judge_all();
    } else {
      return {};
    }
  }
  const std::array<std::size_t, 3> last = outline.triangle(1);
  if (!(turn(corners[last[0]], corners[last[1]], corners[last[2]]) >= -1e-9 * double_area(corners))) return {};
  triangles.push_back(last);
  return triangles;
}

}  // namespace thinwall::io
