#pragma once
// Declarations that the files of the Python module share: one function for each folder of the library, guards of long
// calls, views of arrays.

#include <pybind11/complex.h>
#include <pybind11/eigen.h>
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>
#include <signal.h>

#include <Eigen/Core>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "dynamics/dof.hpp"
#include "fem/model.hpp"
#include "linalg/sparse.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/selection.hpp"
#include "mesh/tet_mesh.hpp"
#include "milling/simulation/simulation.hpp"

namespace thinwall::python {

namespace py = pybind11;
using namespace pybind11::literals;

void bind_core(py::module_& module);
void bind_mesh(py::module_& module);
void bind_fem(py::module_& module);
void bind_dynamics(py::module_& module);
void bind_reduction(py::module_& module);
void bind_robot(py::module_& module);
void bind_coupling(py::module_& module);
void bind_identification(py::module_& module);
void bind_learning(py::module_& module);
void bind_milling(py::module_& module);
void bind_simulation(py::module_& module);
void bind_io(py::module_& module);
void bind_study(py::module_& module);

/// A mesh as a Python object: tetrahedra, and the nodes of a file if it has more nodes than the corners.
struct Mesh {
  mesh::TetMesh tets;
  std::optional<mesh::LagrangeNodes> nodes{};  ///< nodes of order 2
};

/// A model with its factor, which is made when it is first needed and shared by all results computed from it.
class Part {
 public:
  explicit Part(fem::Model assembled) : model(std::move(assembled)) {}
  const fem::Factored& factored();

  fem::Model model;

 private:
  std::once_flag once_;  // long calls of several Python threads may arrive here together
  std::unique_ptr<fem::Factored> factored_;
};

/// A guard of a long call, during which other Python threads continue and Ctrl-C ends the call. Python's own handler
/// only notes the signal for the interpreter, which is not running; this one asks the library to stop, and the library
/// throws core::Interrupted at its next check. A request that comes too late becomes a KeyboardInterrupt after the
/// call.
class LongCall {
 public:
  LongCall();
  ~LongCall();
  LongCall(const LongCall&) = delete;
  LongCall& operator=(const LongCall&) = delete;

 private:
  py::gil_scoped_release released_;
  bool installed_ = false;
  struct sigaction before_ {};
};

using LongCallGuard = py::call_guard<LongCall>;

/// A read-only array on memory that `owner` keeps alive, of the given shape, row by row.
template <typename Scalar>
py::array view(const Scalar* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<Scalar> array(std::move(shape), data, owner);
  array.attr("setflags")("write"_a = false);
  return array;
}

/// A scipy.sparse.csc_matrix on the matrix's own memory, which `owner` keeps alive.
py::object sparse_view(const linalg::SparseMatrix& matrix, const py::object& owner);

/// The DOF with a name such as "P.x", "P.rz", "P.(0.6,0.8,0)", or "mode 3" for an amplitude. Throws InputError for
/// anything else.
dynamics::Dof dof_from_name(const std::string& text);
std::vector<std::string> names(const dynamics::DofTable& dofs);

/// A list of values; Python may give one of them in its place.
template <typename Value>
struct OneOrMore {
  std::vector<Value> values;
};

/// A simulated cut as a dict of figures, with its passes, trace and walls.
py::dict dict_of(const milling::SimulatedCut& cut);

/// "6 DOFs: P.x, P.y, P.z, …", for what represents an object to a reader.
std::string listed(const std::string& of, const std::vector<std::string>& names);

/// The DOFs as Python keeps them when it pickles: (point, direction, kind) each.
py::list state_of(const dynamics::DofTable& dofs);
dynamics::DofTable dofs_of(const py::list& state);

/// The unit vectors given by letters ("x", "xyz") or by one or several vectors. Throws InputError for anything else.
std::vector<Eigen::Vector3d> directions(const py::object& words);

/// The region given by a mesh::Region, or by "x_min" … "z_max", the plane of a mesh's outermost vertices.
mesh::Region region_on(const mesh::TetMesh& mesh, const py::object& region);

}  // namespace thinwall::python

namespace pybind11::detail {

/// Takes a list, or one value of it, as a list.
template <typename Value>
struct type_caster<thinwall::python::OneOrMore<Value>> {
  using List = make_caster<std::vector<Value>>;
  PYBIND11_TYPE_CASTER(thinwall::python::OneOrMore<Value>, const_name("Union[") + make_caster<Value>::name +
                                                               const_name(", ") + List::name + const_name("]"));

  bool load(handle source, bool convert) {
    List list;
    const bool is_one = isinstance<array>(source) && reinterpret_borrow<array>(source).ndim() == 0;
    if (!is_one && list.load(source, convert)) {
      value.values = cast_op<std::vector<Value>>(std::move(list));
      return true;
    }
    make_caster<Value> one;
    if (!one.load(source, convert)) return false;
    value.values = {cast_op<Value>(one)};
    return true;
  }

  static handle cast(const thinwall::python::OneOrMore<Value>& from, return_value_policy policy, handle parent) {
    return List::cast(from.values, policy, parent);
  }
};

}  // namespace pybind11::detail
