#include "study/lobes/cut_structure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "dynamics/conversion.hpp"
#include "io/frf/resample.hpp"
#include "setup/measured.hpp"
#include "setup/milling_process.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/line_warnings.hpp"
#include "study/lobes/tool_swap.hpp"

namespace thinwall::study {

namespace {

bool has_poles(const setup::Tool& tool) {
  return !tool.modes.empty() || tool.fitted;
}

milling::RelativeStructure tool_modes(const setup::Tool& tool) {
  if (tool.fitted) return milling::relative_structure(tool.fitted->model, "tool");
  return milling::relative_structure(dynamics::to_modal(robot::spatial_model(setup::one_modes(tool.modes), "tool")),
                                     "tool");
}

/// The tool's files as a matrix in part axes, on `axis`.
milling::SampledReceptance measured_tip(const std::vector<setup::MeasuredFrf>& files,
                                        const dynamics::FrequencyAxis& axis) {
  milling::SampledReceptance tip{axis.hz, {}};
  tip.H.assign(static_cast<std::size_t>(axis.size()), Eigen::Matrix3cd::Zero());
  for (const setup::MeasuredFrf& file : files) {
    const Eigen::VectorXcd H = io::resample(setup::receptance_of(file), axis);
    if (H.isZero(0.0) && file.response == file.force)
      core::warn(fmt::format("{}: every line along {} is 0, as of a tool that is rigid there: look at the file",
                             file.file.string(), file.response));
    const int i = direction_of_dof(file.response);
    const int j = direction_of_dof(file.force);
    const bool reverse_given = gives_reverse(files, file);
    for (Eigen::Index line = 0; line < axis.size(); ++line) {
      auto& matrix = tip.H[static_cast<std::size_t>(line)];
      matrix(i, j) = H(line);
      if (!reverse_given) matrix(j, i) = H(line);
    }
  }
  return tip;
}

milling::SampledReceptance in_tool_axes(milling::SampledReceptance tip, const milling::ToolFrame& frame) {
  const Eigen::Matrix3d R = frame.rotation();
  for (Eigen::Matrix3cd& H : tip.H) H = (R.transpose() * H * R).eval();
  return tip;
}

/// The poles that stand for a measured tip, on its lines.
milling::SampledReceptance fitted_on_its_lines(const setup::Tool& tool) {
  milling::SampledReceptance tip{setup::receptance_of(tool.measured.front()).axis.hz, {}};
  const milling::RelativeStructure poles = tool_modes(tool);
  for (const double hz : tip.frequency_hz) tip.H.emplace_back(milling::receptance(poles, 2.0 * std::numbers::pi * hz));
  return tip;
}

/// What the messages call the owner of tip_lines().
std::string owner_of_tip(const setup::Tool& tool) {
  return tool.swap ? "the swapped tool's" : "the tool's";
}

/// The fit of lines in tool axes, with a warning where the lines are those of no passive structure.
milling::FittedStructure fitted(milling::SampledReceptance lines,
                                const std::optional<milling::RelativeStructure>& poles, const milling::ToolFrame& frame,
                                const std::string& whose) {
  milling::FittedStructure fit = milling::fitted_structure({std::move(lines), poles}, frame);
  warn_of_growing_motion(fit.growing, whose);
  return fit;
}

}  // namespace

dynamics::ModalModel kept_modes(const setup::CutSetup& source, const dynamics::ModalModel& part) {
  if (!source.lobes || !source.lobes->modes_up_to_hz) return part;
  return dynamics::truncate(part, 2.0 * std::numbers::pi * *source.lobes->modes_up_to_hz, true);
}

milling::RelativeStructure part_structure(const setup::CutSetup& source, const dynamics::ModalModel& part) {
  return milling::relative_structure(kept_modes(source, part), source.cutting->at);
}

std::optional<double> usual_modes_up_to_hz(const Eigen::VectorXd& fixed_interface_hz) {
  constexpr double beyond_reduction = 1.5;
  if (fixed_interface_hz.size() == 0) return std::nullopt;
  return beyond_reduction * fixed_interface_hz.maxCoeff();
}

int direction_of_dof(const std::string& dof) {
  return dof.back() - 'x';
}

bool gives_reverse(const std::vector<setup::MeasuredFrf>& files, const setup::MeasuredFrf& file) {
  return std::ranges::any_of(files, [&](const setup::MeasuredFrf& other) {
    return other.response == file.force && other.force == file.response;
  });
}

std::optional<milling::RelativeStructure> cut_poles(const setup::CutSetup& source, const dynamics::ModalModel* part,
                                                    const dynamics::ModalModel* carrier) {
  std::optional<milling::RelativeStructure> poles;
  const auto add = [&](const milling::RelativeStructure& more) { poles = poles ? milling::sum(*poles, more) : more; };
  if (part != nullptr) add(part_structure(source, *part));
  if (has_poles(*source.tool)) add(tool_modes(*source.tool));
  if (carrier != nullptr) add(milling::relative_structure(*carrier, carrier->dofs.front().point));
  return poles;
}

std::optional<milling::SampledReceptance> synthesised_tip(const setup::CutSetup& source,
                                                          const CutStructure& structure) {
  if (source.tool->fitted) return fitted_on_its_lines(*source.tool);
  const auto* fit = std::get_if<milling::FittedStructure>(&structure);
  if (fit == nullptr || (!source.tool->swap && source.tool->measured.empty())) return std::nullopt;
  milling::SampledReceptance tip{fit->lines.samples.frequency_hz, {}};
  for (const double hz : tip.frequency_hz) {
    const double omega = 2.0 * std::numbers::pi * hz;
    tip.H.emplace_back(milling::receptance(fit->all.poles, omega));
    if (fit->lines.poles) tip.H.back() -= milling::receptance(*fit->lines.poles, omega);
  }
  return tip;
}

milling::FittedStructure sampled_structure(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                           const dynamics::ResponseModel& coupled) {
  const dynamics::ResponseModel at_cut = dynamics::between(coupled, source.cutting->at, source.cutting->at);
  const Eigen::Matrix3Xd D = dynamics::displacement_matrix(at_cut.responses, source.cutting->at);
  milling::SampledReceptance felt{coupled.axis.hz, {}};
  felt.H.reserve(at_cut.H.size());
  for (const Eigen::MatrixXcd& H : at_cut.H) felt.H.emplace_back(D * H * D.transpose());
  warn_of_energy(felt, "the supported part's");
  if (source.tool->swap) throw core::InputError("a swapped tool has lines of its own; give the tool by modes");
  std::optional<milling::RelativeStructure> tool;
  if (setup::known_by_lines(*source.tool)) {
    const milling::SampledReceptance tip = measured_tip(source.tool->measured, coupled.axis);
    for (std::size_t line = 0; line < felt.H.size(); ++line) felt.H[line] += tip.H[line];
  } else if (has_poles(*source.tool)) {
    tool = tool_modes(*source.tool);
  }
  return fitted(in_tool_axes(std::move(felt), frame), tool, frame, "the supported part's");
}

milling::SampledReceptance tip_lines(const setup::CutSetup& source, const milling::ToolFrame& frame) {
  if (source.tool->swap) {
    SwappedTip swapped = swapped_tip(source);
    warn_of_swap(*source.tool, swapped);
    return in_tool_axes(std::move(swapped.tip), frame);
  }
  const dynamics::FrequencyAxis& lines = setup::receptance_of(source.tool->measured.front()).axis;
  milling::SampledReceptance tip = measured_tip(source.tool->measured, lines);
  warn_of_energy(tip, owner_of_tip(*source.tool));
  return in_tool_axes(std::move(tip), frame);
}

CutStructure cut_structure(const setup::CutSetup& source, const milling::ToolFrame& frame,
                           const dynamics::ModalModel* part, const dynamics::ModalModel* carrier) {
  return cut_structure(source, frame, cut_poles(source, part, carrier));
}

CutStructure cut_structure(const setup::CutSetup& source, const milling::ToolFrame& frame,
                           const std::optional<milling::RelativeStructure>& modal) {
  if (setup::known_by_lines(*source.tool))
    return fitted(tip_lines(source, frame), modal, frame, owner_of_tip(*source.tool));
  if (!modal)
    throw core::InputError(
        "lobes need something that moves: a part, tool.modes, tool.measured, or a robot that carries the tool");
  return *modal;
}

}  // namespace thinwall::study
