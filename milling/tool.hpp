#pragma once
// The cutter, and how it lies in the part's axes.

#include <Eigen/Core>
#include <numbers>
#include <string>
#include <vector>

namespace thinwall::milling {

/// A cylindrical cutter.
struct Cutter {
  int teeth = 0;                         ///< z ≥ 1
  double diameter_m = 0.0;               ///< D > 0
  std::vector<double> pitches_rad = {};  ///< at the tip, from each tooth to the one ahead of it; empty: equal
  std::vector<double> helices_rad = {};  ///< of each tooth; positive: its upper parts follow its tip; empty: 0

  /// Mean angle between neighbouring teeth, rad.
  [[nodiscard]] double pitch_rad() const { return 2.0 * std::numbers::pi / teeth; }
  [[nodiscard]] double pitch_rad(int tooth) const {
    return pitches_rad.empty() ? pitch_rad() : pitches_rad[static_cast<std::size_t>(tooth)];
  }
  /// Rotation by which a tooth's edge lags behind its tip per metre of height, 2 tan β / D.
  [[nodiscard]] double lag_rad_per_m(int tooth) const;
  [[nodiscard]] bool has_helix() const;
  /// Whether the cut repeats itself with every tooth: equal pitches and equal helices.
  [[nodiscard]] bool equal_teeth() const;
};

/// The frame of the cut, in the part's axes. `feed` (x_T) is the direction in which the tool moves relative to the
/// part, `axis` (z_T) points from the tip to the spindle; the normal is y_T = z_T × x_T. The spindle turns clockwise
/// seen from above, as a right-hand cutter does, so a tooth at angle φ stands at
///
///     r = sin φ x_T + cos φ y_T   and moves along   t = cos φ x_T − sin φ y_T            (angles as in Altintas &
///     Budak 1995)
struct ToolFrame {
  Eigen::Vector3d feed = Eigen::Vector3d::UnitX();  ///< unit vector
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector, orthogonal to `feed`

  /// Columns x_T, y_T, z_T: R v_T = v in part axes.
  [[nodiscard]] Eigen::Matrix3d rotation() const;
};

/// Every violation, empty if there is none: teeth ≥ 1, diameter > 0; pitches, if given, one a tooth, above 0 and a full
/// turn together; helices likewise one a tooth, from 0 to 80°.
[[nodiscard]] std::vector<std::string> validate(const Cutter& cutter);

/// Every violation, empty if there is none: unit length and right angle, both to 1e-9.
[[nodiscard]] std::vector<std::string> validate(const ToolFrame& frame);

}  // namespace thinwall::milling
