#include "milling/direct/lobe_row.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

namespace thinwall::milling {

std::string name(Bifurcation kind) {
  switch (kind) {
    case Bifurcation::hopf:
      return "hopf";
    case Bifurcation::flip:
      return "flip";
    case Bifurcation::fold:
      break;
  }
  return "fold";
}

Bifurcation bifurcation_of(std::complex<double> mu) {
  if (mu.imag() != 0.0) return Bifurcation::hopf;
  return mu.real() < 0.0 ? Bifurcation::flip : Bifurcation::fold;
}

Bifurcation bifurcation_at(double theta_rad) {
  if (theta_rad == std::numbers::pi) return Bifurcation::flip;
  return theta_rad == 0.0 ? Bifurcation::fold : Bifurcation::hopf;
}

std::string name(StabilityStatus status) {
  switch (status) {
    case StabilityStatus::converged:
      return "converged";
    case StabilityStatus::node_limit_reached:
      return "node_limit_reached";
    case StabilityStatus::data_limited:
      return "data_limited";
    case StabilityStatus::data_insufficient:
      return "data_insufficient";
    case StabilityStatus::stable_to_depth_limit:
      return "stable_to_depth_limit";
    case StabilityStatus::crossing_missed:
      break;
  }
  return "crossing_missed";
}

double multiplier_angle_rad(const LobePoint& point, double period_s) {
  constexpr double turn = 2.0 * std::numbers::pi;
  if (point.kind == Bifurcation::flip) return 0.5 * turn;
  if (point.kind == Bifurcation::fold) return 0.0;
  return std::abs(std::remainder(turn * point.chatter_frequency_hz * period_s, turn));
}

std::vector<std::string> validate(const StabilityOptions& options) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const char* what, double value, const char* bound) {
    if (holds) return;
    std::ostringstream text;
    text << "stability: " << what << " is " << value << ", must be " << bound;
    violations.push_back(text.str());
  };
  require(options.depth_limit_m > 0.0 && std::isfinite(options.depth_limit_m), "depth limit", options.depth_limit_m,
          "a positive depth in m; give the tool's cutting length");
  require(options.error_tolerance > 0.0 && options.error_tolerance < 1.0, "error tolerance", options.error_tolerance,
          "between 0 and 1; 0.0001 is usual");
  require(options.follow >= 1.0, "depth to follow crossings to, over the first one's,", options.follow,
          "at least 1; 20 is usual");
  require(options.most_nodes >= 8, "largest number of nodes", options.most_nodes, "at least 8; 240 is usual");
  return violations;
}

bool answers(StabilityStatus status) {
  return status == StabilityStatus::converged || status == StabilityStatus::stable_to_depth_limit ||
         status == StabilityStatus::data_limited;
}

void take_limit_from_crossings(LobeRow& row) {
  if (row.crossings.empty()) return;
  const LobePoint& first = row.crossings.front();
  row.limiting_depth_m = first.depth_m;
  row.chatter_frequency_hz = first.chatter_frequency_hz;
  row.kind = first.kind;
  row.error_estimate = first.error_estimate;
}

}  // namespace thinwall::milling
