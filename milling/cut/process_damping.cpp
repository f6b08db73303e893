#include "milling/cut/process_damping.hpp"

#include <cmath>
#include <sstream>

namespace thinwall::milling {

CuttingCoefficients per_slope(const ProcessDamping& damping, const Cutter& cutter) {
  const double radial = 2.0 * damping.C / cutter.diameter_m;
  return {damping.friction * radial, radial, 0.0, 0.0, 0.0, 0.0};
}

std::vector<std::string> validate(const ProcessDamping& damping, const Cutter& cutter) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const char* what, double value, const char* bound) {
    if (holds) return;
    std::ostringstream text;
    text << "process damping: " << what << " " << value << ", must be " << bound;
    violations.push_back(text.str());
  };
  require(damping.C >= 0.0 && std::isfinite(damping.C), "coefficient in N/m", damping.C,
          "0 or more; leave it out for none");
  require(damping.friction >= 0.0 && std::isfinite(damping.friction), "friction", damping.friction,
          "0 or more; 0.3 is usual");
  const Envelope& e = cutter.envelope;
  require(damping.C == 0.0 || (e.straight() && e.taper_rad == 0.0), "coefficient in N/m", damping.C,
          "0 unless the cutter is a cylinder; leave it out");
  return violations;
}

}  // namespace thinwall::milling
