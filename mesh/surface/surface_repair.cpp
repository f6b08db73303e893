#include "mesh/surface/surface_repair.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/edge_uses.hpp"
#include "mesh/surface/facet_repair.hpp"
#include "mesh/surface/hole_filling.hpp"
#include "mesh/surface/orientation.hpp"
#include "mesh/surface/separate_bodies.hpp"
#include "mesh/surface/solid_union.hpp"
#include "mesh/surface/thin_walls.hpp"

namespace thinwall::mesh {

namespace {

/// Largest distance of a part from the origin in its diagonals. Beyond it double precision is coarser than 2e-8 of the
/// diagonal.
constexpr double farthest_diagonals = 1e8;
/// Number of crossings that are searched for. One is enough to refuse the surface, more show where to look.
constexpr int most_crossings = 1000;

void require_within(double value, double least, double most, const char* name) {
  if (value >= least && value <= most) return;
  throw core::InputError(std::string(name) + " of a surface's repair is " + core::number_text(value, 3) + "; choose " +
                         core::number_text(least, 3) + " to " + core::number_text(most, 3));
}

void validate(const SurfaceRepairOptions& options) {
  constexpr double largest = std::numeric_limits<double>::max();
  require_within(options.merge_tolerance_m, 0.0, largest, "merge_tolerance_m");
  require_within(options.largest_hole_edges, 0, 100, "largest_hole_edges");
  require_within(options.largest_movement, 0.0, 0.1, "largest_movement");
  require_within(options.thinnest_wall_m, 0.0, largest, "thinnest_wall_m");
  require_within(options.longest_union_s, 0.0, largest, "longest_union_s");
  require_within(options.far_diagonals, 1.0, farthest_diagonals, "far_diagonals");
}

/// Throws InputError, in one line with every fault that was found, at its place in the frame of the file.
void refuse_if_any(std::vector<SurfaceFinding> faults, const Eigen::Vector3d& moved_by) {
  std::string all;
  for (SurfaceFinding& fault : faults) {
    if (fault.count == 0) continue;
    fault.first_m -= moved_by;
    all += (all.empty() ? "" : "; ") + text(fault);
  }
  if (!all.empty()) throw core::InputError("the surface cannot be repaired: " + all);
}

/// The surface under repair and the repairs so far.
struct Repair {
  TriangleSoup soup;
  SurfaceRepair result;
  SurfaceFinding not_united;  // the bodies whose union failed

  /// Records a repair, at its place in the frame of the file.
  void note(SurfaceFinding finding) {
    if (finding.count == 0) return;
    finding.first_m -= result.moved_by;
    result.mended.push_back(std::move(finding));
  }

  /// Throws InputError as above. Bodies that were not united are a cause of faults, and no fault where there are none.
  void refuse_if_any(std::vector<SurfaceFinding> faults) const {
    if (std::ranges::all_of(faults, [](const SurfaceFinding& fault) { return fault.count == 0; })) return;
    faults.insert(faults.begin(), not_united);
    mesh::refuse_if_any(std::move(faults), result.moved_by);
  }
};

/// Products of three larger or smaller lengths leave the range in which predicates are exact.
constexpr double largest_size_m = 1e6, smallest_size_m = 1e-9;

/// Throws InputError if the surface has a size that no part has, as by a stray point or a wrong unit.
void require_size(const TriangleSoup& soup) {
  const SoupBounds block = bounds(soup);
  const double diagonal = (block.largest - block.least).norm();
  if (diagonal > largest_size_m) {
    const double farthest = block.largest.cwiseAbs().cwiseMax(block.least.cwiseAbs()).maxCoeff();
    const auto far = [&](const Eigen::Vector3d& x) { return x.cwiseAbs().maxCoeff() == farthest; };
    throw core::InputError("the surface reaches to " + place_text(*std::ranges::find_if(soup.points, far)) +
                           ", and no part is larger than 1e+09 mm; look for a stray point, and check the unit");
  }
  if (diagonal > 0.0 && diagonal < smallest_size_m)
    throw core::InputError("the surface is " + size_text(soup) + ", and no part is that small; check the unit");
}

/// Merges points; throws InputError if that moves a point too far.
void merge(Repair& repair, const TriangleSoup& soup, const SurfaceRepairOptions& options) {
  MergedPoints merged = merged_points(soup, options.merge_tolerance_m);
  repair.soup = std::move(merged.soup);
  if (repair.soup.triangles.empty()) throw core::InputError("the surface has no triangles; give a closed surface");
  require_size(repair.soup);
  repair.result.largest_movement_m = merged.largest_way;
  repair.note({"points that lay on another", merged.merged, merged.first_merged, ""});
  repair.note({"points that no facet uses", merged.unused, merged.first_unused, ""});
  const SoupBounds block = bounds(repair.soup);
  const double bound = options.largest_movement * (block.largest - block.least).norm();
  if (merged.largest_way > bound) {
    throw core::InputError("merging points moves the surface by " + core::number_text(1e3 * merged.largest_way, 3) +
                           " mm, more than " + core::number_text(1e3 * bound, 3) + " mm (" +
                           core::number_text(options.largest_movement, 3) + " of its diagonal), the first at " +
                           place_text(merged.first_merged) +
                           "; merge within less (repair.merge_tolerance), or allow more (repair.largest_movement)");
  }
}

/// Moves a part that is far from the origin to its centre. Differences of its coordinates, which would lose digits to
/// the offset, are exact once the offset is subtracted.
void move_to_centre_if_far(Repair& repair, const SurfaceRepairOptions& options) {
  const SoupBounds block = bounds(repair.soup);
  const Eigen::Vector3d centre = 0.5 * (block.least + block.largest);
  const double diagonal = (block.largest - block.least).norm();
  const double ratio = centre.norm() / diagonal;
  if (!(diagonal > 0.0) || ratio <= options.far_diagonals) return;
  const std::string where =
      "coordinates lie " + core::number_text(ratio, 3) + " diagonals from the origin, around " + place_text(centre);
  if (ratio > farthest_diagonals) {
    throw core::InputError(where + ", too far to resolve the surface; export it near the origin");
  }
  repair.result.moved_by = -centre;
  for (auto& x : repair.soup.points) x -= centre;
  const double single = std::numeric_limits<float>::epsilon() / 2 * ratio;
  SurfaceFinding finding{.what = "surface moved to its centre: " + where + "; a file in single precision resolves " +
                                 core::number_text(single, 3) + " of its diagonal there"};
  finding.add(block.least - centre);
  repair.note(finding);
}

/// The facets that coincided with an opposite one and are not part of a closed surface.
SurfaceFinding coincident_walls(const TriangleSoup& soup, const std::vector<int>& opposite) {
  SurfaceFinding finding{.what = "facets that coincide with another that looks the other way: a wall without thickness",
                         .remedy = "give it a thickness or remove it"};
  std::vector<bool> is_bad(soup.triangles.size());
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    if (uses.size() == 2) return;
    for (const EdgeUse& use : uses) is_bad[static_cast<std::size_t>(use.triangle)] = true;
  });
  for (const int t : opposite) {
    const auto& corners = soup.triangles[static_cast<std::size_t>(t)];
    const auto at = [&](std::size_t k) { return soup.points[static_cast<std::size_t>(corners[k])]; };
    if (is_bad[static_cast<std::size_t>(t)]) finding.add((at(0) + at(1) + at(2)) / 3.0);
  }
  return finding;
}

