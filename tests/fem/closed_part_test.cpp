#include "fem/closed_part.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "mesh/box.hpp"
#include "mesh/surface/shapes.hpp"
#include "tests/mesh/kuhn_box.hpp"
#include "tests/mesh/round_surfaces.hpp"

namespace thinwall::fem::closed_part_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};
const mesh::Box plate{{0.09, 0.06, 0.003}};

mesh::TriangleSurface plate_surface() {
  return mesh::triangulated(mesh::surface(plate));
}

TEST(ClosedPart, NodesAreCountedAsTheyAreMade) {
  const mesh::TetMesh mesh = mesh::kuhn_box({1.0, 2.0, 3.0}, {2, 3, 1});
  for (int order = 1; order <= 6; ++order)
    EXPECT_EQ(mesh::lagrange_node_count(mesh, order), mesh::lagrange_nodes(mesh, order).positions.rows()) << order;
  EXPECT_THROW((void)mesh::lagrange_node_count(mesh, 7), core::InputError);
}

TEST(ClosedPart, AnEdgeThatTurnsInwardsIsTold) {
  EXPECT_FALSE(has_reentrant_edge(plate_surface()));
  EXPECT_FALSE(has_reentrant_edge(mesh::surface(mesh::CylinderSector{}, 0.01))) << "a smooth hollow is no edge";
  EXPECT_TRUE(has_reentrant_edge(mesh::surface(mesh::LPocket{}, 0.01)));
}

// A fifth of the tolerance stands for the truth; against other meshes: tests/verification/real_parts.
TEST(ClosedPart, ATighterToleranceFindsTheEarlierOneWithinItsEstimate) {
  ClosedPartOptions options;
  options.supports = {{"foot", mesh::face_of(plate, "x_min"), {0, 1, 2}}};
  const ClosedPart coarse = refine_closed_part(plate_surface(), steel, options);
  options.tolerance = 2e-3;
  options.first_order = 4;
  const ClosedPart fine = refine_closed_part(plate_surface(), steel, options);
  ASSERT_TRUE(coarse.met);
  ASSERT_TRUE(fine.met);
  const auto error = (coarse.refined.modes.frequency_hz.array() / fine.refined.modes.frequency_hz.array() - 1.0).abs();
  EXPECT_LT(error.maxCoeff(), coarse.frequency_error + fine.frequency_error);
  EXPECT_GE(fine.refined.model.K.rows(), coarse.refined.model.K.rows());
}

TEST(ClosedPart, KeepsWithinTheBoundOnDegreesOfFreedomAndSaysSo) {
  ClosedPartOptions options;
  options.tolerance = 1e-3;
  options.levels = 2;
  const auto free = refine_closed_part(plate_surface(), steel, options);
  const auto& steps = free.refined.estimate.steps;
  ASSERT_GE(steps.size(), 3U) << "three orders at least";
  options.largest_dofs = steps[1].dofs + 1;
  const auto bounded = refine_closed_part(plate_surface(), steel, options);
  EXPECT_EQ(bounded.refined.estimate.held_back_by, "the next model would be too large");
  EXPECT_FALSE(bounded.met);
  EXPECT_EQ(bounded.refined.model.K.rows(), steps[1].dofs);
  EXPECT_GT(bounded.frequency_error, options.tolerance);
  options.largest_dofs = steps[1].dofs - 1;
  options.first_dofs = 0;
  try {
    (void)refine_closed_part(plate_surface(), steel, options);
    FAIL() << "above the bound";
  } catch (const core::InputError& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(steps[1].dofs) + " degrees of freedom at order 4"),
              std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("lower part.mesh.order"), std::string::npos) << error.what();
  }
}

// The first answer comes by lower orders; refinement then goes on as it would have, on the same mesh,
// although a finer one is left and the error of low orders is far above the tolerance.
TEST(ClosedPart, BeginsAtTheOrderThatIsSmallEnoughAndEndsTheSame) {
  ClosedPartOptions options;
  options.levels = 2;
  options.supports = {{"foot", mesh::face_of(plate, "x_min"), {0, 1, 2}}};
  const ClosedPart usual = refine_closed_part(plate_surface(), steel, options);
  ASSERT_TRUE(usual.met);
  const mesh::TetMesh mesh = first_mesh(plate_surface(), options).mesh;
  EXPECT_EQ(first_order_on(mesh, options), 3);
  for (const int order : {2, 1}) {
    options.first_dofs = 3 * mesh::lagrange_node_count(mesh, order + 1);
    EXPECT_EQ(first_order_on(mesh, options), order);
    const ClosedPart found = refine_closed_part(plate_surface(), steel, options);
    EXPECT_EQ(found.refined.estimate.steps.front().order, order);
    EXPECT_TRUE(found.met);
    EXPECT_EQ(found.refined.level, usual.refined.level);
    const auto change =
        (found.refined.modes.frequency_hz.array() / usual.refined.modes.frequency_hz.array() - 1.0).abs();
    EXPECT_LT(change.maxCoeff(), found.frequency_error + usual.frequency_error) << order;
  }
}

