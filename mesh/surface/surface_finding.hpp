#pragma once
// Findings on a surface: their kind, number and first place.

#include <Eigen/Core>
#include <string>

#include "mesh/triangle_soup.hpp"

namespace thinwall::mesh {

/// A kind of fault or repair, the number of its occurrences, and the place of the first.
struct SurfaceFinding {
  std::string what;                                   ///< words that follow the count: "facets that stand twice"
  int count = 0;                                      ///< 0: nothing found
  Eigen::Vector3d first_m = Eigen::Vector3d::Zero();  ///< place of the first, in the frame of the file
  std::string remedy{};                               ///< remedy of a fault; empty for a repair

  /// Counts one more occurrence, at this place.
  void add(const Eigen::Vector3d& x_m) {
    if (count++ == 0) first_m = x_m;
  }
};

/// A line such as "3 facets that stand twice, the first at (1, 0, 20) mm", with the remedy behind it in brackets.
[[nodiscard]] inline std::string text(const SurfaceFinding& finding) {
  return std::to_string(finding.count) + " " + finding.what + ", the first at " + place_text(finding.first_m) +
         (finding.remedy.empty() ? "" : " (" + finding.remedy + ")");
}

}  // namespace thinwall::mesh
