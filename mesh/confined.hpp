#pragma once
// Meshers of other libraries, each run in a process of its own under limits of time and memory.

#include <functional>
#include <vector>

#include "mesh/tet_mesh.hpp"

namespace thinwall::mesh {

/// The time that a mesher may last, over the processor time that it may use: on a busy machine it waits for others, and
/// its outcome does not depend on them.
inline constexpr double longest_wait = 3.0;

/// Resources that a mesher's process may use.
struct ProcessLimits {
  double time_s = 120.0;      ///< the process is killed after this processor time, or after longest_wait times as long
  double memory_bytes = 4e9;  ///< address space that it may take beyond what it starts with
};

/// The bytes that `work` returned, after it has run in a forked process under the limits. A process is used because
/// meshers abort, throw, crash or hang on some input. It may not take more memory than is left for this process
/// (core::memory_left_bytes()). Throws NumericalError if the process is killed, crashes, throws
/// or exceeds a limit; Interrupted if the user stops the run, and as core::check_interrupt().
[[nodiscard]] std::vector<char> run_confined(const std::function<std::vector<char>()>& work, double time_limit_s,
                                             double memory_limit_bytes);

/// The mesh that `work` makes, in a process as run_confined() describes. Tetrahedra are turned to positive volume and
/// order_along_curve() is applied. Throws NumericalError, whose message begins with the mesher's `name`, as
/// run_confined() and for a mesh without tetrahedra.
[[nodiscard]] TetMesh mesh_confined(const char* name, const std::function<TetMesh()>& work,
                                    const ProcessLimits& limits);

}  // namespace thinwall::mesh
