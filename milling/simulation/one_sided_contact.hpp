#pragma once
// A support that only presses: its contact may open while the tool cuts.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// A contact of which the structure at the cut holds the spring and the damper as if they could pull. What they pull
/// with beyond the preload is taken back by a pair of forces that pushes both sides apart,
///
///     g = max(0, k δ + c δ' − N₀),      pressing force N = max(0, N₀ − k δ − c δ'),
///
/// with δ the distance between the sides since rest. So N never pulls, and as long as the contact is closed the motion
/// is that of the linear structure.
struct OneSidedContact {
  ForcePair pair;                  ///< that pushes the sides apart along the normal
  double stiffness_n_per_m = 0.0;  ///< k > 0, along the normal
  double damping_n_s_per_m = 0.0;  ///< c ≥ 0
  double preload_n = 0.0;          ///< N₀ ≥ 0
};

/// N₀ − k δ − c δ': the force that presses the sides together where it is positive, N.
[[nodiscard]] inline double force_between(const OneSidedContact& contact, double opening_m, double opening_m_s) {
  return contact.preload_n - contact.stiffness_n_per_m * opening_m - contact.damping_n_s_per_m * opening_m_s;
}

/// Every violation, empty if there is none: finite, stiffness above zero, damping and preload at least zero.
[[nodiscard]] std::vector<std::string> validate(const OneSidedContact& contact);

/// The fate of a contact that may open, over the recorded turns.
struct ContactOutcome {
  double open_share = 0.0;  ///< of the time
  double least_n = 0.0;     ///< pressing force; 0 once it opened
  double largest_n = 0.0;
  double widest_m = 0.0;  ///< the widest gap between the sides
};

}  // namespace thinwall::milling
