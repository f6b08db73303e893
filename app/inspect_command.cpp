#include "app/inspect_command.hpp"

#include <algorithm>

#include "app/inspect_universal.hpp"
#include "core/error.hpp"
#include "io/json_file.hpp"
#include "io/matrices/matrix_format.hpp"
#include "reduction/trust/sparse_report.hpp"
#include "report/model_files.hpp"
#include "report/model_report_json.hpp"

namespace thinwall::app {

namespace {

constexpr Eigen::Index largest_dense = 1500;  // rows; a dense report takes some ten seconds there

/// Checks for what matrices need beside their file; the options that state it are named.
void require_inspectable(const io::MatrixFiles& files) {
  if (files.stiffness.empty())
    throw core::UsageError("nothing to inspect: name a model, or matrices with --stiffness and --mass");
  if (files.length_unit.empty())
    throw core::UsageError("the files do not tell their unit of length: add --unit mm, or --unit m");
  if (files.mass_unit.empty())
    throw core::UsageError(
        "the files do not tell their unit of mass: add --mass-unit t (beside mm, N and s) or --mass-unit kg (beside m, "
        "N and s)");
  if (files.mass.empty() && !io::may_hold_several_matrices(files.stiffness))
    throw core::UsageError(files.stiffness.string() + " holds one matrix only: add --mass FILE");
}

/// Of matrices from files: dense where they are small enough, which tells more.
reduction::ReducedModelReport report_of(const InspectRequest& request, std::string& notes) {
  require_inspectable(request.files);
  const io::ImportedMatrices imported = io::read_matrices(request.files);
  notes = "read as " + imported.format + "\n";
  for (const auto& note : imported.notes) notes += note + "\n";
  if (imported.model.size() > largest_dense)
    return reduction::sparse_report(imported.model, {.positions = {}, .rigid_motions = request.rigid_motions});
  report::PlacedModel model = report::placed(imported.model);
  const auto unplaced = [&](const dynamics::Dof& dof) {
    return dof.kind != dynamics::DofKind::modal && !model.positions.contains(dof.point);
  };
  if (!model.positions.empty() && std::ranges::any_of(model.model.dofs, unplaced)) {
    notes += "some nodes have no position: nothing is said of rigid motions\n";
    model.positions.clear();
  }
  return reduction::report(model.model, {.positions = model.positions, .rigid_motions = request.rigid_motions});
}

reduction::ReducedModelReport report_of_model(const InspectRequest& request) {
  const report::PlacedModel model = report::read_model(request.model);
  return reduction::report(model.model, {.positions = model.positions, .rigid_motions = request.rigid_motions});
}

}  // namespace

Inspection inspect(const InspectRequest& request) {
  if (is_universal_file(request.model))
    return inspect_universal(request.model, request.files.length_unit, request.json);
  std::string notes;
  const auto report = request.model.empty() ? report_of(request, notes) : report_of_model(request);
  if (request.json) io::write_json(*request.json, report::report_json(report));
  return {notes + reduction::text(report), report.trustworthy()};
}

}  // namespace thinwall::app
