#include "reduction/methods/reduce.hpp"

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "reduction/methods/characteristic_constraint_modes.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "reduction/methods/craig_chang.hpp"
#include "reduction/methods/dual_craig_bampton.hpp"
#include "reduction/methods/free_interface.hpp"
#include "reduction/methods/guyan.hpp"
#include "reduction/methods/held_interface.hpp"
#include "reduction/methods/macneal.hpp"
#include "reduction/methods/modal_truncation.hpp"
#include "reduction/methods/rubin.hpp"

namespace thinwall::reduction {

namespace {

void reduce_held(const FullModel& full, const Interface& interface, const ReductionOptions& options,
                 Reduction& result) {
  const linalg::SparseCholesky factor = held_by_interface(full, interface);
  const linalg::ShiftedInverse inverse = {
      [&factor](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd { return factor.solve(B); }, 0.0};
  CraigBampton reduced = result.method == Method::guyan ? guyan(full.K, full.M, inverse, interface)
                                                        : craig_bampton(full.K, full.M, inverse, interface,
                                                                        {.modes = options.modes, .up_to_hz = {}});
  result.status = reduced.status;
  result.modes = static_cast<int>(reduced.fixed_interface_hz.size());
  if (result.method == Method::characteristic_constraint_modes) {
    result.model = characteristic_constraint_modes(reduced, options.characteristic).model;
  } else {
    result.model = std::move(reduced.model);
  }
}

ReducedModel free_interface_model(Method method, const FreeInterface& part, double damping_ratio) {
  if (method == Method::macneal) return macneal(part);
  if (method == Method::craig_chang) return craig_chang(part);
  if (method == Method::dual_craig_bampton) return dual_craig_bampton(part);
  if (method == Method::modal_truncation) return modal_truncation(part, damping_ratio);
  return rubin(part);
}

void reduce_free(const FullModel& full, const Interface& interface, const ReductionOptions& options,
                 Reduction& result) {
  const StaticFlexibility flexibility(full);
  const PartModes modes = free_modes(full, flexibility, options.modes);
  const FreeInterface part = free_interface(modes, full.M, flexibility.action(), interface);
  result.status = modes.status;
  result.modes = static_cast<int>(modes.lambda.size() - flexibility.rigid_modes().cols());
  result.model = free_interface_model(result.method, part, options.damping_ratio);
}

}  // namespace

int size(const Reduction& reduction) {
  if (const auto* modal = std::get_if<dynamics::ModalModel>(&reduction.model))
    return static_cast<int>(modal->poles.size() / 2);
  const auto& model = std::get<dynamics::SpatialModel>(reduction.model);
  const auto interface = std::count_if(model.dofs.begin(), model.dofs.end(),
                                       [](const auto& dof) { return dof.kind != dynamics::DofKind::modal; });
  const Eigen::Index uncounted = reduction.method == Method::dual_craig_bampton ? interface : 0;
  return static_cast<int>(model.size() - uncounted);
}

Reduction reduce(Method method, const FullModel& full, const Interface& interface, const ReductionOptions& options) {
  if (options.modes < 0)
    throw core::InputError("asked for " + std::to_string(options.modes) + " modes of a reduction: ask for 0 or more");
  const auto start = std::chrono::steady_clock::now();
  Reduction result;
  result.method = method;
  if (holds_the_interface(method)) {
    reduce_held(full, interface, options, result);
  } else {
    reduce_free(full, interface, options, result);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace thinwall::reduction
