#include "app/part_stage.hpp"

#include <spdlog/spdlog.h>

#include <Eigen/SVD>
#include <algorithm>
#include <limits>

#include "app/measured.hpp"
#include "core/error.hpp"
#include "fem/points.hpp"
#include "fem/supports.hpp"
#include "mesh/selection.hpp"
#include "mesh/tetgen.hpp"
#include "reduction/accuracy.hpp"
#include "reduction/damping.hpp"
#include "reduction/full_response.hpp"

namespace thinwall::app {

namespace {

fem::Material material_of(const Case& source) {
  const Material& m = source.part->material;
  return {m.youngs_modulus, m.poisson_ratio, m.density};
}

mesh::Region region_of(const Case& source, const std::string& name) {
  const auto selection = std::find_if(source.selections.begin(), source.selections.end(),
                                      [&](const Selection& s) { return s.name == name; });
  if (selection == source.selections.end()) return mesh::face_of({box_size(*source.part)}, name);
  if (selection->plane) return mesh::PlaneRegion{selection->plane->point, selection->plane->normal};
  if (selection->box) return mesh::BoxRegion{selection->box->min, selection->box->max};
  return mesh::SphereRegion{selection->sphere->centre, selection->sphere->radius};
}

/// Size near the named points, growing by `grading` (m of size per m of distance) away from them.
std::function<double(const Eigen::Vector3d&)> graded_size(const Case& source) {
  const MeshOptions& options = source.part->mesh;
  if (!options.point_element_size) return {};
  std::vector<Eigen::Vector3d> points;
  for (const Point& p : source.points) points.push_back(position(*source.part, p));
  const double growth = options.grading.value_or(1.5) - 1.0;
  return [points, growth, near = *options.point_element_size, far = options.element_size](const Eigen::Vector3d& x) {
    double nearest = std::numeric_limits<double>::max();
    for (const auto& p : points) nearest = std::min(nearest, (x - p).norm());
    return std::min(far, near + growth * nearest);
  };
}

fem::ModeOptions mode_options(const Case& source) {
  return {source.modes.range.count.value_or(10), source.modes.range.up_to_hz, source.modes.verify_count};
}

/// The part's rigid-body modes must all show at the interface: points on one line, say, do not see the turn about it.
void require_held_by_interface(const PartResult& part) {
  const Eigen::Index rigid = part.modes.rigid_motions;
  const Eigen::MatrixXd seen = part.interface.W.transpose() * part.modes.pairs.Phi.leftCols(rigid);
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(seen);
  svd.setThreshold(1e-6);
  if (svd.rank() == rigid) return;
  throw core::InputError(
      "the part can move rigidly in " + std::to_string(rigid) + " ways and its points see " +
      std::to_string(svd.rank()) +
      " of them: add a support, or a point off the line of the others; without points, modes alone are computed");
}

reduction::CraigBampton reduce(const Case& source, const PartResult& part, const fem::Factored& factored) {
  const reduction::CraigBamptonOptions options{source.reduction.fixed_interface.count.value_or(30),
                                               source.reduction.fixed_interface.up_to_hz};
  if (factored.sigma == 0.0)
    return reduction::craig_bampton(part.model.K, part.model.M, fem::inverse_of(factored), part.interface, options);
  // A free part: the interface itself restrains it, if its points hold all rigid-body motions.
  require_held_by_interface(part);
  const linalg::SparseCholesky held(reduction::restrained(part.model.K, part.interface), part.model.node_of_row);
  const linalg::ShiftedInverse inverse{[&held](const Eigen::Ref<const Eigen::MatrixXd>& B) { return held.solve(B); },
                                       0.0};
  return reduction::craig_bampton(part.model.K, part.model.M, inverse, part.interface, options);
}

void require_solved(double relative_residual) {
  if (relative_residual < 1e-6) return;
  throw core::NumericalError("the check of the reduced model did not solve the full one (residual " +
                             std::to_string(relative_residual) + ")");
}

/// Undamped receptances of the full model at a few frequencies between its resonances. A held part's factor serves all
/// of them; a free part, whose K has no inverse, is factored anew at each.
std::vector<reduction::FullReceptance> full_receptances(const PartResult& part, const fem::Factored& factored,
                                                        const std::vector<double>& hz) {
  if (factored.sigma != 0.0) {
    auto direct = reduction::full_receptances(part.model.K, part.model.M, part.model.node_of_row, part.interface, hz);
    for (const auto& line : direct) require_solved(line.relative_residual);
    return direct;
  }
  dynamics::FrequencyAxis axis;
  axis.hz = Eigen::Map<const Eigen::VectorXd>(hz.data(), static_cast<Eigen::Index>(hz.size()));
  const auto full = reduction::full_response(part.model.K, part.model.M, fem::inverse_of(factored), part.modes.pairs,
                                             {}, 0.0, part.interface, axis);
  require_solved(full.max_relative_residual);
  std::vector<reduction::FullReceptance> result;
  for (std::size_t i = 0; i < hz.size(); ++i)
    result.push_back({hz[i], full.response.H[i].real(), full.max_relative_residual});
  return result;
}

void check_reduction(const Case& source, PartResult& part, const fem::Factored& factored) {
  const Eigen::Index rigid = part.modes.rigid_motions;
  const Eigen::VectorXd elastic = part.modes.frequency_hz.tail(part.modes.frequency_hz.size() - rigid);
  part.frequency_error = reduction::max_relative_frequency_error(part.reduced->model, elastic, static_cast<int>(rigid));
  const double from = std::max(1.0, source.response.from_hz);
  const double to = std::min(source.response.to_hz, 0.5 * elastic.maxCoeff());
  if (source.reduction.check_frequencies == 0 || to <= from) return;
  const auto frequencies = reduction::frequencies_between(elastic, from, to, source.reduction.check_frequencies);
  part.receptance_error =
      reduction::max_relative_receptance_error(part.reduced->model, full_receptances(part, factored, frequencies));
}

}  // namespace

mesh::TetMesh mesh_part(const Case& source) {
  const MeshOptions& wanted = source.part->mesh;
  mesh::TetgenOptions options;
  options.element_size_m = wanted.element_size;
  options.radius_edge_ratio = wanted.quality;
  options.time_limit_s = wanted.time_limit;
  options.memory_limit_bytes = wanted.memory_limit;
  options.size_at = graded_size(source);
  return mesh::tetrahedralise(mesh::surface({box_size(*source.part)}), options);
}

mesh::TetMesh stretched(mesh::TetMesh mesh, const Eigen::Vector3d& from_size, const Eigen::Vector3d& to_size) {
  const Eigen::Vector3d factor = to_size.cwiseQuotient(from_size);
  for (auto& v : mesh.vertices) v = v.cwiseProduct(factor).eval();
  return mesh;
}

fem::Model part_model(const Case& source, mesh::TetMesh mesh) {
  std::vector<fem::Support> supports;
  for (const Support& s : source.part->supports) supports.push_back({s.on, region_of(source, s.on), s.fixed});
  return fem::supported_model(std::move(mesh), source.part->mesh.order, material_of(source), supports);
}

reduction::Interface part_interface(const Case& source, const fem::Model& model) {
  reduction::Interface interface;
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::string& name : source.reduction.interface) {
    const Point& p = point(source, name);
    const linalg::SparseMatrix columns =
        fem::point_columns(model, {p.name, position(*source.part, p), p.patch_radius, p.directions});
    for (Eigen::Index j = 0; j < columns.cols(); ++j) {
      for (linalg::SparseMatrix::InnerIterator it(columns, j); it; ++it) {
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(interface.dofs.size()), it.value());
      }
      interface.dofs.push_back({p.name, p.directions[static_cast<std::size_t>(j)], dynamics::DofKind::translation});
    }
  }
  interface.W.resize(model.K.rows(), static_cast<Eigen::Index>(interface.dofs.size()));
  interface.W.setFromTriplets(entries.begin(), entries.end());
  return interface;
}

