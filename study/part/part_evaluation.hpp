#pragma once
// The frequencies that a fit of the part asks for, and how they change with its parameters.

#include <optional>
#include <vector>

#include "core/error.hpp"
#include "mesh/tet_mesh.hpp"
#include "setup/variation.hpp"
#include "study/part/discretisation.hpp"

namespace thinwall::study {

/// The error of a target whose mode is not among the `found` ones.
[[nodiscard]] core::InputError no_such_mode(const setup::UpdatingTarget& target, std::size_t found);

/// The targets of an [[updating]] with on = "part", on the part as a case describes it. The mesh is stretched with the
/// part and keeps its topology. A mode is found by its share at a point, by its likeness to the shape of the first
/// evaluation, or by its number.
class PartEvaluation {
 public:
  /// `mesh` fits the part of `start`; it, `variation` and `updating` are kept by reference.
  PartEvaluation(const setup::Variation& variation, const setup::PartSetup& start, const setup::Updating& updating,
                 const mesh::TetMesh& mesh, int order);

  /// The targets' frequencies, Hz. The first evaluation, where a fit starts, is solved as far as a fit can tell; those
  /// after it as the case asks, for the last of them is the part itself. Throws InputError if a target names a mode
  /// that is not there. Cost: a modal solution.
  Eigen::VectorXd operator()(const setup::VariedSetup& now);

  /// Derivatives of the latest evaluation's frequencies by each parameter of the fit (targets × parameters, Hz per
  /// range from `lower` to `upper`). With K', M' the matrices at a parameter moved by h, and K φ = λ M φ, φᵀMφ = 1:
  ///
  ///     λ(p + h) − λ(p) = φᵀ(K' − K − λ(M' − M))φ + O(h²),   ∂f/∂p = (∂λ/∂p) / (8π² f)
  ///
  /// (Fox & Kapoor 1968). Where modes share a frequency it is the derivative along the shape that was found.
  /// `now` must be the set-up of the latest evaluation. Throws InputError if the supports hold other nodes beside it.
  /// Cost: an assembly a parameter.
  [[nodiscard]] Eigen::MatrixXd slopes(const setup::VariedSetup& now) const;

  /// The latest solution, if it is of this case and as this case asks; it is given away.
  [[nodiscard]] std::optional<Solution> take(const setup::VariedSetup& now);

 private:
  /// The matrices with one parameter moved by h of its range.
  struct Neighbour {
    fem::Model model;
    double h = 0.0;
  };

  fem::Model model(const setup::VariedSetup& now) const;
  fem::Modes modes(const setup::VariedSetup& now);
  Eigen::Index mode_of(const setup::VariedSetup& now, const setup::UpdatingTarget& target) const;
  std::vector<double> parameters(const setup::VariedSetup& now) const;
  Neighbour neighbour(const setup::VariedSetup& now, const setup::UpdatingParameter& p) const;

  const setup::Variation& variation_;
  const setup::Updating& updating_;
  const mesh::TetMesh& mesh_;
  int order_;
  Eigen::Vector3d start_size_;
  Eigen::MatrixXd reference_;  // shapes of the first evaluation
  std::optional<Solution> latest_;
  std::vector<double> parameters_;    // of the latest evaluation
  std::vector<Eigen::Index> chosen_;  // its mode for each target
  bool as_asked_ = false;             // its modes are those that the case asks for
  bool asked_suffices_ = true;        // until they turn out too few to look for the targets among them
};

}  // namespace thinwall::study
