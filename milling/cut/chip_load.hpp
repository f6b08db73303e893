#pragma once
// The chip thickness of each tooth when nothing vibrates: feed, unequal pitches and runout.

#include <vector>

#include "milling/cut/engagement.hpp"
#include "milling/cut/tool.hpp"

namespace thinwall::milling {

/// The chip of one tooth.
struct ChipLoad {
  double mean_thickness_m = 0.0;  ///< over the part of the arcs in which the tooth cuts; 0 if it never does
  double share_in_cut = 1.0;      ///< of the arcs: less where runout lets the tooth pass above the last cut surface
};

/// One a tooth. The tooth meets the lowest of the surfaces that the teeth before it left within a turn,
///
///     h_j(φ) = min_k [ f_k sin φ + ρ_j − ρ_{j−k} ],  k = 1 … z,      cut where h_j > 0
///
/// with ρ the runout and f_k the feed while the k pitches between them turn (Kline & DeVor 1983). `feed_per_tooth_m` is
/// the mean over the teeth, along x_T. Side of a cylinder or taper; a taper or ball thins the chip by sin κ besides.
/// Throws InputError if the feed is not positive, or if no tooth cuts, as where all arcs lie behind the tool.
/// Cost O(z² · 2000).
[[nodiscard]] std::vector<ChipLoad> chip_loads(const Cutter& cutter, const std::vector<Engagement>& arcs,
                                               double feed_per_tooth_m);

/// f_z = v_f/(z n), m: of a feed rate in m/s at a spindle speed. Throws InputError unless both are positive.
[[nodiscard]] double feed_per_tooth_m(const Cutter& cutter, double feed_rate_m_s, double spindle_speed_rpm);

}  // namespace thinwall::milling
