#include "app/lobes_stage.hpp"

#include <cmath>
#include <variant>

#include "app/cut_structure.hpp"
#include "app/milling_process.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "milling/sampled_stability.hpp"
#include "milling/stability.hpp"

namespace thinwall::app {

namespace {

/// |μ| where there are poles, and the margins to the boundary.
PointStability stability_of(const milling::OperatingPoint& point, const CutStructure& structure,
                            const milling::MillingProcess& process, const milling::RowAt& row_at,
                            const milling::Lobes& chart, const milling::StabilityOptions& options) {
  PointStability result;
  result.point = point;
  const milling::LobeRow row = milling::row_to(row_at, point, options);
  result.stable = milling::stable_at(row, point.depth_m);
  result.depth = milling::depth_margin(row, point.depth_m);
  result.speed = milling::speed_margin(row_at, chart.rows, point, options);
  result.status = row.status;
  const auto* poles = std::get_if<milling::RelativeStructure>(&structure);
  if (poles == nullptr) return result;
  result.multiplier = milling::multiplier_at(*poles, process, point.spindle_speed_rpm, point.depth_m, options);
  if ((result.multiplier->modulus < 1.0) != result.stable) {
    // The two disagree on the boundary itself only, unless a crossing was missed.
    const bool on_boundary = std::abs(result.depth.margin_m) <= 1e-3 * point.depth_m;
    if (!on_boundary) result.status = milling::StabilityStatus::crossing_missed;
    result.stable = result.multiplier->modulus < 1.0;
  }
  return result;
}

}  // namespace

milling::StabilityOptions stability_options(const LobesOptions& wanted) {
  milling::StabilityOptions options;
  options.depth_limit_m = wanted.depth_limit;
  options.error_tolerance = wanted.tolerance;
  return options;
}

NamedLobes compute_lobes(const Case& source, const std::string& name, const dynamics::ModalModel* part,
                         const std::vector<milling::OperatingPoint>& points) {
  const LobesOptions& wanted = *source.lobes;
  const milling::MillingProcess process = milling_process(source);
  const CutStructure structure = cut_structure(source, process.frame, part);
  const milling::StabilityOptions options = stability_options(wanted);
  const milling::RowAt row_at = [&](double rpm, const milling::StabilityOptions& with) {
    return std::visit([&](const auto& s) { return milling::limiting_depth(s, process, rpm, with); }, structure);
  };
  const auto speeds = milling::spindle_speeds(wanted.from_rpm, wanted.to_rpm, wanted.count);
  NamedLobes result;
  result.name = name;
  result.lobes =
      std::visit([&](const auto& s) { return milling::stability_lobes(s, process, speeds, options); }, structure);
  if (source.cutting->spindle_speed_rpm) result.at_spindle_speed = row_at(*source.cutting->spindle_speed_rpm, options);
  for (const auto& point : points)
    result.points.push_back(stability_of(point, structure, process, row_at, result.lobes, options));
  return result;
}

void require_chart_of(const Case& source, const std::vector<milling::OperatingPoint>& points) {
  if (points.empty()) return;
  if (!source.lobes || !source.cutting || !source.tool)
    throw core::InputError("an operating point needs a chart; add [tool], [cutting] and [lobes] to the case");
  for (const auto& point : points) {
    if (point.depth_m <= source.lobes->depth_limit) continue;
    throw core::InputError("operating point at " + core::readable_text(point.depth_m, core::kind::length) +
                           ": deeper than the chart goes, " +
                           core::readable_text(source.lobes->depth_limit, core::kind::length) +
                           " (lobes.depth_limit, else tool.length); give a smaller depth or raise the limit");
  }
}

}  // namespace thinwall::app
