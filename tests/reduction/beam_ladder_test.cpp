// Ten planar beam elements in a row, a cantilever split into two superelements at its middle node: the public Nastran
// problem of NASTRAN_CoFE. L = 10 each 1, A = 0.1, I = 0.01, E = 2.9e7, ρ = 7.357e-4, lumped mass; all digits given.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "dynamics/conversion.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "reduction/methods/craig_bampton.hpp"

namespace thinwall::reduction::beam_ladder_test {
namespace {

constexpr double EI = 2.9e7 * 0.01;
constexpr double mass_per_length = 7.357e-4 * 0.1;

struct Beam {
  Eigen::MatrixXd K;
  Eigen::MatrixXd M;
};

/// Euler-Bernoulli elements of length 1 on nodes with (w, θ); half of each element's mass at each end, none in
/// rotation.
Beam beam(int elements) {
  const Eigen::Index n = 2 * (elements + 1);
  Beam b{Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n)};
  Eigen::Matrix4d k;
  k << 12, 6, -12, 6, 6, 4, -6, 2, -12, -6, 12, -6, 6, 2, -6, 4;
  for (Eigen::Index e = 0; e < elements; ++e) {
    b.K.block<4, 4>(2 * e, 2 * e) += EI * k;
    b.M(2 * e, 2 * e) += mass_per_length / 2;
    b.M(2 * e + 2, 2 * e + 2) += mass_per_length / 2;
  }
  return b;
}

/// The beam on the DOFs `kept`. The others carry no mass, so that they follow statically, without error:
/// K = K_kk − K_kc K_cc⁻¹ K_ck (Guyan 1965).
Beam condense(const Beam& full, const std::vector<int>& kept, const std::vector<int>& massless) {
  const Eigen::MatrixXd Kkc = full.K(kept, massless);
  const Eigen::MatrixXd Kcc = full.K(massless, massless);
  return {full.K(kept, kept) - Kkc * Kcc.partialPivLu().solve(Kkc.transpose()), full.M(kept, kept)};
}

/// One half: its deflections, and at the interface node the rotation too, which stay visible (w first, then θ).
struct Half {
  linalg::SparseMatrix K;
  linalg::SparseMatrix M;
  Interface interface;
};

Half half(const std::vector<int>& deflections, const std::vector<int>& inner_rotations, int interface_node) {
  std::vector<int> kept{2 * interface_node, 2 * interface_node + 1};
  kept.insert(kept.end(), deflections.begin(), deflections.end());
  const Beam b = condense(beam(5), kept, inner_rotations);
  Half result{b.K.sparseView(), b.M.sparseView(), {}};
  result.interface.W.resize(b.K.rows(), 2);
  result.interface.W.insert(0, 0) = 1.0;
  result.interface.W.insert(1, 1) = 1.0;
  result.interface.W.makeCompressed();
  result.interface.dofs = {{"node 6", Eigen::Vector3d::UnitZ(), dynamics::DofKind::translation},
                           {"node 6", Eigen::Vector3d::UnitY(), dynamics::DofKind::rotation}};
  return result;
}

/// Nodes 6 … 11: free but for the interface.
Half tip_half() {
  return half({2, 4, 6, 8, 10}, {3, 5, 7, 9, 11}, 0);
}
/// Nodes 1 … 6: node 1 clamped.
Half root_half() {
  return half({2, 4, 6, 8}, {3, 5, 7, 9}, 5);
}

CraigBampton reduced(const Half& h, int modes) {
  const linalg::SparseMatrix K = restrained(h.K, h.interface);
  std::vector<int> nodes(static_cast<std::size_t>(K.rows()));
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<int>(i);
  const linalg::SparseCholesky factor(K, nodes);
  const linalg::ShiftedInverse inverse{[&](const Eigen::Ref<const Eigen::MatrixXd>& B) { return factor.solve(B); },
                                       0.0};
  return craig_bampton(h.K, h.M, inverse, h.interface, {.modes = modes, .up_to_hz = {}});
}

Eigen::VectorXd hertz(const dynamics::SpatialModel& model) {
  return dynamics::undamped_modes(model).omega_rad_s / (2.0 * std::numbers::pi);
}

/// The two halves over the shared (w, θ) of node 6, followed by the modes of the tip and those of the root.
Eigen::VectorXd coupled(int tip_modes, int root_modes) {
  const CraigBampton tip = reduced(tip_half(), tip_modes);
  const CraigBampton root = reduced(root_half(), root_modes);
  const Eigen::Index n = 2 + tip_modes + root_modes;
  dynamics::SpatialModel whole{
      Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), Eigen::MatrixXd::Zero(n, n), {}, {}};
  whole.dofs.resize(static_cast<std::size_t>(n));
  std::vector<int> tip_rows{0, 1};
  std::vector<int> root_rows{0, 1};
  for (int k = 0; k < tip_modes; ++k) tip_rows.push_back(2 + k);
  for (int k = 0; k < root_modes; ++k) root_rows.push_back(2 + tip_modes + k);
  whole.K(tip_rows, tip_rows) += tip.model.K;
  whole.M(tip_rows, tip_rows) += tip.model.M;
  whole.K(root_rows, root_rows) += root.model.K;
  whole.M(root_rows, root_rows) += root.model.M;
  return hertz(whole);
}

