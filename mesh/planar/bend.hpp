#pragma once
// A flat part bent about a cylinder: curved walls and cylinder sectors from plates.

#include <Eigen/Core>
#include <string>
#include <vector>

namespace thinwall::mesh {

/// Points, one in each row, m.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The bend, in part axes: coordinate `along` (0 x, 1 y, 2 z) becomes the arc length on the mid-surface, `through` the
/// radial coordinate, and the third one stays. With s = x_along − start, w = x_through − middle:
///
///     x_along   = start  + (R + w) sin(s / R)
///     x_through = middle + (R + w) cos(s / R) − R
///
/// The line s = 0 stays where it is; the centre of curvature lies at x_through = middle − R. The Jacobian determinant
/// is (R + w) / R, positive inside |w| < |R|. A negative R bends to the other side.
struct Bend {
  double radius_m = 0.0;  ///< R, of the mid-surface
  int along = 0;
  int through = 2;
  double start_m = 0.0;   ///< x_along of the line that stays where it is
  double middle_m = 0.0;  ///< x_through of the mid-surface
};

/// The faults that keep the positions (nodes × 3, m) from being bent, one line each: axes that are not two of 0, 1, 2;
/// a radius that is not beyond the largest |w|, half the thickness of a wall with its middle at middle_m; 360 degrees
/// or more.
[[nodiscard]] std::vector<std::string> violations(const Bend& bend, const Positions& positions);

/// The position in the bent part of a point x of the flat part; m, part axes.
[[nodiscard]] Eigen::Vector3d bent(const Bend& bend, const Eigen::Vector3d& x);
/// The position in the flat part of a point x of the bent part, which lies within ±180 degrees of the line s = 0; m,
/// part axes.
[[nodiscard]] Eigen::Vector3d unbent(const Bend& bend, const Eigen::Vector3d& x);

/// The rotation at a point of the flat part: column k is the direction that axis k of the flat part has after bending.
[[nodiscard]] Eigen::Matrix3d rotation_at(const Bend& bend, const Eigen::Vector3d& x);

/// Moves all positions, such as LagrangeNodes::positions of a flat mesh, to the bent part. Elements of order p then
/// follow the cylinder at their nodes. Throws InputError with all violations in one line. Cost O(positions).
void bend(const Bend& bend, Positions& positions);

}  // namespace thinwall::mesh
