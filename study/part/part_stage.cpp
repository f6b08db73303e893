#include "study/part/part_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/messages.hpp"
#include "core/units.hpp"
#include "fem/closed_part.hpp"
#include "fem/determined_motions.hpp"
#include "fem/mode_check.hpp"
#include "fem/points.hpp"
#include "mesh/solid/locate.hpp"
#include "mesh/solid/tessellation.hpp"
#include "mesh/surface/triangle_tree.hpp"
#include "mesh/surface/wall_thickness.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "reduction/damping.hpp"
#include "reduction/methods/static_flexibility.hpp"
#include "reduction/trust/accuracy.hpp"
#include "reduction/trust/full_response.hpp"
#include "reduction/trust/mode_count.hpp"
#include "reduction/trust/receptance_sum.hpp"
#include "setup/imported_part.hpp"
#include "setup/measured.hpp"
#include "setup/part_attachments.hpp"
#include "setup/part_geometry.hpp"
#include "setup/part_materials.hpp"
#include "study/part/part_damping.hpp"
#include "study/part/part_model.hpp"
#include "study/part/path_models.hpp"

namespace thinwall::study {

namespace {

/// The full model's receptances, with which the reduced ones are compared, must be known to `most`. Round-off limits
/// them where the stiffnesses of the part differ by many orders.
void require_solved(double relative_error, double most, const char* remedy) {
  if (relative_error < reduction::small_error) return;
  if (relative_error < most) {
    core::warn(
        fmt::format("the receptances of the full model are known to {:.0e} only, because of round-off: the check "
                    "of the reduced model sees no smaller errors",
                    relative_error));
    return;
  }
  throw core::NumericalError(fmt::format(
      "the check of the reduced model: the receptances of the full one are known to {:.0e} only, {:.0e} is needed; "
      "elements of a bad shape and nearly rigid links cost digits: make the mesh more even, {}",
      relative_error, most, remedy));
}

void require_solved_for_check(double relative_error) {
  require_solved(relative_error, 1e-3, "or leave out the check (reduction.check_frequencies = 0)");
}

/// The full model, with the motions that nothing holds.
reduction::FullModel full_model(const PartResult& part) {
  return {part.model.K, part.model.M, part.model.node_of_row, part.modes.pairs.Phi.leftCols(part.modes.rigid_motions)};
}

/// As many modes as a tolerance on the interface's receptance needs.
void reduce_to_tolerance(const setup::PartSetup& source, PartResult& part) {
  reduction::Band band{source.response.from_hz, source.response.to_hz};
  if (const double least = least_loss_factor(source.damping, part.modes, band.from_hz, band.to_hz); least > 0.0)
    band.loss_factor = least;
  const reduction::FullModel full = full_model(part);
  const auto truth = reduction::band_truth(full, part.interface, band);
  require_solved(truth.max_relative_error, std::max(reduction::small_error, 0.1 * *source.reduction.tolerance),
                 "or take a larger reduction.tolerance");
  auto chosen = reduction::modes_for_tolerance(full, part.interface,
                                               {.tolerance = *source.reduction.tolerance, .band = band}, truth);
  if (chosen.status != reduction::ModeCountStatus::met) {
    throw core::NumericalError("reduction.tolerance is not met with " + std::to_string(chosen.modes) +
                               " modes: take a narrower response band, a larger tolerance, or reduction.modes");
  }
  core::inform(fmt::format("{} modes: the receptance of the interface is {:.1e} off by estimate", chosen.modes,
                           chosen.estimated_error));
  part.reduced = std::move(chosen.reduced);
  part.truncation = std::move(chosen.truncation);
  part.estimated_receptance_error = chosen.estimated_error;
}

/// The reduced model and what it leaves out.
void reduce(const setup::PartSetup& source, PartResult& part, const fem::Factored& factored) {
  if (factored.sigma != 0.0)
    fem::require_motions_determined(part.model, part.modes, part.interface.W.transpose() * part.modes.pairs.Phi);
  if (source.reduction.tolerance) return reduce_to_tolerance(source, part);
  const auto inner = static_cast<int>(part.model.K.rows() - part.interface.W.cols());
  const int asked = source.reduction.fixed_interface.count.value_or(setup::usual_reduction_modes);
  if (asked > std::max(inner, setup::usual_reduction_modes)) {
    throw core::InputError(
        fmt::format("reduction.modes is {}, but the part has {} degrees of freedom besides its points; "
                    "ask for fewer modes, or take a finer mesh",
                    asked, inner));
  }
  const reduction::CraigBamptonOptions options{std::min(asked, inner),  // a small model has fewer than is usual
                                               source.reduction.fixed_interface.up_to_hz};
  const auto by = [&](const linalg::ShiftedInverse& inverse) {
    part.reduced = reduction::craig_bampton(part.model.K, part.model.M, inverse, part.interface, options);
    part.truncation = reduction::truncation(*part.reduced, part.model.M, inverse, part.interface);
  };
  if (factored.sigma == 0.0) return by(fem::inverse_of(factored));
  // A free part: the interface itself restrains it, if its points hold all rigid-body motions.
  const linalg::SparseCholesky held(reduction::restrained(part.model.K, part.interface), part.model.node_of_row);
  const linalg::ShiftedInverse inverse{[&held](const Eigen::Ref<const Eigen::MatrixXd>& B) { return held.solve(B); },
                                       0.0};
  by(inverse);
}

/// Undamped receptances of the full model at a few frequencies between its resonances. A held part's factor serves all
/// of them; the K of a free part has no inverse, and its elastic flexibility takes that place.
std::vector<reduction::FullReceptance> full_receptances(const PartResult& part, const fem::Factored& factored,
                                                        const std::vector<double>& hz) {
  std::optional<reduction::StaticFlexibility> elastic;
  if (factored.sigma != 0.0) elastic.emplace(full_model(part));
  const linalg::ShiftedInverse inverse = elastic ? elastic->action() : fem::inverse_of(factored);
  dynamics::FrequencyAxis axis;
  axis.hz = Eigen::Map<const Eigen::VectorXd>(hz.data(), static_cast<Eigen::Index>(hz.size()));
  const auto full =
      reduction::full_response(part.model.K, part.model.M, inverse, part.modes.pairs, {}, 0.0, part.interface, axis);
  require_solved_for_check(full.max_relative_error);
  std::vector<reduction::FullReceptance> result;
  for (std::size_t i = 0; i < hz.size(); ++i)
    result.push_back({hz[i], full.response.H[i].real(), full.max_relative_residual, full.max_relative_error});
  return result;
}

void check_reduction(const setup::PartSetup& source, PartResult& part, const fem::Factored& factored) {
  const Eigen::Index rigid = part.modes.rigid_motions;
  const Eigen::VectorXd elastic = part.modes.frequency_hz.tail(part.modes.frequency_hz.size() - rigid);
  part.error_by_size = reduction::frequency_error_by_size(*part.reduced, elastic, static_cast<int>(rigid));
  part.frequency_error = reduction::max_relative_frequency_error(part.reduced->model, elastic, static_cast<int>(rigid));
  const double from = std::max(1.0, source.response.from_hz);
  const double to = std::min(source.response.to_hz, 0.5 * elastic.maxCoeff());
  if (source.reduction.check_frequencies == 0 || to <= from) return;
  const auto frequencies = reduction::frequencies_between(elastic, from, to, source.reduction.check_frequencies);
  part.receptance_error =
      reduction::max_relative_receptance_error(part.reduced->model, full_receptances(part, factored, frequencies));
}

}  // namespace

mesh::TetMesh stretched(mesh::TetMesh mesh, const Eigen::Vector3d& from_size, const Eigen::Vector3d& to_size) {
  const Eigen::Vector3d factor = to_size.cwiseQuotient(from_size);
  for (auto& v : mesh.vertices) v = v.cwiseProduct(factor).eval();
  return mesh;
}

namespace {

/// C of the part's file on the reduced coordinates, TᵀCT.
void take_damping_of_file(const setup::PartSetup& source, PartResult& part) {
  if (setup::kind(*source.part) != setup::ShapeKind::matrices || !source.part->imported->matrices->has_damping())
    return;
  if (std::holds_alternative<setup::MatrixDamping>(source.damping)) {
    const Eigen::MatrixXd C_T = source.part->imported->matrices->C * part.reduced->T;
    part.reduced->model.C = part.reduced->T.transpose() * C_T;
  } else {
    core::warn("the part's damping matrix is not used; set damping.model = \"matrices\" to take it");
  }
}

/// The wall thickness of the surface as it is drawn; empty for a surface that no ray leaves.
std::vector<double> thickness_of(const fem::Model& model) {
  mesh::TriangleSurface surface{{}, mesh::surface_triangles(model.nodes, mesh::boundary(model.mesh))};
  for (const auto& x : model.nodes.positions.rowwise()) surface.vertices.emplace_back(x);
  try {
    return mesh::wall_thickness(surface, mesh::TriangleTree(surface));
  } catch (const core::NumericalError& error) {
    core::inform(fmt::format("no wall thickness among the results: {}", error.what()));
    return {};
  }
}

/// Measures the quality of the mesh.
void look_at_mesh(PartResult& part) {
  part.min_quality = 1.0;
  for (int tet = 0; tet < static_cast<int>(part.model.mesh.tets.size()); ++tet) {
    part.min_quality = std::min(part.min_quality, mesh::mean_ratio(part.model.mesh, tet));
  }
  part.quality = mesh::quality(part.model.mesh);
  part.wall_thickness_m = thickness_of(part.model);
}

/// The matrix's mass against the geometry's: exact for straight elements, to the accuracy of the curve for bent ones.
void check_mass(const setup::PartSetup& source, PartResult& part) {
  const bool summed = setup::kind(*source.part) == setup::ShapeKind::mesh || !source.part->materials.empty();
  if (summed && part.model.curved_elements > 0) return;  // nothing to compare with
  const double expected = summed ? setup::mass(setup::materials_on(source, part.model.mesh), part.model.mesh)
                                 : mass(*source.part, part.model.mesh);
  part.mass_difference = std::abs(part.model.mass.mass_kg / expected - 1.0);
  double bound = part.model.curved_elements > 0 ? 1e-4 : 1e-8;
  if (setup::kind(*source.part) == setup::ShapeKind::surface && !summed) {
    const setup::MeshOptions& mesh = source.part->mesh;
    bound = mesh.element_size ? mesh::SurfaceMeshOptions{}.volume_tolerance : fem::share_of_surface * mesh.tolerance;
    if (part.estimate) bound = std::max(bound, part.estimate->frequency);  // which what the surface is off by is in
  }
  if (part.mass_difference < bound) return;
  throw core::NumericalError("the mass of the mesh differs from the geometry's by " +
                             core::number_text(part.mass_difference, 3) + " relative, more than " +
                             core::number_text(bound, 3) +
                             (part.model.curved_elements > 0 ? ": use smaller elements or a higher order" : ""));
}

std::string direction_text(const Eigen::Vector3d& n) {
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", n.x() + 0.0, n.y() + 0.0, n.z() + 0.0);
}

/// Says which of the faces that meet in a point carries its patch, where the case does not choose one.
void tell_chosen_faces(const setup::PartSetup& source, const mesh::TetMesh& mesh) {
  const auto boundary = mesh::boundary(mesh);
  for (const std::string& name : source.reduction.interface) {
    const setup::Point& point = setup::point(source, name);
    if (point.patch_radius <= 0.0 || !point.face.empty()) continue;
    const mesh::DiscFace face = mesh::disc_face(mesh, boundary, fem::disc_of(setup::named_point(source, name)));
    if (face.others.empty()) continue;
    core::warn(fmt::format(
        "point \"{}\" lies where faces meet; its patch is on the one of outward normal {}, not {}, as its directions "
        "choose; points.{}.face names another",
        name, direction_text(face.normal), direction_text(face.others.front()), name));
  }
}

}  // namespace

namespace {

/// The remedy for the coarse mesh of a file: its elements can be of a higher order where they are straight and nothing
/// is held by a set of nodes.
std::string remedy_of_given_mesh(const PartInput& source, int order) {
  const bool by_sets = std::ranges::any_of(
      source.part->supports, [&](const setup::Support& support) { return setup::names_node_set(source, support.on); });
  const bool curved = source.part->imported->mesh->solid.midside_offset > 1e-6;
  return by_sets || curved ? "take a finer one" : fmt::format("take part.mesh.order = {}, or a finer one", order + 1);
}

/// Checks the modes where the case asks for it.
void verify(const setup::PartSetup& source, Solution& solution, Stages& stages) {
  if (!source.modes.verify) return;
  stages.begin("modes check");
  fem::verify(solution.model, solution.factored, solution.modes);
  const linalg::EigenpairCheck& check = *solution.modes.check;
  core::inform(fmt::format(
      "modes confirmed: the Sturm count shows {} below {:.6g} Hz, a second eigen-solver differs by at most {:.1e}",
      check.counted, std::sqrt(check.shift) / (2.0 * std::numbers::pi), check.largest_difference));
}

Solution solve(const setup::PartSetup& source, Discretisation discretisation, Stages& stages) {
  if (discretisation.solved) return std::move(*discretisation.solved);
  stages.begin("assembly");
  fem::Model model = part_model(source, std::move(discretisation.mesh), discretisation.order);
  stages.begin("modes");
  fem::Factored factored = fem::factorise(model, core::available_memory_bytes());
  fem::Modes modes = fem::modes(model, factored, setup::mode_options(source));
  return {std::move(model), std::move(factored), std::move(modes)};
}

/// The error that the mesh of a file costs, by one order more on it. None where that takes too much memory, which is
/// told.
std::optional<fem::Estimate> error_of_given_mesh(const PartInput& source, const Solution& solved, Stages& stages) {
  const int order = solved.model.nodes.order;
  stages.begin("mesh error");
  fem::ToleranceOptions options;
  options.modes = setup::mode_options(source);
  options.points = watched_points(source);
  options.reentrant_edges = true;  // there may be one
  options.memory_limit_bytes = core::available_memory_bytes();
  try {
    const fem::Model higher = part_model(source, solved.model.mesh, order + 1);
    fem::Estimate estimate = fem::estimate_by_next_order(solved.model, solved.factored, solved.modes, higher, options);
    if (std::max(estimate.frequency, estimate.receptance) > 0.01) {
      const std::string receptances =
          options.points.empty() ? "" : fmt::format(", receptances to {:.1e}", estimate.receptance);
      core::warn(fmt::format(
          "the mesh of the file is coarse for elements of order {}: frequencies are right to about {:.1e}{}; {}", order,
          estimate.frequency, receptances, remedy_of_given_mesh(source, order)));
    }
    return estimate;
  } catch (const linalg::MemoryLimitError& error) {
    core::warn(
        fmt::format("what the mesh of the file costs is not known, for one order more would take too much "
                    "memory: {}",
                    error.what()));
    return std::nullopt;
  }
}

/// The relative change of the lowest frequency from which round-off is told.
constexpr double much_round_off = 1e-4;

/// The cause of much round-off and what helps: materials where it would be little if all were as stiff for their mass
/// as the softest, which the ratio of E/ρ tells; else a wall that is thin.
std::string cause_of_round_off(const setup::PartSetup& source, const PartResult& part) {
  if (part.model.mesh.tets.empty()) return "for the stiffnesses in its matrices differ by many orders";
  const auto materials = setup::materials_on(source, part.model.mesh).list;
  const auto specific = [](const fem::Material& m) { return m.youngs_modulus_Pa / m.density_kg_m3; };
  const auto [soft, stiff] = std::ranges::minmax_element(materials, {}, specific);
  if (part.modes.round_off > much_round_off * specific(*stiff) / specific(*soft))
    return "for the part is very thin: a lower order or larger elements lose less";
  return fmt::format(
      "for its materials are of very unlike stiffness, {} and {}: leave one of them out, or take moduli that "
      "are nearer to each other",
      core::readable_text(soft->youngs_modulus_Pa, core::kind::stress),
      core::readable_text(stiff->youngs_modulus_Pa, core::kind::stress));
}

}  // namespace

Solution solved_part(const setup::PartSetup& source, Discretisation discretisation, Stages& stages) {
  Solution solution = solve(source, std::move(discretisation), stages);
  verify(source, solution, stages);
  return solution;
}

PartResult compute_part(const PartInput& source, Discretisation discretisation, Stages& stages) {
  PartResult part;
  part.estimate = discretisation.estimate;
  Solution solved = solved_part(source, std::move(discretisation), stages);
  if (is_solved_one_order_higher(*source.part, solved.model.nodes.order))
    part.estimate = error_of_given_mesh(source, solved, stages);
  part.model = std::move(solved.model);
  part.modes = std::move(solved.modes);
  const fem::Factored factored = std::move(solved.factored);
  const bool meshed = !part.model.mesh.tets.empty();
  if (meshed) check_mass(source, part);
  if (part.modes.round_off > much_round_off) {
    core::warn(fmt::format("round-off may change the lowest frequency by {:.0e} of it, {}", part.modes.round_off,
                           cause_of_round_off(source, part)));
  }
  if (meshed) look_at_mesh(part);
  if (source.reduction.interface.empty()) return part;
  stages.begin("reduction");
  if (meshed) tell_chosen_faces(source, part.model.mesh);
  part.interface = part_interface(source, part.model);
  reduce(source, part, factored);
  if (part.reduced->status != linalg::EigenStatus::converged) {
    throw core::NumericalError("the fixed-interface modes of the reduction did not converge (" +
                               std::to_string(part.reduced->fixed_interface_hz.size()) +
                               " found): ask for fewer in reduction.modes, or mesh more evenly");
  }
  take_damping_of_file(source, part);
  part.damped = damped(source.damping, part.reduced->model, part.identified);
  if (!source.path.empty()) {
    stages.begin("path");
    part.along_path = models_along_path(source, part, fem::inverse_of(factored));
  }
  stages.begin("reduction check");
  check_reduction(source, part, factored);
  core::inform(fmt::format("reduced to {} degrees of freedom; frequencies agree to {:.1e}", part.reduced->model.size(),
                           part.frequency_error));
  return part;
}

}  // namespace thinwall::study
