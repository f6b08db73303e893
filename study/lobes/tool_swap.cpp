#include "study/lobes/tool_swap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "coupling/finite_difference_rotations.hpp"
#include "dynamics/conversion.hpp"
#include "fem/beam.hpp"
#include "robot/modal_table.hpp"
#include "setup/measured.hpp"
#include "study/lobes/line_warnings.hpp"

namespace thinwall::study {

namespace {

using Eigen::Vector3d;

constexpr auto root = "root";
constexpr int most_lines = 4000;

dynamics::Tube tube(const setup::ToolStep& step) {
  return {step.outer_diameter, step.inner_diameter, step.youngs_modulus, step.poisson_ratio, step.density};
}

/// The tool with the points that are wanted: its tip, its root and, where `up` is not empty, a point `distance` up.
dynamics::SpatialModel free_tool(const std::vector<setup::ToolStep>& steps, const setup::ToolSwap& swap,
                                 const std::string& up, const Vector3d& axis) {
  constexpr int elements = 8;
  std::vector<fem::CylinderStep> cylinders;
  std::vector<std::string> names{swap.tip};
  double from = 0.0;
  for (const setup::ToolStep& step : steps) {
    const double to = from + step.length;
    const bool inside = !up.empty() && swap.distance > from && swap.distance < to;
    if (inside) {
      cylinders.push_back({swap.distance - from, tube(step), elements});
      names.push_back(up);
      from = swap.distance;
    }
    cylinders.push_back({to - from, tube(step), elements});
    names.push_back(!up.empty() && to == swap.distance ? up : "");
    from = to;
  }
  if (!up.empty() && !(swap.distance < from))
    throw core::InputError("tool.swap.distance: the second point lies beyond the overhang of the measured tool");
  names.back() = root;
  return fem::tool_beam(cylinders, names, axis);
}

/// The lowest frequency of a tool whose root is held rigidly, Hz.
double clamped_frequency_hz(const std::vector<setup::ToolStep>& steps) {
  constexpr int elements = 4;
  fem::BeamFrame frame;
  frame.nodes.push_back({Vector3d::Zero(), "", true});
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
    const std::size_t before = frame.nodes.size() - 1;
    frame.nodes.push_back({frame.nodes.back().position_m + step->length * Vector3d::UnitZ(), ""});
    frame.segments.push_back({before, before + 1, dynamics::section(tube(*step)), elements});
  }
  frame.nodes.back().name = "tip";
  return dynamics::undamped_modes(fem::spatial_model(frame)).omega_rad_s.minCoeff() / (2.0 * std::numbers::pi);
}

/// H = U diag(1/(ω_r² − ω²)) Uᵀ over all its modes, rigid motions among them.
dynamics::ResponseModel free_response(const dynamics::SpatialModel& tool, const dynamics::FrequencyAxis& axis) {
  const dynamics::UndampedModes modes = dynamics::undamped_modes(tool);
  const Eigen::MatrixXd U = dynamics::displacements(tool) * modes.Phi;
  dynamics::ResponseModel response{axis, tool.dofs, tool.dofs, {}};
  response.H.resize(static_cast<std::size_t>(axis.size()));
  core::parallel_for(response.H.size(), [&](std::size_t line) {
    const double omega = axis.omega_rad_s(static_cast<Eigen::Index>(line));
    const Eigen::VectorXd gain = (modes.omega_rad_s.array().square() - omega * omega).inverse();
    response.H[line] = (U * gain.asDiagonal() * U.transpose()).cast<std::complex<double>>();
  });
  return response;
}

/// Two directions across the axis, in the order in which the FRFs name them.
std::vector<Vector3d> directions_of(const dynamics::ResponseModel& measured, const Vector3d& axis) {
  std::vector<Vector3d> directions;
  for (const dynamics::Dof& dof : measured.responses) {
    if (std::abs(dof.direction.dot(axis)) > 1e-6)
      throw core::InputError("tool.swap.measured: \"" + dynamics::name(dof) +
                             "\" is not across cutting.tool_axis; measure in the two directions that are");
    if (std::ranges::find(directions, dof.direction) == directions.end()) directions.push_back(dof.direction);
  }
  return directions;
}

/// Translations and the turns of bending in the same planes, held rigidly: what both tools have in common.
coupling::Contact joint(const std::vector<Vector3d>& directions, const Vector3d& axis) {
  coupling::Contact contact{root, "holder", {}};
  for (const Vector3d& d : directions) {
    coupling::ContactSpring along, about;
    along.direction = d;
    about.direction = axis.cross(d).normalized();
    about.kind = dynamics::DofKind::rotation;
    contact.springs.push_back(along);
    contact.springs.push_back(about);
  }
  return contact;
}

coupling::RotationRule rule_of(setup::SwapRotations rotations) {
  if (rotations == setup::SwapRotations::rank_one) return coupling::RotationRule::rank_one;
  return rotations == setup::SwapRotations::corrected ? coupling::RotationRule::corrected
                                                      : coupling::RotationRule::second_difference;
}

/// The measured FRFs as they are, or as the tip's displacements and rotations.
dynamics::ResponseModel with_rotations(const dynamics::ResponseModel& measured, const setup::ToolSwap& swap,
                                       const std::vector<Vector3d>& directions, const Vector3d& axis) {
  if (swap.rotations == setup::SwapRotations::none) return measured;
  coupling::RotationOptions options;
  options.rule = rule_of(swap.rotations);
  options.tip_section = tube(swap.reference.front());
  return coupling::finite_difference_rotations(measured, {swap.tip, swap.up, swap.distance, axis, directions}, options)
      .T;
}

/// What both swaps of a case have in common, whatever was measured.
struct Swap {
  setup::ToolSwap of;
  Vector3d axis;
  std::vector<Vector3d> directions;
  coupling::HeldTool reference, target;
};

Swap swap_on(const setup::ToolSwap& swap, const Vector3d& axis, const dynamics::ResponseModel& measured) {
  const std::vector<Vector3d> directions = directions_of(measured, axis);
  const coupling::Contact held = joint(directions, axis);
  return {swap,
          axis,
          directions,
          {free_response(free_tool(swap.reference, swap, swap.up, axis), measured.axis), held},
          {free_response(free_tool(swap.target, swap, "", axis), measured.axis), held}};
}

dynamics::ResponseModel response_of(const dynamics::ModalTable& table, const dynamics::FrequencyAxis& lines) {
  return dynamics::to_response(robot::modal_model(table), lines);
}

SwappedResponse swapped(const Swap& swap, const dynamics::ResponseModel& measured) {
  const coupling::SwappedTool in_machine =
      coupling::tool_swap(with_rotations(measured, swap.of, swap.directions, swap.axis), swap.reference, swap.target);
  SwappedResponse result{{}, in_machine.status, 0.0, 0.0};
  Eigen::Index worst = 0;
  result.worst_condition = in_machine.holder.condition.maxCoeff(&worst);
  result.at_frequency_hz = measured.axis.hz(worst);
  if (in_machine.status == coupling::SwapStatus::rank_deficient) {
    throw core::NumericalError(
        "tool.swap: at " + std::to_string(result.at_frequency_hz) +
        " Hz the measured FRFs say nothing of the holder (they are those of the free tool, or not "
        "independent); leave out such lines");
  }
  const dynamics::ResponseModel tip = dynamics::between(in_machine.coupled.response, swap.of.tip, swap.of.tip);
  dynamics::DofTable dofs;
  Eigen::MatrixXd E(std::ssize(swap.directions), std::ssize(tip.responses));
  for (const Vector3d& direction : swap.directions) {
    dofs.push_back({swap.of.tip, direction, dynamics::DofKind::translation});
    E.row(std::ssize(dofs) - 1) = dynamics::displacement_row(tip.responses, swap.of.tip, direction).transpose();
  }
  result.tip = {tip.axis, dofs, dofs, {}};
  for (const Eigen::MatrixXcd& H : tip.H) result.tip.H.emplace_back(E * H * E.transpose());
  return result;
}

/// The tip in space: along its axis nothing holds the tool here.
SwappedTip in_space(const SwappedResponse& response) {
  SwappedTip result{{response.tip.axis.hz, {}}, response.status, response.worst_condition, response.at_frequency_hz};
  const Eigen::Matrix3Xd D =
      dynamics::displacement_matrix(response.tip.responses, response.tip.responses.front().point);
  for (const Eigen::MatrixXcd& H : response.tip.H) result.tip.H.emplace_back(D * H * D.transpose());
  return result;
}

/// The FRFs with the reference tool, on the lines of their first file or those of the modes: as the other tool may be
/// damped less than the modes are, twice as many until its peaks are resolved.
dynamics::ResponseModel with_reference(const setup::ToolSwap& swap, const Vector3d& axis) {
  if (!swap.measured.empty())
    return setup::measured_response(swap.measured, setup::receptance_of(swap.measured.front()).axis);
  if (!swap.table)
    throw core::InputError(
        "tool.swap has neither FRFs nor the modes of a robot; call setup::identify() for those, or give "
        "tool.swap.measured");
  dynamics::ResponseModel response = response_of(*swap.table, lines_of_modes(swap));
  while (response.axis.size() < most_lines &&
         unresolved_peak_hz(in_space(swapped_response(swap, axis, response)).tip)) {
    const Eigen::VectorXd& hz = response.axis.hz;
    const int lines = std::min(2 * static_cast<int>(hz.size()), most_lines);
    response = response_of(*swap.table, dynamics::logarithmic_axis(hz(0), hz(hz.size() - 1), lines));
  }
  return response;
}

}  // namespace

