#include "setup/imported_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/matrices/matrix_files.hpp"
#include "io/surface/surface_file.hpp"
#include "setup/matrix_faults.hpp"

namespace thinwall::setup {

namespace {

constexpr std::array surface_endings{".stl", ".off", ".obj", ".ply", ".3mf", ".glb", ".gltf", ".step", ".stp"};
constexpr std::array mesh_endings{".msh", ".inp", ".vtu"};

std::string ending(const std::filesystem::path& file) {
  std::string text = file.extension().string();
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c; });
  return text;
}

/// A place of the file in the digits that part.origin takes.
std::string as_origin(const Eigen::Vector3d& x) {
  std::string list;
  for (int i = 0; i < 3; ++i) list += (i == 0 ? "[" : ", ") + core::readable_text(x[i], core::kind::length);
  return list + "]";
}

ImportedPart read_surface_part(const PartFile& file, const mesh::SurfaceRepairOptions& repair) {
  mesh::TriangleSoup soup = io::read_surface(file.path, file.unit);
  for (auto& x : soup.points) x -= file.origin;
  ImportedPart part;
  part.surface = mesh::repaired_surface(soup, repair);
  if (part.surface->moved_by != Eigen::Vector3d::Zero()) {
    throw core::InputError("the part lies far from the origin for its size of " + mesh::size_text(soup) +
                           "; set part.origin to a place on it, such as " +
                           as_origin(file.origin - part.surface->moved_by));
  }
  for (const auto& x : part.surface->surface.vertices) part.box.extend(x);
  part.summary = mesh::size_text(soup) + ", " + std::to_string(part.surface->surface.triangles.size()) +
                 " triangles; mended: " + mesh::text(*part.surface);
  return part;
}

ImportedPart read_mesh_part(const PartFile& file) {
  ImportedPart part;
  part.mesh = io::read_mesh_file(file.path, file.unit);
  mesh::SolidMesh& solid = part.mesh->solid;
  for (auto& x : solid.mesh.vertices) part.box.extend(x -= file.origin);
  solid.nodes.positions.rowwise() -= file.origin.transpose();
  const Eigen::Vector3d size = 1e3 * part.box.sizes();
  part.summary = fmt::format("{:.4g} x {:.4g} x {:.4g} mm, {} tetrahedra of order {}", size.x(), size.y(), size.z(),
                             solid.mesh.tets.size(), solid.nodes.order);
  if (solid.pieces > 1) part.summary += fmt::format(", {} pieces that share no node", solid.pieces);
  part.notes = solid.notices;
  for (const io::InpMaterial& m : part.mesh->materials) {
    if (const std::string lacking = io::what_lacks(m); !lacking.empty())
      part.notes.push_back("the material \"" + m.name + "\" of the set " + m.element_set + " has no " + lacking +
                           ": the case's takes its place");
  }
  return part;
}

ImportedPart read_matrix_part(const MatrixShape& shape) {
  io::ImportedMatrices imported = io::read_matrices(shape.files);
  dynamics::require_consistent(imported.model);
  try {
    dynamics::require_plausible(imported.model);
  } catch (const core::InputError&) {
    require_plausible_files(shape.files, imported.model);  // tells which file
    throw;
  }
  ImportedPart part;
  for (auto& [node, x] : imported.model.positions) part.box.extend(x -= shape.origin);
  part.summary = imported.format + ", " + std::to_string(imported.model.size()) + " rows";
  part.notes = std::move(imported.notes);
  part.matrices = std::move(imported.model);
  return part;
}

}  // namespace

std::filesystem::path main_file(const Part& part) {
  if (const auto* matrices = std::get_if<MatrixShape>(&part.shape)) return matrices->files.stiffness;
  const PartFile* file = shape_file(part);
  return file != nullptr ? file->path : std::filesystem::path();
}

std::optional<ShapeKind> shape_of_file(const std::filesystem::path& file) {
  const auto among = [end = ending(file)](const auto& endings) {
    return std::ranges::find(endings, end) != endings.end();
  };
  if (among(surface_endings)) return ShapeKind::surface;
  return among(mesh_endings) ? std::optional(ShapeKind::mesh) : std::nullopt;
}

bool tells_its_unit(const std::filesystem::path& file) {
  constexpr std::array endings{".step", ".stp", ".3mf", ".glb", ".gltf"};
  return std::ranges::find(endings, ending(file)) != endings.end();
}

bool from_file(const Part& part) {
  return kind(part) == ShapeKind::surface || kind(part) == ShapeKind::mesh || kind(part) == ShapeKind::matrices;
}

Eigen::Vector3d node_position(const Part& part, int node) {
  Eigen::Vector3d unknown = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (!part.imported) return unknown;
  if (part.imported->mesh) {
    const auto& solid = part.imported->mesh->solid;
    const auto label = std::ranges::find(solid.node_labels, node);
    if (label == solid.node_labels.end()) return unknown;
    return solid.nodes.positions.row(label - solid.node_labels.begin()).transpose();
  }
  if (!part.imported->matrices) return unknown;
  const auto& positions = part.imported->matrices->positions;
  const auto found = positions.find(node);
  return found == positions.end() ? unknown : found->second;
}

const mesh::SolidMesh* solid_of(const Part& part) {
  return part.imported && part.imported->mesh ? &part.imported->mesh->solid : nullptr;
}

std::optional<int> node_of(const ImportedPart& part, const Point& point) {
  if (point.node || !part.matrices) return point.node;
  for (const auto& [node, name] : part.matrices->names) {
    if (name == point.name) return node;
  }
  return std::nullopt;
}

std::vector<int> node_numbers(const ImportedPart& part) {
  std::vector<int> nodes;
  if (part.mesh) {
    for (const auto label : part.mesh->solid.node_labels) {
      if (label >= 0) nodes.push_back(static_cast<int>(label));
    }
  }
  if (part.matrices) {
    for (const auto& dof : part.matrices->dofs) {
      if (dof.component > 0) nodes.push_back(dof.node);
    }
  }
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::shared_ptr<const ImportedPart> read_part_file(const Part& part) {
  try {
    if (const auto* matrices = std::get_if<MatrixShape>(&part.shape))
      return std::make_shared<ImportedPart>(read_matrix_part(*matrices));
    if (const auto* mesh = std::get_if<MeshShape>(&part.shape))
      return std::make_shared<ImportedPart>(read_mesh_part(mesh->file));
    const auto& surface = std::get<SurfaceShape>(part.shape);
    return std::make_shared<ImportedPart>(read_surface_part(surface.file, surface.repair));
  } catch (const core::InputError& error) {
    throw core::InputError(main_file(part).string() + ": " + error.what());
  }
}

}  // namespace thinwall::setup
