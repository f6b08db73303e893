#include "study/part/matrix_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/messages.hpp"
#include "fem/modes.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "reduction/rigid_count.hpp"
#include "setup/imported_part.hpp"
#include "setup/matrix_faults.hpp"
#include "setup/part_geometry.hpp"

namespace thinwall::study {

namespace {

fem::Model model_of(const dynamics::SparseModel& matrices) {
  fem::Model model;
  model.K = matrices.K;
  model.M = matrices.M;
  model.spectrum_rad2_s2 = model.K.diagonal().sum() / model.M.diagonal().sum();
  std::map<int, int> index;  // amplitudes stand by themselves
  int next = 0;
  for (const auto& dof : matrices.dofs) {
    const int node = dof.component == 0 ? next++ : index.try_emplace(dof.node, next).first->second;
    if (node == next) ++next;
    model.free_rows.push_back(static_cast<int>(model.free_rows.size()));
    model.node_of_row.push_back(node);
  }
  return model;
}

/// True if M is positive semi-definite: with another a search for modes may end with numbers all the same. Rows scaled
/// to a unit diagonal; 1e-9 is round-off and holds rows without mass.
bool has_definite_mass(const fem::Model& model) {
  const Eigen::VectorXd diagonal = model.M.diagonal();
  const Eigen::VectorXd scale = diagonal.cwiseMax(1e-14 * diagonal.maxCoeff()).cwiseSqrt().cwiseInverse();
  const linalg::SparseMatrix scaled = scale.asDiagonal() * model.M * scale.asDiagonal();
  linalg::SparseMatrix unit(model.M.rows(), model.M.rows());
  unit.setIdentity();
  try {
    const linalg::SparseCholesky factor(scaled, 1e-9, unit, model.node_of_row, {core::available_memory_bytes()});
    return true;
  } catch (const linalg::MemoryLimitError&) {
    throw;
  } catch (const core::NumericalError&) {
    return false;
  }
}

/// Warns of motions that are counted as free though K holds them: by a soft suspension, or by the digits that a file
/// has lost.
void warn_of_soft_springs(const Eigen::VectorXd& lambda, int free, double round_off) {
  if (free == 0) return;
  const double largest = lambda.head(free).cwiseAbs().maxCoeff();
  if (largest < 100.0 * round_off) return;
  const auto hertz = [](double value) { return std::sqrt(value) / (2.0 * std::numbers::pi); };
  const std::string next = free < lambda.size() ? fmt::format(", the next at {:.4g} Hz", hertz(lambda(free))) : "";
  core::warn(fmt::format(
      "{} modes up to {:.3g} Hz are counted as free motions{}: a suspension a thousand times softer than the part, or "
      "matrices written with few digits; its stiffness is left out",
      free, hertz(largest), next));
}

/// Sets how many motions are free: by the lowest modes of a shifted K, which is definite whatever is free.
void count_rigid_motions(fem::Model& model) {
  model.rigid_motions = 1;  // so that it is shifted
  const fem::Factored shifted = fem::factorise(model, core::available_memory_bytes());
  if (model.K.rows() < 2)
    throw core::InputError(
        "the part's matrices have a single row: describe a part of one mode by measured FRFs or modes");
  const int wanted = static_cast<int>(std::min<Eigen::Index>(reduction::most_rigid_modes + 4, model.K.rows() - 1));
  const auto lowest = linalg::lowest_eigenpairs(model.K, model.M, fem::inverse_of(shifted), wanted);
  if (lowest.status != linalg::EigenStatus::converged)
    throw core::NumericalError("the lowest modes of the matrices did not converge: \"thinwall inspect\" tells more");
  const double round_off = 10.0 * std::numeric_limits<double>::epsilon() * model.spectrum_rad2_s2;
  model.rigid_motions = reduction::rigid_count(lowest.lambda, round_off);
  warn_of_soft_springs(lowest.lambda, model.rigid_motions, round_off);
  for (int k = 0; k < model.rigid_motions; ++k) model.free_motions.push_back("mode " + std::to_string(k + 1));
}

[[noreturn]] void no_such_row(const std::string& point, int node, int axis) {
  throw core::InputError(
      fmt::format("point \"{0}\": node {1} has no row along {2}: leave the direction out of points.{0}.directions",
                  point, node, "xyz"[axis]));
}

Solution solved_matrices(const setup::PartSetup& source) {
  fem::Model model = model_of(*source.part->imported->matrices);
  if (!has_definite_mass(model))
    setup::require_definite_files(std::get<setup::MatrixShape>(source.part->shape).files,
                                  *source.part->imported->matrices);  // or the file's digits
  count_rigid_motions(model);
  fem::Factored factored = fem::factorise(model, core::available_memory_bytes());
  fem::ModeOptions options = setup::mode_options(source);
  const int most = std::max(1, static_cast<int>(model.K.rows()) - 1 - model.rigid_motions);
  if (options.count > most && !options.up_to_hz) {
    core::inform(
        fmt::format("{} modes are asked for; of {} rows {} can be computed", options.count, model.K.rows(), most));
    options.count = most;
  }
  fem::Modes modes = fem::modes(model, factored, options);
  return {std::move(model), std::move(factored), std::move(modes)};
}

}  // namespace

Solution matrix_solution(const setup::PartSetup& source) {
  try {
    return solved_matrices(source);
  } catch (const linalg::MemoryLimitError&) {
    throw;
  } catch (const core::NumericalError&) {
    setup::require_definite_files(std::get<setup::MatrixShape>(source.part->shape).files,
                                  *source.part->imported->matrices);
    throw;
  }
}

reduction::Interface matrix_interface(const setup::PartSetup& source) {
  const dynamics::SparseModel& matrices = *source.part->imported->matrices;
  std::map<dynamics::NodeDof, int> row_of;
  for (std::size_t i = 0; i < matrices.dofs.size(); ++i) row_of[matrices.dofs[i]] = static_cast<int>(i);
  reduction::Interface interface;
  std::vector<Eigen::Triplet<double>> entries;
  for (const std::string& name : source.reduction.interface) {
    const setup::Point& p = setup::point(source, name);
    const int node = setup::node_of(*source.part->imported, p).value();
    for (const Eigen::Vector3d& n : p.directions) {
      for (int axis = 0; axis < 3; ++axis) {
        if (n[axis] == 0.0) continue;
        const auto row = row_of.find({node, axis + 1});
        if (row == row_of.end()) no_such_row(name, node, axis);
        entries.emplace_back(row->second, static_cast<int>(interface.dofs.size()), n[axis]);
      }
      interface.dofs.push_back({p.name, n, dynamics::DofKind::translation});
    }
  }
  interface.W.resize(matrices.K.rows(), static_cast<Eigen::Index>(interface.dofs.size()));
  interface.W.setFromTriplets(entries.begin(), entries.end());
  return interface;
}

}  // namespace thinwall::study
