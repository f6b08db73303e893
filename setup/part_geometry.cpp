#include "setup/part_geometry.hpp"

#include <algorithm>
#include <cmath>

#include "setup/imported_part.hpp"

namespace thinwall::setup {

namespace {

int along_axis(const Part& part, int through) {
  if (const auto along = bend(part)->along) return *along;
  Eigen::Vector3d size = box_size(part);
  size[through] = 0.0;
  int longest = 0;
  size.maxCoeff(&longest);
  return longest;
}

}  // namespace

PlanarPart planar(const Part& part) {
  if (const auto* shape = std::get_if<PrismShape>(&part.shape)) return {shape->prism, {0, 1, 2}};
  const auto& box = std::get<BoxShape>(part.shape);
  PlanarPart result;
  result.axes = {box.length_axis, box.height_axis, box.thickness_axis};
  result.prism.outline = {{0.0, 0.0}, {box.length, 0.0}, {box.length, box.height}, {0.0, box.height}};
  result.prism.top = box.thickness;
  return result;
}

mesh::Bend bend_of(const Part& part) {
  const int through = planar(part).axes[2];
  const int along = along_axis(part, through);
  const Eigen::Vector3d middle = bounds(part).center();
  return {bend(part)->radius, along, through, middle[along], middle[through]};
}

fem::Shaping shaping(const Part& part) {
  if (bend(part) == nullptr) return {};
  return [bend = bend_of(part)](mesh::LagrangeNodes& nodes) { mesh::bend(bend, nodes.positions); };
}

double mass(const Part& part, const mesh::TetMesh& flat) {
  if (from_file(part)) return part.material.density * part.imported->surface->volume_m3;
  if (bend(part) == nullptr) return part.material.density * mesh::volume(planar(part).prism);
  const mesh::Bend curve = bend_of(part);
  double volume = 0.0;
  for (int tet = 0; tet < static_cast<int>(flat.tets.size()); ++tet) {
    double w = -curve.middle_m;
    for (const int v : flat.tets[static_cast<std::size_t>(tet)])
      w += 0.25 * flat.vertices[static_cast<std::size_t>(v)][curve.through];
    volume += mesh::volume(flat, tet) * (1.0 + w / curve.radius_m);
  }
  return part.material.density * volume;
}

mesh::Region region_of(const PartSetup& source, const std::string& name) {
  const auto selection = std::find_if(source.selections.begin(), source.selections.end(),
                                      [&](const Selection& s) { return s.name == name; });
  if (selection == source.selections.end()) {
    const Eigen::AlignedBox3d box = bounds(*source.part);
    auto plane = std::get<mesh::PlaneRegion>(mesh::face_of({box.sizes()}, name));
    plane.point += box.min();
    return plane;
  }
  if (selection->plane) return mesh::PlaneRegion{selection->plane->point, selection->plane->normal};
  if (selection->box) return mesh::BoxRegion{selection->box->min, selection->box->max};
  return mesh::SphereRegion{selection->sphere->centre, selection->sphere->radius};
}

std::vector<int> rows_held_by_sets(const PartSetup& source, const mesh::SolidMesh& solid,
                                   const mesh::LagrangeNodes& nodes) {
  std::vector<int> rows;
  for (const Support& support : source.part->supports) {
    if (!names_node_set(source, support.on)) continue;
    const auto& set = mesh::node_set(solid, support.on, main_file(*source.part).string());
    const std::vector<int> held =
        nodes.order == solid.nodes.order ? set.nodes : mesh::set_of_order(solid.nodes, set.nodes, nodes);
    for (const int row : fem::rows_of(held, support.fixed)) rows.push_back(row);
  }
  return rows;
}

fem::Material material_of(const Part& part) {
  const Material& m = part.material;
  return {m.youngs_modulus, m.poisson_ratio, m.density};
}

std::vector<fem::Support> supports_of(const PartSetup& source) {
  std::vector<fem::Support> supports;
  for (const Support& s : source.part->supports) {
    if (!names_node_set(source, s.on)) supports.push_back({s.on, region_of(source, s.on), s.fixed});
  }
  return supports;
}

double off_surface(const Part& part) {
  if (kind(part) == ShapeKind::surface) return 0.01 * bounds(part).diagonal().norm();
  const mesh::SolidMesh* solid = solid_of(part);
  if (solid == nullptr || solid->midside_offset < 1e-6) return 0.0;
  const auto vertex = [solid](int v) { return solid->mesh.vertices[static_cast<std::size_t>(v)]; };
  double longest = 0.0;
  for (const auto& tet : solid->mesh.tets) {
    for (const int v : tet) longest = std::max(longest, (vertex(v) - vertex(tet[0])).norm());
  }
  return solid->midside_offset * longest;
}

std::vector<Eigen::Vector3d> facing(const PartSetup& source, const Point& point) {
  if (point.face.empty()) return point.directions;
  return {std::get<mesh::PlaneRegion>(region_of(source, point.face)).normal.normalized()};
}

fem::NamedPoint named_point(const PartSetup& source, const std::string& name) {
  const Point& p = point(source, name);
  return {p.name, position(*source.part, p), p.patch_radius,   p.directions, {},
          {},     off_surface(*source.part), facing(source, p)};
}

fem::ModeOptions mode_options(const PartSetup& source) {
  return {.count = source.modes.range.count.value_or(10),
          .substructures = source.modes.substructures,
          .up_to_hz = source.modes.range.up_to_hz};
}

std::vector<std::string> unreachable_tolerances(const PartSetup& source) {
  std::vector<std::string> warnings;
  if (!source.part || source.part->mesh.element_size) return warnings;
  if (kind(*source.part) == ShapeKind::matrices || kind(*source.part) == ShapeKind::mesh) return warnings;
  for (const std::string& name : source.reduction.interface) {
    if (point(source, name).patch_radius > 0.0) continue;
    warnings.push_back("points." + name +
                       " has no patch_radius: its receptance grows as the elements shrink, and no tolerance on it is "
                       "met; give the radius over which cutter or robot press");
  }
  return warnings;
}

}  // namespace thinwall::setup