dynamics::SpatialModel damped(const Case& source, const dynamics::SpatialModel& reduced,
                              std::vector<reduction::IdentifiedMode>& identified) {
  const Damping& damping = source.damping;
  if (damping.model == "rayleigh") return reduction::with_rayleigh_damping(reduced, damping.alpha, damping.beta);
  if (damping.model == "structural") return reduction::with_structural_damping(reduced, damping.loss_factor);
  if (!damping.from_frf) return reduction::with_modal_damping(reduced, damping.ratios, damping.ratio);
  const io::MeasuredFrf frf = read_measured(*damping.from_frf);
  identified = reduction::identify_modes(frf.axis, frf.H);
  return reduction::with_modal_damping(reduced, matched_ratios(reduced, identified, damping.ratio), damping.ratio);
}

PartResult compute_part(const Case& source, mesh::TetMesh mesh, Stages& stages) {
  PartResult part;
  stages.begin("assembly");
  part.model = part_model(source, std::move(mesh));
  part.min_quality = 1.0;
  for (int tet = 0; tet < static_cast<int>(part.model.mesh.tets.size()); ++tet) {
    part.min_quality = std::min(part.min_quality, mesh::mean_ratio(part.model.mesh, tet));
  }
  part.mass_difference = fem::relative_difference(
      part.model.mass, fem::box_mass_properties(box_size(*source.part), source.part->material.density));
  if (!(part.mass_difference < 1e-8)) {
    throw core::NumericalError("mass, centre or inertia of the mesh differ from the geometry's by " +
                               std::to_string(part.mass_difference) + " relative");
  }
  stages.begin("modes");
  const fem::Factored factored = fem::factorise(part.model);
  part.modes = fem::modes(part.model, factored, mode_options(source));
  if (part.modes.count_verified && !*part.modes.count_verified) {
    throw core::NumericalError("the Sturm count shows that the eigen-solver missed a mode: ask for a few more modes");
  }
  if (source.reduction.interface.empty()) return part;
  stages.begin("reduction");
  part.interface = part_interface(source, part.model);
  part.reduced = reduce(source, part, factored);
  if (part.reduced->status != linalg::EigenStatus::converged) {
    throw core::NumericalError("the fixed-interface modes did not converge: ask for fewer (reduction.modes)");
  }
  part.damped = damped(source, part.reduced->model, part.identified);
  stages.begin("reduction check");
  check_reduction(source, part, factored);
  spdlog::info("reduced to {} degrees of freedom; frequencies agree to {:.1e}", part.reduced->model.size(),
               part.frequency_error);
  return part;
}

}  // namespace thinwall::app
