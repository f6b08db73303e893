#include "study/kept/kept_part.hpp"

#include "core/messages.hpp"
#include "study/kept/archive_models.hpp"
#include "study/kept/input_key.hpp"

// Members of each type, for cereal, which looks in the type's own namespace.
namespace thinwall {

namespace mesh {
template <class Archive>
void serialize(Archive& archive, TetMesh& m) {
  archive(m.vertices, m.tets);
}
template <class Archive>
void serialize(Archive& archive, LagrangeNodes& n) {
  archive(n.order, n.positions, n.elements);
}
template <class Archive>
void serialize(Archive& archive, Quality& q) {
  archive(q.aspect_ratio, q.aspect_ratio_tet, q.smallest_dihedral_deg, q.smallest_dihedral_tet);
}
}  // namespace mesh

namespace linalg {
template <class Archive>
void serialize(Archive& archive, EigenpairCheck& c) {
  archive(c.status, c.shift, c.below, c.counted, c.pair, c.lambda, c.other_lambda, c.second_alone, c.largest_difference,
          c.tolerance);
}
template <class Archive>
void serialize(Archive& archive, Eigenpairs& p) {
  archive(p.lambda, p.Phi, p.inverse_residual, p.status);
}
}  // namespace linalg

namespace fem {
template <class Archive>
void serialize(Archive& archive, MassProperties& m) {
  archive(m.mass_kg, m.centre_m, m.inertia_kg_m2);
}
template <class Archive>
void serialize(Archive& archive, RigidPatch& p) {
  archive(p.name, p.nodes, p.centre_m, p.size_m);
}
template <class Archive>
void serialize(Archive& archive, Model& m) {
  archive(m.mesh, m.nodes, m.K, m.M, m.free_rows, m.node_of_row, m.rigid, m.spectrum_rad2_s2, m.rigid_motions,
          m.free_motions, m.mass, m.curved_elements, m.least_jacobian);
}
template <class Archive>
void serialize(Archive& archive, Modes& m) {
  archive(m.frequency_hz, m.pairs, m.residual, m.rigid_motions, m.round_off, m.check);
}
template <class Archive>
void serialize(Archive& archive, RefinementStep& s) {
  auto dofs = static_cast<std::int64_t>(s.dofs);
  archive(s.level, s.order, dofs, s.frequency_change, s.receptance_change, s.entry_change, s.worst_receptance);
  s.dofs = dofs;
}
template <class Archive>
void serialize(Archive& archive, Estimate& e) {
  archive(e.frequency, e.receptance, e.entry, e.worst_receptance, e.tolerance, e.met, e.held_back_by, e.within_reach,
          e.steps);
}
}  // namespace fem

namespace reduction {
template <class Archive>
void serialize(Archive& archive, Interface& i) {
  archive(i.W, i.dofs);
}
template <class Archive>
void serialize(Archive& archive, CraigBampton& c) {
  archive(c.model, c.T, c.fixed_interface_hz, c.status);
}
template <class Archive>
void serialize(Archive& archive, Truncation& t) {
  archive(t.A, t.B);
}
template <class Archive>
void serialize(Archive& archive, ErrorBySize& e) {
  archive(e.modes, e.max_relative_frequency_error);
}
}  // namespace reduction

namespace milling {
template <class Archive>
void serialize(Archive& archive, LobePoint& p) {
  archive(p.depth_m, p.chatter_frequency_hz, p.kind, p.unstable_change, p.error_estimate);
}
template <class Archive>
void serialize(Archive& archive, LobeRow& r) {
  archive(r.spindle_speed_rpm, r.limiting_depth_m, r.at_limit, r.chatter_frequency_hz, r.kind, r.error_estimate,
          r.modulus_at_limit, r.searched_m, r.crossings, r.nodes, r.status);
}
}  // namespace milling

namespace study {

template <class Archive>
void serialize(Archive& archive, PartResult& p) {
  archive(p.model, p.modes, p.min_quality, p.quality, p.estimate, p.wall_thickness_m, p.mass_difference, p.interface,
          p.reduced, p.truncation, p.frequency_error, p.error_by_size, p.estimated_receptance_error, p.receptance_error,
          p.along_path);
}
template <class Archive>
void serialize(Archive& archive, UpdatingResult::Parameter& p) {
  archive(p.key, p.unit, p.start, p.fitted, p.lower, p.upper, p.at_bound);
}
template <class Archive>
void serialize(Archive& archive, UpdatingResult::Target& t) {
  archive(t.quantity, t.wanted, t.reached, t.sensitivity);
}
template <class Archive>
void serialize(Archive& archive, DepthError& e) {
  archive(e.truncation_m, e.noise_m, e.low_m, e.high_m);
}
template <class Archive>
void serialize(Archive& archive, UpdatingResult& u) {
  archive(u.name, u.parameters, u.targets, u.evaluations, u.converged);
}

namespace {

/// Only the sizes of what later stages do not read.
void drop_entries(linalg::SparseMatrix& A) {
  A = linalg::SparseMatrix(A.rows(), A.cols());
}

/// Puts the values that were found into the set-up.
void take_fitted(const setup::Variation& variation, setup::VariedSetup& work, const std::vector<UpdatingResult>& fits) {
  if (fits.empty()) return;
  for (const UpdatingResult& fit : fits)
    for (const auto& parameter : fit.parameters) work.values[parameter.key] = parameter.fitted;
  work.setup = variation.with(work.values);
}

}  // namespace

void part_of_checkpoint(Checkpoint& kept, const setup::Variation& variation, setup::VariedSetup& work, Results& results,
                        const std::function<void(setup::VariedSetup&, Results&)>& compute) {
  if (const std::string* bytes = kept.find("part")) {
    results.finite_elements.emplace();
    from_bytes(*bytes, *results.finite_elements, results.updating);
    take_fitted(variation, work, results.updating);
    core::inform("the part of an earlier run is taken: mesh, modes and reduction have the same inputs");
    return;
  }
  compute(work, results);
  drop_entries(results.finite_elements->model.K);
  drop_entries(results.finite_elements->model.M);
  kept.add("part", to_bytes(*results.finite_elements, results.updating));
}

void fits_of_checkpoint(Checkpoint& kept, const setup::Variation& variation, setup::VariedSetup& work, Results& results,
                        const std::function<void(setup::VariedSetup&, Results&)>& compute) {
  std::vector<UpdatingResult> fits;
  if (const std::string* bytes = kept.find("fits")) {
    from_bytes(*bytes, fits);
    take_fitted(variation, work, fits);
    results.updating.insert(results.updating.end(), fits.begin(), fits.end());
    return;
  }
  const auto before = static_cast<std::ptrdiff_t>(results.updating.size());
  compute(work, results);
  fits.assign(results.updating.begin() + before, results.updating.end());
  kept.add("fits", to_bytes(fits));
}

std::vector<DepthError> errors_of_checkpoint(Checkpoint& kept, const std::string& chart,
                                             const std::vector<double>& speeds_rpm,
                                             const std::function<std::vector<DepthError>()>& compute) {
  // Operating points add speeds to a chart of the same key.
  const std::string name = chart + "-errors-" + key_of_bytes(to_bytes(speeds_rpm)).substr(0, 16);
  std::vector<DepthError> errors;
  if (const std::string* bytes = kept.find(name)) {
    from_bytes(*bytes, errors);
    return errors;
  }
  errors = compute();
  kept.add(name, to_bytes(errors));
  return errors;
}

milling::KeptRows kept_rows(Checkpoint& kept, const std::string& chart) {
  const auto piece = [chart](std::size_t first) { return chart + "-" + std::to_string(first); };
  return {[&kept, piece](std::size_t first) {
            std::vector<milling::LobeRow> rows;
            if (const std::string* bytes = kept.find(piece(first))) from_bytes(*bytes, rows);
            return rows;
          },
          [&kept, piece](std::size_t first, const std::vector<milling::LobeRow>& rows) {
            kept.add(piece(first), to_bytes(rows));
          }};
}

}  // namespace study

}  // namespace thinwall
