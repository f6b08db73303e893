#include "app/observed/coefficients_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>
#include <vector>

#include "case/schema/physical_range.hpp"
#include "case/tool_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/results/csv_table.hpp"
#include "learning/edge_force_fit.hpp"
#include "learning/mean_force_fit.hpp"
#include "setup/milling_process.hpp"

namespace thinwall::app {

namespace {

/// A column with the unit behind its name.
struct Unit {
  const char* ending;
  double factor;
};

constexpr Unit lengths[] = {{"_mm", 1e-3}, {"_m", 1.0}};
constexpr Unit forces[] = {{"_n", 1.0}, {"_kn", 1e3}};
constexpr Unit angle_units[] = {{"_deg", std::numbers::pi / 180.0}, {"_rad", 1.0}};

/// A table with its file's name for messages.
struct Source {
  std::string file;
  io::Table table;

  [[nodiscard]] bool has(const std::string& name) const {
    return std::ranges::count(table, name, &io::Column::name) > 0;
  }

  /// The column of that name in any of the units, SI; empty if there is none.
  template <std::size_t n>
  [[nodiscard]] std::vector<double> column(const std::string& name, const Unit (&units)[n]) const {
    for (const Unit& unit : units) {
      if (!has(name + unit.ending)) continue;
      std::vector<double> values = io::numbers(table, name + unit.ending, file);
      for (double& value : values) value *= unit.factor;
      return values;
    }
    if (has(name)) {
      throw core::DataError(fmt::format("{}: column \"{}\" does not say its unit; call it \"{}{}\" or \"{}{}\"", file,
                                        name, name, units[0].ending, name, units[1].ending));
    }
    return {};
  }

