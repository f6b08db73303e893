#include "milling/chart/stability_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/cut_at_speed.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

namespace {

struct Column {
  Eigen::VectorXd modulus;
  double error_estimate = 0.0;
  bool converged = true;
};

double largest_modulus(const DiscreteCut& d, double depth_m) {
  return multipliers(d, depth_m).cwiseAbs().maxCoeff();
}

/// Largest change of |μ| between two grids at five of the depths.
double change(const DiscreteCut& coarse, const DiscreteCut& fine, const std::vector<double>& depths_m) {
  double largest = 0.0;
  for (int i = 1; i <= 5; ++i) {
    const double depth = depths_m[(depths_m.size() * static_cast<std::size_t>(i) - 1) / 5];
    const double modulus = largest_modulus(fine, depth);
    largest = std::max(largest, std::abs(largest_modulus(coarse, depth) - modulus) / std::max(1.0, modulus));
  }
  return largest;
}

Column column(const CutAtSpeed& cut, const std::vector<double>& depths_m, const StabilityOptions& options) {
  Resolution r = resolving(cut, depths_m.back());
  DiscreteCut coarse = discrete(cut, r, 0.0);
  Column result;
  while (true) {
    r = finer(r);
    DiscreteCut fine = discrete(cut, r, 0.0);
    result.error_estimate = change(coarse, fine, depths_m);
    result.converged = result.error_estimate <= options.error_tolerance;
    if (result.converged || 3 * fine.grid.node_rad.size() >= 2 * options.most_nodes) break;
    coarse = std::move(fine);
  }
  result.modulus.resize(static_cast<Eigen::Index>(depths_m.size()));
  std::transform(depths_m.begin(), depths_m.end(), result.modulus.begin(),
                 [&](double depth) { return largest_modulus(coarse, depth); });
  return result;
}

Column column_of_own_grids(const RelativeStructure& structure, const MillingProcess& process, double rpm,
                           const std::vector<double>& depths_m, const StabilityOptions& options) {
  Column result{Eigen::VectorXd(static_cast<Eigen::Index>(depths_m.size()))};
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    const Multiplier mu = multiplier_at(structure, process, rpm, depths_m[i], options);
    result.modulus(static_cast<Eigen::Index>(i)) = mu.modulus;
    result.error_estimate = std::max(result.error_estimate, mu.error_estimate * std::min(1.0, mu.modulus));
    result.converged = result.converged && mu.status == StabilityStatus::converged;
  }
  return result;
}

}  // namespace

StabilityMap stability_map(const RelativeStructure& structure, const MillingProcess& process,
                           const std::vector<double>& spindle_speeds_rpm, const std::vector<double>& depths_m,
                           const StabilityOptions& options) {
  require_usable(process, options);
  const auto usable = [](double depth) { return depth > 0.0 && std::isfinite(depth); };
  if (spindle_speeds_rpm.empty() || depths_m.empty() || !std::is_sorted(depths_m.begin(), depths_m.end()) ||
      !std::all_of(depths_m.begin(), depths_m.end(), usable)) {
    throw core::InputError("stability map: " + std::to_string(spindle_speeds_rpm.size()) + " speeds and " +
                           std::to_string(depths_m.size()) +
                           " depths, one of each at least is needed, and ascending depths above 0; correct the ranges");
  }
  StabilityMap map{spindle_speeds_rpm, depths_m, {}};
  map.modulus.resize(static_cast<Eigen::Index>(depths_m.size()), static_cast<Eigen::Index>(spindle_speeds_rpm.size()));
  std::vector<Column> columns(spindle_speeds_rpm.size());
  core::Progress progress("speeds of the map", columns.size());
  core::parallel_for(columns.size(), [&](std::size_t i) {
    const double rpm = spindle_speeds_rpm[i];
    columns[i] = process.cutter.depends_on_depth() ? column_of_own_grids(structure, process, rpm, depths_m, options)
                                                   : column(cut_at_speed(structure, process, rpm), depths_m, options);
    progress.step();
  });
  for (std::size_t i = 0; i < columns.size(); ++i) {
    map.modulus.col(static_cast<Eigen::Index>(i)) = columns[i].modulus;
    map.worst_error_estimate = std::max(map.worst_error_estimate, columns[i].error_estimate);
    map.speeds_not_converged += columns[i].converged ? 0 : 1;
  }
  return map;
}

}  // namespace thinwall::milling
