#pragma once
// Where and how a robot touches a part.

#include <Eigen/Core>
#include <limits>
#include <string>
#include <vector>

namespace thinwall::coupling {

/// What joins the two points along one direction, Z(ω) = K (1 + iη) + iωC. All other directions stay free.
struct ContactSpring {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();        ///< unit vector, part axes
  double stiffness = std::numeric_limits<double>::infinity();  ///< K > 0, N/m; infinite: both points move as one
  double damping = 0.0;                                        ///< C ≥ 0, N s/m; without meaning if K is infinite
  double loss_factor = 0.0;                                    ///< η ≥ 0; without meaning if K is infinite

  [[nodiscard]] bool rigid() const { return stiffness == std::numeric_limits<double>::infinity(); }
};

/// One point of the part against one point of the robot, joined in one to three directions, which need not be
/// orthogonal.
struct Contact {
  std::string part_point;
  std::string robot_point;
  std::vector<ContactSpring> springs;
};

/// Throws InputError with every violation at once: no contact, no spring, a direction that is not a unit vector, a
/// stiffness that is not positive, negative damping or loss.
void require_valid(const std::vector<Contact>& contacts);

}  // namespace thinwall::coupling
