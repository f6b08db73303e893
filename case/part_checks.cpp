#include "case/part_checks.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "case/checks.hpp"
#include "case/part_description_checks.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
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

/// A regular tetrahedron of edge a has a³/(6√2); meshers fill space with tetrahedra of about that size.
constexpr double tets_per_cube = 8.485281374238570;
constexpr double most_tets = 2e7;
constexpr double most_dofs = 5e6;

bool axes_differ(const setup::Part& part) {
  const int sum = (1 << std::max(part.length_axis, 0)) + (1 << std::max(part.height_axis, 0)) +
                  (1 << std::max(part.thickness_axis, 0));
  return std::min({part.length_axis, part.height_axis, part.thickness_axis}) >= 0 && sum == 7 &&
         part.length_axis != part.height_axis;
}

bool geometry_known(const setup::Part& part) {
  if (setup::from_file(part)) return part.imported != nullptr;
  if (part.shape == setup::PartShape::prism) return mesh::violations(part.prism).empty();
  return axes_differ(part) && std::isfinite(part.length) && std::isfinite(part.height) && std::isfinite(part.thickness);
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

/// Keys of other shapes than the part's.
void check_belonging(const setup::Part& part, Findings& findings) {
  struct Belonging {
    const char* key;
    std::vector<setup::PartShape> shapes;
  };
  using enum setup::PartShape;
  const std::vector<Belonging> all{{"part.length", {box}},
                                   {"part.height", {box}},
                                   {"part.thickness", {box, prism}},
                                   {"part.outline", {prism}},
                                   {"part.holes[0].outline", {prism}},
                                   {"part.zones[0].outline", {prism}},
                                   {"part.bend.radius", {box, prism}},
                                   {"part.file", {surface, mesh}},
                                   {"part.unit", {surface, mesh, matrices}},
                                   {"part.mass_unit", {mesh, matrices}},
                                   {"part.matrices.stiffness", {matrices}},
                                   {"part.origin", {surface, mesh, matrices}},
                                   {"part.supports[0].on", {box, prism, surface, mesh}},
                                   {"part.clamps[0].on", {box, prism, surface, mesh}},
                                   {"part.masses[0].at", {box, prism, surface, mesh}},
                                   {"part.springs[0].at", {box, prism, surface, mesh}},
                                   {"part.materials[0].on", {box, prism, surface, mesh}},
                                   {"part.material.density", {box, prism, surface, mesh}},
                                   {"part.mesh.tolerance", {box, prism, surface, mesh}},
                                   {"part.repair.merge_tolerance", {surface}}};
  for (const auto& [key, shapes] : all) {
    if (!findings.given(key) || std::ranges::find(shapes, part.shape) != shapes.end()) continue;
    std::string list;
    for (const auto shape : shapes) list += (list.empty() ? "\"" : " or \"") + core::word_of(shape) + "\"";
    findings.report(key, "belongs to a part of shape " + list + ", this one is a \"" + core::word_of(part.shape) +
                             "\"; set part.shape, or remove it");
  }
}

void check_matrices(const setup::Part& part, Findings& findings) {
  if (!findings.given("part.matrices.stiffness"))
    return findings.report("part.matrices.stiffness", "missing; the file of K");
  try {
    (void)dynamics::unit_system(part.file.unit, part.file.matrices.mass_unit);
  } catch (const core::InputError& error) {
    findings.report("part.matrices", std::string(error.what()) + "; set part.unit and part.mass_unit");
  }
}

void check_part_file(const setup::Part& part, Findings& findings) {
  if (part.shape == setup::PartShape::matrices) return check_matrices(part, findings);
  if (!findings.given("part.shape") && findings.given("part.file") && !setup::shape_of_file(part.file.path)) {
    findings.report("part.file", "\"" + part.file.path.filename().string() +
                                     "\" has an ending that is not read; take a .stl, .off, .obj, .ply or .step, or a "
                                     "mesh as .msh, .inp or .vtu");
    return;
  }
  if (!findings.given("part.file")) findings.report("part.file", "missing; the surface or the mesh of the part");
  if (setup::tells_its_unit(part.file.path) && !findings.given("part.unit")) return;
  if (!findings.given("part.unit")) {
    findings.report("part.unit", "missing; the file does not tell its unit of length: \"mm\", \"m\", \"inch\"");
  } else {
    try {
      (void)io::metres_per_unit(part.file.unit, part.file.path.filename().string());
    } catch (const core::InputError& error) {
      findings.report("part.unit", error.what());
    }
  }
}

void check_prism(const setup::Part& part, Findings& findings) {
  for (const auto* key : {"part.outline", "part.thickness"}) {
    if (!findings.given(key)) findings.report(key, "missing; a prism has an outline and a thickness along z");
  }
  if (!findings.given("part.outline") || !std::isfinite(part.prism.top)) return;
  bool unread = part.prism.outline.empty();  // and reported as such
  for (const auto& hole : part.prism.holes) unread = unread || hole.empty();
  for (const auto& zone : part.prism.zones) unread = unread || zone.outline.empty() || !std::isfinite(zone.top);
  if (unread) return;
  for (const std::string& violation : mesh::violations(part.prism)) findings.report("part.outline", violation);
}

void check_bend(const setup::Part& part, Findings& findings) {
  if (!part.bend || setup::from_file(part) || !geometry_known(part) || !std::isfinite(part.bend->radius)) return;
  const int through = setup::planar(part).axes[2];
  const Eigen::AlignedBox3d box = setup::bounds(part);
  if (part.bend->along && *part.bend->along == through) {
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
  check_belonging(part, findings);
  if (setup::from_file(part)) return check_part_file(part, findings);
  if (part.shape == setup::PartShape::prism) return check_prism(part, findings);
  for (const auto* extent : {"part.length", "part.height", "part.thickness"}) {
    if (!findings.given(extent)) findings.report(extent, "missing; a box has a length, a height and a thickness");
  }
  if (findings.given("part.axes.length") && !axes_differ(part)) {
    findings.report("part.axes.length", "length, height and thickness must run along three different axes");
  }
}

/// Parts that TetGen meshes: boxes with a given element size.
bool by_tetgen(const setup::Part& part) {
  return part.shape == setup::PartShape::box && !part.bend && part.mesh.element_size.has_value();
}

/// Element size as the mesher is asked for it: `near` at the points, growing with the distance to them up to `far`.
struct Grading {
  std::vector<Eigen::Vector3d> points;
  double near = 0.0, growth = 0.0, far = 0.0;

  [[nodiscard]] double distance(const Eigen::Vector3d& x) const {
    double nearest = std::numeric_limits<double>::max();
    for (const auto& p : points) nearest = std::min(nearest, (x - p).norm());
    return nearest;
  }
  [[nodiscard]] double size(double distance) const { return std::min(far, near + growth * std::max(0.0, distance)); }
};

Grading grading_of(const Case& source) {
  const setup::Part& part = *source.part;
  const double thinnest = std::min({part.length, part.height, part.thickness});
  // The quality bound lets a tetrahedron be about twice as wide as the wall is thick, however large it may be.
  const double far = std::min(*part.mesh.element_size, 2.0 * thinnest);
  Grading grading{{}, far, 0.0, far};
  if (!part.mesh.point_element_size) return grading;
  for (const setup::Point& p : source.points) {
    if (p.at.has_value() != p.position.has_value()) grading.points.push_back(setup::position(part, p));
  }
  if (grading.points.empty()) return grading;
  grading.near = *part.mesh.point_element_size;
  grading.growth = part.mesh.grading.value_or(1.5) - 1.0;
  return grading;
}

/// ∫ 6√2 / size³ over the cell, halved until the size varies little in it or it is no larger than an element.
double tets_in(const Eigen::AlignedBox3d& cell, const Grading& grading) {
  const Eigen::Vector3d extent = cell.sizes();
  const double distance = grading.distance(cell.center()), reach = 0.5 * extent.norm();
  const double finest = grading.size(distance - reach), coarsest = grading.size(distance + reach);
  if (!(coarsest > 1.5 * finest && extent.maxCoeff() > finest))
    return tets_per_cube * cell.volume() / std::pow(grading.size(distance), 3);
  Eigen::Index longest = 0;
  extent.maxCoeff(&longest);
  Eigen::AlignedBox3d lower = cell, upper = cell;
  lower.max()[longest] = upper.min()[longest] = cell.center()[longest];
  return tets_in(lower, grading) + tets_in(upper, grading);
}

double area_of(const mesh::TriangleSurface& surface) {
  double area = 0.0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    area += mesh::area_vector(surface, static_cast<int>(t)).norm();
  return area;
}

/// Twice as many as an even layer of triangles of the usual size (mesh::SurfaceSize) on both sides of a wall, three
/// tetrahedra for two triangles, as edges are lined with layers; five times as many on the second level, which edges
/// that turn inwards call for.
double elements_in_surface(const setup::Part& part) {
  const mesh::SurfaceRepair& imported = *part.imported->surface;
  const double area = area_of(imported.surface), wall = 2.0 * imported.volume_m3 / area;
  const double size = part.mesh.element_size.value_or(std::min(9.0 * wall, part.imported->box.diagonal().norm() / 8.0));
  const bool finer = !part.mesh.element_size && fem::has_reentrant_edge(imported.surface);
  return (finer ? 5.0 : 1.0) * 2.0 * 1.5 * area / (0.433 * size * size);
}

/// Walls so thin that elements of their size are too many: most often the unit is another than stated.
void check_surface_size(const Case& source, Findings& findings) {
  const setup::Part& part = *source.part;
  const double dofs = estimate_size(source).dofs;
  if (!(dofs > most_dofs)) return;
  const mesh::SurfaceRepair& imported = *part.imported->surface;
  const auto length = [](double value) { return core::readable_text(value, core::kind::length); };
  const std::string wall = "walls of " + length(2.0 * imported.volume_m3 / area_of(imported.surface)) + " on the whole";
  const std::string many =
      "about " + core::readable_text(dofs, core::kind::number) + " degrees of freedom, at most 5e+06 are solved; ";
  if (part.mesh.element_size) {
    findings.report("part.mesh.element_size",
                    length(*part.mesh.element_size) + " would make " + many + "take larger elements or a lower order");
  } else {
    findings.report("part.file", "in a part of its size, " + wall + " would make " + many +
                                     "check part.unit, or give part.mesh.element_size");
  }
}

/// The excess, and the size or order that would do; a uniform mesh grows with the cube of its fineness.
void check_mesh_size(const Case& source, Findings& findings) {
  const setup::MeshOptions& mesh = source.part->mesh;
  if (mesh.grading && !findings.given("part.mesh.point_element_size"))
    findings.report("part.mesh.grading", "there is nothing to grade; give point_element_size, or remove grading");
  // A resolved case writes defaults out: only another value shows that the user meant it.
  const bool other_quality = mesh.quality != setup::MeshOptions{}.quality;
  if (!by_tetgen(*source.part) && (mesh.point_element_size || other_quality)) {
    findings.report(other_quality ? "part.mesh.quality" : "part.mesh.point_element_size",
                    "belongs to boxes with a given element_size; elsewhere meshes are graded by rule; remove it");
  }
  if (source.part->shape == setup::PartShape::surface && !mesh.element_size && mesh.tolerance < 1e-3)
    findings.report("part.mesh.tolerance", "a surface from a file is followed to 0.001 at best; take that or more");
  if (mesh.element_size && mesh.tolerance != setup::usual_tolerance(*source.part))
    findings.report("part.mesh.tolerance", "nothing is estimated with a given element_size; remove one of the two");
  if (source.part->shape == setup::PartShape::surface) check_surface_size(source, findings);
  if (!by_tetgen(*source.part)) return;
  const int order_now = mesh.order.value_or(2);
  const SizeEstimate size = estimate_size(source);
  const bool many_tets = size.elements > most_tets;
  if (!many_tets && !(size.dofs > most_dofs)) return;
  const double excess = many_tets ? size.elements / most_tets : size.dofs / most_dofs;
  const Grading grading = grading_of(source);
  const bool near_points = grading.near < grading.far;
  const double asked = near_points ? grading.near : *mesh.element_size;
  const double enough = 1.05 * std::cbrt(excess) * std::min(asked, grading.far);
  const auto length = [](double value) { return core::readable_text(value, core::kind::length); };
  const auto number = [](double value) { return core::readable_text(value, core::kind::number); };
  const std::string order = " of order " + std::to_string(order_now);
  const std::string what = many_tets ? number(size.elements) + " tetrahedra, at most 2e+07 are made"
                                     : number(size.dofs) + " degrees of freedom, at most 5e+06 are solved";
  const double widest = 2.0 * std::min({source.part->length, source.part->height, source.part->thickness});
  const std::string remedy = near_points        ? "larger elements at the points, or a larger part.mesh.grading"
                             : enough <= widest ? length(enough) + " or more"
                                                : "a smaller or thicker part";
  findings.report(near_points ? "part.mesh.point_element_size" : "part.mesh.element_size",
                  length(asked) + (many_tets ? "" : order) + " would make about " + what + "; take " + remedy +
                      (many_tets || order_now == 1 ? "" : ", or a lower part.mesh.order"));
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
      (source.part->shape != setup::PartShape::matrices && source.part->shape != setup::PartShape::mesh))
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

void check_point(const Case& source, const setup::Point& point, Findings& findings) {
  const std::string key = "points." + point.name;
  const bool matrices = source.part && source.part->shape == setup::PartShape::matrices;
  if (matrices || point.node) return check_node(source, point, findings);
  if (point.at.has_value() == point.position.has_value()) {
    findings.report(key, "give either at = [fractions of the box] or position = [lengths]");
    return;
  }
  if (source.part && geometry_known(*source.part)) {
    const std::string outside = outside_part(*source.part, setup::position(*source.part, point), point.patch_radius);
    if (!outside.empty()) findings.report(point.at ? key + ".at" : key + ".position", outside);
  }
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

bool holds(const setup::PartSetup& source, const setup::Support& support, const Eigen::Vector3d& p) {
  const auto& part = *source.part;
  if (std::ranges::find(mesh::face_names(), support.on) != mesh::face_names().end())
    return on_face(part, support.on, p);
  const auto selection = std::ranges::find(source.selections, support.on, &setup::Selection::name);
  return selection != source.selections.end() && contains(*selection, p, tolerance(part));
}

}  // namespace

SizeEstimate estimate_size(const Case& source) {
  const setup::Part& part = *source.part;
  SizeEstimate size;
  if (part.shape == setup::PartShape::matrices) {
    size.dofs = static_cast<double>(part.imported->matrices->size());
    size.seconds = 3.0 * std::pow(size.dofs / 4e4, 1.3);
    return size;
  }
  size.order = part.mesh.order.value_or(part.mesh.element_size ? 2 : 5);
  if (part.shape == setup::PartShape::mesh)
    size.order = part.mesh.order.value_or(std::max(2, part.imported->mesh->solid.nodes.order));
  size.elements =
      part.shape == setup::PartShape::mesh ? static_cast<double>(part.imported->mesh->solid.mesh.tets.size())
      : setup::from_file(part)             ? elements_in_surface(part)
      : by_tetgen(part) ? std::max(6.0, tets_in({Eigen::Vector3d::Zero(), setup::box_size(part)}, grading_of(source)))
                        : static_cast<double>(setup::graded_mesh(source, 0).tets.size());
  // A tetrahedral mesh of a thin wall has about 0.3 vertices, 1.6 edges and 2.3 faces an element.
  const double p = size.order;
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
    check_shape(source, findings);
    check_description(source, findings);
    check_bend(*source.part, findings);
    if (geometry_known(*source.part)) check_material_places(source, findings);
    if (geometry_known(*source.part) && source.part->shape != setup::PartShape::matrices &&
        source.part->shape != setup::PartShape::mesh)
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
  if (part.shape != setup::PartShape::surface) return "";
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
