#pragma once
// Natural modes of the full model.

#include <optional>

#include "fem/model.hpp"
#include "linalg/eigenpairs.hpp"

namespace thinwall::fem {

/// How many modes, or up to which frequency; whether to prove that none was missed.
struct ModeOptions {
  int count = 10;                    ///< elastic modes; used if up_to_hz is not given
  std::optional<double> up_to_hz{};  ///< all modes below this frequency instead
  bool verify_count = false;         ///< Sturm count: inertia of K − σM just above the last mode
  double inverse_residual = 3e-10;  ///< ≤ 1e-6, of `count` modes: a frequency is off by its square, a shape by itself
};

/// Modes in ascending order, the rigid-body modes first (as many as Model::rigid_motions).
struct [[nodiscard]] Modes {
  Eigen::VectorXd frequency_hz;  ///< 0 for rigid-body modes
  linalg::Eigenpairs pairs;      ///< λ in rad²/s², Φ over the free rows, M-normalised
  Eigen::VectorXd residual;      ///< ‖Kφ−λMφ‖/(λ‖Mφ‖), 0 for rigid-body modes
  int rigid_motions = 0;
  /// What rounding K's entries may change of the lowest elastic frequency, relative: ε tr K / (2 λ tr M). No residual
  /// shows it; it grows as (length / thickness)⁴ with the thinnest of parts.
  double round_off = 0.0;
  std::optional<bool> count_verified;  ///< set on request: true if the Sturm count agrees
};

/// Sturm count: no eigenvalue but the pairs' lies below the last of them. Counts at a shift between it and the next
/// one.
[[nodiscard]] bool none_missed(const Model& model, const linalg::Eigenpairs& pairs);

/// Cost: see linalg::lowest_eigenpairs; the Sturm count adds a simplicial factorisation.
/// Throws NumericalError if the iteration does not converge, if a free part does not show exactly its rigid-body modes
/// (|λ| < 1e-6 of the first elastic eigenvalue or of the size of K's round-off, 10 ε tr K / tr M), or if the first
/// elastic eigenvalue, of a held part too, is no more than that round-off.
Modes modes(const Model& model, const Factored& factored, const ModeOptions& options);

/// The modes near given ones, which must lie near the lowest: inverse iteration (linalg::inverse_iteration) until the
/// residuals of all are below `inverse_residual` before the last step; frequencies are then off by less than its square
/// (relative, where they are not close to one that is left out), upwards in a held part. Of a solution of another order
/// two steps do, where block_lanczos() takes nine of as many columns. None if the start is too far: the columns depend
/// on each other, or four steps were not enough. Does not show if a mode is missing between those given. start: λ,
/// rad²/s², and Φ on the free rows of the model. Throws as modes() does.
std::optional<Modes> modes_near(const Model& model, const Factored& factored, linalg::Eigenpairs start,
                                double inverse_residual);

}  // namespace thinwall::fem