  template <std::size_t n>
  [[nodiscard]] std::vector<double> needed(const std::string& name, const Unit (&units)[n]) const {
    std::vector<double> values = column(name, units);
    if (!values.empty()) return values;
    throw core::DataError(fmt::format("{}: there is no column \"{}{}\" or \"{}{}\"; add it", file, name,
                                      units[0].ending, name, units[1].ending));
  }
};

double diameter_of(const CoefficientsRequest& request) {
  try {
    const double diameter_m = core::parse_quantity(request.diameter, core::kind::length);
    cases::require_physical(core::kind::length, diameter_m);
    return diameter_m;
  } catch (const core::InputError& error) {
    throw core::UsageError("--diameter \"" + request.diameter + "\": " + error.what());
  }
}

/// The tool of --tool, or a plain cylinder; its diameter is 0 where it is not told.
milling::Cutter cutter_of(const CoefficientsRequest& request) {
  if (!request.tool.empty()) return setup::cutter_of(cases::read_tool(request.tool));
  if (request.teeth < 1)
    throw core::UsageError("--teeth is missing: give the number of teeth, or --tool with a file that has [tool]");
  milling::Cutter cutter;
  cutter.teeth = request.teeth;
  if (!request.diameter.empty()) cutter.diameter_m = diameter_of(request);
  return cutter;
}

/// A tool of --tool that can cut what the lines say.
void require_fitting_tool(const milling::Cutter& cutter, const std::vector<learning::MeanForceTest>& tests) {
  if (const auto faults = milling::validate(cutter); !faults.empty())
    throw core::InputError("coefficients: --tool: " + faults.front());
  for (std::size_t i = 0; i < tests.size(); ++i) {
    if (tests[i].depth_m <= cutter.envelope.height_m) continue;
    throw core::InputError(fmt::format(
        "coefficients: cut {} is {:g} mm deep, must be at most the {:g} mm of the tool's length; correct either", i + 1,
        1e3 * tests[i].depth_m, 1e3 * cutter.envelope.height_m));
  }
}

void require_diameter(const milling::Cutter& cutter) {
  if (cutter.diameter_m > 0.0) return;
  throw core::UsageError("--diameter is missing: angles and edges follow by it; give \"10 mm\", or --tool");
}

/// The engagement of every line: slots where no radial depth is given.
std::vector<milling::Engagement> engagements_of(const Source& source, const milling::Cutter& cutter,
                                                std::size_t count) {
  const std::vector<double> radial = source.column("radial_depth", lengths);
  if (radial.empty()) return {count, milling::Engagement{0.0, std::numbers::pi}};
  const auto milling_column = std::ranges::find(source.table, "milling", &io::Column::name);
  const auto* words =
      milling_column == source.table.end() ? nullptr : std::get_if<std::vector<std::string>>(&milling_column->values);
  if (words == nullptr)
    throw core::DataError(source.file + ": radial depths need a column \"milling\" with up or down; add it");
  require_diameter(cutter);
  std::vector<milling::Engagement> list;
  for (std::size_t i = 0; i < radial.size(); ++i) {
    const std::string& word = (*words)[i];
    if (word != "up" && word != "down")
      throw core::DataError(fmt::format("{}, cut {}: milling \"{}\"; write up or down", source.file, i + 1, word));
    list.push_back(milling::engagement_of(
        cutter, radial[i], word == "up" ? milling::MillingDirection::up : milling::MillingDirection::down));
  }
  return list;
}

/// The lines of the table: each as a mean force.
std::vector<learning::MeanForceTest> tests_of(const Source& source, const milling::Cutter& cutter,
                                              const std::string& on) {
  const auto feeds = source.needed("feed_per_tooth", lengths), depths = source.needed("depth", lengths);
  const auto x = source.needed("force_feed", forces), y = source.needed("force_normal", forces),
             z = source.needed("force_axis", forces);
  const auto engagements = engagements_of(source, cutter, feeds.size());
  const double sign = on == "part" ? -1.0 : 1.0;
  std::vector<learning::MeanForceTest> tests;
  for (std::size_t i = 0; i < feeds.size(); ++i)
    tests.push_back({engagements[i], depths[i], feeds[i], sign * Eigen::Vector3d(x[i], y[i], z[i])});
  return tests;
}

std::string line_of(const char* name, const learning::FittedCoefficient& c, double factor, const char* unit) {
  return fmt::format("{:<4}= \"{:.6g} {}\"   # ± {:.3g} with 95 %\n", name, c.value * factor, unit,
                     c.half_interval * factor);
}

/// A case takes no edge coefficient below 0, which friction on the edge cannot give.
std::string edge_line_of(const char* name, const learning::FittedCoefficient& c) {
  std::string line = line_of(name, c, 1e-3, "N/mm");
  if (c.value >= 0.0) return line;
  return fmt::format("# {}   # a case takes none below 0, {}; left out it is 0\n", line.substr(0, line.size() - 1),
                     -c.value <= c.half_interval ? "and 0 lies within the interval"
                                                 : "though 0 lies outside the interval: check the forces' zero");
}

void require_cutting(const learning::FittedCoefficient& K_t) {
  if (!std::isfinite(K_t.value))
    throw core::InputError("K_t is no finite number; look for a force or a feed in another unit");
  if (K_t.value > 0.0) return;
  throw core::InputError(
      fmt::format("K_t is {:.6g} N/mm^2, must be above 0; the forces seem to act on the part (--on "
                  "part), or an axis is reversed",
                  K_t.value * 1e-6));
}

/// [cutting] of any of the fits.
template <class Fit>
std::string cutting_text(const Fit& fit) {
  require_cutting(fit.K_t);
  return "[cutting]\n" + line_of("Kt", fit.K_t, 1e-6, "N/mm^2") + line_of("Kr", fit.K_r, 1e-6, "N/mm^2") +
         line_of("Ka", fit.K_a, 1e-6, "N/mm^2") + edge_line_of("Kte", fit.K_te) + edge_line_of("Kre", fit.K_re) +
         edge_line_of("Kae", fit.K_ae);
}

/// The fit with edge coefficients per length of edge, which a helix makes longer than the depth.
learning::CoefficientFit per_edge_length(learning::CoefficientFit fit, const milling::Cutter& cutter) {
  if (!cutter.has_helix()) return fit;
  double length = 0.0;
  for (int tooth = 0; tooth < cutter.teeth; ++tooth)
    length += milling::edge_length_per_height(cutter, tooth, 0.0) / cutter.teeth;
  for (learning::FittedCoefficient* c : {&fit.K_te, &fit.K_re, &fit.K_ae})
    *c = {c->value / length, c->deviation / length, c->half_interval / length};
  return fit;
}

/// The equations of mean forces hold the chip and the edge of a cylinder.
void require_cylinder(const milling::Cutter& cutter) {
  if (learning::is_cylinder(cutter)) return;
  throw core::InputError(
      "coefficients: --tool has another end than a cylinder, and mean forces are those of a cylinder; give a tool with "
      "a "
      "flat end with which the forces were measured");
}

std::string mean_force_text(const milling::Cutter& cutter, const std::vector<learning::MeanForceTest>& tests) {
  require_cylinder(cutter);
  const learning::CoefficientFit fit = per_edge_length(learning::fit_mean_forces(cutter.teeth, tests), cutter);
  return fmt::format("# {} cuts; R2 {:.5f}, residual {:.3g} N, condition {:.3g}\n", tests.size(), fit.r_squared,
                     fit.residual_n, fit.condition) +
         cutting_text(fit);
}

std::string runout_text(const std::vector<learning::FittedCoefficient>& runout) {
  std::string values, intervals;
  for (const learning::FittedCoefficient& offset : runout) {
    values += fmt::format("{}\"{:.4g} um\"", values.empty() ? "" : ", ", 1e6 * offset.value);
    if (offset.half_interval > 0.0) intervals += fmt::format(" {:.2g}", 1e6 * offset.half_interval);
  }
  return fmt::format("[tool]\nrunout = [{}]   # ±{} um with 95 %; the last one from the sum 0\n", values, intervals);
}

std::string edge_force_text(const milling::Cutter& cutter, const std::vector<learning::ForceRecord>& records) {
  require_diameter(cutter);
  const learning::EdgeForceFit fit = learning::fit_edge_forces(cutter, records);
  if (!fit.converged) {
    throw core::NumericalError(fmt::format(
        "coefficients: the search for the runout ends unfinished after {} steps (R2 {:.3f}); with an R2 far "
        "below 1 check that angles are those of the first tooth's tip from the normal, in the direction of "
        "rotation, else give more angles or leave out the column of angles",
        fit.steps, fit.r_squared));
  }
  return fmt::format("# {} cuts, {} degrees of freedom; R2 {:.5f}, residual {:.3g} N, condition {:.3g}\n",
                     records.size(), fit.degrees_of_freedom, fit.r_squared, fit.residual_n, fit.condition) +
         cutting_text(fit) + (cutter.teeth > 1 ? runout_text(fit.runout_m) : "");
}

}  // namespace

std::string coefficients_of(const CoefficientsRequest& request) {
  if (request.on != "tool" && request.on != "part")
    throw core::UsageError("--on \"" + request.on + "\": write tool or part");
  const milling::Cutter cutter = cutter_of(request);
  const Source source{request.forces, io::read_csv(request.forces)};
  const std::vector<learning::MeanForceTest> tests = tests_of(source, cutter, request.on);
  if (!request.tool.empty()) require_fitting_tool(cutter, tests);
  const std::vector<double> angles = source.column("angle", angle_units);
  return angles.empty() ? mean_force_text(cutter, tests)
                        : edge_force_text(cutter, learning::records_of(tests, Eigen::Map<const Eigen::VectorXd>(
                                                                                  angles.data(), std::ssize(angles))));
}

}  // namespace thinwall::app
