#include "reduction/trust/accuracy.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "dynamics/conversion.hpp"
#include "fem/modes.hpp"
#include "reduction/damping.hpp"
#include "reduction/trust/full_response.hpp"
#include "reduction/trust/receptance_sum.hpp"
#include "reduction/worst.hpp"
#include "tests/reduction/solid_part.hpp"

namespace thinwall::reduction::accuracy_test {
namespace {

constexpr double pi = std::numbers::pi;

/// A clamped block with two patches, its modes and its static inverse.
struct Part {
  fem::Model model = block({0.3, 0.2, 0.1}, {2, 2, 1}, 2, true);
  Interface interface = interface_at(model, {{"P", {0.3, 0.11, 0.05}, 0.03, xyz}, {"Q", {0.1, 0.2, 0.05}, 0.02, xyz}});
  StaticInverse inverse{model.K, model.node_of_row};
  Eigen::VectorXd natural_hz = dynamics::undamped_modes(dense(model.K, model.M)).omega_rad_s / (2.0 * pi);

  [[nodiscard]] dynamics::SpatialModel reduced(int modes) const {
    return craig_bampton(model.K, model.M, inverse.action(), interface, {.modes = modes, .up_to_hz = {}}).model;
  }
};

TEST(FullReceptances, EqualADenseSolve) {
  const Part part;
  const auto lines = frequencies_between(part.natural_hz.head(8), 100.0, part.natural_hz(7), 5);
  const auto full = full_receptances(part.model.K, part.model.M, part.model.node_of_row, part.interface, lines);
  ASSERT_EQ(full.size(), 5U);
  const Eigen::MatrixXd W = part.interface.W;
  for (const auto& line : full) {
    const double w = 2 * pi * line.frequency_hz;
    const Eigen::MatrixXd Z = Eigen::MatrixXd(part.model.K) - w * w * Eigen::MatrixXd(part.model.M);
    const Eigen::MatrixXd expected = W.transpose() * Z.partialPivLu().solve(W);
    EXPECT_LT((line.H - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff())
        << line.frequency_hz << " Hz";
    EXPECT_LT((line.H - line.H.transpose()).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff())
        << "reciprocity";
    EXPECT_LT(line.relative_residual, 1e-9);
  }
}

/// The second number is a good one: a comparison with NaN is false, whichever way it is written.
TEST(Accuracy, OfWhatIsNotANumberIsNotThatOfTheNextNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(worse_of(worse_of(0.0, nan), 1.0)));
  EXPECT_EQ(worse_of(worse_of(0.0, 2.0), 1.0), 2.0);
  const Part part;
  const dynamics::SpatialModel model = part.reduced(5);
  Eigen::VectorXd hz = part.natural_hz.head(3);
  EXPECT_LT(max_relative_frequency_error(model, hz, 0), 1.0);
  hz(0) = nan;
  EXPECT_TRUE(std::isnan(max_relative_frequency_error(model, hz, 0)));
  auto full = full_receptances(part.model.K, part.model.M, part.model.node_of_row, part.interface,
                               {0.5 * part.natural_hz(0), 0.7 * part.natural_hz(0)});
  EXPECT_LT(max_relative_receptance_error(model, full), 1.0);
  full[0].H(1, 1) = nan;
  EXPECT_TRUE(std::isnan(max_relative_receptance_error(model, full)));
}

TEST(Accuracy, ErrorsFallAsModesAreAddedAndVanishWithAllOfThem) {
  const Part part;
  const Eigen::VectorXd lowest = part.natural_hz.head(6);
  const auto lines = frequencies_between(part.natural_hz, 100.0, lowest(5), 5);
  const auto full = full_receptances(part.model.K, part.model.M, part.model.node_of_row, part.interface, lines);
  double frequency_before = 1e9;
  double receptance_before = 1e9;
  const int all = static_cast<int>(part.model.K.rows() - part.interface.W.cols());
  for (const int modes : {5, 10, 20, 40, 80, all}) {
    const auto reduced = part.reduced(modes);
    const double frequency = max_relative_frequency_error(reduced, lowest, 0);
    const double receptance = max_relative_receptance_error(reduced, full);
    std::printf("%3d fixed-interface modes: frequency error %.1e, receptance error %.1e\n", modes, frequency,
                receptance);
    EXPECT_LT(frequency, frequency_before);
    EXPECT_LT(receptance, receptance_before);
    frequency_before = frequency;
    receptance_before = receptance;
  }
  EXPECT_LT(frequency_before, 1e-9);
  EXPECT_LT(receptance_before, 1e-8);
}

TEST(FrequenciesBetween, AreTheMiddlesOfTheWidestGapsAwayFromEveryResonance) {
  const Eigen::VectorXd natural = (Eigen::VectorXd(4) << 50.0, 200.0, 220.0, 5000.0).finished();
  const auto lines = frequencies_between(natural, 100.0, 1000.0, 2);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_NEAR(lines[0], std::sqrt(100.0 * 200.0), 1e-9);
  EXPECT_NEAR(lines[1], std::sqrt(220.0 * 1000.0), 1e-9);
  EXPECT_EQ(frequencies_between(natural, 100.0, 1000.0, 9).size(), 3U) << "no more than there are gaps";
}

TEST(FullResponse, EqualsADirectSolveOfTheDampedFullModel) {
  const Part part;
  const fem::Factored factored = fem::factorise(part.model);
  const auto modes = fem::modes(part.model, factored, {.count = 14, .up_to_hz = {}});
  const std::vector<double> ratios{0.01, 0.02};
  const double rest = 0.005;
  const auto axis = dynamics::linear_axis(50.0, 0.8 * modes.frequency_hz(13), 40);
  const auto full =
      full_response(part.model.K, part.model.M, part.inverse.action(), modes.pairs, ratios, rest, part.interface, axis);
  EXPECT_LT(full.max_relative_residual, 1e-8);

  // The response with damping on the known modes only, as full_response() defines it, by one dense solve for each line.
  const Eigen::MatrixXd MPhi = part.model.M * modes.pairs.Phi;
  Eigen::VectorXd two_zeta_omega = 2.0 * rest * modes.pairs.lambda.cwiseSqrt();
  for (std::size_t k = 0; k < 2; ++k) two_zeta_omega(static_cast<Eigen::Index>(k)) *= ratios[k] / rest;
  const Eigen::MatrixXd C = MPhi * two_zeta_omega.asDiagonal() * MPhi.transpose();
  const Eigen::MatrixXd W = part.interface.W;
  double worst = 0.0;
  for (const Eigen::Index line : {0, 13, 26, 39}) {
    const double w = axis.omega_rad_s(line);
    Eigen::MatrixXcd Z =
        (Eigen::MatrixXd(part.model.K) - w * w * Eigen::MatrixXd(part.model.M)).cast<std::complex<double>>();
    Z.imag() = w * C;
    const Eigen::MatrixXcd expected = W.transpose() * Z.partialPivLu().solve(W.cast<std::complex<double>>());
    const Eigen::MatrixXcd& H = full.response.H[static_cast<std::size_t>(line)];
    worst = std::max(worst, (H - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff());
  }
  std::printf("full response against direct solves: %.1e, residual %.1e\n", worst, full.max_relative_residual);
  EXPECT_LT(worst, 1e-9);
  const auto too_far = dynamics::linear_axis(50.0, 0.95 * modes.frequency_hz(13), 40);
  EXPECT_THROW((void)full_response(part.model.K, part.model.M, part.inverse.action(), modes.pairs, ratios, rest,
                                   part.interface, too_far),
               core::InputError);
}

/// A chain of twelve unit masses and springs, held at one end: fewer degrees of freedom than the basis has room for.
TEST(FullResponse, IsExactWhereItsBasisHoldsTheWholeModel) {
  const int n = 12;
  Eigen::MatrixXd K = 2.0 * Eigen::MatrixXd::Identity(n, n);
  K.diagonal(1).setConstant(-1.0);
  K.diagonal(-1).setConstant(-1.0);
  K(n - 1, n - 1) = 1.0;
  const linalg::SparseMatrix sparse_K(K.sparseView());
  const linalg::SparseMatrix M(Eigen::MatrixXd(Eigen::MatrixXd::Identity(n, n)).sparseView());
  linalg::Eigenpairs pairs = linalg::dense_eigenpairs(sparse_K, M, {});
  pairs.lambda.conservativeResize(3);
  pairs.Phi.conservativeResize(Eigen::NoChange, 3);
  const Eigen::MatrixXd inverse = K.inverse();
  const linalg::ShiftedInverse action{
      [&](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd { return inverse * B; }, 0.0};
  Interface interface;
  interface.W.resize(n, 2);
  interface.W.insert(n - 1, 0) = 1.0;
  interface.W.insert(4, 1) = 1.0;
  interface.dofs = {{"tip", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation},
                    {"middle", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation}};
  const double hz = 0.85 * std::sqrt(pairs.lambda(2)) / (2.0 * std::numbers::pi);
  const auto full =
      full_response(sparse_K, M, action, pairs, {}, 0.0, interface, dynamics::linear_axis(0.1 * hz, hz, 5));
  EXPECT_LT(full.max_relative_residual, 1e-12);
  for (Eigen::Index line = 0; line < 5; ++line) {
    const double w = full.response.axis.omega_rad_s(line);
    const Eigen::MatrixXd expected =
        interface.W.transpose() * (K - w * w * Eigen::MatrixXd::Identity(n, n)).inverse() * interface.W;
    const Eigen::MatrixXd found = full.response.H[static_cast<std::size_t>(line)].real();
    EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm()) << "line " << line;
  }
}

/// Unit masses and springs in a chain, held at one end if `held`, with one link in the middle that is nearly rigid: its
/// round-off fills the residual.
struct ChainWithRigidLink {
  static constexpr int n = 60;
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  Interface interface;

  ChainWithRigidLink(double link, bool held) {
    const auto spring = [&](int i, double k) {
      K(i, i) += k;
      if (i > 0) K(i - 1, i - 1) += k;
      if (i > 0) K(i, i - 1) = K(i - 1, i) = -k;
    };
    for (int i = held ? 0 : 1; i < n; ++i) spring(i, i == n / 2 ? link : 1.0);
    interface.W.resize(n, 2);
    interface.W.insert(n - 1, 0) = 1.0;
    interface.W.insert(n / 2, 1) = 1.0;
    interface.dofs = {{"tip", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation},
                      {"middle", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation}};
  }

  /// The receptances by elimination with pivots in long double; all entries of K are exact in double precision.
  [[nodiscard]] Eigen::MatrixXd receptance(double omega) const {
    using Long = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
    const Long Z = K.cast<long double>() - static_cast<long double>(omega) * omega * Long::Identity(n, n);
    const Long W = Eigen::MatrixXd(interface.W).cast<long double>();
    return Long(W.transpose() * Z.fullPivLu().solve(W)).cast<double>();
  }
};

/// The largest error of a receptance against another, relative to its largest entry.
double largest_error(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected) {
  return (found - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

/// A sum from six modes of a chain at a share of the frequency of its mode `mode`, and by how much its receptances are
/// off, relative to the magnitudes of their terms.
struct SumOfChain {
  ReceptanceSum sum;
  double off = 0.0;

  SumOfChain(const ChainWithRigidLink& chain, Eigen::Index mode, double share) {
    const linalg::SparseMatrix K(chain.K.sparseView());
    const linalg::SparseMatrix M(Eigen::MatrixXd(Eigen::MatrixXd::Identity(chain.n, chain.n)).sparseView());
    linalg::Eigenpairs pairs = linalg::dense_eigenpairs(K, M, {});
    pairs.lambda.conservativeResize(6);
    pairs.Phi.conservativeResize(Eigen::NoChange, 6);
    const Eigen::LDLT<Eigen::MatrixXd> factor(chain.K);
    const linalg::ShiftedInverse action{
        [&](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd { return factor.solve(B); }, 0.0};
    const double omega = share * std::sqrt(pairs.lambda(mode));
    sum = receptance_sum(K, M, action, pairs, chain.interface, omega);
    const Eigen::VectorXd size =
        sum.amplitude.cwiseAbs2() * (sum.lambda.array() - omega * omega).abs().inverse().matrix();
    off = (receptance_at(sum, omega * omega).real() - chain.receptance(omega))
              .cwiseAbs()
              .cwiseQuotient((size * size.transpose()).cwiseSqrt())
              .maxCoeff();
  }
};

/// The residual is no measure: with stiff links it is round-off that hardly moves the receptances. The estimate takes
/// round-off for independent from row to row: 3 leaves room for what it adds up to by chance.
TEST(ReceptanceSum, TellsItsErrorFromSoftToNearlyRigidLinks) {
  for (const double link : {1e2, 1e4, 1e6, 1e7, 1e8, 1e9, 1e10}) {
    const SumOfChain at(ChainWithRigidLink(link, true), 5, 0.7);
    EXPECT_LT(at.off, 3.0 * at.sum.max_relative_error) << "link " << link;
    EXPECT_LT(at.sum.max_relative_error, 1e-3) << "link " << link;
  }
}

/// Near a resonance the chain moves far more than its foot, where the load is: the error of the receptance is many
/// times the residual, small as that is.
TEST(ReceptanceSum, TellsAnErrorThatIsLargerThanTheResidual) {
  for (const double link : {1.0, 1e2}) {
    ChainWithRigidLink chain(link, true);
    chain.interface.W = linalg::SparseMatrix(chain.n, 1);
    chain.interface.W.insert(0, 0) = 1.0;
    chain.interface.dofs.resize(1);
    const SumOfChain at(chain, 0, 0.9999);
    EXPECT_LT(at.sum.max_relative_residual, 1e-6) << "link " << link;
    EXPECT_GT(at.off, 3.0 * at.sum.max_relative_residual) << "the residual would do, link " << link;
    EXPECT_LT(at.off, 3.0 * at.sum.max_relative_error) << "link " << link;
    EXPECT_LT(at.sum.max_relative_error, 1e-3) << "link " << link;
  }
}

/// The estimate does not pass an answer from whose known modes one is missing.
TEST(FullResponse, SaysALargeErrorWhereItsBasisIsTooSmall) {
  const ChainWithRigidLink chain(1.0, true);
  const linalg::SparseMatrix K(chain.K.sparseView());
  const linalg::SparseMatrix M(Eigen::MatrixXd(Eigen::MatrixXd::Identity(chain.n, chain.n)).sparseView());
  linalg::Eigenpairs pairs = linalg::dense_eigenpairs(K, M, {});
  pairs.lambda.conservativeResize(20);
  pairs.lambda(19) *= 200.0;  // pretends that the modes reach far, so that few steps are made
  pairs.Phi.conservativeResize(Eigen::NoChange, 20);
  const Eigen::LDLT<Eigen::MatrixXd> factor(chain.K);
  const linalg::ShiftedInverse action{
      [&](const Eigen::Ref<const Eigen::MatrixXd>& B) -> Eigen::MatrixXd { return factor.solve(B); }, 0.0};
  const double hz = 0.5 * std::sqrt(pairs.lambda(19)) / (2.0 * std::numbers::pi);
  const auto full =
      full_response(K, M, action, pairs, {}, 0.0, chain.interface, dynamics::linear_axis(0.5 * hz, hz, 2));
  EXPECT_GT(full.max_relative_error, 1e-3);
}

/// Near the rigid motion of a free chain displacements are far larger than those of the load, and so is the error that
/// a small residual makes: at some of these links it exceeds the residual, whatever the compiler. At others the
/// residual is round-off that hardly moves the receptances.
TEST(FullReceptances, TellTheirErrorWhateverTheResidual) {
  for (const double link : {1.0, 1e4, 1e6, 1e7, 1e8, 1e9}) {
    const ChainWithRigidLink chain(link, false);
    const linalg::SparseMatrix K(chain.K.sparseView());
    const linalg::SparseMatrix M(Eigen::MatrixXd(Eigen::MatrixXd::Identity(chain.n, chain.n)).sparseView());
    std::vector<int> nodes(chain.n);
    for (int i = 0; i < chain.n; ++i) nodes[static_cast<std::size_t>(i)] = i;
    const double first = std::numbers::pi / chain.n;  // rad/s, the first elastic mode of a chain of even links
    for (const double omega : {0.2 * first, 0.4 * first, 0.6 * first}) {
      const double hz = omega / (2.0 * std::numbers::pi);
      const auto lines = full_receptances(K, M, nodes, chain.interface, {hz});
      const double error = largest_error(lines[0].H, chain.receptance(2.0 * std::numbers::pi * hz));
      std::printf("link %.0e, %.3f rad/s: residual %.1e, receptances off by %.1e, said %.1e\n", link, omega,
                  lines[0].relative_residual, error, lines[0].relative_error);
      EXPECT_LT(error, lines[0].relative_error) << "link " << link << ", " << omega << " rad/s";
      EXPECT_LT(lines[0].relative_error, 1e-3) << "link " << link << ", " << omega << " rad/s";
    }
  }
}

}  // namespace
}  // namespace thinwall::reduction::accuracy_test
