// Bindings of the three kinds of models and the conversions between them.

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "core/units.hpp"
#include "dynamics/conversion.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

using dynamics::ModalModel;
using dynamics::ResponseModel;
using dynamics::SpatialModel;

dynamics::DofTable table(const std::vector<std::string>& names) {
  dynamics::DofTable dofs;
  for (const auto& name : names) dofs.push_back(dof_from_name(name));
  return dofs;
}

SpatialModel spatial_model(const Eigen::MatrixXd& M, const Eigen::MatrixXd& K, const OneOrMore<std::string>& dofs,
                           const std::optional<Eigen::MatrixXd>& C) {
  SpatialModel model{M, C.value_or(Eigen::MatrixXd::Zero(M.rows(), M.cols())), K, {}, table(dofs.values)};
  dynamics::require_consistent(model);
  return model;
}

dynamics::FrequencyAxis axis_of(const OneOrMore<double>& frequencies) {
  const Eigen::VectorXd hz = Eigen::Map<const Eigen::VectorXd>(frequencies.values.data(),
                                                               static_cast<Eigen::Index>(frequencies.values.size()));
  for (Eigen::Index i = 0; i < hz.size(); ++i) {
    if (!std::isfinite(hz(i)) || hz(i) < 0.0 || (i > 0 && hz(i) <= hz(i - 1)))
      throw core::InputError("frequencies must rise strictly from 0 Hz or above; number " + std::to_string(i) +
                             " does not");
  }
  return {hz};
}

ModalModel modal(const SpatialModel& model) {
  return dynamics::to_modal(model.has_structural_damping() ? dynamics::equivalent_viscous(model) : model);
}

