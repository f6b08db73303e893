#include "setup/part_materials.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/surface_unit.hpp"
#include "mesh/solid/plane_cut.hpp"
#include "setup/imported_part.hpp"

namespace thinwall::setup {

namespace {

fem::Material material(const Material& m) {
  return {m.youngs_modulus, m.poisson_ratio, m.density};
}

bool given(const Material& m) {
  return std::isfinite(m.youngs_modulus) && std::isfinite(m.poisson_ratio) && std::isfinite(m.density);
}

Eigen::Vector3d corner(const mesh::TetMesh& mesh, std::size_t tet, int k) {
  return mesh.vertices[static_cast<std::size_t>(mesh.tets[tet][static_cast<std::size_t>(k)])];
}

Eigen::Vector3d centre(const mesh::TetMesh& mesh, std::size_t tet) {
  return 0.25 * (corner(mesh, tet, 0) + corner(mesh, tet, 1) + corner(mesh, tet, 2) + corner(mesh, tet, 3));
}

/// Tetrahedra of a set of the file, or whose centres the selection of that name holds.
std::vector<int> tets_in(const PartSetup& source, const std::string& name, const mesh::TetMesh& mesh) {
  const auto selection = std::ranges::find(source.selections, name, &Selection::name);
  if (selection == source.selections.end())
    return mesh::element_set(*solid_of(*source.part), name, main_file(*source.part).string()).tets;
  std::vector<int> tets;
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
    if (contains(*selection, centre(mesh, tet), 0.0)) tets.push_back(static_cast<int>(tet));
  }
  if (tets.empty())
    throw core::InputError("part.materials: no element has its centre in \"" + name + "\": enlarge it, or mesh finer");
  return tets;
}

void set_material(fem::Materials& materials, const std::vector<int>& tets, const fem::Material& m) {
  const int index = static_cast<int>(materials.list.size());
  materials.list.push_back(m);
  for (const int tet : tets) materials.of_tet[static_cast<std::size_t>(tet)] = index;
}

double kilograms_per_unit(const Part& part) {
  return core::parse_quantity("1 " + std::get<MeshShape>(part.shape).mass_unit, core::kind::mass);
}

/// The file's sections in SI, each on its set of elements.
void add_sections(const Part& part, fem::Materials& materials) {
  const double metres = io::metres_per_unit(file_unit(part), main_file(part).string());
  for (const io::InpMaterial& raw : part.imported->mesh->materials) {
    const io::InpMaterial m = io::in_si(raw, metres, kilograms_per_unit(part));
    if (!io::what_lacks(m).empty()) continue;  // the check has told of it
    set_material(materials, mesh::element_set(*solid_of(part), m.element_set, main_file(part).string()).tets,
                 {*m.youngs_modulus, *m.poisson_ratio, *m.density});
  }
}

}  // namespace

bool materials_in_file(const Part& part) {
  const auto* mesh = std::get_if<MeshShape>(&part.shape);
  return mesh != nullptr && part.imported && part.imported->mesh && !part.imported->mesh->materials.empty() &&
         !mesh->mass_unit.empty();
}

mesh::TetMesh cut_at_materials(const PartSetup& source, mesh::TetMesh mesh) {
  if (kind(*source.part) == ShapeKind::mesh) return mesh;
  for (const MaterialRegion& region : source.part->materials) {
    const auto selection = std::ranges::find(source.selections, region.on, &Selection::name);
    if (selection == source.selections.end() || !selection->box) continue;
    for (const Eigen::Vector3d& corner : {selection->box->min, selection->box->max}) {
      for (int axis = 0; axis < 3; ++axis) mesh = mesh::cut_along(mesh, {corner, Eigen::Vector3d::Unit(axis)});
    }
  }
  return mesh;
}

double misplaced_share(const PartSetup& source, const mesh::TetMesh& mesh) {
  constexpr int n = 4;  // lattice of points within an element
  double misplaced = 0.0;
  for (const MaterialRegion& region : source.part->materials) {
    const auto selection = std::ranges::find(source.selections, region.on, &Selection::name);
    if (selection == source.selections.end() || !selection->sphere) continue;
    for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
      int samples = 0, within = 0;
      for (int i = 0; i <= n; ++i) {
        for (int j = 0; i + j <= n; ++j) {
          for (int k = 0; i + j + k <= n; ++k) {
            const Eigen::Vector4d lambda = (Eigen::Vector4d(i, j, k, n - i - j - k).array() + 0.25) / (n + 1);
            Eigen::Vector3d x = Eigen::Vector3d::Zero();
            for (int v = 0; v < 4; ++v) x += lambda(v) * corner(mesh, tet, v);
            ++samples;
            within += contains(*selection, x, 0.0) ? 1 : 0;
          }
        }
      }
      const int wrong = contains(*selection, centre(mesh, tet), 0.0) ? samples - within : within;
      misplaced += mesh::volume(mesh, static_cast<int>(tet)) * wrong / samples;
    }
  }
  return misplaced / mesh::volume(mesh);
}

fem::Materials materials_on(const PartSetup& source, const mesh::TetMesh& mesh) {
  const Part& part = *source.part;
  fem::Materials materials;
  if (given(part.material)) materials.list.push_back(material(part.material));
  if (part.materials.empty() && given(part.material) && !materials_in_file(part)) return materials;
  materials.of_tet.assign(mesh.tets.size(), given(part.material) ? 0 : -1);
  if (materials_in_file(part)) add_sections(part, materials);
  for (const MaterialRegion& region : part.materials)
    set_material(materials, tets_in(source, region.on, mesh), material(region.material));
  const auto without = std::ranges::find(materials.of_tet, -1);
  if (without != materials.of_tet.end()) {
    const Eigen::Vector3d x = 1e3 * centre(mesh, static_cast<std::size_t>(without - materials.of_tet.begin()));
    char place[96];
    std::snprintf(place, sizeof place, "(%.4g, %.4g, %.4g) mm", x(0), x(1), x(2));
    throw core::InputError("an element at " + std::string(place) +
                           " has no material: give [part.material] for what no set or selection names");
  }
  return materials;
}

double mass(const fem::Materials& materials, const mesh::TetMesh& mesh) {
  double sum = 0.0;
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
    const std::size_t index = materials.of_tet.empty() ? 0 : static_cast<std::size_t>(materials.of_tet[tet]);
    sum += materials.list[index].density_kg_m3 * mesh::volume(mesh, static_cast<int>(tet));
  }
  return sum;
}

}  // namespace thinwall::setup
