#pragma once
// The computation of one frequency line of the receptance route, which couple() and its derivatives repeat line by
// line.

#include <string>
#include <vector>

#include "coupling/joints.hpp"
#include "coupling/kernel.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// The receptances of the components that are coupled, in order.
using Components = std::vector<const dynamics::ResponseModel*>;

/// An entry of a column of B: a row of a DOF table with its weight.
struct Term {
  Eigen::Index row;
  double weight;
};

/// The part of one component in B and in the result.
struct Interface {
  const dynamics::ResponseModel* model;
  std::vector<Eigen::Index> directions;            ///< columns of B that are not zero here
  std::vector<std::vector<Term>> response, force;  ///< these columns, over the component's two tables
  std::vector<int> responses, forces;              ///< the rows and columns of H that are wanted
  Eigen::Index first_row = 0, first_column = 0;    ///< first row and column of the component in the result
};

/// The interfaces of all components: both ends of every joined direction in their tables, and the wanted rows and
/// columns, which are the DOFs of `points`, or all if `points` is empty. Throws InputError as couple() does for
/// components that cannot be joined or a point that is unknown. The components must outlive the result.
[[nodiscard]] std::vector<Interface> interfaces(const Components& components, const Joints& joints,
                                                const std::vector<std::string>& points);

/// The response table of the result: the wanted responses of all components, in their order.
[[nodiscard]] dynamics::DofTable wanted_responses(const std::vector<Interface>& components);
/// The force table of the result: the wanted forces of all components, in their order.
[[nodiscard]] dynamics::DofTable wanted_forces(const std::vector<Interface>& components);

/// Throws NumericalError, with the frequency, if the condition of the kernel is above 1e14.
void require_solvable(const KernelLine& kernel, double hz);

/// A workspace that couples one frequency line after another in storage that is kept: the products of B with Y, the
/// kernel S = BᵀYB + Z⁻¹, and G = Y − Y B S⁻¹ Bᵀ Y over the wanted rows and columns (docs/theory/coupling.md, Eq. 4). B
/// is never formed, because it has few entries. Cost of a line: n² m + m³ for n wanted DOFs and m directions. Nothing
/// is allocated after the first line, except for matrices that are returned. All arguments must outlive it.
class CoupledLine {
 public:
  CoupledLine(const std::vector<Interface>& components, const Joints& joints, Regularisation regularisation,
              double threshold);

  /// Computes G of a line (`omega` in rad/s) and writes it to `coupled`; returns the condition of its kernel.
  KernelLine couple(std::size_t line, double omega, Eigen::MatrixXcd& coupled);

  /// The wanted rows of P = I − Y B S⁻¹ Bᵀ over the responses of one component, for the line that was coupled last
  /// (docs/theory/coupling.md, Eq. 21).
  [[nodiscard]] Eigen::MatrixXcd P(const Interface& component) const;
  /// The wanted columns of Q = I − B S⁻¹ Bᵀ Y over the forces of one component, for the line that was coupled last.
  [[nodiscard]] Eigen::MatrixXcd Q(const Interface& component) const;

 private:
  void add(const Interface& component, const Eigen::MatrixXcd& H, Eigen::MatrixXcd& coupled);

  const std::vector<Interface>& components_;
  const Joints& joints_;
  Kernel kernel_;
  Eigen::Index rows_ = 0, columns_ = 0;
  Eigen::MatrixXcd S_, to_joints_, from_joints_;
  Eigen::MatrixXd magnitude_;
};

}  // namespace thinwall::coupling
