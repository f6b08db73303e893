#pragma once
// A rule for the sign of a mode shape, which the eigenproblem leaves undetermined.

#include <Eigen/Core>

namespace thinwall::core {

/// Makes the entry of largest magnitude in every column of Phi positive (n × modes, any unit), so that the same modes
/// come out on every machine. Cost n · modes.
void fix_signs(Eigen::MatrixXd& Phi);

}  // namespace thinwall::core
