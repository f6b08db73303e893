// Bindings of milling in the time domain.

#include "milling/simulation/simulation.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/growth.hpp"
#include "python/bindings.hpp"
#include "python/cut_structure.hpp"

namespace thinwall::python {

namespace {

using MatricesOrModes = std::variant<dynamics::SpatialModel, dynamics::ModalModel>;

milling::RelativeStructure felt(const MatricesOrModes& structure, const std::optional<std::string>& at) {
  return std::visit([&](const auto& model) { return poles(model, at); }, structure);
}

/// The samples once a tooth, an array for each of their members.
py::dict passes_of(const std::vector<milling::ToothPass>& passes) {
  const auto count = static_cast<Eigen::Index>(passes.size());
  Eigen::VectorXi tooth(count);
  Eigen::VectorXd entry_s(count);
  Eigen::MatrixX3d entry(count, 3), velocity(count, 3), exit(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const milling::ToothPass& pass = passes[static_cast<std::size_t>(i)];
    tooth(i) = pass.tooth;
    entry_s(i) = pass.entry_s;
    entry.row(i) = pass.entry_m;
    velocity.row(i) = pass.entry_m_s;
    exit.row(i) = pass.exit_m;
  }
  return py::dict("tooth"_a = tooth, "entry_s"_a = entry_s, "entry_m"_a = entry, "entry_m_s"_a = velocity,
                  "exit_m"_a = exit);
}

py::dict trace_of(const milling::Trace& trace) {
  const auto samples = trace.torque_n_m.size();
  const Eigen::VectorXd time =
      Eigen::VectorXd::LinSpaced(samples, 0.0, static_cast<double>(samples - 1)) * trace.step_s;
  return py::dict("time_s"_a = Eigen::VectorXd(time.array() + trace.start_s),
                  "displacement_m"_a = Eigen::MatrixX3d(trace.displacement_m.transpose()),
                  "force_n"_a = Eigen::MatrixX3d(trace.force_n.transpose()), "torque_n_m"_a = trace.torque_n_m);
}

py::list walls_of(const std::vector<milling::Wall>& walls) {
  py::list list;
  for (const milling::Wall& wall : walls) {
    list.append(py::dict("side"_a = wall.side, "height_m"_a = wall.height_m, "x_m"_a = wall.x_m,
                         "error_m"_a = wall.error_m, "mean_m"_a = wall.mean_m, "R_a_m"_a = wall.R_a_m,
                         "R_q_m"_a = wall.R_q_m, "R_t_m"_a = wall.R_t_m));
  }
  return list;
}

/// Shoulder or slot of the process's first arc: the radial depth whose straight wall has this arc.
milling::Stock stock_of(const milling::MillingProcess& process) {
  const milling::Engagement& arc = process.engagement;
  constexpr double hair = 1e-9;
  const double radius = 0.5 * process.cutter.diameter_m;
  if (std::abs(arc.entry_rad) < hair)
    return milling::shoulder(process.cutter, radius * (1.0 - std::cos(arc.exit_rad)), milling::MillingDirection::up);
  if (std::abs(arc.exit_rad - std::numbers::pi) < hair)
    return milling::shoulder(process.cutter, radius * (1.0 + std::cos(arc.entry_rad)), milling::MillingDirection::down);
  throw core::InputError("exact paths need a cut with a radial_depth_m, not an arc that no straight wall has");
}

py::dict simulate(const MatricesOrModes& structure, const milling::MillingProcess& process, double spindle_speed_rpm,
                  double depth_m, double feed_per_tooth_m, const std::optional<std::string>& at,
                  const std::string& paths, int settling_turns, int recorded_turns, int traced_turns, int wall_turns,
                  int steps) {
  if (paths != "circular" && paths != "exact")
    throw core::InputError("paths are \"circular\" or \"exact\", not \"" + paths + "\"");
  milling::SimulationOptions options;
  options.settling_turns = settling_turns;
  options.recorded_turns = recorded_turns;
  options.traced_turns = traced_turns;
  options.wall.turns = wall_turns;
  options.steps.steps_in_cut = steps;
  const milling::SimulatedPoint point{spindle_speed_rpm, depth_m, feed_per_tooth_m};
  const auto look = [](double /*share*/) { core::check_interrupt(); };
  const milling::SimulatedCut cut = [&] {
    const LongCall guard;
    const milling::RelativeStructure relative = felt(structure, at);
    if (paths == "circular") return milling::simulate(relative, process, process.coefficients, point, options, look);
    return milling::simulate_exact_path(relative, process, process.coefficients, point, stock_of(process), options, {},
                                        look);
  }();
  return dict_of(cut);
}

py::dict growth(const MatricesOrModes& structure, const milling::MillingProcess& process, double spindle_speed_rpm,
                double depth_m, const std::optional<std::string>& at, int steps) {
  const milling::SimulatedGrowth found = [&] {
    const LongCall guard;
    return milling::simulated_growth(felt(structure, at), process, spindle_speed_rpm, depth_m, {.steps_in_cut = steps});
  }();
  return py::dict("multiplier"_a = found.multiplier, "modulus"_a = found.modulus,
                  "error_estimate"_a = found.error_estimate, "converged"_a = found.converged);
}

}  // namespace

py::dict dict_of(const milling::SimulatedCut& cut) {
  return py::dict("status"_a = milling::name(cut.status), "simulated_s"_a = cut.simulated_s,
                  "motion"_a = milling::name(cut.motion.motion), "period"_a = cut.motion.period,
                  "peak_to_peak_m"_a = Eigen::Vector3d(cut.displacement_m.range()), "peak_force_n"_a = cut.peak_force_n,
                  "mean_force_n"_a = cut.mean_force_n, "peak_torque_n_m"_a = cut.peak_torque_n_m,
                  "mean_torque_n_m"_a = cut.mean_torque_n_m, "mean_power_w"_a = cut.mean_power_w,
                  "thickest_chip_m"_a = cut.thickest_chip_m, "share_without_contact"_a = cut.share_without_contact,
                  "passes"_a = passes_of(cut.passes), "trace"_a = trace_of(cut.trace), "walls"_a = walls_of(cut.walls));
}

void bind_simulation(py::module_& module) {
  module.def("simulate", simulate, "structure"_a, "process"_a, "spindle_speed_rpm"_a, "depth_m"_a, "feed_per_tooth_m"_a,
             py::kw_only(), "at"_a = py::none(), "paths"_a = "circular", "settling_turns"_a = 200,
             "recorded_turns"_a = 200, "traced_turns"_a = 0, "wall_turns"_a = 0, "steps"_a = 200,
             "The vibration of a cut whose teeth may leave the material, step by step.\n\n"
             "structure: SpatialModel or ModalModel. paths: circular (teeth on circles, fixed angles of entry and\n"
             "exit), or exact (their real paths, contact by geometry; needs a radial_depth_m). steps: of a tooth from\n"
             "entry to exit; exact paths take 720 a turn. Returns a dict of figures over the recorded turns, with\n"
             "samples once a tooth (passes), the last traced_turns sample by sample (trace) and the walls of the last\n"
             "wall_turns. Displacements are those of tool minus part, forces act on the tool, both in the axes of the\n"
             "cut (feed, normal, axis). status: completed, overflowed, unsettled,\n"
             "surface_lost or too_coarse.");
  module.def("simulated_growth", growth, "structure"_a, "process"_a, "spindle_speed_rpm"_a, "depth_m"_a, py::kw_only(),
             "at"_a = py::none(), "steps"_a = 200,
             "The factor by which a small vibration grows in a period of the simulated cut, as a dict of multiplier,\n"
             "modulus, error_estimate and converged: what multiplier() finds by another way.");
}

}  // namespace thinwall::python
