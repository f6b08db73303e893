#pragma once
// The stability chart that is asked for.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "milling/chart/lobe_method.hpp"
#include "milling/chart/sensitivity.hpp"

namespace thinwall::setup {

/// Uncertainties that a robust chart allows for.
struct RobustOptions {
  milling::Uncertainty uncertainty;
  double confidence = 2.0;  ///< k, standard uncertainties
};

/// The chart that is asked for: speeds, depths, method, and the answers beside it.
struct LobesOptions {
  double from_rpm = 0.0, to_rpm = 0.0;
  int count = 400;                ///< evenly spaced, the least
  double line_tolerance = 0.02;   ///< bound on the estimated relative error of the line between two speeds
  std::optional<int> most_added;  ///< speeds added for that; none: see most_added()
  double depth_limit = 0.0;       ///< m
  double tolerance = 1e-4;        ///< bound on the estimated relative error of the limiting depth
  std::optional<double> modes_up_to_hz;
  milling::Method method = milling::Method::direct;
  std::vector<milling::Method> compare = {};       ///< others
  std::optional<int> steps_per_period, harmonics;  ///< none: milling::MethodOptions' own
  std::optional<int> map_depths;                   ///< none: no map
  std::optional<RobustOptions> robust;
  std::optional<int> noise_samples;  ///< draws of what is measured, at the case's own speed; none: first order only
  int seed = 1;                      ///< of these
};

/// The number of speeds that may be added: twice as many as there are evenly spaced ones unless the case says.
[[nodiscard]] inline int most_added(const LobesOptions& lobes) {
  return lobes.most_added.value_or(2 * lobes.count);
}

}  // namespace thinwall::setup
