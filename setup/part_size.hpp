#pragma once
// The size that is expected of a part's mesh, and the time and memory of the part, before anything is solved.

namespace thinwall::setup {

/// The size of a mesh, and the time of mesh, modes and reduction on two cores, and their memory.
struct PartSize {
  int order = 2;  ///< with a tolerance, the one that it usually takes
  double elements = 0.0;
  double dofs = 0.0;  ///< before supports
  double seconds = 0.0;
  bool at_least = false;      ///< no tolerance is met, so that it takes as long or longer (unreachable_tolerances())
  double memory_bytes = 0.0;  ///< held at most while the part is solved; 0: not known
};

}  // namespace thinwall::setup
