#include "coupling/receptance.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "coupling/coupled_line.hpp"
#include "coupling/kernel.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::ResponseModel;

/// Number of frequency lines that one task computes with one workspace.
constexpr Eigen::Index block_lines = 64;

/// The error bound ε |P| |Y| |Q| of the line that was coupled last.
Eigen::MatrixXd error_bound(const CoupledLine& work, const std::vector<Interface>& parts, std::size_t line,
                            double epsilon) {
  Eigen::MatrixXd bound;
  for (const Interface& component : parts) {
    const Eigen::MatrixXd share =
        epsilon * (work.P(component).cwiseAbs() * component.model->H[line].cwiseAbs() * work.Q(component).cwiseAbs());
    if (bound.size() == 0) bound.setZero(share.rows(), share.cols());
    bound += share;
  }
  return bound;
}

KernelStatus status_of(const CoupledResponse& coupled, Regularisation regularisation) {
  // Tikhonov's rule changes every singular value, those above its bound a little, so that nothing need be dropped for
  // the result to be regularised.
  if (coupled.dropped.any() || regularisation == Regularisation::tikhonov) return KernelStatus::regularised;
  if (coupled.kernel_condition.maxCoeff() > ill_conditioned_above) return KernelStatus::ill_conditioned;
  return KernelStatus::well_conditioned;
}

CoupledResponse couple(const Components& components, const std::vector<Contact>& contacts,
                       const CouplingOptions& options) {
  require_valid(options);
  const Joints joints = coupling::joints(contacts, options.length);
  const std::vector<Interface> parts = interfaces(components, joints, options.points);
  const dynamics::FrequencyAxis& axis = components.front()->axis;
  const auto lines = static_cast<std::size_t>(axis.size());
  CoupledResponse coupled;
  coupled.response = {axis, wanted_responses(parts), wanted_forces(parts), std::vector<Eigen::MatrixXcd>(lines)};
  coupled.kernel_condition.setZero(axis.size());
  coupled.dropped.setZero(axis.size());
  coupled.compatibility_residual.setZero(axis.size());
  if (options.component_error > 0.0) coupled.error.resize(lines);
  core::parallel_for((lines + block_lines - 1) / block_lines, [&](std::size_t block) {
    CoupledLine work(parts, joints, options.regularisation, options.threshold);
    const Eigen::Index first = static_cast<Eigen::Index>(block) * block_lines;
    for (Eigen::Index line = first; line < std::min(first + block_lines, axis.size()); ++line) {
      const auto i = static_cast<std::size_t>(line);
      const KernelLine kernel = work.couple(i, axis.omega_rad_s(line), coupled.response.H[i]);
      require_solvable(kernel, axis.hz(line));
      coupled.kernel_condition(line) = kernel.condition;
      coupled.dropped(line) = kernel.dropped;
      coupled.compatibility_residual(line) = kernel.compatibility_residual;
      if (options.component_error > 0.0) coupled.error[i] = error_bound(work, parts, i, options.component_error);
    }
  });
  coupled.status = status_of(coupled, options.regularisation);
  return coupled;
}

}  // namespace

void require_valid(const CouplingOptions& options) {
  std::ostringstream faults;
  const auto fault = [&](const char* what, double value, const char* bound) {
    faults << (faults.tellp() > 0 ? "; " : "") << what << " is " << value << ", but it must " << bound;
  };
  if (!(options.length > 0.0 && std::isfinite(options.length))) {
    fault("the length that scales rotations (m)", options.length, "be positive");
  }
  if (!(options.threshold > 0.0 && options.threshold < 1.0)) {
    fault("the threshold of singular values", options.threshold, "lie between 0 and 1");
  }
  if (!(options.component_error >= 0.0 && std::isfinite(options.component_error))) {
    fault("the relative error of the components", options.component_error, "not be negative");
  }
  if (faults.tellp() > 0) throw core::InputError(faults.str());
}

CoupledResponse couple(const std::vector<ResponseModel>& components, const std::vector<Contact>& contacts,
                       const CouplingOptions& options) {
  Components all;
  for (const ResponseModel& component : components) all.push_back(&component);
  return couple(all, contacts, options);
}

CoupledResponse couple(const ResponseModel& part, const ResponseModel& robot, const std::vector<Contact>& contacts,
                       const CouplingOptions& options) {
  return couple(Components{&part, &robot}, contacts, options);
}

Eigen::VectorXd relative_error(const CoupledResponse& coupled, const std::string& response, const std::string& force) {
  if (coupled.error.empty()) {
    throw core::InputError("no error was computed with the coupling: give CouplingOptions::component_error");
  }
  const int row = dynamics::row_of(coupled.response.responses, response);
  const int column = dynamics::row_of(coupled.response.forces, force);
  Eigen::VectorXd relative(coupled.response.axis.size());
  for (Eigen::Index line = 0; line < relative.size(); ++line) {
    const auto i = static_cast<std::size_t>(line);
    relative(line) = coupled.error[i](row, column) / std::abs(coupled.response.H[i](row, column));
  }
  return relative;
}

}  // namespace thinwall::coupling
