#include "fem/model.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include "core/error.hpp"
#include "fem/mode_check.hpp"
#include "fem/modes.hpp"
#include "fem/points.hpp"
#include "fem/supports.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::model_test {
namespace {

const Material steel{210e9, 0.3, 7850.0};
const mesh::Box box{{0.3, 0.2, 0.15}};

Support face(const std::string& name, std::vector<int> axes = {0, 1, 2}) {
  return {name, mesh::face_of(box, name), std::move(axes)};
}

Model block(int order, const std::vector<Support>& supports) {
  return supported_model(mesh::kuhn_box(box.size, {2, 2, 2}), order, steel, supports);
}

TEST(Model, FreeRigidMotionsAreThoseThatTheSupportsLeave) {
  EXPECT_EQ(block(2, {}).rigid_motions, 6);
  EXPECT_EQ(block(2, {face("x_min")}).rigid_motions, 0);
  EXPECT_EQ(block(2, {face("x_min", {0})}).rigid_motions, 3) << "slides in y and z, turns about x";
  EXPECT_EQ(block(2, {face("x_min", {0}), face("y_min", {1})}).rigid_motions, 1) << "slides in z";
  EXPECT_EQ(block(2, {face("x_min", {0}), face("y_min", {1}), face("z_min", {2})}).rigid_motions, 0);
  EXPECT_EQ(block(2, {face("x_min", {0}), face("y_min", {1})}).free_motions,
            std::vector<std::string>{"translation along z"});
}

TEST(Model, ConstraintsStrikeOutTheRowsOfTheSupport) {
  const Model model = block(3, {face("y_min"), face("z_max", {2})});
  const int n = 7 * 7;
  EXPECT_EQ(model.K.rows(), 3 * 7 * n - 3 * n - (n - 7));
  ASSERT_EQ(model.free_rows.size(), static_cast<std::size_t>(model.K.rows()));
  for (std::size_t i = 0; i < model.free_rows.size(); ++i) {
    ASSERT_EQ(model.node_of_row[i], model.free_rows[i] / 3);
    const Eigen::Vector3d x = model.nodes.positions.row(model.free_rows[i] / 3);
    EXPECT_GT(x.y(), 1e-12);
    EXPECT_TRUE(model.free_rows[i] % 3 != 2 || x.z() < box.size.z() - 1e-12);
  }
  const Eigen::VectorXd u = Eigen::VectorXd::LinSpaced(model.K.rows(), 1.0, 2.0);
  const auto all = displacements(model, u);
  EXPECT_NEAR(all.sum(), u.sum(), 1e-9);
  for (Eigen::Index i = 0; i < all.rows(); ++i) {
    EXPECT_EQ(all(i, 1) == 0.0, model.nodes.positions(i, 1) == 0.0) << "held nodes, and only they, stay";
  }
  EXPECT_LT(relative_difference(model.mass, box_mass_properties(box.size, 7850.0)), 1e-12) << "before constraining";
}

TEST(Model, WithEveryNodeHeldIsAnError) {
  std::vector<int> all(3 * 27);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_THROW((void)build_model(mesh::kuhn_box(box.size, {2, 2, 2}), 1, steel, all), core::InputError);
}

Eigen::VectorXd elastic_frequencies(mesh::TetMesh mesh, int order) {
  const Model model = build_model(std::move(mesh), order, steel, {});
  const auto factored = factorise(model);
  const Modes found = modes(model, factored, {.count = 6, .up_to_hz = {}});
  EXPECT_EQ(found.rigid_motions, 6);
  EXPECT_EQ(check_modes(model, factored, found).status, linalg::EigenCheckStatus::agrees);
  return found.frequency_hz.tail(6);
}

TEST(Model, FrequenciesDoNotChangeWhenThePartIsTurnedOrItsNumbersShuffled) {
  for (const int order : {1, 2, 3}) {
    const mesh::TetMesh mesh = mesh::kuhn_box(box.size, {2, 2, 2});
    const Eigen::VectorXd expected = elastic_frequencies(mesh, order);
    mesh::TetMesh turned = mesh;
    const Eigen::Matrix3d Q = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -3).normalized()).toRotationMatrix();
    for (auto& x : turned.vertices) x = Q * x + Eigen::Vector3d(3, -1, 2);
    EXPECT_LT((elastic_frequencies(turned, order) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-9);

    mesh::TetMesh shuffled = mesh;
    std::mt19937 random(3);
    std::vector<int> number(mesh.vertices.size());
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), random);
    for (std::size_t v = 0; v < number.size(); ++v)
      shuffled.vertices[static_cast<std::size_t>(number[v])] = mesh.vertices[v];
    for (auto& tet : shuffled.tets) {
      for (int& v : tet) v = number[static_cast<std::size_t>(v)];
      tet = {tet[2], tet[0], tet[1], tet[3]};  // an even permutation of its corners
    }
    std::shuffle(shuffled.tets.begin(), shuffled.tets.end(), random);
    EXPECT_LT((elastic_frequencies(shuffled, order) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(Modes, AgreeWithTheDenseSpectrumAndTheSturmCount) {
  const Model model = block(2, {face("x_min")});
  const auto dense = linalg::dense_eigenpairs(model.K, model.M, {});
  const auto factored = factorise(model);
  const Modes by_count = modes(model, factored, {.count = 9, .up_to_hz = {}});
  ASSERT_EQ(by_count.frequency_hz.size(), 9);
  EXPECT_LT((by_count.pairs.lambda - dense.lambda.head(9)).cwiseQuotient(dense.lambda.head(9)).cwiseAbs().maxCoeff(),
            1e-10);
  EXPECT_EQ(check_modes(model, factored, by_count).status, linalg::EigenCheckStatus::agrees);
  const double bound = 0.5 * (by_count.frequency_hz(4) + by_count.frequency_hz(5));
  const Modes by_band = modes(model, factored, {.count = 1, .up_to_hz = bound});
  EXPECT_EQ(by_band.frequency_hz.size(), 5);
  EXPECT_FALSE(by_band.check.has_value());
  EXPECT_THROW((void)modes(model, factored, {.count = 1, .up_to_hz = 1.0}), core::InputError);
}

TEST(NamedPoint, WeighsALinearFieldToItsValueAtThePoint) {
  for (const int order : {1, 2, 4}) {
    const Model model = block(order, {});
    Eigen::Matrix3d A;
    A << 1, 2, 3, -1, 0.5, 2, 0.3, -2, 1;
    Eigen::VectorXd u(model.K.rows());
    for (Eigen::Index i = 0; i < model.nodes.positions.rows(); ++i) {
      u.segment<3>(3 * i) = A * model.nodes.positions.row(i).transpose();
    }
    const Eigen::Vector3d x(0.3, 0.11, 0.07);
    const Eigen::Vector3d n = Eigen::Vector3d(0.6, 0.0, 0.8);
    for (const double radius : {0.0, 0.02}) {
      const auto W = point_columns(model, {"P", x, radius, {n, Eigen::Vector3d::UnitY()}});
      ASSERT_EQ(W.cols(), 2);
      EXPECT_NEAR((W.transpose() * u)(0), n.dot(A * x), 1e-12) << "order " << order << ", radius " << radius;
      EXPECT_NEAR((W.transpose() * u)(1), (A * x).y(), 1e-12);
    }
  }
}

TEST(NamedPoint, OnASupportOrOffThePartIsAnErrorWithItsName) {
  const Model model = block(2, {face("x_min"), face("y_min", {1})});
  const auto message = [&](const Eigen::Vector3d& x, double radius, const Eigen::Vector3d& n) -> std::string {
    try {
      (void)point_columns(model, {"P", x, radius, {n}});
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message({0, 0.1, 0.07}, 0.0, {1, 0, 0}).find("\"P\" cannot move"), std::string::npos);
  EXPECT_NE(message({0.1, 0, 0.07}, 0.01, {0, 1, 0}).find("\"P\" cannot move"), std::string::npos);
  EXPECT_EQ(message({0.1, 0, 0.07}, 0.01, {1, 0, 0}), "no error") << "slides along the roller";
  EXPECT_NE(message({0.1, -0.01, 0.07}, 0.01, {1, 0, 0}).find("point \"P\": "), std::string::npos);
}

}  // namespace
}  // namespace thinwall::fem::model_test
