#include "identification/line_functions.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "core/dense_factorisations.hpp"
#include "core/parallel.hpp"

namespace thinwall::identification {

namespace {

/// Real above imaginary parts of φ + φ̄ and iφ − iφ̄ with φ of a pole and φ̄ of its conjugate.
void put_pair(const Eigen::ArrayXcd& up, const Eigen::ArrayXcd& down, Eigen::Ref<Eigen::MatrixXd> columns) {
  const Eigen::Index lines = up.size();
  const Eigen::ArrayXcd sum = up + down, difference = up - down;
  columns.col(0) << sum.real().matrix(), sum.imag().matrix();
  columns.col(1).head(lines) = -difference.imag().matrix();
  columns.col(1).tail(lines) = difference.real().matrix();
}

/// Sums over some lines, a column an entry: the products of all pairs of functions, then of each function with the
/// values, then of the values with themselves.
Eigen::MatrixXd sums_over(const Eigen::MatrixXd& functions, const WeightedEntries& entries, Eigen::Index first,
                          Eigen::Index count) {
  const Eigen::Index lines = entries.weights.rows(), n = functions.cols(), pairs = n * (n + 1) / 2;
  const auto re = functions.middleRows(first, count), im = functions.middleRows(lines + first, count);
  const auto y_re = entries.values.middleRows(first, count), y_im = entries.values.middleRows(lines + first, count);
  const Eigen::MatrixXd squares = entries.weights.middleRows(first, count).cwiseAbs2();
  Eigen::MatrixXd of_pairs(count, pairs);
  Eigen::Index at = 0;
  for (Eigen::Index j = 0; j < n; ++j) {
    for (Eigen::Index i = 0; i <= j; ++i)
      of_pairs.col(at++) = re.col(i).cwiseProduct(re.col(j)) + im.col(i).cwiseProduct(im.col(j));
  }
  Eigen::MatrixXd sums(pairs + n + 1, squares.cols());
  sums.topRows(pairs).noalias() = of_pairs.transpose() * squares;
  sums.middleRows(pairs, n).noalias() = re.transpose() * squares.cwiseProduct(y_re);
  sums.middleRows(pairs, n).noalias() += im.transpose() * squares.cwiseProduct(y_im);
  sums.bottomRows(1) = squares.cwiseProduct(y_re.cwiseAbs2() + y_im.cwiseAbs2()).colwise().sum();
  return sums;
}

/// The upper half of [F y]ᵀ W² [F y] of each entry. Lines are taken by parts, so that their products stay in the cache,
/// and parts are summed in their order, whatever the threads.
std::vector<Eigen::MatrixXd> products_of(const Eigen::MatrixXd& functions, const WeightedEntries& entries) {
  constexpr Eigen::Index lines_at_once = 256;
  const Eigen::Index lines = entries.weights.rows(), n = functions.cols();
  std::vector<Eigen::MatrixXd> parts(static_cast<std::size_t>((lines + lines_at_once - 1) / lines_at_once));
  core::parallel_for(parts.size(), [&](std::size_t part) {
    const Eigen::Index first = static_cast<Eigen::Index>(part) * lines_at_once;
    parts[part] = sums_over(functions, entries, first, std::min(lines_at_once, lines - first));
  });
  for (std::size_t part = 1; part < parts.size(); ++part) parts[0] += parts[part];
  std::vector<Eigen::MatrixXd> products(static_cast<std::size_t>(entries.weights.cols()));
  for (std::size_t e = 0; e < products.size(); ++e) {
    const auto sums = parts[0].col(static_cast<Eigen::Index>(e));
    products[e].setZero(n + 1, n + 1);
    Eigen::Index at = 0;
    for (Eigen::Index j = 0; j < n; ++j) {
      products[e].col(j).head(j + 1) = sums.segment(at, j + 1);
      at += j + 1;
    }
    products[e].col(n) = sums.tail(n + 1);
  }
  return products;
}

/// The upper triangle whose square is a matrix, of which the upper half is given; none where it is not positive.
std::optional<Eigen::MatrixXd> factor_of(const Eigen::MatrixXd& products) {
  const Eigen::VectorXd length = products.diagonal().cwiseSqrt().cwiseMax(1e-300);
  const Eigen::MatrixXd cosines =
      (length.cwiseInverse().asDiagonal() * products * length.cwiseInverse().asDiagonal()).transpose();
  const Eigen::LLT<Eigen::MatrixXd> factor(cosines);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return Eigen::MatrixXd(factor.matrixU()) * length.asDiagonal();
}

/// The triangle of an entry by reflections.
Eigen::MatrixXd reflected(const Eigen::MatrixXd& functions, const WeightedEntries& entries, Eigen::Index entry) {
  const Eigen::Index n = functions.cols() + 1;
  const Eigen::VectorXd weight = entries.weights.col(entry).replicate(2, 1);
  Eigen::MatrixXd weighted(functions.rows(), n);
  weighted.leftCols(n - 1) = functions.array().colwise() * weight.array();
  weighted.col(n - 1) = entries.values.col(entry).cwiseProduct(weight);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(weighted);
  const Eigen::Index rows = std::min(n, weighted.rows());  // fewer where the lines are few
  Eigen::MatrixXd triangle = Eigen::MatrixXd::Zero(n, n);
  triangle.topRows(rows) = qr.matrixQR().topRows(rows).triangularView<Eigen::Upper>();
  return triangle;
}

}  // namespace

Eigen::MatrixXd line_functions(const Eigen::VectorXcd& s, const Eigen::VectorXcd& poles, const ResidualTerms& terms) {
  const Eigen::Index lines = s.size(), n = terms.highest_power + 1 + (terms.inertia ? 1 : 0);
  Eigen::MatrixXd functions(2 * lines, 4 * poles.size() + n);
  for (Eigen::Index r = 0; r < poles.size(); ++r) {
    const Eigen::ArrayXcd up = (s.array() - poles(r)).inverse(), down = (s.array() - std::conj(poles(r))).inverse();
    put_pair(up, down, functions.middleCols(4 * r, 2));
    put_pair(up.square(), down.square(), functions.middleCols(4 * r + 2, 2));
  }
  auto put = [&, k = 4 * poles.size()](const Eigen::ArrayXcd& values) mutable {
    functions.col(k++) << values.real().matrix(), values.imag().matrix();
  };
  if (terms.inertia) put((s / std::abs(s(0))).array().square().inverse());
  const Eigen::VectorXcd scaled = s / std::abs(s(lines - 1));
  for (int power = 0; power <= terms.highest_power; ++power) put(scaled.array().pow(power));
  return functions;
}

std::vector<Eigen::MatrixXd> compressed(const Eigen::MatrixXd& functions, const WeightedEntries& entries,
                                        Digits digits) {
  std::vector<Eigen::MatrixXd> triangles(static_cast<std::size_t>(entries.values.cols()));
  const std::vector<Eigen::MatrixXd> products =
      digits == Digits::half ? products_of(functions, entries) : std::vector<Eigen::MatrixXd>();
  core::parallel_for(triangles.size(), [&](std::size_t e) {
    std::optional<Eigen::MatrixXd> factor;
    if (digits == Digits::half) factor = factor_of(products[e]);
    triangles[e] = factor ? *factor : reflected(functions, entries, static_cast<Eigen::Index>(e));
  });
  return triangles;
}

}  // namespace thinwall::identification
