#include "identification/plscf.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <string>

#include "core/dense_eigenvalues.hpp"
#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/median.hpp"

namespace thinwall::identification {

namespace {

using Complex = std::complex<double>;

/// The normal equations of the highest order: of the numerator R, between both S, of the denominator T less what the
/// numerator takes. Those of a lower order stand in their first rows and columns.
struct NormalEquations {
  std::vector<Eigen::MatrixXcd> R, S;  ///< of each response
  Eigen::MatrixXcd T;                  ///< summed over the responses
};

/// Σ_i e^{−iθ_i d} data_i over the lines for d = −order … order, a row each, with θ from 0 to π over the band.
Eigen::MatrixXcd moments(const MeasuredLines& m, int order, const Eigen::MatrixXcd& data) {
  const double from = m.hz(0), band = m.hz(m.lines() - 1) - from;
  Eigen::MatrixXcd turns(2 * order + 1, m.lines());
  for (Eigen::Index i = 0; i < m.lines(); ++i) {
    const double angle = std::numbers::pi * (m.hz(i) - from) / band;
    for (Eigen::Index d = 0; d <= order; ++d) {
      turns(order + d, i) = std::polar(1.0, -angle * static_cast<double>(d));
      turns(order - d, i) = std::conj(turns(order + d, i));
    }
  }
  return turns * data;
}

/// The matrix of blocks whose block (k, l) is the moment of d = l − k, of `height` × `width` numbers from a column on.
Eigen::MatrixXcd blocks(const Eigen::MatrixXcd& moments, int order, Eigen::Index first, Eigen::Index height,
                        Eigen::Index width) {
  const Eigen::Index n = order + 1;
  Eigen::MatrixXcd all(n * height, n * width);
  for (Eigen::Index k = 0; k < n; ++k) {
    for (Eigen::Index l = 0; l < n; ++l)
      all.block(k * height, l * width, height, width) =
          moments.row(order + l - k).segment(first, height * width).reshaped(height, width);
  }
  return all;
}

/// Because |z| is 1 on the lines, the products z_k* z_l depend on l − k alone.
NormalEquations normal_equations(const MeasuredLines& m, int order) {
  const Eigen::Index references = m.references(), lines = m.lines();
  NormalEquations e;
  e.T = Eigen::MatrixXcd::Zero((order + 1) * references, (order + 1) * references);
  for (Eigen::Index o = 0; o < m.responses(); ++o) {
    Eigen::MatrixXcd data(lines, 1 + references + references * references);
    for (Eigen::Index i = 0; i < lines; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const double weight = 1.0 / m.variance[at].row(o).mean();
      const Eigen::RowVectorXcd H = m.H[at].row(o);
      data(i, 0) = weight;
      data.row(i).segment(1, references) = -weight * H;
      data.row(i).tail(references * references) = weight * (H.adjoint() * H).eval().reshaped().transpose();
    }
    const Eigen::MatrixXcd sums = moments(m, order, data);
    e.R.push_back(blocks(sums, order, 0, 1, 1));
    e.S.push_back(blocks(sums, order, 1, 1, references));
    e.T += blocks(sums, order, 1 + references, references, references);
  }
  return e;
}

/// The denominator's coefficients A_0 … A_{n−1} above each other, A_n = I.
Eigen::MatrixXcd denominator(const NormalEquations& e, int order, Eigen::Index references) {
  const Eigen::Index n = order + 1, size = n * references;
  Eigen::MatrixXcd M = e.T.topLeftCorner(size, size);
  for (std::size_t o = 0; o < e.R.size(); ++o) {
    const Eigen::MatrixXcd S = e.S[o].topLeftCorner(n, size);
    M -= S.adjoint() * Eigen::PartialPivLU<Eigen::MatrixXcd>(e.R[o].topLeftCorner(n, n)).solve(S);
  }
  const Eigen::Index known = size - references;
  return Eigen::PartialPivLU<Eigen::MatrixXcd>(M.topLeftCorner(known, known))
      .solve(-M.topRightCorner(known, references));
}

std::vector<OrderPole> poles_of(const Eigen::MatrixXcd& A, int order, Eigen::Index references, double from_hz,
                                double to_hz) {
  const Eigen::Index size = order * references;
  // A(z) v = 0 with the state (v, z v, … z^{n−1} v).
  Eigen::MatrixXcd companion = Eigen::MatrixXcd::Zero(size, size);
  companion.topRightCorner(size - references, size - references).setIdentity();
  for (int k = 0; k < order; ++k)
    companion.block(size - references, k * references, references, references) =
        -A.middleRows(k * references, references);
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> solver(companion, false);
  std::vector<OrderPole> poles;
  if (solver.info() != Eigen::Success) return poles;
  const double dt = 0.5 / (to_hz - from_hz);
  for (Eigen::Index i = 0; i < size; ++i) {
    const Complex z = solver.eigenvalues()(i);
    if (!(std::abs(z) > 0.0)) continue;
    const Complex pole = Complex(0.0, 2.0 * std::numbers::pi * from_hz) - std::log(z) / dt;
    const double hz = std::abs(pole) / (2.0 * std::numbers::pi);
    if (!(pole.real() < 0.0) || !(pole.imag() > 0.0) || hz < from_hz || hz > to_hz) continue;
    // The force that B A⁻¹ answers with this pole: the left null vector of A(z), which is of rank one short.
    Eigen::MatrixXcd at = Eigen::MatrixXcd::Identity(references, references) * std::pow(z, order);
    for (int k = 0; k < order; ++k) at += A.middleRows(k * references, references) * std::pow(z, k);
    const Eigen::JacobiSVD<Eigen::MatrixXcd> svd(at, Eigen::ComputeThinU | Eigen::ComputeThinV);
    Eigen::VectorXcd left = svd.matrixU().col(references - 1).conjugate();
    Eigen::Index largest = 0;
    left.cwiseAbs().maxCoeff(&largest);
    poles.push_back({pole, left / left(largest)});
  }
  std::sort(poles.begin(), poles.end(),
            [](const OrderPole& a, const OrderPole& b) { return std::abs(a.pole) < std::abs(b.pole); });
  return poles;
}

double damping(Complex pole) {
  return -pole.real() / std::abs(pole);
}

bool alike(Complex a, Complex b) {
  return std::abs(std::abs(a) / std::abs(b) - 1.0) < 0.01 && std::abs(damping(a) - damping(b)) < 0.25 * damping(b);
}

}  // namespace

std::vector<OrderPoles> plscf(const MeasuredLines& measured, int highest_order) {
  require_usable(measured);
  if (highest_order < 1 || highest_order > 200)
    throw core::InputError("identification: a highest order of " + std::to_string(highest_order) +
                           ", must be 1 to 200");
  if (measured.lines() <= 2 * (highest_order + 1)) {
    throw core::InputError("identification: " + std::to_string(measured.lines()) + " lines for an order of " +
                           std::to_string(highest_order) + ", must be more than " +
                           std::to_string(2 * (highest_order + 1)) + "; widen the band or lower the order");
  }
  const NormalEquations equations = normal_equations(measured, highest_order);
  std::vector<OrderPoles> orders;
  for (int order = 1; order <= highest_order; ++order) {
    core::check_interrupt();
    const Eigen::MatrixXcd A = denominator(equations, order, measured.references());
    orders.push_back({order, {}});
    if (A.allFinite()) {
      orders.back().poles =
          poles_of(A, order, measured.references(), measured.hz(0), measured.hz(measured.lines() - 1));
    }
  }
  return orders;
}

std::vector<std::vector<Stability>> stabilisation(const std::vector<OrderPoles>& orders) {
  constexpr double same_frequency = 0.01, same_damping = 0.05, same_shape = 0.95;
  std::vector<std::vector<Stability>> result;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    result.emplace_back();
    for (const OrderPole& pole : orders[i].poles) {
      Stability stability;
      for (std::size_t k = 0; i > 0 && k < orders[i - 1].poles.size(); ++k) {
        const OrderPole& before = orders[i - 1].poles[k];
        Stability with;
        with.frequency = std::abs(std::abs(pole.pole) / std::abs(before.pole) - 1.0) < same_frequency;
        with.damping = with.frequency && std::abs(damping(pole.pole) / damping(before.pole) - 1.0) < same_damping;
        const double mac = std::norm(pole.participation.dot(before.participation)) /
                           (pole.participation.squaredNorm() * before.participation.squaredNorm());
        with.participation = with.frequency && mac > same_shape;
        if (with.all()) stability = with;
        if (!stability.all() && with.frequency) stability = with;
      }
      result.back().push_back(stability);
    }
  }
  return result;
}

