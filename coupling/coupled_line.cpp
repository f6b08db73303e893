#include "coupling/coupled_line.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "coupling/kernel.hpp"

namespace thinwall::coupling {

namespace {

using Complex = std::complex<double>;
using dynamics::DofTable;
using dynamics::ResponseModel;
using Column = std::vector<Term>;

/// The response or force tables of all components.
std::vector<const DofTable*> tables(const Components& components, DofTable ResponseModel::*table) {
  std::vector<const DofTable*> all;
  for (const ResponseModel* component : components) all.push_back(&(component->*table));
  return all;
}

/// Throws InputError unless there are components, on one axis, complete, and with different points.
void require_joinable(const Components& components) {
  if (components.empty()) throw core::InputError("a coupling without a component");
  if (components.front()->axis.size() == 0) throw core::InputError("a coupling without a frequency line");
  for (const ResponseModel* component : components) {
    dynamics::require_equal(components.front()->axis, component->axis);
    dynamics::require_complete(*component);
  }
  require_different_points(tables(components, &ResponseModel::responses));
  require_different_points(tables(components, &ResponseModel::forces));
}

/// Appends the entries of a column of B at one of its two ends; sign: 1 at point a, −1 at point b.
void add_terms(const DofTable& dofs, const std::string& point, const JoinedDirection& joined, double sign,
               Column& column) {
  const Eigen::VectorXd row = dynamics::displacement_row(dofs, point, joined.direction, joined.kind);
  for (Eigen::Index i = 0; i < row.size(); ++i) {
    if (row(i) != 0.0) column.push_back({i, sign * joined.scale * row(i)});
  }
}

/// The rows of the DOFs of the points; all rows if no point is named.
std::vector<int> wanted_rows(const DofTable& dofs, const std::vector<std::string>& points) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(dofs.size()); ++i) {
    const std::string& point = dofs[static_cast<std::size_t>(i)].point;
    if (points.empty() || std::find(points.begin(), points.end(), point) != points.end()) rows.push_back(i);
  }
  return rows;
}

/// One table with the wanted DOFs of all components.
DofTable selected(const std::vector<Interface>& components, DofTable ResponseModel::*table,
                  std::vector<int> Interface::*wanted) {
  DofTable all;
  for (const Interface& component : components) {
    for (const int i : component.*wanted) all.push_back((component.model->*table)[static_cast<std::size_t>(i)]);
  }
  return all;
}

}  // namespace

std::vector<Interface> interfaces(const Components& components, const Joints& joints,
                                  const std::vector<std::string>& points) {
  require_joinable(components);
  const auto responses = tables(components, &ResponseModel::responses);
  auto both = responses;
  for (const DofTable* forces : tables(components, &ResponseModel::forces)) both.push_back(forces);
  for (const std::string& point : points) (void)component_of(both, point);
  std::vector<Interface> all;
  for (const ResponseModel* component : components) {
    Interface& own = all.emplace_back();
    own.model = component;
    own.responses = wanted_rows(component->responses, points);
    own.forces = wanted_rows(component->forces, points);
    if (all.size() == 1) continue;
    const Interface& before = *(all.end() - 2);
    own.first_row = before.first_row + static_cast<Eigen::Index>(before.responses.size());
    own.first_column = before.first_column + static_cast<Eigen::Index>(before.forces.size());
  }
  for (Eigen::Index j = 0; j < joints.size(); ++j) {
    const JoinedDirection& joined = joints.directions[static_cast<std::size_t>(j)];
    for (const auto& [point, sign] : {std::pair{&joined.point_a, 1.0}, std::pair{&joined.point_b, -1.0}}) {
      Interface& own = all[component_of(responses, *point)];
      if (own.directions.empty() || own.directions.back() != j) {
        own.directions.push_back(j);
        own.response.emplace_back();
        own.force.emplace_back();
      }
      add_terms(own.model->responses, *point, joined, sign, own.response.back());
      add_terms(own.model->forces, *point, joined, sign, own.force.back());
    }
  }
  return all;
}

DofTable wanted_responses(const std::vector<Interface>& components) {
  return selected(components, &ResponseModel::responses, &Interface::responses);
}

DofTable wanted_forces(const std::vector<Interface>& components) {
  return selected(components, &ResponseModel::forces, &Interface::forces);
}

