#pragma once
// All contacts of a coupling as one list of joined directions with their matrices; rotations are scaled by a length.

#include <Eigen/Core>
#include <vector>

#include "coupling/contact.hpp"

namespace thinwall::coupling {

/// The length L (m/rad) by which rotations are multiplied before they are compared with translations: a rotation then
/// counts as the displacement at that distance. 0.1 m is about the size of a tool or of what a robot holds. Results do
/// not depend on it unless a regularisation drops something.
constexpr double default_length = 0.1;

/// One row of the opening Bᵀx: `scale` times the motion of point a along (about) `direction` less that of point b.
struct JoinedDirection {
  std::string point_a;
  std::string point_b;
  Eigen::Vector3d direction;
  dynamics::DofKind kind;
  double scale;  ///< 1, or L for a rotation
  bool rigid;
};

/// The joints between all components. With Λ = diag(scale) all openings are in m and all joint forces in N, and Z(ω) =
/// K + iD + iωC is Λ⁻¹ Z Λ⁻¹ of the contacts. Rows and columns of rigid directions are zero.
struct Joints {
  std::vector<JoinedDirection> directions;
  Eigen::MatrixXd K, C, D;

  /// The directions of one contact; Z has no entries between two contacts.
  struct Block {
    Eigen::Index first, size;
    bool diagonal;
  };
  std::vector<Block> blocks;

  /// Number of joined directions.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(directions.size()); }
};

/// The joints of all contacts, directions in the contacts' order. Throws InputError as require_valid() does, or unless
/// length > 0.
[[nodiscard]] Joints joints(const std::vector<Contact>& contacts, double length);

/// Adds Z⁻¹(ω) to W (zero for a rigid direction) and |Z⁻¹| to `magnitude`; both are m × m over the directions, m/N. ω
/// in rad/s.
void add_compliance(const Joints& joints, double omega, Eigen::MatrixXcd& W, Eigen::MatrixXd& magnitude);

/// Throws InputError, with the numbers of both components, if two components have a point (or mode) of the same name:
/// contacts know points by name only.
void require_different_points(const std::vector<const dynamics::DofTable*>& components);

/// The index of the component that has `point`. Throws InputError, with the nearest name, if none has it.
[[nodiscard]] std::size_t component_of(const std::vector<const dynamics::DofTable*>& components,
                                       const std::string& point);

}  // namespace thinwall::coupling
