#include "identification/measured_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/error.hpp"

namespace thinwall::identification {

namespace {

/// Four neighbours of a line, and the weights by which the cubic through them predicts it.
struct LinesBeside {
  std::array<Eigen::Index, 4> line{};
  std::array<double, 4> weight{};

  [[nodiscard]] double spread() const {
    double sum = 1.0;
    for (const double w : weight) sum += w * w;
    return sum;
  }
};

LinesBeside lines_beside(const Eigen::VectorXd& hz, Eigen::Index k) {
  const Eigen::Index first = std::clamp<Eigen::Index>(k - 2, 0, hz.size() - 5);
  LinesBeside found;
  for (Eigen::Index i = first, n = 0; i < first + 5; ++i) {
    if (i != k) found.line.at(static_cast<std::size_t>(n++)) = i;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    double weight = 1.0;
    for (std::size_t j = 0; j < 4; ++j) {
      if (j != i) weight *= (hz(k) - hz(found.line.at(j))) / (hz(found.line.at(i)) - hz(found.line.at(j)));
    }
    found.weight.at(i) = weight;
  }
  return found;
}

/// Squares of δ over √(1 + Σ w²) of each line, responses × references.
std::vector<Eigen::MatrixXd> squares_off_neighbours(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H) {
  std::vector<Eigen::MatrixXd> squares;
  squares.reserve(H.size());
  for (Eigen::Index k = 0; k < hz.size(); ++k) {
    const LinesBeside beside = lines_beside(hz, k);
    Eigen::MatrixXcd off = H[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < 4; ++i) off -= beside.weight.at(i) * H[static_cast<std::size_t>(beside.line.at(i))];
    squares.emplace_back(off.cwiseAbs2() / beside.spread());
  }
  return squares;
}

double middle_of(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Medians over 41 lines, fewer at most where there are fewer.
Eigen::ArrayXd medians(const Eigen::ArrayXd& values) {
  constexpr Eigen::Index around = 20;
  const Eigen::Index lines = values.size(), width = std::min(lines, 2 * around + 1);
  Eigen::ArrayXd result(lines);
  std::vector<double> window;
  for (Eigen::Index k = 0; k < lines; ++k) {
    const auto first = values.begin() + std::clamp<Eigen::Index>(k - around, 0, lines - width);
    window.assign(first, first + width);
    result(k) = middle_of(window);
  }
  return result;
}

/// The variance of an entry from its δ² and the squares of its size: of three laws the likeliest.
Eigen::ArrayXd likeliest_variance(const Eigen::ArrayXd& squares, const Eigen::ArrayXd& square_size,
                                  double least_share) {
  const Eigen::ArrayXd size = square_size.max(1e-300);
  Eigen::ArrayXd best;
  double least = std::numeric_limits<double>::infinity();
  for (const double power : {0.0, 0.5, 1.0}) {
    const Eigen::ArrayXd law = size.pow(power);
    const Eigen::ArrayXd variance =
        (law * medians(squares / law) / std::numbers::ln2).max(least_share * least_share * size);
    const double deviance = (variance.log() + squares / variance).sum();
    if (best.size() > 0 && !(deviance < least)) continue;
    least = deviance;
    best = variance;
  }
  return best;
}

}  // namespace

void require_usable(const MeasuredLines& measured) {
  const auto lines = static_cast<std::size_t>(measured.lines());
  if (lines < 2 || measured.H.size() != lines || measured.variance.size() != lines) {
    throw core::InputError("identification: " + std::to_string(lines) + " lines, " + std::to_string(measured.H.size()) +
                           " matrices and " + std::to_string(measured.variance.size()) +
                           " variances, must be as many and at least two");
  }
  for (std::size_t i = 0; i < lines; ++i) {
    const auto line = static_cast<Eigen::Index>(i);
    const bool ascends = measured.hz(line) > (i == 0 ? 0.0 : measured.hz(line - 1));
    if (!ascends || !std::isfinite(measured.hz(line)))
      throw core::InputError("identification: line " + std::to_string(i + 1) + " at " +
                             std::to_string(measured.hz(line)) +
                             " Hz, must be above 0 and the one before it; sort them");
    const Eigen::MatrixXcd& H = measured.H[i];
    const Eigen::MatrixXd& variance = measured.variance[i];
    if (H.size() == 0 || H.rows() != measured.responses() || H.cols() != measured.references() ||
        variance.rows() != H.rows() || variance.cols() != H.cols())
      throw core::InputError("identification: the matrices of line " + std::to_string(i + 1) +
                             " are not of the shape of the first; give all entries");
    if (!H.allFinite() || !variance.allFinite() || !(variance.minCoeff() > 0.0))
      throw core::InputError("identification: line " + std::to_string(i + 1) +
                             " holds a number that is not finite, or a variance that is not positive; leave it out");
  }
}

Eigen::ArrayXXd spread_over(const OfEntries& figures, Eigen::Index responses, Eigen::Index references,
                            const char* what) {
  if (figures.size() == 1) return Eigen::ArrayXXd::Constant(responses, references, figures(0));
  if (figures.rows() == responses && figures.cols() == references) return figures.array();
  throw core::InputError(std::string(what) + " of " + std::to_string(figures.rows()) + " x " +
                         std::to_string(figures.cols()) + " entries for " + std::to_string(responses) + " x " +
                         std::to_string(references) + " receptances; give one for all, or one each");
}

std::vector<Eigen::MatrixXd> variance_of(const std::vector<Eigen::MatrixXcd>& H,
                                         const std::vector<Eigen::MatrixXd>& coherence, const OfEntries& averages) {
  constexpr double least = 1e-6, most = 1.0 - 1e-12;
  if (H.size() != coherence.size())
    throw core::InputError("coherence: " + std::to_string(coherence.size()) + " lines for " + std::to_string(H.size()) +
                           ", must be as many");
  std::vector<Eigen::MatrixXd> variance;
  for (std::size_t i = 0; i < H.size(); ++i) {
    if (H[i].rows() != coherence[i].rows() || H[i].cols() != coherence[i].cols())
      throw core::InputError("coherence: line " + std::to_string(i + 1) + " is of another shape than its receptances");
    const Eigen::ArrayXXd n = spread_over(averages, H[i].rows(), H[i].cols(), "averages");
    if (!(n.minCoeff() >= 1.0))
      throw core::InputError("coherence: " + std::to_string(n.minCoeff()) + " averages, must be at least one");
    const Eigen::ArrayXXd g = coherence[i].array().max(least).min(most);
    variance.emplace_back((1.0 - g) / (g * n) * H[i].array().abs2());
  }
  return variance;
}

std::vector<Eigen::MatrixXd> variance_from_scatter(const Eigen::VectorXd& hz, const std::vector<Eigen::MatrixXcd>& H,
                                                   const std::vector<Eigen::MatrixXcd>& sizes, double least_share) {
  constexpr std::size_t fewest = 6;
  const auto lines = static_cast<std::size_t>(hz.size());
  if (lines < fewest || H.size() != lines || sizes.size() != lines)
    throw core::InputError("identification: scatter of " + std::to_string(lines) + " lines, must be at least 6");
  const std::vector<Eigen::MatrixXd> squares = squares_off_neighbours(hz, H);
  std::vector<Eigen::MatrixXd> variance(lines, Eigen::MatrixXd(H[0].rows(), H[0].cols()));
  for (Eigen::Index e = 0; e < H[0].size(); ++e) {
    Eigen::ArrayXd of_entry(hz.size()), square_size(hz.size());
    for (std::size_t k = 0; k < lines; ++k) {
      of_entry(static_cast<Eigen::Index>(k)) = squares[k](e);
      square_size(static_cast<Eigen::Index>(k)) = std::norm(sizes[k](e));
    }
    const Eigen::ArrayXd likeliest = likeliest_variance(of_entry, square_size, least_share);
    for (std::size_t k = 0; k < lines; ++k) variance[k](e) = likeliest(static_cast<Eigen::Index>(k));
  }
  return variance;
}

}  // namespace thinwall::identification
