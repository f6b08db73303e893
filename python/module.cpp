// The extension module thinwall._core; the package's __init__.py selects its public names.

#include "python/bindings.hpp"

namespace thinwall::python {

namespace {

/// Gives every class its copies: as none of its members can be changed, an object is its own copy.
void hold_copies(const py::module_& module) {
  const auto itself = [](const py::object& self) { return self; };
  const auto also_deep = [](const py::object& self, const py::dict& /*known*/) { return self; };
  for (const auto& [name, member] : py::dict(module.attr("__dict__"))) {
    if (!PyType_Check(member.ptr()) || PyExceptionClass_Check(member.ptr())) continue;
    member.attr("__copy__") = py::cpp_function(itself, py::name("__copy__"), py::is_method(member));
    member.attr("__deepcopy__") = py::cpp_function(also_deep, py::name("__deepcopy__"), py::is_method(member));
  }
}

}  // namespace

}  // namespace thinwall::python

PYBIND11_MODULE(_core, module) {
  using namespace thinwall::python;
  module.doc() = "Bindings of thinwall's library; import thinwall instead.";
  bind_core(module);
  bind_mesh(module);
  bind_fem(module);
  bind_dynamics(module);
  bind_reduction(module);
  bind_robot(module);
  bind_coupling(module);
  bind_identification(module);
  bind_milling(module);
  bind_learning(module);
  bind_simulation(module);
  bind_io(module);
  bind_study(module);
  hold_copies(module);
}
