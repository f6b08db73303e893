#include "app/inspect_command.hpp"

#include "app/model_files.hpp"
#include "app/model_report_json.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::app {

namespace {

PlacedModel model_of(const InspectRequest& request, std::string& notes) {
  if (!request.model.empty()) return read_model(request.model);
  if (request.files.stiffness.empty())
    throw core::InputError("nothing to inspect: name a model, or matrices with --stiffness and --mass");
  const io::ImportedMatrices imported = io::read_matrices(request.files);
  notes = "read as " + imported.format + "\n";
  for (const auto& note : imported.notes) notes += note + "\n";
  return placed(imported.model);
}

}  // namespace

Inspection inspect(const InspectRequest& request) {
  std::string notes;
  const PlacedModel model = model_of(request, notes);
  const reduction::ReducedModelReport report =
      reduction::report(model.model, {.positions = model.positions, .rigid_motions = request.rigid_motions});
  if (request.json) core::write_file_atomically(*request.json, report_json(report).dump(2) + "\n");
  return {notes + reduction::text(report), report.trustworthy()};
}

}  // namespace thinwall::app
