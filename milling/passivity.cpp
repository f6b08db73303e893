#include "milling/passivity.hpp"

#include <algorithm>
#include <cmath>

namespace thinwall::milling {

std::optional<GivesEnergy> energy_given(const SampledReceptance& r) {
  constexpr double phase = 0.1;
  constexpr double quiet = 0.01;
  std::optional<GivesEnergy> worst;
  double most = 0.0;
  for (int direction = 0; direction < 3; ++direction) {
    const auto at = [&](std::size_t line) { return r.H[line](direction, direction); };
    double largest = 0.0;
    for (std::size_t line = 0; line < r.H.size(); ++line) largest = std::max(largest, std::abs(at(line)));
    int in_a_row = 0;
    double highest = 0.0;  // of the run
    std::size_t where = 0;
    for (std::size_t line = 0; line < r.H.size(); ++line) {
      const std::complex<double> H = at(line);
      if (H.imag() <= phase * std::abs(H) || std::abs(H) < quiet * largest) {
        in_a_row = 0;
        highest = 0.0;
        continue;
      }
      if (H.imag() > highest) where = line;
      highest = std::max(highest, H.imag());
      if (++in_a_row < 3 || highest <= most) continue;
      most = highest;
      worst = {direction, r.frequency_hz(static_cast<Eigen::Index>(where)), highest / std::abs(at(where))};
    }
  }
  return worst;
}

}  // namespace thinwall::milling
