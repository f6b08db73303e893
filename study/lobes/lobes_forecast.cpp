#include "study/lobes/lobes_forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/time_limit.hpp"
#include "milling/chart/robust_lobes.hpp"
#include "milling/chart/sampled_stability.hpp"
#include "setup/imported_part.hpp"
#include "setup/milling_process.hpp"
#include "setup/path.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

using std::complex;

/// The plate that stands in for a part: its thinnest extent, or the mean wall of a surface.
struct Plate {
  double thickness_m = 0.0, area_m2 = 0.0, mass_kg = 0.0, wave_speed_m_s = 5000.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};

Plate plate_like(const setup::Part& part) {
  Eigen::Vector3d size = setup::box_size(part);
  if (!(size.minCoeff() > 0.0)) size = {0.005, 0.2, 0.2};  // matrices without positions
  Eigen::Index thin = 0;
  Plate plate;
  plate.thickness_m = size.minCoeff(&thin);
  plate.normal = Eigen::Vector3d::Unit(thin);
  plate.area_m2 = size.prod() / plate.thickness_m;
  if (part.imported && part.imported->surface) {
    double area = 0.0;
    const mesh::TriangleSurface& surface = part.imported->surface->surface;
    for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) area += mesh::area_vector(surface, t).norm();
    plate.area_m2 = 0.5 * area;
    plate.thickness_m = part.imported->surface->volume_m3 / plate.area_m2;
  }
  const setup::Material& m = part.material;
  const double density = m.density > 0.0 ? m.density : 2700.0;
  if (m.youngs_modulus > 0.0) plate.wave_speed_m_s = std::sqrt(m.youngs_modulus / density);
  plate.mass_kg = density * plate.area_m2 * plate.thickness_m;
  return plate;
}

/// The direction in which mode k of a part moves: the wall's normal and a tenth along the other axes, for no mode keeps
/// to one direction; the walls of a part from a file stand in any.
Eigen::Vector3d direction_of_mode(const setup::Part& part, const Plate& plate, Eigen::Index k) {
  const Eigen::Vector3d main = setup::from_file(part) ? Eigen::Vector3d(Eigen::Vector3d::Unit(k % 3)) : plate.normal;
  const Eigen::Vector3d beside(1.0, k % 2 == 0 ? 1.0 : -1.0, k % 4 < 2 ? 1.0 : -1.0);
  return (main + 0.1 * beside).normalized();
}

/// Modes of the plate, 2 c_L t / (√12 A) apart, each of a quarter of its mass: φ φᵀ / (2 i ω_d (iω − λ)) + conjugate.
milling::RelativeStructure modes_like(const setup::Setup& source) {
  constexpr double damping_ratio = 0.01;
  const Plate plate = plate_like(*source.part);
  const double apart_hz = 2.0 * plate.wave_speed_m_s * plate.thickness_m / (std::sqrt(12.0) * plate.area_m2);
  const setup::ModeRange& range = source.reduction.fixed_interface;
  const double highest_hz =
      std::min(range.up_to_hz.value_or(INFINITY), source.lobes->modes_up_to_hz.value_or(INFINITY));
  const int most = range.up_to_hz ? 300 : range.count.value_or(setup::usual_reduction_modes);
  const auto count = static_cast<Eigen::Index>(std::clamp(highest_hz / apart_hz, 1.0, static_cast<double>(most)));
  milling::RelativeStructure structure{Eigen::VectorXcd(count), Eigen::Matrix3Xcd(3, count),
                                       Eigen::Matrix3Xcd(3, count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const double omega = 2.0 * std::numbers::pi * apart_hz * static_cast<double>(k + 1);
    const double damped = omega * std::sqrt(1.0 - damping_ratio * damping_ratio);
    structure.poles(k) = {-damping_ratio * omega, damped};
    structure.phi.col(k) =
        (2.0 / std::sqrt(plate.mass_kg) * direction_of_mode(*source.part, plate, k)).cast<complex<double>>();
    structure.b.col(k) = structure.phi.col(k) / complex<double>(0.0, 2.0 * damped);
  }
  return structure;
}

/// A structure that stands in for that of a chart, and how many times as long as it the true one takes to be made.
struct StandIn {
  CutStructure structure;
  double longer = 1.0;
};

StandIn structure_like(const setup::Setup& source, const milling::ToolFrame& frame) {
  std::optional<Component> robot;
  if (setup::carries_tool(source.robot)) {
    robot = robot_component(*source.robot, {Eigen::VectorXd::Ones(1)}, setup::robot_posture(source, source).posture);
  }
  std::optional<milling::RelativeStructure> poles =
      cut_poles(source, nullptr, robot ? &carrier_modes(*robot) : nullptr);
  if (source.part) poles = poles ? milling::sum(*poles, modes_like(source)) : modes_like(source);
  return {cut_structure(source, frame, poles)};
}

/// The supported part as it is known by its lines: some of them, for a fit takes as long as there are lines.
StandIn lines_like(const setup::Setup& source, const milling::ToolFrame& frame) {
  constexpr Eigen::Index enough = 1000;
  const dynamics::FrequencyAxis axis = frequency_axis(source.response, source, source);
  const Eigen::Index lines = std::min(enough, axis.size());
  milling::SampledStructure felt{{Eigen::VectorXd::LinSpaced(lines, axis.hz(0), axis.hz(axis.size() - 1)), {}},
                                 cut_poles(source, nullptr)};
  const milling::RelativeStructure part = milling::in_tool_axes(modes_like(source), frame);
  for (const double hz : felt.samples.frequency_hz)
    felt.samples.H.push_back(milling::receptance(part, 2.0 * std::numbers::pi * hz));
  return {milling::fitted_structure(felt, frame), static_cast<double>(axis.size()) / static_cast<double>(lines)};
}

/// Seconds that `work` takes; at least so many where the limit of the thread ended it.
struct Took {
  double seconds = 0.0;
  bool over = false;
};

Took time_of(const std::function<void()>& work) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  Took took;
  try {
    work();
  } catch (const core::TimeIsOver&) {
    took.over = true;
  }
  took.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return took;
}

