#pragma once
// Frames of beams: tools and holders as stepped cylinders, robot arms made of links.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/beam_element.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::fem {

/// A node of a frame. A node with a name has its six DOFs in the model's table; one without is internal.
struct BeamNode {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  std::string name{};
  bool clamped = false;
};

/// A straight beam between two nodes, divided into equal elements of length h. Its frequencies are too high by a
/// relative error of (βh)⁴/1440 in bending (β⁴ = ω²ρA/EI), and of (ωh/c)²/24 in shear, torsion and stretching, with c²
/// = κG/ρ, G/ρ, E/ρ.
struct BeamSegment {
  std::size_t from = 0;
  std::size_t to = 0;
  dynamics::BeamSection section;
  int elements = 4;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< direction near the section's y axis; zero if the section is round
};

/// A rigid body at a node; its centre is relative to the node, in the axes of the world.
struct NodeBody {
  std::size_t node = 0;
  dynamics::RigidBody body;
};

/// Six springs and dampers at `node`, in the axes of the world. They connect the node to the end of a rigid arm from
/// the node `other`, or to the ground if there is none: force (N, N m) and damping force (N s/m, N m s/rad) act on
/// q_node − X(p_node − p_other) q_other. Both matrices are symmetric and positive semidefinite.
struct NodeSpring {
  std::size_t node = 0;
  std::optional<std::size_t> other{};
  dynamics::Matrix6 stiffness = dynamics::Matrix6::Zero();
  dynamics::Matrix6 damping = dynamics::Matrix6::Zero();
};

/// A hinge between two nodes at one place: `to` moves as `from` except for a rotation about `axis` (unit vector,
/// world), on which a spring (N m/rad) and a damper (N m s/rad) may act. In a chain, hinges are listed from the fixed
/// end onwards.
struct Hinge {
  std::size_t from = 0;
  std::size_t to = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double stiffness = 0.0;
  double damping = 0.0;
};

/// A frame: nodes, the members that join them, and the springs that hold them.
struct BeamFrame {
  std::vector<BeamNode> nodes;
  std::vector<BeamSegment> segments;
  std::vector<NodeBody> bodies{};
  std::vector<NodeSpring> springs{};
  std::vector<Hinge> hinges{};
  double loss_factor = 0.0;  ///< loss factor η of all stiffness, D = η K
};

/// The spatial model of a frame, over the motions of its nodes and the angles of its hinges, y; clamped and hinged
/// motions are eliminated. M and K are those of dynamics::beam_mass() and beam_stiffness(), turned into the world's
/// axes; C contains the dampers, D = η K, and T the DOFs x, y, z, rx, ry, rz of each named node. The static response to
/// forces on nodes is exact. A frame that nothing holds has its rigid-body motions in the null space of K. Throws
/// InputError that lists every violation: no named node, a name given twice, a node without mass or that does not
/// exist, a segment without length or elements, a section that is not round without its y axis, hinged nodes at
/// different places, anything negative or not finite. Cost O(n³), n the size of y.
[[nodiscard]] dynamics::SpatialModel spatial_model(const BeamFrame& frame);

/// One step of a stepped cylinder, such as the overhang of a tool, its holder or its flange.
struct CylinderStep {
  double length_m = 0.0;
  dynamics::Tube tube;
  int elements = 4;
};

/// The spatial model of a free tool or holder: steps in a row from the origin along `axis` (unit vector). names: the
/// names of the ends of the steps, one more than there are steps, "" for an end that needs none, such as {"tip", "",
/// "root"}. Throws InputError as spatial_model() does, or for another number of names.
[[nodiscard]] dynamics::SpatialModel tool_beam(const std::vector<CylinderStep>& steps,
                                               const std::vector<std::string>& names, const Eigen::Vector3d& axis,
                                               double loss_factor = 0.0);

}  // namespace thinwall::fem
