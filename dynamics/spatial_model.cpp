#include "dynamics/spatial_model.hpp"

#include <string>

#include "core/error.hpp"

namespace thinwall::dynamics {

void require_consistent(const SpatialModel& model) {
  const auto n = static_cast<Eigen::Index>(model.dofs.size());
  if (n == 0) throw core::InputError("a spatial model without degrees of freedom");
  const auto check = [n](const Eigen::MatrixXd& matrix, const char* letter) {
    if (matrix.rows() != n || matrix.cols() != n) {
      throw core::InputError("matrix " + std::string(letter) + " is " + std::to_string(matrix.rows()) + " x " +
                             std::to_string(matrix.cols()) + ", but the table names " + std::to_string(n) +
                             " degrees of freedom");
    }
    if (!matrix.allFinite())
      throw core::InputError("matrix " + std::string(letter) + " holds a value that is not finite");
  };
  check(model.M, "M");
  check(model.C, "C");
  check(model.K, "K");
  if (model.has_structural_damping()) check(model.D, "D");
}

}  // namespace thinwall::dynamics
