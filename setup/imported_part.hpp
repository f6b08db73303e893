#pragma once
// A part whose shape comes from a file: read once, when the case is read.

#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "dynamics/sparse_model.hpp"
#include "io/mesh/mesh_file.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// Contents of a part's file, in m, in the part's axes.
struct ImportedPart {
  std::optional<mesh::SurfaceRepair> surface;     ///< of shape surface
  std::optional<io::MeshFile> mesh;               ///< of shape mesh
  std::optional<dynamics::SparseModel> matrices;  ///< of shape matrices
  Eigen::AlignedBox3d box;
  std::string summary;             ///< what was read and mended, for people
  std::vector<std::string> notes;  ///< what a reader noticed, a line each
};

/// The shape that a file's ending tells: "surface", "mesh"; empty for an ending that no reader knows.
[[nodiscard]] std::optional<ShapeKind> shape_of_file(const std::filesystem::path& file);

/// True if a file of that ending states its unit of length: STEP.
[[nodiscard]] bool tells_its_unit(const std::filesystem::path& file);

/// True if the part's shape is one that a file holds.
[[nodiscard]] bool from_file(const Part& part);

/// The mesh of the part's file, once it is read; null for parts of other shapes.
[[nodiscard]] const mesh::SolidMesh* solid_of(const Part& part);

/// The node that a point stands for: by its number, or, where it has none, by its name in the part's DOF table.
[[nodiscard]] std::optional<int> node_of(const ImportedPart& part, const Point& point);

/// The position of a numbered node of an imported part, m; NaN where no file says it.
[[nodiscard]] Eigen::Vector3d node_position(const Part& part, int node);

/// Numbers of the nodes that can move, ascending; empty for parts without numbered nodes.
[[nodiscard]] std::vector<int> node_numbers(const ImportedPart& part);

/// The file that a part's shape comes from, of matrices that of the stiffness; empty of other parts.
[[nodiscard]] std::filesystem::path main_file(const Part& part);

/// Reads the part's file. Throws DataError for one that cannot be read, InputError, with the file's name, for a unit
/// that is none and for what mesh::repaired_surface refuses. Matrices that no part has throw DataError with the file of
/// the one at fault (setup/matrix_faults.hpp). Cost: that of reading and repair.
[[nodiscard]] std::shared_ptr<const ImportedPart> read_part_file(const Part& part);

}  // namespace thinwall::setup
