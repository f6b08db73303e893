#include "coupling/contact.hpp"

#include <cmath>
#include <sstream>

#include "core/dense_eigenvalues.hpp"
#include "core/error.hpp"

namespace thinwall::coupling {

namespace {

/// The list of faults of contacts, each with the names of its points, raised as one error.
class Faults {
 public:
  template <typename Value>
  void add(const Contact& contact, const std::string& what, const Value& value, const std::string& bound) {
    begin() << "contact " << contact.point_a << "-" << contact.point_b << ": " << what << " is " << value << ", but "
            << bound;
  }
  std::ostream& begin() { return text_ << (text_.tellp() > 0 ? "; " : ""); }
  void throw_if_any() const {
    if (const std::string all = text_.str(); !all.empty()) throw core::InputError(all);
  }

 private:
  std::ostringstream text_;
};

void check(const Contact& contact, const ContactSpring& spring, Faults& faults) {
  const bool turns = spring.kind == dynamics::DofKind::rotation;
  const double length = spring.direction.norm();
  if (!(std::abs(length - 1.0) <= 1e-9)) faults.add(contact, "the direction's length", length, "it must be 1");
  if (spring.kind == dynamics::DofKind::modal) {
    faults.add(contact, "the kind of a direction", "modal", "points are joined along translations and rotations only");
  }
  if (!(spring.stiffness > 0.0)) {
    faults.add(contact, turns ? "the stiffness (N m/rad)" : "the stiffness (N/m)", spring.stiffness,
               "it must be positive; leave a free direction out");
  }
  if (!(spring.damping >= 0.0 && std::isfinite(spring.damping))) {
    faults.add(contact, turns ? "the damping (N m s/rad)" : "the damping (N s/m)", spring.damping,
               "it must not be negative");
  }
  if (!(spring.loss_factor >= 0.0 && std::isfinite(spring.loss_factor))) {
    faults.add(contact, "the loss factor", spring.loss_factor, "it must not be negative");
  }
  if (contact.has_matrices() && !(spring.rigid() && spring.damping == 0.0 && spring.loss_factor == 0.0)) {
    faults.add(contact, "a spring's own stiffness, damping or loss", "given beside matrices",
               "they stand for the springs' values: give one or the other");
  }
}

/// The smallest eigenvalue of a symmetric matrix scaled to a unit diagonal, so that it does not depend on the units of
/// the rows.
double smallest_eigenvalue(const Eigen::MatrixXd& matrix) {
  Eigen::VectorXd scale = matrix.diagonal().cwiseAbs();
  for (double& size : scale) size = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
  const Eigen::MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

void check(const Contact& contact, const Eigen::MatrixXd& matrix, const std::string& letter, Faults& faults) {
  const auto size = static_cast<Eigen::Index>(contact.springs.size());
  if (matrix.rows() != size || matrix.cols() != size) {
    faults.add(contact, "the number of rows of " + letter, matrix.rows(),
               "it must be square over the " + std::to_string(size) + " directions");
    return;
  }
  if (!matrix.allFinite()) {
    faults.add(contact, "a value of " + letter, "not finite", "a rigid direction has no place in a matrix");
    return;
  }
  const Eigen::VectorXd root = matrix.diagonal().cwiseAbs().cwiseSqrt();
  if (((matrix - matrix.transpose()).cwiseAbs().array() > 1e-10 * (root * root.transpose()).array()).any()) {
    faults.add(contact, letter, "not symmetric", "a joint's matrices must be (relative bound 1e-10)");
    return;
  }
  const double smallest = smallest_eigenvalue(matrix);
  if (letter == "K" && !(smallest > 1e-14)) {
    faults.add(contact, "the smallest eigenvalue of K, scaled to a unit diagonal,", smallest,
               "it must be positive (bound 1e-14); leave a free direction out");
  }
  if (letter != "K" && !(smallest >= -1e-12)) {
    faults.add(contact, "the smallest eigenvalue of " + letter + ", scaled to a unit diagonal,", smallest,
               "it must not be negative");
  }
}

}  // namespace

void require_valid(const std::vector<Contact>& contacts) {
  Faults faults;
  if (contacts.empty()) faults.begin() << "a coupling without a contact: give at least one";
  for (const Contact& contact : contacts) {
    if (contact.point_a == contact.point_b) {
      faults.add(contact, "the second point", "the first", "a contact joins two points");
    }
    if (contact.springs.empty()) faults.add(contact, "the number of directions", 0, "at least one must be joined");
    for (const ContactSpring& spring : contact.springs) check(contact, spring, faults);
    if (!contact.has_matrices() && contact.matrices.C.size() + contact.matrices.D.size() > 0) {
      faults.add(contact, "the joint's K", "missing", "C and D were given as matrices");
    }
    if (!contact.has_matrices()) continue;
    if (contact.springs.size() > 6) {
      faults.add(contact, "the number of directions", contact.springs.size(),
                 "matrices join two points in six at most");
    }
    check(contact, contact.matrices.K, "K", faults);
    if (contact.matrices.C.size() > 0) check(contact, contact.matrices.C, "C", faults);
    if (contact.matrices.D.size() > 0) check(contact, contact.matrices.D, "D", faults);
  }
  faults.throw_if_any();
}

}  // namespace thinwall::coupling
