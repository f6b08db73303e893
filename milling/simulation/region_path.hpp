#pragma once
// Milling in the time domain with the part as a region from which each tooth takes what it sweeps.

#include <optional>
#include <vector>

#include "milling/simulation/exact_path.hpp"
#include "milling/simulation/part_region.hpp"

namespace thinwall::milling {

/// The shape in which the tip of a tooth moves from step to step.
enum class SweptEdge {
  arcs,    ///< along its path, in chords that leave it by 0.5 nm at most
  chords,  ///< one chord a step, as Huynh 2017 has it: the wall keeps the corners of a polygon
};

/// The fineness of a part as a region.
struct RegionOptions {
  int steps_a_turn = 720;  ///< ≥ 24; raised to a multiple of equal teeth
  SweptEdge edge = SweptEdge::arcs;
  double cell_m = 0.0;                          ///< of PartRegion; 0: a twentieth of the cutter's radius
  std::optional<OneSidedContact> contact = {};  ///< of a support, that may open
};

/// The part that is left at a height.
struct PartSlice {
  double height_m = 0.0;  ///< from the tip up
  double width_m = 0.0;   ///< of cut that it stands for
  std::vector<Outline> outlines;
};

/// A cut, and the part that it leaves.
struct RegionCut {
  SimulatedCut cut;
  double removed_m2 = 0.0;  ///< area of the region that the teeth took away, mean over the slices
  std::vector<PartSlice> slices;
};

/// The stock within a rectangle, as an outline; no corners where they do not meet. Its edges as in stock.hpp.
[[nodiscard]] Outline outline_of(const Stock& stock, const Eigen::Vector2d& low, const Eigen::Vector2d& high);

/// A rectangle in the plane of the cut, m.
struct CutWindow {
  Eigen::Vector2d low, high;
};

/// The rectangle in which a cut of so many turns moves: from the radius and a tenth of it behind the start to as much
/// ahead of the end.
[[nodiscard]] CutWindow cut_window(const MillingProcess& process, const SimulatedPoint& point, int turns);

/// As simulate_exact_path(), with a part of any shape: `part` are the outlines of the material before the cut, in the
/// plane of the cut (x_T, y_T), m, from the place where the centre of the tool that does not vibrate is when the
/// simulation begins. A tooth cuts the material that lies on the ray from the centre to its tip, and takes away the
/// sector that this ray sweeps (Huynh 2017, Section 4); each disc has a slice of its own. What lies behind the start is
/// taken away first, as by a tool that did not vibrate. Throws as simulate_exact_path(), and as PartRegion. Cost: steps
/// × teeth in the material × discs × differences of small polygons, some ten times that of exact paths; the memory
/// grows with the length of the path.
[[nodiscard]] RegionCut simulate_region(const RelativeStructure& structure, const MillingProcess& process,
                                        const ForceLaw& law, const SimulatedPoint& point,
                                        const std::vector<Outline>& part, const SimulationOptions& options = {},
                                        const RegionOptions& region = {}, const TurnObserver& after_turn = {});

}  // namespace thinwall::milling
