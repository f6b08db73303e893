#include "fem/to_tolerance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "dynamics/dof.hpp"
#include "fem/determined_motions.hpp"
#include "fem/edge_exponent.hpp"
#include "fem/interpolation.hpp"

namespace thinwall::fem {

namespace {

/// The data of the receptances between the points; empty without points.
struct Responses {
  Eigen::ArrayXd lambda;        // rad²/s²
  double sigma = 0.0;           // of the factor
  Eigen::MatrixXd amplitudes;   // Wᵀ Φ
  Eigen::MatrixXd flexibility;  // Wᵀ (K − σM)⁻¹ W
};

/// One solution, with the quantities that are compared between orders.
struct Solution {
  Model model;
  Factored factored;
  Modes modes;
  Responses responses;
};

/// The columns of the points. Turns are scaled to the norm of a displacement's column, so that receptances in rad and
/// in m can be compared.
linalg::SparseMatrix point_loads(const Model& model, const std::vector<NamedPoint>& points) {
  std::vector<Eigen::Triplet<double>> entries;
  int columns = 0;
  for (const NamedPoint& point : points) {
    const linalg::SparseMatrix w = point_columns(model, point);
    for (Eigen::Index j = 0; j < w.cols(); ++j, ++columns) {
      const bool turn = j >= static_cast<Eigen::Index>(point.directions.size());
      const double scale = turn && !point.directions.empty() ? w.col(0).norm() / w.col(j).norm() : 1.0;
      for (linalg::SparseMatrix::InnerIterator it(w, j); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), columns, scale * it.value());
    }
  }
  linalg::SparseMatrix W(model.K.rows(), columns);
  W.setFromTriplets(entries.begin(), entries.end());
  return W;
}

/// The materials of a part on a mesh.
Materials materials_of(const SolidPart& part, const mesh::TetMesh& mesh) {
  return part.materials ? part.materials(mesh) : Materials{{part.material}, {}};
}

/// The model and its factor, with the modes still to be found.
Solution prepared(const SolidPart& part, const mesh::TetMesh& mesh, int order, const ToleranceOptions& options) {
  Model model = supported_model(mesh, order, materials_of(part, mesh), part.supports, part.shape, part.attachments);
  Factored factored = factorise(model, options.memory_limit_bytes);
  return {std::move(model), std::move(factored), {}, {}};
}

/// The amplitudes and the flexibility of the points, if there are any.
Responses responses_of(const Model& model, const Factored& factored, const Modes& modes,
                       const ToleranceOptions& options) {
  if (options.points.empty()) return {};
  const linalg::SparseMatrix W = point_loads(model, options.points);
  return {modes.pairs.lambda.array(), factored.sigma, W.transpose() * modes.pairs.Phi,
          W.transpose() * factored.factor.solve(Eigen::MatrixXd(W))};
}

/// The solution of the given order on a mesh, with its modes.
Solution solve(const SolidPart& part, const mesh::TetMesh& mesh, int order, const ToleranceOptions& options) {
  Solution s = prepared(part, mesh, order, options);
  s.modes = modes(s.model, s.factored, options.modes);
  s.responses = responses_of(s.model, s.factored, s.modes, options);
  return s;
}

/// The solution of the next lower order, made from that of a higher one as accurately as an estimate needs it:
/// frequencies to a hundredth of the tolerance. Their error is the square of the inverse residual, hence the bound 0.1
/// √tolerance.
Solution solve_below(const SolidPart& part, const Solution& above, const ToleranceOptions& options) {
  Solution s = prepared(part, above.model.mesh, above.model.nodes.order - 1, options);
  linalg::Eigenpairs start = above.modes.pairs;
  start.Phi = interpolated(above.model, start.Phi, s.model);
  auto near = modes_near(s.model, s.factored, std::move(start), 0.1 * std::sqrt(options.tolerance));
  s.modes = near ? std::move(*near) : modes(s.model, s.factored, options.modes);
  s.responses = responses_of(s.model, s.factored, s.modes, options);
  return s;
}

/// The largest relative change of the elastic frequencies that both solutions have.
double frequency_change(const Modes& a, const Modes& b) {
  const Eigen::Index elastic = std::min(a.frequency_hz.size(), b.frequency_hz.size()) - b.rigid_motions;
  if (elastic <= 0) return std::numeric_limits<double>::infinity();
  const auto fa = a.frequency_hz.segment(a.rigid_motions, elastic).array();
  const auto fb = b.frequency_hz.segment(b.rigid_motions, elastic).array();
  return ((fa - fb) / fb).abs().maxCoeff();
}

/// The receptance between the points over the known modes k and all others, whose contribution is taken at the shift,
/// where the factor gives it exactly: H(ω²) = Wᵀ(K − σM)⁻¹W + Σ_k a_k a_kᵀ (1/(λ_k − ω²) − 1/(λ_k − σ)).
Eigen::MatrixXd receptance(const Responses& s, double omega_squared) {
  const Eigen::VectorXd share = (s.lambda - omega_squared).inverse() - (s.lambda - s.sigma).inverse();
  return s.flexibility + s.amplitudes * share.asDiagonal() * s.amplitudes.transpose();
}

/// The scale for the error of every entry of a receptance. The diagonal of B = Σ |a| |a|ᵀ / |λ − ω²|, plus the
/// magnitude of the other modes' contribution, is the receptance that the modes' contributions would add up to if none
/// cancelled. At an antiresonance they do cancel, and an error relative to the remainder would say nothing about the
/// model. The entry (i, j) has the scale √(B_ii B_jj), which bounds it (Cauchy-Schwarz) and leaves one that vanishes by
/// symmetry a scale.
Eigen::MatrixXd magnitudes(const Responses& s, double omega_squared) {
  const Eigen::VectorXd share = (s.lambda - omega_squared).inverse().abs();
  const Eigen::VectorXd at_shift = (s.lambda - s.sigma).inverse();
  const Eigen::MatrixXd squares = s.amplitudes.cwiseAbs2();
  const Eigen::VectorXd rest = (s.flexibility.diagonal() - squares * at_shift).cwiseAbs();
  const Eigen::VectorXd root = (rest + squares * share).cwiseSqrt();
  return root * root.transpose();
}

/// Values of ω² at which receptances are compared: the shift, then up to five places midway between frequencies at
/// least 25 % apart, away from resonances.
std::vector<double> compared_omega_squared(const Modes& modes, double sigma) {
  std::vector<double> places{sigma};
  for (Eigen::Index k = std::max(modes.rigid_motions, 0); k + 1 < modes.frequency_hz.size(); ++k) {
    if (modes.frequency_hz(k) <= 0.0 || modes.frequency_hz(k + 1) < 1.25 * modes.frequency_hz(k)) continue;
    const double middle = std::numbers::pi * (modes.frequency_hz(k) + modes.frequency_hz(k + 1));
    places.push_back(middle * middle);
    if (places.size() == 6) break;
  }
  return places;
}

/// The largest change of a receptance between the points: relative to the largest magnitude, and relative to the
/// entry's own, with the entry.
struct ReceptanceChange {
  double of_largest = 0.0, of_own = 0.0;
  Eigen::Index row = 0, column = 0;
};

/// The change between two solutions, relative to the magnitudes() of the second one, whose modes are given.
ReceptanceChange receptance_change(const Responses& a, const Responses& b, const Modes& modes) {
  ReceptanceChange worst;
  for (const double place : compared_omega_squared(modes, b.sigma)) {
    // Both at the same place: the shifts of a free part, which scale with the matrices, differ by half between orders,
    // and its rigid motions have a receptance there that is inverse to it.
    const Eigen::MatrixXd change = (receptance(a, place) - receptance(b, place)).cwiseAbs();
    const Eigen::MatrixXd magnitude = magnitudes(b, place);
    worst.of_largest = std::max(worst.of_largest, change.maxCoeff() / magnitude.maxCoeff());
    Eigen::Index row = 0, column = 0;
    const double of_own = change.cwiseQuotient(magnitude).maxCoeff(&row, &column);
    if (of_own > worst.of_own) worst = {worst.of_largest, of_own, row, column};
  }
  return worst;
}

/// The name of a receptance between two columns of point_loads(): "P.x", or "P.x to Q.z".
std::string receptance_name(const std::vector<NamedPoint>& points, Eigen::Index row, Eigen::Index column) {
  std::vector<std::string> names;
  for (const NamedPoint& point : points) {
    for (const auto& d : point.directions) names.push_back(dynamics::name({point.name, d}));
    for (const auto& d : point.turns) names.push_back(dynamics::name({point.name, d, dynamics::DofKind::rotation}));
  }
  const std::string& to = names[static_cast<std::size_t>(row)];
  return row == column ? to : names[static_cast<std::size_t>(column)] + " to " + to;
}

/// Adds what changes of the receptances between the points from one solution to the next, whose modes are given.
void compare_receptances(const Responses& below, const Responses& now, const Modes& modes,
                         const std::vector<NamedPoint>& points, RefinementStep& step) {
  if (points.empty()) return;
  const ReceptanceChange change = receptance_change(below, now, modes);
  step.receptance_change = change.of_largest;
  step.entry_change = change.of_own;
  step.worst_receptance = receptance_name(points, change.row, change.column);
}

void validate(const ToleranceOptions& o) {
  if (!(o.tolerance >= 1e-6 && o.tolerance <= 0.1)) {
    throw core::InputError("a tolerance of " + std::to_string(o.tolerance) +
                           " is outside 1e-6 to 0.1: 0.001 is one part in a thousand of a frequency");
  }
  if (o.first_order < 1 || o.last_order <= o.first_order || o.last_order > 6 || o.levels < 1)
    throw core::InputError("orders must rise within 1 to 6, on at least one level");
}

/// True if the model of this order stays within the bound on degrees of freedom.
bool fits(const mesh::TetMesh& mesh, int order, const ToleranceOptions& options) {
  return options.largest_dofs == 0 || 3 * mesh::lagrange_node_count(mesh, order) <= options.largest_dofs;
}

/// The least singular exponents of the part's edges, by which the errors of frequencies and of receptances fall; 1
/// where all is regular.
struct Exponents {
  double frequency = 1.0, receptance = 1.0;
};

/// The exponents of a part: of its re-entrant edges, or else, for frequencies, of the edges of its clamps. Of several
/// materials the largest Poisson's ratio counts.
Exponents exponents(const SolidPart& part, const Materials& materials, const ToleranceOptions& options) {
  if (options.reentrant_edges) return {reentrant_edge_exponent, reentrant_edge_exponent};
  if (part.supports.empty() && part.attachments.clamps.empty()) return {};
  double poisson_ratio = -1.0;
  for (const Material& material : materials.list) poisson_ratio = std::max(poisson_ratio, material.poisson_ratio);
  return {clamped_edge_exponent(poisson_ratio), 1.0};
}

/// The ratio r of the error at `order` to the error at the order below it (docs/theory/elements.md). Beside an edge of
/// exponent λ the error is that of the squares of the coefficients above the order p, Σ_{k>p} k^(−4λ−1), which is (p +
/// ½)^−4λ up to a factor. The law holds for high orders only; its values below 1/2 are not trusted.
double error_ratio(int order, double exponent) {
  return std::max(0.5, std::pow((order - 0.5) / (order + 0.5), 4.0 * exponent));
}

/// The estimated errors of a solution. That of an entry by its own magnitude is told, and held to no tolerance: a stiff
/// direction may be thousands of times stiffer than the one that chatters, and its error falls slowly, for it comes
/// from the edge of the loaded disc, which no edge of an element follows.
struct Errors {
  double frequency = 0.0, receptance = 0.0, entry = 0.0;
  [[nodiscard]] double worst() const { return std::max(frequency, receptance); }
};

/// The errors of the lower one of the last two orders, d / (1 − r) with d the last changes.
Errors errors_of_lower(const RefinementStep& last, const Exponents& exponent) {
  const double receptance = 1.0 / (1.0 - error_ratio(last.order, exponent.receptance));
  return {last.frequency_change.value_or(0.0) / (1.0 - error_ratio(last.order, exponent.frequency)),
          last.receptance_change.value_or(0.0) * receptance, last.entry_change.value_or(0.0) * receptance};
}

/// The errors of the higher one, r d / (1 − r).
Errors errors_of_higher(const RefinementStep& last, const Exponents& exponent) {
  const Errors lower = errors_of_lower(last, exponent);
  const double receptance = error_ratio(last.order, exponent.receptance);
  return {error_ratio(last.order, exponent.frequency) * lower.frequency, receptance * lower.receptance,
          receptance * lower.entry};
}

/// The factor by which the levels left reduce an error at best, q²ⁿ with q ≤ 1 the ratio of the last change to that of
/// the same order on the level before; 0, for all is open, if that order was not solved there.
double factor_of_levels(const std::vector<RefinementStep>& steps, std::optional<double> RefinementStep::*change,
                        int left) {
  const RefinementStep& last = steps.back();
  const auto before = std::ranges::find_if(
      steps, [&](const RefinementStep& s) { return s.level == last.level - 1 && s.order == last.order && s.*change; });
  if (before == steps.end() || !(last.*change)) return 0.0;
  return std::pow(std::min(1.0, *(last.*change) / *((*before).*change)), 2 * left);
}

/// The larger of the errors to which the levels left reduce these.
double error_after(int left, const Errors& errors, const std::vector<RefinementStep>& steps) {
  return std::max(errors.frequency * factor_of_levels(steps, &RefinementStep::frequency_change, left),
                  errors.receptance * factor_of_levels(steps, &RefinementStep::receptance_change, left));
}

/// The solution with its estimated errors.
Refined finished(Solution&& s, Estimate&& estimate, const Errors& errors) {
  estimate.frequency = errors.frequency;
  estimate.receptance = errors.receptance;
  estimate.entry = errors.entry;
  estimate.worst_receptance = estimate.steps.back().worst_receptance;
  estimate.met = errors.worst() <= estimate.tolerance;
  return {std::move(s.model), std::move(s.factored), std::move(s.modes), std::move(estimate)};
}

}  // namespace

