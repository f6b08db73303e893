#include "milling/simulation/wall.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;
constexpr double reach_rad = 0.3;
constexpr int samples_a_pass = 161;
constexpr int points_a_feed = 200;

/// The rotation in its period; a hair before the end, where by round-off no step may reach, it is the start of the
/// next.
double within_period(double rotation_rad, double period_rad) {
  constexpr double hair = 1e-12;
  return std::max(0.0, rotation_rad - period_rad * std::floor(rotation_rad / period_rad + hair));
}

/// Height of a path at a place between its samples: the cubic through the four next to it.
double height_at(const TipPath& path, double x) {
  const auto begin = path.x_m.data();
  const auto after = std::upper_bound(begin, begin + path.x_m.size(), x) - begin;
  const Eigen::Index first = std::clamp<Eigen::Index>(after - 2, 0, path.x_m.size() - 4);
  return lagrange_polynomials(path.x_m.segment<4>(first), x).dot(path.e_m.segment<4>(first));
}

bool ascends(const Eigen::VectorXd& x) {
  return ((x.tail(x.size() - 1) - x.head(x.size() - 1)).array() > 0.0).all();
}

double deepest_place(const TipPath& path) {
  Eigen::Index at = 0;
  path.e_m.maxCoeff(&at);
  return path.x_m(at);
}

/// The distance from its deepest place, m, up to which a pass may take more than those of another turn: the parabola of
/// its arc, x²/2R, is by then as far out. `a_turn` passes make a turn, of which the deepest counts, so that runout is
/// no difference.
double reach_of_deepest(const std::vector<const TipPath*>& paths, std::size_t a_turn, double radius_m) {
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t first = 0; first + a_turn <= paths.size(); first += a_turn) {
    double deepest = -std::numeric_limits<double>::infinity();
    for (std::size_t i = first; i < first + a_turn; ++i) deepest = std::max(deepest, paths[i]->e_m.maxCoeff());
    least = std::min(least, deepest);
    most = std::max(most, deepest);
  }
  return most > least ? std::sqrt(2.0 * radius_m * (most - least)) : 0.0;
}

/// The error that the deepest of several tips leaves at a place; −∞ where none passes.
double deepest_at(const std::vector<const TipPath*>& paths, double x) {
  double deepest = -std::numeric_limits<double>::infinity();
  for (const TipPath* path : paths) {
    if (x >= path->x_m(0) && x <= path->x_m(samples_a_pass - 1)) deepest = std::max(deepest, height_at(*path, x));
  }
  return deepest;
}

/// The top of the cusp between two places, where a falling arc meets a rising one: by thirds, which need no slopes.
double cusp_between(const std::vector<const TipPath*>& paths, double low, double high) {
  for (int pass = 0; pass < 40; ++pass) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    if (deepest_at(paths, a) < deepest_at(paths, b)) {
      high = b;
    } else {
      low = a;
    }
  }
  return deepest_at(paths, 0.5 * (low + high));
}

/// The least error of a wall. Cusps that are within a tenth of the range of the least step are looked at between steps.
double highest_cusp(const Wall& wall, const std::vector<const TipPath*>& paths) {
  const double least = wall.error_m.minCoeff();
  const double near_least = least + 0.1 * (wall.error_m.maxCoeff() - least);
  double highest = least;
  for (Eigen::Index i = 1; i + 1 < wall.x_m.size(); ++i) {
    const double here = wall.error_m(i);
    if (here > near_least || here > wall.error_m(i - 1) || here > wall.error_m(i + 1)) continue;
    highest = std::min(highest, cusp_between(paths, wall.x_m(i - 1), wall.x_m(i + 1)));
  }
  return highest;
}

/// Points between the ends that a filter of this cutoff takes.
Eigen::Index left_by_filter(const Wall& wall, double cutoff_m) {
  const double step = wall.x_m(1) - wall.x_m(0);
  return wall.x_m.size() - 2 * static_cast<Eigen::Index>(std::ceil(cutoff_m / step));
}

}  // namespace