// The foot's first mode lies just below the frequency asked for; at order 2 it lies above.
TEST(ClosedPart, LowOrdersAreNotTriedForModesUpToAFrequency) {
  ClosedPartOptions options;
  options.supports = {{"foot", mesh::face_of(plate, "x_min"), {0, 1, 2}}};
  options.modes.count = 1;
  const auto first = std::make_shared<const FirstMesh>(first_mesh(plate_surface(), options));
  options.first = first;
  const ClosedPart usual = refine_closed_part(plate_surface(), steel, options);
  options.modes.up_to_hz = 1.01 * usual.refined.modes.frequency_hz(0);
  options.first_dofs = 3 * mesh::lagrange_node_count(first->mesh, 2);
  EXPECT_EQ(first_order_on(first->mesh, options), 3);
  EXPECT_TRUE(refine_closed_part(plate_surface(), steel, options).met);
  options.largest_dofs = options.first_dofs;
  EXPECT_EQ(first_order_on(first->mesh, options), 1) << "but where the part has no answer otherwise";
}

// Curved elements of this wall miss the volume by 5e-4, straight ones by less, with five times as many.
TEST(ClosedPart, CurvedElementsAreTakenWhereStraightOnesAreTooManyToBeSolved) {
  const mesh::TriangleSurface surface = mesh::surface(mesh::CylinderSector{}, 0.008);
  ClosedPartOptions options;
  options.tolerance = 1e-3;
  const FirstMesh straight = first_mesh(surface, options);
  ASSERT_FALSE(straight.shape) << straight.fit.volume_error_relative;
  options.largest_dofs = 3 * mesh::lagrange_node_count(straight.mesh, 2) - 1;
  const FirstMesh curved = first_mesh(surface, options);
  EXPECT_TRUE(curved.shape);
  EXPECT_LE(3 * mesh::lagrange_node_count(curved.mesh, 2), options.largest_dofs);
}

TEST(ClosedPart, APartThatIsTooLargeForTheUsualOrdersHasAnAnswer) {
  ClosedPartOptions options;
  const mesh::TetMesh mesh = first_mesh(plate_surface(), options).mesh;
  options.largest_dofs = 3 * mesh::lagrange_node_count(mesh, 2);
  const ClosedPart found = refine_closed_part(plate_surface(), steel, options);
  EXPECT_EQ(found.refined.model.nodes.order, 2);
  EXPECT_FALSE(found.met);
  EXPECT_GT(found.frequency_error, options.tolerance);
  EXPECT_EQ(found.refined.estimate.held_back_by, "the next model would be too large");
  options.largest_dofs -= 1;
  EXPECT_THROW((void)refine_closed_part(plate_surface(), steel, options), core::InputError);
}