dynamics::FrequencyAxis lines_of_modes(const setup::ToolSwap& swap) {
  constexpr double least = 20.0;
  const auto [low, high] = std::ranges::minmax(swap.table->rows, {}, &dynamics::ModalTableRow::frequency_hz);
  const double half = 0.5 * low.frequency_hz, to = swap.to_hz.value_or(high.frequency_hz);
  if (!(to > half))
    throw core::InputError("tool.swap.to: " + core::readable_text(to, core::kind::frequency) +
                           " lies below the modes of the robot's table, must be above " +
                           core::readable_text(half, core::kind::frequency));
  const double ratio = low.frequency_hz / clamped_frequency_hz(swap.target);
  const double from = half / std::hypot(1.0, ratio);  // half of Dunkerley's frequency for the other tool in its place
  double damping = 1.0;
  for (const dynamics::ModalTableRow& row : swap.table->rows)
    if (row.frequency_hz <= to) damping = std::min(damping, row.damping_ratio);
  return dynamics::logarithmic_axis(
      from, to, static_cast<int>(std::clamp(2.0 * std::log(to / from) / damping, least, 1.0 * most_lines)));
}

std::optional<double> unresolved_peak_hz(const milling::SampledReceptance& tip) {
  constexpr double least_lines = 4.0;
  const Eigen::VectorXd& hz = tip.frequency_hz;
  if (hz.size() < 2) return std::nullopt;
  const double step = std::log(hz(hz.size() - 1) / hz(0)) / static_cast<double>(hz.size() - 1);
  for (const milling::Resonance& peak : milling::resonances(tip))
    if (2.0 * peak.half_width_hz < least_lines * step * peak.frequency_hz) return peak.frequency_hz;
  return std::nullopt;
}