Eigen::VectorXd full() {
  std::vector<int> deflections;
  std::vector<int> rotations;
  for (int node = 1; node <= 10; ++node) {
    deflections.push_back(2 * node);
    rotations.push_back(2 * node + 1);
  }
  const Beam b = condense(beam(10), deflections, rotations);
  dynamics::SpatialModel model{b.M, Eigen::MatrixXd::Zero(10, 10), b.K, {}, dynamics::DofTable(10)};
  return hertz(model);
}

/// Equal in all seven digits given: within half a unit of the last, and the round-off of its decimal form.
void expect_digits(const Eigen::VectorXd& found, const std::vector<double>& published) {
  ASSERT_GE(found.size(), static_cast<Eigen::Index>(published.size()));
  for (std::size_t k = 0; k < published.size(); ++k) {
    const double unit = std::pow(10.0, std::floor(std::log10(published[k])) - 6.0);
    EXPECT_NEAR(found(static_cast<Eigen::Index>(k)), published[k], 0.501 * unit) << "mode " << k + 1;
  }
}

TEST(BeamLadder, FullModelHasThePublishedFrequencies) {
  expect_digits(full(), {349.7288, 2167.324, 6007.803, 11650.23, 19044.54});
}

TEST(BeamLadder, FixedInterfaceModesOfBothHalvesAreThePublishedOnes) {
  expect_digits(reduced(tip_half(), 3).fixed_interface_hz, {1380.011, 8287.086, 22364.10});
  expect_digits(reduced(root_half(), 3).fixed_interface_hz, {8933.322, 24361.77, 45213.12});
}

TEST(BeamLadder, ThreeModesAHalf) {
  expect_digits(coupled(3, 3), {349.7289, 2167.436, 6008.068, 11670.88, 19073.61});
}
TEST(BeamLadder, OneModeAHalf) {
  expect_digits(coupled(1, 1), {349.7555, 2182.490, 6733.634, 18222.00});
}
TEST(BeamLadder, NoModesAreGuyansReduction) {
  expect_digits(coupled(0, 0), {359.0738, 2934.100});
}

// All fixed-interface modes cannot be kept here: the rotation at the interface has no mass of its own, and M would be
// singular.
TEST(BeamLadder, MoreModesComeCloserToTheFullModelFromAbove) {
  const Eigen::VectorXd exact = full();
  Eigen::VectorXd before = Eigen::VectorXd::Constant(2, 1e9);
  for (int modes = 0; modes <= 3; ++modes) {
    const Eigen::VectorXd found = coupled(modes, modes);
    for (Eigen::Index k = 0; k < 2; ++k) {
      EXPECT_GT(found(k), exact(k) * (1 - 1e-12));
      EXPECT_LT(found(k), before(k) * (1 + 1e-12));
    }
    before = found.head(2);
  }
}

}  // namespace
}  // namespace thinwall::reduction::beam_ladder_test
