#include "fem/to_tolerance.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <new>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/memory.hpp"
#include "core/time_limit.hpp"
#include "core/units.hpp"
#include "fem/determined_motions.hpp"
#include "fem/error/edge_exponent.hpp"
#include "fem/error/error_of_orders.hpp"
#include "fem/error/receptance_change.hpp"
#include "fem/interpolation.hpp"
#include "fem/size/solution_bytes.hpp"

namespace thinwall::fem {

namespace {

constexpr const char* next_too_large = "the next model would be too large";

/// The inverse residual from which on modes are found sooner from those of another order than from random vectors.
constexpr double least_from_start = 1e-4;

/// One solution, with the quantities that are compared between orders. Where memory is short, the factor and then K and
/// M are given up while a larger model is solved.
struct Solution {
  Model model;
  std::optional<Factored> factored;
  Modes modes;
  Responses responses;
  bool for_estimate = false;  // the modes are less accurate than they are asked for
};

/// Frees most of a solution's memory; its factor and its matrices can be made again.
void give_up_matrices(Solution& s) {
  s.factored.reset();
  linalg::SparseMatrix().swap(s.model.K);
  linalg::SparseMatrix().swap(s.model.M);
}

/// The materials of a part on a mesh.
Materials materials_of(const SolidPart& part, const mesh::TetMesh& mesh) {
  return part.materials ? part.materials(mesh) : Materials{{part.material}, {}};
}

/// The model of a part on a mesh.
Model model_on(const SolidPart& part, const mesh::TetMesh& mesh, int order) {
  const Shaping shape = part.shaping ? part.shaping(mesh) : part.shape;
  return supported_model(mesh, order, materials_of(part, mesh), part.supports, shape, part.attachments);
}

/// The model and its factor, with the modes still to be found.
Solution prepared(const SolidPart& part, const mesh::TetMesh& mesh, int order, const ToleranceOptions& options) {
  Model model = model_on(part, mesh, order);
  Factored factored = factorise(model, options.memory_limit_bytes);
  return {std::move(model), std::move(factored), {}, {}, false};
}

/// The solution with its modes, which are found from those of another order on its mesh if these are given: few digits
/// come sooner from them.
Solution solved(Solution s, const ModeOptions& wanted, const Solution* near, const ToleranceOptions& options) {
  const bool has_start = near != nullptr && !wanted.up_to_hz && wanted.inverse_residual >= least_from_start;
  const Eigen::MatrixXd start =
      has_start ? interpolated(near->model, near->modes.pairs.Phi, s.model) : Eigen::MatrixXd();
  s.modes = modes(s.model, *s.factored, wanted, start);
  s.for_estimate = wanted.inverse_residual > options.modes.inverse_residual;
  s.responses = responses_of(s.model, *s.factored, s.modes, options.points);
  return s;
}

/// The solution of the next lower order, made from that of a higher one as accurately as an estimate needs it:
/// frequencies to a hundredth of the tolerance. Their error is the square of the inverse residual, hence the bound 0.1
/// √tolerance. It has as many modes as far as it can, for at a low order fewer lie below a frequency.
Solution solve_below(const SolidPart& part, const Solution& above, const ToleranceOptions& options) {
  Solution s = prepared(part, above.model.mesh, above.model.nodes.order - 1, options);
  ModeOptions wanted = options.modes;
  if (wanted.up_to_hz) {
    const Eigen::Index all = std::min(above.modes.frequency_hz.size(), s.model.K.rows() - 1);
    wanted.count = static_cast<int>(all) - s.model.rigid_motions;
    wanted.up_to_hz.reset();
  }
  wanted.substructures = 0;
  wanted.inverse_residual = std::max(wanted.inverse_residual, std::min(0.01, 0.1 * std::sqrt(options.tolerance)));
  return solved(std::move(s), wanted, &above, options);
}

/// The largest relative change of the elastic frequencies that both solutions have.
double frequency_change(const Modes& a, const Modes& b) {
  const Eigen::Index elastic = std::min(a.frequency_hz.size(), b.frequency_hz.size()) - b.rigid_motions;
  if (elastic <= 0) return std::numeric_limits<double>::infinity();
  const auto fa = a.frequency_hz.segment(a.rigid_motions, elastic).array();
  const auto fb = b.frequency_hz.segment(b.rigid_motions, elastic).array();
  return ((fa - fb) / fb).abs().maxCoeff();
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
  if (!(o.untold_ratio >= 0.5 && o.untold_ratio <= 0.9))
    throw core::InputError("the ratio of errors that nothing has told yet is outside 0.5 to 0.9");
}

/// True if the model of this order stays within the bound on degrees of freedom.
bool fits(const mesh::TetMesh& mesh, int order, const ToleranceOptions& options) {
  return options.largest_dofs == 0 || 3 * mesh::lagrange_node_count(mesh, order) <= options.largest_dofs;
}

/// The exponent of the edges of a part's clamps for frequencies; 1 if it has none. Of several materials the largest
/// Poisson's ratio counts.
double exponent_of_clamps(const SolidPart& part, const Materials& materials) {
  if (part.supports.empty() && part.attachments.clamps.empty()) return 1.0;
  double poisson_ratio = -1.0;
  for (const Material& material : materials.list) poisson_ratio = std::max(poisson_ratio, material.poisson_ratio);
  return clamped_edge_exponent(poisson_ratio);
}

Exponents exponents(const SolidPart& part, const Materials& materials, const ToleranceOptions& options) {
  const double clamps = exponent_of_clamps(part, materials);
  if (!options.reentrant_edges) return {{clamps, clamps}, {}};
  return {{reentrant_edge_exponent, clamps}, {reentrant_edge_exponent, 1.0}};
}

/// A solution on the way, with its estimated errors.
struct Found {
  Solution solution;
  Errors errors;
  int level = 0;
};

/// The refinement of a part, as far as it has come.
struct Refinement {
  const SolidPart& part;
  const ToleranceOptions& options;
  Exponents exponent;
  mesh::TetMesh mesh;  // of the last solution
  Estimate estimate;
  std::optional<Found> now;       // the last solution
  std::optional<Found> better{};  // the best one of the levels before
  int usual_order = 0;            // the higher one of the first two orders that were asked for
};

/// The best solution with its estimated errors.
Refined finished(Refinement&& r) {
  Found& best = r.better && r.better->errors.worst() < r.now->errors.worst() ? *r.better : *r.now;
  Estimate& estimate = r.estimate;
  estimate.frequency = best.errors.frequency;
  estimate.receptance = best.errors.receptance;
  estimate.entry = best.errors.entry;
  estimate.worst_receptance = best.errors.worst_receptance;
  estimate.met = best.errors.worst() <= estimate.tolerance;
  if (estimate.met) estimate.held_back_by.clear();
  Solution& s = best.solution;
  if (!s.factored) {
    // The factor was given up for another solution. It fits as it did before once that one is gone.
    if (r.better) (&best == &*r.better ? r.now : r.better).reset();
    if (s.model.K.size() == 0) s.model = model_on(r.part, s.model.mesh, s.model.nodes.order);
    s.factored = factorise(s.model, r.options.memory_limit_bytes);
  }
  if (s.for_estimate) s.modes = modes(s.model, *s.factored, r.options.modes);
  return {std::move(s.model), std::move(*s.factored), std::move(s.modes), std::move(estimate), best.level};
}

/// Adds what the shape of a model's elements errs by.
void add_shape(const SolidPart& part, const Model& model, Errors& errors) {
  if (!part.shape_error) return;
  errors.shape = part.shape_error(model);
  errors.frequency += errors.shape;
}

/// Adds what the modes of both compared solutions may err by where they come from substructures.
void add_substructures(const ModeOptions& options, Errors& errors) {
  if (options.substructures > 0) errors.frequency += substructures_error;
}

void add_step(Refinement& r, RefinementStep step) {
  if (r.options.solved) r.options.solved(step);
  r.estimate.steps.push_back(std::move(step));
}

/// Adds the comparison of two successive orders on one mesh; returns the errors of both.
std::pair<Errors, Errors> compared(Refinement& r, int level, const Solution& below, const Solution& above) {
  RefinementStep step{
      level, above.model.nodes.order, above.model.K.rows(), frequency_change(below.modes, above.modes), {}};
  compare_receptances(below.responses, above.responses, above.modes, r.options.points, step);
  add_step(r, std::move(step));
  Untold untold{r.options.untold_ratio, r.usual_order};
  if (r.part.has_rows && r.part.has_rows(above.model.mesh)) untold = {Untold{}.ratio, r.usual_order, true};
  auto errors = errors_of_last_two(r.estimate.steps, r.exponent, untold);
  for (auto [model, of_it] : {std::pair{&below.model, &errors.first}, std::pair{&above.model, &errors.second}}) {
    add_shape(r.part, *model, *of_it);
    add_substructures(r.options.modes, *of_it);
  }
  return errors;
}

/// Solves the first two orders on a mesh, the higher one first: the modes of the lower one, which only the estimate
/// needs as a rule, follow from it.
void begin_level(Refinement& r, int level, mesh::TetMesh mesh) {
  const ToleranceOptions& options = r.options;
  Solution above = solved(prepared(r.part, mesh, options.first_order + 1, options), options.modes, nullptr, options);
  if (level == 0 && options.points_hold && above.factored->sigma != 0.0)
    require_motions_determined(above.model, above.modes, above.responses.amplitudes);
  Solution below = solve_below(r.part, above, options);
  add_step(r, {level, options.first_order, below.model.K.rows(), {}, {}});
  const auto [of_below, of_above] = compared(r, level, below, above);
  if (r.now && !(r.better && r.better->errors.worst() < r.now->errors.worst())) r.better = std::move(r.now);
  r.mesh = std::move(mesh);
  r.now = Found{std::move(above), of_above, level};
  if (of_below.worst() > options.tolerance) return;
  r.now = Found{std::move(below), of_below, level};
}

/// Gives up the factor of the last solution if those of some orders on a mesh, which are held at once, do not fit
/// beside it, and its matrices if they are in the way, too. Throws NumericalError if they do not fit without them.
void make_room(Refinement& r, const mesh::TetMesh& mesh, int lowest_order, int order) {
  constexpr double margin = 1.05;  // the forecast is right to 3 %, and freed memory does not fit every new block
  Solution& last = r.now->solution;
  const double factor = last.factored ? last.factored->factor.statistics().bytes_held : 0.0;
  const double matrices = bytes_of(last.model.K) + bytes_of(last.model.M);
  double needed = 0.0;
  for (int held = lowest_order; held <= order; ++held) needed += margin * solution_bytes(mesh, held);
  const double left = core::memory_left_bytes();
  if (left > 0.0 && needed > left && needed <= left + factor + matrices) {
    last.factored.reset();
    if (needed > core::memory_left_bytes()) give_up_matrices(last);
  }
  core::require_memory(needed, "a solution of " + std::to_string(3 * mesh::lagrange_node_count(mesh, order)) +
                                   " degrees of freedom at order " + std::to_string(order));
}

/// Solves the next order on the mesh. The order before stays the result if it meets the tolerance.
void raise_order(Refinement& r) {
  const int order = r.now->solution.model.nodes.order + 1;
  make_room(r, r.mesh, order, order);
  Solution above = solved(prepared(r.part, r.mesh, order, r.options), r.options.modes, &r.now->solution, r.options);
  const auto [of_below, of_above] = compared(r, r.now->level, r.now->solution, above);
  if (of_below.worst() <= r.options.tolerance) {
    r.now->errors = of_below;
  } else {
    r.now = Found{std::move(above), of_above, r.now->level};
  }
}

/// True if the shape of the elements alone misses the tolerance, which higher orders do not mend.
bool shape_misses(const Refinement& r) {
  return r.now->solution.model.nodes.order >= r.usual_order && r.now->errors.shape >= r.options.tolerance;
}

/// True if raising the order on this mesh may meet the tolerance, or if it is below the usual one. Away from re-entrant
/// edges one order reduces the error by a factor of ten, at most thirty. Beside them the orders left reduce it at best
/// by q² each, with q the ratio of the last two changes on this mesh; by a factor of five each before that ratio is
/// known (thirteen by two orders was seen).
bool orders_may_do(const Refinement& r) {
  if (r.now->solution.model.nodes.order < r.usual_order) return true;
  if (shape_misses(r)) return false;
  const double error = r.now->errors.worst();
  if (!r.options.reentrant_edges) return error <= 30.0 * r.options.tolerance;
  const auto change = [](const RefinementStep& s) {
    return std::max(s.frequency_change.value_or(0.0), s.receptance_change.value_or(0.0));
  };
  const auto& steps = r.estimate.steps;
  const RefinementStep* lower = usual_step_before(steps, r.usual_order);
  const double last = change(steps.back()), before = lower != nullptr ? change(*lower) : 0.0;
  const double of_one = before > 0.0 ? std::pow(std::min(1.0, last / before), 2) : 0.2;
  return error * std::pow(of_one, r.options.last_order - steps.back().order) <= r.options.tolerance;
}

/// Does a step of the refinement. False if it fails for memory or because a mesh cannot be made or solved, which ends
/// up in held_back_by; the solutions before it are kept.
bool succeeds(Refinement& r, const std::function<void()>& step) {
  std::string cause = "out of memory";
  try {
    step();
    return true;
  } catch (const std::bad_alloc&) {
  } catch (const core::NumericalError& error) {
    cause = error.what();
  }
  r.estimate.held_back_by = "the next solution could not be had: " + cause;
  return false;
}

/// Takes the next level. False if it cannot be had.
bool takes_finer_level(Refinement& r) {
  const int level = r.now->level + 1, order = r.options.first_order + 1;
  bool fitting = true;
  const auto step = [&] {
    mesh::TetMesh finer = r.part.mesh(level);
    fitting = fits(finer, order, r.options);
    if (!fitting) return;
    make_room(r, finer, order - 1, order);
    begin_level(r, level, std::move(finer));
  };
  if (!succeeds(r, step)) return false;
  if (!fitting) r.estimate.held_back_by = next_too_large;
  return fitting;
}

/// True if no order brings the error of this mesh near the tolerance, because most of it is that of its shape; which
/// ends up in held_back_by, unless a finer mesh was tried and its failure stands there.
bool shape_ends(Refinement& r) {
  const double shape = r.now->errors.shape;
  if (!shape_misses(r) || r.now->errors.worst() > 2.0 * shape) return false;
  if (r.estimate.held_back_by.empty())
    r.estimate.held_back_by =
        "the elements follow the surface's volume to " + core::number_text(100.0 * shape, 2) + " % only";
  return true;
}

/// Refines until the tolerance is met, or nothing is left that could be solved.
void refine(Refinement& r) {
  const ToleranceOptions& options = r.options;
  bool more_levels = true;
  while (r.now->errors.worst() > options.tolerance) {
    core::check_interrupt();
    if (r.better && r.now->errors.worst() <= r.better->errors.worst()) give_up_matrices(r.better->solution);
    const int levels_left = options.levels - 1 - r.now->level, order = r.now->solution.model.nodes.order;
    if (more_levels && levels_left > 0 && (order == options.last_order || !orders_may_do(r))) {
      const double reach = error_after(levels_left, r.now->errors, r.estimate.steps);
      if (reach > 2.0 * options.tolerance) {
        r.estimate.within_reach = reach;
        return;
      }
      more_levels = takes_finer_level(r);
      continue;
    }
    if (shape_ends(r) || order == options.last_order) return;
    if (!fits(r.mesh, order + 1, options)) {
      r.estimate.held_back_by = next_too_large;
      return;
    }
    if (!succeeds(r, [&r] { raise_order(r); })) return;
  }
}

/// Refines within the time that is left of the budget.
void refine_in_time(Refinement& r, double seconds_gone) {
  const double budget = r.options.time_budget_s;
  try {
    std::optional<core::TimeLimit> limit;
    if (budget > 0.0) limit.emplace(budget - seconds_gone);
    refine(r);
  } catch (const core::TimeIsOver&) {
    r.estimate.held_back_by = "the " + core::number_text(budget, 3) + " s for its solutions were over";
  }
}

}  // namespace

int first_order_on(const mesh::TetMesh& mesh, const ToleranceOptions& options) {
  // Low orders may have no mode at all below the frequency up to which modes are wanted, for thin walls are too stiff.
  const std::int64_t most = options.modes.up_to_hz ? options.largest_dofs : options.first_dofs;
  const auto is_small = [&](int order) {
    return (most == 0 || 3 * mesh::lagrange_node_count(mesh, order) <= most) && fits(mesh, order, options);
  };
  int first = options.first_order;
  while (options.first_dofs > 0 && first > 1 && !is_small(first + 1)) --first;
  return first;
}

void require_fit(const mesh::TetMesh& mesh, const ToleranceOptions& options) {
  const int order = first_order_on(mesh, options) + 1;
  if (fits(mesh, order, options)) return;
  throw core::InputError("the coarsest mesh has " + std::to_string(3 * mesh::lagrange_node_count(mesh, order)) +
                         " degrees of freedom at order " + std::to_string(order) + ", more than the bound of " +
                         std::to_string(options.largest_dofs) + "; check part.unit, give part.mesh.element_size, " +
                         (order > 2 ? "lower part.mesh.order, " : "") + "or simplify the part");
}

double enough_for_frequencies(double tolerance) {
  return 0.01 * std::sqrt(tolerance);
}

Refined refine_to_tolerance(const SolidPart& part, const ToleranceOptions& asked) {
  using Clock = std::chrono::steady_clock;
  validate(asked);
  const auto start = Clock::now();
  mesh::TetMesh mesh = part.mesh(0);
  ToleranceOptions options = asked;
  options.first_order = first_order_on(mesh, asked);
  require_fit(mesh, options);
  Refinement r{part, options, exponents(part, materials_of(part, mesh), options), {}, {}, {}};
  r.estimate.tolerance = options.tolerance;
  r.usual_order = asked.first_order + 1;
  begin_level(r, 0, std::move(mesh));
  refine_in_time(r, std::chrono::duration<double>(Clock::now() - start).count());
  return finished(std::move(r));
}

Estimate estimate_by_next_order(const Model& model, const Factored& factored, const Modes& modes, const Model& higher,
                                const ToleranceOptions& options) {
  const Factored next_factored = factorise(higher, options.memory_limit_bytes);
  const Modes next = fem::modes(higher, next_factored, options.modes);
  RefinementStep step{0, higher.nodes.order, higher.K.rows(), frequency_change(modes, next), {}};
  compare_receptances(responses_of(model, factored, modes, options.points),
                      responses_of(higher, next_factored, next, options.points), next, options.points, step);
  const double least = options.reentrant_edges ? reentrant_edge_exponent : 1.0;
  Estimate estimate;
  estimate.steps = {{0, model.nodes.order, model.K.rows(), {}, {}}, step};
  Errors errors = errors_of_last_two(estimate.steps, {{least, 1.0}, {least, 1.0}}, {}).first;
  add_substructures(options.modes, errors);
  estimate.frequency = errors.frequency;
  estimate.receptance = errors.receptance;
  estimate.entry = errors.entry;
  estimate.worst_receptance = step.worst_receptance;
  estimate.met = true;  // nothing was asked for
  return estimate;
}

}  // namespace thinwall::fem