/// The edges in which more than two triangles meet.
SurfaceFinding crowded_edges(const TriangleSoup& soup) {
  SurfaceFinding finding{.what = "edges in which more than two triangles meet", .remedy = "separate or join the parts"};
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    if (uses.size() <= 2) return;
    const auto at = [&](std::size_t k) { return soup.points[static_cast<std::size_t>(uses[0].ends[k])]; };
    finding.add(0.5 * (at(0) + at(1)));
  });
  return finding;
}

/// A share of the diagonal: edges of bodies that should lie on each other leave slivers of this width in their union,
/// for the coordinates of a file have seven digits or so.
constexpr double sliver_of_union = 1e-7;

/// Replaces several bodies by their union if all of them touch or overlap. A soup that is no set of closed bodies, or
/// whose bodies lie apart, stays as it is, and so does one whose union takes too long.
void unite_bodies(Repair& repair, const SurfaceRepairOptions& options) {
  const std::vector<TriangleSoup> bodies = separate_bodies(repair.soup);
  if (bodies.size() < 2) return;
  const SolidUnion all = united(bodies, {options.longest_union_s, options.limits.memory_bytes});
  const int count = static_cast<int>(bodies.size());
  const Eigen::Vector3d& first = bodies.front().points.front();
  if (!all.failure.empty()) {
    repair.not_united = {.what = "bodies whose union could not be had: " + all.failure,
                         .count = count,
                         .first_m = first,
                         .remedy = "join them before the export"};
  }
  if (!all.surface) return;
  const SoupBounds block = bounds(*all.surface);
  repair.soup = merged_points(*all.surface, sliver_of_union * (block.largest - block.least).norm()).soup;
  (void)drop_collapsed(repair.soup);
  repair.note({.what = "bodies that touch or overlap and are treated as one", .count = count, .first_m = first});
}

/// Repairs the facets, so that every edge has two triangles; throws InputError with the faults if that fails.
void mend_facets(Repair& repair, const SurfaceRepairOptions& options) {
  repair.note(drop_collapsed(repair.soup));
  unite_bodies(repair, options);
  auto [doubled, opposite] = drop_duplicates(repair.soup);
  const SurfaceFinding walls = coincident_walls(repair.soup, opposite);
  repair.note(doubled);
  const auto [removed, left] = split_flat(repair.soup);
  repair.note(removed);
  repair.note(drop_duplicates(repair.soup).dropped);
  if (options.largest_hole_edges > 0) repair.note(fill_holes(repair.soup, options.largest_hole_edges, options.limits));
  if (repair.soup.triangles.empty())
    throw core::InputError("all facets of the surface lie on lines; give a closed surface");
  repair.refuse_if_any({walls, crowded_edges(repair.soup), open_edges(repair.soup), left});
}

