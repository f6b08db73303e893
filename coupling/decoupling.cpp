#include "coupling/decoupling.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

using dynamics::Dof;
using dynamics::DofTable;
using dynamics::ResponseModel;

/// A prefix for the names of the known component's points while it is coupled. Names read from a file cannot begin with
/// this character, so that no two points share a name.
const std::string taken_out = "\x1f";

bool has_point(const DofTable& dofs, const std::string& point) {
  return std::any_of(dofs.begin(), dofs.end(), [&](const Dof& dof) { return dof.point == point; });
}

DofTable renamed(DofTable dofs) {
  for (Dof& dof : dofs) dof.point = taken_out + dof.point;
  return dofs;
}

/// The known component with the opposite sign and prefixed names.
ResponseModel negative(const ResponseModel& known) {
  ResponseModel model{known.axis, renamed(known.responses), renamed(known.forces), {}};
  model.H.reserve(known.H.size());
  for (const Eigen::MatrixXcd& H : known.H) model.H.emplace_back(-H);
  return model;
}

/// Throws InputError unless the DOFs of the same kind at the point span the DOF's direction.
void require_motion(const DofTable& dofs, const Dof& dof, const std::string& whose) {
  Eigen::MatrixXd directions(3, 0);
  const Eigen::VectorXd wanted = dof.direction;
  for (const Dof& other : dofs) {
    if (other.point != dof.point || other.kind != dof.kind) continue;
    directions.conservativeResize(Eigen::NoChange, directions.cols() + 1);
    directions.rightCols(1) = other.direction;
  }
  if (directions.cols() > 0) {
    const Eigen::VectorXd amplitudes = directions.completeOrthogonalDecomposition().solve(wanted);
    if ((directions * amplitudes - wanted).norm() <= 1e-9) return;
  }
  throw core::InputError("the interface needs " + name(dof) + " among the " + whose +
                         ": measure it, or leave it out of the known component's table");
}

/// Contacts that join both sides rigidly along every DOF of the known component at the points.
std::vector<Contact> interface_contacts(const ResponseModel& assembly, const ResponseModel& known,
                                        const std::vector<std::string>& points) {
  std::vector<Contact> contacts;
  for (const std::string& point : points) {
    Contact contact{point, taken_out + point, {}};
    for (const int row : dynamics::rows_of_point(known.responses, point)) {
      const Dof& dof = known.responses[static_cast<std::size_t>(row)];
      require_motion(known.forces, dof, "known component's forces");
      require_motion(assembly.responses, dof, "assembly's responses");
      require_motion(assembly.forces, dof, "assembly's forces");
      ContactSpring spring;
      spring.direction = dof.direction;
      spring.kind = dof.kind;
      contact.springs.push_back(spring);
    }
    contacts.push_back(std::move(contact));
  }
  return contacts;
}

/// The points of the result: those of the assembly that were asked for, and those of the known component that the
/// assembly has not.
std::vector<std::string> result_points(const ResponseModel& assembly, const ResponseModel& known,
                                       const std::vector<std::string>& wanted) {
  std::vector<std::string> points;
  const auto add = [&](const DofTable& dofs, const std::string& prefix, bool known_only) {
    for (const Dof& dof : dofs) {
      const bool asked = wanted.empty() || std::find(wanted.begin(), wanted.end(), dof.point) != wanted.end();
      if (asked && !(known_only && has_point(assembly.responses, dof.point))) points.push_back(prefix + dof.point);
    }
  };
  add(assembly.responses, "", false);
  add(assembly.forces, "", false);
  add(known.responses, taken_out, true);
  for (const std::string& point : wanted) {
    (void)component_of({&assembly.responses, &assembly.forces, &known.responses}, point);
  }
  return points;
}

/// Removes the prefix from the names of the known component's points.
void give_names_back(DofTable& dofs) {
  for (Dof& dof : dofs) {
    if (dof.point.starts_with(taken_out)) dof.point.erase(0, taken_out.size());
  }
}

}  // namespace

CoupledResponse decouple(const ResponseModel& assembly, const ResponseModel& known,
                         const std::vector<std::string>& interface, const CouplingOptions& options) {
  if (interface.empty()) throw core::InputError("a decoupling without an interface: name the points to be parted");
  CouplingOptions own = options;
  own.points = result_points(assembly, known, options.points);
  // The negative of the known component is coupled at its interface, so that its forces there cancel (Eq. 13).
  CoupledResponse rest = couple(assembly, negative(known), interface_contacts(assembly, known, interface), own);
  give_names_back(rest.response.responses);
  give_names_back(rest.response.forces);
  return rest;
}

CoupledResponse remove_point_mass(const ResponseModel& assembly, const std::string& point, double mass_kg) {
  if (!(std::abs(mass_kg) > 0.0 && std::isfinite(mass_kg))) {
    std::ostringstream text;
    text << "the mass to be taken off point \"" << point << "\" is " << mass_kg << " kg, but it must not be zero";
    throw core::InputError(text.str());
  }
  ResponseModel mass{assembly.axis, {}, {}, {}};
  for (const int row : dynamics::rows_of_point(assembly.responses, point)) {
    const Dof& dof = assembly.responses[static_cast<std::size_t>(row)];
    if (dof.kind != dynamics::DofKind::translation) continue;
    for (const Dof& other : mass.responses) {
      if (std::abs(other.direction.dot(dof.direction)) <= 1e-9) continue;
      throw core::InputError("a point mass at \"" + point + "\" needs orthogonal directions there, but " + name(other) +
                             " and " + name(dof) + " are not");
    }
    mass.responses.push_back(dof);
  }
  if (mass.responses.empty()) throw core::InputError("point \"" + point + "\" has no translation in its table");
  mass.forces = mass.responses;
  const auto n = static_cast<Eigen::Index>(mass.responses.size());
  const Eigen::MatrixXcd unit = Eigen::MatrixXcd::Identity(n, n);
  for (Eigen::Index line = 0; line < assembly.axis.size(); ++line) {
    const double omega = assembly.axis.omega_rad_s(line);
    mass.H.emplace_back(unit * (-1.0 / (mass_kg * (omega > 0.0 ? omega * omega : 1.0))));
  }
  CoupledResponse rest = decouple(assembly, mass, {point}, {});
  // A free mass has no finite receptance at 0 Hz, but has no effect there either: the value inserted above is replaced.
  if (assembly.axis.hz(0) == 0.0) {
    rest.response.H.front() = assembly.H.front();
    rest.kernel_condition(0) = 1.0;
  }
  return rest;
}

}  // namespace thinwall::coupling
