#pragma once
// A machining set-up: part, robot, contacts, tool and cut as typed data in SI (frequencies in Hz, spindle speeds in
// rpm).

#include <optional>
#include <string>
#include <vector>

#include "milling/chart/machine_limits.hpp"
#include "setup/chart.hpp"
#include "setup/contact.hpp"
#include "setup/cutting.hpp"
#include "setup/fit.hpp"
#include "setup/measured_frf.hpp"
#include "setup/part.hpp"
#include "setup/part_model.hpp"
#include "setup/point.hpp"
#include "setup/robot.hpp"
#include "setup/tool.hpp"

namespace thinwall::setup {

/// All that is known of one set-up. What is absent is not computed.
struct Setup {
  std::optional<Part> part;
  std::vector<MeasuredFrf> measured_part;
  std::vector<Sensor> part_sensors;  ///< during all of `measured_part`
  std::vector<Selection> selections;
  std::vector<Point> points;
  Modes modes;
  Reduction reduction;
  Damping damping;
  std::optional<Robot> robot;
  std::vector<Contact> contacts;
  CouplingChoice coupling;
  ResponseOptions response;
  std::vector<Updating> updating;
  std::optional<Tool> tool;
  std::optional<Cutting> cutting;
  std::optional<LobesOptions> lobes;
  std::optional<milling::MachineLimits> machine;
  std::optional<Path> path;
};

/// The point of that name; throws InputError with the nearest name if there is none.
[[nodiscard]] const Point& point(const Setup& source, const std::string& name);

/// Whether a name of part.supports is a set of nodes of the mesh file: no face of the box around the part (x_min …),
/// no selection.
[[nodiscard]] bool names_node_set(const Setup& source, const std::string& name);

}  // namespace thinwall::setup
