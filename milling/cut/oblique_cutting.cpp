#include "milling/cut/oblique_cutting.hpp"

#include <cmath>
#include <numbers>
#include <sstream>

#include "milling/cut/process.hpp"

namespace thinwall::milling {

namespace {

using std::numbers::pi;

}  // namespace

CuttingCoefficients oblique_coefficients(const OrthogonalCutting& data, double oblique_rad) {
  std::vector<std::string> violations = validate(data);
  if (!(std::abs(oblique_rad) <= 80.0 * pi / 180.0)) {
    std::ostringstream text;
    text << "oblique cutting: oblique angle " << oblique_rad << " rad, must be within 80°; give the helix angle";
    violations.push_back(text.str());
  }
  require_valid(violations);
  const double flow = oblique_rad;
  const double friction = std::atan(std::tan(data.friction_angle_rad) * std::cos(flow));
  const double along = friction - data.rake_rad;
  const double across = std::tan(flow) * std::sin(friction);
  const double c = std::hypot(std::cos(data.shear_angle_rad + along), across);
  const double unit = data.shear_stress_pa / (std::sin(data.shear_angle_rad) * c);
  const double slant = std::tan(oblique_rad);
  return {unit * (std::cos(along) + slant * across),
          unit * std::sin(along) / std::cos(oblique_rad),
          -unit * (std::cos(along) * slant - across),
          data.K_te,
          data.K_re,
          0.0};
}

std::vector<std::string> validate(const OrthogonalCutting& data) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const char* what, double value, const char* bound) {
    if (holds) return;
    std::ostringstream text;
    text << "orthogonal cutting: " << what << " " << value << ", must be " << bound;
    violations.push_back(text.str());
  };
  require(data.shear_stress_pa > 0.0 && std::isfinite(data.shear_stress_pa), "shear stress in Pa", data.shear_stress_pa,
          "positive; titanium alloys have some 600 MPa");
  require(data.shear_angle_rad > 0.0 && data.shear_angle_rad < 0.5 * pi, "shear angle in rad", data.shear_angle_rad,
          "above 0 and below 90°; 20 to 40° is usual");
  require(data.friction_angle_rad >= 0.0 && data.friction_angle_rad < 0.5 * pi, "friction angle in rad",
          data.friction_angle_rad, "at least 0 and below 90°; 20 to 40° is usual");
  require(std::abs(data.rake_rad) < 0.5 * pi, "rake angle in rad", data.rake_rad, "within 90°; 0 to 15° is usual");
  require(std::isfinite(data.K_te) && std::isfinite(data.K_re), "edge coefficient in N/m", data.K_te + data.K_re,
          "a number; leave it out for none");
  if (!violations.empty()) return violations;
  const double sum = data.shear_angle_rad + data.friction_angle_rad - data.rake_rad;
  require(std::abs(sum) < 0.5 * pi, "shear angle + friction angle − rake in rad", sum,
          "within 90°, or no force shears the chip; give a smaller shear angle");
  return violations;
}

double merchant_shear_angle(double friction_angle_rad, double rake_rad) {
  return 0.25 * pi - 0.5 * (friction_angle_rad - rake_rad);
}

}  // namespace thinwall::milling
