#pragma once
// Frames of beams: tools and holders as stepped cylinders, robot arms link by link.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/beam_element.hpp"
#include "dynamics/spatial_model.hpp"

namespace thinwall::fem {

/// A point of a frame. One with a name has its six DOFs in the model's table; without, it stays inside.
struct BeamNode {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  std::string name{};
  bool clamped = false;
};

/// A straight beam between two nodes, cut into equal elements of length h. A frequency comes out too high, relative, by
/// (βh)⁴/1440 of bending (β⁴ = ω²ρA/EI), and by (ωh/c)²/24 of shear, torsion and stretching, c² = κG/ρ, G/ρ, E/ρ.
struct BeamSegment {
  std::size_t from = 0;
  std::size_t to = 0;
  dynamics::BeamSection section;
  int elements = 4;
  Eigen::Vector3d y = Eigen::Vector3d::Zero();  ///< near the section's y axis; zero: any, of a section that is round
};

/// A rigid body at a node, its centre from the node, in the axes of the world.
struct NodeBody {
  std::size_t node = 0;
  dynamics::RigidBody body;
};

/// Six springs and dampers at `node`, in the axes of the world, to a rigid arm from `other` or, if there is none, to
/// the ground: force (N, N m) and damping (N s/m, N m s/rad) by q_node − X(p_node − p_other) q_other. Symmetric,
/// positive semidefinite.
struct NodeSpring {
  std::size_t node = 0;
  std::optional<std::size_t> other{};
  dynamics::Matrix6 stiffness = dynamics::Matrix6::Zero();
  dynamics::Matrix6 damping = dynamics::Matrix6::Zero();
};

/// Two nodes at one place: `to` moves as `from` but for a turn about `axis` (unit vector, world), which a spring (N
/// m/rad) and a damper (N m s/rad) may hold. Hinges in a row are listed from the fixed end on.
struct Hinge {
  std::size_t from = 0;
  std::size_t to = 0;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  double stiffness = 0.0;
  double damping = 0.0;
};

/// Nodes, what joins them, and what holds them.
struct BeamFrame {
  std::vector<BeamNode> nodes;
  std::vector<BeamSegment> segments;
  std::vector<NodeBody> bodies{};
  std::vector<NodeSpring> springs{};
  std::vector<Hinge> hinges{};
  double loss_factor = 0.0;  ///< η of all stiffness, D = η K
};

/// The frame over its nodes' motions and hinges' angles y, whatever is clamped or hinged eliminated: M, K by
/// dynamics::beam_mass, beam_stiffness, turned into the world's axes, C of the dampers, D = η K, and T with the DOFs x,
/// y, z, rx, ry, rz of each named node. Static under forces on nodes exactly. A frame that nothing holds has its
/// rigid-body motions in K's null space. Throws InputError with every violation at once: no named node, a name twice, a
/// node on which nothing hangs or that does not exist, a segment without length or elements, a section that is not
/// round without its y axis, hinged nodes apart, anything negative or not finite. Cost O(n³), n: size of y.
[[nodiscard]] dynamics::SpatialModel spatial_model(const BeamFrame& frame);

/// One step of a stepped cylinder. Overhang, holder, flange.
struct CylinderStep {
  double length_m = 0.0;
  dynamics::Tube tube;
  int elements = 4;
};

/// A tool or holder that nothing holds: steps in a row from the origin along `axis` (unit vector). names: of the ends
/// of the steps, one more than there are; "" for an end that needs none. Two names at least the ends: {"tip", "",
/// "root"}. Throws InputError as spatial_model(), or for another number of names.
[[nodiscard]] dynamics::SpatialModel tool_beam(const std::vector<CylinderStep>& steps,
                                               const std::vector<std::string>& names, const Eigen::Vector3d& axis,
                                               double loss_factor = 0.0);

}  // namespace thinwall::fem
