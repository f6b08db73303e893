#pragma once
// Operating points in the time domain, for each structure that the cut may feel.

#include <vector>

#include "milling/chart/operating_point.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/simulation/growth.hpp"
#include "milling/simulation/simulation.hpp"
#include "setup/machining_setup.hpp"
#include "study/lobes/chart_of.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// The paths of teeth.
enum class ToothPaths {
  circular,  ///< on circles, between fixed angles of entry and exit (milling/simulation/circular_cut.hpp)
  exact,     ///< on their real paths (milling/simulation/exact_path.hpp)
};

/// The points that are to be simulated, and in which way.
struct SimulationRequest {
  std::vector<milling::OperatingPoint> points;
  ToothPaths paths = ToothPaths::circular;
  milling::SimulationOptions options;
};

/// One point on one structure.
struct PointSimulation {
  ChartOf of = ChartOf::part;
  milling::OperatingPoint point;
  double feed_per_tooth_m = 0.0;
  int teeth = 1;
  milling::SimulatedCut cut;
  milling::SimulatedGrowth growth;  ///< of a small vibration, by the march
  milling::Multiplier lobes;        ///< what multiplier_at() says of it

  /// |μ| of the march over that of the lobes, less one: how far the two are apart.
  [[nodiscard]] double growth_difference() const { return growth.modulus / lobes.modulus - 1.0; }
};

/// Simulates every point on the part alone, the supported part, or the tool where there is no part. `results` are those
/// of run() without lobes. Throws InputError without points, [tool], [cutting] or a feed; where a structure has no
/// poles (lines of a measured FRF need a fit by modes first); where exact paths need a radial depth; for bad options;
/// and Interrupted between turns. Cost: see milling::simulate().
[[nodiscard]] std::vector<PointSimulation> simulate_points(const setup::Setup& setup, const Results& results,
                                                           const SimulationRequest& request);

}  // namespace thinwall::study

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 2> words<study::ToothPaths>{"circular", "exact"};

}  // namespace thinwall::core
