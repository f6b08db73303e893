#include "milling/simulation/one_sided_contact.hpp"

#include <cmath>

namespace thinwall::milling {

std::vector<std::string> validate(const OneSidedContact& contact) {
  std::vector<std::string> violations;
  const auto require = [&](bool holds, const std::string& what, double value, const std::string& bound) {
    if (holds && std::isfinite(value)) return;
    violations.push_back("contact that may open: " + what + " of " + std::to_string(value) + ", must be finite and " +
                         bound + "; correct it");
  };
  require(contact.stiffness_n_per_m > 0.0, "a stiffness", contact.stiffness_n_per_m, "above 0 N/m");
  require(contact.damping_n_s_per_m >= 0.0, "a damping", contact.damping_n_s_per_m, "at least 0 N s/m");
  require(contact.preload_n >= 0.0, "a preload", contact.preload_n, "at least 0 N");
  return violations;
}

}  // namespace thinwall::milling
