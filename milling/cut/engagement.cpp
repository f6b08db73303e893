#include "milling/cut/engagement.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

bool overlap(const Engagement& a, const Engagement& b) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  constexpr double touch = 1e-9;
  const auto into_turn = [](double angle) { return angle - full_turn * std::floor(angle / full_turn); };
  return into_turn(b.entry_rad - a.entry_rad + touch) < a.arc_rad() ||
         into_turn(a.entry_rad - b.entry_rad + touch) < b.arc_rad();
}

}  // namespace

Engagement engagement_of(const Cutter& cutter, double radial_depth_m, MillingDirection direction) {
  if (!(radial_depth_m > 0.0) || !(radial_depth_m <= cutter.diameter_m)) {
    std::ostringstream text;
    text << "engagement: radial depth " << radial_depth_m << " m, must be above 0 and at most the cutter's diameter "
         << cutter.diameter_m << " m; reduce the radial depth or take a larger cutter";
    throw core::InputError(text.str());
  }
  const double immersion = 2.0 * radial_depth_m / cutter.diameter_m;
  if (direction == MillingDirection::up) return {0.0, std::acos(1.0 - immersion)};
  return {std::acos(immersion - 1.0), std::numbers::pi};
}

std::vector<std::string> validate(const Engagement& engagement) {
  constexpr double full_turn = 2.0 * std::numbers::pi * (1.0 + 1e-12);
  const double arc = engagement.arc_rad();
  if (arc > 0.0 && arc <= full_turn && std::isfinite(engagement.entry_rad)) return {};
  std::ostringstream text;
  text << "engagement: from " << engagement.entry_rad << " to " << engagement.exit_rad
       << " rad, the arc must be above 0 and at most 2π; correct the entry or the exit angle";
  return {text.str()};
}

std::vector<std::string> validate(const std::vector<Engagement>& arcs) {
  std::vector<std::string> violations;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const auto own = validate(arcs[i]);
    violations.insert(violations.end(), own.begin(), own.end());
    for (std::size_t j = 0; own.empty() && j < i; ++j) {
      if (!overlap(arcs[i], arcs[j])) continue;
      std::ostringstream text;
      text << "engagement: the arc that enters at " << arcs[i].entry_rad << " rad overlaps the one that enters at "
           << arcs[j].entry_rad << " rad; join them, or correct the angles";
      violations.push_back(text.str());
    }
  }
  return violations;
}

std::vector<CutSegment> cut_segments(const Engagement& engagement, const Cutter& cutter) {
  const double pitch = cutter.pitch_rad();
  const double pitches = engagement.arc_rad() / pitch;
  const int whole = static_cast<int>(std::floor(pitches + 1e-9));
  const double rest = (pitches - whole) * pitch;
  std::vector<CutSegment> segments;
  const bool overlap = rest > 1e-9 * pitch;
  if (overlap) segments.push_back({0.0, rest, whole + 1});
  if (whole > 0) segments.push_back({overlap ? rest : 0.0, pitch, whole});
  return segments;
}

}  // namespace thinwall::milling
