#include "milling/observed/chatter_probability.hpp"

#include <algorithm>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "milling/direct/stability.hpp"

namespace thinwall::milling {

std::vector<Cut> drawn_cuts(const Cut& nominal, const Uncertainty& uncertainty, int count, unsigned seed) {
  if (count < 1) throw core::InputError("draws of a cut: " + std::to_string(count) + "; take at least 1");
  const std::vector<UncertainParameter> parameters = uncertain_parameters(nominal, uncertainty);
  std::mt19937 random(seed);
  std::vector<Cut> draws;
  draws.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    draws.push_back(cut_at(nominal, parameters, standard_normal(std::ssize(parameters), random)));
  return draws;
}

std::vector<double> chatter_probabilities(const std::vector<Cut>& draws, const std::vector<OperatingPoint>& points,
                                          const StabilityOptions& options) {
  if (draws.empty()) throw core::InputError("probability of chatter: there are no draws; give at least one");
  std::vector<double> probability(points.size());
  core::Progress progress("probability of chatter", points.size());
  core::parallel_for(points.size(), [&](std::size_t i) {
    const auto chatters = std::ranges::count_if(draws, [&](const Cut& draw) {
      const double rpm = points[i].spindle_speed_rpm;
      return multiplier_at(draw.structure, process_at(draw, rpm), rpm, points[i].depth_m, options).modulus > 1.0;
    });
    probability[i] = static_cast<double>(chatters) / static_cast<double>(draws.size());
    progress.step();
  });
  return probability;
}

}  // namespace thinwall::milling