/// An array with one value for each oscillating mode, by rising frequency.
Eigen::VectorXd of_modes(const ModalModel& model, double dynamics::ModeSummary::*what) {
  const auto modes = dynamics::oscillating_modes(model);
  Eigen::VectorXd values(static_cast<Eigen::Index>(modes.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i)
    values(i) = dynamics::summarise(model.poles(modes[static_cast<std::size_t>(i)])).*what;
  return values;
}

using Cube = py::array_t<std::complex<double>, py::array::c_style | py::array::forcecast>;

/// The lines of a contiguous array (lines, rows, columns).
std::vector<Eigen::MatrixXcd> lines_of(const Cube& H, py::ssize_t lines, py::ssize_t rows, py::ssize_t columns) {
  using Line = Eigen::Matrix<std::complex<double>, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  std::vector<Eigen::MatrixXcd> list;
  for (py::ssize_t line = 0; line < lines; ++line)
    list.emplace_back(Eigen::Map<const Line>(H.data() + line * rows * columns, rows, columns));
  return list;
}

ResponseModel response(const OneOrMore<double>& frequencies, const Cube& H, const OneOrMore<std::string>& responses,
                       const std::optional<OneOrMore<std::string>>& forces) {
  ResponseModel model{axis_of(frequencies), table(responses.values), table((forces ? *forces : responses).values), {}};
  const auto lines = static_cast<py::ssize_t>(model.axis.hz.size());
  const auto rows = static_cast<py::ssize_t>(model.responses.size());
  const auto width = static_cast<py::ssize_t>(model.forces.size());
  const bool fits = H.ndim() == 3 ? H.shape(1) == rows && H.shape(2) == width : H.ndim() <= 1 && rows * width == 1;
  if (!fits || (H.ndim() == 0 ? 1 : H.shape(0)) != lines)
    throw core::InputError("H must be (lines, responses, forces), or (lines,) of a single entry");
  model.H = lines_of(H, lines, rows, width);
  dynamics::require_complete(model);
  return model;
}

py::array one_piece(const ResponseModel& model) {
  const auto rows = static_cast<py::ssize_t>(model.responses.size());
  const auto columns = static_cast<py::ssize_t>(model.forces.size());
  py::array_t<std::complex<double>> H({static_cast<py::ssize_t>(model.H.size()), rows, columns});
  auto* next = H.mutable_data();
  for (const auto& line : model.H) {
    for (Eigen::Index i = 0; i < rows; ++i)
      for (Eigen::Index j = 0; j < columns; ++j) *next++ = line(i, j);
  }
  H.attr("setflags")("write"_a = false);
  return H;
}

/// The array of all matrices of a response. The model holds one matrix for each line, so that the array is made when it
/// is first asked for, and kept in the Python object.
py::object values(const py::object& self) {
  const py::dict kept = self.attr("__dict__");
  if (!kept.contains("_H")) kept["_H"] = one_piece(self.cast<const ResponseModel&>());
  return kept["_H"];
}

std::string band(const dynamics::FrequencyAxis& axis) {
  if (axis.hz.size() == 0) return "no line";
  return std::to_string(axis.hz.size()) + " lines, " + core::number_text(axis.hz(0), 6) + " to " +
         core::number_text(axis.hz(axis.hz.size() - 1), 6) + " Hz";
}

py::tuple members_of_response(const ResponseModel& model) {
  return py::make_tuple(model.axis.hz, one_piece(model), state_of(model.responses), state_of(model.forces));
}

ResponseModel response_of(const py::tuple& members) {
  ResponseModel model{{members[0].cast<Eigen::VectorXd>()}, dofs_of(members[2]), dofs_of(members[3]), {}};
  model.H = lines_of(members[1].cast<Cube>(), model.axis.hz.size(), static_cast<py::ssize_t>(model.responses.size()),
                     static_cast<py::ssize_t>(model.forces.size()));
  return model;
}

SpatialModel spatial_of(const py::tuple& members) {
  const auto matrix = [&members](std::size_t i) { return members[i].cast<Eigen::MatrixXd>(); };
  return {matrix(0), matrix(1), matrix(2), matrix(3), dofs_of(members[4]), matrix(5)};
}

ModalModel modal_of(const py::tuple& members) {
  return {members[0].cast<Eigen::VectorXcd>(), members[1].cast<Eigen::MatrixXcd>(), members[2].cast<Eigen::MatrixXcd>(),
          members[3].cast<Eigen::VectorXcd>(), members[4].cast<Eigen::MatrixXd>(),  dofs_of(members[5])};
}

void bind_spatial(py::module_& module) {
  py::class_<SpatialModel>(module, "SpatialModel",
                           "A model M y'' + C y' + (K + iD) y = Tᵀ f, x = T y, with named DOFs.")
      .def(py::init(&spatial_model), "M"_a, "K"_a, "dofs"_a, "C"_a = py::none(),
           "dofs: the name of each row, such as \"P.x\", \"P.rz\", \"mode 1\". SI units.")
      .def_readonly("M", &SpatialModel::M, "The mass matrix; a view.")
      .def_readonly("C", &SpatialModel::C, "The viscous damping matrix; a view.")
      .def_readonly("K", &SpatialModel::K, "The stiffness matrix; a view.")
      .def_readonly("D", &SpatialModel::D, "The structural damping matrix, (0, 0) if there is none; a view.")
      .def_readonly("T", &SpatialModel::T,
                    "The matrix that gives DOFs from coordinates, (0, 0) if they are equal; a view.")
      .def_property_readonly(
          "dofs", [](const SpatialModel& model) { return names(model.dofs); }, "The names of the DOFs.")
      .def("__repr__",
           [](const SpatialModel& m) {
             return "<SpatialModel of " + std::to_string(m.size()) + " coordinates, " + listed("DOFs", names(m.dofs)) +
                    ">";
           })
      .def(py::pickle([](const SpatialModel& m) { return py::make_tuple(m.M, m.C, m.K, m.D, state_of(m.dofs), m.T); },
                      &spatial_of));
}

void bind_modal(py::module_& module) {
  py::class_<ModalModel>(module, "ModalModel", "A model H = R + Σ φ ψᵀ / (a (iω − λ)) with every pole listed.")
      .def_readonly("poles", &ModalModel::poles, "The poles λ, rad/s; a view.")
      .def_readonly("right", &ModalModel::right, "The response shapes φ, (dofs, poles); a view.")
      .def_readonly("left", &ModalModel::left, "The force shapes ψ, (dofs, poles); a view.")
      .def_readonly("scaling", &ModalModel::scaling, "The scaling a of each pole; a view.")
      .def_readonly("residual", &ModalModel::residual, "The residual R, m/N, (0, 0) if there is none; a view.")
      .def_property_readonly(
          "dofs", [](const ModalModel& model) { return names(model.dofs); }, "The names of the DOFs.")
      .def_property_readonly(
          "frequency_hz", [](const ModalModel& m) { return of_modes(m, &dynamics::ModeSummary::frequency_hz); },
          "The frequency |λ|/2π of each oscillating mode, ascending.")
      .def_property_readonly(
          "damping_ratio", [](const ModalModel& m) { return of_modes(m, &dynamics::ModeSummary::damping_ratio); },
          "The damping ratio −Re λ/|λ| of each oscillating mode, by ascending frequency.")
      .def("__repr__",
           [](const ModalModel& m) {
             return "<ModalModel of " + std::to_string(m.poles.size()) + " poles, " + listed("DOFs", names(m.dofs)) +
                    ">";
           })
      .def(py::pickle(
          [](const ModalModel& m) {
            return py::make_tuple(m.poles, m.right, m.left, m.scaling, m.residual, state_of(m.dofs));
          },
          &modal_of));
}

void bind_response(py::module_& module) {
  py::class_<ResponseModel>(module, "Response", py::dynamic_attr(), "Receptances on a frequency axis, m/N, e^{+iωt}.")
      .def(py::init(&response), "frequency_hz"_a, "H"_a, "responses"_a, "forces"_a = py::none(),
           "H: (lines, responses, forces), or (lines,) for a single entry; DOF names as for a SpatialModel.")
      .def_property_readonly(
          "frequency_hz", [](const ResponseModel& model) -> const Eigen::VectorXd& { return model.axis.hz; },
          py::return_value_policy::reference_internal, "The frequencies of the lines; a view.")
      .def_property_readonly("H", values,
                             "The receptances (lines, responses, forces), a read-only array that is copied from the\n"
                             "library at the first access and kept.")
      .def_property_readonly(
          "responses", [](const ResponseModel& model) { return names(model.responses); },
          "The names of the rows' DOFs.")
      .def_property_readonly(
          "forces", [](const ResponseModel& model) { return names(model.forces); }, "The names of the columns' DOFs.")
      .def("entry", dynamics::entry, "response"_a, "force"_a,
           "The entry of two DOFs, given by their names, over frequency.")
      .def("__repr__",
           [](const ResponseModel& m) {
             return "<Response at " + band(m.axis) + "; " + listed("responses", names(m.responses)) + "; " +
                    listed("forces", names(m.forces)) + ">";
           })
      .def(py::pickle(&members_of_response, &response_of));
}

}  // namespace

