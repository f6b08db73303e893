#include "milling/cut/chip_load.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <sstream>

#include "core/error.hpp"
#include "milling/cut/process.hpp"

namespace thinwall::milling {

namespace {

constexpr int samples = 2000;  // midpoints of an arc: the kinks where a tooth leaves the cut cost some 1e-6

/// A surface left by an earlier tooth: the feed since then, and how far that tooth reaches beyond this one.
struct Surface {
  double feed_m = 0.0;
  double beyond_m = 0.0;
};

std::vector<Surface> surfaces_before(const Cutter& cutter, int tooth, double feed_m) {
  std::vector<Surface> surfaces;
  const auto runout = [&](int j) {
    return cutter.runout_m.empty() ? 0.0 : cutter.runout_m[static_cast<std::size_t>(j)];
  };
  double turned = 0.0;
  for (int k = 1; k <= cutter.teeth; ++k) {
    turned += cutter.pitch_rad((tooth - k + 1 + cutter.teeth) % cutter.teeth);
    const int before = (tooth - k + cutter.teeth) % cutter.teeth;
    surfaces.push_back({feed_m * turned / cutter.pitch_rad(), runout(before) - runout(tooth)});
  }
  return surfaces;
}

double thickness(const std::vector<Surface>& surfaces, double phi) {
  double least = std::numeric_limits<double>::infinity();
  for (const Surface& s : surfaces) least = std::min(least, s.feed_m * std::sin(phi) - s.beyond_m);
  return std::max(0.0, least);
}

ChipLoad load_of(const std::vector<Surface>& surfaces, const std::vector<Engagement>& arcs) {
  double area = 0.0;
  double missed = 0.0;
  double all = 0.0;
  for (const Engagement& arc : arcs) {
    const double step = arc.arc_rad() / samples;
    for (int i = 0; i < samples; ++i) {
      const double h = thickness(surfaces, arc.entry_rad + (i + 0.5) * step);
      area += step * h;
      if (h == 0.0) missed += step;
    }
    all += arc.arc_rad();
  }
  return {area > 0.0 ? area / (all - missed) : 0.0, area > 0.0 ? 1.0 - missed / all : 0.0};
}

}  // namespace

std::vector<ChipLoad> chip_loads(const Cutter& cutter, const std::vector<Engagement>& arcs, double feed_m) {
  if (!(feed_m > 0.0) || !std::isfinite(feed_m)) {
    std::ostringstream text;
    text << "chip thickness: feed per tooth " << feed_m << " m, must be positive; give the feed";
    throw core::InputError(text.str());
  }
  std::vector<ChipLoad> loads;
  loads.reserve(static_cast<std::size_t>(cutter.teeth));
  for (int j = 0; j < cutter.teeth; ++j) loads.push_back(load_of(surfaces_before(cutter, j, feed_m), arcs));
  if (std::none_of(loads.begin(), loads.end(), [](const ChipLoad& l) { return l.mean_thickness_m > 0.0; })) {
    throw core::InputError(
        "chip thickness: no tooth cuts a chip between entry and exit, at least one must; "
        "the feed makes chips from 0 to 180°, correct the angles");
  }
  return loads;
}

double feed_per_tooth_m(const Cutter& cutter, double feed_rate_m_s, double spindle_speed_rpm) {
  if (!(feed_rate_m_s > 0.0) || !std::isfinite(feed_rate_m_s)) {
    std::ostringstream text;
    text << "feed rate " << feed_rate_m_s << " m/s, must be positive; correct the feed rate";
    throw core::InputError(text.str());
  }
  return feed_rate_m_s * tooth_period_s(cutter, spindle_speed_rpm);
}

}  // namespace thinwall::milling
