#include "mesh/planar/prism_mesh.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <random>
#include <set>

#include "core/error.hpp"
#include "mesh/planar/planar_mesh.hpp"
#include "mesh/planar/sweep.hpp"
#include "mesh/solid/quality.hpp"
#include "tests/mesh/plane_shapes.hpp"

namespace thinwall::mesh::prism_mesh_test {
namespace {

PrismMeshOptions sized(double size_m, int layers = 1) {
  PrismMeshOptions options;
  options.size_m = size_m;
  options.layers = layers;
  return options;
}

PlanarMesh plane_of(const Prism& prism, const PrismMeshOptions& options) {
  const BorderGraph graph = border_graph(prism);
  return rectilinear(graph) ? tensor_grid(prism, graph, options) : planar_delaunay(prism, graph, options);
}

/// Every face belongs to one or two tetrahedra, the boundary is closed and encloses `expected`, no tet is inside out.
void expect_sound(const TetMesh& mesh, double expected) {
  for (int tet = 0; tet < static_cast<int>(mesh.tets.size()); ++tet) ASSERT_GT(volume(mesh, tet), 0.0);
  std::map<std::set<int>, int> faces;
  for (const auto& t : mesh.tets) {
    for (std::size_t k = 0; k < 4; ++k) ++faces[{t[k], t[(k + 1) % 4], t[(k + 2) % 4]}];
  }
  for (const auto& [face, count] : faces) ASSERT_LE(count, 2);
  std::map<std::pair<int, int>, int> edges;
  double enclosed = 0.0;
  for (const auto& triangle : boundary(mesh)) {
    std::array<Eigen::Vector3d, 3> p;
    for (std::size_t k = 0; k < 3; ++k) {
      p[k] = mesh.vertices[static_cast<std::size_t>(triangle.vertices[k])];
      ++edges[std::minmax(triangle.vertices[k], triangle.vertices[(k + 1) % 3])];
    }
    enclosed += p[0].dot(p[1].cross(p[2])) / 6.0;
  }
  for (const auto& [ends, count] : edges) ASSERT_EQ(count % 2, 0);
  EXPECT_NEAR(enclosed, expected, 1e-12 * expected);
  EXPECT_NEAR(volume(mesh), expected, 1e-12 * expected);
}

TEST(PrismMesh, BoxTakesTheCellsOfTheGradedGridAndNoMore) {
  // (8 + 2) × (2 + 2) cells of six tets each, theory: one order-4 layer of elements towards each edge.
  const TetMesh mesh = mesh_prism(flat_plate(), sized(0.055));
  EXPECT_EQ(mesh.tets.size(), 240U);
  EXPECT_EQ(mesh.vertices.size(), 2U * 11U * 5U);
  expect_sound(mesh, 0.45 * 0.1 * 0.006);
  EXPECT_EQ(mesh_prism(flat_plate(), sized(0.055, 2)).tets.size(), 432U);
  EXPECT_EQ(mesh_prism(flat_plate(), sized(0.055, 0)).tets.size(), 6U * 9U * 2U);
}

TEST(PrismMesh, LayersOfTheBoxAreGeometric) {
  PrismMeshOptions options = sized(0.055, 3);
  options.layer_factor = 0.25;
  options.layer_width_m = 0.008;
  std::set<double> y;
  for (const auto& v : mesh_prism(flat_plate(), options).vertices) y.insert(v.y());
  const std::vector<double> lines(y.begin(), y.end());
  ASSERT_EQ(lines.size(), 1U + 3U + 2U + 3U);
  for (const auto& [index, expected] : {std::pair{1U, 0.0005}, {2U, 0.0025}, {3U, 0.0105}, {4U, 0.05}, {7U, 0.0995}})
    EXPECT_NEAR(lines[index], expected, 1e-15);
}

TEST(PrismMesh, LayersTakeAtMostAThirdOfTheWayAcross) {
  PrismMeshOptions options = sized(0.055);
  options.layer_width_m = 0.05;
  std::set<double> y;
  for (const auto& v : mesh_prism(flat_plate(), options).vertices) y.insert(v.y());
  EXPECT_NEAR(*std::next(y.begin()), 0.1 / 3.0, 1e-15);
}

/// No diagonal cuts a corner of the plate off: else a tet would have all four vertices on two clamped sides.
TEST(PrismMesh, NoElementHasAllItsVerticesOnTwoSidesOfACorner) {
  for (const Prism& prism : {flat_plate(), turned(flat_plate(), 0.3)}) {
    const TetMesh mesh = mesh_prism(prism, sized(0.055));
    for (const auto& tet : mesh.tets) {
      const bool on_sides = std::all_of(tet.begin(), tet.end(), [&](int v) {
        const Eigen::Vector2d p = mesh.vertices[static_cast<std::size_t>(v)].head<2>();
        double nearest = 1.0;
        for (std::size_t i = 0; i < 4; ++i) nearest = std::min(nearest, distance(edge(prism.outline, i), p));
        return nearest < 1e-12;
      });
      EXPECT_FALSE(on_sides);
    }
  }
}

/// Walls 40 mm high: ceil(40 / 12) even pieces at most and a layer at either end, on the cells along two sides; floor:
/// the wall's own line, a layer at either end and even pieces between.
TEST(PrismMesh, PocketCornerTakesFewElements) {
  const std::size_t columns = 1 + 1 + 8 + 1;
  const std::size_t rows = 1 + 1 + 5 + 1;
  const std::size_t bound = 6 * (columns * rows + (columns + rows - 1) * (4 + 2));
  const Prism prism = pocket_corner();
  const TetMesh mesh = mesh_prism(prism, sized(0.012));
  EXPECT_LE(mesh.tets.size(), bound);
  EXPECT_GE(mesh.tets.size(), bound / 2);
  expect_sound(mesh, volume(prism));
  const TetMesh aslant = mesh_prism(turned(prism, 0.3), sized(0.012));
  EXPECT_LE(aslant.tets.size(), bound + bound / 5);
  expect_sound(aslant, volume(prism));
}

TEST(PrismMesh, BordersAlongTheAxesMakeAGridAlsoWhereZonesOverlap) {
  EXPECT_TRUE(rectilinear(border_graph(pocket_corner())));
  EXPECT_FALSE(rectilinear(border_graph(turned(pocket_corner(), 1e-3))));
}

TEST(PrismMesh, RibsAreGradedTowardsTheirTopAndTheirFoot) {
  std::set<double> z;
  for (const auto& v : mesh_prism(pocket_corner(), sized(0.012)).vertices) z.insert(v.z());
  ASSERT_EQ(z.size(), 2U + 1U + 2U + 1U + 2U);
  // 2 area / perimeter of the walls' foot, 316 mm² within 320 mm.
  const double thickness = 2.0 * (100.0 * 2.0 + 58.0 * 2.0) / 320.0 * 1e-3;
  EXPECT_NEAR(*std::next(z.begin(), 2), 0.003 + thickness, 1e-15);
  EXPECT_NEAR(*std::prev(z.end(), 2), 0.043 - thickness, 1e-15);
}

TEST(PrismMesh, NarrowStripTakesLongTriangles) {
  for (const double angle : {0.0, 0.3}) {
    const Prism strip = turned(Prism{rectangle(0, 0, 0.1, 0.002), {}, 0.0, 0.04, {}}, angle);
    const PlanarMesh mesh = plane_of(strip, sized(0.012));
    // ceil(100 / 12) pieces and a layer at each end; two triangles each.
    EXPECT_LE(mesh.triangles.size(), 2U * (9U + 2U));
    EXPECT_GE(mesh.triangles.size(), 2U * 9U);
  }
}

TEST(PrismMesh, RowsFollowASlantedOutlineAtTheDistancesOfTheLayers) {
  const Prism prism{{{0, 0}, {0.45, 0}, {0.40, 0.1}, {0, 0.1}}, {}, 0.0, 0.006, {}};
  const PlanarMesh mesh = plane_of(prism, sized(0.04, 2));
  std::array<int, 4> count{};
  for (const auto& v : mesh.vertices) {
    double nearest = 1.0;
    for (std::size_t i = 0; i < 4; ++i) nearest = std::min(nearest, distance(edge(prism.outline, i), v));
    const std::array<double, 3> rows{0.0, 0.0012, 0.0072};
    std::size_t row = 0;
    while (row < 3 && std::abs(nearest - rows[row]) > 1e-9) ++row;
    ++count[row];
    EXPECT_TRUE(row < 3 || nearest > 0.0072 + 0.4 * 0.04 - 1e-9) << "a point of the lattice keeps away from the rows";
  }
  // Each border has ceil(length / size) pieces and two feet at each corner; a row of it loses feet to the mitres.
  EXPECT_EQ(count[0], 12 + 3 + 10 + 3 + 8 * 2);
  EXPECT_EQ(count[1], 12 + 3 + 10 + 3 + 8);
  EXPECT_EQ(count[2], 12 + 3 + 10 + 3);
  EXPECT_GT(count[3], 0);
}

TEST(PrismMesh, CornersOfARoundHoleAreNoCorners) {
  const Eigen::Vector2d centre(0.2, 0.05);
  const Prism prism{{{0, 0}, {0.45, 0}, {0.40, 0.1}, {0, 0.1}}, {regular(centre, 0.015, 24)}, 0.0, 0.006, {}};
  const PlanarMesh mesh = plane_of(prism, sized(0.04));
  int on_hole = 0;
  int in_row = 0;
  for (const auto& v : mesh.vertices) {
    const double r = (v - centre).norm();
    on_hole += std::abs(r - 0.015) < 1e-9 ? 1 : 0;
    in_row += r > 0.015 + 1e-9 && r < 0.015 + 0.0065 ? 1 : 0;
  }
  EXPECT_EQ(on_hole, 24);
  EXPECT_EQ(in_row, 24);
}

TEST(PrismMesh, ElementsAreAsSmallAsASpotThereAndNotFurtherAway) {
  for (const double angle : {0.0, 0.3}) {
    const Prism prism = turned(flat_plate(), angle);
    PrismMeshOptions options = sized(0.055);
    const std::size_t plain = mesh_prism(prism, options).tets.size();
    const Eigen::Vector2d centre = turned(Polygon{{0.3, 0.05}}, angle).front();
    options.spots = {{centre, 0.005}};
    const PlanarMesh mesh = plane_of(cleaned(prism), options);
    int near = 0;
    for (const auto& triangle : mesh.triangles) {
      double longest = 0.0;
      double nearest = 1.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto& a = mesh.vertices[static_cast<std::size_t>(triangle[k])];
        const auto& b = mesh.vertices[static_cast<std::size_t>(triangle[(k + 1) % 3])];
        longest = std::max(longest, (b - a).norm());
        nearest = std::min(nearest, (a - centre).norm());
      }
      if (nearest > 0.5 * 0.005) continue;
      EXPECT_LT(longest, 2.0 * 0.005);
      ++near;
    }
    EXPECT_GE(near, 4);
    EXPECT_LE(mesh_prism(prism, options).tets.size(), 5 * plain);
  }
}

/// A wall along an arc, cut off square: the rows at its ends meet its faces at nearly a right angle, where feet beside
/// the corners would make needles. A needle of an outline and a slit have no room for rows at their tips.
TEST(PrismMesh, OddCornersMakeNoNeedles) {
  Polygon arc;
  for (int i = 0; i < 66; ++i) {
    const double angle = std::numbers::pi / 96 * (i < 33 ? i : 65 - i);
    arc.emplace_back((i < 33 ? 0.1 : 0.097) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  const Polygon wedge{{0, 0}, {0.3, 0}, {0.3, 0.02}};
  const Polygon slit{{0, 0}, {0.1, 0}, {0.1, 0.06}, {0.051, 0.06}, {0.05, 0.02}, {0.049, 0.06}, {0, 0.06}};
  // Flat elements, 20 to 40 mm long and 3 to 6 mm thick, have ratios up to 4 · 40 / 6.
  for (const auto& [outline, top] : {std::pair{arc, 0.04}, std::pair{wedge, 0.006}, std::pair{slit, 0.003}}) {
    const Prism prism{outline, {}, 0.0, top, {}};
    const TetMesh mesh = mesh_prism(prism, sized(outline.size() == 66 ? 0.02 : 0.04));
    EXPECT_LT(quality(mesh).aspect_ratio, 4.0 * 40.0 / 6.0);
    expect_sound(mesh, std::abs(signed_area(outline)) * top);
  }
}

TEST(PrismMesh, FineMeshOfAPlateKeepsTheVolume) {
  // Summed in double precision, the volumes of these elements are 1.7e-12 off, and the mesh was refused.
  const Prism plate{{{0, 0}, {0.45, 0}, {0.45, 0.25}, {0, 0.25}}, {}, 0.0, 0.006, {}};
  const TetMesh mesh = mesh_prism(plate, sized(0.004));
  EXPECT_GT(mesh.tets.size(), 40'000U);
  EXPECT_NEAR(volume(mesh) / (0.45 * 0.25 * 0.006), 1.0, 1e-13);
}

TEST(PrismMesh, MeshIsTheSameEveryTime) {
  const Prism prism = turned(pocket_corner(), 0.3);
  const TetMesh a = mesh_prism(prism, sized(0.012));
  const TetMesh b = mesh_prism(prism, sized(0.012));
  EXPECT_EQ(a.tets, b.tets);
  EXPECT_EQ(a.vertices, b.vertices);
}

using Random = std::mt19937;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

int whole(Random& random, int low, int high) {
  return std::uniform_int_distribution<int>(low, high)(random);
}

PrismMeshOptions random_options(Random& random, double extent) {
  PrismMeshOptions options = sized(extent * uniform(random, 0.05, 0.6), whole(random, 0, 3));
  options.layer_factor = uniform(random, 0.1, 0.5);
  if (whole(random, 0, 2) == 0) options.layer_width_m = extent * uniform(random, 0.005, 0.3);
  return options;
}

/// Star-shaped outline about the origin, with radii from half to all of `radius`.
Polygon star(Random& random, double radius) {
  const int n = whole(random, 3, 14);
  Polygon polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + uniform(random, -0.3, 0.3)) / n;
    polygon.emplace_back(radius * uniform(random, 0.5, 1.0) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  return polygon;
}

/// Area of a star with another height over the sector between two of its corners, and a hole in the middle.
TEST(PrismMeshProperties, RandomStarsWithHolesAndZonesAreSound) {
  Random random(20240607);
  int meshed = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Prism prism{star(random, 0.1), {}, 0.0, uniform(random, 0.001, 0.03), {}};
    double inside = 0.1;
    for (std::size_t k = 0; k < prism.outline.size(); ++k)
      inside = std::min(inside, distance(edge(prism.outline, k), Eigen::Vector2d::Zero()));
    const auto k = static_cast<std::size_t>(whole(random, 0, static_cast<int>(prism.outline.size()) - 1));
    const double top = uniform(random, 0.001, 0.06);
    const Eigen::Vector2d tip = -0.1 * inside * prism.outline[k].normalized();
    prism.zones = {{{prism.outline[k], edge(prism.outline, k)[1], tip}, 0.0, top}};
    double expected = std::abs(signed_area(prism.outline)) * prism.top +
                      std::abs(signed_area(prism.zones[0].outline)) * (top - prism.top);
    if (prism.outline.size() > 3 && whole(random, 0, 1) == 0) {
      // Beyond the tip, so that hole and zone stay apart.
      const Eigen::Vector2d centre = -0.5 * inside * prism.outline[k].normalized();
      prism.holes = {regular(centre, 0.2 * inside, whole(random, 3, 20))};
      expected -= std::abs(signed_area(prism.holes[0])) * prism.top;
    }
    if (!violations(prism).empty()) continue;  // the zone's sides may leave a star with a deep notch
    expect_sound(mesh_prism(prism, random_options(random, 0.1)), expected);
    ++meshed;
  }
  EXPECT_GT(meshed, 150);
}

/// Heights on a lattice of millimetres: the volume is a sum over its cells, whatever the polygons' order and overlap.
TEST(PrismMeshProperties, RandomStaircasesWithOverlappingZonesAreSound) {
  Random random(7);
  int meshed = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    Prism prism{{{0, 0}, {0.02, 0}}, {}, 0.0, 1e-3 * whole(random, 1, 5), {}};
    int x = 20;
    while (x > 0) {
      const double y = 1e-3 * whole(random, 10, 20);
      const int step = std::min(x, whole(random, 3, 20));
      prism.outline.emplace_back(1e-3 * x, y);
      x -= step;
      prism.outline.emplace_back(1e-3 * x, y);
    }
    const auto lattice_rectangle = [&] {
      const int x0 = whole(random, 1, 17);
      const int y0 = whole(random, 1, 7);
      return rectangle(1e-3 * x0, 1e-3 * y0, 1e-3 * whole(random, x0 + 1, 19), 1e-3 * whole(random, y0 + 1, 9));
    };
    for (int zone = whole(random, 0, 3); zone > 0; --zone)
      prism.zones.push_back({lattice_rectangle(), 0.0, 1e-3 * whole(random, 1, 30)});
    if (whole(random, 0, 1) == 0) prism.holes = {lattice_rectangle()};
    if (!violations(prism).empty()) continue;  // equal heights of neighbouring steps repeat a point
    double expected = 0.0;
    for (int cell = 0; cell < 400; ++cell) {
      const auto extent = extent_at(prism, 1e-3 * Eigen::Vector2d(cell % 20 + 0.5, std::floor(cell / 20.0) + 0.5));
      if (extent) expected += 1e-6 * (extent->top - extent->bottom);
    }
    PrismMeshOptions options = random_options(random, 0.02);
    if (whole(random, 0, 3) == 0) options.spots = {{{0.005, 0.005}, 0.001}};
    expect_sound(mesh_prism(prism, options), expected);
    expect_sound(mesh_prism(turned(prism, uniform(random, 0.0, 6.0)), options), expected);
    ++meshed;
  }
  EXPECT_GT(meshed, 100);
}

void expect_refused(const Prism& prism, const PrismMeshOptions& options, const std::string& what) {
  try {
    static_cast<void>(mesh_prism(prism, options));
    FAIL() << "accepted: " << what;
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(PrismMeshBadInput, OptionsOutOfRangeAreNamed) {
  const auto changed = [](auto change) {
    PrismMeshOptions options = sized(0.055);
    change(options);
    return options;
  };
  const Prism plate = flat_plate();
  expect_refused(plate, sized(0.0), "size is 0 mm");
  expect_refused(plate, sized(-1.0), "size is -1000 mm");
  expect_refused(plate, sized(NAN), "size is nan mm");
  expect_refused(plate, sized(0.055e-3), "it must be at least 0.212");
  expect_refused(plate, sized(0.055, -1), "layers is -1");
  expect_refused(plate, sized(0.055, 9), "layers is 9");
  expect_refused(plate, changed([](auto& o) { o.layer_factor = 0.05; }), "layer_factor is 0.05");
  expect_refused(plate, changed([](auto& o) { o.layer_factor = NAN; }), "layer_factor is nan");
  expect_refused(plate, changed([](auto& o) { o.layer_width_m = -0.001; }), "layer_width (m) is -0.001");
  expect_refused(plate, changed([](auto& o) { o.spots = {{{0.1, 0.05}, 0.0}}; }), "spot 1 at (100, 50) mm");
  expect_refused(Prism{}, sized(0.055), "the outline has 0 points");
}

TEST(PrismMeshBadInput, GradingThatCollapsesElementsIsRefused) {
  PrismMeshOptions options = sized(0.055, 8);
  options.layer_factor = 0.1;  // 6 mm · 1e-7
  expect_refused(flat_plate(), options, "the innermost of 8 layers would be");
  expect_refused(turned(flat_plate(), 0.3), options, "the innermost of 8 layers would be");
  options.layers = 5;
  EXPECT_NO_THROW(static_cast<void>(mesh_prism(flat_plate(), options)));
  // In the plane there is nothing to grade across this wall, up its height there is.
  const Prism wall{rectangle(0, 0, 0.0002, 0.0002), {}, 0.0, 0.04, {}};
  options.layers = 8;
  expect_refused(wall, options, "would be");
}

}  // namespace
}  // namespace thinwall::mesh::prism_mesh_test
