#include "milling/cut/process.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

#include "core/error.hpp"
#include "milling/cut/chip_load.hpp"

namespace thinwall::milling {

namespace {

bool same_coefficients(const CuttingCoefficients& a, const CuttingCoefficients& b) {
  return a.K_t == b.K_t && a.K_r == b.K_r && a.K_a == b.K_a && a.K_te == b.K_te && a.K_re == b.K_re && a.K_ae == b.K_ae;
}

std::vector<std::string> coefficient_violations(const MillingProcess& process) {
  const auto& own = process.tooth_coefficients;
  if (own.empty()) return validate(process.coefficients);
  if (own.size() != static_cast<std::size_t>(std::max(0, process.cutter.teeth))) {
    return {"cutting coefficients: " + std::to_string(own.size()) + " sets for " +
            std::to_string(process.cutter.teeth) + " teeth, must be one a tooth; give as many, or none"};
  }
  for (const CuttingCoefficients& k : own) {
    auto violations = validate(k);
    if (!violations.empty()) return violations;
  }
  return {};
}

}  // namespace

std::vector<Engagement> arcs(const MillingProcess& process) {
  std::vector<Engagement> all{process.engagement};
  all.insert(all.end(), process.further_engagements.begin(), process.further_engagements.end());
  return all;
}

const CuttingCoefficients& coefficients(const MillingProcess& process, int tooth) {
  return process.tooth_coefficients.empty() ? process.coefficients
                                            : process.tooth_coefficients[static_cast<std::size_t>(tooth)];
}

bool equal_teeth(const MillingProcess& process) {
  const auto& own = process.tooth_coefficients;
  const auto differ = [](const CuttingCoefficients& a, const CuttingCoefficients& b) {
    return !same_coefficients(a, b);
  };
  return process.cutter.equal_teeth() && std::adjacent_find(own.begin(), own.end(), differ) == own.end();
}

bool equal_surfaces(const MillingProcess& process) {
  const std::vector<double>& runout = process.cutter.runout_m;
  return equal_teeth(process) &&
         std::adjacent_find(runout.begin(), runout.end(), std::not_equal_to<>{}) == runout.end();
}

bool elementary(const MillingProcess& process) {
  const Cutter& cutter = process.cutter;
  return equal_teeth(process) && process.tooth_coefficients.empty() && !cutter.depends_on_depth() &&
         cutter.envelope.taper_rad == 0.0 && process.further_engagements.empty() && process.damping.C == 0.0;
}

void set_force_law(MillingProcess& process, const ForceLaw& law, double feed_per_tooth_m) {
  require_valid(validate(law));
  const Cutter& cutter = process.cutter;
  process.tooth_coefficients.clear();
  if (!std::holds_alternative<CuttingCoefficients>(law) && !cutter.envelope.straight()) {
    throw core::InputError(
        "cutting force: only the linear law serves a cutter with a corner radius or a tip angle, whose chip thins "
        "towards the tip; give coefficients for its mean chip");
  }
  const double thinning = std::cos(cutter.envelope.taper_rad);  // sin κ
  for (const ChipLoad& load : chip_loads(cutter, arcs(process), feed_per_tooth_m)) {
    if (load.mean_thickness_m == 0.0) {
      throw core::InputError("cutting force: tooth " + std::to_string(process.tooth_coefficients.size() + 1) +
                             " never cuts at this runout and feed, every tooth must; raise the feed, or leave the "
                             "tooth out and give the pitches of the others");
    }
    process.tooth_coefficients.push_back(linearised(law, thinning * load.mean_thickness_m));
  }
  process.coefficients = process.tooth_coefficients.front();
  if (equal_teeth(process)) process.tooth_coefficients.clear();
}

std::vector<std::string> validate(const MillingProcess& process) {
  std::vector<std::string> all = validate(process.cutter);
  for (const auto& part : {coefficient_violations(process), validate(arcs(process)), validate(process.frame),
                           validate(process.damping, process.cutter)}) {
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
