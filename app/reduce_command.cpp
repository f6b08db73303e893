#include "app/reduce_command.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>

#include "app/stage_display.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "core/units.hpp"
#include "fem/patch.hpp"
#include "io/json_file.hpp"
#include "reduction/damping.hpp"
#include "reduction/trust/comparison.hpp"
#include "reduction/trust/mode_count.hpp"
#include "report/model_files.hpp"
#include "report/model_report_json.hpp"
#include "setup/part_geometry.hpp"
#include "study/part/discretisation.hpp"
#include "study/part/part_damping.hpp"
#include "study/part/part_model.hpp"
#include "study/part/part_stage.hpp"
#include "study/results.hpp"

namespace thinwall::app {

namespace {

using reduction::Method;

/// A reduced model, how it was asked for, and what is known of its error.
struct ReducedPart {
  reduction::Reduction reduction;
  std::string chosen;  ///< why so many modes; "" where they were given
};

/// The method of --method, which must give matrices.
Method method_of(const ReduceRequest& request) {
  Method method = Method::craig_bampton;
  try {
    method = reduction::method_named(request.method);
  } catch (const core::InputError& error) {
    throw core::UsageError(std::string("--method: ") + error.what());
  }
  if (method == Method::modal_truncation)
    throw core::UsageError(
        "--method: modal_truncation gives poles, no matrices to write; \"thinwall run\" writes them as modes");
  return method;
}

void require_reducible(const cases::Case& source) {
  if (!source.part) throw core::InputError("there is no modelled part to reduce; describe it in [part]");
  if (source.reduction.interface.empty())
    throw core::InputError("the part has no points to be reduced to; name them in [points]");
}

/// A model is not written over the matrices that it comes from.
void require_apart(const cases::Case& source, const ReduceRequest& request) {
  const auto* matrices = std::get_if<setup::MatrixShape>(&source.part->shape);
  if (matrices == nullptr) return;
  const io::MatrixFiles& files = matrices->files;
  std::error_code ignored;
  const auto out = std::filesystem::weakly_canonical(request.out, ignored);
  for (const auto& file : {files.stiffness, files.mass, files.damping, files.dofs}) {
    if (file.empty() || std::filesystem::weakly_canonical(file, ignored).parent_path() != out) continue;
    throw core::InputError("\"" + file.string() + "\", which the part is read from, lies in \"" + request.out.string() +
                           "\", where the reduced model is to go; choose another folder with -o");
  }
}

reduction::Band band_of(const cases::Case& source, const ReduceRequest& request) {
  reduction::Band band;
  band.from_hz = request.from_hz.value_or(source.response.from_hz);
  band.to_hz = request.to_hz.value_or(source.response.to_hz);
  try {
    reduction::validate(band);
  } catch (const core::InputError& error) {
    if (!request.from_hz && !request.to_hz) throw;  // it is the case's
    throw core::UsageError(std::string("--from, --to: ") + error.what());
  }
  return band;
}

reduction::FullModel full_model(const study::Solution& part) {
  return {part.model.K, part.model.M, part.model.node_of_row, part.modes.pairs.Phi.leftCols(part.modes.rigid_motions)};
}

void require_solved(const reduction::BandTruth& truth) {
  if (truth.max_relative_error < reduction::small_error) return;
  if (truth.max_relative_error < 1e-4) {
    core::warn(
        fmt::format("the receptances of the full model are known to {:.0e} only, because of round-off: smaller "
                    "errors of the reduced model are not seen",
                    truth.max_relative_error));
    return;
  }
  throw core::NumericalError(
      fmt::format("the full model's receptance over the band is known to {:.1e} only, because of round-off; make the "
                  "mesh more even",
                  truth.max_relative_error));
}

/// Elastic modes that are asked for: by the command, or by the case's [reduction]; none where a tolerance is to choose.
std::optional<int> wanted_modes(const cases::Case& source, const ReduceRequest& request, const study::Solution& part) {
  if (request.modes || request.tolerance) return request.modes;
  if (source.reduction.fixed_interface.up_to_hz) {  // as many as the part itself has up to there
    const auto& hz = part.modes.frequency_hz;
    if (hz(hz.size() - 1) < *source.reduction.fixed_interface.up_to_hz)
      throw core::InputError(
          "reduction.up_to reaches beyond the modes that are computed; raise modes.up_to, or give --modes");
    return static_cast<int>((hz.array() <= *source.reduction.fixed_interface.up_to_hz).count()) -
           part.modes.rigid_motions;
  }
  const auto* given = cases::find(source.values, "reduction.modes");
  return given == nullptr ? std::nullopt : source.reduction.fixed_interface.count;
}

ReducedPart by_tolerance(const reduction::FullModel& full, const reduction::Interface& interface,
                         const reduction::Band& band, const reduction::BandTruth& truth, double tolerance) {
  const reduction::ModeCountOptions options{.tolerance = tolerance, .band = band};
  reduction::ChosenModes chosen = reduction::modes_for_tolerance(full, interface, options, truth);
  const std::string found = fmt::format(
      "{} modes: by estimate {:.2g} off where {:.2g} is allowed; the estimate's reference is {:.1e} off the full model",
      chosen.modes, chosen.estimated_error, tolerance, chosen.reference_error);
  if (chosen.status != reduction::ModeCountStatus::met) {
    throw core::NumericalError(
        "the tolerance on the receptance is " +
        std::string(chosen.status == reduction::ModeCountStatus::not_met ? "not met" : "not verified") + " with " +
        found + "; take a narrower band, a larger tolerance or --modes");
  }
  ReducedPart result;
  result.reduction.model = std::move(chosen.reduced.model);
  result.reduction.modes = chosen.modes;
  result.reduction.status = chosen.reduced.status;
  result.chosen = found;
  return result;
}

ReducedPart reduced_part(const cases::Case& source, const ReduceRequest& request, std::optional<int> modes,
                         const reduction::FullModel& full, const reduction::Interface& interface,
                         const reduction::Band& band, const reduction::BandTruth& truth) {
  const Method method = method_of(request);
  if (request.tolerance || (!modes && method == Method::craig_bampton))
    return by_tolerance(full, interface, band, truth,
                        request.tolerance.value_or(source.reduction.tolerance.value_or(0.01)));
  reduction::ReductionOptions options;
  options.modes = modes.value_or(options.modes);
  options.characteristic =
      std::min(request.characteristic.value_or(options.characteristic), static_cast<int>(interface.W.cols()));
  const auto* modal = std::get_if<setup::ModalDamping>(&source.damping);
  options.damping_ratio = modal != nullptr ? modal->ratio : 0.01;
  return {reduction::reduce(method, full, interface, options), ""};
}

/// Positions of the points: the centres of their patches, which an edge may cut, or their nodes; empty unless all are
/// known.
reduction::Positions positions_of(const cases::Case& source, const fem::Model& model) {
  reduction::Positions positions;
  for (const std::string& name : source.reduction.interface) {
    const fem::NamedPoint p = setup::named_point(source, name);
    const fem::Patch disc = fem::disc_of(p);
    const Eigen::Vector3d x =
        model.mesh.tets.empty() ? p.position_m : fem::patch_average(model.mesh, model.nodes, disc, name).centre_m;
    if (!x.allFinite()) return {};
    positions[name] = x;
  }
  return positions;
}

/// Methods whose M is positive definite take the damping of the case.
bool takes_damping(Method method) {
  return method != Method::macneal && method != Method::dual_craig_bampton;
}

std::string error_text(const reduction::ComparisonRow& row, const reduction::Band& band) {
  return fmt::format(
      "  error       frequencies {:.1e}, receptance of the interface {:.1e} of the full model's, {:g} to {:g} Hz, loss "
      "factor {:g}\n",
      row.max_relative_frequency_error, row.max_relative_receptance_error, band.from_hz, band.to_hz, band.loss_factor);
}

/// The files, and what is to be said of them.
std::string written(const cases::Case& source, const ReduceRequest& request, const ReducedPart& reduced,
                    const study::Solution& part) {
  report::PlacedModel model{std::get<dynamics::SpatialModel>(reduced.reduction.model),
                            positions_of(source, part.model)};
  if (std::holds_alternative<setup::MatrixDamping>(source.damping)) {
    spdlog::warn("the part's damping matrix is not carried into the reduced model; \"thinwall run\" does that");
  } else if (takes_damping(reduced.reduction.method)) {
    std::vector<reduction::IdentifiedMode> identified;
    model.model = study::damped(source.damping, model.model, identified);
  }
  const std::string left_out = report::write_model(request.out, model);
  const reduction::ReducedModelReport report =
      reduction::report(model.model, {.positions = model.positions, .rigid_motions = part.modes.rigid_motions});
  io::write_json(request.out / "report.json", report::report_json(report));
  core::write_file_atomically(request.out / "report.txt", reduction::text(report));
  std::string text = reduction::text(report) + "\n";
  if (!left_out.empty()) text += "  model.mat only: " + left_out + "\n";
  return text + "  model in " + request.out.string() + "\n";
}

}  // namespace

void require_options(const ReduceRequest& request) {
  const Method method = method_of(request);
  if (!request.tolerance) return;
  if (!(*request.tolerance >= 1e-8 && *request.tolerance <= 1.0))
    throw core::UsageError("--tolerance is " + core::number_text(*request.tolerance) +
                           "; it is relative, a number from 1e-8 to 1, as 0.01");
  if (method != Method::craig_bampton)
    throw core::UsageError("--tolerance chooses the modes of craig_bampton; give --modes with --method " +
                           request.method);
}

std::string reduce_part(const cases::Case& source, const ReduceRequest& request) {
  require_options(request);
  require_reducible(source);
  require_apart(source, request);
  reduction::Band band = band_of(source, request);
  report::make_model_folder(request.out);
  StageDisplay display(request.display);
  study::Stages stages(display.listener());
  stages.begin("mesh, order and modes");
  const study::Solution part = study::solved_part(source, study::discretise(study::part_input(source)), stages);
  const double least = study::least_loss_factor(source.damping, part.modes, band.from_hz, band.to_hz);
  if (least > 0.0) band.loss_factor = least;
  const reduction::Interface interface = study::part_interface(source, part.model);
  const reduction::FullModel full = full_model(part);
  stages.begin("receptance of the full model");
  const reduction::BandTruth truth = reduction::band_truth(full, interface, band);
  require_solved(truth);
  stages.begin("reduction");
  const ReducedPart reduced =
      reduced_part(source, request, wanted_modes(source, request, part), full, interface, band, truth);
  if (reduced.reduction.status != linalg::EigenStatus::converged)
    throw core::NumericalError("the modes of the reduction did not converge: ask for fewer, or mesh more evenly");
  const reduction::ComparisonRow row = reduction::compared(reduced.reduction, truth, band);
  std::string text = (source.title.empty() ? source.name : source.title) + "\n\n";
  text += fmt::format("  full model  {} degrees of freedom, {} rigid motions free\n", full.K.rows(),
                      part.modes.rigid_motions);
  text += fmt::format("  reduced     {}: {} coordinates, {} of them interface, {} modes\n",
                      reduction::name(reduced.reduction.method), row.size, interface.W.cols(), row.modes);
  if (!reduced.chosen.empty()) text += "  tolerance   " + reduced.chosen + "\n";
  text += error_text(row, band);
  if (request.compare) {
    stages.begin("comparison");
    text += "\n" + reduction::text(reduction::compare(full, interface, band, row.size)) + "\n";
  }
  return text + written(source, request, reduced, part);
}

}  // namespace thinwall::app
