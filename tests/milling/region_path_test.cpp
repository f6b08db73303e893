// A part as a region: areas in closed form, the motion of exact paths, the polygon that chords leave.

#include "milling/simulation/region_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::region_path_test {
namespace {

using std::numbers::pi;
using Point = Eigen::Vector2d;

RelativeStructure modes_in_plane(double frequency_hz, double damping_ratio, double mass_kg) {
  return relative_structure(testing::modal_model({{frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitX()},
                                                  {frequency_hz, damping_ratio, mass_kg, Eigen::Vector3d::UnitY()}}),
                            "P");
}

RelativeStructure stiff() {
  return modes_in_plane(20e3, 0.05, 1e6);
}

MillingProcess cut_of(double diameter_m, double radial_depth_m, MillingDirection direction, int teeth = 2) {
  MillingProcess process;
  process.cutter = {teeth, diameter_m};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, radial_depth_m, direction);
  return process;
}

SimulationOptions turns(int settling, int recorded) {
  SimulationOptions options;
  options.settling_turns = settling;
  options.recorded_turns = recorded;
  return options;
}

std::vector<Outline> shoulder_in_window(const MillingProcess& process, const SimulatedPoint& point, double radial_m,
                                        MillingDirection direction, int of_turns) {
  const CutWindow window = cut_window(process, point, of_turns);
  return {outline_of(shoulder(process.cutter, radial_m, direction), window.low, window.high)};
}

Outline rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

TEST(PartRegion, HasTheAreaThatIsLeft) {
  PartRegion region({rectangle(0.0, 0.0, 10e-3, 5e-3)}, 0.3e-3);
  EXPECT_NEAR(region.area_m2(), 50e-6, 1e-14);
  region.erase(rectangle(-1e-3, -1e-3, 2e-3, 2e-3));
  EXPECT_NEAR(region.area_m2(), 46e-6, 1e-14);
  region.erase(rectangle(-1e-3, -1e-3, 2e-3, 2e-3));
  EXPECT_NEAR(region.area_m2(), 46e-6, 1e-14);
  Outline circle;
  constexpr int corners = 1000;
  for (int i = 0; i < corners; ++i)
    circle.emplace_back(Point(6e-3, 2.5e-3) +
                        2e-3 * Point(std::cos(2 * pi * i / corners), std::sin(2 * pi * i / corners)));
  region.erase(circle);
  const double polygon_m2 = 0.5 * corners * std::sin(2 * pi / corners) * 4e-6;
  EXPECT_NEAR(region.area_m2(), 46e-6 - polygon_m2, 1e-13);
}

/// The pieces of all cells join to the outline with its hole: two outlines, whose areas by the formula of the
/// trapezoids are those of the region.
TEST(PartRegion, JoinsItsCellsToOutlines) {
  PartRegion region({rectangle(0.0, 0.0, 10e-3, 5e-3)}, 0.7e-3);
  region.erase(rectangle(3e-3, 1e-3, 6e-3, 2e-3));
  const std::vector<Outline> outlines = region.outlines();
  ASSERT_EQ(outlines.size(), 2U);
  double area = 0.0;
  for (const Outline& o : outlines) {
    for (std::size_t i = 0; i < o.size(); ++i) {
      const Point &a = o[i], &b = o[(i + 1) % o.size()];
      area += 0.5 * (a.x() * b.y() - a.y() * b.x());
    }
  }
  EXPECT_NEAR(area, 47e-6, 1e-14);
}

TEST(PartRegion, TellsTheMaterialOnARay) {
  PartRegion region({rectangle(0.0, 0.0, 10e-3, 5e-3), rectangle(12e-3, 0.0, 13e-3, 5e-3)}, 0.31e-3);
  region.erase(rectangle(4e-3, 0.0, 6e-3, 5e-3));
  const Point from(-1e-3, 1e-3);
  const RayMaterial along = region.on_ray(from, Point::UnitX(), 8e-3, 20e-3);
  EXPECT_NEAR(along.within_m, 5e-3, 1e-9);  // 0 to 4 mm, and 6 to 7
  EXPECT_TRUE(along.tip_within);
  const RayMaterial in_gap = region.on_ray(from, Point::UnitX(), 11.5e-3, 20e-3);
  EXPECT_NEAR(in_gap.within_m, 8e-3, 1e-9);
  EXPECT_FALSE(in_gap.tip_within);
  EXPECT_NEAR(in_gap.beyond_m, 13e-3, 1e-9);
  const Point oblique = Point(3.0, -4.0) / 5.0;
  EXPECT_NEAR(region.on_ray({1e-3, 3e-3}, oblique, 10e-3, 10e-3).within_m, 3.75e-3, 1e-9);
  const RayMaterial away = region.on_ray(from, -Point::UnitX(), 1e-3, 5e-3);
  EXPECT_EQ(away.within_m, 0.0);
  EXPECT_EQ(away.beyond_m, 5e-3);
}

