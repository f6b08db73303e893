// The memory of a solution is known from its mesh.

#include "fem/size/solution_bytes.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "fem/to_tolerance.hpp"
#include "linalg/external_factor.hpp"
#include "linalg/factor_bytes.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::solution_bytes_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};

/// A free thin plate and a free block, whose factors grow at different rates.
struct Shape {
  const char* name = "";
  mesh::TetMesh mesh;
};

std::vector<Shape> shapes() {
  return {{"plate", mesh::kuhn_box({0.3, 0.2, 0.005}, {9, 6, 1})},
          {"block", mesh::kuhn_box({0.3, 0.2, 0.15}, {4, 4, 4})}};
}

TEST(SolutionBytes, AreThoseOfTheMatricesAndTheFactor) {
  for (const Shape& shape : shapes()) {
    for (const int order : {1, 2, 4}) {
      const Model model = supported_model(shape.mesh, order, steel, {});
      ASSERT_EQ(model.rigid_motions, 6);
      const Factored factored = factorise(model);
      const double matrices = bytes_of(model.K) + bytes_of(model.M), factor = factored.factor.statistics().bytes;
      const double by_graph = linalg::factor_bytes(element_graph(shape.mesh, order));
      EXPECT_NEAR(solution_bytes(shape.mesh, order), matrices + by_graph, 1e-9 * matrices) << shape.name << order;
      EXPECT_NEAR(by_graph, factor, 0.2 * factor) << shape.name << " at order " << order;
    }
  }
}

TEST(SolutionBytes, CountTheSumThatAnotherEngineIsHanded) {
  const mesh::TetMesh mesh = mesh::kuhn_box({0.3, 0.2, 0.15}, {2, 3, 1});
  const Model model = supported_model(mesh, 2, steel, {});
  const double in_this_process = solution_bytes(mesh, 2);
  const linalg::Factoriser before = linalg::set_factoriser([](const auto&, const auto&) { return nullptr; });
  const double with_engine = solution_bytes(mesh, 2);
  (void)linalg::set_factoriser(before);
  EXPECT_NEAR(with_engine - in_this_process, bytes_of(model.K), 1e-9 * bytes_of(model.K));
}

TEST(SolutionBytes, OfAGraphHaveARowForEachDegreeOfFreedom) {
  for (int order = 1; order <= 6; ++order) {
    const mesh::TetMesh mesh = mesh::kuhn_box({0.3, 0.2, 0.15}, {2, 3, 1});
    std::size_t rows = 0;
    for (const auto& of_node : element_graph(mesh, order).rows) rows += of_node.size();
    EXPECT_EQ(rows, 3 * static_cast<std::size_t>(mesh::lagrange_node_count(mesh, order))) << order;
  }
}

/// A block at order 4 whose refinement goes on to a finer mesh, which fails as soon as its elements are asked for.
struct RoomForAFinerMesh {
  Model coarse = supported_model(mesh_of(0), 4, steel, {});
  double factor = factorise(coarse).factor.statistics().bytes_held;
  double matrices = bytes_of(coarse.K) + bytes_of(coarse.M);
  bool finer_was_begun = false;

  static mesh::TetMesh mesh_of(int level) {
    return mesh::kuhn_box({0.3, 0.2, 0.05}, {6 + 2 * level, 4 + 2 * level, 2});
  }

  /// Refines with so many bytes left when the finer mesh is made.
  Refined refined_with(double left) {
    SolidPart part;
    part.mesh = [left](int level) {
      if (level > 0) {
        core::set_memory_limit(1e12);
        core::set_memory_limit(1e12 - core::memory_left_bytes() + left);
      }
      return mesh_of(level);
    };
    part.materials = [this](const mesh::TetMesh& mesh) -> Materials {
      if (mesh.tets.size() > coarse.mesh.tets.size()) {
        finer_was_begun = true;
        throw core::NumericalError("the finer one fails");
      }
      return {{steel}, {}};
    };
    ToleranceOptions options;
    options.modes = {.count = 2, .up_to_hz = {}};
    options.first_order = 3;
    options.last_order = 4;
    options.levels = 2;
    options.tolerance = 1e-6;
    Refined refined = refine_to_tolerance(part, options);
    core::set_memory_limit(0.0);
    return refined;
  }
};

/// A finer mesh whose first two orders do not fit beside the factor and the matrices of the solution before is tried
/// without them (here with half of their bytes), and when it fails they are made again.
TEST(SolutionBytes, OfThePreviousSolutionAreGivenUpForANextOneThatNeedsThem) {
  RoomForAFinerMesh room;
  const mesh::TetMesh finer = RoomForAFinerMesh::mesh_of(1);
  const Refined refined =
      room.refined_with(solution_bytes(finer, 3) + solution_bytes(finer, 4) - 0.5 * (room.factor + room.matrices));
  EXPECT_TRUE(room.finer_was_begun) << refined.estimate.held_back_by;
  EXPECT_NE(refined.estimate.held_back_by.find("the finer one fails"), std::string::npos);
  EXPECT_EQ((refined.model.K - room.coarse.K).norm(), 0.0);
  EXPECT_EQ((refined.model.M - room.coarse.M).norm(), 0.0);
  EXPECT_EQ(refined.factored.factor.rows(), room.coarse.K.rows());
}

/// Both orders of a finer mesh are held at once, while they are compared.
TEST(SolutionBytes, OfBothOrdersOfAFinerMeshMustBeLeft) {
  RoomForAFinerMesh room;
  const mesh::TetMesh finer = RoomForAFinerMesh::mesh_of(1);
  const double higher = solution_bytes(finer, 4);
  ASSERT_GT(solution_bytes(finer, 3), 0.2 * higher);
  const Refined refined = room.refined_with(1.1 * higher - room.factor - room.matrices);
  EXPECT_FALSE(room.finer_was_begun);
  EXPECT_NE(refined.estimate.held_back_by.find("memory"), std::string::npos) << refined.estimate.held_back_by;
  EXPECT_EQ(refined.model.K.rows(), room.coarse.K.rows());
}

}  // namespace
}  // namespace thinwall::fem::solution_bytes_test
