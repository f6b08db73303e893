#include "milling/simulation/exact_path.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "milling/simulation/chip_force.hpp"
#include "milling/simulation/earlier_paths.hpp"
#include "milling/simulation/path_march.hpp"

namespace thinwall::milling {

std::vector<std::string> validate(const PathOptions& options) {
  std::vector<std::string> violations;
  if (options.steps_a_turn < 24) {
    violations.push_back("simulation: " + std::to_string(options.steps_a_turn) +
                         " steps a turn, must be at least 24; 720 are usual");
  }
  if (options.earlier_passes < 1 || options.earlier_passes > 1000) {
    violations.push_back("simulation: " + std::to_string(options.earlier_passes) +
                         " earlier passes, must be 1 to 1000; 10 are usual");
  }
  return violations;
}

SimulatedCut simulate_exact_path(const RelativeStructure& structure, const MillingProcess& process, const ForceLaw& law,
                                 const SimulatedPoint& point, const Stock& stock, const SimulationOptions& options,
                                 const PathOptions& paths, const TurnObserver& after_turn) {
  require_usable(process, law, point, options);
  require_valid(validate(stock));
  require_valid(validate(paths));
  const PathCut cut =
      path_cut(structure, process, point, options, paths.steps_a_turn, paths.earlier_passes, paths.contact);
  double farthest = 0.0;
  for (const ToothDisc& disc : cut.discs) farthest = std::max(farthest, disc.earlier.back().ahead_rad);
  const auto remembered = static_cast<std::size_t>((farthest + 1.0) / cut.node_rad) + 16;
  EarlierPaths material(stock, cut.feed_per_node_m, cut.node_rad, cut.start_m.head<2>(), remembered);
  return with_chip_force(process, law, [&](const auto& chip_force) {
    return over_path(cut, material, chip_force, process, options, after_turn);
  });
}

}  // namespace thinwall::milling
