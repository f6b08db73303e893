#pragma once
// First frequency and stable depth over a workspace, with their bands.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "posture/bands.hpp"
#include "posture/predictor.hpp"

namespace thinwall::posture {

/// A value between whose `low` and `high` 95 % of the possible ones lie.
struct Banded {
  double value = 0.0, low = 0.0, high = 0.0;
};

/// The stable depth at a place, m, and the speed that it belongs to.
struct MappedDepth {
  double spindle_speed_rpm = 0.0;
  Banded depth_m;
};

/// A place of the map.
struct MappedPlace {
  double from_hull = 0.0;            ///< of the tapped postures, scaled coordinates: > 0 is extrapolation
  Banded first_hz;                   ///< of the mode of lowest frequency
  std::optional<MappedDepth> depth;  ///< of a cut
};

/// The places of an even grid with `count` ≥ 2 values a column, between the least and the largest of the rows of
/// `places`, that lie within their convex hull: one a row, the last column changing first. Throws InputError for a
/// smaller count, and for a grid of more than a million places. Cost: a distance_from_hull() a place of the grid.
[[nodiscard]] Eigen::MatrixXd grid_within_hull(const Eigen::MatrixXd& places, int count);

/// First frequency e^{m ∓ 1.96 σ} of the lowest mode's ln f and, with a cut, the limiting depth at the speed at which
/// that of the expected modes is largest (of several speeds), with its band from `draws` ≥ 40 draws. Throws InputError
/// for a place at which no mode is predicted, and as depth_band_from_draws(). Cost: predict(), a limiting depth a
/// speed, and one a draw.
[[nodiscard]] MappedPlace map_place(const Predictor& predictor, const Place& place,
                                    const std::optional<PostureCut>& cut, int draws = 60);

/// The map of all places, shared out among core::thread_count() threads.
[[nodiscard]] std::vector<MappedPlace> workspace_map(const Predictor& predictor, const std::vector<Place>& places,
                                                     const std::optional<PostureCut>& cut, int draws = 60);

}  // namespace thinwall::posture
