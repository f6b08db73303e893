#include "milling/cut/edge.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

namespace {

/// body(piece, low, high) for what of each piece lies between two heights, m.
template <class Body>
void each_piece(const EdgeShape& shape, double low, double high, const Body& body) {
  for (const MeridianPiece& piece : shape.pieces) {
    const double from = std::max(piece.from_m, low * shape.depth_m);
    const double to = std::min(piece.to_m, high * shape.depth_m);
    if (to > from) body(piece, from, to);
  }
}

}  // namespace

std::vector<double> EdgeShape::joints() const {
  std::vector<double> shares{0.0};
  for (const MeridianPiece& piece : pieces) shares.push_back(piece.to_m / depth_m);
  shares.back() = 1.0;
  return shares;
}

EdgeShape edge_shape(const Cutter& cutter, double depth_m) {
  const Envelope& envelope = cutter.envelope;
  if (!(depth_m <= envelope.height_m) || !(depth_m > 0.0 || envelope.straight())) {
    std::ostringstream text;
    text << "cut: depth " << depth_m << " m, must be above 0 and at most the height of the cutter's edges, "
         << envelope.height_m << " m; correct the depth, or the depth limit of the search";
    throw core::InputError(text.str());
  }
  if (envelope.straight()) {
    MeridianPiece whole = meridian(envelope, cutter.diameter_m).front();
    whole.to_m = 1.0;
    return {{whole}, 1.0};
  }
  EdgeShape shape{meridian(envelope, cutter.diameter_m), depth_m};
  std::erase_if(shape.pieces, [&](const MeridianPiece& p) { return p.from_m >= depth_m; });
  shape.pieces.back().to_m = depth_m;
  return shape;
}

Eigen::Matrix3d edge_matrix(const EdgeShape& shape, const CuttingCoefficients& coefficients, double tip_rad,
                            double lag_rad, double low, double high) {
  const double lag_per_m = lag_rad / shape.depth_m;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  each_piece(shape, low, high, [&](const MeridianPiece& piece, double from, double to) {
    if (piece.straight()) {
      sum += (to - from) / (shape.depth_m * std::sin(piece.kappa_rad)) *
             mean_directional_matrix_on(coefficients, piece.kappa_rad, tip_rad - to * lag_per_m,
                                        tip_rad - from * lag_per_m);
      return;
    }
    const int points = exact_points(piece, from, to, lag_per_m * (to - from));
    for (const EdgeSlice& slice : edge_slices(piece, from, to, points)) {
      sum += slice.width_m / shape.depth_m *
             directional_matrix_on(coefficients, slice.kappa_rad, tip_rad - slice.height_m * lag_per_m);
    }
  });
  return sum;
}

std::vector<EdgeWeight> edge_weights(const EdgeShape& shape, int points, double low, double high) {
  std::vector<EdgeWeight> weights;
  each_piece(shape, low, high, [&](const MeridianPiece& piece, double from, double to) {
    for (const EdgeSlice& slice : edge_slices(piece, from, to, points))
      weights.push_back({slice.height_m / shape.depth_m, slice.kappa_rad, slice.width_m / shape.depth_m});
  });
  return weights;
}

Eigen::Matrix3d arc_mean(const MillingProcess& process, const Engagement& arc, double depth_m) {
  constexpr int points = 9;  // exact_points() of a quarter of a circle
  const EdgeShape shape = edge_shape(process.cutter, depth_m);
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const EdgeWeight& w : edge_weights(shape, points, 0.0, 1.0)) {
    for (int j = 0; j < process.cutter.teeth; ++j) {
      sum += w.weight / process.cutter.teeth *
             mean_directional_matrix_on(coefficients(process, j), w.kappa_rad, arc.entry_rad, arc.exit_rad);
    }
  }
  return sum;
}

}  // namespace thinwall::milling
