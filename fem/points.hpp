#pragma once
// Named points of a part as linear functionals of its free DOFs.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fem/model.hpp"
#include "linalg/sparse.hpp"
#include "mesh/selection.hpp"
#include "mesh/solid/locate.hpp"

namespace thinwall::fem {

/// A point of the part: its position, the patch over which its displacement is averaged, and the directions in which
/// its motion is wanted.
struct NamedPoint {
  std::string name;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double patch_radius_m = 0.0;              ///< 0 takes the displacement at the position itself
  std::vector<Eigen::Vector3d> directions;  ///< unit vectors
  std::vector<Eigen::Vector3d> turns{};     ///< unit vectors about which its rotation is wanted
  std::optional<mesh::Region> faces{};      ///< the patch, if it is not the disc about the position
  double off_m = 0.0;                       ///< Disc::off_m of the disc
  std::vector<Eigen::Vector3d> facing{};    ///< Disc::facing of the disc; empty: the directions
};

/// The disc of a point.
[[nodiscard]] mesh::Disc disc_of(const NamedPoint& point);

/// The columns W of a point over the free rows, rows × (directions + turns). The column of a direction n gives wᵀu = n
/// · ∫ u dA / ∫ dA over the patch (or n · u at the position), from the shape functions at the patch's samples; as a
/// load it is a unit force spread evenly over the patch. The column of a turn about n gives wᵀu = n · θ (rad) of the
/// averaging connection about the patch's centre (motion_of_node()); as a load it is a unit moment without net force.
/// The centre is the position unless an edge cuts the patch off. A point load on a solid has no limit under refinement;
/// a load on a patch has. Throws InputError if the point lies off the part or on a support, where nothing moves, or if
/// its patch does not determine a rotation that is wanted (inverse_spread()).
[[nodiscard]] linalg::SparseMatrix point_columns(const Model& model, const NamedPoint& point);

}  // namespace thinwall::fem
