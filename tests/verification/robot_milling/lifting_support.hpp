#pragma once
// A support that can only press, by Newmark's method on the matrices of part and robot: an independent check of
// milling/simulation/one_sided_contact.hpp.

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <string>

#include "dynamics/spatial_model.hpp"
#include "milling/cut/tool.hpp"
#include "milling/simulation/exact_path.hpp"

namespace thinwall::testing {

/// The contact between a point of the part and the robot's tip, along one direction.
struct LiftingContact {
  std::string part_point, robot_point;
  Eigen::Vector3d pressing = Eigen::Vector3d::UnitX();  ///< unit vector along which the part presses the tip, part axes
  double stiffness = 0.0;                               ///< k > 0, N/m
  double damping = 0.0;                                 ///< c ≥ 0, N s/m
  double preload_n = 0.0;                               ///< N₀ ≥ 0: the force in it at rest
};

/// The force in the contact over the simulated time.
struct ContactHistory {
  double simulated_s = 0.0;
  double open_s = 0.0;                                       ///< of it, without contact
  double widest_m = 0.0;                                     ///< the largest gap
  double largest_n = 0.0;                                    ///< the largest force
  double least_n = std::numeric_limits<double>::infinity();  ///< the least force; 0 where the contact opens
};

/// A part with its support as a tool of milling::simulate_exact_path(), and what its contact goes through meanwhile.
struct LiftingSupport {
  milling::MovedTool tool;
  std::shared_ptr<const ContactHistory> contact;
};

/// Part and robot over their own coordinates y beside the state at rest, in which the preload is balanced:
///
///     M y'' + C y' + K y + b λ = Tᵀ f,     λ = max(k d + c d', −N₀),     d = b·y = p·(u_part − u_tip)
///
/// so that the contact presses with N₀ + λ and never pulls. While it is open, part and tip move by themselves, the tip
/// under the preload that the part no longer holds. f is the force at `cut_point`, the opposite of that on the tool;
/// the tool is rigid. A step is Newmark's of average acceleration with the matrices of the closed or the open contact,
/// whichever agrees with λ at its end, and the force of the cut there by fixed-point iterations. Of second order in the
/// step. Throws InputError for a faulty model, an unknown point, structural damping, or numbers of the contact out of
/// their bounds. Cost of a step: a few times the square of the coordinates; factorised once a step size.
[[nodiscard]] LiftingSupport lifting_support(const dynamics::SpatialModel& part, const dynamics::SpatialModel& robot,
                                             const LiftingContact& contact, const std::string& cut_point,
                                             const milling::ToolFrame& frame);

}  // namespace thinwall::testing
