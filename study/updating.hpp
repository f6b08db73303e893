#pragma once
// Model updating: a few parameters of the case fitted so that the model shows what was measured.

#include <optional>

#include "case/case.hpp"
#include "mesh/tet_mesh.hpp"
#include "study/part/discretisation.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// A fit of the part, and the solution of the part as fitted, if the fit ended with it.
struct [[nodiscard]] PartUpdating {
  UpdatingResult result;
  std::optional<Solution> solved;
};

/// Fits one [[updating]] entry with on = "part" and writes the parameters into the case. The mesh is stretched with the
/// part. Residuals are relative, (value − wanted)/wanted times weight. Throws InputError if a target names a mode that
/// is not there, NumericalError if nothing can be evaluated. Cost: a modal solution an evaluation, two or three
/// whatever the number of parameters, for their derivatives need none (PartEvaluation::slopes).
PartUpdating update_part(cases::Case& source, const setup::Updating& updating, const mesh::TetMesh& mesh, int order);

/// The same with on = "coupled", on the reduced part: milliseconds an evaluation. A reduction is compared by the
/// logarithm of what remains, log((1 − value)/(1 − wanted)).
[[nodiscard]] UpdatingResult update_coupled(cases::Case& source, const setup::Updating& updating,
                                            const dynamics::SpatialModel& reduced);

}  // namespace thinwall::study
