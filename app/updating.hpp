#pragma once
// Model updating: a few parameters of the case fitted so that the model shows what was measured.

#include "app/case.hpp"
#include "app/results.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::app {

/// Fits one [[updating]] entry with on = "part" and writes the parameters into the case. The mesh is stretched with the
/// part. Residuals are relative, (value − wanted)/wanted times weight. Throws InputError if a target names a mode that
/// is not there, NumericalError if nothing can be evaluated. Cost: a modal solution an evaluation, about 5 for one
/// parameter.
[[nodiscard]] UpdatingResult update_part(Case& source, const Updating& updating, const mesh::TetMesh& mesh, int order);

/// The same with on = "coupled", on the reduced part: microseconds an evaluation. A reduction is compared by the
/// logarithm of what remains, log((1 − value)/(1 − wanted)).
[[nodiscard]] UpdatingResult update_coupled(Case& source, const Updating& updating,
                                            const dynamics::SpatialModel& reduced);

}  // namespace thinwall::app
