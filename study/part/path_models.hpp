#pragma once
// Reduced models of a part along the path of its cut.

#include <vector>

#include "dynamics/spatial_model.hpp"
#include "linalg/eigenpairs.hpp"
#include "study/part/part_input.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// Undamped models of the part at each position of the case's path, between the cut and the contacts there. Mesh,
/// factor (`inverse`, at zero shift) and modes are those of the part as it was reduced; a position costs a solve of
/// three right-hand sides, and as many a contact (reduction/methods/attachment_modes.hpp). Throws InputError for a
/// position off the part's surface, with its number.
[[nodiscard]] std::vector<dynamics::SpatialModel> models_along_path(const PartInput& source, const PartResult& part,
                                                                    const linalg::ShiftedInverse& inverse);

}  // namespace thinwall::study
