#include "study/simulation/amplitude_map.hpp"

#include <limits>

#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/simulation/simulation.hpp"
#include "setup/milling_process.hpp"
#include "setup/simulation_options.hpp"
#include "study/kept/kept_simulation.hpp"
#include "study/results.hpp"
#include "study/simulation/felt_structures.hpp"

namespace thinwall::study {

namespace {

std::vector<double> even_depths(const setup::SimulationMap& wanted) {
  std::vector<double> depths;
  depths.reserve(static_cast<std::size_t>(wanted.depths));
  for (int i = 1; i <= wanted.depths; ++i) depths.push_back(wanted.depth_limit_m * i / wanted.depths);
  return depths;
}

AmplitudeMap map_of(const setup::Setup& setup, ChartOf of, const milling::RelativeStructure& structure) {
  const setup::SimulationMap& wanted = *setup.simulation->map;
  const milling::MillingProcess process = setup::milling_process(setup);
  const milling::ForceLaw law = setup::force_law(*setup.cutting, process);
  const milling::SimulationOptions options = setup::map_options(wanted);
  const double feed = *setup::feed_per_tooth(setup);
  AmplitudeMap map{of,
                   milling::spindle_speeds(wanted.from_rpm, wanted.to_rpm, wanted.speeds),
                   even_depths(wanted),
                   Eigen::MatrixXd::Constant(wanted.depths, wanted.speeds, std::numeric_limits<double>::infinity()),
                   Eigen::MatrixXd::Ones(wanted.depths, wanted.speeds),
                   Eigen::MatrixXi::Zero(wanted.depths, wanted.speeds)};
  const auto count = static_cast<std::size_t>(map.peak_to_peak_m.size());
  core::Progress progress("points of the map", count);
  core::parallel_for(count, [&](std::size_t i) {
    const std::size_t depth = i % map.depths_m.size(), speed = i / map.depths_m.size();
    const milling::SimulatedCut cut =
        milling::simulate(structure, process, law, {map.spindle_speeds_rpm[speed], map.depths_m[depth], feed}, options,
                          [](double /*share*/) { core::check_interrupt(); });
    const auto entry = static_cast<Eigen::Index>(i);  // columns are speeds
    if (cut.status != milling::SimulationStatus::overflowed) {
      map.peak_to_peak_m(entry) = cut.displacement_m.range().maxCoeff();
      map.share_without_contact(entry) = cut.share_without_contact;
    }
    map.unsettled(entry) = cut.status == milling::SimulationStatus::unsettled ? 1 : 0;
    progress.step();
  });
  return map;
}

}  // namespace

std::vector<AmplitudeMap> amplitude_maps(const setup::Setup& setup, const Results& results, Checkpoint& kept) {
  std::vector<AmplitudeMap> maps;
  if (!setup.simulation || !setup.simulation->map) return maps;
  for (const auto& felt : felt_structures(setup, results))
    maps.push_back(map_of_checkpoint(kept, felt.of, [&] { return map_of(setup, felt.of, felt.structure); }));
  return maps;
}

}  // namespace thinwall::study
