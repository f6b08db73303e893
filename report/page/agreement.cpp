#include "report/page/agreement.hpp"

#include <cmath>
#include <complex>

namespace thinwall::report {

std::optional<Agreement> agreement_of(const Eigen::VectorXcd& H, const Eigen::VectorXcd& G) {
  std::complex<double> across = 0.0;
  double measured = 0.0, fitted = 0.0, apart = 0.0;
  for (Eigen::Index i = 0; i < H.size(); ++i) {
    if (std::isnan(G(i).real())) continue;
    across += std::conj(H(i)) * G(i);
    measured += std::norm(H(i));
    fitted += std::norm(G(i));
    apart += std::norm(G(i) - H(i));
  }
  if (!(measured > 0.0) || !(fitted > 0.0)) return std::nullopt;
  return Agreement{std::norm(across) / (measured * fitted), std::sqrt(apart / measured)};
}

}  // namespace thinwall::report
