#include "robot/modal_table.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <set>
#include <sstream>

#include "core/error.hpp"
#include "core/faults.hpp"

namespace thinwall::robot {

namespace {

using dynamics::Dof;
using dynamics::ModalTable;
using dynamics::ModalTableRow;
using Eigen::Index;

void check(const ModalTableRow& row, Index dofs, core::Faults& faults) {
  const std::string where = "mode " + row.mode;
  faults.require_number(row.frequency_hz, row.frequency_hz > 0.0, where, "frequency (Hz)", "be positive");
  faults.require_number(row.damping_ratio, row.damping_ratio > 0.0 && row.damping_ratio < 1.0, where, "damping ratio",
                        "lie between 0 and 1 (1 % is 0.01)");
  faults.require(row.right.size() == dofs && row.left.size() == dofs && row.place_m.size() == dofs, where,
                 "has not as many entries as the table has DOFs (" + std::to_string(dofs) + ")");
  faults.require(row.right.allFinite() && row.left.allFinite(), where, "holds a number that is not finite");
}

void require_valid(const ModalTable& table) {
  core::Faults faults;
  faults.require(!table.dofs.empty() && !table.rows.empty(), "it", "has no DOF or no row");
  for (const ModalTableRow& row : table.rows) check(row, static_cast<Index>(table.dofs.size()), faults);
  faults.raise("table of modes");
}

/// The places of a DOF's point with the modes measured there: "33.4 mm in the modes 1, 2; 20 mm in the mode 6".
std::string places_of(const ModalTable& table, Index dof) {
  std::vector<double> seen;
  std::ostringstream text;
  for (const ModalTableRow& row : table.rows) {
    const double place = row.place_m(dof);
    if (std::find(seen.begin(), seen.end(), place) != seen.end()) continue;
    text << (seen.empty() ? "" : "; ") << 1e3 * place << " mm in the modes";
    seen.push_back(place);
    const char* separator = " ";
    for (const ModalTableRow& other : table.rows) {
      if (other.place_m(dof) != place) continue;
      text << separator << other.mode;
      separator = ", ";
    }
  }
  return text.str();
}

void require_one_place_each(const ModalTable& table) {
  core::Faults faults;
  std::set<std::string> told;
  for (std::size_t i = 0; i < table.dofs.size(); ++i) {
    const auto dof = static_cast<Index>(i);
    const bool known = std::all_of(table.rows.begin(), table.rows.end(),
                                   [&](const ModalTableRow& row) { return std::isfinite(row.place_m(dof)); });
    if (!known && told.insert(table.dofs[i].point).second) {
      faults.require(false, "point \"" + table.dofs[i].point + "\"",
                     "lay nobody tells how far up the tool from the tip; give its place (0 for the tip), one a mode if "
                     "the sensors moved, or take the tip alone");
    }
    const bool one = std::all_of(table.rows.begin(), table.rows.end(), [&](const ModalTableRow& row) {
      return std::abs(row.place_m(dof) - table.rows[0].place_m(dof)) <= 1e-9;
    });
    if (one || !told.insert(table.dofs[i].point).second) continue;
    faults.require(false, "point \"" + table.dofs[i].point + "\"",
                   "is two places up the tool under one name (" + places_of(table, dof) +
                       "), and the sum of those modes is no motion of either: take the tip alone, the modes of one "
                       "place, or the tip's rotations, which each mode gives by its own distance");
  }
  faults.raise("table of modes");
}

/// The row of `point` with the direction of `like`. Throws InputError if there is none.
int partner(const ModalTable& table, const std::string& point, const Dof& like) {
  for (const int row : dynamics::rows_of_point(table.dofs, point)) {
    const Dof& dof = table.dofs[static_cast<std::size_t>(row)];
    if (dof.kind == like.kind && (dof.direction - like.direction).norm() <= 1e-9) return row;
  }
  throw core::InputError("table of modes: point \"" + point + "\" has no DOF along that of " + dynamics::name(like) +
                         "; a rotation needs both points in each direction");
}

/// The rotation DOF about up × d, with its axis reversed if needed so that its largest component is positive, and the
/// sign of that reversal.
std::pair<double, Dof> rotation(const Dof& along, const Eigen::Vector3d& up) {
  if (along.kind != dynamics::DofKind::translation || std::abs(along.direction.dot(up)) > 1e-9) {
    throw core::InputError("table of modes: " + dynamics::name(along) +
                           " is no displacement across the tool, and tells no rotation; leave it out");
  }
  const Eigen::Vector3d about = up.cross(along.direction);
  Index largest = 0;
  about.cwiseAbs().maxCoeff(&largest);
  const double sign = about(largest) < 0.0 ? -1.0 : 1.0;
  // Adding zero turns −0 into 0: the DOF's name is written from these numbers.
  return {sign, {along.point, (sign * about).array() + 0.0, dynamics::DofKind::rotation}};
}

}  // namespace

dynamics::ModalModel without_cross_terms(const dynamics::ModalModel& model) {
  const Index poles = model.poles.size(), n = model.right.rows();
  dynamics::ModalModel direct;
  direct.dofs = model.dofs;
  direct.poles.resize(poles * n);
  direct.scaling.resize(poles * n);
  direct.right = direct.left = Eigen::MatrixXcd::Zero(n, poles * n);
  for (Index i = 0; i < n; ++i) {
    direct.poles.segment(i * poles, poles) = model.poles;
    direct.scaling.segment(i * poles, poles) = model.scaling;
    direct.right.block(i, i * poles, 1, poles) = model.right.row(i);
    direct.left.block(i, i * poles, 1, poles) = model.left.row(i);
  }
  if (model.residual.size() > 0) direct.residual = model.residual.diagonal().asDiagonal();
  return direct;
}

dynamics::ModalModel modal_model(const ModalTable& table, PointPlaces places) {
  require_valid(table);
  if (places == PointPlaces::one_each) require_one_place_each(table);
  const auto dofs = static_cast<Index>(table.dofs.size());
  const auto poles = static_cast<Index>(2 * table.rows.size());
  dynamics::ModalModel model{Eigen::VectorXcd(poles),
                             Eigen::MatrixXcd(dofs, poles),
                             Eigen::MatrixXcd(dofs, poles),
                             Eigen::VectorXcd::Ones(poles),
                             {},
                             table.dofs};
  Index k = 0;
  for (const ModalTableRow& row : table.rows) {
    const double zeta = row.damping_ratio;
    const double omega = 2.0 * std::numbers::pi * row.frequency_hz;
    model.poles(k) = omega * std::complex<double>(-zeta, std::sqrt(1.0 - zeta * zeta));
    model.right.col(k) = row.right;
    model.left.col(k) = row.left;
    model.poles(k + 1) = std::conj(model.poles(k));
    model.right.col(k + 1) = row.right.conjugate();
    model.left.col(k + 1) = row.left.conjugate();
    k += 2;
  }
  return model;
}

ModalTable at_dofs(const ModalTable& table, const std::vector<int>& dofs) {
  ModalTable part;
  for (const int row : dofs) part.dofs.push_back(table.dofs[static_cast<std::size_t>(row)]);
  for (const ModalTableRow& mode : table.rows) {
    part.rows.push_back(
        {mode.mode, mode.frequency_hz, mode.damping_ratio, mode.right(dofs), mode.left(dofs), mode.place_m(dofs)});
  }
  return part;
}

ModalTable at_point(const ModalTable& table, const std::string& point) {
  require_valid(table);
  return at_dofs(table, dynamics::rows_of_point(table.dofs, point));
}

ModalTable with_point_at(const ModalTable& table, const std::string& point, double place) {
  require_valid(table);
  const int dof = dynamics::rows_of_point(table.dofs, point)[0];
  ModalTable part{table.dofs, {}};
  std::copy_if(table.rows.begin(), table.rows.end(), std::back_inserter(part.rows),
               [&](const ModalTableRow& row) { return std::abs(row.place_m(dof) - place) <= 1e-9; });
  if (!part.rows.empty()) return part;
  std::ostringstream text;
  text << "table of modes: point \"" << point << "\" lies " << 1e3 * place << " mm up the tool in no mode, but "
       << places_of(table, dof);
  throw core::InputError(text.str());
}

ModalTable with_rotations(const ModalTable& table, const std::string& tip, const std::string& second,
                          const Eigen::Vector3d& up) {
  require_valid(table);
  if (!(std::abs(up.norm() - 1.0) <= 1e-9)) throw core::InputError("table of modes: up is not a unit vector");
  const std::vector<int> at_tip = dynamics::rows_of_point(table.dofs, tip);
  ModalTable both = at_dofs(table, at_tip);
  const auto n = static_cast<Index>(at_tip.size());
  for (ModalTableRow& row : both.rows) {
    row.right.conservativeResize(2 * n);
    row.left.conservativeResize(2 * n);
    row.place_m = Eigen::VectorXd::Constant(2 * n, row.place_m(0));
  }
  for (Index i = 0; i < n; ++i) {
    const int j = partner(table, second, both.dofs[static_cast<std::size_t>(i)]);
    const auto [sign, dof] = rotation(both.dofs[static_cast<std::size_t>(i)], up);
    both.dofs.push_back(dof);
    for (std::size_t mode = 0; mode < table.rows.size(); ++mode) {
      const ModalTableRow& row = table.rows[mode];
      const double S = row.place_m(j) - row.place_m(at_tip[static_cast<std::size_t>(i)]);
      if (!(S > 0.0)) {
        std::ostringstream text;
        text << "table of modes: in mode " << row.mode << " point \"" << second << "\" lies " << 1e3 * S
             << " mm up the tool from \"" << tip << "\", which must be positive; exchange them, or give its place";
        throw core::InputError(text.str());
      }
      both.rows[mode].right(n + i) = sign * (row.right(j) - both.rows[mode].right(i)) / S;
      both.rows[mode].left(n + i) = sign * (row.left(j) - both.rows[mode].left(i)) / S;
    }
  }
  return both;
}

}  // namespace thinwall::robot
