#include "identification/fitted_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"

namespace thinwall::identification {

namespace {

using Complex = std::complex<double>;

/// All DOFs, and the number of each response and each reference among them.
struct AllDofs {
  dynamics::DofTable dofs;
  std::vector<int> of_response, of_reference;
};

int number_of(const dynamics::DofTable& dofs, const dynamics::Dof& dof) {
  const std::string name = dynamics::name(dof);
  const auto found = std::ranges::find_if(dofs, [&](const dynamics::Dof& d) { return dynamics::name(d) == name; });
  return found == dofs.end() ? -1 : static_cast<int>(found - dofs.begin());
}

AllDofs all_dofs(const dynamics::DofTable& responses, const dynamics::DofTable& forces) {
  AllDofs all{responses, {}, {}};
  for (std::size_t i = 0; i < responses.size(); ++i) all.of_response.push_back(static_cast<int>(i));
  for (const dynamics::Dof& force : forces) {
    if (number_of(all.dofs, force) < 0) all.dofs.push_back(force);
    all.of_reference.push_back(number_of(all.dofs, force));
  }
  return all;
}

/// The vectors of R = r lᵀ over all DOFs, of one size where a DOF has both.
dynamics::ModalTableRow row_of(const FittedMode& mode, const Eigen::VectorXcd& right, const Eigen::VectorXcd& left,
                               const AllDofs& all, const CommonDofs& common) {
  // left = α right at the DOFs that have both, in least squares.
  Complex across = 0.0;
  double square = 0.0;
  for (std::size_t i = 0; i < common.response.size(); ++i) {
    across += left(common.reference[i]) * std::conj(right(common.response[i]));
    square += std::norm(right(common.response[i]));
  }
  const Complex alpha = square > 0.0 && across != 0.0 ? across / square : Complex(1.0), root = std::sqrt(alpha);
  const auto n = static_cast<Eigen::Index>(all.dofs.size());
  dynamics::ModalTableRow row;
  row.frequency_hz = mode.frequency_hz;
  row.damping_ratio = mode.damping_ratio;
  row.right = row.left = Eigen::VectorXcd::Zero(n);
  row.place_m = Eigen::VectorXd::Constant(n, std::nan(""));
  for (std::size_t j = 0; j < all.of_reference.size(); ++j)
    row.left(all.of_reference[j]) = row.right(all.of_reference[j]) = left(static_cast<Eigen::Index>(j)) / root;
  std::vector<bool> is_reference(all.dofs.size(), false);
  for (const int j : all.of_reference) is_reference[static_cast<std::size_t>(j)] = true;
  for (std::size_t i = 0; i < all.of_response.size(); ++i) {
    const Complex value = root * right(static_cast<Eigen::Index>(i));
    row.right(all.of_response[i]) = value;
    if (!is_reference[static_cast<std::size_t>(all.of_response[i])]) row.left(all.of_response[i]) = value;
  }
  return row;
}

/// The pairs of vectors of a mode: one of rank one, or one a singular value.
std::vector<std::pair<Eigen::VectorXcd, Eigen::VectorXcd>> vectors_of(const FittedMode& mode) {
  constexpr double least = 1e-9;
  if (mode.left.size() > 0) return {{mode.right, mode.left}};
  const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(mode.residue, Eigen::ComputeThinU | Eigen::ComputeThinV);
  std::vector<std::pair<Eigen::VectorXcd, Eigen::VectorXcd>> pairs;
  for (Eigen::Index i = 0; i < svd.singularValues().size(); ++i) {
    const double size = svd.singularValues()(i);
    if (size > least * svd.singularValues()(0))
      pairs.emplace_back(size * svd.matrixU().col(i), svd.matrixV().col(i).conjugate());
  }
  return pairs;
}

}  // namespace

CommonDofs common_dofs(const dynamics::DofTable& responses, const dynamics::DofTable& forces) {
  CommonDofs common;
  for (std::size_t i = 0; i < responses.size(); ++i) {
    const int j = number_of(forces, responses[i]);
    if (j < 0) continue;
    common.response.push_back(static_cast<int>(i));
    common.reference.push_back(j);
  }
  return common;
}

dynamics::ModalTable modal_table(const ModalFit& fit, const dynamics::DofTable& responses,
                                 const dynamics::DofTable& forces) {
  const AllDofs all = all_dofs(responses, forces);
  const CommonDofs common = common_dofs(responses, forces);
  if (common.response.empty())
    throw core::InputError(
        "no DOF was measured as response and as force, so that shapes have no scale; add a driving point");
  dynamics::ModalTable table{all.dofs, {}};
  for (std::size_t r = 0; r < fit.modes.size(); ++r) {
    const auto pairs = vectors_of(fit.modes[r]);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      table.rows.push_back(row_of(fit.modes[r], pairs[k].first, pairs[k].second, all, common));
      table.rows.back().mode = std::to_string(r + 1) + (k == 0 ? "" : "." + std::to_string(k + 1));
    }
  }
  return table;
}

