#pragma once
// Names of the reduction methods.

#include <string>
#include <vector>

namespace thinwall::reduction {

/// The reduction methods (docs/theory/reductions.md).
enum class Method {
  guyan,                            ///< static condensation (Guyan 1965)
  craig_bampton,                    ///< fixed-interface modes (Craig & Bampton 1968)
  characteristic_constraint_modes,  ///< craig_bampton with a reduced interface (Castanier, Tan & Pierre 2001)
  rubin,                            ///< free-interface modes, residual flexibility and inertia (Rubin 1975)
  macneal,                          ///< free-interface modes and residual flexibility (MacNeal 1971)
  craig_chang,                      ///< free-interface and residual attachment modes (Craig & Chang 1977)
  dual_craig_bampton,               ///< free-interface modes and interface forces (Rixen 2004)
  modal_truncation,                 ///< free-interface modes as poles, with a residual
};

/// All methods, in the order of the enumeration.
[[nodiscard]] const std::vector<Method>& all_methods();

/// The name of a method as in the enumeration: "craig_bampton".
[[nodiscard]] std::string name(Method method);

/// The method with a name. Throws InputError with the nearest name if there is none.
[[nodiscard]] Method method_named(const std::string& name);

/// True if the modes of the method are those of the part with its interface held, rather than free.
[[nodiscard]] bool holds_the_interface(Method method);

/// The number of elastic modes of a model with `size` coordinates, for an interface with so many DOFs and a part with
/// so many rigid motions; negative if the model cannot be that small. `characteristic`: the number of amplitudes of a
/// reduced interface. For dual Craig-Bampton, modes and forces are counted, but not the interface's displacements,
/// which have neither mass nor stiffness and which an assembly of dual models eliminates.
[[nodiscard]] int modes_for_size(Method method, int size, int interface_dofs, int rigid_motions, int characteristic);

}  // namespace thinwall::reduction
