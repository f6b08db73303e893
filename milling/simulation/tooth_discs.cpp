#include "milling/simulation/tooth_discs.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace thinwall::milling {

std::vector<ToothDisc> tooth_discs(const MillingProcess& process, double depth_m, const StepOptions& options,
                                   int earlier_passes) {
  const Cutter& cutter = process.cutter;
  if (!cutter.envelope.straight() || cutter.envelope.taper_rad != 0.0) {
    throw core::InputError(
        "simulation: the paths of teeth in the plane are those of cylinders; take circular paths for another envelope");
  }
  const std::vector<Disc> heights = discs_of(process, depth_m, options);
  const auto radius = [&](int tooth) {
    return 0.5 * cutter.diameter_m + (cutter.runout_m.empty() ? 0.0 : cutter.runout_m[static_cast<std::size_t>(tooth)]);
  };
  double largest = 0.0;
  for (int j = 0; j < cutter.teeth; ++j) largest = std::max(largest, radius(j));
  std::vector<ToothDisc> discs;
  double tip = 0.0;
  for (int j = 0; j < cutter.teeth; ++j) {
    if (j > 0) tip += cutter.pitch_rad(j);
    for (std::size_t slice = 0; slice < heights.size(); ++slice) {
      const Disc& disc = heights[slice];
      const double lag = disc.height_m * cutter.lag_rad_per_m(j);
      const double edge_share = edge_length_per_height(cutter, j, disc.height_m) * disc.sin_kappa;
      ToothDisc one{j, static_cast<int>(slice), tip + lag, radius(j), disc.width_m, edge_share, largest, {}};
      double ahead = lag;
      for (int k = 1, other = j; k <= earlier_passes; ++k) {
        ahead += cutter.pitch_rad(other);
        other = (other + cutter.teeth - 1) % cutter.teeth;
        one.earlier.push_back({ahead - disc.height_m * cutter.lag_rad_per_m(other), radius(other)});
      }
      discs.push_back(std::move(one));
    }
  }
  return discs;
}

double width_of_cut(const std::vector<ToothDisc>& discs, const Cutter& cutter) {
  double width = 0.0;
  for (const ToothDisc& disc : discs) width += disc.width_m / cutter.teeth;
  return width;
}

std::vector<TipPass> tips_of_turn(const MillingProcess& process) {
  constexpr double turn_rad = 2.0 * std::numbers::pi;
  std::vector<TipPass> tips;
  double behind = 0.0;
  for (int j = 0; j < process.cutter.teeth; ++j) {
    if (j > 0) behind += process.cutter.pitch_rad(j);
    const double exit = std::fmod(behind + process.engagement.arc_rad(), turn_rad);
    tips.push_back(
        {j, behind, exit < 1e-9 ? turn_rad : exit, process.engagement.entry_rad, process.engagement.arc_rad()});
  }
  return tips;
}

}  // namespace thinwall::milling