std::string listed(const std::string& of, const std::vector<std::string>& names) {
  std::string text = std::to_string(names.size()) + " " + of;
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 6); ++i) text += (i == 0 ? ": " : ", ") + names[i];
  return names.size() > 6 ? text + ", …" : text;
}

py::list state_of(const dynamics::DofTable& dofs) {
  py::list list;
  for (const auto& dof : dofs) list.append(py::make_tuple(dof.point, dof.direction, static_cast<int>(dof.kind)));
  return list;
}

dynamics::DofTable dofs_of(const py::list& state) {
  dynamics::DofTable dofs;
  for (const auto& each : state) {
    const auto dof = each.cast<py::tuple>();
    dofs.push_back({dof[0].cast<std::string>(), dof[1].cast<Eigen::Vector3d>(),
                    static_cast<dynamics::DofKind>(dof[2].cast<int>())});
  }
  return dofs;
}

dynamics::Dof dof_from_name(const std::string& text) {
  if (text.rfind("mode ", 0) == 0) return {text, Eigen::Vector3d::Zero(), dynamics::DofKind::modal};
  const auto open = text.find(".(") != std::string::npos ? text.find(".(") : text.find(".r(");
  const auto dot = open != std::string::npos ? open : text.rfind('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == text.size())
    throw core::InputError("a DOF is named as \"P.x\", \"P.rz\", \"P.(0.6,0.8,0)\" or \"mode 1\", not \"" + text +
                           "\"");
  std::string direction = text.substr(dot + 1);
  const bool turn = direction.front() == 'r';
  if (turn) direction.erase(0, 1);
  const auto kind = turn ? dynamics::DofKind::rotation : dynamics::DofKind::translation;
  if (direction.empty() || direction.front() != '(') return {text.substr(0, dot), dynamics::axis(direction), kind};
  Eigen::Vector3d d;
  char skipped = 0;
  std::istringstream(direction) >> skipped >> d.x() >> skipped >> d.y() >> skipped >> d.z() >> skipped;
  if (skipped != ')' || std::abs(d.norm() - 1.0) > 1e-4)
    throw core::InputError("\"" + text + "\" names no unit vector");
  return {text.substr(0, dot), d.normalized(), kind};
}

std::vector<std::string> names(const dynamics::DofTable& dofs) {
  std::vector<std::string> result;
  result.reserve(dofs.size());
  for (const auto& dof : dofs) result.push_back(dynamics::name(dof));
  return result;
}

std::vector<Eigen::Vector3d> directions(const py::object& words) {
  std::vector<Eigen::Vector3d> result;
  if (py::isinstance<py::str>(words)) {
    for (const char letter : words.cast<std::string>()) result.push_back(dynamics::axis(std::string(1, letter)));
    return result;
  }
  const auto rows = py::array_t<double, py::array::c_style | py::array::forcecast>(words);
  if (rows.ndim() < 1 || rows.ndim() > 2 || rows.shape(rows.ndim() - 1) != 3)
    throw core::InputError("directions are letters as \"xz\", a vector of three, or a list of such");
  for (py::ssize_t i = 0; i < rows.size(); i += 3)
    result.emplace_back(Eigen::Map<const Eigen::Vector3d>(rows.data() + i));
  return result;
}

py::object sparse_view(const linalg::SparseMatrix& matrix, const py::object& owner) {
  const auto entries = static_cast<py::ssize_t>(matrix.nonZeros());
  const py::tuple arrays =
      py::make_tuple(view(matrix.valuePtr(), {entries}, owner), view(matrix.innerIndexPtr(), {entries}, owner),
                     view(matrix.outerIndexPtr(), {matrix.outerSize() + 1}, owner));
  return py::module_::import("scipy.sparse")
      .attr("csc_matrix")(arrays, "shape"_a = py::make_tuple(matrix.rows(), matrix.cols()), "copy"_a = false);
}

void bind_dynamics(py::module_& module) {
  bind_spatial(module);
  bind_modal(module);
  bind_response(module);
  module.def("to_modal", modal, "model"_a, LongCallGuard(),
             "The ModalModel with all poles. Structural damping becomes viscous with equal loss at each mode.");
  module.def(
      "receptances",
      [](const SpatialModel& model, const OneOrMore<double>& hz) {
        return dynamics::direct_response(model, axis_of(hz));
      },
      "model"_a, "frequency_hz"_a, LongCallGuard(),
      "The receptances of a SpatialModel, by one factorisation for each line.");
  module.def(
      "receptances",
      [](const ModalModel& model, const OneOrMore<double>& hz) { return dynamics::to_response(model, axis_of(hz)); },
      "model"_a, "frequency_hz"_a, LongCallGuard(), "The receptances of a ModalModel, as the sum over its poles.");
}

}  // namespace thinwall::python
