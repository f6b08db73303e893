#include "milling/tool.hpp"

#include <Eigen/Geometry>
#include <cmath>
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

}  // namespace

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
