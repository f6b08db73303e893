#include "coupling/receptance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::coupling {

namespace {

using Complex = std::complex<double>;
using dynamics::DofTable;
using dynamics::ResponseModel;
using Components = std::vector<const ResponseModel*>;

constexpr double ill_conditioned_above = 1e8;
constexpr double singular_above = 1e14;

/// Lines that one task works through with one workspace.
constexpr Eigen::Index block_lines = 64;

/// Row i of a table with its weight in a column of B.
struct Term {
  Eigen::Index row;
  double weight;
};
using Column = std::vector<Term>;

/// One component's part of B and of the result.
struct Interface {
  const ResponseModel* model;
  std::vector<Eigen::Index> directions;          ///< columns of B that are not zero here
  std::vector<Column> response, force;           ///< these columns, over the component's two tables
  std::vector<int> responses, forces;            ///< the rows and columns of H that are wanted
  Eigen::Index first_row = 0, first_column = 0;  ///< where they begin in the result
};

std::vector<const DofTable*> tables(const Components& components, DofTable ResponseModel::*table) {
  std::vector<const DofTable*> all;
  for (const ResponseModel* component : components) all.push_back(&(component->*table));
  return all;
}

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

void add_terms(const DofTable& dofs, const std::string& point, const JoinedDirection& joined, double sign,
               Column& column) {
  const Eigen::VectorXd row = dynamics::displacement_row(dofs, point, joined.direction, joined.kind);
  for (Eigen::Index i = 0; i < row.size(); ++i) {
    if (row(i) != 0.0) column.push_back({i, sign * joined.scale * row(i)});
  }
}

std::vector<int> wanted_rows(const DofTable& dofs, const std::vector<std::string>& points) {
  std::vector<int> rows;
  for (int i = 0; i < static_cast<int>(dofs.size()); ++i) {
    const std::string& point = dofs[static_cast<std::size_t>(i)].point;
    if (points.empty() || std::find(points.begin(), points.end(), point) != points.end()) rows.push_back(i);
  }
  return rows;
}

/// Both ends of every direction in the components' tables.
std::vector<Interface> interfaces(const Components& components, const Joints& joints,
                                  const std::vector<std::string>& points) {
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

DofTable selected(const std::vector<Interface>& components, DofTable ResponseModel::*table,
                  std::vector<int> Interface::*wanted) {
  DofTable all;
  for (const Interface& component : components) {
    for (const int i : component.*wanted) all.push_back((component.model->*table)[static_cast<std::size_t>(i)]);
  }
  return all;
}

/// One line after another: B's products with Y, the kernel, G.
class Lines {
 public:
  Lines(const std::vector<Interface>& components, const Joints& joints, const CouplingOptions& options)
      : components_(components), joints_(joints), kernel_(options.regularisation, options.threshold) {
    const Interface& last = components.back();
    rows_ = last.first_row + static_cast<Eigen::Index>(last.responses.size());
    columns_ = last.first_column + static_cast<Eigen::Index>(last.forces.size());
  }

  /// G of one line into `coupled`.
  KernelLine couple(std::size_t line, double omega, Eigen::MatrixXcd& coupled) {
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

  /// ε |I − Y B S⁻¹ Bᵀ| |Y| |I − B S⁻¹ Bᵀ Y| of the line that was coupled last.
  [[nodiscard]] Eigen::MatrixXd error(std::size_t line, double epsilon) const;

 private:
  void add(const Interface& component, const Eigen::MatrixXcd& H, Eigen::MatrixXcd& coupled);

  const std::vector<Interface>& components_;
  const Joints& joints_;
  Kernel kernel_;
  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::MatrixXcd S_, to_joints_, from_joints_;
  Eigen::MatrixXd magnitude_;
};

void Lines::add(const Interface& component, const Eigen::MatrixXcd& H, Eigen::MatrixXcd& coupled) {
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

Eigen::MatrixXd Lines::error(std::size_t line, double epsilon) const {
  const Eigen::MatrixXcd per_response = from_joints_ * kernel_.inverse();  // Y B S⁻¹
  const Eigen::MatrixXcd& per_force = kernel_.solution();                  // S⁻¹ Bᵀ Y
  Eigen::MatrixXd bound = Eigen::MatrixXd::Zero(rows_, columns_);
  for (const Interface& component : components_) {
    const Eigen::MatrixXcd& H = component.model->H[line];
    Eigen::MatrixXcd left = Eigen::MatrixXcd::Zero(rows_, H.rows()), right = Eigen::MatrixXcd::Zero(H.cols(), columns_);
    for (std::size_t p = 0; p < component.responses.size(); ++p) {
      left(component.first_row + static_cast<Eigen::Index>(p), component.responses[p]) = 1.0;
    }
    for (std::size_t q = 0; q < component.forces.size(); ++q) {
      right(component.forces[q], component.first_column + static_cast<Eigen::Index>(q)) = 1.0;
    }
    for (std::size_t a = 0; a < component.directions.size(); ++a) {
      const Eigen::Index j = component.directions[a];
      for (const auto& [i, weight] : component.response[a]) left.col(i) -= weight * per_response.col(j);
      for (const auto& [i, weight] : component.force[a]) right.row(i) -= weight * per_force.row(j);
    }
    bound += epsilon * (left.cwiseAbs() * H.cwiseAbs() * right.cwiseAbs());
  }
  return bound;
}

[[noreturn]] void refuse_kernel(double hz, double condition) {
  std::ostringstream text;
  text.precision(10);
  text << "the kernel of the receptance coupling is singular at " << hz << " Hz (condition " << condition << ", bound "
       << singular_above << "): two contact directions say the same, or an undamped coupled mode lies there";
  throw core::NumericalError(text.str());
}

KernelStatus status_of(const CoupledResponse& coupled) {
  if (coupled.dropped.any()) return KernelStatus::regularised;
  if (coupled.kernel_condition.maxCoeff() > ill_conditioned_above) return KernelStatus::ill_conditioned;
  return KernelStatus::well_conditioned;
}

CoupledResponse couple(const Components& components, const std::vector<Contact>& contacts,
                       const CouplingOptions& options) {
  require_valid(options);
  const Joints joints = coupling::joints(contacts, options.length);
  require_joinable(components);
  const std::vector<Interface> parts = interfaces(components, joints, options.points);
  const dynamics::FrequencyAxis& axis = components.front()->axis;
  const auto lines = static_cast<std::size_t>(axis.size());
  CoupledResponse coupled;
  coupled.response = {axis, selected(parts, &ResponseModel::responses, &Interface::responses),
                      selected(parts, &ResponseModel::forces, &Interface::forces),
                      std::vector<Eigen::MatrixXcd>(lines)};
  coupled.kernel_condition.setZero(axis.size());
  coupled.dropped.setZero(axis.size());
  coupled.compatibility_residual.setZero(axis.size());
  if (options.component_error > 0.0) coupled.error.resize(lines);
  core::parallel_for((lines + block_lines - 1) / block_lines, [&](std::size_t block) {
    Lines work(parts, joints, options);
    const Eigen::Index first = static_cast<Eigen::Index>(block) * block_lines;
    for (Eigen::Index line = first; line < std::min(first + block_lines, axis.size()); ++line) {
      const auto i = static_cast<std::size_t>(line);
      const KernelLine kernel = work.couple(i, axis.omega_rad_s(line), coupled.response.H[i]);
      if (!(kernel.condition <= singular_above)) refuse_kernel(axis.hz(line), kernel.condition);
      coupled.kernel_condition(line) = kernel.condition;
      coupled.dropped(line) = kernel.dropped;
      coupled.compatibility_residual(line) = kernel.compatibility_residual;
      if (options.component_error > 0.0) coupled.error[i] = work.error(i, options.component_error);
    }
  });
  coupled.status = status_of(coupled);
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
