#pragma once
// Mode shapes of part and robot together, as they are drawn.

#include <Eigen/Core>
#include <vector>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// Of each coupled mode up to the highest that was computed of the part.
struct CoupledShapes {
  std::vector<double> frequency_hz, damping_ratio;
  Eigen::MatrixXd part;    ///< u = T_CB q over the free rows of the part; zero in modes of the robot alone
  Eigen::Matrix3Xd robot;  ///< the first contact's point of the robot in the same scale, along x, y, z of the part
};

/// The largest entry of part and robot together is 1. q: the part's rows of a coupled mode, turned so that the largest
/// displacement is real (a complex mode is drawn at the phase of that); zero in a mode of the robot alone, where they
/// are round-off, 1e-9 of the mode's largest entry. The part must be reduced and the coupling have modes. Cost
/// O(rows · kept · modes).
[[nodiscard]] CoupledShapes coupled_shapes(const setup::Setup& source, const study::PartResult& part,
                                           const study::CouplingResult& coupled);

}  // namespace thinwall::report
