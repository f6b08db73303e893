#pragma once
// A space in which every wanted edge of a surface mesh has length one.

#include <Eigen/Geometry>
#include <vector>

#include "mesh/polyline.hpp"
#include "mesh/selection.hpp"
#include "mesh/surface/surface_features.hpp"
#include "mesh/surface/triangle_tree.hpp"

namespace thinwall::mesh {

/// Wanted edges of a surface mesh. Away from features an edge is `size_m` long. Across the first `layer_width_m` from a
/// sharp line or from the border of a refined region there are `layers` layers, each `layer_ratio` times as wide as the
/// next one inwards; beyond them the width grows by 1/layer_ratio until it reaches size_m. Along the line the edges
/// stay long, because the error of a thin wall is concentrated in boundary layers as wide as the wall is thick.
struct SurfaceSize {
  double size_m = 0.0;         ///< m, > 0; 0: 9 wall thicknesses of the patch, at most an eighth of the part's diagonal
  double least_plane_m = 0.0;  ///< m; below which the automatic size of plane patches is not, up to the same eighth
  double scale = 1.0;          ///< factor on the wanted edge, 0.05 to 20
  int layers = 1;              ///< 0 to 4
  double layer_width_m = 0.0;  ///< m, > 0; 0: the wall thickness of the patch
  double layer_ratio = 0.15;   ///< 0.05 to 0.8
  double turn_rad = 0.05;   ///< turning of the surface along an edge, 0.01 to 1; a bent wall's volume errs by turn²/6
  double deviation = 0.05;  ///< distance of a triangle from a curved patch, of its wall thickness, 0.01 to 0.5
  double sharp_angle_rad = 0.5235987755982988;  ///< dihedral angle above which an edge is a feature, 0.05 to 2 (30°)
  std::vector<Region> refined{};  ///< spheres and boxes (clamps, contact patches) with layers on their borders
};

/// Throws InputError that lists every field out of its range, and for a plane among the refined regions.
void validate(const SurfaceSize& size);

/// A space whose coordinates of a point x of patch P are
///
///     ( x/H,  n/θ,  φ(d₁), φ(d₂) … )
///
/// with the wanted size H, the surface's normal n, the turning θ, and the distances d_k to the sharp lines of the patch
/// and the borders of refined regions. These are stretched by φ' = (1/h² − 1/H²)^½ if h(d) = h₀ + g d < H, otherwise 0,
/// with g = −ln layer_ratio and h₀ such that ∫₀^w dd/h = layers: across the layers, the coordinates x/H and φ together
/// then count 1/h wanted edges per length. The Euclidean length of an edge is thus its number of wanted edges, which
/// gives an anisotropic size by embedding (Lévy & Bonneel 2012, "Variational anisotropic surface meshing"; there in six
/// dimensions, with normals). A patch that is nowhere wider than it is thick (the rim of a wall) has no d_k.
class SizeSpace {
 public:
  /// The space of a surface. `thickness`: that of every triangle (mesh::wall_thickness()).
  SizeSpace(const TriangleSurface& surface, const SurfaceFeatures& features, const std::vector<double>& thickness,
            const SurfaceSize& size);

  /// The coordinates of a point x of a patch with the normal n there.
  [[nodiscard]] Eigen::VectorXd at(int patch, const Eigen::Vector3d& x, const Eigen::Vector3d& normal) const;
  /// Unit normal of the input surface, interpolated between the patch's own vertex normals, at the point nearest to x.
  [[nodiscard]] Eigen::Vector3d normal(int patch, const Eigen::Vector3d& x) const;
  /// The point of a patch of the input surface nearest to x, m.
  [[nodiscard]] Eigen::Vector3d on_patch(int patch, const Eigen::Vector3d& x) const;
  /// The point of a sharp line of the input surface nearest to x, m.
  [[nodiscard]] Eigen::Vector3d on_line(int line, const Eigen::Vector3d& x) const;
  /// The distance by which a face of the new mesh may lie off the patch, m: SurfaceSize::deviation. It is 0 for a
  /// planar patch, whose faces need no check.
  [[nodiscard]] double allowed_deviation_m(int patch) const;
  /// True if the patch is planar.
  [[nodiscard]] bool is_planar(int patch) const;

 private:
  struct Patch {
    TriangleTree tree;
    double size = 0.0;       // H
    double thickness = 0.0;  // median wall thickness
    bool planar = false;
    std::vector<int> lines{};  // those that its layers run along
    double first = 0.0;        // h₀; infinite without layers
    double growth = 0.0;       // g
    Eigen::Vector3d mean_normal = Eigen::Vector3d::Zero();
  };
  [[nodiscard]] Patch make_patch(int patch, const SurfaceFeatures& features, const std::vector<double>& thickness,
                                 const SurfaceSize& size) const;
  [[nodiscard]] const Patch& of(int patch) const { return patches_[static_cast<std::size_t>(patch)]; }

  TriangleSurface surface_;
  std::vector<std::array<Eigen::Vector3d, 3>> normals_;  // of each triangle's corners, within its patch
  std::vector<Polyline> lines_;                          // the sharp lines
  std::vector<Polyline> straight_lines_;                 // the same without vertices that lie on the way
  std::vector<Eigen::AlignedBox3d> line_blocks_;         // around each line
  std::vector<Region> refined_;
  double turn_ = 1.0;       // θ
  double deviation_ = 0.0;  // of the wall thickness
  std::vector<Patch> patches_;
};

}  // namespace thinwall::mesh
