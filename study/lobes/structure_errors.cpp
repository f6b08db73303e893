#include "study/lobes/structure_errors.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <unsupported/Eigen/KroneckerProduct>

#include "core/error.hpp"
#include "coupling/error_budget.hpp"
#include "io/frf/resample.hpp"
#include "milling/chart/depth_band.hpp"
#include "milling/chart/sensitivity.hpp"
#include "setup/measured.hpp"
#include "setup/measured_noise.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

using Eigen::Index;
using Eigen::Matrix3cd;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

/// vec(Rᵀ H R) = (Rᵀ ⊗ Rᵀ) vec H.
Matrix9d turn_of_entries(const milling::ToolFrame& frame) {
  const Eigen::Matrix3d Rt = frame.rotation().transpose();
  return Eigen::kroneckerProduct(Rt, Rt);
}

/// The covariance of the tool's files on `axis`, part axes: an entry that serves as its transpose, too, scatters with
/// it.
milling::SampleCovariance tip_covariance(const std::vector<setup::MeasuredFrf>& files,
                                         const dynamics::FrequencyAxis& axis) {
  milling::SampleCovariance covariance;
  for (const setup::MeasuredFrf& file : files) {
    if (!file.noise && !file.averages) continue;
    const Eigen::VectorXd sigma = *setup::deviation_of(file, axis, io::resample(setup::receptance_of(file), axis));
    const Index i = direction_of_dof(file.response), j = direction_of_dof(file.force);
    Eigen::Vector<double, 9> felt = Eigen::Vector<double, 9>::Unit(i + 3 * j);
    if (!gives_reverse(files, file)) felt(j + 3 * i) = 1.0;
    covariance.resize(static_cast<std::size_t>(axis.size()), milling::SampleCovariance::value_type::Zero());
    for (Index line = 0; line < sigma.size(); ++line)
      covariance[static_cast<std::size_t>(line)] += 2.0 * sigma(line) * sigma(line) * felt * felt.transpose();
  }
  return covariance;
}

void add_tool_noise(const setup::CutSetup& source, const milling::ToolFrame& frame, const dynamics::FrequencyAxis& axis,
                    milling::SampleCovariance& noise) {
  if (!setup::known_by_lines(*source.tool)) return;
  const Matrix9d turn = turn_of_entries(frame);
  const milling::SampleCovariance tool = tip_covariance(source.tool->measured, axis);
  if (noise.empty()) noise.resize(tool.size(), milling::SampleCovariance::value_type::Zero());
  for (std::size_t line = 0; line < tool.size(); ++line) noise[line] += turn * tool[line] * turn.transpose();
}

/// The covariance of the coupled response at the point that is cut, tool axes.
milling::SampleCovariance coupled_noise(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                        const Results& results) {
  const std::string& at = source.cutting->at;
  const dynamics::DofTable dofs = dynamics::between(results.coupled->receptance.response, at, at).responses;
  std::vector<std::string> names;
  std::ranges::transform(dofs, std::back_inserter(names), dynamics::name);
  const auto covariance =
      coupling::entry_covariance({results.part->response, results.robot->response}, contacts_of(results.contacts),
                                 {{results.errors.part.noise}, {results.errors.robot.noise}}, names, names);
  const Eigen::Matrix3Xd E = frame.rotation().transpose() * dynamics::displacement_matrix(dofs, at);
  const Eigen::MatrixXd turn = Eigen::kroneckerProduct(E, E);
  milling::SampleCovariance turned;
  turned.reserve(covariance.size());
  for (const Eigen::MatrixXcd& of : covariance) turned.emplace_back(turn * of * turn.transpose());
  return turned;
}

/// Re Σ g dH over the samples' lines, dH of the samples and of the poles.
double depth_change(const std::vector<Matrix3cd>& gradient, const milling::SampledStructure& structure,
                    const StructureErrors& errors, const milling::ToolFrame& frame) {
  double change = 0.0;
  for (std::size_t line = 0; line < gradient.size(); ++line) {
    Matrix3cd dH = Matrix3cd::Zero();
    if (!errors.truncation.empty()) dH += errors.truncation[line];
    if (errors.richer) {
      const double omega = 2.0 * std::numbers::pi * structure.samples.frequency_hz(static_cast<Index>(line));
      const Eigen::Matrix3d R = frame.rotation();
      dH += R.transpose() * (receptance(*structure.poles, omega) - receptance(*errors.richer, omega)) * R;
    }
    change += gradient[line].cwiseProduct(dH).sum().real();
  }
  return change;
}

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