void require_fit(const mesh::TetMesh& mesh, const ToleranceOptions& options) {
  const int order = options.first_order + 1;
  if (fits(mesh, order, options)) return;
  throw core::InputError("the coarsest mesh has " + std::to_string(3 * mesh::lagrange_node_count(mesh, order)) +
                         " degrees of freedom at order " + std::to_string(order) + ", more than the bound of " +
                         std::to_string(options.largest_dofs) +
                         "; allow more, lower the first order, or simplify the part");
}

Refined refine_to_tolerance(const SolidPart& part, const ToleranceOptions& options) {
  validate(options);
  Estimate estimate;
  estimate.tolerance = options.tolerance;
  mesh::TetMesh mesh = part.mesh(0);
  require_fit(mesh, options);
  const Exponents exponent = exponents(part, materials_of(part, mesh), options);
  for (int level = 0;; ++level) {
    bool last_level = level + 1 == options.levels;
    // The higher of the first two orders is solved first: the modes of the lower one, which only the estimate needs,
    // follow from it by inverse iteration.
    Solution now = solve(part, mesh, options.first_order + 1, options);
    if (level == 0 && options.points_hold && now.factored.sigma != 0.0)
      require_motions_determined(now.model, now.modes, now.responses.amplitudes);
    Solution below = solve_below(part, now, options);
    estimate.steps.push_back({level, options.first_order, below.model.K.rows(), {}, {}});
    for (int order = options.first_order + 1;; ++order) {
      RefinementStep step{level, order, now.model.K.rows(), frequency_change(below.modes, now.modes), {}};
      compare_receptances(below.responses, now.responses, now.modes, options.points, step);
      estimate.steps.push_back(step);
      const Errors of_lower = errors_of_lower(step, exponent);
      const Errors of_higher = errors_of_higher(step, exponent);
      if (of_lower.worst() <= options.tolerance) {
        // These modes are only as accurate as the estimate needs; as a result they are computed in full.
        if (order == options.first_order + 1) below.modes = modes(below.model, below.factored, options.modes);
        return finished(std::move(below), std::move(estimate), of_lower);
      }
      if (of_higher.worst() <= options.tolerance || (last_level && order == options.last_order))
        return finished(std::move(now), std::move(estimate), of_higher);
      // The next level is taken if another order cannot reach the tolerance. Away from re-entrant edges one order
      // reduces the error by a factor of ten, at most thirty; beside them by the factor of error_ratio().
      const double next = options.reentrant_edges ? error_ratio(order + 1, reentrant_edge_exponent) : 1.0 / 30.0;
      if (!last_level && (order == options.last_order || next * of_higher.worst() > options.tolerance)) {
        const double reach = error_after(options.levels - 1 - level, of_higher, estimate.steps);
        if (reach > 2.0 * options.tolerance) {
          estimate.within_reach = reach;
          return finished(std::move(now), std::move(estimate), of_higher);
        }
        mesh::TetMesh finer = part.mesh(level + 1);
        if (fits(finer, options.first_order + 1, options)) {
          mesh = std::move(finer);
          break;
        }
        last_level = true;
        estimate.held_back = true;
      }
      estimate.held_back = estimate.held_back || !fits(mesh, order + 1, options);
      if (order == options.last_order || !fits(mesh, order + 1, options))
        return finished(std::move(now), std::move(estimate), of_higher);
      below = std::move(now);
      now = solve(part, mesh, order + 1, options);
    }
  }
}

Estimate estimate_by_next_order(const Model& model, const Factored& factored, const Modes& modes, const Model& higher,
                                const ToleranceOptions& options) {
  const Factored next_factored = factorise(higher, options.memory_limit_bytes);
  const Modes next = fem::modes(higher, next_factored, options.modes);
  RefinementStep step{0, higher.nodes.order, higher.K.rows(), frequency_change(modes, next), {}};
  compare_receptances(responses_of(model, factored, modes, options), responses_of(higher, next_factored, next, options),
                      next, options.points, step);
  const double exponent = options.reentrant_edges ? reentrant_edge_exponent : 1.0;
  const Errors errors = errors_of_lower(step, {exponent, exponent});
  Estimate estimate;
  estimate.frequency = errors.frequency;
  estimate.receptance = errors.receptance;
  estimate.entry = errors.entry;
  estimate.worst_receptance = step.worst_receptance;
  estimate.met = true;  // nothing was asked for
  estimate.steps = {{0, model.nodes.order, model.K.rows(), {}, {}}, step};
  return estimate;
}

}  // namespace thinwall::fem
