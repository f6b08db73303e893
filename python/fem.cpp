// Bindings of finite elements: assembly and modes of the full model of a part.

#include "core/error.hpp"
#include "core/units.hpp"
#include "fem/mode_check.hpp"
#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

using Rows3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The support for a region, or for (region, "xz"), which holds some axes only.
fem::Support support_on(const mesh::TetMesh& mesh, const py::object& words) {
  py::object region = words;
  std::string axes = "xyz";
  if (py::isinstance<py::tuple>(words)) {
    const auto pair = words.cast<std::pair<py::object, std::string>>();
    region = pair.first;
    axes = pair.second;
  }
  fem::Support support{py::repr(region).cast<std::string>(), region_on(mesh, region), {}};
  for (const char letter : axes) {
    if (letter < 'x' || letter > 'z') throw core::InputError("a support holds axes of \"xyz\", not \"" + axes + "\"");
    support.axes.push_back(letter - 'x');
  }
  return support;
}

fem::Model model_of(const Mesh& mesh, int order, const fem::Material& material,
                    const std::vector<fem::Support>& supports) {
  const LongCall guard;
  if (!mesh.nodes) return fem::supported_model(mesh.tets, order, material, supports);
  const auto fixed = fem::fixed_rows(mesh.tets, *mesh.nodes, supports);
  return fem::build_model(mesh.tets, *mesh.nodes, material, fixed);
}

std::unique_ptr<Part> assemble(const Mesh& mesh, const fem::Material& material, const OneOrMore<py::object>& fixed,
                               std::optional<int> order) {
  if (mesh.nodes && order.value_or(2) != 2)
    throw core::InputError("the file's mesh has nodes in the middles of its edges: its order is 2");
  std::vector<fem::Support> supports;
  for (const py::object& words : fixed.values) supports.push_back(support_on(mesh.tets, words));
  return std::make_unique<Part>(model_of(mesh, order.value_or(4), material, supports));
}

fem::Modes modes(Part& part, int count, std::optional<double> up_to_hz, bool verify) {
  fem::Modes modes = fem::modes(part.model, part.factored(), {.count = count, .up_to_hz = up_to_hz});
  if (verify) fem::verify(part.model, part.factored(), modes);
  return modes;
}

py::array positions(const py::object& self) {
  const auto& nodes = self.cast<const Part&>().model.nodes.positions;
  return view(nodes.data(), {nodes.rows(), 3}, self);
}

py::array free_rows(const py::object& self) {
  const auto& rows = self.cast<const Part&>().model.free_rows;
  return view(rows.data(), {static_cast<py::ssize_t>(rows.size())}, self);
}

Rows3 displacements(const Part& part, const Eigen::VectorXd& values) {
  if (values.size() != part.model.K.rows()) {
    throw core::InputError("displacements are wanted of a vector of " + std::to_string(values.size()) +
                           " values: the model has " + std::to_string(part.model.K.rows()) + " free rows");
  }
  return fem::displacements(part.model, values);
}

void bind_model(py::module_& module) {
  py::class_<Part>(module, "Model", "The stiffness and mass of a part over its free rows.")
      .def_property_readonly(
          "K", [](const py::object& self) { return sparse_view(self.cast<Part&>().model.K, self); },
          "The stiffness matrix, N/m, as a scipy.sparse.csc_matrix; a view.")
      .def_property_readonly(
          "M", [](const py::object& self) { return sparse_view(self.cast<Part&>().model.M, self); },
          "The mass matrix, kg, as a scipy.sparse.csc_matrix; a view.")
      .def_property_readonly("positions", positions, "The positions of the nodes, (n, 3) in m; a view.")
      .def_property_readonly("free_rows", free_rows, "The number 3 node + axis of each row of K; a view.")
      .def_property_readonly(
          "mass_kg", [](const Part& part) { return part.model.mass.mass_kg; },
          "The part's mass, from the unconstrained mass matrix.")
      .def_property_readonly(
          "rigid_motions", [](const Part& part) { return part.model.rigid_motions; },
          "The number of free rigid motions: 0 for a held part, 6 for a free one.")
      .def("__repr__",
           [](const Part& part) {
             return "<Model of " + std::to_string(part.model.K.rows()) + " free rows, " +
                    core::number_text(part.model.mass.mass_kg, 4) + " kg, " + std::to_string(part.model.rigid_motions) +
                    " rigid motions>";
           })
      .def("displacements", displacements, "values"_a,
           "The displacements of all nodes, (n, 3), from values of the free rows; held ones are zero.");
}

}  // namespace

