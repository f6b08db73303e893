#pragma once
// Model updating: a few parameters of the case fitted so that the model shows what was measured.

#include <optional>

#include "mesh/tet_mesh.hpp"
#include "setup/variation.hpp"
#include "study/part/discretisation.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// A fit of the part, and the solution of the part as fitted, if the fit ended with it.
struct [[nodiscard]] PartUpdating {
  UpdatingResult result;
  std::optional<Solution> solved;
};

/// Fits the parameters of one entry whose targets are frequencies of the part alone, and puts them into `source`. The
/// mesh is stretched with the part. Residuals are relative, (value − wanted)/wanted times weight. Throws InputError if
/// a target names a mode that is not there, NumericalError if nothing can be evaluated. Cost: a modal solution an
/// evaluation, two or three whatever the number of parameters, for their derivatives need none
/// (PartEvaluation::slopes).
PartUpdating update_part(const setup::Variation& variation, setup::VariedSetup& source, const setup::Updating& updating,
                         const mesh::TetMesh& mesh, int order);

/// Fits the parameters of one entry whose targets belong to the part with its robot, on the reduced part: milliseconds
/// an evaluation. A reduction is compared by the logarithm of what remains, log((1 − value)/(1 − wanted)).
[[nodiscard]] UpdatingResult update_coupled(const setup::Variation& variation, setup::VariedSetup& source,
                                            const setup::Updating& updating, const dynamics::SpatialModel& reduced);

}  // namespace thinwall::study
