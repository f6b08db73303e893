#include "identification/measured_lines.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"

namespace thinwall::identification {

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

std::vector<Eigen::MatrixXd> variance_of(const std::vector<Eigen::MatrixXcd>& H,
                                         const std::vector<Eigen::MatrixXd>& coherence, int averages) {
  constexpr double least = 1e-6, most = 1.0 - 1e-12;
  if (averages < 1 || H.size() != coherence.size())
    throw core::InputError("coherence: " + std::to_string(averages) + " averages over " +
                           std::to_string(coherence.size()) + " lines for " + std::to_string(H.size()) +
                           ", must be at least one, and as many lines");
  std::vector<Eigen::MatrixXd> variance;
  for (std::size_t i = 0; i < H.size(); ++i) {
    if (H[i].rows() != coherence[i].rows() || H[i].cols() != coherence[i].cols())
      throw core::InputError("coherence: line " + std::to_string(i + 1) + " is of another shape than its receptances");
    const Eigen::ArrayXXd g = coherence[i].array().max(least).min(most);
    variance.push_back((1.0 - g) / (g * averages) * H[i].array().abs2());
  }
  return variance;
}

}  // namespace thinwall::identification
