#pragma once
// Named points of a part as weights over its free DOFs.

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fem/model.hpp"
#include "linalg/sparse.hpp"
#include "mesh/selection.hpp"

namespace thinwall::fem {

/// A point of the part: where it is, over what patch its displacement is averaged, in which directions it is wanted.
struct NamedPoint {
  std::string name;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double patch_radius_m = 0.0;              ///< 0: the displacement at the position itself
  std::vector<Eigen::Vector3d> directions;  ///< unit vectors
  std::vector<Eigen::Vector3d> turns{};     ///< unit vectors about which its rotation is wanted
  std::optional<mesh::Region> faces{};      ///< the patch, in place of the disc about the position
  double off_m = 0.0;                       ///< of the disc
};

/// Column for each direction: w with wᵀu = n · ∫ u dA / ∫ dA over the patch (or n · u at the position), from the shape
/// functions at the patch's samples; the same column is the load of a unit force spread evenly over the patch. Then a
/// column for each turn: wᵀu = n · θ of the averaging connection about the patch's centre (motion_of_node()), in rad;
/// as a load a unit moment without net force. The centre is the position but for a patch that an edge cuts off. Shape
/// rows × (directions + turns). A point load on a solid has no limit under refinement; a patch has. Throws InputError
/// if the point lies off the part, or where nothing can move (on a support), or if its patch does not see a turn
/// (inverse_spread()).
[[nodiscard]] linalg::SparseMatrix point_columns(const Model& model, const NamedPoint& point);

}  // namespace thinwall::fem
