// Bindings of meshes: boxes, prisms, files, and the regions that select their faces.

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/mesh/mesh_file.hpp"
#include "mesh/planar/box_mesh.hpp"
#include "mesh/solid/quality.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

mesh::PrismMeshOptions options_of(double element_size, int layers,
                                  const std::vector<std::pair<Eigen::Vector2d, double>>& spots) {
  mesh::PrismMeshOptions options{.size_m = element_size, .layers = layers};
  for (const auto& [at, radius] : spots) options.spots.push_back({at, radius});
  return options;
}

Mesh box_mesh(const Eigen::Vector3d& size, double element_size, int layers,
              const std::vector<std::pair<Eigen::Vector2d, double>>& spots) {
  return {mesh::mesh_box({size}, options_of(element_size, layers, spots))};
}

Mesh prism_mesh(const mesh::Polygon& outline, double top, double element_size, double bottom,
                const std::vector<mesh::Polygon>& holes,
                const std::vector<std::tuple<mesh::Polygon, double, double>>& zones, int layers,
                const std::vector<std::pair<Eigen::Vector2d, double>>& spots) {
  mesh::Prism prism{outline, holes, bottom, top, {}};
  for (const auto& [border, low, high] : zones) prism.zones.push_back({border, low, high});
  return {mesh::mesh_prism(prism, options_of(element_size, layers, spots))};
}

Mesh read_mesh(const std::filesystem::path& path, const std::string& unit) {
  mesh::SolidMesh solid = io::read_solid_mesh(path, unit);
  Mesh mesh{std::move(solid.mesh)};
  if (solid.nodes.order == 2) mesh.nodes = std::move(solid.nodes);
  return mesh;
}

py::array vertices(const py::object& self) {
  const auto& vertices = self.cast<const Mesh&>().tets.vertices;
  return view(vertices.data()->data(), {static_cast<py::ssize_t>(vertices.size()), 3}, self);
}

py::array tets(const py::object& self) {
  const auto& tets = self.cast<const Mesh&>().tets.tets;
  return view(tets.data()->data(), {static_cast<py::ssize_t>(tets.size()), 4}, self);
}

/// "(0, 0.1, 0.2)".
std::string text(const Eigen::Vector3d& v) {
  return "(" + core::number_text(v.x()) + ", " + core::number_text(v.y()) + ", " + core::number_text(v.z()) + ")";
}

std::string represented(const Mesh& mesh) {
  return "<Mesh of " + std::to_string(mesh.tets.tets.size()) + " tetrahedra of order " +
         std::to_string(mesh.nodes ? mesh.nodes->order : 1) + ", " + std::to_string(mesh.tets.vertices.size()) +
         " corners>";
}

py::tuple members_of_mesh(const Mesh& mesh) {
  py::object nodes = py::none();
  if (mesh.nodes) nodes = py::make_tuple(mesh.nodes->order, mesh.nodes->positions, mesh.nodes->elements);
  return py::make_tuple(mesh.tets.vertices, mesh.tets.tets, nodes);
}

Mesh mesh_of(const py::tuple& members) {
  Mesh mesh{{members[0].cast<std::vector<Eigen::Vector3d>>(), members[1].cast<std::vector<std::array<int, 4>>>()}};
  if (members[2].is_none()) return mesh;
  const py::tuple nodes = members[2];
  mesh.nodes = {nodes[0].cast<int>(), nodes[1].cast<decltype(mesh::LagrangeNodes::positions)>(),
                nodes[2].cast<decltype(mesh::LagrangeNodes::elements)>()};
  return mesh;
}

mesh::Region outermost(const mesh::TetMesh& mesh, const std::string& name) {
  Eigen::Vector3d low = mesh.vertices.front(), high = low;
  for (const auto& v : mesh.vertices) {
    low = low.cwiseMin(v);
    high = high.cwiseMax(v);
  }
  auto plane = std::get<mesh::PlaneRegion>(mesh::face_of({high - low}, name));
  plane.point += low;
  return plane;
}