std::optional<double> rotation_to_wall(const Engagement& arc, int side) {
  constexpr double round_off_rad = 1e-9;
  const double wall = side > 0 ? 0.0 : std::numbers::pi;
  double s = std::fmod(wall - arc.entry_rad + 2.0 * turn_rad, turn_rad);
  if (s > turn_rad - round_off_rad) s = 0.0;
  if (s > arc.arc_rad() + round_off_rad) return {};
  return s;
}

double recorded_length_m(const WallOptions& options, double feed_a_turn_m) {
  constexpr int lost_turns = 4;  // at the ends, and of what vibration shifts
  return std::max(0, options.turns - lost_turns) * feed_a_turn_m;
}

void set_roughness(Wall& wall) {
  const Eigen::ArrayXd about = wall.error_m.array() - wall.error_m.mean();
  wall.mean_m = wall.error_m.mean();
  wall.R_a_m = about.abs().mean();
  wall.R_q_m = std::sqrt(about.square().mean());
  wall.R_t_m = about.maxCoeff() - about.minCoeff();
}

WallRecorder::WallRecorder(const MillingProcess& process, double feed_m_per_rad, const std::vector<TipPass>& tips,
                           double period_rad, const WallOptions& options)
    : radius_m_(0.5 * process.cutter.diameter_m),
      feed_m_per_rad_(feed_m_per_rad),
      feed_a_turn_m_(feed_m_per_rad * turn_rad),
      periods_a_turn_(std::lround(turn_rad / period_rad)),
      options_(options) {
  if (options.turns == 0) return;
  const Cutter& cutter = process.cutter;
  const double reach = std::min(reach_rad + feed_a_turn_m_ / radius_m_, 0.45 * period_rad);
  for (int i = 0; i < samples_a_pass; ++i) offset_rad_.push_back(reach * (2.0 * i / (samples_a_pass - 1) - 1.0));
  for (const TipPass& tip : tips) {
    const double runout = cutter.runout_m.empty() ? 0.0 : cutter.runout_m[static_cast<std::size_t>(tip.tooth)];
    for (const int side : {1, -1}) {
      const auto to_wall = rotation_to_wall({tip.entry_phi_rad, tip.entry_phi_rad + tip.arc_rad}, side);
      if (!to_wall) continue;
      for (std::size_t h = 0; h < options.heights_m.size(); ++h) {
        const double at = tip.entry_rad + *to_wall + options.heights_m[h] * cutter.lag_rad_per_m(tip.tooth);
        for (int i = 0; i < samples_a_pass; ++i) {
          const double rotation = at + offset_rad_[static_cast<std::size_t>(i)];
          samples_.push_back({within_period(rotation, period_rad), static_cast<int>(open_.size()), i});
        }
        const Eigen::VectorXd empty(samples_a_pass);
        open_.push_back({side, radius_m_ + runout, false, {static_cast<int>(h), empty, empty}});
      }
    }
  }
  std::stable_sort(samples_.begin(), samples_.end(),
                   [](const Sample& a, const Sample& b) { return a.rotation_rad < b.rotation_rad; });
}

void WallRecorder::begin_period(double recorded_rad) {
  recorded_rad_ = recorded_rad;
  next_ = 0;
}

void WallRecorder::operator()(const MarchStep& step) {
  if (recorded_rad_ < 0.0) return;
  const double to = step.from_rad + step.step_rad;
  for (; next_ < samples_.size() && samples_[next_].rotation_rad < to; ++next_) {
    const Sample& sample = samples_[next_];
    OpenPath& open = open_[static_cast<std::size_t>(sample.path)];
    if (sample.place == 0) open.begun = true;
    if (!open.begun) continue;
    const Eigen::Vector3d q =
        step.value(sample.rotation_rad, [](const MarchNode& n) { return Eigen::Vector3d(n.displacement_m); });
    // Angle from the normal of the wall; n = (sin φ, cos φ), so that along the feed the tip goes backwards at φ = π.
    const double offset = offset_rad_[static_cast<std::size_t>(sample.place)];
    const double moved = feed_m_per_rad_ * (recorded_rad_ + sample.rotation_rad);
    const Eigen::Index ascending = open.side > 0 ? sample.place : samples_a_pass - 1 - sample.place;
    open.path.x_m(ascending) = moved + q.x() + open.side * open.radius_m * std::sin(offset);
    open.path.e_m(ascending) = open.side * q.y() + open.radius_m * std::cos(offset) - radius_m_;
    if (sample.place + 1 < samples_a_pass) continue;
    if (ascends(open.path.x_m)) done_.emplace_back(open.side, open.path);
    open.begun = false;
  }
}

