#pragma once
// The time that the charts of a set-up will take, from some of their rows computed with modes that stand in for the
// part's.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "milling/chart/operating_point.hpp"
#include "setup/machining_setup.hpp"
#include "study/lobes/stand_in.hpp"

namespace thinwall::study {

/// Numbers of rows.
struct ExpectedRows {
  double of_structure = 0.0;  ///< of part or tool as cut_structure() has them, and supported by a robot that has poles
  double of_lines = 0.0;      ///< of the supported part where it is known by its receptances alone
};

/// The rows and the time of the stage of the lobes on core::thread_count() threads.
struct LobesForecast {
  ExpectedRows rows;
  double seconds = 0.0;
  bool at_least = false;     ///< a row was given up: all of them take as long or longer
  std::string refusal = {};  ///< milling::require_range()'s, of the tool's lines; empty: none
};

/// The rows of all charts: with and without the robot, along a path, of methods to compare with, of a map, and those
/// that a robust chart needs. A line is taken to need five hundred speeds, a quarter more than the even ones
/// at least, as far as they may be added. The set-up must have lobes.
[[nodiscard]] ExpectedRows expected_rows(const setup::Setup& source);

/// The seconds that a forecast may take for each structure that a chart is of, as a rule.
inline constexpr double forecast_limit_s = 2.5;

/// Gives the modes of the part for a forecast; none where they are not known.
using StandInModesOf = std::function<std::optional<StandInModes>()>;

/// The time of expected_rows(), from the mean time of a row of its method at up to twenty speeds, and of the fit of
/// lines. What is known is taken as it is: cut, tool, and the lines of a measured tip. The part's modes, alone and with
/// the robot, are those of `modes_of`, as rehearsed_modes() has them, which is called once if the lines are not
/// refused. Without it they have the density of those of a plate of the part's extent and thickness (Cremer, Heckl &
/// Petersson 2005) and its mass, for the supported part, too. It is right within a factor of three as a rule. Empty
/// where there is no chart, or where no row can be computed, which the run will tell; `refusal` alone is set where the
/// tool's lines do not reach at an even speed of the chart, at the case's own or at one of the `points`. Messages are
/// dropped: the run says them. Throws Interrupted. Cost: that of `modes_of`, of the rows and of a fit, `limit_s` at
/// most for each structure, of which there are one or two, but for steps that do not look at interrupts.
[[nodiscard]] std::optional<LobesForecast> forecast_lobes(const setup::Setup& source, double limit_s = forecast_limit_s,
                                                          const std::vector<milling::OperatingPoint>& points = {},
                                                          const StandInModesOf& modes_of = {});

}  // namespace thinwall::study
