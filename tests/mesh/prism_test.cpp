#include "mesh/planar/prism.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/error.hpp"
#include "mesh/planar/border_graph.hpp"
#include "tests/mesh/plane_shapes.hpp"

namespace thinwall::mesh::prism_test {
namespace {

/// The one violation of a prism, "" if there is none.
std::string only_violation(const Prism& prism) {
  const auto found = violations(prism);
  EXPECT_LE(found.size(), 1U);
  for (const auto& line : found) EXPECT_EQ(line.find('\n'), std::string::npos);
  return found.empty() ? "" : found.front();
}

void expect_violation(const Prism& prism, const std::string& what) {
  EXPECT_NE(only_violation(prism).find(what), std::string::npos) << only_violation(prism);
  EXPECT_THROW(validate(prism), core::InputError);
}

TEST(Prism, VolumeOfAPlateWithAHoleAndAZoneIsTheSumOfItsParts) {
  Prism prism{{{0, 0}, {0.45, 0}, {0.40, 0.1}, {0, 0.1}}, {regular({0.2, 0.05}, 0.015, 24)}, 0.001, 0.007, {}};
  const double plate = 0.5 * (0.45 + 0.40) * 0.1 - regular_area(0.015, 24);
  EXPECT_NEAR(volume(prism), 0.006 * plate, 1e-15 * plate);
  prism.zones.push_back({regular({0.1, 0.05}, 0.02, 7), 0.001, 0.002});
  const double pocketed = 0.006 * plate - 0.005 * regular_area(0.02, 7);
  EXPECT_NEAR(volume(prism), pocketed, 1e-14 * pocketed);
}

TEST(Prism, LaterZonesWinOverEarlierOnesAndHolesOverAll) {
  Prism prism{rectangle(0, 0, 0.1, 0.1), {rectangle(0.04, 0.04, 0.06, 0.06)}, 0.0, 0.01, {}};
  prism.zones = {{rectangle(0.0, 0.0, 0.05, 0.1), 0.0, 0.02}, {rectangle(0.02, 0.0, 0.07, 0.05), 0.0, 0.04}};
  EXPECT_EQ(extent_at(prism, {0.01, 0.05})->top, 0.02);
  EXPECT_EQ(extent_at(prism, {0.03, 0.01})->top, 0.04);
  EXPECT_EQ(extent_at(prism, {0.09, 0.09})->top, 0.01);
  EXPECT_FALSE(extent_at(prism, {0.045, 0.045}));
  EXPECT_FALSE(extent_at(prism, {0.11, 0.05}));
  // Areas in cm²: second zone 25 − 2 (its part in the hole), first 50 − 15 − 1 (hole above 5 cm), the rest.
  const double expected = 1e-4 * (23.0 * 0.04 + 34.0 * 0.02 + (96.0 - 23.0 - 34.0) * 0.01);
  EXPECT_NEAR(volume(prism), expected, 1e-14 * expected);
}

TEST(Prism, VolumeKnowsNoOrientationNorPosition) {
  Prism prism = pocket_corner();
  const double expected = 1e-9 * (100.0 * 60.0 * 3.0 + (100.0 * 2.0 + 58.0 * 2.0) * 40.0);
  EXPECT_NEAR(volume(prism), expected, 1e-13 * expected);
  std::reverse(prism.outline.begin(), prism.outline.end());
  std::reverse(prism.zones[1].outline.begin(), prism.zones[1].outline.end());
  EXPECT_NEAR(volume(turned(prism, 0.7)), expected, 1e-13 * expected);
}

TEST(Prism, BordersBetweenEqualHeightsVanishAndStraightRunsAreJoined) {
  const BorderGraph graph = border_graph(pocket_corner());
  // Six corners of the walls' foot, five of them on the outline, and the floor's far corner.
  EXPECT_EQ(graph.points.size(), 7U);
  EXPECT_EQ(graph.borders.size(), 8U);
}

TEST(Prism, CoordinatesThatDifferByRoundOffAreOneLine) {
  Prism prism{rectangle(0, 0, 0.3, 0.1), {}, 0.0, 0.01, {{rectangle(0.1, 0, 0.1 + 0.2, 0.1), 0.0, 0.02}}};
  EXPECT_EQ(only_violation(prism), "");
  EXPECT_EQ(border_graph(cleaned(prism)).points.size(), 6U);
}

TEST(Prism, ValidPartsHaveNoViolations) {
  EXPECT_EQ(only_violation(flat_plate()), "");
  EXPECT_EQ(only_violation(pocket_corner()), "");
  EXPECT_EQ(only_violation(turned(pocket_corner(), 1.0)), "");
}

TEST(PrismBadInput, PolygonsThatAreNone) {
  Prism prism = flat_plate();
  prism.outline = {{0, 0}, {0.1, 0}};
  expect_violation(prism, "2 points");
  prism.outline = {{0, 0}, {0.1, 0}, {0.2, 0}};
  expect_violation(prism, "no area");
  prism.outline = {{0, 0}, {0.1, 0}, {0.1, 0}, {0.1, 0.1}};
  expect_violation(prism, "repeats the point (100, 0) mm");
  prism.outline = {{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0}};
  expect_violation(prism, "repeats the point");
  prism.outline = {{0, 0}, {0.1, 0.1}, {0.1, 0}, {0, 0.1}};
  expect_violation(prism, "crosses or touches itself near (50, 50) mm");
  prism.outline = {{0, 0}, {0.2, 0}, {0.2, 0.1}, {0.1, 0.0}, {0, 0.1}};
  expect_violation(prism, "crosses or touches itself");
  prism.outline = {{0, 0}, {0.2, 0}, {0.1, 0}, {0.1, 0.1}};
  expect_violation(prism, "crosses or touches itself");
  prism.outline = {{0, 0}, {NAN, 0}, {0.1, 0.1}};
  expect_violation(prism, "not a finite number");
}

TEST(PrismBadInput, ThicknessOfNothing) {
  Prism prism = flat_plate();
  prism.top = prism.bottom;
  expect_violation(prism, "the part has thickness 0 mm");
  prism.top = -0.001;
  expect_violation(prism, "thickness -1 mm");
  prism = flat_plate();
  prism.zones = {{rectangle(0.1, 0.01, 0.2, 0.09), 0.002, 0.001}};
  expect_violation(prism, "zone 1 has thickness -1 mm");
  prism.zones[0].top = NAN;
  expect_violation(prism, "zone 1 has thickness");
}

TEST(PrismBadInput, HolesThatAreNotInside) {
  Prism prism = flat_plate();
  prism.holes = {rectangle(0.5, 0.01, 0.6, 0.02)};
  expect_violation(prism, "hole 1 at (500, 10) mm lies outside");
  prism.holes = {rectangle(0.4, 0.01, 0.5, 0.02)};
  expect_violation(prism, "touches or crosses the outline");
  prism.holes = {rectangle(0.4, 0.01, 0.45, 0.02)};
  expect_violation(prism, "touches or crosses the outline");
  prism.holes = {rectangle(0.1, 0.01, 0.2, 0.02), rectangle(0.2, 0.01, 0.3, 0.02)};
  expect_violation(prism, "hole 2 at (200, 10) mm touches, crosses or contains hole 1");
  prism.holes = {rectangle(0.1, 0.01, 0.2, 0.09), rectangle(0.12, 0.02, 0.18, 0.08)};
  expect_violation(prism, "touches, crosses or contains hole 1");
}

TEST(PrismBadInput, ZonesThatReachOutside) {
  Prism prism = flat_plate();
  prism.zones = {{rectangle(0.4, 0.01, 0.46, 0.05), 0.0, 0.01}};
  expect_violation(prism, "zone 1 reaches outside the outline");
  prism.zones = {{rectangle(0.4, 0.01, 0.45, 0.05), 0.0, 0.01}};
  EXPECT_EQ(only_violation(prism), "") << "a shared line is none";
  // Both ends on the outline, the middle across its notch.
  prism = {{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0.05, 0.02}, {0, 0.1}}, {}, 0, 0.01, {}};
  prism.zones = {{{{0, 0}, {0.1, 0}, {0.1, 0.1}, {0, 0.1}}, 0.0, 0.02}};
  expect_violation(prism, "zone 1 reaches outside the outline at (50, 100) mm");
}

TEST(PrismBadInput, BordersThatNearlyTouch) {
  Prism prism = flat_plate();
  prism.zones = {{rectangle(0.4, 0.01, 0.45 - 1e-8, 0.05), 0.0, 0.01}};
  expect_violation(prism, "borders come within");
}

TEST(PrismBadInput, RegionsThatShareNoHeightFallApart) {
  Prism prism = flat_plate();
  prism.zones = {{rectangle(0.2, 0.0, 0.3, 0.1), 0.006, 0.01}};
  expect_violation(prism, "falls apart");
  prism.zones[0].bottom = 0.005;
  EXPECT_EQ(only_violation(prism), "");
  // An island that floats above the plate, and the same joined to a rib that stands on it.
  prism.zones = {{rectangle(0.2, 0.03, 0.3, 0.06), 0.01, 0.02}};
  expect_violation(prism, "falls apart");
  prism.zones.push_back({rectangle(0.3, 0.03, 0.31, 0.06), 0.0, 0.015});
  EXPECT_EQ(only_violation(prism), "");
}

TEST(Prism, KnowsWhetherAnEdgeTurnsInwards) {
  const Prism plate{rectangle(0, 0, 0.4, 0.1), {}, 0.0, 0.006, {}};
  EXPECT_FALSE(has_reentrant_edge(plate));
  Prism part = plate;
  std::reverse(part.outline.begin(), part.outline.end());
  EXPECT_FALSE(has_reentrant_edge(part)) << "whatever the orientation";
  part.holes = {regular({0.2, 0.05}, 0.02, 32)};
  EXPECT_FALSE(has_reentrant_edge(part)) << "a round hole";
  part.holes = {rectangle(0.2, 0.04, 0.22, 0.06)};
  EXPECT_TRUE(has_reentrant_edge(part)) << "a square one";
  std::reverse(part.holes[0].begin(), part.holes[0].end());
  EXPECT_TRUE(has_reentrant_edge(part));
  part = plate;
  part.zones = {{rectangle(0, 0, 0.1, 0.1), 0.0, 0.006}};
  EXPECT_FALSE(has_reentrant_edge(part)) << "a zone of the part's own height";
  part.zones[0].top = std::nextafter(0.006, 1.0);
  EXPECT_FALSE(has_reentrant_edge(part)) << "the same but for round-off";
  part.zones[0].top = 0.003;
  EXPECT_TRUE(has_reentrant_edge(part)) << "a step";
  part = plate;
  part.outline = {{0, 0}, {0.4, 0}, {0.4, 0.05}, {0.2, 0.05}, {0.2, 0.1}, {0, 0.1}};
  EXPECT_TRUE(has_reentrant_edge(part)) << "an L";
}

}  // namespace
}  // namespace thinwall::mesh::prism_test
