#include "fem/curved_boundary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "fem/closed_part.hpp"
#include "fem/harmonic_extension.hpp"
#include "mesh/selection.hpp"
#include "mesh/surface/closed_surface.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/surface/surface_distance.hpp"
#include "mesh/volume/beneath_curves.hpp"
#include "mesh/volume/surface_to_volume.hpp"
#include "tests/mesh/kuhn_box.hpp"
#include "tests/mesh/round_surfaces.hpp"

namespace thinwall::fem::curved_boundary_test {
namespace {

constexpr double sharp_rad = 0.52;
const Material steel{210e9, 0.3, 7850.0};

/// A coarse mesh of chords within a fine surface.
mesh::TetMesh chords_of(const mesh::TriangleSurface& surface, double size_m) {
  mesh::SurfaceMeshOptions options;
  options.size.size_m = size_m;
  options.size.layers = 0;
  options.size.turn_rad = 0.7;
  options.size.deviation = 0.2;
  options.volume_tolerance = 0.1;
  options.radius_edge_ratio = 1.4;
  return mesh::mesh_closed_surface(surface, options).mesh;
}

// x, y, z and 1 are harmonic, and the elements represent them.
TEST(HarmonicExtension, OfLinearFieldsIsExact) {
  const mesh::TetMesh box = mesh::kuhn_box({1.0, 2.0, 0.1}, {2, 3, 2});
  const mesh::LagrangeNodes nodes = mesh::lagrange_nodes(box, 3);
  std::vector<bool> given;
  for (Eigen::Index node = 0; node < nodes.positions.rows(); ++node) {
    const Eigen::Array3d x = nodes.positions.row(node).transpose(), end(1.0, 2.0, 0.1);
    given.push_back((x < 1e-12).any() || (x > end - 1e-12).any());
  }
  ASSERT_GT(std::ranges::count(given, false), 50);
  Eigen::MatrixXd values = nodes.positions;
  for (std::size_t node = 0; node < given.size(); ++node)
    if (!given[node]) values.row(static_cast<Eigen::Index>(node)).setConstant(7.0);
  const Eigen::MatrixXd found = HarmonicExtension(nodes, given).extended(values);
  EXPECT_LT((found - nodes.positions).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(CurvedBoundary, CubicElementsHaveTheVolumeOfATorusThatTheirChordsMiss) {
  const mesh::TriangleSurface surface = mesh::testing::torus_surface(0.06, 0.02, 120, 60);
  const double wanted = 2.0 * std::numbers::pi * std::numbers::pi * 0.06 * 0.02 * 0.02;
  ASSERT_NEAR(mesh::volume(surface) / wanted, 1.0, 3e-3) << "the facets' own";
  const auto patches = mesh::smooth_patches(surface, sharp_rad);
  const mesh::TetMesh mesh = mesh::fitted_beneath_curves(patches, chords_of(surface, 0.014));
  EXPECT_LT(mesh::volume(mesh) / wanted, 0.98);
  const auto shape = std::make_shared<const CubicShape>(curved_onto(patches, mesh));
  EXPECT_NEAR(shape->volume_m3 / mesh::volume(surface), 1.0, 2e-3);
  for (const int order : {3, 4}) {  // cubic, whatever the order
    const Model model = supported_model(mesh, order, steel, {}, shaping_by(shape));
    EXPECT_NEAR(model.mass.mass_kg / (7850.0 * shape->volume_m3), 1.0, 1e-9) << order;
    EXPECT_GE(model.least_jacobian, 0.1) << order;
    EXPECT_GT(model.curved_elements, 0) << order;
  }
  const std::vector<int> skin = mesh::nodes_on(shape->nodes, mesh, mesh::boundary(mesh));
  const auto lies_on_it = [&](int node) {
    const Eigen::Vector3d x = shape->nodes.positions.row(node).transpose();
    const double depth = 0.02 - std::hypot(std::hypot(x(0), x(1)) - 0.06, x(2));
    return std::abs(depth) < 1e-4;  // the facets lie up to 0.03 mm within the torus, chords 1 mm
  };
  EXPECT_GT(std::ranges::count_if(skin, lies_on_it), 0.9 * static_cast<double>(skin.size()));
}

TEST(CurvedBoundary, NoTetrahedronKeepsTwoFacesOnACurvedPatch) {
  const mesh::TriangleSurface surface = mesh::testing::torus_surface(0.06, 0.02, 90, 45);
  const auto patches = mesh::smooth_patches(surface, sharp_rad);
  const mesh::TetMesh before = chords_of(surface, 0.02);
  const mesh::TetMesh mesh = mesh::fitted_beneath_curves(patches, before);
  const auto most_faces = [](const mesh::TetMesh& of) {
    std::map<int, int> faces;
    int most = 0;
    for (const auto& face : mesh::boundary(of)) most = std::max(most, ++faces[face.tet]);
    return most;
  };
  ASSERT_GT(most_faces(before), 1);
  EXPECT_EQ(most_faces(mesh), 1);
  for (int tet = 0; tet < static_cast<int>(mesh.tets.size()); ++tet) EXPECT_GT(mesh::volume(mesh, tet), 0.0);
  const mesh::TriangleSurface skin = mesh::boundary_surface(mesh);
  EXPECT_NO_THROW(mesh::require_closed(skin));
  EXPECT_EQ(skin.vertices.size(), mesh::boundary_surface(before).vertices.size());
}

/// A slender ring whose long elements are spoilt in many places where all of them follow it.
struct SlenderRing {
  mesh::TriangleSurface surface = mesh::testing::torus_surface(0.06, 0.005, 240, 48);
  mesh::SmoothPatches patches = mesh::smooth_patches(surface, sharp_rad);
  mesh::TetMesh mesh;
  explicit SlenderRing(double size_m) : mesh(mesh::fitted_beneath_curves(patches, chords_of(surface, size_m))) {}
  /// The relative error of a volume.
  [[nodiscard]] double off(double volume_m3) const { return std::abs(volume_m3 / mesh::volume(surface) - 1.0); }
};

// Elements beside spoilt ones lost two thirds more of the volume when they were made straight, too.
TEST(CurvedBoundary, ASpoiltElementLeavesTheOthersOnTheSurface) {
  const SlenderRing ring(0.005);
  const double of_chords = ring.off(mesh::volume(ring.mesh));
  ASSERT_GT(of_chords, 0.05);
  EXPECT_LT(ring.off(curved_onto(ring.patches, ring.mesh).volume_m3), of_chords / 20.0);
}

TEST(CurvedBoundary, ElementsOfLowOrdersAreHeldToo) {
  const SlenderRing ring(0.01);
  const auto shape = std::make_shared<const CubicShape>(curved_onto(ring.patches, ring.mesh, 1));
  for (const int order : {1, 2, 3})
    EXPECT_GE(supported_model(ring.mesh, order, steel, {}, shaping_by(shape)).least_jacobian, 0.1) << order;
  EXPECT_LT(ring.off(shape->volume_m3), 0.25 * ring.off(mesh::volume(ring.mesh)));
}

TEST(CurvedBoundary, PlanePartsStayAsTheyAre) {
  const mesh::TriangleSurface block = mesh::block_surface({0.1, 0.06, 0.003}, 0.01);
  const auto patches = mesh::smooth_patches(block, sharp_rad);
  EXPECT_TRUE(mesh::all_planar(patches));
  EXPECT_FALSE(mesh::all_planar(mesh::smooth_patches(mesh::testing::ball_surface(0.04, 20), sharp_rad)));
  const FirstMesh first = first_mesh(block, {});
  EXPECT_EQ(first.shape, nullptr);
}

// Lamb (1882): the torsional oscillations of degree 2 of a free sphere have ω R / c_t = 2.50113, five alike. They are
// the lowest for Poisson's ratio 0.3, where those of the spheroidal kind begin at 2.647.
TEST(CurvedBoundary, ASphereHasLambsFrequenciesByFewUnknowns) {
  const double radius = 0.04;
  const ClosedPart part = refine_closed_part(mesh::testing::ball_surface(radius, 60), steel);
  const double transverse = std::sqrt(210e9 / (2.0 * 1.3) / 7850.0);
  const double wanted = 2.50113 * transverse / (2.0 * std::numbers::pi * radius);
  EXPECT_TRUE(part.met);
  EXPECT_LT(part.refined.model.K.rows(), 40000) << "straight elements took 110 000";
  ASSERT_EQ(part.refined.modes.rigid_motions, 6);
  // The facets of the file lie up to (√2 π / 60)² / 8 = 6.9e-4 of the radius within the sphere.
  for (Eigen::Index mode = 6; mode < 11; ++mode)
    EXPECT_NEAR(part.refined.modes.frequency_hz(mode) / wanted, 1.0, part.frequency_error + 7e-4) << mode;
}

}  // namespace
}  // namespace thinwall::fem::curved_boundary_test