SwappedResponse swapped_response(const setup::ToolSwap& swap, const Vector3d& axis,
                                 const dynamics::ResponseModel& measured) {
  return swapped(swap_on(swap, axis, measured), measured);
}

SwappedTip swapped_tip(const setup::CutSetup& source) {
  const setup::ToolSwap& swap = *source.tool->swap;
  return in_space(swapped_response(swap, source.cutting->tool_axis, with_reference(swap, source.cutting->tool_axis)));
}

void warn_of_swap(const setup::Tool& tool, const SwappedTip& swapped) {
  if (swapped.status == coupling::SwapStatus::ill_conditioned)
    core::warn(fmt::format(
        "the tool swap lost more than half of its digits (condition {:.1e} at {:.1f} Hz): expect errors there",
        swapped.worst_condition, swapped.at_frequency_hz));
  if (const auto peak = setup::swapped_on_robot(tool) ? unresolved_peak_hz(swapped.tip) : std::nullopt)
    core::warn(
        fmt::format("the swapped tool's peak at {:.1f} Hz has less than four of the {} lines in its width, the most "
                    "that are taken: bound them by tool.swap.to",
                    *peak, swapped.tip.frequency_hz.size()));
  warn_of_energy(swapped.tip, "the swapped tool's");
}

TipOfModes tip_of_modes(const setup::CutSetup& source) {
  const dynamics::ResponseModel expected = with_reference(*source.tool->swap, source.cutting->tool_axis);
  return [axis = expected.axis, swap = swap_on(*source.tool->swap, source.cutting->tool_axis, expected)](
             const dynamics::ModalTable& table) { return in_space(swapped(swap, response_of(table, axis))); };
}

std::vector<SwappedTip> swapped_tips(const setup::CutSetup& source, const std::vector<dynamics::ModalTable>& tables) {
  const TipOfModes tip = tip_of_modes(source);
  std::vector<SwappedTip> tips(tables.size());
  core::parallel_for(tables.size(), [&](std::size_t i) { tips[i] = tip(tables[i]); });
  return tips;
}

}  // namespace thinwall::study
