#include "case/checks/part_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "case/checks/mesh_size.hpp"
#include "case/checks/part_description_checks.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "core/units.hpp"
#include "dynamics/dof.hpp"
#include "dynamics/unit_system.hpp"
#include "fem/closed_part.hpp"
#include "io/surface_unit.hpp"
#include "mesh/box.hpp"
#include "mesh/nearest_point.hpp"
#include "mesh/planar/bend.hpp"
#include "setup/graded_mesh.hpp"
#include "setup/imported_part.hpp"
#include "setup/measured_layout.hpp"
#include "setup/part_geometry.hpp"

namespace thinwall::cases {

namespace {

bool axes_differ(const setup::BoxShape& part) {
  const int sum = (1 << std::max(part.length_axis, 0)) + (1 << std::max(part.height_axis, 0)) +
                  (1 << std::max(part.thickness_axis, 0));
  return std::min({part.length_axis, part.height_axis, part.thickness_axis}) >= 0 && sum == 7 &&
         part.length_axis != part.height_axis;
}

bool sizes_known(const setup::BoxShape& box) {
  return axes_differ(box) && std::isfinite(box.length) && std::isfinite(box.height) && std::isfinite(box.thickness);
}

bool geometry_known(const setup::Part& part) {
  const auto known = [&](const setup::BoxShape& box) {
    return sizes_known(box) && mesh::violations(setup::planar(part).prism).empty();
  };
  return std::visit(
      core::overloaded{known, [](const setup::PrismShape& shape) { return mesh::violations(shape.prism).empty(); },
                       [&](const auto& /*from a file*/) { return part.imported != nullptr; }},
      part.shape);
}

/// Coordinates equal to a face's up to this are on it.
double tolerance(const setup::Part& part) {
  return 1e-9 * bounds(part).sizes().maxCoeff();
}

/// The distance within which a point must be given of a file's surface: the nearest place of the surface is meant.
double given_to(const setup::Part& part) {
  return 1e-4 * bounds(part).diagonal().norm();
}

bool on_face(const setup::Part& part, const std::string& face, const Eigen::Vector3d& p) {
  const int axis = face[0] - 'x';
  const double coordinate = face.ends_with("max") ? setup::bounds(part).max()[axis] : setup::bounds(part).min()[axis];
  return std::abs(p[axis] - coordinate) <= tolerance(part);
}

void check_matrices(const io::MatrixFiles& files, Findings& findings) {
  if (files.stiffness.empty()) return;  // which was reported
  try {
    (void)dynamics::unit_system(files.length_unit, files.mass_unit);
  } catch (const core::InputError& error) {
    findings.report("part.matrices", std::string(error.what()) + "; set part.unit and part.mass_unit");
  }
}

void check_part_file(const setup::PartFile& file, Findings& findings) {
  if (file.path.empty()) return;  // which was reported
  if (!findings.written("part.shape") && !setup::shape_of_file(file.path)) {
    findings.report(
        "part.file",
        "\"" + file.path.filename().string() +
            "\" has an ending that is not read; take a .stl, .off, .obj, .ply, .3mf, .glb, .gltf or .step, or a "
            "mesh as .msh, .inp or .vtu");
    return;
  }
  if (setup::tells_its_unit(file.path) && !findings.given("part.unit")) return;
  if (!findings.given("part.unit")) {
    findings.report("part.unit", "missing; the file does not tell its unit of length: \"mm\", \"m\", \"inch\"");
  } else {
    try {
      (void)io::metres_per_unit(file.unit, file.path.filename().string());
    } catch (const core::InputError& error) {
      findings.report("part.unit", error.what());
    }
  }
}

void check_prism(const mesh::Prism& prism, Findings& findings) {
  if (!findings.given("part.outline") || !std::isfinite(prism.top)) return;
  bool unread = prism.outline.empty();  // and reported as such
  for (const auto& hole : prism.holes) unread = unread || hole.empty();
  for (const auto& zone : prism.zones) unread = unread || zone.outline.empty() || !std::isfinite(zone.top);
  if (unread) return;
  for (const std::string& violation : mesh::violations(prism)) findings.report("part.outline", violation);
}

void check_bend(const setup::Part& part, Findings& findings) {
  const setup::Bend* bend = setup::bend(part);
  if (bend == nullptr || !geometry_known(part) || !std::isfinite(bend->radius)) return;
  const int through = setup::planar(part).axes[2];
  const Eigen::AlignedBox3d box = setup::bounds(part);
  if (bend->along && *bend->along == through) {
    findings.report("part.bend.along", "the part is bent along its wall, not through its thickness; name another axis");
    return;
  }
  mesh::Positions corners(2, 3);
  corners << box.min().transpose(), box.max().transpose();
  for (const std::string& violation : mesh::violations(setup::bend_of(part), corners))
    findings.report("part.bend.radius", violation);
}

void check_shape(const Case& source, Findings& findings) {
  const setup::Part& part = *source.part;
  if (!source.measured_part.empty()) {
    findings.report("part.measured", "a part is either modelled (part.length …) or measured; remove one of the two");
  }
  if (findings.unreadable("part.shape")) return;
  const auto check_box = [&](const setup::BoxShape& box) {
    if (findings.given("part.axes.length") && !axes_differ(box))
      findings.report("part.axes.length", "length, height and thickness must run along three different axes");
    if (!sizes_known(box)) return;
    for (const std::string& violation : mesh::violations(setup::planar(part).prism))
      findings.report("part.thickness", violation);
  };
  std::visit(core::overloaded{check_box, [&](const setup::PrismShape& shape) { check_prism(shape.prism, findings); },
                              [&](const setup::MatrixShape& shape) { check_matrices(shape.files, findings); },
                              [&](const auto& shape) { check_part_file(shape.file, findings); }},
             part.shape);
}

void check_selection(const setup::Selection& selection, Findings& findings) {
  const std::string key = "selections." + selection.name;
  const int predicates = (selection.plane ? 1 : 0) + (selection.box ? 1 : 0) + (selection.sphere ? 1 : 0);
  if (predicates != 1) findings.report(key, "give exactly one of plane, box, sphere");
  if (std::ranges::find(mesh::face_names(), selection.name) != mesh::face_names().end()) {
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

void check_node(const Case& source, const setup::Point& point, Findings& findings) {
  const std::string key = "points." + point.name;
  if (!source.part ||
      (setup::kind(*source.part) != setup::ShapeKind::matrices && setup::kind(*source.part) != setup::ShapeKind::mesh))
    return findings.report(key + ".node", "this part has no numbered nodes; give at or position");
  if (point.at || point.position)
    return findings.report(key, "give the node = its number, and neither at nor position (matrices know no places)");
  if (!independent(point.directions))
    findings.report(key + ".directions", "the directions must be independent, three at most");
  if (!source.part->imported) return;
  const std::vector<int> known = setup::node_numbers(*source.part->imported);
  const std::optional<int> node = setup::node_of(*source.part->imported, point);
  if (node && std::ranges::binary_search(known, *node)) return;
  const std::string which = node ? "node " + std::to_string(*node) : "point of this name; give its node";
  const std::string range =
      known.empty() ? "none" : std::to_string(known.front()) + " to " + std::to_string(known.back());
  findings.report(node ? key + ".node" : key,
                  "the part's file has no " + which + " (nodes are numbered " + range + ")");
}

/// Checks the face on which a point's patch is to lie.
void check_face(const Case& source, const setup::Point& point, Findings& findings) {
  if (point.face.empty()) return;
  const std::string key = "points." + point.name + ".face";
  std::vector<std::string> known(mesh::face_names().begin(), mesh::face_names().end());
  for (const auto& selection : source.selections)
    if (selection.plane) known.push_back(selection.name);
  if (std::ranges::find(known, point.face) == known.end())
    return findings.require_known(key, point.face, known, "face or selection of a plane");
  if (point.patch_radius <= 0.0)
    return findings.report(key, "a face is chosen for a patch; give points." + point.name + ".patch_radius");
  if (!source.part || !geometry_known(*source.part)) return;
  const auto plane = std::get<mesh::PlaneRegion>(setup::region_of(source, point.face));
  const double off =
      std::abs((setup::position(*source.part, point) - plane.point).dot(plane.normal)) / plane.normal.norm();
  if (off > 1e-6 * setup::bounds(*source.part).diagonal().norm())
    findings.report(key, "the point lies " + core::readable_text(off, core::kind::length) + " off the plane of \"" +
                             point.face + "\"; move it there, or name a face that it lies on");
}

void check_point(const Case& source, const setup::Point& point, Findings& findings) {
  const std::string key = "points." + point.name;
  const bool matrices = source.part && setup::kind(*source.part) == setup::ShapeKind::matrices;
  if (matrices || point.node) return check_node(source, point, findings);
  if (point.at.has_value() == point.position.has_value()) {
    findings.report(key, "give either at = [fractions of the box] or position = [lengths]");
    return;
  }
  if (source.part && geometry_known(*source.part)) {
    const std::string outside = outside_part(*source.part, setup::position(*source.part, point), point.patch_radius);
    if (!outside.empty()) findings.report(point.at ? key + ".at" : key + ".position", outside);
    const double least = 1e-6 * setup::bounds(*source.part).diagonal().norm();
    if (point.patch_radius > 0.0 && point.patch_radius < least)
      findings.report(key + ".patch_radius", core::readable_text(point.patch_radius, core::kind::length) +
                                                 " is less than a millionth of the part, " +
                                                 core::readable_text(least, core::kind::length) +
                                                 "; give the radius of the contact, or 0 for a single node");
  }
  check_face(source, point, findings);
  if (!independent(point.directions)) {
    findings.report(key + ".directions", "the directions must be independent, three at most");
  }
}

/// True if a box or sphere shares no volume with the block around the part.
bool misses_part(const setup::Part& part, const setup::Selection& selection) {
  const Eigen::AlignedBox3d block = setup::bounds(part);
  if (selection.sphere) return block.exteriorDistance(selection.sphere->centre) >= selection.sphere->radius;
  return selection.box && !(block.intersection({selection.box->min, selection.box->max}).sizes().minCoeff() > 0.0);
}

/// True if a selection lies off the block around the part, so that it holds no face.
bool lies_off_part(const setup::Part& part, const setup::Selection& selection) {
  const Eigen::AlignedBox3d block = setup::bounds(part);
  const double slack = setup::from_file(part) ? setup::off_surface(part) : tolerance(part);
  if (selection.sphere) return block.exteriorDistance(selection.sphere->centre) > selection.sphere->radius + slack;
  if (selection.box) {
    const Eigen::AlignedBox3d other(selection.box->min, selection.box->max);
    return !other.isEmpty() && block.exteriorDistance(other) > slack;
  }
  if (!selection.plane) return false;
  const Eigen::Vector3d n = selection.plane->normal.normalized();
  const double middle = n.dot(block.center() - selection.plane->point), reach = n.cwiseAbs().dot(block.sizes()) / 2.0;
  return std::abs(middle) > reach + slack;
}

/// Checks that selections which hold the part meet it.
void check_held_places(const Case& source, Findings& findings) {
  if (setup::kind(*source.part) == setup::ShapeKind::matrices) return;
  const auto check = [&](const std::string& key, const std::string& on) {
    const auto selection = std::ranges::find(source.selections, on, &setup::Selection::name);
    if (selection == source.selections.end() || !lies_off_part(*source.part, *selection)) return;
    findings.report(key, "the selection \"" + on + "\" holds no face of the part, which reaches from " +
                             text(setup::bounds(*source.part).min()) + " to " +
                             text(setup::bounds(*source.part).max()) + "; move it");
  };
  for (std::size_t i = 0; i < source.part->supports.size(); ++i)
    check(indexed("part.supports", i) + ".on", source.part->supports[i].on);
  for (std::size_t i = 0; i < source.part->clamps.size(); ++i)
    check(indexed("part.clamps", i) + ".on", source.part->clamps[i].on);
}

void check_material_places(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.part->materials.size(); ++i) {
    const std::string& on = source.part->materials[i].on;
    const auto selection = std::ranges::find(source.selections, on, &setup::Selection::name);
    if (selection != source.selections.end() && misses_part(*source.part, *selection))
      findings.report("part.materials[" + std::to_string(i) + "].on",
                      "the selection \"" + on + "\" does not meet the part, which reaches from " +
                          text(setup::bounds(*source.part).min()) + " to " + text(setup::bounds(*source.part).max()) +
                          "; move it");
  }
}

/// The number of degrees of freedom, where a file tells it.
std::optional<Eigen::Index> dofs_of_file(const setup::Part& part) {
  if (part.imported && part.imported->matrices) return part.imported->matrices->size();
  const mesh::SolidMesh* solid = setup::solid_of(part);
  if (solid == nullptr || part.mesh.order.value_or(std::max(2, solid->nodes.order)) != solid->nodes.order) return {};
  return 3 * solid->nodes.positions.rows();
}

void check_substructures(const Case& source, Findings& findings) {
  const int domains = source.modes.substructures;
  if (domains < 2) return;  // a number out of bounds is reported where it is read
  if (!std::has_single_bit(static_cast<unsigned>(domains)))
    findings.report("modes.substructures", std::to_string(domains) + " is no power of two; take " +
                                               std::to_string(std::bit_floor(static_cast<unsigned>(domains))) + " or " +
                                               std::to_string(std::bit_ceil(static_cast<unsigned>(domains))));
  if (source.modes.verify)
    findings.report("modes.verify",
                    "compares frequencies to 1e-8, and modes.substructures finds them to 1e-5; remove one of them");
  if (const setup::MeshOptions& mesh = source.part->mesh; !mesh.element_size && mesh.tolerance < 1e-4)
    findings.report(
        "part.mesh.tolerance",
        "is below 1e-4, to which shapes from modes.substructures are not right; take 1e-4 or more, or remove "
        "modes.substructures");
}

void check_mode_counts(const Case& source, Findings& findings) {
  const auto dofs = dofs_of_file(*source.part);
  if (!dofs) return;
  for (const auto& [key, range] :
       {std::pair{"modes.count", source.modes.range}, std::pair{"reduction.modes", source.reduction.fixed_interface}}) {
    if (findings.written(key) && range.count.value_or(0) >= *dofs)
      findings.report(key, std::to_string(*range.count) + " modes of a part that has " + std::to_string(*dofs) +
                               " degrees of freedom by its file; ask for fewer");
  }
}

bool holds(const setup::PartSetup& source, const setup::Support& support, const Eigen::Vector3d& p) {
  const auto& part = *source.part;
  if (std::ranges::find(mesh::face_names(), support.on) != mesh::face_names().end())
    return on_face(part, support.on, p);
  const auto selection = std::ranges::find(source.selections, support.on, &setup::Selection::name);
  return selection != source.selections.end() && contains(*selection, p, tolerance(part));
}

}  // namespace

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
    check_shape(source, findings);
    check_description(source, findings);
    check_mode_counts(source, findings);
    check_substructures(source, findings);
    check_bend(*source.part, findings);
    if (geometry_known(*source.part)) {
      check_material_places(source, findings);
      check_held_places(source, findings);
    }
    if (geometry_known(*source.part) && setup::kind(*source.part) != setup::ShapeKind::matrices &&
        setup::kind(*source.part) != setup::ShapeKind::mesh)
      check_mesh_size(source, findings);
  }
  for (const auto& selection : source.selections) check_selection(selection, findings);
  for (const auto& point : source.points) check_point(source, point, findings);
}