std::size_t WallRecorder::passes_a_turn(int side, int height) const {
  const auto passes = std::ranges::count_if(
      open_, [&](const OpenPath& open) { return open.side == side && open.path.height == height; });
  return static_cast<std::size_t>(periods_a_turn_ * passes);
}

std::vector<Wall> WallRecorder::walls() const {
  std::vector<Wall> walls;
  for (const int side : {1, -1}) {
    for (std::size_t h = 0; h < options_.heights_m.size(); ++h) {
      std::vector<const TipPath*> paths;
      for (const auto& [of_side, path] : done_) {
        if (of_side == side && path.height == static_cast<int>(h)) paths.push_back(&path);
      }
      if (paths.size() < 2) continue;
      // Closer to the first and the last pass the wall is not finished: passes before and after may be deeper there.
      const double unfinished =
          std::max(feed_a_turn_m_, reach_of_deepest(paths, passes_a_turn(side, static_cast<int>(h)), radius_m_));
      const double from = deepest_place(*paths.front()) + unfinished;
      const double to = deepest_place(*paths.back()) - unfinished;
      const auto feeds = static_cast<Eigen::Index>(std::floor((to - from) / feed_a_turn_m_ + 1e-9));
      if (feeds < 1) continue;
      Wall wall{side, options_.heights_m[h], {}, {}};
      const Eigen::Index points = feeds * points_a_feed;
      wall.x_m =
          Eigen::VectorXd::LinSpaced(points + 1, from, from + static_cast<double>(feeds) * feed_a_turn_m_).head(points);
      wall.error_m.resize(points);
      for (Eigen::Index i = 0; i < points; ++i) wall.error_m(i) = deepest_at(paths, wall.x_m(i));
      if (!wall.error_m.allFinite()) continue;  // no recorded tip passed some place
      set_roughness(wall);
      wall.deepest_m = wall.error_m.maxCoeff();
      wall.highest_m = highest_cusp(wall, paths);
      wall.R_t_m = wall.deepest_m - wall.highest_m;
      if (options_.cutoff_m > 0.0 && !(left_by_filter(wall, options_.cutoff_m) >= 2)) continue;
      walls.push_back(options_.cutoff_m > 0.0 ? filtered(wall, options_.cutoff_m) : std::move(wall));
    }
  }
  return walls;
}

Wall filtered(const Wall& wall, double cutoff_m) {
  const Eigen::Index size = wall.x_m.size();
  const double step = size > 1 ? wall.x_m(1) - wall.x_m(0) : 0.0;
  const Eigen::Index left = cutoff_m > 0.0 && size > 1 ? left_by_filter(wall, cutoff_m) : 0;
  if (left < 2) {
    std::ostringstream text;
    text << "wall: cutoff " << cutoff_m << " m, must be above 0 and below half of the profile's "
         << static_cast<double>(size) * step << " m; record more turns or take a shorter one";
    throw core::InputError(text.str());
  }
  const Eigen::Index half = (size - left) / 2;
  // ISO 16610-21: weight exp(−π (x/(α λ_c))²)/(α λ_c) with α = √(ln 2/π), which halves a wave of length λ_c.
  const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);
  Eigen::ArrayXd weight(2 * half + 1);
  for (Eigen::Index i = -half; i <= half; ++i) {
    const double x = static_cast<double>(i) * step / (alpha * cutoff_m);
    weight(i + half) = std::exp(-std::numbers::pi * x * x);
  }
  weight /= weight.sum();
  Wall result = wall;
  result.x_m = wall.x_m.segment(half, left);
  result.error_m.resize(left);
  for (Eigen::Index i = 0; i < left; ++i)
    result.error_m(i) = wall.error_m(i + half) - (weight * wall.error_m.segment(i, 2 * half + 1).array()).sum();
  set_roughness(result);
  result.mean_m = wall.mean_m;
  return result;
}

}  // namespace thinwall::milling
