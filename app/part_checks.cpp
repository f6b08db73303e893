#include "app/part_checks.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "app/case_checks.hpp"
#include "core/units.hpp"

namespace thinwall::app {

namespace {

const std::vector<std::string> face_names{"x_min", "x_max", "y_min", "y_max", "z_min", "z_max"};

/// A regular tetrahedron of edge a has a³/(6√2); meshers fill space with tetrahedra of about that size.
constexpr double tets_per_cube = 8.485281374238570;
constexpr double most_tets = 2e7;

bool axes_differ(const Part& part) {
  const int sum = (1 << std::max(part.length_axis, 0)) + (1 << std::max(part.height_axis, 0)) +
                  (1 << std::max(part.thickness_axis, 0));
  return std::min({part.length_axis, part.height_axis, part.thickness_axis}) >= 0 && sum == 7 &&
         part.length_axis != part.height_axis;
}

bool geometry_known(const Part& part) {
  return axes_differ(part) && std::isfinite(part.length) && std::isfinite(part.height) && std::isfinite(part.thickness);
}

/// Coordinates equal to a face's up to this are on it.
double tolerance(const Part& part) {
  return 1e-9 * box_size(part).maxCoeff();
}

bool on_face(const Part& part, const std::string& face, const Eigen::Vector3d& p) {
  const int axis = face[0] - 'x';
  const double coordinate = face.ends_with("max") ? box_size(part)[axis] : 0.0;
  return std::abs(p[axis] - coordinate) <= tolerance(part);
}

void check_box(const Case& source, Findings& findings) {
  const Part& part = *source.part;
  if (!source.measured_part.empty()) {
    findings.report("part.measured", "a part is either modelled (part.length …) or measured; remove one of the two");
  }
  for (const auto* extent : {"part.length", "part.height", "part.thickness"}) {
    if (!findings.given(extent)) findings.report(extent, "missing; a box has a length, a height and a thickness");
  }
  if (findings.given("part.axes.length") && !axes_differ(part)) {
    findings.report("part.axes.length", "length, height and thickness must run along three different axes");
  }
}

void check_mesh_size(const Part& part, Findings& findings) {
  const SizeEstimate size = estimate_size(part);
  if (!(size.elements > most_tets)) return;
  const double volume = part.length * part.height * part.thickness;
  const double finest = std::cbrt(tets_per_cube * volume / most_tets);
  const bool near_points =
      part.mesh.point_element_size && *part.mesh.point_element_size < part.mesh.element_size && !part.mesh.grading;
  findings.report(near_points ? "part.mesh.point_element_size" : "part.mesh.element_size",
                  core::readable_text(part.mesh.element_size, core::kind::length) + " would make about " +
                      core::readable_text(size.elements, core::kind::number) +
                      " tetrahedra, at most 2e+07 are made; take " +
                      core::readable_text(finest * 1.05, core::kind::length) + " or more");
}

void check_supports(const Case& source, Findings& findings) {
  std::vector<std::string> known = face_names;
  for (const auto& selection : source.selections) known.push_back(selection.name);
  const auto& supports = source.part->supports;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const std::string key = "part.supports[" + std::to_string(i) + "]";
    findings.require_known(key + ".on", supports[i].on, known, "face or selection");
  }
}

void check_selection(const Selection& selection, Findings& findings) {
  const std::string key = "selections." + selection.name;
  const int predicates = (selection.plane ? 1 : 0) + (selection.box ? 1 : 0) + (selection.sphere ? 1 : 0);
  if (predicates != 1) findings.report(key, "give exactly one of plane, box, sphere");
  if (std::ranges::find(face_names, selection.name) != face_names.end()) {
    findings.report(key, "this is the name of a face of the box; choose another");
  }
  if (selection.box && (selection.box->min.array() > selection.box->max.array()).any()) {
    findings.report(key + ".box.min", "min lies beyond max; exchange them");
  }
}

std::string text(const Eigen::Vector3d& p) {
  std::string list;
  for (int i = 0; i < 3; ++i) {
    list += (i == 0 ? "" : ", ") + core::readable_text(std::abs(p[i]) < 1e-15 ? 0.0 : p[i], core::kind::length);
  }
  return "(" + list + ")";
}

void check_point(const Case& source, const Point& point, Findings& findings) {
  const std::string key = "points." + point.name;
  if (point.at.has_value() == point.position.has_value()) {
    findings.report(key, "give either at = [fractions of the box] or position = [lengths]");
    return;
  }
  if (source.part && geometry_known(*source.part)) {
    const Eigen::Vector3d p = position(*source.part, point), size = box_size(*source.part);
    const double slack = tolerance(*source.part);
    if ((p.array() < -slack).any() || ((p - size).array() > slack).any()) {
      findings.report(point.at ? key + ".at" : key + ".position",
                      text(p) + " lies outside the part, which reaches from the origin to " + text(size));
    }
  }
  if (!independent(point.directions)) {
    findings.report(key + ".directions", "the directions must be independent, three at most");
  }
}

bool holds(const Case& source, const Support& support, const Eigen::Vector3d& p) {
  const auto& part = *source.part;
  if (std::ranges::find(face_names, support.on) != face_names.end()) return on_face(part, support.on, p);
  const auto selection = std::ranges::find(source.selections, support.on, &Selection::name);
  return selection != source.selections.end() && contains(*selection, p, tolerance(part));
}

}  // namespace