TEST(PartRegion, RefusesWhatIsNone) {
  EXPECT_THROW(PartRegion({}, 1e-3), core::InputError);
  EXPECT_THROW(PartRegion({rectangle(0.0, 0.0, 1.0, 1.0)}, 0.0), core::InputError);
  EXPECT_THROW(PartRegion({rectangle(0.0, 0.0, 1.0, 1.0)}, 1e-5), core::InputError);
  EXPECT_THROW(PartRegion({{{0.0, 0.0}, {std::nan(""), 1.0}, {1.0, 0.0}}}, 1e-3), core::InputError);
}

/// a_e times the feed less the cusps, both by the region's own area and by the integral over the chips.
TEST(RegionPath, RemovesTheAreaOfTheCut) {
  constexpr double feed = 1e-4, diameter = 0.01;
  for (const auto direction : {MillingDirection::down, MillingDirection::up}) {
    for (const double radial : {0.5e-3, 4e-3, 7e-3, 9.9e-3, 10e-3}) {
      const MillingProcess process = cut_of(diameter, radial, direction);
      const SimulatedPoint point{6000.0, 1e-3, feed};
      const RegionCut result = simulate_region(stiff(), process, process.coefficients, point,
                                               shoulder_in_window(process, point, radial, direction, 3), turns(0, 3));
      const double cusps = 2.0 * feed * feed * feed / (24.0 * 0.5 * diameter) * (radial < diameter ? 1.0 : 2.0);
      const double a_turn = 2.0 * feed * radial - cusps;
      EXPECT_NEAR(result.removed_m2 / 3.0, a_turn, 1e-4 * a_turn) << radial;
      EXPECT_NEAR(result.cut.removed_m2, a_turn, 1e-3 * a_turn) << radial;  // no step ends where a tooth enters
    }
  }
}

/// The same cuts by exact_path.hpp, whose contact is found without a region: a flip that leaves the cut, a helix with
/// runout and unequal pitches.
TEST(RegionPath, MovesAsExactPathsDo) {
  struct Row {
    double rpm, depth_m, radial_m;
    double helix_rad;
    std::vector<double> runout_m, pitches_rad;
  };
  for (const Row& row : {Row{19000.0, 2e-3, 0.5e-3, 0.0, {}, {}}, Row{6000.0, 0.6e-3, 1e-3, 0.0, {}, {}},
                         Row{12000.0, 0.2e-3, 3e-3, 0.5, {20e-6, -15e-6}, {2.9, 2 * pi - 2.9}}}) {
    MillingProcess process = cut_of(0.01, row.radial_m, MillingDirection::down);
    process.cutter.helices_rad = {row.helix_rad, row.helix_rad};
    process.cutter.runout_m = row.runout_m;
    process.cutter.pitches_rad = row.pitches_rad;
    const SimulatedPoint point{row.rpm, row.depth_m, 1e-4};
    SimulationOptions options = turns(60, 20);
    options.steps.discs = 4;
    options.wall.turns = 8;
    const RelativeStructure structure = modes_in_plane(922.0, 0.011, 0.03993);
    const SimulatedCut exact =
        simulate_exact_path(structure, process, process.coefficients, point,
                            shoulder(process.cutter, row.radial_m, MillingDirection::down), options, {720, 10});
    const RegionCut region =
        simulate_region(structure, process, process.coefficients, point,
                        shoulder_in_window(process, point, row.radial_m, MillingDirection::down, 80), options);
    const Eigen::Vector3d range = exact.displacement_m.range();
    EXPECT_LT((region.cut.displacement_m.range() - range).norm(), 1e-3 * range.norm()) << row.rpm;
    EXPECT_NEAR(region.cut.peak_force_n, exact.peak_force_n, 1e-3 * exact.peak_force_n) << row.rpm;
    EXPECT_LT((region.cut.mean_force_n - exact.mean_force_n).norm(), 1e-3 * exact.mean_force_n.norm()) << row.rpm;
    EXPECT_NEAR(region.cut.removed_m2, exact.removed_m2, 1e-3 * exact.removed_m2) << row.rpm;
    EXPECT_EQ(region.cut.motion.motion, exact.motion.motion) << row.rpm;
  }
}

