#pragma once
// Operating points in the time domain, for each structure that the cut may feel.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "milling/chart/operating_point.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/simulation/entry.hpp"
#include "milling/simulation/growth.hpp"
#include "milling/simulation/region_path.hpp"
#include "milling/simulation/simulation.hpp"
#include "setup/machining_setup.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::study {

struct Results;

/// The periodic motion of a stable cut in closed form (milling/forced/forced_vibration.hpp), and how far the simulated
/// one is from it.
struct ForcedAgreement {
  Eigen::Vector3d peak_to_peak_m = Eigen::Vector3d::Zero();  ///< in closed form, tool axes
  double difference = 0.0;  ///< the largest of: the mean force over the peak force; the places at which straight teeth
                            ///< enter and leave, else the peak to peak along an axis, over the largest peak to peak
  double left = 0.0;  ///< |μ| to the power of the periods before the record: of the beginning, what is left in it
};

/// One point on one structure.
struct PointSimulation {
  ChartOf of = ChartOf::part;
  milling::OperatingPoint point;
  double feed_per_tooth_m = 0.0;
  int teeth = 1;
  bool alike = true;  ///< the teeth leave one surface (milling::equal_surfaces())
  milling::SimulatedCut cut;
  milling::SimulatedGrowth growth;  ///< of a small vibration, by the march
  milling::Multiplier lobes;        ///< what multiplier_at() says of it; |μ| NaN where nodes do not suffice to ask
  std::optional<ForcedAgreement> forced;    ///< of a stable point, equal teeth, circular paths and the linear law
  std::vector<milling::Approach> approach;  ///< along feed and normal, of a cut that began at a border
  std::vector<milling::PartSlice> part;     ///< what is left of a part that is kept as a region
  std::vector<double> lag_m;                ///< of a multibody arm: displacement in tool axes before the cut, m

  /// |μ| of the march over that of the lobes, less one: how far the two are apart.
  [[nodiscard]] double growth_difference() const { return growth.modulus / lobes.modulus - 1.0; }
};

/// Throws InputError where [simulation] asks for what cannot be simulated, before anything is computed: without [tool],
/// [cutting] or a feed, with measured lines in place of poles, structures, a contact that opens or an arm with a fault
/// (setup/simulation_faults.hpp), exact paths without a radial depth, arcs behind the tool alone, or without any point
/// and a speed of the case's own. `asked`: points for a simulation that names none.
void require_simulation(const setup::Setup& setup, const std::vector<milling::OperatingPoint>& asked);

/// Simulates every point of setup.simulation on every structure; where it names none those that are `asked` for, else
/// nine tenths and eleven tenths of the limiting depth at the case's own speed; a boundary that is not known well is a
/// warning. What `kept` holds is taken from there. Points share out among the threads. Errors as require_simulation()
/// and simulated_structures(); Interrupted between turns. Cost: see milling::simulate().
[[nodiscard]] std::vector<PointSimulation> simulate_points(const setup::Setup& setup, const Results& results,
                                                           const std::vector<milling::OperatingPoint>& asked,
                                                           Checkpoint& kept);

}  // namespace thinwall::study