/// The mean over ln n of what a row takes, by Simpson's rule from both ends and the middle: even speeds are denser in
/// it at the top, those that a line adds at the bottom. From the last speed, which is the cheapest as a rule.
Took mean_row(const std::function<void(double rpm)>& row, double from_rpm, double to_rpm) {
  constexpr double first_call_s = 0.05;  // what a first call does besides counts in a short one
  const double middle_rpm = std::sqrt(from_rpm * to_rpm);
  double weight_left = 1.0;
  Took mean;
  for (const double rpm : {to_rpm, middle_rpm, from_rpm}) {
    Took took = time_of([&] { row(rpm); });
    if (!took.over && took.seconds < first_call_s) took = time_of([&] { row(rpm); });
    const double weight = rpm == middle_rpm ? 4.0 / 6.0 : 1.0 / 6.0;
    mean.seconds += took.seconds * (took.over ? weight_left : weight);
    mean.over = took.over;
    if (took.over) return mean;
    weight_left -= weight;
  }
  return mean;
}

using StructureLike = StandIn (*)(const setup::Setup&, const milling::ToolFrame&);

/// The time of so many rows of a structure, on all threads, and of making it; over: at least so much.
Took time_of_charts(const setup::Setup& source, StructureLike like, double rows, double limit_s) {
  if (rows == 0.0) return {};
  const setup::LobesOptions& lobes = *source.lobes;
  const milling::MillingProcess process = setup::milling_process(source);
  const milling::MethodOptions options = method_options(lobes);
  const core::TimeLimit limit(limit_s);
  std::optional<StandIn> made;
  const Took making = time_of([&] { made = like(source, process.frame); });
  if (making.over) return making;
  const auto row = [&](double rpm) {
    if (const auto* sampled = std::get_if<milling::FittedStructure>(&made->structure)) {
      (void)milling::limiting_depth(*sampled, process, rpm, options.stability);
    } else {
      (void)milling::lobe_method(lobes.method, std::get<milling::RelativeStructure>(made->structure), process, options)
          ->limiting_depth(rpm, std::nullopt);
    }
  };
  const Took of_row = mean_row(row, lobes.from_rpm, lobes.to_rpm);
  return {made->longer * making.seconds + rows * of_row.seconds / core::thread_count(), of_row.over};
}

/// The rows of a robust chart: those at the speeds and at their neighbours, and what is changed at each of them.
double robust_rows(const setup::LobesOptions& lobes, double speeds) {
  constexpr double rows_of_each = 2.5, neighbours_of_reach = 4.0;
  const double reach = milling::two_sided_coverage(lobes.robust->confidence) * lobes.robust->uncertainty.frequency;
  const double range = std::log(lobes.to_rpm / lobes.from_rpm) + 2.0 * std::log1p(reach);
  const double neighbours = reach > 0.0 ? neighbours_of_reach * range / std::log1p(reach) : 0.0;
  return rows_of_each * (speeds + neighbours);
}

}  // namespace

ExpectedRows expected_rows(const setup::Setup& source) {
  constexpr double usual = 500.0, least_share = 1.25;  // of the even speeds
  const setup::LobesOptions& lobes = *source.lobes;
  const double speeds =
      std::min(std::max(usual, least_share * lobes.count), 1.0 * lobes.count + setup::most_added(lobes));
  double chart = speeds * (1.0 + static_cast<double>(lobes.compare.size()));
  if (lobes.robust) chart += robust_rows(lobes, speeds);
  if (lobes.map_depths) chart += 0.02 * lobes.count * *lobes.map_depths;
  const double stations = source.path ? static_cast<double>(source.path->positions.size()) : 0.0;
  chart += stations * lobes.count;
  const bool with_robot = setup::carries_tool(source.robot) || (source.robot && !source.contacts.empty());
  if (!source.part || !with_robot) return {chart, 0.0};
  return setup::is_measured(*source.robot) ? ExpectedRows{chart, speeds} : ExpectedRows{2.0 * chart, 0.0};
}

std::optional<LobesForecast> forecast_lobes(const setup::Setup& source, double limit_s) {
  if (!source.lobes || !source.cutting || !source.tool) return std::nullopt;
  try {
    LobesForecast result{expected_rows(source), 0.0, false};
    const Took of_poles = time_of_charts(source, structure_like, result.rows.of_structure, limit_s);
    const Took of_lines = time_of_charts(source, lines_like, result.rows.of_lines, limit_s);
    result.seconds = of_poles.seconds + of_lines.seconds;
    result.at_least = of_poles.over || of_lines.over;
    return result;
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error&) {
    return std::nullopt;
  }
}

}  // namespace thinwall::study