SizeEstimate estimate_size(const Part& part) {
  const double thinnest = std::min({part.length, part.height, part.thickness});
  // The quality bound lets a tetrahedron be about twice as wide as the wall is thick, however large it may be.
  double edge = std::min(part.mesh.element_size, 2.0 * thinnest);
  if (part.mesh.point_element_size && !part.mesh.grading) edge = std::min(edge, *part.mesh.point_element_size);
  SizeEstimate size;
  size.elements = std::max(6.0, tets_per_cube * part.length * part.height * part.thickness / (edge * edge * edge));
  // A tetrahedral mesh of a thin wall has about 0.3 vertices, 1.6 edges and 2.3 faces an element.
  const double p = part.mesh.order;
  size.nodes = size.elements * (0.3 + 1.6 * (p - 1) + 2.3 * (p - 1) * (p - 2) / 2 + (p - 1) * (p - 2) * (p - 3) / 6);
  size.dofs = 3.0 * size.nodes;
  // 40 000 DOFs take some three seconds with factorisation, modes and reduction; the factor of a wall grows as n^1.3.
  size.seconds = 3.0 * std::pow(size.dofs / 4e4, 1.3);
  return size;
}

bool independent(const std::vector<Eigen::Vector3d>& directions) {
  if (directions.empty() || directions.size() > 3) return directions.empty();
  Eigen::MatrixXd columns(3, static_cast<Eigen::Index>(directions.size()));
  for (std::size_t i = 0; i < directions.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = directions[i];
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factor(columns);
  factor.setThreshold(1e-6);
  return factor.rank() == columns.cols();
}

void check_part(const Case& source, Findings& findings) {
  if (source.part) {
    check_box(source, findings);
    if (geometry_known(*source.part)) check_mesh_size(*source.part, findings);
    check_supports(source, findings);
  }
  for (const auto& selection : source.selections) check_selection(selection, findings);
  for (const auto& point : source.points) check_point(source, point, findings);
}

std::string point_of(const std::string& dof) {
  return dof.substr(0, dof.find('.'));
}

std::vector<std::string> part_points(const Case& source) {
  std::vector<std::string> names;
  for (const auto& point : source.points) names.push_back(point.name);
  for (const auto& frf : source.measured_part) {
    for (const auto& name : {point_of(frf.response), point_of(frf.force)}) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

std::string clamped_by(const Case& source, const std::string& name, const Eigen::Vector3d& direction) {
  const auto found = std::ranges::find(source.points, name, &Point::name);
  if (!source.part || !geometry_known(*source.part) || found == source.points.end()) return "";
  if (found->at.has_value() == found->position.has_value()) return "";
  for (const auto& support : source.part->supports) {
    if (!holds(source, support, position(*source.part, *found))) continue;
    double held = 0.0;
    for (const int axis : support.fixed) held += direction[axis] * direction[axis];
    if (held > 1e-12) return support.on;
  }
  return "";
}

}  // namespace thinwall::app
