#include "study/part/discretisation.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/memory.hpp"
#include "fem/closed_part.hpp"
#include "mesh/planar/bend.hpp"
#include "mesh/planar/box_mesh.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "mesh/selection.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "mesh/volume/tetgen.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_attachments.hpp"
#include "setup/part_materials.hpp"
#include "setup/path.hpp"
#include "study/part/matrix_part.hpp"

namespace thinwall::study {

namespace {

/// Size near the named points, growing by `grading` (m of size per m of distance) away from them.
std::function<double(const Eigen::Vector3d&)> graded_size(const cases::Case& source) {
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
mesh::TetMesh tetgen_mesh(const cases::Case& source) {
  const setup::MeshOptions& wanted = source.part->mesh;
  mesh::TetgenOptions options;
  options.element_size_m = *wanted.element_size;
  options.radius_edge_ratio = wanted.quality;
  options.time_limit_s = wanted.time_limit;
  options.memory_limit_bytes = wanted.memory_limit;
  options.size_at = graded_size(source);
  return mesh::tetrahedralise(mesh::surface({setup::box_size(*source.part)}), options);
}

double thinnest(const mesh::Prism& prism) {
  double t = prism.top - prism.bottom;
  for (const auto& zone : prism.zones) t = std::min(t, zone.top - zone.bottom);
  return t;
}

/// About the frequency (Hz) of the highest mode wanted: of a plate N modes lie below N · 2 c_L t / (√12 A), less what
/// free edges add to their number; c_L the speed of longitudinal waves in a plate (Cremer, Heckl & Petersson 2005).
double highest_frequency(const cases::Case& source, const mesh::Prism& prism) {
  if (source.modes.range.up_to_hz) return *source.modes.range.up_to_hz;
  const setup::Material& m = source.part->material;
  const double wave_speed = std::sqrt(m.youngs_modulus / (m.density * (1.0 - m.poisson_ratio * m.poisson_ratio)));
  const double t = thinnest(prism);
  const double area = mesh::volume(prism) / t;
  return 0.6 * source.modes.range.count.value_or(10) * 2.0 * wave_speed * t / (std::sqrt(12.0) * area);
}

/// Length of a bending wave of a plate, 2π (E t² / (12 (1−ν²) ρ ω²))^¼, m.
double bending_wavelength(const setup::Material& m, double thickness, double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  const double stiffness_over_mass = m.youngs_modulus * thickness * thickness /
                                     (12.0 * (1.0 - m.poisson_ratio * m.poisson_ratio) * m.density * omega * omega);
  return 2.0 * std::numbers::pi * std::pow(stiffness_over_mass, 0.25);
}

int along_axis(const setup::Part& part, int through) {
  if (part.bend->along) return *part.bend->along;
  Eigen::Vector3d size = setup::box_size(part);
  size[through] = 0.0;
  int longest = 0;
  size.maxCoeff(&longest);
  return longest;
}

/// A mesh of the closed surface of a file with elements of the size that the case gives, one through the wall.
mesh::TetMesh surface_mesh(const cases::Case& source) {
  const setup::MeshOptions& wanted = source.part->mesh;
  mesh::SurfaceMeshOptions options;
  options.size.size_m = *wanted.element_size;
  options.limits = {wanted.time_limit, wanted.memory_limit};
  mesh::SurfaceMeshed meshed = mesh::mesh_closed_surface(source.part->imported->surface->surface, options);
  for (const auto& failure : meshed.failures) spdlog::info("a mesher failed and the next was tried: {}", failure);
  spdlog::info("{}: volume off by {:.1e} relative, surface by up to {:.2g} mm", meshed.mesher,
               meshed.volume_error_relative, 1e3 * meshed.surface_distance_m);
  return std::move(meshed.mesh);
}

/// Where the tolerance on receptances is to hold: at the interface, and at both ends and the middle of the path.
std::vector<fem::NamedPoint> watched_points(const cases::Case& source) {
  std::vector<fem::NamedPoint> points;
  const auto add = [&points](const cases::Case& at) {
    for (const std::string& name : at.reduction.interface) points.push_back(named_point(at, name));
  };
  add(source);
  if (!source.path) return points;
  const std::size_t last = source.path->positions.size() - 1;
  for (const std::size_t i : {std::size_t{0}, last / 2, last}) add(setup::at_position(source, i));
  return points;
}

void log_steps(const fem::Estimate& estimate) {
  for (const auto& step : estimate.steps) {
    spdlog::info("level {}, order {}: {} degrees of freedom, frequencies changed by {:.2e}, receptances by {:.2e}",
                 step.level, step.order, step.dofs, step.frequency_change.value_or(0.0),
                 step.receptance_change.value_or(0.0));
  }
  if (estimate.met) return;
  spdlog::warn("the tolerance of {} was not met{}: frequencies are right to about {:.1e}, receptances to {:.1e}",
               estimate.tolerance, estimate.held_back ? ", for the next model would be too large" : "",
               estimate.frequency, estimate.receptance);
}

/// Says what spheres of another material cost; returns their share of the part.
double warn_of_misplaced(const cases::Case& source, const mesh::TetMesh& mesh) {
  const double share = setup::misplaced_share(source, mesh);
  if (share > 0.0)
    spdlog::warn(
        "{:.1e} of the part's volume is of the wrong material, for elements lie across the border of a sphere; a box, "
        "which the mesh follows, or smaller elements make it less",
        share);
  return share;
}

/// Frequencies are off by about the share of mass or stiffness that is misplaced; the estimate knows nothing of it.
void add_misplaced(double share, fem::Estimate& estimate) {
  estimate.frequency += share;
  estimate.met = estimate.met && estimate.frequency <= estimate.tolerance;
}

Discretisation discretised(const cases::Case& source, fem::Refined refined) {
  add_misplaced(warn_of_misplaced(source, refined.model.mesh), refined.estimate);
  log_steps(refined.estimate);
  Discretisation result{refined.model.mesh, refined.model.nodes.order, refined.estimate, {}};
  result.solved.emplace(Solution{std::move(refined.model), std::move(refined.factored), std::move(refined.modes)});
  return result;
}

std::function<fem::Materials(const mesh::TetMesh&)> several_materials(const cases::Case& source) {
  if (source.part->materials.empty()) return {};
  return [&source](const mesh::TetMesh& mesh) { return setup::materials_on(source, mesh); };
}

/// The closed surface of a file, by its walls.
Discretisation refined_surface(const cases::Case& source) {
  const setup::MeshOptions& wanted = source.part->mesh;
  fem::ClosedPartOptions options;
  options.tolerance = wanted.tolerance;
  options.modes = mode_options(source);
  options.modes.verify_count = false;
  options.supports = supports_of(source);
  options.points = watched_points(source);
  options.points_hold = !source.reduction.interface.empty();
  options.attachments = setup::attachments_of(source);
  options.materials = several_materials(source);
  options.divided = [&source](mesh::TetMesh mesh) { return setup::cut_at_materials(source, std::move(mesh)); };
  options.levels = 2;
  options.memory_limit_bytes = core::available_memory_bytes();
  options.limits = {wanted.time_limit, wanted.memory_limit};
  if (wanted.order) {
    options.last_order = std::max(2, *wanted.order);
    options.first_order = options.last_order - 1;
  }
  fem::ClosedPart part =
      fem::refine_closed_part(source.part->imported->surface->surface, material_of(*source.part), options);
  for (const auto& fit : part.fits) {
    for (const auto& failure : fit.failures) spdlog::info("a mesher failed and the next was tried: {}", failure);
    spdlog::info("{}: volume off by {:.1e} relative, surface by up to {:.2g} mm", fit.mesher, fit.volume_error_relative,
                 1e3 * fit.surface_distance_m);
  }
  fem::Estimate& estimate = part.refined.estimate;  // what the surface is off by belongs to it
  estimate.frequency = part.frequency_error;
  estimate.tolerance = options.tolerance;
  estimate.met = part.met;
  return discretised(source, std::move(part.refined));
}

Discretisation refined_to_tolerance(const cases::Case& source) {
  for (const std::string& warning : unreachable_tolerances(source)) spdlog::warn("{}", warning);
  if (source.part->shape == "surface") return refined_surface(source);
  const setup::MeshOptions& wanted = source.part->mesh;
  fem::SolidPart part{[&](int level) { return setup::cut_at_materials(source, graded_mesh(source, level)); },
                      shaping(*source.part),
                      material_of(*source.part),
                      supports_of(source),
                      setup::attachments_of(source),
                      several_materials(source)};
  fem::ToleranceOptions options;
  options.tolerance = wanted.tolerance;
  options.modes = mode_options(source);
  options.modes.verify_count = false;
  options.memory_limit_bytes = core::available_memory_bytes();
  options.reentrant_edges = mesh::has_reentrant_edge(planar(*source.part).prism);
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

PlanarPart planar(const setup::Part& part) {
  if (part.shape == "prism") return {part.prism, {0, 1, 2}};
  PlanarPart result;
  result.axes = {part.length_axis, part.height_axis, part.thickness_axis};
  result.prism.outline = {{0.0, 0.0}, {part.length, 0.0}, {part.length, part.height}, {0.0, part.height}};
  result.prism.top = part.thickness;
  return result;
}

mesh::TetMesh graded_mesh(const cases::Case& source, int level) {
  const PlanarPart part = planar(*source.part);
  const Eigen::Vector3d size = setup::box_size(*source.part);
  const double wave =
      bending_wavelength(source.part->material, thinnest(part.prism), highest_frequency(source, part.prism));
  const double widest = std::max(size[part.axes[0]], size[part.axes[1]]);
  mesh::PrismMeshOptions options;
  options.size_m = source.part->mesh.element_size.value_or(std::min(0.3 * wave, 0.5 * widest) / std::pow(1.5, level));
  options.layers = (mesh::has_reentrant_edge(part.prism) ? 2 : 1) + level;
  options.spot_growth = level == 0 ? 4.0 : 2.0;
  for (const setup::Point& p : source.points) {
    if (p.patch_radius <= 0.0) continue;
    const Eigen::Vector3d x = setup::position(*source.part, p);
    options.spots.push_back({{x[part.axes[0]], x[part.axes[1]]}, p.patch_radius});
  }
  return mesh::in_axes(mesh::mesh_prism(part.prism, options), part.axes);
}

mesh::Bend bend_of(const setup::Part& part) {
  const int through = planar(part).axes[2];
  const int along = along_axis(part, through);
  const Eigen::Vector3d middle = setup::bounds(part).center();
  return {part.bend->radius, along, through, middle[along], middle[through]};
}

fem::Shaping shaping(const setup::Part& part) {
  if (!part.bend) return {};
  return [bend = bend_of(part)](mesh::LagrangeNodes& nodes) { mesh::bend(bend, nodes.positions); };
}

double mass(const setup::Part& part, const mesh::TetMesh& flat) {
  if (setup::from_file(part)) return part.material.density * part.imported->surface->volume_m3;
  if (!part.bend) return part.material.density * mesh::volume(planar(part).prism);
  const mesh::Bend bend = bend_of(part);
  double volume = 0.0;
  for (int tet = 0; tet < static_cast<int>(flat.tets.size()); ++tet) {
    double w = -bend.middle_m;
    for (const int v : flat.tets[static_cast<std::size_t>(tet)])
      w += 0.25 * flat.vertices[static_cast<std::size_t>(v)][bend.through];
    volume += mesh::volume(flat, tet) * (1.0 + w / bend.radius_m);
  }
  return part.material.density * volume;
}

mesh::Region region_of(const cases::Case& source, const std::string& name) {
  const auto selection = std::find_if(source.selections.begin(), source.selections.end(),
                                      [&](const setup::Selection& s) { return s.name == name; });
  if (selection == source.selections.end()) {
    const Eigen::AlignedBox3d box = setup::bounds(*source.part);
    auto plane = std::get<mesh::PlaneRegion>(mesh::face_of({box.sizes()}, name));
    plane.point += box.min();
    return plane;
  }
  if (selection->plane) return mesh::PlaneRegion{selection->plane->point, selection->plane->normal};
  if (selection->box) return mesh::BoxRegion{selection->box->min, selection->box->max};
  return mesh::SphereRegion{selection->sphere->centre, selection->sphere->radius};
}

std::vector<int> rows_held_by_sets(const cases::Case& source, const mesh::SolidMesh& solid) {
  std::vector<int> rows;
  for (const setup::Support& support : source.part->supports) {
    if (!setup::names_node_set(source, support.on)) continue;
    const auto& set = mesh::node_set(solid, support.on, source.part->file.path.string());
    for (const int row : fem::rows_of(set.nodes, support.fixed)) rows.push_back(row);
  }
  return rows;
}

fem::Material material_of(const setup::Part& part) {
  const setup::Material& m = part.material;
  return {m.youngs_modulus, m.poisson_ratio, m.density};
}

std::vector<fem::Support> supports_of(const cases::Case& source) {
  std::vector<fem::Support> supports;
  for (const setup::Support& s : source.part->supports) {
    if (!setup::names_node_set(source, s.on)) supports.push_back({s.on, region_of(source, s.on), s.fixed});
  }
  return supports;
}

double off_surface(const setup::Part& part) {
  if (part.shape == "surface") return 0.01 * bounds(part).diagonal().norm();
  const mesh::SolidMesh* solid = setup::solid_of(part);
  if (solid == nullptr || solid->midside_offset < 1e-6) return 0.0;
  const auto vertex = [solid](int v) { return solid->mesh.vertices[static_cast<std::size_t>(v)]; };
  double longest = 0.0;
  for (const auto& tet : solid->mesh.tets) {
    for (const int v : tet) longest = std::max(longest, (vertex(v) - vertex(tet[0])).norm());
  }
  return solid->midside_offset * longest;
}

fem::NamedPoint named_point(const cases::Case& source, const std::string& name) {
  const setup::Point& p = setup::point(source, name);
  return {p.name, setup::position(*source.part, p), p.patch_radius, p.directions, {}, {}, off_surface(*source.part)};
}

fem::ModeOptions mode_options(const cases::Case& source) {
  return {source.modes.range.count.value_or(10), source.modes.range.up_to_hz, source.modes.verify_count};
}

std::vector<std::string> unreachable_tolerances(const cases::Case& source) {
  std::vector<std::string> warnings;
  if (!source.part || source.part->mesh.element_size) return warnings;
  if (source.part->shape == "matrices" || source.part->shape == "mesh") return warnings;
  for (const std::string& name : source.reduction.interface) {
    if (setup::point(source, name).patch_radius > 0.0) continue;
    warnings.push_back("points." + name +
                       " has no patch_radius: its receptance grows as the elements shrink, and no tolerance on it is "
                       "met; give the radius over which cutter or robot press");
  }
  return warnings;
}

Discretisation discretise(const cases::Case& source) {
  const setup::Part& part = *source.part;
  if (part.shape == "matrices") {
    Discretisation result;
    result.solved.emplace(matrix_solution(source));
    return result;
  }
  if (part.shape == "mesh") {
    const mesh::SolidMesh& solid = part.imported->mesh->solid;
    return {solid.mesh, part.mesh.order.value_or(std::max(2, solid.nodes.order)), {}, {}};
  }
  if (part.shape == "box" && part.thickness > std::max(part.length, part.height)) {
    spdlog::warn("the part is {:g} m thick, more than it is long or high; a number without a unit is in metres",
                 part.thickness);
  }
  if (!part.mesh.element_size) return refined_to_tolerance(source);
  const int order = part.mesh.order.value_or(2);
  mesh::TetMesh mesh = part.shape == "surface"             ? surface_mesh(source)
                       : part.shape == "box" && !part.bend ? tetgen_mesh(source)
                                                           : graded_mesh(source, 0);
  mesh = setup::cut_at_materials(source, std::move(mesh));
  warn_of_misplaced(source, mesh);
  return {std::move(mesh), order, {}, {}};
}

}  // namespace thinwall::study
