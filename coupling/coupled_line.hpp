#pragma once
// One line of the receptance route: what couple() and its derivatives work through, line by line.

#include <string>
#include <vector>

#include "coupling/joints.hpp"
#include "coupling/kernel.hpp"
#include "dynamics/response_model.hpp"

namespace thinwall::coupling {

/// The receptances that are coupled, in order.
using Components = std::vector<const dynamics::ResponseModel*>;

/// Row i of a table with its weight in a column of B.
struct Term {
  Eigen::Index row;
  double weight;
};

/// One component's part of B and of the result.
struct Interface {
  const dynamics::ResponseModel* model;
  std::vector<Eigen::Index> directions;            ///< columns of B that are not zero here
  std::vector<std::vector<Term>> response, force;  ///< these columns, over the component's two tables
  std::vector<int> responses, forces;              ///< the rows and columns of H that are wanted
  Eigen::Index first_row = 0, first_column = 0;    ///< where they begin in the result
};

/// Both ends of every joined direction in the components' tables, and what is wanted of them: the DOFs of `points`, all
/// if there are none. Throws InputError as couple() for components that cannot be joined or a point that is unknown.
/// The components must outlive the result.
[[nodiscard]] std::vector<Interface> interfaces(const Components& components, const Joints& joints,
                                                const std::vector<std::string>& points);

/// The tables of the result: what is wanted of every component, one after another.
[[nodiscard]] dynamics::DofTable wanted_responses(const std::vector<Interface>& components);
/// The same of the forces.
[[nodiscard]] dynamics::DofTable wanted_forces(const std::vector<Interface>& components);

/// Throws NumericalError with the frequency where the condition of the kernel is above 1e14.
void require_solvable(const KernelLine& kernel, double hz);

/// One line after another in storage that stays: B's products with Y, the kernel S = BᵀYB + Z⁻¹, and with it
/// G = Y − Y B S⁻¹ Bᵀ Y over the wanted rows and columns (docs/theory/coupling.md, Eq. 4). Cost of a line n² m + m³ for
/// n wanted DOFs and m directions; no allocation after the first but by what asks for a matrix. All arguments must
/// outlive it.
class CoupledLine {
 public:
  CoupledLine(const std::vector<Interface>& components, const Joints& joints, Regularisation regularisation,
              double threshold);

  /// G of a line (`omega` in rad/s) into `coupled`.
  KernelLine couple(std::size_t line, double omega, Eigen::MatrixXcd& coupled);

  /// Of the line that was coupled last, and one component: wanted rows of P = I − Y B S⁻¹ Bᵀ over its responses, and
  /// wanted columns of Q = I − B S⁻¹ Bᵀ Y over its forces (Eq. 21).
  [[nodiscard]] Eigen::MatrixXcd P(const Interface& component) const;
  /// See P().
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
