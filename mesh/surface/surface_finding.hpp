#pragma once
// Something found on a surface: what, how often, where first.

#include <Eigen/Core>
#include <string>

#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// A kind of fault, how often it was found and where first.
struct SurfaceFinding {
  std::string what;                                   ///< follows the count: "facets that stand twice"
  int count = 0;                                      ///< 0: nothing found
  Eigen::Vector3d first_m = Eigen::Vector3d::Zero();  ///< where the first of them is, in the frame of the file
  std::string remedy{};                               ///< of a fault; empty for what was mended

  /// Counts one more at this place.
  void add(const Eigen::Vector3d& x_m) {
    if (count++ == 0) first_m = x_m;
  }
};

/// "3 facets that stand twice, the first at (1, 0, 20) mm", and the remedy.
[[nodiscard]] inline std::string text(const SurfaceFinding& finding) {
  return std::to_string(finding.count) + " " + finding.what + ", the first at " + place_text(finding.first_m) +
         (finding.remedy.empty() ? "" : " (" + finding.remedy + ")");
}

}  // namespace thinwall::mesh