// Chords of a ball enclose less than it; cubic elements a little less.
TEST(ClosedPart, TheVolumeThatAModelMissesIsPartOfItsError) {
  const mesh::TriangleSurface surface = mesh::testing::ball_surface(0.04, 30);
  ClosedPartOptions options;
  std::vector<FirstMesh> meshes;
  const SolidPart part = solid_part(surface, steel, options, meshes);
  const mesh::TetMesh mesh = part.mesh(0);
  double last = 1.0;
  for (const int order : {1, 2, 3}) {
    const Model model = supported_model(mesh, order, steel, {}, part.shaping(mesh));
    const double missed = std::abs(model.mass.mass_kg / (steel.density_kg_m3 * mesh::volume(surface)) - 1.0);
    EXPECT_NEAR(part.shape_error(model), missed, 1e-14);  // round-off of quotients about one
    EXPECT_LT(missed, last) << order;
    last = missed;
  }
  EXPECT_LT(last, 0.4 * options.tolerance);
  ClosedPartOptions of_a_solid = options;
  of_a_solid.solid_volume_m3 = 1.01 * mesh::volume(surface);  // chords of a file lose a hundredth
  const Model model = supported_model(mesh, 2, steel, {}, part.shaping(mesh));
  EXPECT_NEAR(solid_part(surface, steel, of_a_solid, meshes).shape_error(model),
              std::abs(model.mass.mass_kg / (steel.density_kg_m3 * of_a_solid.solid_volume_m3) - 1.0), 1e-14);
  SolidPart alone = part;
  alone.mesh = [&mesh](int) { return mesh; };
  alone.shape_error = nullptr;
  ToleranceOptions steps;
  steps.modes = options.modes;
  steps.first_order = 1;
  steps.last_order = 2;
  steps.levels = 1;
  const double elements = refine_to_tolerance(alone, steps).estimate.frequency;
  alone.shape_error = part.shape_error;
  const Refined whole = refine_to_tolerance(alone, steps);
  EXPECT_GT(part.shape_error(whole.model), 1e-4);
  EXPECT_NEAR(whole.estimate.frequency - elements, part.shape_error(whole.model), 1e-7);
}

TEST(ClosedPart, AFirstMeshThatIsAtHandIsNotMadeAgain) {
  ClosedPartOptions options;
  options.supports = {{"foot", mesh::face_of(plate, "x_min"), {0, 1, 2}}};
  const ClosedPart made = refine_closed_part(plate_surface(), steel, options);
  FirstMesh first = first_mesh(plate_surface(), options);
  EXPECT_EQ(first.fit.mesher, made.fits[0].mesher);
  first.fit.mesher = "at hand";
  options.first = std::make_shared<FirstMesh>(first);
  const ClosedPart taken = refine_closed_part(plate_surface(), steel, options);
  EXPECT_EQ(taken.fits[0].mesher, "at hand");
  EXPECT_EQ(taken.refined.modes.frequency_hz, made.refined.modes.frequency_hz);
}

TEST(ClosedPart, TheFirstLevelIsTheAnswerWhereItsTimeIsOver) {
  ClosedPartOptions options;
  options.tolerance = 1e-3;
  options.levels = 2;
  options.time_budget_s = 1e-9;
  const ClosedPart first = refine_closed_part(plate_surface(), steel, options);
  EXPECT_EQ(first.refined.level, 0);
  EXPECT_FALSE(first.met);
  EXPECT_EQ(first.refined.estimate.steps.size(), 2U);
  EXPECT_EQ(first.fits.size(), 1U);
}

TEST(ClosedPart, PointsThatDoNotSeeHowAFreePartMovesEndItBeforeItIsRefined) {
  const mesh::TriangleSurface surface = plate_surface();
  ClosedPartOptions options;
  options.tolerance = 1e-3;
  options.levels = 2;
  options.points_hold = true;
  const auto at = [&](std::size_t vertex) {
    return NamedPoint{"P" + std::to_string(vertex),
                      surface.vertices[vertex],
                      0.0,
                      {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}};
  };
  options.points = {at(0)};
  try {
    (void)refine_closed_part(surface, steel, options);
    FAIL() << "one point sees no turn";
  } catch (const core::InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("in 6 ways (translation along x"), std::string::npos) << text;
    EXPECT_NE(text.find("see 3 of them: add a support, or a point"), std::string::npos) << text;
  }
  options.points = {at(0), at(1)};
  EXPECT_THROW((void)refine_closed_part(surface, steel, options), core::InputError) << "the turn about their line";
  options.tolerance = 0.1;
  options.levels = 1;
  options.points = {at(0), at(1), at(2)};
  EXPECT_EQ(refine_closed_part(surface, steel, options).refined.modes.rigid_motions, 6);
}

TEST(ClosedPart, RefusesWhatCannotBe) {
  ClosedPartOptions options;
  options.tolerance = 1e-4;
  EXPECT_THROW((void)refine_closed_part(plate_surface(), steel, options), core::InputError);
  options = {};
  options.levels = 0;
  EXPECT_THROW((void)refine_closed_part(plate_surface(), steel, options), core::InputError);
  mesh::TriangleSurface open = plate_surface();
  open.triangles.pop_back();
  EXPECT_THROW((void)refine_closed_part(open, steel), core::InputError);
}

}  // namespace
}  // namespace thinwall::fem::closed_part_test
