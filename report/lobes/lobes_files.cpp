#include "report/lobes/lobes_files.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "io/results/csv_table.hpp"
#include "milling/direct/stability.hpp"
#include "report/lobes/learned_summary.hpp"
#include "report/lobes/observed_summary.hpp"

namespace thinwall::report {

namespace {

namespace fs = std::filesystem;

/// Every crossing of every speed, so that islands and gaps above the limiting depth are there, too.
void write_crossings(const fs::path& folder, const study::StructureLobes& named) {
  std::vector<double> speed, depth, chatter, change, error;
  std::vector<std::string> kind;
  for (const milling::LobeRow& row : named.lobes.rows) {
    for (const milling::LobePoint& point : row.crossings) {
      speed.push_back(row.spindle_speed_rpm);
      depth.push_back(point.depth_m);
      chatter.push_back(point.chatter_frequency_hz);
      kind.push_back(milling::name(point.kind));
      change.push_back(point.unstable_change);
      error.push_back(point.error_estimate);
    }
  }
  io::write_csv(folder / (core::word_of(named.of) + "_crossings.csv"),
                {{"spindle_speed_rpm", speed},
                 {"depth_m", depth},
                 {"chatter_frequency_hz", chatter},
                 {"bifurcation", kind},
                 {"unstable_change", change},
                 {"error_estimate_relative", error}},
                {"unstable_change: Floquet multipliers that leave the unit circle there as the depth rises; negative: "
                 "that return. A cut is stable where the sum of those below its depth is 0"});
}

/// A column of errors that are known of some row at least; inf stands for one that is not.
void add_error_column(io::Table& table, const std::string& name, const std::vector<study::DepthError>& errors,
                      std::optional<double> study::DepthError::*which) {
  if (std::ranges::none_of(errors, [&](const study::DepthError& e) { return (e.*which).has_value(); })) return;
  std::vector<double> values;
  values.reserve(errors.size());
  for (const study::DepthError& error : errors) values.push_back((error.*which).value_or(HUGE_VAL));
  table.push_back({name, values});
}

/// Limits of one method; with what is robust of them, and what they are off by, where that is known.
void write_chart(const fs::path& file, const milling::Lobes& lobes, const milling::RobustLobes* robust,
                 const std::vector<study::DepthError>& errors) {
  std::vector<double> speed, depth, chatter, error, uncertainty, robust_depth;
  std::vector<std::string> kind, status;
  for (const milling::LobeRow& row : lobes.rows) {
    speed.push_back(row.spindle_speed_rpm);
    depth.push_back(row.limiting_depth_m);
    chatter.push_back(row.chatter_frequency_hz);
    error.push_back(row.error_estimate);
    kind.push_back(milling::name(row.kind));
    status.push_back(milling::name(row.status));
  }
  io::Table table{{"spindle_speed_rpm", speed}, {"limiting_depth_m", depth},        {"chatter_frequency_hz", chatter},
                  {"bifurcation", kind},        {"error_estimate_relative", error}, {"status", status}};
  std::vector<std::string> comments{
      "method: " + lobes.method,
      "rows with status stable_to_depth_limit are stable up to the depth given, the limit of the chart"};
  if (robust != nullptr) {
    for (const milling::RobustRow& row : robust->rows) {
      uncertainty.push_back(row.relative_uncertainty);
      robust_depth.push_back(row.depth_m);
    }
    table.push_back({"relative_uncertainty", uncertainty});
    table.push_back({"robust_depth_m", robust_depth});
    comments.emplace_back(
        "relative_uncertainty: standard, of the limiting depth, first order; 0 where the cut is stable as far "
        "as was looked. robust_depth_m: docs/theory/lobes.md; 0 where the cut is not robust at any depth");
  }
  add_error_column(table, "truncation_m", errors, &study::DepthError::truncation_m);
  add_error_column(table, "noise_deviation_m", errors, &study::DepthError::noise_m);
  add_error_column(table, "identification_low_m", errors, &study::DepthError::low_m);
  add_error_column(table, "identification_high_m", errors, &study::DepthError::high_m);
  if (!errors.empty()) {
    comments.emplace_back(
        "truncation_m: this depth less that with what the part's reduction leaves out. noise_deviation_m: standard, by "
        "the noise of what was measured. First order; inf where it is not known. identification_low_m, "
        "identification_high_m: "
        "95 % of the limits lie between, by the uncertainty of a fitted tool or a learned robot");
  }
  io::write_csv(file, table, comments);
}

void write_map(const fs::path& file, const milling::StabilityMap& map) {
  std::vector<double> speed, depth, modulus;
  for (std::size_t s = 0; s < map.spindle_speeds_rpm.size(); ++s) {
    for (std::size_t d = 0; d < map.depths_m.size(); ++d) {
      speed.push_back(map.spindle_speeds_rpm[s]);
      depth.push_back(map.depths_m[d]);
      modulus.push_back(map.modulus(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(s)));
    }
  }
  io::write_csv(file, {{"spindle_speed_rpm", speed}, {"depth_m", depth}, {"multiplier_modulus", modulus}},
                {"of the largest Floquet multiplier, by contact-phase collocation; stable below 1"});
}

/// The forced motion over the speeds, depth by depth.
void write_forced(const fs::path& file, const std::vector<study::ForcedOverSpeed>& curves) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> depth, speed, surface, force, contact, error;
  std::vector<std::string> verdict;
  for (const study::ForcedOverSpeed& curve : curves) {
    for (const study::ForcedRow& row : curve.rows) {
      const auto& figures = row.figures;
      depth.push_back(curve.depth_m);
      speed.push_back(row.spindle_speed_rpm);
      verdict.emplace_back(figures ? "stable" : "chatter");
      surface.push_back(figures ? figures->surface_location_error_m.value_or(none) : none);
      force.push_back(figures ? figures->peak_force_n : none);
      contact.push_back(figures && figures->contact ? figures->contact->least_n : none);
      error.push_back(figures ? figures->error_estimate : none);
    }
  }
  io::Table table{{"depth_m", depth},
                  {"spindle_speed_rpm", speed},
                  {"verdict", verdict},
                  {"surface_location_error_m", surface, true},
                  {"peak_force_n", force, true}};
  if (std::ranges::any_of(contact, [](double n) { return !std::isnan(n); }))
    table.push_back({"least_contact_force_n", contact, true});
  table.push_back({"error_estimate_relative", error, true});
  io::write_csv(file, table,
                {"a row without figures chatters: no forced motion is seen there. surface_location_error_m: positive "
                 "overcut; empty too where no wall is cut",
                 fmt::format("feed per tooth at every speed: {:.9g} m", curves.front().feed_per_tooth_m)});
}

/// Force and torque over a period of each stable point.
void write_forces(const fs::path& file, const std::vector<study::PointStability>& points) {
  std::vector<double> number, rotation, feed, normal, axis, torque;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].forced) continue;
    const milling::ForcedVibration& forced = *points[i].forced;
    for (Eigen::Index k = 0; k < forced.rotation_rad.size(); ++k) {
      number.push_back(static_cast<double>(i + 1));
      rotation.push_back(forced.rotation_rad(k));
      feed.push_back(forced.force_n(0, k));
      normal.push_back(forced.force_n(1, k));
      axis.push_back(forced.force_n(2, k));
      torque.push_back(forced.torque_n_m(k));
    }
  }
  if (number.empty()) return;
  io::write_csv(
      file,
      {{"point", number},
       {"rotation_rad", rotation},
       {"force_feed_n", feed},
       {"force_normal_n", normal},
       {"force_axis_n", axis},
       {"torque_n_m", torque}},
      {"point: number of the operating point, those that chatter have none. rotation_rad: since the first tooth "
       "entered; a period, which is a tooth's where all are alike. Forces on the tool in its axes"});
}

}  // namespace

