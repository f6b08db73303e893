#include "milling/cut/tool.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <sstream>

namespace thinwall::milling {

namespace {

// The negations catch NaN as well.
void require_unit(const Eigen::Vector3d& v, const char* what, std::vector<std::string>& violations) {
  if (std::abs(v.norm() - 1.0) <= 1e-9) return;
  std::ostringstream text;
  text << "tool frame: " << what << " has length " << v.norm() << ", must be a unit vector; normalise it";
  violations.push_back(text.str());
}

void require_one_a_tooth(const std::vector<double>& values, int teeth, const char* what,
                         std::vector<std::string>& violations) {
  if (values.empty() || values.size() == static_cast<std::size_t>(std::max(0, teeth))) return;
  violations.push_back("cutter: " + std::to_string(values.size()) + " " + what + " for " + std::to_string(teeth) +
                       " teeth, must be one a tooth; give as many, or none");
}

void add_pitch_violations(const Cutter& cutter, std::vector<std::string>& violations) {
  if (cutter.pitches_rad.empty()) return;
  require_one_a_tooth(cutter.pitches_rad, cutter.teeth, "pitches", violations);
  const double sum = std::accumulate(cutter.pitches_rad.begin(), cutter.pitches_rad.end(), 0.0);
  const bool positive =
      std::all_of(cutter.pitches_rad.begin(), cutter.pitches_rad.end(), [](double p) { return p > 0.0; });
  if (positive && std::abs(sum - 2.0 * std::numbers::pi) <= 1e-6) return;
  std::ostringstream text;
  text << "cutter: pitches of together " << sum * 180.0 / std::numbers::pi
       << "°, each must be above 0 and their sum 360°; correct the pitches";
  violations.push_back(text.str());
}

void add_helix_violations(const Cutter& cutter, std::vector<std::string>& violations) {
  require_one_a_tooth(cutter.helices_rad, cutter.teeth, "helix angles", violations);
  constexpr double steepest = 80.0 * std::numbers::pi / 180.0;
  for (const double helix : cutter.helices_rad) {
    if (helix >= 0.0 && helix <= steepest) continue;
    std::ostringstream text;
    text << "cutter: helix of " << helix * 180.0 / std::numbers::pi << "°, must be 0 to 80°; correct the helix";
    violations.push_back(text.str());
  }
}

void add_runout_violations(const Cutter& cutter, std::vector<std::string>& violations) {
  require_one_a_tooth(cutter.runout_m, cutter.teeth, "runouts", violations);
  for (const double runout : cutter.runout_m) {
    if (std::abs(runout) < 0.5 * cutter.diameter_m) continue;
    std::ostringstream text;
    text << "cutter: runout " << runout << " m, must be smaller than half the diameter; give the radial offset";
    violations.push_back(text.str());
  }
}

}  // namespace

double Cutter::lag_rad_per_m(int tooth) const {
  return helices_rad.empty() ? 0.0 : 2.0 * std::tan(helices_rad[static_cast<std::size_t>(tooth)]) / diameter_m;
}

bool Cutter::has_helix() const {
  return std::any_of(helices_rad.begin(), helices_rad.end(), [](double h) { return h != 0.0; });
}

bool Cutter::equal_teeth() const {
  const auto differs = [](double a, double b) { return std::abs(a - b) > 1e-12; };
  return std::adjacent_find(pitches_rad.begin(), pitches_rad.end(), differs) == pitches_rad.end() &&
         std::adjacent_find(helices_rad.begin(), helices_rad.end(), differs) == helices_rad.end();
}

double edge_length_per_height(const Cutter& cutter, int tooth, double height_m) {
  const MeridianPoint point = at_height(cutter.envelope, cutter.diameter_m, height_m);
  const double slope = 1.0 / std::sin(point.kappa_rad);  // √(r'² + 1)
  return std::hypot(slope, point.radius_m * cutter.lag_rad_per_m(tooth));
}

ToolFrame leaning(const ToolFrame& frame, double lead_rad) {
  const double c = std::cos(lead_rad);
  const double s = std::sin(lead_rad);
  return {c * frame.feed - s * frame.axis, c * frame.axis + s * frame.feed};
}

Eigen::Matrix3d ToolFrame::rotation() const {
  Eigen::Matrix3d R;
  R << feed, axis.cross(feed), axis;
  return R;
}

std::vector<std::string> validate(const Cutter& cutter) {
  std::vector<std::string> violations;
  if (cutter.teeth < 1) {
    violations.push_back("cutter: " + std::to_string(cutter.teeth) +
                         " teeth, must be at least 1; give the number of teeth");
  }
  add_pitch_violations(cutter, violations);
  add_helix_violations(cutter, violations);
  add_runout_violations(cutter, violations);
  const auto envelope = validate(cutter.envelope, cutter.diameter_m);
  violations.insert(violations.end(), envelope.begin(), envelope.end());
  if (!(cutter.diameter_m > 0.0) || !std::isfinite(cutter.diameter_m)) {
    std::ostringstream text;
    text << "cutter: diameter " << cutter.diameter_m << " m, must be positive; give the diameter";
    violations.push_back(text.str());
  }
  return violations;
}

std::vector<std::string> validate(const ToolFrame& frame) {
  std::vector<std::string> violations;
  require_unit(frame.feed, "feed", violations);
  require_unit(frame.axis, "axis", violations);
  if (violations.empty() && !(std::abs(frame.feed.dot(frame.axis)) <= 1e-9)) {
    std::ostringstream text;
    text << "tool frame: feed · axis = " << frame.feed.dot(frame.axis)
         << ", must be 0; choose a feed direction at right angles to the tool axis";
    violations.push_back(text.str());
  }
  return violations;
}

}  // namespace thinwall::milling
