#include "coupling/sensitivity.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "coupling/coupled_line.hpp"

namespace thinwall::coupling {

CouplingSensitivity coupling_sensitivity(const std::vector<dynamics::ResponseModel>& components,
                                         const std::vector<Contact>& contacts, const CouplingOptions& options) {
  require_valid(options);
  if (options.regularisation != Regularisation::none) {
    throw core::InputError("sensitivity of a coupling: its kernel is regularised; couple without a regularisation");
  }
  Components all;
  for (const dynamics::ResponseModel& component : components) all.push_back(&component);
  const Joints joined = joints(contacts, options.length);
  const std::vector<Interface> parts = interfaces(all, joined, options.points);
  const dynamics::FrequencyAxis& axis = components.front().axis;
  Eigen::Index responses = 0, forces = 0;  // of all components
  for (const dynamics::ResponseModel& component : components) {
    responses += static_cast<Eigen::Index>(component.responses.size());
    forces += static_cast<Eigen::Index>(component.forces.size());
  }
  const auto lines = static_cast<std::size_t>(axis.size());
  CouplingSensitivity sensitivity{wanted_responses(parts), wanted_forces(parts), std::vector<Eigen::MatrixXcd>(lines),
                                  std::vector<Eigen::MatrixXcd>(lines)};
  core::parallel_for(lines, [&](std::size_t line) {
    CoupledLine work(parts, joined, options.regularisation, options.threshold);
    Eigen::MatrixXcd coupled;
    const double hz = axis.hz(static_cast<Eigen::Index>(line));
    require_solvable(work.couple(line, axis.omega_rad_s(static_cast<Eigen::Index>(line)), coupled), hz);
    Eigen::MatrixXcd &P = sensitivity.P[line], &Q = sensitivity.Q[line];
    P.resize(coupled.rows(), responses);
    Q.resize(forces, coupled.cols());
    Eigen::Index column = 0, row = 0;
    for (const Interface& part : parts) {
      P.middleCols(column, static_cast<Eigen::Index>(part.model->responses.size())) = work.P(part);
      Q.middleRows(row, static_cast<Eigen::Index>(part.model->forces.size())) = work.Q(part);
      column += static_cast<Eigen::Index>(part.model->responses.size());
      row += static_cast<Eigen::Index>(part.model->forces.size());
    }
  });
  return sensitivity;
}

}  // namespace thinwall::coupling