/// A tool that does not vibrate never loses contact, though its rays pass beside the material by less than a cell:
/// ahead of the entry of up-milling, beyond its exit (from a centre that lies within the stock as well), beside both
/// walls of a slot.
TEST(RegionPath, CountsNoRayBesideTheMaterialAsLostContact) {
  for (const auto direction : {MillingDirection::down, MillingDirection::up}) {
    for (const double radial : {0.5e-3, 4e-3, 10e-3}) {
      const MillingProcess process = cut_of(0.01, radial, direction);
      const SimulatedPoint point{6000.0, 1e-3, 1e-4};
      const RegionCut result = simulate_region(stiff(), process, process.coefficients, point,
                                               shoulder_in_window(process, point, radial, direction, 3), turns(0, 3));
      const SimulatedCut exact = simulate_exact_path(stiff(), process, process.coefficients, point,
                                                     shoulder(process.cutter, radial, direction), turns(0, 3));
      EXPECT_NEAR(result.cut.share_without_contact, exact.share_without_contact, 5e-3) << radial;
      EXPECT_LT(result.cut.share_without_contact, 0.02) << radial;
    }
  }
}

/// Where the tool has left the part nothing is left of its swath, and nothing pushes it.
TEST(RegionPath, LeavesThePartThroughACorner) {
  const MillingProcess process = cut_of(0.01, 4e-3, MillingDirection::down);
  const SimulatedPoint point{6000.0, 1e-3, 1e-4};
  // An L: the tool runs along its foot and out of it.
  const Outline part{{5.5e-3, -8e-3}, {9e-3, -8e-3}, {9e-3, -3e-3}, {7e-3, -3e-3}, {7e-3, 0.5e-3}, {5.5e-3, 0.5e-3}};
  SimulationOptions options = turns(0, 100);  // 20 mm
  options.traced_turns = 100;
  const RegionCut result = simulate_region(stiff(), process, process.coefficients, point, {part}, options);
  const double cut_m2 = 1.5e-3 * 5.5e-3 + 2e-3 * 2e-3;  // what lies above y = −5 mm
  EXPECT_NEAR(result.removed_m2, cut_m2, 1e-4 * cut_m2);
  const Eigen::Index last = result.cut.trace.force_n.cols() / 4;
  EXPECT_EQ(result.cut.trace.force_n.rightCols(last).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_GT(result.cut.peak_force_n, 0.0);
}

/// The wall of a slice on the −y_T side between two places along the feed, by rays across the feed.
Wall wall_of(const PartSlice& slice, double radius_m, double from_m, double to_m, int points) {
  Wall wall{-1, slice.height_m, Eigen::VectorXd::LinSpaced(points, from_m, to_m), Eigen::VectorXd(points)};
  const PartRegion region(slice.outlines, radius_m / 20.0);
  for (int i = 0; i < points; ++i)
    wall.error_m(i) = region.on_ray({wall.x_m(i), 0.0}, {0.0, -1.0}, 0.0, 2.0 * radius_m).beyond_m - radius_m;
  set_roughness(wall);
  return wall;
}

/// A rigid tool whose tips move in chords of 100 a turn, as in Huynh 2017: 40 phases of the steps by another program
/// give R_a of 0.2147 to 0.5328 um and R_t of 1.2989 to 2.1970 um, seven times the cusps of arcs.
TEST(RegionPath, ChordsLeaveThePolygonOnTheWall) {
  MillingProcess process = cut_of(0.01, 4e-3, MillingDirection::down);
  process.cutter.pitches_rad = {170.0 * pi / 180.0, 190.0 * pi / 180.0};
  const SimulatedPoint point{18700.0, 1.6e-3, 3.7 / 18700.0 / 2.0};
  const double feed_a_turn = 2.0 * point.feed_per_tooth_m;
  const auto wall = [&](RegionOptions region) {
    const RegionCut cut =
        simulate_region(stiff(), process, process.coefficients, point,
                        shoulder_in_window(process, point, 4e-3, MillingDirection::down, 16), turns(0, 16), region);
    return wall_of(cut.slices.front(), 5e-3, 4 * feed_a_turn, 12 * feed_a_turn, 4001);
  };
  const Wall arcs = wall({});
  EXPECT_NEAR(1e6 * arcs.R_a_m, 0.06447, 1e-3);
  EXPECT_NEAR(1e6 * arcs.R_t_m, 0.27603, 3e-3);
  const double entry = process.engagement.entry_rad;
  double least = 1e3, largest = 0.0;
  for (int phase = 0; phase < 20; ++phase) {
    process.engagement.entry_rad = entry + 2.0 * pi / 100.0 * phase / 20.0;
    const Wall chords = wall({100, SweptEdge::chords, 0.0});
    least = std::min(least, 1e6 * chords.R_t_m);
    largest = std::max(largest, 1e6 * chords.R_t_m);
    EXPECT_GT(1e6 * chords.R_a_m, 0.2147 - 0.02);
    EXPECT_LT(1e6 * chords.R_a_m, 0.5328 + 0.02);
  }
  EXPECT_NEAR(least, 1.2989, 0.1);
  EXPECT_NEAR(largest, 2.1970, 0.1);
}

}  // namespace
}  // namespace thinwall::milling::region_path_test