void bind_regions(py::module_& module) {
  py::class_<mesh::PlaneRegion>(module, "Plane", "All faces of a mesh in the plane through `point` (m).")
      .def(py::init<Eigen::Vector3d, Eigen::Vector3d>(), "point"_a, "normal"_a)
      .def_readonly("point", &mesh::PlaneRegion::point, "A point of the plane, m.")
      .def_readonly("normal", &mesh::PlaneRegion::normal, "The normal of the plane.")
      .def("__repr__",
           [](const mesh::PlaneRegion& r) {
             return "Plane(point=" + text(r.point) + ", normal=" + text(r.normal) + ")";
           })
      .def(py::pickle([](const mesh::PlaneRegion& r) { return py::make_tuple(r.point, r.normal); },
                      [](const py::tuple& t) {
                        return mesh::PlaneRegion{t[0].cast<Eigen::Vector3d>(), t[1].cast<Eigen::Vector3d>()};
                      }));
  py::class_<mesh::BoxRegion>(module, "Block", "All faces of a mesh inside the block from `min` to `max` (m).")
      .def(py::init<Eigen::Vector3d, Eigen::Vector3d>(), "min"_a, "max"_a)
      .def_readonly("min", &mesh::BoxRegion::min, "The lowest corner, m.")
      .def_readonly("max", &mesh::BoxRegion::max, "The highest corner, m.")
      .def("__repr__",
           [](const mesh::BoxRegion& r) { return "Block(min=" + text(r.min) + ", max=" + text(r.max) + ")"; })
      .def(py::pickle([](const mesh::BoxRegion& r) { return py::make_tuple(r.min, r.max); },
                      [](const py::tuple& t) {
                        return mesh::BoxRegion{t[0].cast<Eigen::Vector3d>(), t[1].cast<Eigen::Vector3d>()};
                      }));
  py::class_<mesh::SphereRegion>(module, "Ball", "All faces of a mesh inside a ball (m).")
      .def(py::init<Eigen::Vector3d, double>(), "centre"_a, "radius"_a)
      .def_readonly("centre", &mesh::SphereRegion::centre, "The centre, m.")
      .def_readonly("radius", &mesh::SphereRegion::radius, "The radius, m.")
      .def("__repr__",
           [](const mesh::SphereRegion& r) {
             return "Ball(centre=" + text(r.centre) + ", radius=" + core::number_text(r.radius) + ")";
           })
      .def(py::pickle([](const mesh::SphereRegion& r) { return py::make_tuple(r.centre, r.radius); },
                      [](const py::tuple& t) {
                        return mesh::SphereRegion{t[0].cast<Eigen::Vector3d>(), t[1].cast<double>()};
                      }));
}

}  // namespace

mesh::Region region_on(const mesh::TetMesh& mesh, const py::object& region) {
  if (py::isinstance<py::str>(region)) return outermost(mesh, region.cast<std::string>());
  if (py::isinstance<mesh::PlaneRegion>(region)) return region.cast<mesh::PlaneRegion>();
  if (py::isinstance<mesh::BoxRegion>(region)) return region.cast<mesh::BoxRegion>();
  if (py::isinstance<mesh::SphereRegion>(region)) return region.cast<mesh::SphereRegion>();
  throw core::InputError("a region is \"x_min\" … \"z_max\", a Plane, a Block or a Ball, not " +
                         py::repr(region).cast<std::string>());
}

void bind_mesh(py::module_& module) {
  bind_regions(module);
  py::class_<Mesh>(module, "Mesh", "A part as tetrahedra.")
      .def_property_readonly("vertices", vertices, "The positions of the corners, (n, 3) in m; a view.")
      .def_property_readonly("tets", tets, "The four vertices of each tetrahedron, (m, 4); a view.")
      .def_property_readonly(
          "volume_m3", [](const Mesh& mesh) { return mesh::volume(mesh.tets); }, "The sum of the volumes.")
      .def_property_readonly(
          "order", [](const Mesh& mesh) { return mesh.nodes ? mesh.nodes->order : 1; },
          "The order: 1, or 2 for a file with nodes in the middles of edges.")
      .def_property_readonly(
          "aspect_ratio", [](const Mesh& mesh) { return mesh::quality(mesh.tets).aspect_ratio; },
          "The longest edge over the smallest height of the worst tetrahedron.")
      .def("__repr__", represented)
      .def(py::pickle(&members_of_mesh, &mesh_of));
  module.def(
      "box_mesh", box_mesh, "size"_a, "element_size"_a, "layers"_a = 1,
      "spots"_a = std::vector<std::pair<Eigen::Vector2d, double>>{}, LongCallGuard(),
      "The mesh of a box from the origin to `size` (m), with one element through its thinnest side.\n\n"
      "element_size: wanted edge away from borders, m. layers: number of graded layers along borders, 0 to 8. spots:\n"
      "(place, radius) in the plane of the wall, at which elements are as small as the radius.");
  module.def("prism_mesh", prism_mesh, "outline"_a, "top"_a, "element_size"_a, "bottom"_a = 0.0,
             "holes"_a = std::vector<mesh::Polygon>{},
             "zones"_a = std::vector<std::tuple<mesh::Polygon, double, double>>{}, "layers"_a = 1,
             "spots"_a = std::vector<std::pair<Eigen::Vector2d, double>>{}, LongCallGuard(),
             "The mesh of a part with an outline in the x-y plane, from z = bottom to top (m).\n\n"
             "outline, holes: lists of (x, y). zones: (outline, bottom, top), where the part is thinner or thicker;\n"
             "later zones replace earlier ones. Raises InputError with every fault of the part.");
  module.def("read_mesh", read_mesh, "path"_a, "unit"_a, LongCallGuard(),
             "The mesh of a file of Gmsh, Abaqus, CalculiX (.inp) or VTK (.vtu), with all solids as tetrahedra.\n\n"
             "unit: the file's unit of length, such as \"mm\", which no format contains.");
}

}  // namespace thinwall::python
