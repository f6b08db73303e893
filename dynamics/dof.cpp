#include "dynamics/dof.hpp"

#include <algorithm>
#include <array>
#include <sstream>

#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::dynamics {

namespace {

std::string direction_name(const Eigen::Vector3d& d) {
  constexpr std::array letters{"x", "y", "z"};
  for (int axis_index = 0; axis_index < 3; ++axis_index) {
    if (d == Eigen::Vector3d::Unit(axis_index)) return letters[static_cast<std::size_t>(axis_index)];
  }
  std::ostringstream text;
  text << '(' << d.x() << ',' << d.y() << ',' << d.z() << ')';
  return text.str();
}

}  // namespace

std::string name(const Dof& dof) {
  switch (dof.kind) {
    case DofKind::modal:
      return dof.point;
    case DofKind::rotation:
      return dof.point + ".r" + direction_name(dof.direction);
    case DofKind::translation:
      break;
  }
  return dof.point + "." + direction_name(dof.direction);
}

std::string unit(const Dof& dof) {
  switch (dof.kind) {
    case DofKind::modal:
      return "1";
    case DofKind::rotation:
      return "rad";
    case DofKind::translation:
      break;
  }
  return "m";
}

DofTable translations(const std::string& point) {
  return {{point, Eigen::Vector3d::UnitX(), DofKind::translation},
          {point, Eigen::Vector3d::UnitY(), DofKind::translation},
          {point, Eigen::Vector3d::UnitZ(), DofKind::translation}};
}

DofTable six_dofs(const std::string& point) {
  DofTable table = translations(point);
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    table.push_back({point, Eigen::Vector3d::Unit(axis), DofKind::rotation});
  return table;
}

Eigen::Vector3d axis(const std::string& letter) {
  const bool negative = !letter.empty() && letter.front() == '-';
  const std::string bare = negative ? letter.substr(1) : letter;
  const double sign = negative ? -1.0 : 1.0;
  if (bare == "x") return sign * Eigen::Vector3d::UnitX();
  if (bare == "y") return sign * Eigen::Vector3d::UnitY();
  if (bare == "z") return sign * Eigen::Vector3d::UnitZ();
  throw core::InputError("direction \"" + letter + "\" is none of x, y, z, -x, -y, -z");
}

std::vector<int> rows_of_point(const DofTable& dofs, const std::string& point) {
  std::vector<int> rows;
  std::vector<std::string> points;
  for (int row = 0; row < static_cast<int>(dofs.size()); ++row) {
    const Dof& dof = dofs[static_cast<std::size_t>(row)];
    if (dof.kind == DofKind::modal) continue;
    points.push_back(dof.point);
    if (dof.point == point) rows.push_back(row);
  }
  if (rows.empty()) {
    throw core::InputError("no degree of freedom belongs to point \"" + point + "\"" +
                           core::did_you_mean(point, points));
  }
  return rows;
}

int row_of(const DofTable& dofs, const std::string& dof_name) {
  std::vector<std::string> names;
  names.reserve(dofs.size());
  for (const Dof& dof : dofs) names.push_back(name(dof));
  const auto found = std::find(names.begin(), names.end(), dof_name);
  if (found == names.end()) {
    throw core::InputError("no degree of freedom is called \"" + dof_name + "\"" + core::did_you_mean(dof_name, names));
  }
  return static_cast<int>(found - names.begin());
}

Eigen::VectorXd displacement_row(const DofTable& dofs, const std::string& point, const Eigen::Vector3d& n,
                                 DofKind kind) {
  Eigen::VectorXd row = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(dofs.size()));
  bool any = false;
  for (const int i : rows_of_point(dofs, point)) {
    const Dof& dof = dofs[static_cast<std::size_t>(i)];
    if (dof.kind != kind) continue;
    row(i) = n.dot(dof.direction);
    any = true;
  }
  if (!any) {
    throw core::InputError("point \"" + point + "\" has no " +
                           (kind == DofKind::rotation ? "rotation" : "translation") + " in its table");
  }
  return row;
}

Eigen::Matrix3Xd displacement_matrix(const DofTable& dofs, const std::string& point) {
  Eigen::Matrix3Xd D = Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(dofs.size()));
  for (const int i : rows_of_point(dofs, point)) {
    const Dof& dof = dofs[static_cast<std::size_t>(i)];
    if (dof.kind == DofKind::translation) D.col(i) = dof.direction;
  }
  return D;
}

}  // namespace thinwall::dynamics
