#pragma once
// The forced motion of one depth of cut over the speeds of a chart: the surface that it leaves, its largest force, and
// the force that is left in a contact with a preload.

#include <functional>
#include <optional>
#include <vector>

#include "milling/chart/operating_point.hpp"
#include "milling/cut/process.hpp"
#include "milling/structure/relative_structure.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The force in the contact while a cut goes on (contact_force()); empty where no contact has a preload.
using ContactForceOf = std::function<ContactForce(const milling::ForcedVibration& cut)>;

/// The depth and the feed of a cut whose speed varies.
struct FedDepth {
  double depth_m = 0.0;           ///< > 0
  double feed_per_tooth_m = 0.0;  ///< > 0, the same at every speed
};

/// milling::forced_vibration() at the speed of every row at which the cut is stable (milling::stable_at()), and there
/// the least force in the contact. Where the cut chatters the forced motion is not what one sees: such a row has no
/// figures. `structure` as the chart's, in part axes. The speeds share out among the threads; interruptible. Throws as
/// milling::forced_vibration(), and what `force_of` throws. Cost: a millisecond or some at a stable speed, and one call
/// of `force_of`.
[[nodiscard]] ForcedOverSpeed forced_over_speed(const milling::RelativeStructure& structure,
                                                const milling::MillingProcess& process,
                                                const std::vector<milling::LobeRow>& rows, const FedDepth& cut,
                                                const ContactForceOf& force_of = {});

/// The depths of operating points, each once, in their order.
[[nodiscard]] std::vector<double> depths_of(const std::vector<PointStability>& points);

}  // namespace thinwall::study