dynamics::ModalModel modal_model(const ModalFit& fit, const dynamics::DofTable& responses,
                                 const dynamics::DofTable& forces) {
  const dynamics::ModalTable table = modal_table(fit, responses, forces);
  const auto n = static_cast<Eigen::Index>(table.dofs.size()), poles = static_cast<Eigen::Index>(2 * table.rows.size());
  dynamics::ModalModel model;
  model.dofs = table.dofs;
  model.poles.resize(poles);
  model.right.resize(n, poles);
  model.left.resize(n, poles);
  model.scaling = Eigen::VectorXcd::Ones(poles);
  for (Eigen::Index k = 0; k < poles; k += 2) {
    const dynamics::ModalTableRow& row = table.rows[static_cast<std::size_t>(k / 2)];
    const double omega = 2.0 * std::numbers::pi * row.frequency_hz, zeta = row.damping_ratio;
    model.poles(k) = Complex(-zeta * omega, omega * std::sqrt(1.0 - zeta * zeta));
    model.right.col(k) = row.right;
    model.left.col(k) = row.left;
    model.poles(k + 1) = std::conj(model.poles(k));
    model.right.col(k + 1) = row.right.conjugate();
    model.left.col(k + 1) = row.left.conjugate();
  }
  if (fit.powers.empty()) return model;
  const AllDofs all = all_dofs(responses, forces);
  model.residual = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t j = 0; j < all.of_reference.size(); ++j) {
    for (std::size_t i = 0; i < all.of_response.size(); ++i) {
      const double c = fit.powers.front()(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      model.residual(all.of_response[i], all.of_reference[j]) = c;
      if (number_of(forces, responses[i]) < 0) model.residual(all.of_reference[j], all.of_response[i]) = c;
    }
  }
  return model;
}

std::vector<std::optional<PointMode>> point_modes(const ModalFit& fit, const dynamics::DofTable& responses,
                                                  const dynamics::DofTable& forces) {
  const CommonDofs common = common_dofs(responses, forces);
  std::vector<std::optional<PointMode>> result(fit.modes.size());
  if (common.response.empty()) return result;
  for (std::size_t r = 0; r < fit.modes.size(); ++r) {
    const FittedMode& mode = fit.modes[r];
    const Eigen::MatrixXcd there = mode.residue(common.response, common.reference);
    const Eigen::MatrixXd A = (Complex(0.0, 2.0 * mode.pole().imag()) * there).real();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(Eigen::MatrixXd(0.5 * (A + A.transpose())));
    const double largest = of.eigenvalues()(A.rows() - 1);
    if (!(largest > 0.0)) continue;
    PointMode point{1.0 / largest, std::norm(mode.pole()) / largest, of.eigenvectors().col(A.rows() - 1)};
    Eigen::Index at = 0;
    point.direction.cwiseAbs().maxCoeff(&at);
    if (point.direction(at) < 0.0) point.direction *= -1.0;
    result[r] = point;
  }
  return result;
}

}  // namespace thinwall::identification
