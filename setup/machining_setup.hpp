#pragma once
// A machining set-up: part, robot, contacts, tool and cut as typed data in SI (frequencies in Hz, spindle speeds in
// rpm).

#include <optional>
#include <string>
#include <vector>

#include "milling/chart/machine_limits.hpp"
#include "setup/calibration.hpp"
#include "setup/chart.hpp"
#include "setup/contact.hpp"
#include "setup/cutting.hpp"
#include "setup/fit.hpp"
#include "setup/measured_frf.hpp"
#include "setup/observed.hpp"
#include "setup/part.hpp"
#include "setup/part_model.hpp"
#include "setup/point.hpp"
#include "setup/robot.hpp"
#include "setup/simulation.hpp"
#include "setup/tool.hpp"

namespace thinwall::setup {

/// The part, its named points, and the model of it that is asked for. This is all that the part's own stages read.
struct PartSetup {
  std::optional<Part> part;
  std::vector<Selection> selections;
  std::vector<Point> points;
  Modes modes;
  Reduction reduction;
  Damping damping;
  ResponseOptions response;
};

/// A part that is known by measured FRFs instead of a model.
struct MeasuredPart {
  std::vector<MeasuredFrf> measured_part;
  std::vector<Sensor> part_sensors;  ///< during all of `measured_part`
};

/// The robot, the places where it holds the part, and the options of the coupling.
struct SupportSetup {
  std::optional<Robot> robot;
  std::vector<SupportContact> contacts;
  CouplingChoice coupling;
};

/// The cutter, the cut, the stability chart that is asked for, and the cuts that were made.
struct CutSetup {
  std::optional<Tool> tool;
  std::optional<Cutting> cutting;
  std::optional<LobesOptions> lobes;
  std::optional<milling::MachineLimits> machine;
  std::vector<ObservedCuts> observed;
  std::optional<Calibration> calibration;
};

/// True if a robot carries the tool and is not in the tip already, as in that of a tool that is swapped in at its
/// modes.
[[nodiscard]] inline bool robot_beside_tool(const SupportSetup& support, const CutSetup& cut) {
  return carries_tool(support.robot) && !(cut.tool && swapped_on_robot(*cut.tool));
}

/// All that is known of one set-up. What is absent is not computed. A stage takes those of the bases that it reads.
struct Setup : PartSetup, MeasuredPart, SupportSetup, CutSetup {
  std::vector<Updating> updating;
  std::optional<Path> path;
  std::optional<Simulation> simulation;
};

/// The point of that name; throws InputError with the nearest name if there is none.
[[nodiscard]] const Point& point(const PartSetup& source, const std::string& name);

/// True if a name of part.supports is a set of nodes of the mesh file, that is, neither a face of the box around the
/// part (x_min …) nor a selection.
[[nodiscard]] bool names_node_set(const PartSetup& source, const std::string& name);

}  // namespace thinwall::setup
