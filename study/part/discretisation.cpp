#include "study/part/discretisation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/messages.hpp"
#include "fem/closed_part.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/planar/box_mesh.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "mesh/selection.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "mesh/volume/tetgen.hpp"
#include "setup/graded_mesh.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_attachments.hpp"
#include "setup/part_geometry.hpp"
#include "setup/part_materials.hpp"
#include "setup/path.hpp"
#include "study/part/matrix_part.hpp"

namespace thinwall::study {

namespace {

/// Size near the named points, growing by `grading` (m of size per m of distance) away from them.
std::function<double(const Eigen::Vector3d&)> graded_size(const setup::PartSetup& source) {
  const setup::MeshOptions& options = source.part->mesh;
  if (!options.point_element_size) return {};
  std::vector<Eigen::Vector3d> points;
  for (const setup::Point& p : source.points) points.push_back(setup::position(*source.part, p));
  const double growth = options.grading.value_or(1.5) - 1.0;
  return [points, growth, near = *options.point_element_size, far = *options.element_size](const Eigen::Vector3d& x) {
    double nearest = std::numeric_limits<double>::max();
    for (const auto& p : points) nearest = std::min(nearest, (x - p).norm());
    return std::min(far, near + growth * nearest);
  };
}

/// TetGen's mesh of the part's box, graded towards the named points where the case asks for it.
mesh::TetMesh tetgen_mesh(const setup::PartSetup& source) {
  const setup::MeshOptions& wanted = source.part->mesh;
  mesh::TetgenOptions options;
  options.element_size_m = *wanted.element_size;
  options.radius_edge_ratio = wanted.quality;
  options.time_limit_s = wanted.time_limit;
  options.memory_limit_bytes = wanted.memory_limit;
  options.size_at = graded_size(source);
  return mesh::tetrahedralise(mesh::surface({setup::box_size(*source.part)}), options);
}

/// A mesh of the closed surface of a file with elements of the size that the case gives, one through the wall.
mesh::TetMesh surface_mesh(const setup::PartSetup& source) {
  const setup::MeshOptions& wanted = source.part->mesh;
  mesh::SurfaceMeshOptions options;
  options.size.size_m = *wanted.element_size;
  options.limits = {wanted.time_limit, wanted.memory_limit};
  mesh::SurfaceMeshed meshed = mesh::mesh_closed_surface(source.part->imported->surface->surface, options);
  for (const auto& failure : meshed.failures)
    core::inform(fmt::format("a mesher failed and the next was tried: {}", failure));
  core::inform(fmt::format("{}: volume off by {:.1e} relative, surface by up to {:.2g} mm", meshed.mesher,
                           meshed.volume_error_relative, 1e3 * meshed.surface_distance_m));
  return std::move(meshed.mesh);
}

void log_step(const fem::RefinementStep& step) {
  std::string text = fmt::format("level {}, order {}: {} degrees of freedom", step.level, step.order, step.dofs);
  if (step.frequency_change) text += fmt::format(", frequencies changed by {:.2e}", *step.frequency_change);
  if (step.receptance_change)
    text += fmt::format(", receptances by {:.2e} ({} by {:.2e} of itself)", *step.receptance_change,
                        step.worst_receptance, *step.entry_change);
  core::inform(text);
}

void warn_if_not_met(const fem::Estimate& estimate) {
  if (estimate.met) return;
  const std::string reached = fmt::format("frequencies are right to about {:.1e}, receptances to {:.1e}",
                                          estimate.frequency, estimate.receptance);
  if (estimate.within_reach > 0.0) {
    core::warn(fmt::format(
        "the tolerance of {} is out of reach, and finer meshes were left out: {}, and all of them would have come to "
        "{:.1e} at best; take a larger part.mesh.tolerance, or a larger patch_radius of the points",
        estimate.tolerance, reached, estimate.within_reach));
    return;
  }
  core::warn(fmt::format("the tolerance of {} was not met{}: {}", estimate.tolerance,
                         estimate.held_back_by.empty() ? "" : ", for " + estimate.held_back_by, reached));
}

/// Says what spheres of another material cost; returns their share of the part.
double warn_of_misplaced(const setup::PartSetup& source, const mesh::TetMesh& mesh) {
  const double share = setup::misplaced_share(source, mesh);
  if (share > 0.0)
    core::warn(fmt::format(
        "{:.1e} of the part's volume is of the wrong material, for elements lie across the border of a sphere; a box, "
        "which the mesh follows, or smaller elements make it less",
        share));
  return share;
}

/// Frequencies are off by about the share of mass or stiffness that is misplaced; the estimate knows nothing of it.
void add_misplaced(double share, fem::Estimate& estimate) {
  estimate.frequency += share;
  estimate.met = estimate.met && estimate.frequency <= estimate.tolerance;
}

Discretisation discretised(const setup::PartSetup& source, fem::Refined refined) {
  add_misplaced(warn_of_misplaced(source, refined.model.mesh), refined.estimate);
  warn_if_not_met(refined.estimate);
  Discretisation result{refined.model.mesh, refined.model.nodes.order, refined.estimate, {}};
  result.solved.emplace(Solution{std::move(refined.model), std::move(refined.factored), std::move(refined.modes)});
  return result;
}

std::function<fem::Materials(const mesh::TetMesh&)> several_materials(const setup::PartSetup& source) {
  if (source.part->materials.empty()) return {};
  return [&source](const mesh::TetMesh& mesh) { return setup::materials_on(source, mesh); };
}

/// The share of part.mesh.time_budget in which meshes and solutions must be found; the rest is for checks and results.
constexpr double share_of_solutions = 0.8;

/// The share of the time of meshes and solutions in which one attempt of a mesher must end.
constexpr double share_of_a_mesher = 0.5;

double budget_of_solutions_s(const setup::Part& part) {
  return share_of_solutions * part.mesh.time_budget.value_or(0.0);
}

/// The options by which the closed surface of a file is solved.
fem::ClosedPartOptions closed_part_options(const PartInput& source) {
  const setup::MeshOptions& wanted = source.part->mesh;
  fem::ClosedPartOptions options;
  options.tolerance = wanted.tolerance;
  options.modes = setup::mode_options(source);
  // Frequencies need few digits of the shapes; reductions and the check of modes need more.
  if (source.reduction.interface.empty() && !source.modes.verify)
    options.modes.inverse_residual = fem::enough_for_frequencies(wanted.tolerance);
  options.supports = setup::supports_of(source);
  options.points = watched_points(source);
  options.points_hold = !source.reduction.interface.empty();
  options.attachments = setup::attachments_of(source);
  options.materials = several_materials(source);
  options.divided = [&source](mesh::TetMesh mesh) { return setup::cut_at_materials(source, std::move(mesh)); };
  options.solid_volume_m3 = source.part->imported->surface->solid_volume_m3;
  options.levels = 2;
  options.time_budget_s = budget_of_solutions_s(*source.part);
  options.solved = log_step;
  options.limits = {wanted.time_limit, wanted.memory_limit};
  if (options.time_budget_s > 0.0)
    options.limits.time_s = std::min(wanted.time_limit, share_of_a_mesher * options.time_budget_s);
  if (wanted.order) {
    options.last_order = std::max(2, *wanted.order);
    options.first_order = options.last_order - 1;
    options.first_dofs = 0;  // the order is the one that is asked for
  }
  return options;
}

/// The closed surface of a file, by its walls.
Discretisation refined_surface(const PartInput& source, std::shared_ptr<const fem::FirstMesh> first) {
  fem::ClosedPartOptions options = closed_part_options(source);
  options.first = std::move(first);
  fem::ClosedPart part =
      fem::refine_closed_part(source.part->imported->surface->surface, setup::material_of(*source.part), options);
  for (const auto& fit : part.fits) {
    for (const auto& failure : fit.failures)
      core::inform(fmt::format("a mesher failed and the next was tried: {}", failure));
    core::inform(fmt::format("{}: volume off by {:.1e} relative, surface by up to {:.2g} mm", fit.mesher,
                             fit.volume_error_relative, 1e3 * fit.surface_distance_m));
  }
  fem::Estimate& estimate = part.refined.estimate;  // what the surface is off by belongs to it
  estimate.frequency = part.frequency_error;
  estimate.tolerance = options.tolerance;
  estimate.met = part.met;
  return discretised(source, std::move(part.refined));
}

Discretisation refined_to_tolerance(const PartInput& source, std::shared_ptr<const fem::FirstMesh> first) {
  for (const std::string& warning : setup::unreachable_tolerances(source)) core::warn(warning);
  if (setup::kind(*source.part) == setup::ShapeKind::surface) return refined_surface(source, std::move(first));
  const setup::MeshOptions& wanted = source.part->mesh;
  fem::SolidPart part{[&](int level) { return setup::cut_at_materials(source, setup::graded_mesh(source, level)); },
                      setup::shaping(*source.part),
                      setup::material_of(*source.part),
                      setup::supports_of(source),
                      setup::attachments_of(source),
                      several_materials(source)};
  fem::ToleranceOptions options;
  options.tolerance = wanted.tolerance;
  options.modes = setup::mode_options(source);
  options.time_budget_s = budget_of_solutions_s(*source.part);
  options.solved = log_step;
  options.reentrant_edges = mesh::has_reentrant_edge(setup::planar(*source.part).prism);
  if (options.reentrant_edges) options.levels = 2;  // more bring little: across a rib one element remains
  options.points = watched_points(source);
  options.points_hold = !source.reduction.interface.empty();
  if (wanted.order) {
    options.last_order = std::max(2, *wanted.order);
    options.first_order = options.last_order - 1;
  }
  return discretised(source, fem::refine_to_tolerance(part, options));
}

}  // namespace

mesh::TetMesh coarsest_mesh(const PartInput& source) {
  const setup::Part& part = *source.part;
  if (setup::kind(part) == setup::ShapeKind::mesh) return part.imported->mesh->solid.mesh;
  if (part.mesh.element_size) return setup::cut_at_materials(source, surface_mesh(source));
  return fem::first_mesh(part.imported->surface->surface, closed_part_options(source)).mesh;
}

std::shared_ptr<const fem::FirstMesh> first_mesh(const PartInput& source) {
  const setup::Part& part = *source.part;
  if (setup::kind(part) != setup::ShapeKind::surface || part.mesh.element_size) return {};
  return std::make_shared<fem::FirstMesh>(
      fem::first_mesh(part.imported->surface->surface, closed_part_options(source)));
}

bool is_solved_one_order_higher(const setup::Part& part, int order) {
  return setup::kind(part) == setup::ShapeKind::mesh && order <= 5;
}

std::vector<fem::NamedPoint> watched_points(const PartInput& source) {
  std::vector<fem::NamedPoint> points;
  const auto add = [&points](const setup::PartSetup& at) {
    for (const std::string& name : at.reduction.interface) points.push_back(setup::named_point(at, name));
  };
  add(source);
  if (source.path.empty()) return points;
  const std::size_t last = source.path.size() - 1;
  for (const std::size_t i : {std::size_t{0}, last / 2, last}) add(setup::part_at(source, source.path[i]));
  return points;
}

Discretisation discretise(const PartInput& source, std::shared_ptr<const fem::FirstMesh> first) {
  const setup::Part& part = *source.part;
  if (setup::kind(part) == setup::ShapeKind::matrices) {
    Discretisation result;
    result.solved.emplace(matrix_solution(source));
    return result;
  }
  if (setup::kind(part) == setup::ShapeKind::mesh) {
    const mesh::SolidMesh& solid = part.imported->mesh->solid;
    return {solid.mesh, part.mesh.order.value_or(std::max(2, solid.nodes.order)), {}, {}};
  }
  const auto* box = std::get_if<setup::BoxShape>(&part.shape);
  if (box != nullptr && box->thickness > std::max(box->length, box->height)) {
    core::warn(
        fmt::format("the part is {:g} m thick, more than it is long or high; a number without a unit is in metres",
                    box->thickness));
  }
  if (!part.mesh.element_size) return refined_to_tolerance(source, std::move(first));
  const int order = part.mesh.order.value_or(2);
  mesh::TetMesh mesh = setup::kind(part) == setup::ShapeKind::surface ? surface_mesh(source)
                       : box != nullptr && !box->bend                 ? tetgen_mesh(source)
                                                                      : setup::graded_mesh(source, 0);
  mesh = setup::cut_at_materials(source, std::move(mesh));
  warn_of_misplaced(source, mesh);
  return {std::move(mesh), order, {}, {}};
}

}  // namespace thinwall::study
