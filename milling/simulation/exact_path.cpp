#include "milling/simulation/exact_path.hpp"

#include <algorithm>
#include <numbers>

#include "core/error.hpp"
#include "milling/simulation/chip_force.hpp"
#include "milling/simulation/earlier_paths.hpp"
#include "milling/simulation/modal_tool.hpp"
#include "milling/simulation/path_march.hpp"

namespace thinwall::milling {

namespace {

/// The tool of path_march.hpp that a function moves from node to node.
class StepwiseTool {
 public:
  static constexpr bool has_contact = false;

  StepwiseTool(const MovedTool& tool, const PathCut& cut)
      : tool_(tool), node_s_(cut.node_rad / cut.rad_per_s), rad_per_s_(cut.rad_per_s), at_(tool.start) {}

  void begin(MarchNode& /*node*/) const {}

  template <class LoadAt>
  int over_step(MarchStep& step, const LoadAt& load) {
    int unsettled = 0;
    for (const std::size_t c : {std::size_t{1}, std::size_t{2}}) {
      MarchNode& node = step.at[c];
      const MovedStep moved = tool_.step(node_s_, [&](const ToolPlace& place) -> Eigen::Vector3d {
        node.displacement_m = place.displacement_m;
        node.slope = place.velocity_m_s / rad_per_s_;
        load(c, node);
        return node.force_n;
      });
      at_ = moved.place;
      unsettled += moved.settled ? 0 : 1;
    }
    return unsettled;
  }

  [[nodiscard]] bool within(double radius_m) const {
    return at_.displacement_m.allFinite() && at_.displacement_m.cwiseAbs().maxCoeff() < radius_m;
  }

 private:
  const MovedTool& tool_;
  double node_s_, rad_per_s_;
  ToolPlace at_;
};

void require_usable(const MillingProcess& process, const ForceLaw& law, const SimulatedPoint& point, const Stock& stock,
                    const SimulationOptions& options, const PathOptions& paths) {
  require_usable(process, law, point, options);
  require_valid(validate(stock));
  require_valid(validate(paths));
  require_whole_steps(options, whole_steps(process, paths.steps_a_turn));
}

template <class Tool>
SimulatedCut march(const PathCut& cut, const Tool& tool, const MillingProcess& process, const ForceLaw& law,
                   const Stock& stock, const SimulationOptions& options, const TurnObserver& after_turn) {
  double farthest = 0.0;
  for (const ToothDisc& disc : cut.discs) farthest = std::max(farthest, disc.earlier.back().ahead_rad);
  const auto remembered = static_cast<std::size_t>((farthest + 0.5 * std::numbers::pi) / cut.node_rad) + 16;
  EarlierPaths material(stock, cut, remembered);
  return with_chip_force(process, law, [&](const auto& chip_force) {
    return over_path(cut, tool, material, chip_force, process, options, after_turn);
  });
}

}  // namespace

std::vector<std::string> validate(const PathOptions& options) {
  std::vector<std::string> violations;
  if (options.steps_a_turn < 24) {
    violations.push_back("simulation: " + std::to_string(options.steps_a_turn) +
                         " steps a turn, must be at least 24; 720 are usual");
  }
  if (options.earlier_passes < 1 || options.earlier_passes > 1000) {
    violations.push_back("simulation: " + std::to_string(options.earlier_passes) +
                         " earlier passes, must be 1 to 1000; 60 are usual");
  }
  return violations;
}

void require_whole_steps(const SimulationOptions& options, int steps_a_turn) {
  if (options.means_a_turn == 0 || steps_a_turn % options.means_a_turn == 0) return;
  throw core::InputError("simulation: " + std::to_string(steps_a_turn) + " steps a turn do not divide into the " +
                         std::to_string(options.means_a_turn) + " parts of which means are taken; take a multiple");
}

SimulatedCut simulate_exact_path(const RelativeStructure& structure, const MillingProcess& process, const ForceLaw& law,
                                 const SimulatedPoint& point, const Stock& stock, const SimulationOptions& options,
                                 const PathOptions& paths, const TurnObserver& after_turn) {
  require_usable(process, law, point, stock, options, paths);
  const PathCut cut =
      path_cut(structure, process, point, options, paths.steps_a_turn, paths.earlier_passes, paths.contact);
  return with_modal_tool(cut,
                         [&](const auto& tool) { return march(cut, tool, process, law, stock, options, after_turn); });
}

SimulatedCut simulate_exact_path(const MovedTool& tool, const MillingProcess& process, const ForceLaw& law,
                                 const SimulatedPoint& point, const Stock& stock, const SimulationOptions& options,
                                 const PathOptions& paths, const TurnObserver& after_turn) {
  require_usable(process, law, point, stock, options, paths);
  PathCut cut = path_cut(process, point, options, paths.steps_a_turn, paths.earlier_passes);
  cut.start_m = tool.start.displacement_m;
  return march(cut, StepwiseTool(tool, cut), process, law, stock, options, after_turn);
}

}  // namespace thinwall::milling