/// The shells other than the largest: cavities if their first point lies within it, other bodies if not.
std::vector<SurfaceFinding> other_shells(const TriangleSoup& soup, const Orientation& orientation) {
  constexpr int most_looked_at = 20;
  SurfaceFinding bodies{.what = "bodies beside the largest", .remedy = "give one body, or join them"};
  SurfaceFinding cavities{.what = "closed cavities within the body", .remedy = "fill or open them"};
  const auto& volumes = orientation.volumes_m3;
  const int main = static_cast<int>(std::max_element(volumes.begin(), volumes.end()) - volumes.begin());
  std::vector<bool> is_seen(volumes.size());
  for (std::size_t t = 0; t < soup.triangles.size(); ++t) {
    const int shell = orientation.shell_of_triangle[t];
    if (shell == main || is_seen[static_cast<std::size_t>(shell)]) continue;
    is_seen[static_cast<std::size_t>(shell)] = true;
    const Eigen::Vector3d& x = soup.points[static_cast<std::size_t>(soup.triangles[t][0])];
    const bool is_looked_at = bodies.count + cavities.count < most_looked_at;
    const bool is_within = is_looked_at && winding_number(soup, orientation.shell_of_triangle, main, x) > 0.5;
    (is_within ? cavities : bodies).add(x);
  }
  return {bodies, cavities};
}

/// The pairs of triangles that cross. The search runs in a process of its own, because CGAL takes quadratic time where
/// everything overlaps.
SurfaceFinding crossings(const TriangleSurface& surface, const ProcessLimits& limits) {
  SurfaceFinding finding{.what = "pairs of triangles that cross or cover each other", .remedy = "separate them"};
  std::vector<char> bytes;
  try {
    bytes = run_confined(
        [&] {
          const auto pairs = self_intersections(surface, most_crossings);
          std::vector<char> raw(pairs.size() * sizeof(std::array<int, 2>));
          if (!raw.empty()) std::memcpy(raw.data(), pairs.data(), raw.size());
          return raw;
        },
        limits.time_s, limits.memory_bytes);
  } catch (const core::NumericalError& error) {
    throw core::NumericalError(std::string("the search for triangles that cross failed: ") + error.what() +
                               "; most of the surface may overlap, export it again");
  }
  std::vector<std::array<int, 2>> pairs(bytes.size() / sizeof(std::array<int, 2>));
  if (!pairs.empty()) std::memcpy(pairs.data(), bytes.data(), pairs.size() * sizeof pairs[0]);
  std::sort(pairs.begin(), pairs.end());
  for (const auto& pair : pairs) finding.add(centroid(surface, pair[0]));
  return finding;
}

/// Turns all triangles outwards and checks that one closed body without crossings is left.
void turn_outwards(Repair& repair, const SurfaceRepairOptions& options) {
  repair.refuse_if_any({touching_vertices(repair.soup)});
  const Orientation orientation = orient(repair.soup);
  repair.refuse_if_any({orientation.one_sided});
  repair.note(orientation.turned);
  auto faults = other_shells(repair.soup, orientation);
  const MergedPoints compact = merged_points(repair.soup);  // without points that facets no longer use
  repair.result.surface = {compact.soup.points, compact.soup.triangles};
  faults.push_back(crossings(repair.result.surface, options.limits));
  repair.refuse_if_any(faults);
}

/// A share of the volume.
constexpr double most_lost_by_chords = 0.1;

void require_thick_enough(SurfaceRepair& result, double thinnest_m) {
  const ThinWalls walls = thin_walls(result.surface, thinnest_m);
  result.thinnest_wall_m = walls.thinnest_m;
  SurfaceFinding thin{.what = "facets above a wall thinner than " + core::number_text(1e3 * thinnest_m, 3) +
                              " mm, the thinnest " + core::number_text(1e3 * walls.thinnest_m, 3) + " mm",
                      .remedy = "thicken it, lower the tolerance, or correct the unit"};
  for (const int t : walls.triangles) thin.add(centroid(result.surface, t));
  refuse_if_any({thin}, result.moved_by);
}

}  // namespace

SurfaceRepair repaired_surface(const TriangleSoup& soup, const SurfaceRepairOptions& options) {
  validate(options);
  Repair repair;
  merge(repair, soup, options);
  move_to_centre_if_far(repair, options);
  mend_facets(repair, options);
  turn_outwards(repair, options);
  require_closed_shell(repair.result.surface);
  repair.result.volume_m3 = volume(repair.result.surface);
  if (std::abs(soup.solid_volume_m3 / repair.result.volume_m3 - 1.0) < most_lost_by_chords)
    repair.result.solid_volume_m3 = soup.solid_volume_m3;
  if (options.thinnest_wall_m > 0.0) require_thick_enough(repair.result, options.thinnest_wall_m);
  return std::move(repair.result);
}

std::string text(const SurfaceRepair& repair) {
  std::string all;
  for (const auto& finding : repair.mended) all += (all.empty() ? "" : "; ") + text(finding);
  return all.empty() ? "nothing to mend" : all;
}

}  // namespace thinwall::mesh