void write_lobes(const fs::path& folder, const study::StructureLobes& named) {
  const std::string name = core::word_of(named.of);
  write_chart(folder / (name + ".csv"), named.lobes, named.robust ? &*named.robust : nullptr, named.errors);
  write_crossings(folder, named);
  for (const study::ComparedLobes& other : named.compared)
    write_chart(folder / (name + "_" + other.method + ".csv"), other.lobes, nullptr, {});
  if (named.map) write_map(folder / (name + "_map.csv"), *named.map);
  write_forces(folder / (name + "_forces.csv"), named.points);
  if (!named.observed.empty()) write_observed(folder / (name + "_observed.csv"), observed_summary(named.observed));
  if (named.learned) write_learned(folder / (name + "_learned.csv"), learned_summary(*named.learned));
  if (!named.forced_over_speed.empty()) write_forced(folder / (name + "_forced.csv"), named.forced_over_speed);
}

void write_path(const fs::path& folder, const setup::Setup& source, const study::PathLobes& path) {
  std::vector<double> number, x, y, z, speed, depth, chatter, error;
  std::vector<std::string> kind, status;
  for (std::size_t i = 0; i < path.lobes.size(); ++i) {
    const Eigen::Vector3d& at = source.path->positions[i];
    for (const milling::LobeRow& row : path.lobes[i].rows) {
      number.push_back(static_cast<double>(i + 1));
      x.push_back(at.x());
      y.push_back(at.y());
      z.push_back(at.z());
      speed.push_back(row.spindle_speed_rpm);
      depth.push_back(row.limiting_depth_m);
      chatter.push_back(row.chatter_frequency_hz);
      error.push_back(row.error_estimate);
      kind.push_back(milling::name(row.kind));
      status.push_back(milling::name(row.status));
    }
  }
  io::write_csv(folder / (core::word_of(path.of) + "_path.csv"),
                {{"position", number},
                 {"x_m", x},
                 {"y_m", y},
                 {"z_m", z},
                 {"spindle_speed_rpm", speed},
                 {"limiting_depth_m", depth},
                 {"chatter_frequency_hz", chatter},
                 {"bifurcation", kind},
                 {"error_estimate_relative", error},
                 {"status", status}},
                {"method: " + path.lobes.front().method,
                 "rows with status stable_to_depth_limit are stable up to the depth given, the limit of the chart"});
}

}  // namespace thinwall::report