void require_solvable(const KernelLine& kernel, double hz) {
  if (kernel.condition <= singular_above) return;
  std::ostringstream text;
  text.precision(10);
  text << "the kernel of the receptance coupling is singular at " << hz << " Hz (condition " << kernel.condition
       << ", bound " << singular_above
       << "): two contact directions say the same, or an undamped coupled mode lies there";
  throw core::NumericalError(text.str());
}

CoupledLine::CoupledLine(const std::vector<Interface>& components, const Joints& joints, Regularisation regularisation,
                         double threshold)
    : components_(components), joints_(joints), kernel_(regularisation, threshold) {
  const Interface& last = components.back();
  rows_ = last.first_row + static_cast<Eigen::Index>(last.responses.size());
  columns_ = last.first_column + static_cast<Eigen::Index>(last.forces.size());
}

KernelLine CoupledLine::couple(std::size_t line, double omega, Eigen::MatrixXcd& coupled) {
  const Eigen::Index m = joints_.size();
  S_.setZero(m, m);
  magnitude_.setZero(m, m);
  to_joints_.setZero(m, columns_);
  from_joints_.setZero(rows_, m);
  coupled.setZero(rows_, columns_);
  for (const Interface& component : components_) add(component, component.model->H[line], coupled);
  add_compliance(joints_, omega, S_, magnitude_);
  const KernelLine result = kernel_.solve(S_, magnitude_, to_joints_);
  coupled.noalias() -= from_joints_ * kernel_.solution();
  return result;
}

/// Adds one component to S, to Bᵀ Y and Y B over the wanted columns and rows, and its wanted entries to G. The modulus
/// of its term of S goes into `magnitude`, from which the condition is computed.
void CoupledLine::add(const Interface& component, const Eigen::MatrixXcd& H, Eigen::MatrixXcd& coupled) {
  const auto rows = static_cast<Eigen::Index>(component.responses.size());
  const auto columns = static_cast<Eigen::Index>(component.forces.size());
  const int* const row = component.responses.data();
  const int* const column = component.forces.data();
  for (Eigen::Index q = 0; q < columns; ++q) {
    for (Eigen::Index p = 0; p < rows; ++p) {
      coupled(component.first_row + p, component.first_column + q) = H(row[p], column[q]);
    }
  }
  for (std::size_t a = 0; a < component.directions.size(); ++a) {
    const Eigen::Index j = component.directions[a];
    for (const auto& [i, weight] : component.response[a]) {
      for (Eigen::Index q = 0; q < columns; ++q) to_joints_(j, component.first_column + q) += weight * H(i, column[q]);
    }
    for (const auto& [i, weight] : component.force[a]) {
      for (Eigen::Index p = 0; p < rows; ++p) from_joints_(component.first_row + p, j) += weight * H(row[p], i);
    }
    for (std::size_t b = 0; b < component.directions.size(); ++b) {
      Complex opening = 0.0;
      for (const auto& [i, weight] : component.response[a]) {
        for (const auto& [k, force] : component.force[b]) opening += weight * force * H(i, k);
      }
      S_(j, component.directions[b]) += opening;
      magnitude_(j, component.directions[b]) += std::abs(opening);
    }
  }
}

Eigen::MatrixXcd CoupledLine::P(const Interface& component) const {
  const Eigen::MatrixXcd per_response = from_joints_ * kernel_.inverse();  // Y B S⁻¹
  Eigen::MatrixXcd left = Eigen::MatrixXcd::Zero(rows_, static_cast<Eigen::Index>(component.model->responses.size()));
  for (std::size_t p = 0; p < component.responses.size(); ++p)
    left(component.first_row + static_cast<Eigen::Index>(p), component.responses[p]) = 1.0;
  for (std::size_t a = 0; a < component.directions.size(); ++a) {
    for (const auto& [i, weight] : component.response[a])
      left.col(i) -= weight * per_response.col(component.directions[a]);
  }
  return left;
}

Eigen::MatrixXcd CoupledLine::Q(const Interface& component) const {
  const Eigen::MatrixXcd& per_force = kernel_.solution();  // S⁻¹ Bᵀ Y
  Eigen::MatrixXcd right = Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(component.model->forces.size()), columns_);
  for (std::size_t q = 0; q < component.forces.size(); ++q)
    right(component.forces[q], component.first_column + static_cast<Eigen::Index>(q)) = 1.0;
  for (std::size_t a = 0; a < component.directions.size(); ++a) {
    for (const auto& [i, weight] : component.force[a]) right.row(i) -= weight * per_force.row(component.directions[a]);
  }
  return right;
}

}  // namespace thinwall::coupling
