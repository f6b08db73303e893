#include "posture/workspace_map.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/parallel.hpp"
#include "core/progress.hpp"
#include "posture/hull.hpp"

namespace thinwall::posture {

namespace {

/// The depth at the best speed.
MappedDepth mapped_depth(const PosturePrediction& at, PostureCut cut, int draws) {
  Eigen::Index best = 0;
  if (cut.spindle_speeds_rpm.size() > 1) limiting_depths(expected_modes(at), cut, at.rest).maxCoeff(&best);
  cut.spindle_speeds_rpm = {cut.spindle_speeds_rpm[static_cast<std::size_t>(best)]};
  const DepthBand band = depth_band_from_draws(at, cut, draws);
  return {cut.spindle_speeds_rpm.front(), {band.depth(0), band.low(0), band.high(0)}};
}

}  // namespace

Eigen::MatrixXd grid_within_hull(const Eigen::MatrixXd& places, int count) {
  const double size = std::pow(static_cast<double>(count), static_cast<double>(places.cols()));
  if (count < 2 || size > 1e6)
    throw core::InputError("a grid of " + std::to_string(count) + " values in each of " +
                           std::to_string(places.cols()) +
                           " columns, must be at least 2, and at most a million places");
  const Eigen::RowVectorXd low = places.colwise().minCoeff(), high = places.colwise().maxCoeff();
  std::vector<Eigen::RowVectorXd> inside;
  for (long number = 0; number < std::lround(size); ++number) {
    core::check_interrupt();
    Eigen::RowVectorXd at = low;
    long rest = number;
    for (Eigen::Index c = places.cols() - 1; c >= 0; --c, rest /= count)
      at(c) += (high(c) - low(c)) * static_cast<double>(rest % count) / (count - 1);
    if (distance_from_hull(places, at.transpose()) == 0.0) inside.push_back(at);
  }
  Eigen::MatrixXd grid(std::ssize(inside), places.cols());
  for (std::size_t i = 0; i < inside.size(); ++i) grid.row(static_cast<Eigen::Index>(i)) = inside[i];
  return grid;
}

MappedPlace map_place(const Predictor& predictor, const Place& place, const std::optional<PostureCut>& cut, int draws) {
  const PosturePrediction at = predictor.predict(place);
  if (at.modes.empty()) throw core::InputError("no mode is predicted at a place of the map; learn from more postures");
  const PredictedMode& first =
      *std::ranges::min_element(at.modes, {}, [](const PredictedMode& mode) { return mode.mean(0); });
  MappedPlace result{at.from_hull, {}, {}};
  const double spread = 1.96 * first.deviation(0);
  result.first_hz = {std::exp(first.mean(0)), std::exp(first.mean(0) - spread), std::exp(first.mean(0) + spread)};
  if (cut) result.depth = mapped_depth(at, *cut, draws);
  return result;
}

std::vector<MappedPlace> workspace_map(const Predictor& predictor, const std::vector<Place>& places,
                                       const std::optional<PostureCut>& cut, int draws) {
  std::vector<MappedPlace> map(places.size());
  core::Progress progress("places of the map", places.size());
  core::parallel_for(places.size(), [&](std::size_t i) {
    map[i] = map_place(predictor, places[i], cut, draws);
    progress.step();
  });
  return map;
}

}  // namespace thinwall::posture