DepthError sampled_error(const milling::FittedStructure& structure, const StructureErrors& errors,
                         const milling::MillingProcess& process, double rpm, const milling::LobePoint& point,
                         const milling::StabilityOptions& options) {
  const auto gradient = milling::depth_gradient(structure, process, rpm, point, options);
  DepthError result;
  if (errors.richer || !errors.truncation.empty())
    result.truncation_m = if_finite(depth_change(gradient, structure.lines, errors, process.frame));
  if (!errors.noise.empty()) result.noise_m = if_finite(milling::depth_deviation_m(gradient, errors.noise));
  return result;
}

DepthError error_of_crossing(const CutStructure& structure, const StructureErrors& errors,
                             const milling::MillingProcess& process, const milling::LobeRow& row,
                             const milling::StabilityOptions& options) {
  if (row.crossings.empty()) return {};
  const milling::LobePoint& point = row.crossings.front();
  try {
    if (const auto* sampled = std::get_if<milling::FittedStructure>(&structure))
      return sampled_error(*sampled, errors, process, row.spindle_speed_rpm, point, options);
    if (!errors.richer) return {};
    const double change =
        milling::relative_depth_change(std::get<milling::RelativeStructure>(structure), *errors.richer, process,
                                       row.spindle_speed_rpm, point, options);
    DepthError result;
    result.truncation_m = if_finite(-change * point.depth_m);
    return result;
  } catch (const core::NumericalError&) {
    return {};  // the crossing was not found again
  }
}

std::optional<milling::DepthRange> identified_range(const CutStructure& structure, const StructureErrors& errors,
                                                    const milling::MillingProcess& process, const milling::LobeRow& row,
                                                    const milling::StabilityOptions& options) {
  if (const auto* sampled = std::get_if<milling::FittedStructure>(&structure))
    return errors.drawn_changes.empty() ? std::nullopt
                                        : milling::depth_range(*sampled, errors.drawn_changes, process, row, options);
  if (errors.draws.empty()) return std::nullopt;
  return milling::depth_range(std::get<milling::RelativeStructure>(structure), errors.draws, process, row, options);
}

}  // namespace

StructureErrors structure_errors(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                 const CutStructure& structure, const dynamics::ModalModel* richer_part,
                                 const dynamics::ModalModel* carrier) {
  StructureErrors errors;
  if (richer_part != nullptr) errors.richer = cut_poles(source, richer_part, carrier);
  if (const auto* sampled = std::get_if<milling::FittedStructure>(&structure); sampled && !source.tool->swap)
    add_tool_noise(source, frame, {sampled->lines.samples.frequency_hz}, errors.noise);
  return errors;
}

StructureErrors sampled_structure_errors(const setup::CutSetup& source, const milling::ToolFrame& frame,
                                         const Results& results) {
  StructureErrors errors;
  const dynamics::ResponseModel& coupled = results.coupled->receptance.response;
  const Eigen::Matrix3Xd E =
      frame.rotation().transpose() * dynamics::displacement_matrix(coupled.responses, source.cutting->at);
  for (const Eigen::MatrixXcd& off : results.errors.coupled.truncation)
    errors.truncation.emplace_back(E * off * E.transpose());
  if (!results.errors.coupled.noise.empty()) errors.noise = coupled_noise(source, frame, results);
  const bool coupled_noise_unknown = results.errors.coupled.noise.empty() &&
                                     !(results.errors.part.noise.empty() && results.errors.robot.noise.empty());
  if (!coupled_noise_unknown) add_tool_noise(source, frame, coupled.axis, errors.noise);
  return errors;
}

DepthError depth_error(const CutStructure& structure, const StructureErrors& errors,
                       const milling::MillingProcess& process, const milling::LobeRow& row,
                       const milling::StabilityOptions& options) {
  DepthError result = error_of_crossing(structure, errors, process, row, options);
  if (const auto range = identified_range(structure, errors, process, row, options)) {
    result.low_m = range->low_m;
    result.high_m = range->high_m;
  }
  return result;
}

}  // namespace thinwall::study
