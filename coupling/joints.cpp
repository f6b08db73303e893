#include "coupling/joints.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::coupling {

namespace {

using Complex = std::complex<double>;

/// Writes the springs' own values, or the contact's matrices, to the contact's block of K, C and D.
void set_block(const Contact& contact, Eigen::Index first, Joints& joints) {
  const auto size = static_cast<Eigen::Index>(contact.springs.size());
  const auto block = [&](Eigen::MatrixXd& matrix) { return matrix.block(first, first, size, size); };
  Eigen::VectorXd inverse(size);
  for (Eigen::Index i = 0; i < size; ++i) {
    inverse(i) = 1.0 / joints.directions[static_cast<std::size_t>(first + i)].scale;
  }
  const auto scaled = [&](const Eigen::MatrixXd& matrix) {
    return Eigen::MatrixXd(inverse.asDiagonal() * matrix * inverse.asDiagonal());
  };
  if (contact.has_matrices()) {
    block(joints.K) = scaled(contact.matrices.K);
    if (contact.matrices.C.size() > 0) block(joints.C) = scaled(contact.matrices.C);
    if (contact.matrices.D.size() > 0) block(joints.D) = scaled(contact.matrices.D);
    return;
  }
  for (Eigen::Index i = 0; i < size; ++i) {
    const ContactSpring& spring = contact.springs[static_cast<std::size_t>(i)];
    if (spring.rigid()) continue;
    const double unit = inverse(i) * inverse(i);
    joints.K(first + i, first + i) = unit * spring.stiffness;
    joints.C(first + i, first + i) = unit * spring.damping;
    joints.D(first + i, first + i) = unit * spring.loss_factor * spring.stiffness;
  }
}

}  // namespace

Joints joints(const std::vector<Contact>& contacts, double length) {
  require_valid(contacts);
  if (!(length > 0.0 && std::isfinite(length))) {
    std::ostringstream text;
    text << "the length that scales rotations is " << length << " m, but it must be positive";
    throw core::InputError(text.str());
  }
  Joints all;
  for (const Contact& contact : contacts) {
    const bool diagonal = !contact.has_matrices();
    all.blocks.push_back({all.size(), static_cast<Eigen::Index>(contact.springs.size()), diagonal});
    for (const ContactSpring& spring : contact.springs) {
      const double scale = spring.kind == dynamics::DofKind::rotation ? length : 1.0;
      all.directions.push_back(
          {contact.point_a, contact.point_b, spring.direction, spring.kind, scale, diagonal && spring.rigid()});
    }
  }
  all.K = all.C = all.D = Eigen::MatrixXd::Zero(all.size(), all.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) set_block(contacts[i], all.blocks[i].first, all);
  return all;
}

void add_compliance(const Joints& joints, double omega, Eigen::MatrixXcd& W, Eigen::MatrixXd& magnitude) {
  for (const Joints::Block& block : joints.blocks) {
    if (block.diagonal) {
      for (Eigen::Index i = block.first; i < block.first + block.size; ++i) {
        if (joints.directions[static_cast<std::size_t>(i)].rigid) continue;
        const Complex compliance = 1.0 / Complex(joints.K(i, i), joints.D(i, i) + omega * joints.C(i, i));
        W(i, i) += compliance;
        magnitude(i, i) += std::abs(compliance);
      }
      continue;
    }
    const auto of = [&](const auto& matrix) { return matrix.block(block.first, block.first, block.size, block.size); };
    using Small = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 6, 6>;  // on the stack
    Small Z = of(joints.K).cast<Complex>();
    Z.imag() = of(joints.D) + omega * of(joints.C);
    const Small compliance = Z.inverse();
    W.block(block.first, block.first, block.size, block.size) += compliance;
    magnitude.block(block.first, block.first, block.size, block.size) += compliance.cwiseAbs();
  }
}

void require_different_points(const std::vector<const dynamics::DofTable*>& components) {
  std::map<std::string, std::size_t> owner;
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (const dynamics::Dof& dof : *components[c]) {
      const auto [known, is_new] = owner.emplace(dof.point, c);
      if (is_new || known->second == c) continue;
      throw core::InputError("components " + std::to_string(known->second + 1) + " and " + std::to_string(c + 1) +
                             " both have a point \"" + dof.point + "\": rename one of them");
    }
  }
}

std::size_t component_of(const std::vector<const dynamics::DofTable*>& components, const std::string& point) {
  std::vector<std::string> names;
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (const dynamics::Dof& dof : *components[c]) {
      if (dof.kind == dynamics::DofKind::modal) continue;
      if (dof.point == point) return c;
      names.push_back(dof.point);
    }
  }
  throw core::InputError("no component has a point \"" + point + "\"" + core::did_you_mean(point, names));
}

}  // namespace thinwall::coupling