std::string outside_part(const setup::Part& part, const Eigen::Vector3d& p, double patch_radius) {
  if (!geometry_known(part)) return "";
  const Eigen::AlignedBox3d box = setup::bounds(part);
  const double slack = setup::from_file(part) ? setup::off_surface(part) : tolerance(part);
  if (((box.min() - p).array() > slack).any() || ((p - box.max()).array() > slack).any()) {
    return text(p) + " lies outside the part, which reaches from " +
           (box.min().isZero() ? "the origin" : text(box.min())) + " to " + text(box.max());
  }
  if (setup::kind(part) != setup::ShapeKind::surface) return "";
  const mesh::PointToSurface place = mesh::point_to_surface(part.imported->surface->surface, p);
  const bool inside_is_well = patch_radius <= 0.0;
  if (place.distance_m <= given_to(part) || (place.inside && inside_is_well)) return "";
  return text(p) + " lies " + core::readable_text(place.distance_m, core::kind::length) +
         (place.inside ? " inside the part, where no patch can lie" : " off the part's surface") +
         "; move it there (within " + core::readable_text(given_to(part), core::kind::length) + ")";
}

std::vector<std::string> part_points(const Case& source) {
  std::vector<std::string> names;
  for (const auto& point : source.points) names.push_back(point.name);
  for (const auto& frf : source.measured_part) {
    for (const auto& name : {setup::point_of(frf.response), setup::point_of(frf.force)}) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

std::optional<Eigen::Vector3d> direction_of(const std::string& dof) {
  const auto dot = dof.rfind('.');
  if (dot == std::string::npos || dot == 0) return std::nullopt;
  try {
    return dynamics::axis(dof.substr(dot + 1));
  } catch (const core::InputError&) {
    return std::nullopt;
  }
}

std::vector<Eigen::Vector3d> directions_at(const Case& source, const std::string& name) {
  const auto found = std::ranges::find(source.points, name, &setup::Point::name);
  if (source.part && found != source.points.end()) return found->directions;
  std::vector<Eigen::Vector3d> directions;
  for (const auto& frf : source.measured_part) {
    for (const auto& dof : {frf.response, frf.force}) {
      const auto direction = direction_of(dof);
      if (direction && setup::point_of(dof) == name) directions.push_back(*direction);
    }
  }
  return directions;
}

bool spanned(const std::vector<Eigen::Vector3d>& directions, const Eigen::Vector3d& direction) {
  std::vector<Eigen::Vector3d> basis;  // orthonormal, by Gram and Schmidt
  const auto beyond_basis = [&](Eigen::Vector3d v) {
    for (const auto& b : basis) v -= b.dot(v) * b;
    return v;
  };
  for (const auto& d : directions) {
    const Eigen::Vector3d rest = beyond_basis(d);
    if (rest.norm() > 1e-6) basis.push_back(rest.normalized());
  }
  return !(beyond_basis(direction).norm() > 1e-6);
}

std::string clamped_by(const setup::PartSetup& source, const std::string& name, const Eigen::Vector3d& direction) {
  const auto found = std::ranges::find(source.points, name, &setup::Point::name);
  if (!source.part || !geometry_known(*source.part) || found == source.points.end()) return "";
  if (found->at.has_value() == found->position.has_value()) return "";
  for (const auto& support : source.part->supports) {
    if (!holds(source, support, setup::position(*source.part, *found))) continue;
    double held = 0.0;
    for (const int axis : support.fixed) held += direction[axis] * direction[axis];
    if (held > 1e-12) return support.on;
  }
  return "";
}

}  // namespace thinwall::cases