std::vector<StablePole> stable_poles(const std::vector<OrderPoles>& orders) {
  struct Cluster {
    std::vector<double> omega, zeta;
    int last_order = 0;
    [[nodiscard]] Complex pole() const {
      const double w = core::median(omega), z = core::median(zeta);
      return {-z * w, w * std::sqrt(1.0 - z * z)};
    }
  };
  const std::vector<std::vector<Stability>> stable = stabilisation(orders);
  std::vector<Cluster> clusters;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    for (std::size_t k = 0; k < orders[i].poles.size(); ++k) {
      if (!stable[i][k].all()) continue;
      const Complex pole = orders[i].poles[k].pole;
      Cluster* nearest = nullptr;
      for (Cluster& cluster : clusters) {
        if (cluster.last_order == orders[i].order || !alike(pole, cluster.pole())) continue;
        if (nearest == nullptr || std::abs(pole - cluster.pole()) < std::abs(pole - nearest->pole()))
          nearest = &cluster;
      }
      if (nearest == nullptr) nearest = &clusters.emplace_back();
      nearest->omega.push_back(std::abs(pole));
      nearest->zeta.push_back(damping(pole));
      nearest->last_order = orders[i].order;
    }
  }
  std::vector<StablePole> result;
  constexpr std::size_t least = 3;
  for (const Cluster& cluster : clusters) {
    if (cluster.omega.size() >= least) result.push_back({cluster.pole(), static_cast<int>(cluster.omega.size())});
  }
  std::sort(result.begin(), result.end(),
            [](const StablePole& a, const StablePole& b) { return std::abs(a.pole) < std::abs(b.pole); });
  return result;
}

Eigen::VectorXcd poles_near(const std::vector<double>& hz, const std::vector<StablePole>& stable) {
  constexpr double near = 0.05, usual_damping = 0.01;
  const Eigen::ArrayXd chosen = 2.0 * std::numbers::pi * Eigen::Map<const Eigen::ArrayXd>(hz.data(), std::ssize(hz));
  Eigen::VectorXcd poles = chosen * Complex(-usual_damping, std::sqrt(1.0 - usual_damping * usual_damping));
  Eigen::ArrayXd off = near * chosen;
  for (const StablePole& candidate : stable) {
    Eigen::Index nearest = 0;
    const double distance = (chosen - std::abs(candidate.pole)).abs().minCoeff(&nearest);
    if (distance >= off(nearest)) continue;
    off(nearest) = distance;
    poles(nearest) = candidate.pole;
  }
  return poles;
}

}  // namespace thinwall::identification
