#pragma once
// Does the robot stay in touch while the cutter cuts?

#include <functional>
#include <utility>

#include "setup/machining_setup.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The point that is cut and the cut's axes.
struct CutPlace {
  std::string point;         ///< name of the part's point
  Eigen::Matrix3d rotation;  ///< R of x_part = R x_tool
};

/// The force that presses the contact, N, and the unit vector along which it presses the tip: the normal of an only
/// contact with a preload along it (preload_of()), turned to the side from which robot.preload comes; else
/// robot.preload. Throws InputError without a preload.
[[nodiscard]] std::pair<double, Eigen::Vector3d> pressing_force(const setup::SupportSetup& source);

/// The force of the part on the robot's tip along the preload over a period of the cut, and whether it falls to zero.
/// With the harmonics F_k of the cutting force on the part at the cut and Q of dG = P dY Q (coupling/sensitivity.hpp),
/// whose rows at the tip are the joints' force there for a unit force on the part,
///
///     N(t) = N₀ + n · Re Σ_k Q(kω) F_k e^{ikωt},     ω = 2π/T
///
/// N₀ and n: preload and normal of an only contact (setup/contact_model.hpp), else size and direction of robot.preload;
/// the mean force (k = 0) at a thousandth of the first harmonic. The coupling is two-sided: where N < 0 it is not what
/// the robot does. `tip`: the robot in its posture. Throws InputError without preload. Cost: 65 lines of a coupling.
[[nodiscard]] ContactForce contact_force(const setup::SupportSetup& support,
                                         const std::vector<coupling::Contact>& contacts, const CutPlace& place,
                                         const Component& part, const Component& tip,
                                         const milling::ForcedVibration& cut);

/// The depth of cut up to which the contact holds, m: the least depth at which `force_at` loses it, to 1 %, sought at
/// eight depths up to `deepest_m` > 0 and bisected; none if it holds at all of them. Cost: up to fifteen calls.
[[nodiscard]] std::optional<double> depth_of_lost_contact(const std::function<ContactForce(double depth_m)>& force_at,
                                                          double deepest_m);

}  // namespace thinwall::study
