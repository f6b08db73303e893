// Bindings of reduction: from a full model to a small one that keeps its points.

#include "core/error.hpp"
#include "core/units.hpp"
#include "fem/modes.hpp"
#include "fem/points.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "python/bindings.hpp"
#include "reduction/damping.hpp"
#include "reduction/identification.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "reduction/methods/reduce.hpp"

namespace thinwall::python {

namespace {

using dynamics::SpatialModel;

/// A point as given by Python; its patch is looked up when there is a mesh.
struct Point {
  fem::NamedPoint point;
  py::object region;
};

Point point(const std::string& name, const Eigen::Vector3d& position, const py::object& along, double radius,
            const py::object& about, const py::object& region) {
  return {{.name = name,
           .position_m = position,
           .patch_radius_m = radius,
           .directions = directions(along),
           .turns = directions(about)},
          region};
}

reduction::Interface interface_of(const fem::Model& model, const std::vector<Point>& points) {
  reduction::Interface interface;
  std::vector<Eigen::Triplet<double>> entries;
  for (const Point& given : points) {
    fem::NamedPoint point = given.point;
    if (!given.region.is_none()) point.faces = region_on(model.mesh, given.region);
    const linalg::SparseMatrix columns = fem::point_columns(model, point);
    const auto first = static_cast<int>(interface.dofs.size());
    for (int j = 0; j < columns.cols(); ++j)
      for (linalg::SparseMatrix::InnerIterator it(columns, j); it; ++it)
        entries.emplace_back(static_cast<int>(it.row()), first + j, it.value());
    for (const auto& d : point.directions) interface.dofs.push_back({point.name, d});
    for (const auto& d : point.turns) interface.dofs.push_back({point.name, d, dynamics::DofKind::rotation});
  }
  interface.W.resize(model.K.rows(), static_cast<Eigen::Index>(interface.dofs.size()));
  interface.W.setFromTriplets(entries.begin(), entries.end());
  return interface;
}

void require_converged(linalg::EigenStatus status) {
  if (status == linalg::EigenStatus::converged) return;
  throw core::NumericalError("the modes of the reduction did not converge: ask for fewer");
}

reduction::CraigBampton reduced(Part& part, const reduction::Interface& interface,
                                const reduction::CraigBamptonOptions& options) {
  const LongCall guard;
  const fem::Model& model = part.model;
  if (part.factored().sigma == 0.0)
    return reduction::craig_bampton(model.K, model.M, fem::inverse_of(part.factored()), interface, options);
  const linalg::SparseCholesky held(reduction::restrained(model.K, interface), model.node_of_row);
  const linalg::ShiftedInverse inverse{[&held](const Eigen::Ref<const Eigen::MatrixXd>& B) { return held.solve(B); },
                                       0.0};
  return reduction::craig_bampton(model.K, model.M, inverse, interface, options);
}

reduction::CraigBampton craig_bampton(Part& part, const OneOrMore<Point>& points, int modes,
                                      std::optional<double> up_to_hz) {
  auto result = reduced(part, interface_of(part.model, points.values), {modes, up_to_hz});
  require_converged(result.status);
  return result;
}

reduction::ReducedModel reduce(Part& part, const OneOrMore<Point>& points, const std::string& method, int modes,
                               double damping_ratio) {
  const auto interface = interface_of(part.model, points.values);
  const LongCall guard;
  const fem::Model& model = part.model;
  reduction::FullModel full{model.K, model.M, model.node_of_row, {}};
  if (model.rigid_motions > 0)
    full.rigid = fem::modes(model, part.factored(), {.count = 1}).pairs.Phi.leftCols(model.rigid_motions);
  auto result = reduction::reduce(reduction::method_named(method), full, interface,
                                  {.modes = modes, .damping_ratio = damping_ratio});
  require_converged(result.status);
  return std::move(result.model);
}

py::list identified(const Eigen::VectorXd& hz, const Eigen::VectorXcd& H) {
  py::list modes;
  for (const auto& mode : reduction::identify_modes({hz}, H))
    modes.append(py::make_tuple(mode.frequency_hz, mode.damping_ratio));
  return modes;
}

void bind_damping(py::module_& module) {
  module.def(
      "with_modal_damping",
      [](const SpatialModel& model, double ratio, const OneOrMore<double>& ratios) {
        return reduction::with_modal_damping(model, ratios.values, ratio);
      },
      "model"_a, "ratio"_a, "ratios"_a = OneOrMore<double>{}, LongCallGuard(),
      "The model with a damping ratio for every elastic mode; `ratios` are those of the first ones.");
  module.def("with_rayleigh_damping", reduction::with_rayleigh_damping, "model"_a, "alpha_per_s"_a, "beta_s"_a,
             "The model with C = α M + β K.");
  module.def("with_structural_damping", reduction::with_structural_damping, "model"_a, "loss_factor"_a,
             "The model with stiffness K (1 + iη).");
  module.def("identify_modes", identified, "frequency_hz"_a, "H"_a,
             "The frequency (Hz) and damping ratio of each peak of a measured driving-point receptance.");
}

}  // namespace

void bind_reduction(py::module_& module) {
  py::class_<Point>(module, "Point", "A named point of a part, at which forces act and motion is wanted.")
      .def(py::init(&point), "name"_a, "position"_a, "directions"_a = "xyz", "radius"_a = 0.0, "turns"_a = "",
           "region"_a = py::none(),
           "position: m, on the part. directions, turns: letters or unit vectors, along and about which motion is "
           "wanted.\n"
           "radius: that of the disc over which the motion is averaged, m; region: a face used instead of the disc.")
      .def_property_readonly(
          "name", [](const Point& point) { return point.point.name; },
          "The name of the point in the DOFs of the reduced model.")
      .def_property_readonly(
          "position", [](const Point& point) { return point.point.position_m; }, "The position, m.")
      .def("__repr__",
           [](const Point& p) {
             const Eigen::Vector3d& at = p.point.position_m;
             return "<Point " + p.point.name + " at (" + core::number_text(at.x()) + ", " + core::number_text(at.y()) +
                    ", " + core::number_text(at.z()) + ") m, " +
                    std::to_string(p.point.directions.size() + p.point.turns.size()) + " DOFs>";
           })
      .def(py::pickle(
          [](const Point& p) {
            return py::make_tuple(p.point.name, p.point.position_m, p.point.directions, p.point.patch_radius_m,
                                  p.point.turns, p.region);
          },
          [](const py::tuple& t) {
            return Point{{.name = t[0].cast<std::string>(),
                          .position_m = t[1].cast<Eigen::Vector3d>(),
                          .patch_radius_m = t[3].cast<double>(),
                          .directions = t[2].cast<std::vector<Eigen::Vector3d>>(),
                          .turns = t[4].cast<std::vector<Eigen::Vector3d>>()},
                         t[5]};
          }));
  py::class_<reduction::CraigBampton>(module, "CraigBampton",
                                      "A reduced model and its expansion u = T q to the full one.")
      .def_readonly("model", &reduction::CraigBampton::model, "The undamped SpatialModel, with the points' DOFs first.")
      .def_readonly("T", &reduction::CraigBampton::T,
                    "The constraint and fixed-interface modes, (free rows, coordinates); a view.")
      .def_readonly("fixed_interface_hz", &reduction::CraigBampton::fixed_interface_hz,
                    "The frequencies of the kept modes, with the points held; a view.")
      .def("__repr__", [](const reduction::CraigBampton& r) {
        return "<CraigBampton of " + std::to_string(r.T.rows()) + " free rows to " + std::to_string(r.T.cols()) +
               " coordinates, " + listed("DOFs", names(r.model.dofs)) + ">";
      });
  module.def("craig_bampton", craig_bampton, "model"_a, "points"_a, "modes"_a = 30, "up_to_hz"_a = py::none(),
             "Reduces a part to its points and some modes with them held (Craig & Bampton 1968).\n\n"
             "modes: their number; up_to_hz: all modes below a frequency instead.");
  module.def("reduce", reduce, "model"_a, "points"_a, "method"_a = "craig_bampton", "modes"_a = 30,
             "damping_ratio"_a = 0.0,
             "Reduces a part by any method: guyan, craig_bampton, characteristic_constraint_modes, rubin, macneal,\n"
             "craig_chang, dual_craig_bampton (SpatialModel), modal_truncation (ModalModel, with `damping_ratio`).");
  bind_damping(module);
}

}  // namespace thinwall::python
