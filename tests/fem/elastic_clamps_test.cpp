// Elastic clamps between free and clamped, against closed forms.

#include "fem/elastic_clamps.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"
#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "mesh/planar/bend.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::fem::elastic_clamps_test {
namespace {

using Words = std::vector<std::string>;

const Eigen::Vector3d size(0.2, 0.05, 0.02);
const Material steel{210e9, 0.3, 7850.0};
const mesh::Region foot = mesh::PlaneRegion{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
const mesh::Region floor_face = mesh::PlaneRegion{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()};

Shaping bending(bool curved) {
  if (!curved) return {};
  return [](mesh::LagrangeNodes& nodes) { mesh::bend({0.15, 0, 2, 0.0, 0.01}, nodes.positions); };
}

Attachments clamped(const mesh::Region& region, double normal, double tangential) {
  Attachments attachments;
  attachments.clamps.push_back({"bed", region, normal, tangential});
  return attachments;
}

Modes modes_of(const Model& model, int count) {
  const Factored factored = factorise(model);
  return modes(model, factored, {.count = count, .up_to_hz = {}});
}

/// Largest relative difference of the last frequencies of both.
double difference(const Eigen::VectorXd& f, const Eigen::VectorXd& expected) {
  return (f.tail(expected.size()) - expected).cwiseQuotient(expected).cwiseAbs().maxCoeff();
}

class Clamp : public ::testing::TestWithParam<std::pair<int, bool>> {
 protected:
  [[nodiscard]] Model model(double stiffness) const {
    const auto [order, curved] = GetParam();
    return supported_model(mesh::kuhn_box(size, {4, 2, 1}), order, steel, {}, bending(curved),
                           clamped(foot, stiffness, stiffness));
  }
  [[nodiscard]] Model end(const std::vector<Support>& supports) const {
    const auto [order, curved] = GetParam();
    return supported_model(mesh::kuhn_box(size, {4, 2, 1}), order, steel, supports, bending(curved));
  }
};

// E/h is 1e12 to 1e13 N/m³ here. The error falls as 1/k, a decade of stiffness a decade of error, to 1e-6 and below.
TEST_P(Clamp, OfRisingStiffnessBecomesASupport) {
  const Eigen::VectorXd expected = modes_of(end({{"foot", foot, {0, 1, 2}}}), 8).frequency_hz;
  double before = 0.0;
  double at_end = 1.0;
  for (const double k : {1e15, 1e16, 1e17, 1e18, 1e19, 1e20}) {
    const Model held = model(k);
    EXPECT_EQ(held.rigid_motions, 0);
    const Modes found = modes_of(held, 8);
    EXPECT_TRUE((found.frequency_hz.array() < (1.0 + 1e-8) * expected.array()).all()) << "softer than a support";
    at_end = difference(found.frequency_hz, expected);
    std::printf("clamp of %.0e N/m^3: %.2e below the support\n", k, at_end);
    if (before > 1e-7 && before < 1e-3 && at_end > 1e-8) {
      EXPECT_NEAR(std::log10(before / at_end), 1.0, 0.05);
    }
    before = at_end;
  }
  EXPECT_LT(at_end, 1e-6);
}

// The elastic frequencies come from the free ones as k, the rigid ones from zero as √k.
TEST_P(Clamp, OfFallingStiffnessFreesThePart) {
  const Model free = end({});
  const Eigen::VectorXd expected = modes_of(free, 6).frequency_hz.tail(6);
  double before = 0.0;
  double at_end = 1.0;
  double rigid_before = 0.0;
  for (const double k : {1e9, 1e8, 1e7, 1e6, 1e5}) {
    const Model held = model(k);
    ASSERT_EQ(held.rigid_motions, 0);
    const Modes found = modes_of(held, 12);
    at_end = difference(found.frequency_hz, expected);
    std::printf("clamp of %.0e N/m^3: %.2e above the free part, lowest %.3g Hz\n", k, at_end, found.frequency_hz(0));
    if (before > 1e-6 && before < 1e-2) {
      EXPECT_NEAR(std::log10(before / at_end), 1.0, 0.05);
    }
    if (rigid_before > 0.0) {
      EXPECT_NEAR(rigid_before / found.frequency_hz(0), std::sqrt(10.0), 0.05);
    }
    before = at_end;
    rigid_before = found.frequency_hz(0);
  }
  EXPECT_LT(at_end, 1e-6);
  for (const double k : {0.0, 1e-8}) {  // nothing, and less than what round-off makes of K
    const Model none = model(k);
    EXPECT_EQ(none.rigid_motions, 6);
    EXPECT_EQ(none.free_motions, free.free_motions);
    EXPECT_LT(difference(modes_of(none, 6).frequency_hz, expected), 1e-9);
  }
}

TEST_P(Clamp, RaisesEveryFrequencyAsItStiffens) {
  Eigen::VectorXd before = Eigen::VectorXd::Zero(9);
  for (double k = 1e8; k < 3e15; k *= 30.0) {
    const Eigen::VectorXd now = modes_of(model(k), 9).frequency_hz;
    EXPECT_TRUE((now.array() > before.array() * (1.0 + 1e-9)).all()) << k;
    before = now;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, Clamp,
                         ::testing::Values(std::pair{1, false}, std::pair{2, false}, std::pair{4, true}));

// A block so stiff that it moves as one: z by itself, x with the turn about y, y with the turn about x, the turn about
// z by itself, each with its closed form.
TEST(ElasticBed, UnderARigidBlockHasItsSixFrequencies) {
  const Eigen::Vector3d b(0.12, 0.08, 0.05);
  const Material hard{1e15, 0.3, 7850.0};
  const double kn = 4e9;
  const double kt = 1.5e9;
  const double A = b.x() * b.y();
  const double m = 7850.0 * b.prod();
  const double d = 0.5 * b.z();  // from the bed to the centre
  std::vector<double> squares{
      kn * A / m, kt * A * (b.x() * b.x() + b.y() * b.y()) / 12.0 / (m * (b.x() * b.x() + b.y() * b.y()) / 12.0)};
  for (const double side : {b.x(), b.y()}) {
    Eigen::Matrix2d K;
    K << kt * A, kt * A * d, kt * A * d, kt * A * d * d + kn * A * side * side / 12.0;
    const Eigen::Matrix2d M = Eigen::Vector2d(m, m * (side * side + b.z() * b.z()) / 12.0).asDiagonal();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d> pair(K, M);
    squares.insert(squares.end(), pair.eigenvalues().begin(), pair.eigenvalues().end());
  }
  std::sort(squares.begin(), squares.end());
  for (const int order : {1, 2, 3}) {
    const Model block = supported_model(mesh::kuhn_box(b, {2, 2, 2}), order, hard, {}, {}, clamped(floor_face, kn, kt));
    const Modes found = modes_of(block, 6);
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double f = std::sqrt(squares[static_cast<std::size_t>(i)]) / (2.0 * std::numbers::pi);
      EXPECT_NEAR(found.frequency_hz(i) / f, 1.0, 1e-6) << "order " << order << ", mode " << i;
    }
  }
}

TEST(ElasticBed, WithoutFrictionLeavesTheSlides) {
  const Eigen::Vector3d b(0.12, 0.08, 0.05);
  const auto block = [&](double kn, double kt) {
    return supported_model(mesh::kuhn_box(b, {2, 2, 2}), 2, {1e15, 0.3, 7850.0}, {}, {}, clamped(floor_face, kn, kt));
  };
  const Model slides = block(4e9, 0.0);
  EXPECT_EQ(slides.free_motions, (Words{"translation along x", "translation along y", "rotation about z"}));
  const Modes found = modes_of(slides, 3);
  EXPECT_EQ(found.rigid_motions, 3);
  const double m = 7850.0 * b.prod();
  const auto rocking = [&](double side) {
    return std::sqrt(4e9 * b.x() * b.y() * side * side / (m * (side * side + b.z() * b.z()))) /
           (2.0 * std::numbers::pi);
  };
  EXPECT_NEAR(found.frequency_hz(3) / rocking(b.y()), 1.0, 1e-6);
  EXPECT_NEAR(found.frequency_hz(4) / rocking(b.x()), 1.0, 1e-6);
  EXPECT_NEAR(found.frequency_hz(5) / (std::sqrt(4e9 * b.x() * b.y() / m) / (2.0 * std::numbers::pi)), 1.0, 1e-6);
  EXPECT_EQ(block(0.0, 1e9).rigid_motions, 3);
  EXPECT_EQ(block(0.0, 1e9).free_motions.front(), "translation along z");
  EXPECT_EQ(block(1e21, 1e9).rigid_motions, 0) << "twelve orders apart, and neither is lost";
}

// For a cylinder's sector, ∫ n nᵀ dA is known in closed form.
TEST(ElasticClamp, OnACurvedFaceHasTheNormalsOfTheTrueSurface) {
  const mesh::TetMesh flat = mesh::kuhn_box({0.3, 0.05, 0.02}, {4, 1, 1});
  auto nodes = mesh::lagrange_nodes(flat, 5);
  mesh::bend({0.2, 0, 2, 0.0, 0.01}, nodes.positions);
  const double angle = 0.3 / 0.2;
  const double r = 0.21;
  const mesh::Region top = mesh::PlaneRegion{{0, 0, 0.02}, Eigen::Vector3d::UnitZ()};
  const std::vector<int> one_piece(static_cast<std::size_t>(nodes.positions.rows()), 0);
  const ClampStiffness clamp = clamp_stiffness(flat, nodes, one_piece, {{"top", top, 3.0, 0.5}});
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(clamp.K.rows(), 3);
  for (Eigen::Index i = 0; i < R.rows(); ++i) R(i, i % 3) = 1.0;
  const double A = r * angle * 0.05;
  Eigen::Matrix3d nn = Eigen::Matrix3d::Zero();
  nn(0, 0) = 0.05 * r * (0.5 * angle - 0.25 * std::sin(2.0 * angle));
  nn(2, 2) = 0.05 * r * (0.5 * angle + 0.25 * std::sin(2.0 * angle));
  nn(0, 2) = nn(2, 0) = 0.05 * r * 0.5 * std::pow(std::sin(angle), 2);
  const Eigen::Matrix3d expected = 3.0 * nn + 0.5 * (A * Eigen::Matrix3d::Identity() - nn);
  EXPECT_LT((R.transpose() * (clamp.K * R) - expected).norm(), 1e-8 * expected.norm());
  ASSERT_EQ(clamp.restraints.size(), 2U);
  EXPECT_NEAR(clamp.restraints[0].stiffness_N_m, 3.0 * A, 1e-8 * A);
}

TEST(ElasticClamp, OfNoFaceOrNegativeStiffnessIsAnError) {
  const auto message = [](const Attachments& attachments) -> std::string {
    try {
      (void)supported_model(mesh::kuhn_box(size, {4, 2, 1}), 1, steel, {}, {}, attachments);
    } catch (const core::InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message(clamped(mesh::PlaneRegion{{0.07, 0, 0}, {1, 0, 0}}, 1e9, 0.0)).find("\"bed\" holds no face"),
            std::string::npos);
  const std::string both = message(clamped(foot, -1.0, std::nan("")));
  EXPECT_NE(both.find("normal stiffness of clamp \"bed\""), std::string::npos);
  EXPECT_NE(both.find("tangential stiffness of clamp \"bed\""), std::string::npos);
}

}  // namespace
}  // namespace thinwall::fem::elastic_clamps_test
