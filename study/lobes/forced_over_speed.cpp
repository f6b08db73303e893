#include "study/lobes/forced_over_speed.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/forced/forced_vibration.hpp"

namespace thinwall::study {

ForcedOverSpeed forced_over_speed(const milling::RelativeStructure& structure, const milling::MillingProcess& process,
                                  const std::vector<milling::LobeRow>& rows, const FedDepth& cut,
                                  const ContactForceOf& force_of) {
  ForcedOverSpeed result{cut.depth_m, cut.feed_per_tooth_m, std::vector<ForcedRow>(rows.size())};
  milling::ForcedOptions lean;
  lean.motion = false;
  core::Progress progress("forced vibrations", rows.size());
  core::parallel_for(rows.size(), [&](std::size_t i) {
    ForcedRow& row = result.rows[i];
    row.spindle_speed_rpm = rows[i].spindle_speed_rpm;
    if (milling::stable_at(rows[i], cut.depth_m)) {
      const auto forced =
          milling::forced_vibration(structure, process, row.spindle_speed_rpm, cut.depth_m, cut.feed_per_tooth_m, lean);
      row.figures = {.surface_location_error_m = forced.surface_location_error_m,
                     .peak_force_n = forced.peak_force_n,
                     .error_estimate = forced.error_estimate,
                     .contact = force_of ? std::optional(force_of(forced)) : std::nullopt};
    }
    progress.step();
  });
  return result;
}

std::vector<double> depths_of(const std::vector<PointStability>& points) {
  std::vector<double> depths;
  for (const PointStability& found : points) {
    if (std::ranges::count(depths, found.point.depth_m) == 0) depths.push_back(found.point.depth_m);
  }
  return depths;
}

}  // namespace thinwall::study
