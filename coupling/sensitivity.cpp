#include "coupling/sensitivity.hpp"

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::DofTable;
using dynamics::ResponseModel;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;

DofTable joined(const std::vector<ResponseModel>& components, DofTable ResponseModel::*table) {
  DofTable all;
  for (const ResponseModel& component : components) {
    all.insert(all.end(), (component.*table).begin(), (component.*table).end());
  }
  return all;
}

MatrixXcd block_diagonal(const std::vector<ResponseModel>& components, std::size_t line) {
  Index rows = 0, columns = 0;
  for (const ResponseModel& component : components) {
    rows += component.H[line].rows();
    columns += component.H[line].cols();
  }
  MatrixXcd Y = MatrixXcd::Zero(rows, columns);
  rows = columns = 0;
  for (const ResponseModel& component : components) {
    const MatrixXcd& H = component.H[line];
    Y.block(rows, columns, H.rows(), H.cols()) = H;
    rows += H.rows();
    columns += H.cols();
  }
  return Y;
}

/// B over one table of all components: a column a joined direction.
MatrixXd openings(const DofTable& dofs, const Joints& joints) {
  MatrixXd B(static_cast<Index>(dofs.size()), joints.size());
  for (Index j = 0; j < joints.size(); ++j) {
    const JoinedDirection& along = joints.directions[static_cast<std::size_t>(j)];
    B.col(j) = along.scale * (dynamics::displacement_row(dofs, along.point_a, along.direction, along.kind) -
                              dynamics::displacement_row(dofs, along.point_b, along.direction, along.kind));
  }
  return B;
}

std::vector<int> rows_of(const DofTable& dofs, const DofTable& wanted) {
  std::vector<int> rows;
  for (const dynamics::Dof& dof : wanted) rows.push_back(dynamics::row_of(dofs, dynamics::name(dof)));
  return rows;
}

}  // namespace

CouplingSensitivity coupling_sensitivity(const std::vector<ResponseModel>& components,
                                         const std::vector<Contact>& contacts, const CouplingOptions& options) {
  if (options.regularisation != Regularisation::none) {
    throw core::InputError("sensitivity of a coupling: its kernel is regularised; couple without a regularisation");
  }
  const CoupledResponse coupled = couple(components, contacts, options);  // refuses what cannot be joined
  const Joints all = joints(contacts, options.length);
  const DofTable responses = joined(components, &ResponseModel::responses);
  const DofTable forces = joined(components, &ResponseModel::forces);
  const MatrixXd B_response = openings(responses, all), B_force = openings(forces, all);
  const std::vector<int> rows = rows_of(responses, coupled.response.responses);
  const std::vector<int> columns = rows_of(forces, coupled.response.forces);
  const std::size_t lines = coupled.response.H.size();
  CouplingSensitivity sensitivity{coupled.response.responses, coupled.response.forces, std::vector<MatrixXcd>(lines),
                                  std::vector<MatrixXcd>(lines)};
  core::parallel_for(lines, [&](std::size_t line) {
    const MatrixXcd Y = block_diagonal(components, line);
    const MatrixXcd to_joints = B_response.transpose() * Y, from_joints = Y * B_force;
    MatrixXcd S = to_joints * B_force;
    MatrixXd magnitude = S.cwiseAbs();
    add_compliance(all, coupled.response.axis.omega_rad_s(static_cast<Index>(line)), S, magnitude);
    Kernel kernel(Regularisation::none, 0.5);
    (void)kernel.solve(S, magnitude, to_joints);  // its condition was judged by couple()
    MatrixXcd P = -(from_joints * kernel.inverse()) * B_response.transpose();
    P.diagonal().array() += 1.0;
    MatrixXcd Q = -B_force * kernel.solution();
    Q.diagonal().array() += 1.0;
    sensitivity.P[line] = P(rows, Eigen::all);
    sensitivity.Q[line] = Q(Eigen::all, columns);
  });
  return sensitivity;
}

}  // namespace thinwall::coupling
