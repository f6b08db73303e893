#include "coupling/receptance.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::coupling {

namespace {

using Complex = std::complex<double>;

constexpr double ill_conditioned_above = 1e8;
constexpr double singular_above = 1e14;

/// Columns of B for one component: the displacement of its contact points along each spring, from the DOFs of `dofs`.
Eigen::MatrixXd spring_columns(const dynamics::DofTable& dofs, const std::vector<Contact>& contacts,
                               std::string Contact::*point) {
  Eigen::MatrixXd B(static_cast<Eigen::Index>(dofs.size()), 0);
  for (const Contact& contact : contacts) {
    for (const ContactSpring& spring : contact.springs) {
      B.conservativeResize(Eigen::NoChange, B.cols() + 1);
      B.rightCols(1) = dynamics::displacement_row(dofs, contact.*point, spring.direction);
    }
  }
  return B;
}

/// 1 / Z of every spring at one frequency, m/N.
Eigen::VectorXcd spring_compliance(const std::vector<Contact>& contacts, double omega) {
  std::vector<Complex> compliance;
  for (const Contact& contact : contacts) {
    for (const ContactSpring& spring : contact.springs) {
      const double K = spring.stiffness;
      compliance.push_back(spring.rigid() ? 0.0 : 1.0 / Complex(K, K * spring.loss_factor + omega * spring.damping));
    }
  }
  return Eigen::Map<const Eigen::VectorXcd>(compliance.data(), static_cast<Eigen::Index>(compliance.size()));
}

void require_different_points(const dynamics::ResponseModel& part, const dynamics::ResponseModel& robot) {
  for (const dynamics::Dof& a : part.responses) {
    for (const dynamics::Dof& b : robot.responses) {
      if (a.point == b.point) {
        throw core::InputError("part and robot both have a point \"" + a.point + "\": rename one of them");
      }
    }
  }
}

[[noreturn]] void refuse_kernel(double hz, double condition) {
  std::ostringstream text;
  text.precision(10);
  text << "the kernel of the receptance coupling is singular at " << hz << " Hz (condition " << condition << ", bound "
       << singular_above << "): two contact directions say the same, or an undamped coupled mode lies there";
  throw core::NumericalError(text.str());
}

/// B of both components, for responses (rows) and forces (columns).
struct Interface {
  Eigen::MatrixXd part_response, part_force, robot_response, robot_force;
};

/// One line: G into `coupled`, the kernel's condition returned.
double couple_line(const Eigen::MatrixXcd& H_P, const Eigen::MatrixXcd& H_R, const Interface& B,
                   const Eigen::VectorXcd& compliance, Eigen::MatrixXcd& coupled) {
  const Eigen::Index rows_P = H_P.rows(), rows_R = H_R.rows(), columns_P = H_P.cols(), columns_R = H_R.cols();
  Eigen::MatrixXcd to_springs(compliance.size(), columns_P + columns_R);
  to_springs << B.part_response.transpose() * H_P, -B.robot_response.transpose() * H_R;
  Eigen::MatrixXcd from_springs(rows_P + rows_R, compliance.size());
  from_springs << H_P * B.part_force, -H_R * B.robot_force;

  const Eigen::MatrixXcd S_P = to_springs.leftCols(columns_P) * B.part_force;
  const Eigen::MatrixXcd S_R = -to_springs.rightCols(columns_R) * B.robot_force;
  Eigen::MatrixXcd S = S_P + S_R;
  S.diagonal() += compliance;
  Eigen::MatrixXd magnitude = S_P.cwiseAbs() + S_R.cwiseAbs();
  magnitude.diagonal() += compliance.cwiseAbs();
  const Eigen::FullPivLU<Eigen::MatrixXcd> lu(S);
  const Eigen::MatrixXd inverse = lu.solve(Eigen::MatrixXcd::Identity(S.rows(), S.cols())).cwiseAbs();

  coupled.setZero(rows_P + rows_R, columns_P + columns_R);
  coupled.topLeftCorner(rows_P, columns_P) = H_P;
  coupled.bottomRightCorner(rows_R, columns_R) = H_R;
  coupled -= from_springs * lu.solve(to_springs);
  return lu.isInvertible() ? (inverse * magnitude).rowwise().sum().maxCoeff() : std::numeric_limits<double>::infinity();
}

dynamics::DofTable joined(const dynamics::DofTable& part, const dynamics::DofTable& robot) {
  dynamics::DofTable table = part;
  table.insert(table.end(), robot.begin(), robot.end());
  return table;
}

}  // namespace

CoupledResponse couple(const dynamics::ResponseModel& part, const dynamics::ResponseModel& robot,
                       const std::vector<Contact>& contacts) {
  require_valid(contacts);
  dynamics::require_equal(part.axis, robot.axis);
  require_different_points(part, robot);
  const Interface B{spring_columns(part.responses, contacts, &Contact::part_point),
                    spring_columns(part.forces, contacts, &Contact::part_point),
                    spring_columns(robot.responses, contacts, &Contact::robot_point),
                    spring_columns(robot.forces, contacts, &Contact::robot_point)};
  CoupledResponse coupled;
  coupled.response = {part.axis, joined(part.responses, robot.responses), joined(part.forces, robot.forces),
                      std::vector<Eigen::MatrixXcd>(part.H.size())};
  coupled.kernel_condition.resize(part.axis.size());
  core::parallel_for(part.H.size(), [&](std::size_t i) {
    const auto line = static_cast<Eigen::Index>(i);
    const Eigen::VectorXcd compliance = spring_compliance(contacts, part.axis.omega_rad_s(line));
    const double condition = couple_line(part.H[i], robot.H[i], B, compliance, coupled.response.H[i]);
    if (!(condition <= singular_above)) refuse_kernel(part.axis.hz(line), condition);
    coupled.kernel_condition(line) = condition;
  });
  if (coupled.kernel_condition.maxCoeff() > ill_conditioned_above) coupled.status = KernelStatus::ill_conditioned;
  return coupled;
}

}  // namespace thinwall::coupling
