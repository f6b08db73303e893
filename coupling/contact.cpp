#include "coupling/contact.hpp"

#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::coupling {

void require_valid(const std::vector<Contact>& contacts) {
  std::ostringstream faults;
  const auto fault = [&](const Contact& contact, const std::string& what, double value, const std::string& bound) {
    faults << (faults.tellp() > 0 ? "; " : "") << "contact " << contact.part_point << "-" << contact.robot_point << ": "
           << what << " is " << value << ", but " << bound;
  };
  if (contacts.empty()) faults << "a coupling without a contact: give at least one";
  for (const Contact& contact : contacts) {
    if (contact.springs.empty()) fault(contact, "the number of directions", 0, "at least one must be joined");
    for (const ContactSpring& spring : contact.springs) {
      const double length = spring.direction.norm();
      if (!(std::abs(length - 1.0) <= 1e-9)) fault(contact, "the direction's length", length, "it must be 1");
      if (!(spring.stiffness > 0.0)) {
        fault(contact, "the stiffness (N/m)", spring.stiffness, "it must be positive; leave a free direction out");
      }
      if (!(spring.damping >= 0.0 && std::isfinite(spring.damping))) {
        fault(contact, "the damping (N s/m)", spring.damping, "it must not be negative");
      }
      if (!(spring.loss_factor >= 0.0 && std::isfinite(spring.loss_factor))) {
        fault(contact, "the loss factor", spring.loss_factor, "it must not be negative");
      }
    }
  }
  if (faults.tellp() > 0) throw core::InputError(faults.str());
}

}  // namespace thinwall::coupling
