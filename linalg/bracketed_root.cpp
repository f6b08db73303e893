#include "linalg/bracketed_root.hpp"

#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::linalg {

double bracketed_root(const std::function<double(double)>& f, Bracket bracket, RootTolerance tolerance,
                      const std::string& sought) {
  auto& [a, f_a, b, f_b] = bracket;
  if (f_a == 0.0) return a;
  if (f_b == 0.0) return b;
  int stayed = 0;                  // the end that was kept last: −1 a, 1 b
  double width = std::abs(b - a);  // three values ago
  for (int i = 0; i < 200; ++i) {
    bool bisect = false;
    if (i % 3 == 2) {
      bisect = std::abs(b - a) > 0.5 * width;
      width = (bisect ? 0.5 : 1.0) * std::abs(b - a);
    }
    const double x = bisect ? 0.5 * (a + b) : (f_a * b - f_b * a) / (f_a - f_b);
    const double f_x = f(x);
    if (!std::isfinite(f_x)) break;
    if (std::abs(f_x) <= tolerance.value) return x;
    const bool replaces_b = (f_x > 0.0) == (f_b > 0.0);
    if (replaces_b) {
      if (stayed == -1) f_a *= 0.5;
      b = x;
      f_b = f_x;
      stayed = -1;
    } else {
      if (stayed == 1) f_b *= 0.5;
      a = x;
      f_a = f_x;
      stayed = 1;
    }
    if (std::abs(b - a) <= tolerance.relative * std::abs(x)) return x;
  }
  std::ostringstream text;
  text << sought << " was not found between " << a << " and " << b << ", where the sign of its equation changes";
  throw core::NumericalError(text.str());
}

}  // namespace thinwall::linalg
