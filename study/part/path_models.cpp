#include "study/part/path_models.hpp"

#include <string>

#include "core/error.hpp"
#include "core/progress.hpp"
#include "reduction/methods/attachment_modes.hpp"
#include "study/part/part_model.hpp"

namespace thinwall::study {

std::vector<dynamics::SpatialModel> models_along_path(const PartInput& source, const PartResult& part,
                                                      const linalg::ShiftedInverse& inverse) {
  const reduction::PartModes modes = reduction::part_modes(*part.reduced, part.model.M, inverse);
  const std::size_t count = source.path.size();
  std::vector<dynamics::SpatialModel> models;
  core::Progress progress("positions", count);
  models.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    try {
      const reduction::Interface interface = part_interface(setup::part_at(source, source.path[i]), part.model);
      models.push_back(reduction::with_attachment_modes(modes, part.model.M, inverse, interface));
      progress.step();
    } catch (const core::InputError& error) {
      throw core::InputError("position " + std::to_string(i + 1) + " of the path: " + error.what());
    }
  }
  return models;
}

}  // namespace thinwall::study
