#pragma once
// The surface that the edges of a cutter lie on: flat, ball and bull-nose ends, cones, tapers.

#include <limits>
#include <string>
#include <vector>

namespace thinwall::milling {

/// The meridian of the general end mill of Engin & Altintas 2001 (part I, Fig. 2), six of its seven parameters; the
/// seventh is the diameter D of the cutter, where tip cone and side would meet. From the tip: a cone at `tip_angle`
/// to the plane across the axis, an arc, a side at `taper` to the axis. All zero: a cylinder.
struct Envelope {
  double corner_radius_m = 0.0;                               ///< R ≥ 0
  double corner_radial_m = 0.0;                               ///< R_r: centre of the arc from the axis
  double corner_axial_m = 0.0;                                ///< R_z: centre of the arc above the tip
  double tip_angle_rad = 0.0;                                 ///< α, 0 to below π/2
  double taper_rad = 0.0;                                     ///< β, −π/2 to π/2, positive: wider above
  double height_m = std::numeric_limits<double>::infinity();  ///< h > 0 of the edges; no deeper cut is possible

  /// One angle κ all along the edge, however long it is: a cylinder or a taper.
  [[nodiscard]] bool straight() const { return corner_radius_m == 0.0 && tip_angle_rad == 0.0; }
};

/// A ball of that diameter.
[[nodiscard]] Envelope ball_end(double diameter_m);
/// A cylinder with a rounded corner.
[[nodiscard]] Envelope bull_nose(double diameter_m, double corner_radius_m);

/// A point of the meridian. κ is the axial immersion angle, from the axis to the outward normal
/// n = sin κ r − cos κ z_T: π/2 on a cylinder, 0 at the tip of a ball.
struct MeridianPoint {
  double radius_m = 0.0;
  double kappa_rad = 0.0;
};

/// A stretch of the meridian between heights: straight, or of the corner's arc, on which
/// z = R_z − R cos κ, r = R_r + R sin κ.
struct MeridianPiece {
  double from_m = 0.0;
  double to_m = 0.0;
  double kappa_rad = 0.0;        ///< of a straight piece
  double radius_m = 0.0;         ///< of a straight piece, at `from_m`
  double corner_radius_m = 0.0;  ///< R; 0 of a straight piece
  double corner_radial_m = 0.0;
  double corner_axial_m = 0.0;

  /// A cone or a cylinder.
  [[nodiscard]] bool straight() const { return corner_radius_m == 0.0; }
  /// The point of the meridian at a height of the piece, m.
  [[nodiscard]] MeridianPoint at(double height_m) const;
};

/// The pieces from the tip to the height of the edges, in order, none of zero height. With the cone z = r tan α and the
/// side r = D/2 (1 − tan α tan β) + z tan β, the arc begins where it leaves the cone outwards and ends where it first
/// meets the side (Engin & Altintas 2001, Eq. 1-5). The envelope must be valid.
[[nodiscard]] std::vector<MeridianPiece> meridian(const Envelope& envelope, double diameter_m);

/// r and κ at a height, 0 ≤ z ≤ h, m; a joint belongs to the piece above it.
[[nodiscard]] MeridianPoint at_height(const Envelope& envelope, double diameter_m, double height_m);

/// A point of Gauss's rule along the meridian: ∫ f db ≈ Σ width_m f, with db = dz / sin κ the width of cut.
struct EdgeSlice {
  double height_m = 0.0;
  double kappa_rad = 0.0;
  double width_m = 0.0;
};

/// Slices of a piece between two of its heights, in steps of the meridian, so that the tip of a ball, where dz/db
/// vanishes, is smooth. `points` ≥ 1 of them.
[[nodiscard]] std::vector<EdgeSlice> edge_slices(const MeridianPiece& piece, double low_m, double high_m, int points);

/// Points that give products of two sines of φ and three of κ to 1e-10 on an edge that turns by `turn_rad` between
/// heights of the piece: half the change of their phase, and six.
[[nodiscard]] int exact_points(const MeridianPiece& piece, double low_m, double high_m, double turn_rad);

/// Every violation, empty if there is none: numbers in their ranges, an arc that meets cone and side in this order, a
/// radius that is nowhere negative.
[[nodiscard]] std::vector<std::string> validate(const Envelope& envelope, double diameter_m);

}  // namespace thinwall::milling
