// The extension module thinwall._core; the package's __init__.py selects its public names.

#include "python/bindings.hpp"

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
  bind_milling(module);
  bind_io(module);
  bind_study(module);
}
