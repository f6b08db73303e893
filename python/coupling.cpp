// Bindings of coupling: components joined at points, by matrices or by receptances.

#include "core/error.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"
#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

using coupling::Contact;
using coupling::CoupledResponse;

Contact contact(const std::string& a, const std::string& b, const py::object& along, double stiffness, double damping,
                double loss_factor, const py::object& about) {
  Contact result{a, b, {}};
  for (const auto& d : directions(along)) result.springs.push_back({d, stiffness, damping, loss_factor});
  for (const auto& d : directions(about))
    result.springs.push_back({d, stiffness, damping, loss_factor, dynamics::DofKind::rotation});
  return result;
}

std::string status(const CoupledResponse& coupled) {
  switch (coupled.status) {
    case coupling::KernelStatus::well_conditioned:
      return "well_conditioned";
    case coupling::KernelStatus::ill_conditioned:
      return "ill_conditioned";
    case coupling::KernelStatus::regularised:
      break;
  }
  return "regularised";
}

py::tuple members_of_contact(const Contact& contact) {
  py::list springs;
  for (const auto& s : contact.springs)
    springs.append(py::make_tuple(s.direction, s.stiffness, s.damping, s.loss_factor, static_cast<int>(s.kind)));
  return py::make_tuple(contact.point_a, contact.point_b, springs);
}

Contact contact_of(const py::tuple& members) {
  Contact result{members[0].cast<std::string>(), members[1].cast<std::string>(), {}};
  for (const auto& each : members[2].cast<py::list>()) {
    const auto s = each.cast<py::tuple>();
    result.springs.push_back({s[0].cast<Eigen::Vector3d>(), s[1].cast<double>(), s[2].cast<double>(),
                              s[3].cast<double>(), static_cast<dynamics::DofKind>(s[4].cast<int>())});
  }
  return result;
}

}  // namespace

void bind_coupling(py::module_& module) {
  py::class_<Contact>(module, "Contact", "A contact, which joins a point of one component to a point of another.")
      .def(py::init(&contact), "point_a"_a, "point_b"_a, "directions"_a = "xyz",
           "stiffness"_a = std::numeric_limits<double>::infinity(), "damping"_a = 0.0, "loss_factor"_a = 0.0,
           "turns"_a = "",
           "directions, turns: letters or unit vectors, along which and about which a spring joins both points (N/m,\n"
           "N s/m; N m/rad about them); with infinite stiffness they move as one.")
      .def_readonly("point_a", &Contact::point_a, "The name of the point of the first component.")
      .def_readonly("point_b", &Contact::point_b, "The name of the point of the second component.")
      .def("__repr__",
           [](const Contact& c) {
             return "<Contact of " + c.point_a + " with " + c.point_b + " along " + std::to_string(c.springs.size()) +
                    " directions>";
           })
      .def(py::pickle(&members_of_contact, &contact_of));
  py::class_<CoupledResponse>(module, "CoupledResponse", "A coupled response with the condition of its solution.")
      .def_readonly("response", &CoupledResponse::response, "The Response between all DOFs of the components.")
      .def_readonly("kernel_condition", &CoupledResponse::kernel_condition,
                    "The Skeel condition of the kernel at each line; a view.")
      .def_property_readonly("status", status,
                             "\"well_conditioned\", or \"ill_conditioned\" if half of the digits are lost.")
      .def("__repr__",
           [](const CoupledResponse& c) {
             return "<CoupledResponse, " + status(c) + ", " + std::to_string(c.response.axis.hz.size()) + " lines, " +
                    listed("DOFs", names(c.response.responses)) + ">";
           })
      .def(py::pickle(
          [](const CoupledResponse& c) {
            return py::make_tuple(c.response, c.kernel_condition, static_cast<int>(c.status), c.dropped,
                                  c.compatibility_residual, c.error);
          },
          [](const py::tuple& t) {
            return CoupledResponse{t[0].cast<dynamics::ResponseModel>(),
                                   t[1].cast<Eigen::VectorXd>(),
                                   static_cast<coupling::KernelStatus>(t[2].cast<int>()),
                                   t[3].cast<Eigen::VectorXi>(),
                                   t[4].cast<Eigen::VectorXd>(),
                                   t[5].cast<std::vector<Eigen::MatrixXd>>()};
          }));
  module.def(
      "couple",
      [](const std::vector<dynamics::SpatialModel>& components, const OneOrMore<Contact>& contacts) {
        return coupling::couple(components, contacts.values);
      },
      "components"_a, "contacts"_a, LongCallGuard(),
      "The SpatialModel of several, whose matrices are assembled at the contacts.");
  module.def(
      "couple",
      [](const std::vector<dynamics::ResponseModel>& components, const OneOrMore<Contact>& contacts) {
        return coupling::couple(components, contacts.values);
      },
      "components"_a, "contacts"_a, LongCallGuard(),
      "The CoupledResponse of several Responses on equal axes, by receptance coupling.");
  module.def(
      "route_difference",
      [](const dynamics::ResponseModel& spatial, const dynamics::ResponseModel& receptance) {
        return coupling::route_difference(spatial, receptance).max_relative;
      },
      "spatial"_a, "receptance"_a,
      "The largest difference of two Responses, relative to the largest entry of the line.");
}

}  // namespace thinwall::python
