#pragma once
// The structure that a cut feels, from the models that Python hands over.

#include <optional>
#include <string>

#include "dynamics/modal_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::python {

/// The point of the cut: the one that is named, or the only one whose translations the model has. Throws InputError if
/// there are several.
std::string point_of(const dynamics::DofTable& dofs, const std::optional<std::string>& at);

/// The poles that the cut feels at a point. Throws InputError as point_of() and relative_structure() do.
milling::RelativeStructure poles(const dynamics::ModalModel& model, const std::optional<std::string>& at);
/// The poles of matrices, whose structural damping is taken as its viscous equivalent.
milling::RelativeStructure poles(const dynamics::SpatialModel& model, const std::optional<std::string>& at);

}  // namespace thinwall::python
