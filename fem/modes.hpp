#pragma once
// Natural modes of the full model.

#include <optional>

#include "fem/model.hpp"
#include "linalg/eigenpair_check.hpp"
#include "linalg/eigenpairs.hpp"

namespace thinwall::fem {

/// The modes wanted, by number or by frequency.
struct ModeOptions {
  int count = 10;  ///< number of elastic modes; used if up_to_hz is not given
  /// If not 0 the modes come from so many domains (2, 4, 8 …) by linalg::substructured_eigenpairs(), to 1e-5 of their
  /// frequencies by its estimate and round-off, in place of block Lanczos. That is taken all the same where they do not
  /// converge, with a warning, and where more than half of all modes are wanted.
  int substructures = 0;
  std::optional<double> up_to_hz{};  ///< if given, all modes below this frequency instead
  double inverse_residual = 3e-10;   ///< ≤ 0.01, for `count` modes: error of a shape; its square is that of λ
};

/// Modes in ascending order, the rigid-body modes first (as many as Model::rigid_motions).
struct [[nodiscard]] Modes {
  Eigen::VectorXd frequency_hz;  ///< 0 for rigid-body modes
  linalg::Eigenpairs pairs;      ///< λ in rad²/s², Φ over the free rows, M-normalised
  Eigen::VectorXd residual;      ///< ‖Kφ−λMφ‖/(λ‖Mφ‖), 0 for rigid-body modes
  int rigid_motions = 0;
  /// The relative change of the lowest elastic frequency that rounding the entries of K may cause: ε tr K / (2 λ tr M).
  /// No residual shows it; for very thin parts it grows as (length / thickness)⁴.
  double round_off = 0.0;
  std::optional<linalg::EigenpairCheck> check;  ///< of verify() (mode_check.hpp), where it was asked for
};

/// The natural modes of a model, the rigid-body modes first. Throws NumericalError if the iteration does not converge,
/// if a free part does not show exactly its rigid-body modes (|λ| < 1e-6 of the first elastic eigenvalue or of the size
/// of K's round-off, 10 ε tr K / tr M), or if the first elastic eigenvalue, of a held part too, is no larger than that
/// round-off. Throws InputError if no elastic mode lies below up_to_hz. `start` are shapes near
/// those of `count` modes on the free rows, such as interpolated() ones of another order, if there are such: with them
/// a residual of 1e-3 takes two or three solves of as many columns in place of twelve solves of eight. What
/// substructures were taken is told. Cost: that of linalg::lowest_eigenpairs() or linalg::substructured_eigenpairs().
Modes modes(const Model& model, const Factored& factored, const ModeOptions& options,
            const Eigen::MatrixXd& start = {});

}  // namespace thinwall::fem
