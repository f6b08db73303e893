#include "case/checks/mesh_size.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.hpp"
#include "fem/closed_part.hpp"
#include "setup/graded_mesh.hpp"
#include "setup/imported_part.hpp"

namespace thinwall::cases {

namespace {

/// A regular tetrahedron of edge a has a³/(6√2); meshers fill space with tetrahedra of about that size.
constexpr double tets_per_cube = 8.485281374238570;
constexpr double most_tets = 2e7;
constexpr double most_dofs = 5e6;
constexpr double most_first_dofs = 1e6;  // of a first mesh at order 2; a rough estimate, hence above what is solved

/// Parts that TetGen meshes: boxes with a given element size.
bool by_tetgen(const setup::Part& part) {
  return setup::kind(part) == setup::ShapeKind::box && setup::bend(part) == nullptr &&
         part.mesh.element_size.has_value();
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
  const double thinnest = setup::box_size(part).minCoeff();
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
/// tetrahedra for two triangles, as edges are lined with layers.
double elements_in_first_mesh(const setup::Part& part) {
  const mesh::SurfaceRepair& imported = *part.imported->surface;
  const double area = area_of(imported.surface), wall = 2.0 * imported.volume_m3 / area;
  const double size = part.mesh.element_size.value_or(std::min(9.0 * wall, part.imported->box.diagonal().norm() / 8.0));
  return 2.0 * 1.5 * area / (0.433 * size * size);
}

/// Five times as many on the second level, which edges that turn inwards call for.
double elements_in_surface(const setup::Part& part) {
  const bool finer = !part.mesh.element_size && fem::has_reentrant_edge(part.imported->surface->surface);
  return (finer ? 5.0 : 1.0) * elements_in_first_mesh(part);
}

/// The degrees of freedom of so many elements. A tetrahedral mesh of a thin wall has about 0.3 vertices, 1.6 edges and
/// 2.3 faces an element.
double dofs_of(double elements, int order) {
  const double p = order;
  return 3.0 * elements * (0.3 + 1.6 * (p - 1) + 2.3 * (p - 1) * (p - 2) / 2 + (p - 1) * (p - 2) * (p - 3) / 6);
}

/// Walls so thin that elements of their size are too many: most often the unit is another than stated. A part that is
/// solved to a tolerance has an answer if its first mesh can be solved at order 2.
void check_surface_size(const Case& source, Findings& findings) {
  const setup::Part& part = *source.part;
  const bool to_tolerance = !part.mesh.element_size && !part.mesh.order;
  const double dofs = to_tolerance ? dofs_of(elements_in_first_mesh(part), 2) : estimate_size(source).dofs;
  const double most = to_tolerance ? most_first_dofs : most_dofs;
  if (!(dofs > most)) return;
  const mesh::SurfaceRepair& imported = *part.imported->surface;
  const auto length = [](double value) { return core::readable_text(value, core::kind::length); };
  const std::string wall = "walls of " + length(2.0 * imported.volume_m3 / area_of(imported.surface)) + " on the whole";
  const std::string many = "about " + core::readable_text(dofs, core::kind::number) + " degrees of freedom" +
                           (to_tolerance ? " at order 2, and a first mesh of more than about " : ", at most ") +
                           core::readable_text(most, core::kind::number) +
                           (to_tolerance ? " is not made; " : " are solved; ");
  if (part.mesh.element_size) {
    findings.report("part.mesh.element_size",
                    length(*part.mesh.element_size) + " would make " + many + "take larger elements or a lower order");
  } else {
    findings.report("part.file", "in a part of its size, " + wall + " would make " + many +
                                     "check part.unit, or give part.mesh.element_size");
  }
}

}  // namespace

setup::PartSize estimate_size(const Case& source) {
  const setup::Part& part = *source.part;
  setup::PartSize size;
  if (setup::kind(part) == setup::ShapeKind::matrices) {
    size.dofs = static_cast<double>(part.imported->matrices->size());
    size.seconds = 3.0 * std::pow(size.dofs / 4e4, 1.3);
    return size;
  }
  size.order = part.mesh.order.value_or(part.mesh.element_size ? 2 : 5);
  if (setup::kind(part) == setup::ShapeKind::mesh)
    size.order = part.mesh.order.value_or(std::max(2, part.imported->mesh->solid.nodes.order));
  size.elements =
      setup::kind(part) == setup::ShapeKind::mesh ? static_cast<double>(part.imported->mesh->solid.mesh.tets.size())
      : setup::from_file(part)                    ? elements_in_surface(part)
      : by_tetgen(part) ? std::max(6.0, tets_in({Eigen::Vector3d::Zero(), setup::box_size(part)}, grading_of(source)))
                        : static_cast<double>(setup::graded_mesh(source, 0).tets.size());
  size.dofs = dofs_of(size.elements, size.order);
  // 40 000 DOFs take some three seconds with factorisation, modes and reduction; the factor of a wall grows as n^1.3.
  size.seconds = 3.0 * std::pow(size.dofs / 4e4, 1.3);
  return size;
}

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
  if (setup::kind(*source.part) == setup::ShapeKind::surface && !mesh.element_size && mesh.tolerance < 1e-3)
    findings.report("part.mesh.tolerance", "a surface from a file is followed to 0.001 at best; take that or more");
  if (mesh.element_size && mesh.tolerance != setup::usual_tolerance(*source.part))
    findings.report("part.mesh.tolerance", "nothing is estimated with a given element_size; remove one of the two");
  if (mesh.element_size && mesh.time_budget != setup::usual_time_budget(*source.part))
    findings.report("part.mesh.time_budget", "nothing is refined with a given element_size; remove one of the two");
  if (setup::kind(*source.part) == setup::ShapeKind::surface) check_surface_size(source, findings);
  if (!by_tetgen(*source.part)) return;
  const int order_now = mesh.order.value_or(2);
  const setup::PartSize size = estimate_size(source);
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
  const double widest = 2.0 * setup::box_size(*source.part).minCoeff();
  const std::string remedy = near_points        ? "larger elements at the points, or a larger part.mesh.grading"
                             : enough <= widest ? length(enough) + " or more"
                                                : "a smaller or thicker part";
  findings.report(near_points ? "part.mesh.point_element_size" : "part.mesh.element_size",
                  length(asked) + (many_tets ? "" : order) + " would make about " + what + "; take " + remedy +
                      (many_tets || order_now == 1 ? "" : ", or a lower part.mesh.order"));
}

}  // namespace thinwall::cases
