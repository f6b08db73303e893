// Bindings of robot: a robot's tip from the result of a hammer test.

#include "python/bindings.hpp"
#include "robot/one_mode.hpp"

namespace thinwall::python {

namespace {

using Mode = std::tuple<double, double, double, py::object>;

dynamics::SpatialModel oscillators(const std::vector<Mode>& table, const std::string& point) {
  std::vector<robot::OneMode> modes;
  for (const auto& [hz, ratio, stiffness, along] : table)
    modes.push_back(robot::one_mode(hz, ratio, stiffness, directions(along).at(0)));
  return robot::spatial_model(modes, point);
}

}  // namespace

void bind_robot(py::module_& module) {
  module.def("oscillators", oscillators, "modes"_a, "point"_a,
             "A robot's or a tool's tip as independent modes, each (frequency_hz, damping_ratio, stiffness_n_per_m,\n"
             "direction) with a letter or a unit vector.");
}

}  // namespace thinwall::python
