#include "linalg/complex_eigenvalues.hpp"

#include <cmath>
#include <complex>
#include <limits>
#include <vector>

#include "core/interrupt.hpp"

namespace thinwall::linalg {

namespace {

using Eigen::Index;
using std::complex;

/// Without the care for infinities of std::complex, which costs more than the product.
complex<double> times(complex<double> a, complex<double> b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

double size(complex<double> a) {
  return std::abs(a.real()) + std::abs(a.imag());
}

/// Hessenberg's form by elimination with pivots: with factors of at most 1 it serves as well as reflections in
/// practice, at half their cost (Golub & Van Loan 2013, 7.4.7).
void to_hessenberg(Eigen::MatrixXcd& H) {
  const Index n = H.rows();
  for (Index m = 1; m + 1 < n; ++m) {
    core::check_interrupt();
    Index pivot = m;
    for (Index i = m + 1; i < n; ++i) {
      if (size(H(i, m - 1)) > size(H(pivot, m - 1))) pivot = i;
    }
    if (size(H(pivot, m - 1)) == 0.0) continue;
    if (pivot != m) {
      H.row(pivot).swap(H.row(m));
      H.col(pivot).swap(H.col(m));
    }
    const complex<double> inverse = 1.0 / H(m, m - 1);
    const Index rest = n - m - 1;
    const Eigen::VectorXcd factor = inverse * H.col(m - 1).tail(rest);
    H.col(m - 1).tail(rest).setZero();
    for (Index j = m; j < n; ++j) {
      const complex<double> above = H(m, j);
      H.col(j).tail(rest) -= above * factor;
    }
    for (Index i = 0; i < rest; ++i) {
      const complex<double> f = factor(i);
      H.col(m) += f * H.col(m + 1 + i);
    }
  }
}

/// [c s; −s̄ c], which takes (a, b) to (r, 0).
struct Rotation {
  double c;
  complex<double> s;

  Rotation(complex<double> a, complex<double> b) {
    const double length = std::sqrt(std::norm(a) + std::norm(b));
    const double of_a = std::sqrt(std::norm(a));
    c = length > 0.0 ? of_a / length : 1.0;
    if (of_a > 0.0) s = times(a, std::conj(b)) * (1.0 / (of_a * length));
    else s = length > 0.0 ? std::conj(b) / length : 0.0;
  }

  void turn(complex<double>& x, complex<double>& y) const {
    const complex<double> first = c * x + times(s, y);
    y = c * y - times(std::conj(s), x);
    x = first;
  }

  [[nodiscard]] Rotation conjugate() const {
    Rotation result = *this;
    result.s = std::conj(s);
    return result;
  }
};

/// The eigenvalue of the last 2 × 2 block of rows up to `last` that is nearer to its last entry.
complex<double> wilkinson_shift(const Eigen::MatrixXcd& H, Index last) {
  const complex<double> half = 0.5 * (H(last - 1, last - 1) - H(last, last));
  const complex<double> product = times(H(last - 1, last), H(last, last - 1));
  complex<double> root = std::sqrt(times(half, half) + product);
  if ((std::conj(half) * root).real() < 0.0) root = -root;
  const complex<double> sum = half + root;
  return size(sum) > 0.0 ? H(last, last) - product / sum : H(last, last);
}

/// H − σ = QR, H ← RQ + σ, on rows and columns first to last. Each rotation turns all columns to its right at once,
/// which do not wait for one another.
void qr_step(Eigen::MatrixXcd& H, Index first, Index last, complex<double> shift, std::vector<Rotation>& rotations) {
  rotations.clear();
  for (Index j = first; j <= last; ++j) H(j, j) -= shift;
  for (Index k = first; k < last; ++k) {
    const Rotation rotation = rotations.emplace_back(H(k, k), H(k + 1, k));
    for (Index j = k; j <= last; ++j) rotation.turn(H(k, j), H(k + 1, j));
  }
  for (Index k = first; k < last; ++k) {
    const Rotation from_right = rotations[static_cast<std::size_t>(k - first)].conjugate();
    for (Index i = first; i <= k + 1; ++i) from_right.turn(H(i, k), H(i, k + 1));
  }
  for (Index j = first; j <= last; ++j) H(j, j) += shift;
}

}  // namespace

std::optional<Eigen::VectorXcd> complex_eigenvalues(const Eigen::MatrixXcd& A) {
  constexpr int most_steps = 60;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  if (!A.allFinite()) return std::nullopt;
  Eigen::MatrixXcd H = A;
  to_hessenberg(H);
  std::vector<Rotation> rotations;
  rotations.reserve(static_cast<std::size_t>(A.rows()));
  int steps = 0;
  for (Index last = H.rows() - 1; last > 0;) {
    Index first = last;
    while (first > 0 && size(H(first, first - 1)) > epsilon * (size(H(first, first)) + size(H(first - 1, first - 1))))
      --first;
    if (first == last) {
      --last;
      steps = 0;
      continue;
    }
    if (++steps > most_steps) return std::nullopt;
    core::check_interrupt();
    // Now and then another shift, out of a circle that Wilkinson's may run in.
    const complex<double> shift = steps % 10 == 0 ? H(last, last) + size(H(last, last - 1)) : wilkinson_shift(H, last);
    qr_step(H, first, last, shift, rotations);
  }
  return Eigen::VectorXcd(H.diagonal());
}

}  // namespace thinwall::linalg
