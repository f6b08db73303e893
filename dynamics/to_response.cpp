#include <cmath>
#include <limits>
#include <sstream>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "dynamics/conversion.hpp"

namespace thinwall::dynamics {

namespace {

using Complex = std::complex<double>;

/// Number of frequency lines that one task computes with one workspace.
constexpr Eigen::Index block_lines = 16;

std::vector<int> physical_rows(const DofTable& dofs) {
  std::vector<int> rows;
  for (int row = 0; row < static_cast<int>(dofs.size()); ++row) {
    if (dofs[static_cast<std::size_t>(row)].kind != DofKind::modal) rows.push_back(row);
  }
  if (rows.empty()) throw core::InputError("no response to compute: every degree of freedom of the model is modal");
  return rows;
}

ResponseModel empty_response(const DofTable& dofs, const std::vector<int>& rows, const FrequencyAxis& axis) {
  if (axis.size() == 0) throw core::InputError("a response needs at least one frequency line");
  DofTable table;
  for (const int row : rows) table.push_back(dofs[static_cast<std::size_t>(row)]);
  const auto size = static_cast<Eigen::Index>(rows.size());
  core::require_memory(16.0 * static_cast<double>(axis.size() * size * size),
                       "a response of " + std::to_string(axis.size()) + " lines between " + std::to_string(size) +
                           " degrees of freedom");
  return {axis, table, table,
          std::vector<Eigen::MatrixXcd>(static_cast<std::size_t>(axis.size()), Eigen::MatrixXcd(size, size))};
}

[[noreturn]] void refuse_line(double hz, const char* cause) {
  std::ostringstream text;
  text.precision(10);
  text << "no receptance at " << hz << " Hz: " << cause << "; add damping or leave this frequency out";
  throw core::NumericalError(text.str());
}

template <typename Body>
void for_line_blocks(Eigen::Index lines, Body body) {
  core::parallel_for(static_cast<std::size_t>((lines + block_lines - 1) / block_lines), [&](std::size_t block) {
    const Eigen::Index first = static_cast<Eigen::Index>(block) * block_lines;
    body(first, std::min(first + block_lines, lines));
  });
}

/// Scale factors, powers of two, that bring a dynamic stiffness to a diagonal of order one. Rows of the interface in
/// N/m and modal rows in s⁻² differ by many decades, and partial pivoting compares them; powers of two cause no
/// round-off. The size of a row is that of K + ω²M, which does not vanish at a resonance; a row that has neither (a
/// constraint force) is scaled by its largest entry.
void equilibration(const SpatialModel& model, double omega, const Eigen::MatrixXcd& matrix, Eigen::VectorXd& scale) {
  scale = model.K.diagonal().cwiseAbs() + omega * omega * model.M.diagonal().cwiseAbs();
  for (double& size : scale) size = size > 0.0 ? 1.0 / std::sqrt(size) : 0.0;
  for (Eigen::Index i = 0; i < scale.size(); ++i) {
    if (scale(i) > 0.0) continue;
    const double largest = (matrix.row(i).cwiseAbs() * scale.asDiagonal()).maxCoeff();
    const double own = std::sqrt(std::abs(matrix(i, i)));
    scale(i) = std::max(largest, own) > 0.0 ? 1.0 / std::max(largest, own) : 1.0;
  }
  for (double& size : scale) size = std::exp2(std::round(std::log2(size)));
}

/// The LU factors of K + iD + iωC − ω²M + S, for one frequency line after another, in storage that is kept between
/// lines.
class DynamicStiffness {
 public:
  explicit DynamicStiffness(const SpatialModel& model) : model_(model), complex_K_(model.K.cast<Complex>()) {
    if (model.has_structural_damping()) complex_K_.imag() = model.D;
  }

  /// Factorises the dynamic stiffness at one line.
  void factor(double omega, Eigen::Index line, const AddedStiffness& added) {
    matrix_ = complex_K_;
    matrix_.real() -= omega * omega * model_.M;
    matrix_.imag() += omega * model_.C;
    if (added) added(line, matrix_);
    equilibration(model_, omega, matrix_, scale_);
    matrix_ = scale_.asDiagonal() * matrix_ * scale_.asDiagonal();
    lu_.compute(matrix_);
  }

  /// The smallest pivot; the scaled matrix has entries of order one, so that it can be compared with round-off.
  [[nodiscard]] double smallest_pivot() const { return lu_.matrixLU().diagonal().cwiseAbs().minCoeff(); }

  /// Writes T (…)⁻¹ Tᵀ of the line factorised last to H.
  void response(const Eigen::MatrixXd& T, Eigen::MatrixXcd& H) {
    solution_ = lu_.solve((scale_.asDiagonal() * T.transpose()).cast<Complex>());
    H.noalias() = (T * scale_.asDiagonal()).cast<Complex>() * solution_;
  }

 private:
  const SpatialModel& model_;
  Eigen::MatrixXcd complex_K_;
  Eigen::VectorXd scale_;
  Eigen::MatrixXcd matrix_;
  Eigen::MatrixXcd solution_;
  Eigen::PartialPivLU<Eigen::MatrixXcd> lu_;
};

}  // namespace

ResponseModel to_response(const ModalModel& model, const FrequencyAxis& axis) {
  const std::vector<int> rows = physical_rows(model.dofs);
  ResponseModel response = empty_response(model.dofs, rows, axis);
  const Eigen::MatrixXcd right = model.right(rows, Eigen::all);
  const Eigen::MatrixXcd left = model.left(rows, Eigen::all).transpose();
  const bool has_residual = model.residual.size() > 0;
  const Eigen::MatrixXcd residual =
      has_residual ? Eigen::MatrixXcd(model.residual(rows, rows).cast<Complex>()) : Eigen::MatrixXcd();
  for_line_blocks(axis.size(), [&](Eigen::Index first, Eigen::Index end) {
    Eigen::MatrixXcd weighted(right.rows(), right.cols());
    for (Eigen::Index line = first; line < end; ++line) {
      const Complex s(0.0, axis.omega_rad_s(line));
      weighted = right * (model.scaling.array() * (s - model.poles.array())).inverse().matrix().asDiagonal();
      Eigen::MatrixXcd& H = response.H[static_cast<std::size_t>(line)];
      H.noalias() = weighted * left;
      if (has_residual) H += residual;
      if (!H.allFinite()) refuse_line(axis.hz(line), "a pole without damping lies there");
    }
  });
  return response;
}

ResponseModel direct_response(const SpatialModel& model, const FrequencyAxis& axis, const AddedStiffness& added) {
  require_consistent(model);
  const std::vector<int> rows = physical_rows(model.dofs);
  const Eigen::MatrixXd observed = displacements(model)(rows, Eigen::all);
  ResponseModel response = empty_response(model.dofs, rows, axis);
  const double zero = static_cast<double>(model.size()) * std::numeric_limits<double>::epsilon();
  for_line_blocks(axis.size(), [&](Eigen::Index first, Eigen::Index end) {
    DynamicStiffness stiffness(model);
    for (Eigen::Index line = first; line < end; ++line) {
      Eigen::MatrixXcd& H = response.H[static_cast<std::size_t>(line)];
      stiffness.factor(axis.omega_rad_s(line), line, added);
      if (!(stiffness.smallest_pivot() > zero)) refuse_line(axis.hz(line), "the dynamic stiffness is singular");
      stiffness.response(observed, H);
      if (!H.allFinite()) refuse_line(axis.hz(line), "the dynamic stiffness is not finite");
    }
  });
  return response;
}

}  // namespace thinwall::dynamics
