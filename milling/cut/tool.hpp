#pragma once
// The cutter, and how it lies in the part's axes.

#include <Eigen/Core>
#include <numbers>
#include <string>
#include <vector>

#include "milling/cut/envelope.hpp"

namespace thinwall::milling {

/// Edges on an envelope, a cylinder by default.
struct Cutter {
  int teeth = 0;                         ///< z ≥ 1
  double diameter_m = 0.0;               ///< D > 0
  std::vector<double> pitches_rad = {};  ///< at the tip, from each tooth to the one ahead of it; empty: equal
  std::vector<double> helices_rad = {};  ///< of each tooth; positive: its upper parts follow its tip; empty: 0
  Envelope envelope = {};
  std::vector<double> runout_m = {};  ///< radial offset of each tooth, outwards positive; empty: none

  /// Mean angle between neighbouring teeth, rad.
  [[nodiscard]] double pitch_rad() const { return 2.0 * std::numbers::pi / teeth; }
  /// Angle from a tooth to the one ahead of it, rad.
  [[nodiscard]] double pitch_rad(int tooth) const {
    return pitches_rad.empty() ? pitch_rad() : pitches_rad[static_cast<std::size_t>(tooth)];
  }
  /// Rotation by which a tooth's edge lags behind its tip per metre of height, 2 tan β / D: of constant lead, whatever
  /// the envelope, so that β is the helix angle where the radius is D/2 and the local one is atan(r lag).
  [[nodiscard]] double lag_rad_per_m(int tooth) const;
  /// True if any tooth has a helix.
  [[nodiscard]] bool has_helix() const;
  /// True if the mean of the force over the depth changes with the depth: a helix, or an envelope that is not straight.
  [[nodiscard]] bool depends_on_depth() const { return has_helix() || !envelope.straight(); }
  /// True if the cut repeats itself with every tooth: equal pitches and equal helices.
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

/// Length of a tooth's edge per height, dS/dz = √(r'² + (r ψ')² + 1) with the lag ψ (Engin & Altintas 2001, Eq. 14):
/// edge forces act per length of edge, K_te dS, while chips are cut per width, K_t h db, db = dz/sin κ.
[[nodiscard]] double edge_length_per_height(const Cutter& cutter, int tooth, double height_m);

/// The frame of a tool whose axis leans forwards, into the feed, by the lead angle (rad): the tool turns about y_T.
/// Engagement, depth and feed of the cut are then meant in the axes of the leaning tool, the depth along its axis.
[[nodiscard]] ToolFrame leaning(const ToolFrame& frame, double lead_rad);

/// Every violation, empty if there is none: teeth ≥ 1, diameter > 0; pitches, if given, one a tooth, above 0 and a full
/// turn together; helices likewise one a tooth, from 0 to 80°; runout one a tooth, finite, below D/2; the envelope's.
[[nodiscard]] std::vector<std::string> validate(const Cutter& cutter);

/// Every violation, empty if there is none: unit length and right angle, both to 1e-9.
[[nodiscard]] std::vector<std::string> validate(const ToolFrame& frame);

}  // namespace thinwall::milling