const fem::Factored& Part::factored() {
  std::call_once(once_, [this] { factored_ = std::make_unique<fem::Factored>(fem::factorise(model)); });
  return *factored_;
}

void bind_fem(py::module_& module) {
  py::class_<fem::Material>(module, "Material", "An isotropic, linearly elastic material.")
      .def(py::init([](double E, double nu, double rho) {
             return fem::Material{E, nu, rho};
           }),
           "youngs_modulus_Pa"_a, "poisson_ratio"_a, "density_kg_m3"_a)
      .def_readonly("youngs_modulus_Pa", &fem::Material::youngs_modulus_Pa, "Young's modulus, Pa.")
      .def_readonly("poisson_ratio", &fem::Material::poisson_ratio, "Poisson's ratio.")
      .def_readonly("density_kg_m3", &fem::Material::density_kg_m3, "The density, kg/m³.")
      .def("__repr__",
           [](const fem::Material& m) {
             return "Material(youngs_modulus_Pa=" + core::number_text(m.youngs_modulus_Pa) +
                    ", poisson_ratio=" + core::number_text(m.poisson_ratio) +
                    ", density_kg_m3=" + core::number_text(m.density_kg_m3) + ")";
           })
      .def(py::pickle(
          [](const fem::Material& m) { return py::make_tuple(m.youngs_modulus_Pa, m.poisson_ratio, m.density_kg_m3); },
          [](const py::tuple& t) {
            return fem::Material{t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
          }));
  bind_model(module);
  py::class_<fem::Modes>(module, "Modes", "Natural modes in ascending order, rigid-body modes first.")
      .def_readonly("frequency_hz", &fem::Modes::frequency_hz, "The frequencies, 0 for rigid-body modes; a view.")
      .def_property_readonly(
          "shapes", [](const fem::Modes& modes) -> const Eigen::MatrixXd& { return modes.pairs.Phi; },
          py::return_value_policy::reference_internal,
          "The shapes as columns over the free rows, mass-normalised; a view.")
      .def_readonly("residual", &fem::Modes::residual,
                    "The relative residual ‖Kφ − λMφ‖ / (λ ‖Mφ‖) of each mode; a view.")
      .def_readonly("rigid_motions", &fem::Modes::rigid_motions, "The number of rigid-body modes.")
      .def_readonly("round_off", &fem::Modes::round_off,
                    "The relative change of the lowest frequency that round-off in K may cause.")
      .def("__repr__", [](const fem::Modes& modes) {
        const Eigen::VectorXd& hz = modes.frequency_hz;
        return "<Modes: " + std::to_string(hz.size()) +
               (hz.size() > 0
                    ? " from " + core::number_text(hz(0), 6) + " to " + core::number_text(hz(hz.size() - 1), 6) + " Hz>"
                    : std::string(">"));
      });
  module.def(
      "assemble", assemble, "mesh"_a, "material"_a, "fixed"_a = OneOrMore<py::object>{}, "order"_a = py::none(),
      "The part's Model with Lagrange tetrahedra of order 1 to 6 (by default 4, or 2 for a file of order 2).\n\n"
      "fixed: regions that cannot move, \"x_min\" … \"z_max\" (the mesh's outermost plane), Plane, Block, Ball,\n"
      "or (region, \"xz\") for some axes only. Raises InputError for a region without a face.");
  module.def("modes", modes, "model"_a, "count"_a = 10, "up_to_hz"_a = py::none(), "verify"_a = false, LongCallGuard(),
             "The lowest `count` elastic modes, or all up to a frequency.\n\n"
             "verify: check them by a Sturm count and by a second eigen-solver, and raise NumericalError if either\n"
             "disagrees. The model keeps its factor for what is computed next.");
}

}  // namespace thinwall::python
