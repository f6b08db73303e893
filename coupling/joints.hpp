#pragma once
// All contacts of a coupling as one list of joined directions and their matrices, rotations scaled to a length.

#include <Eigen/Core>
#include <vector>

#include "coupling/contact.hpp"

namespace thinwall::coupling {

/// The length L that a rotation is multiplied by before it meets a translation (m a radian): what a turn moves at that
/// distance. About the size of a tool or of what a robot holds; results that drop nothing do not depend on it.
constexpr double default_length = 0.1;

/// One row of the opening Bᵀx: `scale` times the motion along (about) `direction` of point a less that of point b.
struct JoinedDirection {
  std::string point_a;
  std::string point_b;
  Eigen::Vector3d direction;
  dynamics::DofKind kind;
  double scale;  ///< 1, or L for a rotation
  bool rigid;
};

/// The joints between all components. With Λ = diag(scale) the openings are in m whatever they were, the joint forces
/// in N, and Z(ω) = K + iD + iωC stands for Λ⁻¹ Z Λ⁻¹ of the contacts. Rows and columns of rigid directions are zero.
struct Joints {
  std::vector<JoinedDirection> directions;
  Eigen::MatrixXd K, C, D;

  /// The directions of one contact: Z has no entries between two of them.
  struct Block {
    Eigen::Index first, size;
    bool diagonal;
  };
  std::vector<Block> blocks;

  /// Number of joined directions.
  [[nodiscard]] Eigen::Index size() const { return static_cast<Eigen::Index>(directions.size()); }
};

/// Lists the directions of all contacts in their order. Throws InputError as require_valid(), or unless length > 0.
[[nodiscard]] Joints joints(const std::vector<Contact>& contacts, double length);

/// W += Z⁻¹(ω), zero for a rigid direction, and magnitude += |Z⁻¹|; both m × m over the directions, m/N. ω in rad/s.
void add_compliance(const Joints& joints, double omega, Eigen::MatrixXcd& W, Eigen::MatrixXd& magnitude);

/// Throws InputError where two of the components bear a point (or a mode) of one name, with both components' numbers:
/// contacts know points by name only.
void require_different_points(const std::vector<const dynamics::DofTable*>& components);

/// Which of the components has `point`; throws InputError, with the nearest name, if none has.
[[nodiscard]] std::size_t component_of(const std::vector<const dynamics::DofTable*>& components,
                                       const std::string& point);

}  // namespace thinwall::coupling
