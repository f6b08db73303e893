#pragma once
// A plane region of material from which areas are taken away.

#include <Eigen/Core>
#include <memory>
#include <vector>

namespace thinwall::milling {

/// A closed polygon: its corners in order, m; the last is joined to the first.
using Outline = std::vector<Eigen::Vector2d>;

/// The material on a ray from the centre of a tool, m.
struct RayMaterial {
  double within_m = 0.0;    ///< length of the ray within the material, up to the radius
  bool tip_within = false;  ///< the end of the radius lies in the material
  double beyond_m = 0.0;  ///< from the centre to the nearest material beyond the radius; the reach where there is none
};

/// The region of the part in a plane of the cut (the eraser of matter of Huynh 2017, Section 4), in square cells: each
/// holds the polygons of its share, so that what a tooth sweeps costs only the few cells that it meets. Coordinates are
/// whole multiples of 0.1 nm, for which the differences of polygons by the library Clipper are exact but for rounding
/// of the points where edges cross.
class PartRegion {
 public:
  /// The region inside an odd number of the outlines, in cells of this side, m. Throws InputError for no outline, a
  /// number that is not finite, a side that is not positive, or more than ten million cells.
  PartRegion(const std::vector<Outline>& outlines, double cell_m);
  ~PartRegion();
  PartRegion(PartRegion&&) noexcept;
  PartRegion& operator=(PartRegion&&) noexcept;

  /// Takes the inside of a polygon away. Cost: a difference of polygons in each cell with material that it meets.
  void erase(const Outline& polygon);

  /// The material on the ray from `centre` along the unit vector `direction`: up to `radius_m`, and beyond it up to
  /// `reach_m`.
  [[nodiscard]] RayMaterial on_ray(const Eigen::Vector2d& centre, const Eigen::Vector2d& direction, double radius_m,
                                   double reach_m) const;

  /// m².
  [[nodiscard]] double area_m2() const;

  /// The outlines of what is left: outer ones counter-clockwise, holes clockwise.
  [[nodiscard]] std::vector<Outline> outlines() const;

 private:
  struct Cells;
  std::unique_ptr<Cells> cells_;
};

}  // namespace thinwall::milling
