#pragma once
// The reductions by name.

#include <string>
#include <vector>

namespace thinwall::reduction {

/// Ways to a small model (docs/theory/reductions.md).
enum class Method {
  guyan,                            ///< static condensation (Guyan 1965)
  craig_bampton,                    ///< fixed-interface modes (Craig & Bampton 1968)
  characteristic_constraint_modes,  ///< the same with a reduced interface (Castanier, Tan & Pierre 2001)
  rubin,                            ///< free-interface modes, residual flexibility and inertia (Rubin 1975)
  macneal,                          ///< free-interface modes and residual flexibility (MacNeal 1971)
  craig_chang,                      ///< free-interface and residual attachment modes (Craig & Chang 1977)
  dual_craig_bampton,               ///< free-interface modes and interface forces (Rixen 2004)
  modal_truncation,                 ///< free-interface modes as poles, with a residual
};

/// In the order above.
[[nodiscard]] const std::vector<Method>& all_methods();

/// "craig_bampton", as in the enumeration.
[[nodiscard]] std::string name(Method method);

/// The method of a name; throws InputError with the nearest one.
[[nodiscard]] Method method_named(const std::string& name);

/// Whether its modes are those of the part with the interface held, rather than of the part as it is.
[[nodiscard]] bool holds_the_interface(Method method);

/// How many elastic modes a model of `size` coordinates has with an interface of so many DOFs and so many rigid
/// motions; negative: it cannot be that small. `characteristic`: how many amplitudes a reduced interface has. Of dual
/// Craig-Bampton modes and forces are counted, not the interface's displacements, which have neither mass nor stiffness
/// and which an assembly of dual models eliminates.
[[nodiscard]] int modes_for_size(Method method, int size, int interface_dofs, int rigid_motions, int characteristic);

}  // namespace thinwall::reduction
