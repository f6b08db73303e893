#pragma once
// The part: its shape, material, mesh, supports and what hangs on it.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/words.hpp"
#include "io/matrices/matrix_files.hpp"
#include "mesh/planar/prism.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "setup/point.hpp"

namespace thinwall::setup {

/// Isotropic linear elasticity.
struct Material {
  double youngs_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.0;
  double density = 0.0;  ///< kg/m³
};

/// The mesh that is asked for: by a tolerance, or by the size of its elements.
struct MeshOptions {
  std::optional<double> element_size;        ///< m; none: from the tolerance
  double tolerance = 1e-3;                   ///< on frequencies and receptances, where the size is not given
  std::optional<int> order;                  ///< none: from the tolerance; 2 with a given size
  double quality = 1.4;                      ///< TetGen's bound on circumradius over shortest edge
  std::optional<double> grading;             ///< growth of the size away from the named points
  std::optional<double> point_element_size;  ///< m, near the named points
  double time_limit = 120.0;                 ///< s
  std::optional<double> time_budget;         ///< s, for refinement; none: not bounded
  double memory_limit = 4e9;                 ///< bytes
};

/// Directions held at zero on a face (`x_min` … `z_max`) or on a selection.
struct Support {
  std::string on;
  std::vector<int> fixed;  ///< 0, 1, 2 for x, y, z
};

/// Another material than the part's, of a set of elements or of a selection.
struct MaterialRegion {
  std::string on;
  Material material;
};

/// A bed of springs on a face or a selection, stiffness per area.
struct Clamp {
  std::string on;
  double normal = 0.0, tangential = 0.0;  ///< N/m³
};

/// A rigid body on a point.
struct PointMass {
  std::string at;
  double mass = 0.0;                                  ///< kg
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< kg m², about its own centre and x, y, z
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   ///< m
};

/// Springs from a point to ground.
struct PointSpring {
  std::string at;
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();           ///< N/m
  Eigen::Vector3d rotation_stiffness = Eigen::Vector3d::Zero();  ///< N m/rad
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();              ///< m
};

/// The part is bent about a cylinder; the middle of its extent along `along` stays where it is.
struct Bend {
  double radius = 0.0;       ///< m, of the mid-surface
  std::optional<int> along;  ///< 0, 1, 2 for x, y, z
};

struct ImportedPart;

/// A surface or a mesh in a file, and how it is read.
struct PartFile {
  std::filesystem::path path;
  std::string unit;                                  ///< of length; no default
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m: the point of the file where the part's axes begin
};

/// A box with one corner at the origin, as it stands or bent.
struct BoxShape {
  double length = 0.0, height = 0.0, thickness = 0.0;        ///< m
  int length_axis = 1, height_axis = 2, thickness_axis = 0;  ///< 0, 1, 2 for x, y, z
  std::optional<Bend> bend;
};

/// An outline in x and y, extruded along z, as it stands or bent.
struct PrismShape {
  mesh::Prism prism;
  std::optional<Bend> bend;
};

/// A closed surface of triangles in a file.
struct SurfaceShape {
  PartFile file;
  mesh::SurfaceRepairOptions repair;
};

/// A mesh of tetrahedra in a file.
struct MeshShape {
  PartFile file;
  std::string mass_unit;  ///< of the materials in the file
};

/// Stiffness and mass matrices in files.
struct MatrixShape {
  io::MatrixFiles files;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m: the point of the file where the part's axes begin
};

/// The shape of a part, or the file that it comes from.
using PartShape = std::variant<BoxShape, PrismShape, SurfaceShape, MeshShape, MatrixShape>;

/// The shapes of a part, in the order of PartShape.
enum class ShapeKind { box, prism, surface, mesh, matrices };

/// A part: its shape, material, mesh, and what holds it or hangs on it.
struct Part {
  PartShape shape;
  std::shared_ptr<const ImportedPart> imported;  ///< what the file holds, once it is read (setup/imported_part.hpp)
  Material material;
  std::vector<MaterialRegion> materials;  ///< others; later ones win
  MeshOptions mesh;
  std::vector<Support> supports;  ///< none: a free part, unless clamps or springs hold it
  std::vector<Clamp> clamps;
  std::vector<PointMass> masses;
  std::vector<PointSpring> springs;
};

/// The kind of a part's shape.
[[nodiscard]] inline ShapeKind kind(const Part& part) {
  return static_cast<ShapeKind>(part.shape.index());
}

/// The bend of a box or a prism; nullptr of a part that is not bent.
[[nodiscard]] const Bend* bend(const Part& part);

/// The file of a surface or a mesh; nullptr of other parts.
[[nodiscard]] const PartFile* shape_file(const Part& part);

/// The unit of length of the part's file; "" where it is not stated, and of a part without one.
[[nodiscard]] std::string file_unit(const Part& part);

/// The block around the part, before it is bent, m.
[[nodiscard]] Eigen::AlignedBox3d bounds(const Part& part);

/// part.mesh.tolerance where the case does not give it: 0.01 of a surface from a file, 0.001 of other parts.
[[nodiscard]] double usual_tolerance(const Part& part);

/// The time after which a part is refined no further unless the case says otherwise, s: 30 for a surface of a file,
/// whose mesh and cost nobody knows beforehand; none for others.
[[nodiscard]] std::optional<double> usual_time_budget(const Part& part);

/// True if something holds the part, as far as the case tells: matrices may be those of a held part.
[[nodiscard]] bool may_be_held(const Part& part);

/// Its extents along x, y, z, m.
[[nodiscard]] Eigen::Vector3d box_size(const Part& part);

/// Position of a point in the part's axes, m: fractions of the box (or the given position) plus the offset.
[[nodiscard]] Eigen::Vector3d position(const Part& part, const Point& point);

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 5> words<setup::ShapeKind>{"box", "prism", "surface", "mesh", "matrices"};

}  // namespace thinwall::core
