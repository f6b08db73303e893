#include "milling/process.hpp"

#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::milling {

std::vector<std::string> validate(const MillingProcess& process) {
  std::vector<std::string> all = validate(process.cutter);
  for (const auto& part : {validate(process.coefficients), validate(process.engagement), validate(process.frame)}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

void require_valid(const std::vector<std::string>& violations) {
  if (violations.empty()) return;
  std::string line = violations.front();
  for (std::size_t i = 1; i < violations.size(); ++i) line += "; " + violations[i];
  throw core::InputError(line);
}

double tooth_period_s(const Cutter& cutter, double spindle_speed_rpm) {
  if (!(spindle_speed_rpm > 0.0) || !std::isfinite(spindle_speed_rpm)) {
    std::ostringstream text;
    text << "spindle speed " << spindle_speed_rpm << " rpm, must be positive; correct the speed range";
    throw core::InputError(text.str());
  }
  return 60.0 / (cutter.teeth * spindle_speed_rpm);
}

}  // namespace thinwall::milling
