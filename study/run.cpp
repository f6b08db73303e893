#include "study/run.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <ctime>

#include "app/doctor.hpp"
#include "case/expectation.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "report/kept_files.hpp"
#include "report/page/page.hpp"
#include "report/result_files.hpp"
#include "report/summary.hpp"
#include "setup/contact_model.hpp"
#include "setup/measured.hpp"
#include "setup/milling_process.hpp"
#include "setup/robot_tip.hpp"
#include "study/error_budget.hpp"
#include "study/kept/checkpoint.hpp"
#include "study/kept/kept_coupling.hpp"
#include "study/kept/kept_part.hpp"
#include "study/kept/keys.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "study/lobes/path_stage.hpp"
#include "study/part/part_stage.hpp"
#include "study/results.hpp"
#include "study/stages.hpp"
#include "study/support/contact_force.hpp"
#include "study/support/contact_identification.hpp"
#include "study/support/robot_survey.hpp"
#include "study/support/support_stage.hpp"
#include "study/updating.hpp"

namespace thinwall::study {

namespace {

std::string now_utc() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

/// Mesh, fits of the part, the part itself. Parameters that were fitted are written into `work`.
void compute_part_of(cases::Case& work, Results& results, Stages& stages) {
  stages.begin(work.part->mesh.element_size ? "mesh" : "mesh, order and modes");
  Discretisation discretisation = discretise(work);
  const mesh::TetMesh& mesh = discretisation.mesh;
  const Eigen::Vector3d meshed_size = setup::box_size(*work.part);
  spdlog::info("{} tetrahedra, {} vertices, order {}", mesh.tets.size(), mesh.vertices.size(), discretisation.order);
  const std::vector<setup::Updating> fits = work.updating;  // a fit rewrites `work`
  for (const setup::Updating& updating : fits) {
    if (updating.on != "part") continue;
    stages.begin("updating");
    const Eigen::Vector3d size_before = setup::box_size(*work.part);
    discretisation.solved.reset();  // the part changes: mesh and order stay, the solution does not
    PartUpdating fit = update_part(work, updating, stretched(mesh, meshed_size, size_before), discretisation.order);
    results.updating.push_back(std::move(fit.result));
    discretisation.solved = std::move(fit.solved);
    spdlog::info("{}: {} evaluations", updating.name, results.updating.back().evaluations);
  }
  discretisation.mesh = stretched(std::move(discretisation.mesh), meshed_size, setup::box_size(*work.part));
  results.finite_elements = compute_part(work, std::move(discretisation), stages);
}

/// The part's checkpoint: of this result folder, or one of those that several runs share.
Checkpoint part_checkpoint(const cases::Case& source, const RunOptions& options) {
  const std::string key = part_key(source);
  if (options.parts.empty()) return {options.out / "cache" / "part.bin", key, options.fresh};
  return {options.parts / ("part-" + key.substr(0, 16) + ".bin"), key, false};
}

/// The same, or what an earlier run left of the same inputs.
void run_part(const cases::Case& source, cases::Case& work, const RunOptions& options, Results& results,
              Stages& stages) {
  stages.begin("kept results");
  Checkpoint kept = part_checkpoint(source, options);
  part_of_checkpoint(kept, work, results, [&stages](cases::Case& w, Results& r) { compute_part_of(w, r, stages); });
  PartResult& part = *results.finite_elements;
  if (part.reduced && !part.damped) part.damped = damped(work, part.reduced->model, part.identified);
}

/// Fits on the reduced part; damping may be among the parameters, so it is applied anew.
void run_coupled_updating(Checkpoint& kept, cases::Case& work, Results& results, Stages& stages) {
  if (std::ranges::count(work.updating, "coupled", &setup::Updating::on) == 0) return;
  stages.begin("updating");
  fits_of_checkpoint(kept, work, results, [](cases::Case& w, Results& r) {
    const std::vector<setup::Updating> fits = w.updating;  // a fit rewrites the case
    for (const setup::Updating& updating : fits) {
      if (updating.on != "coupled") continue;
      r.updating.push_back(update_coupled(w, updating, r.finite_elements->reduced->model));
    }
  });
  PartResult& part = *results.finite_elements;
  part.damped = damped(work, part.reduced->model, part.identified);
}

/// An arm that stands by its joints may stand elsewhere than at its contact.
void warn_of_distance(const cases::Case& work, const RobotPosture& robot) {
  const auto place = setup::contact_place(work);
  if (!robot.tip || !place || (*robot.tip - *place).norm() <= 1e-3) return;
  spdlog::warn(
      "the robot's tip stands {:.1f} mm from its contact at \"{}\": it is joined as if it touched; check "
      "robot.base and robot.posture",
      (*robot.tip - *place).norm() * 1e3, work.contacts.front().part_point);
}

/// A joint that is to be found takes its place in `work`, so that whatever joins the contact later has it.
void find_contact(cases::Case& work, Results& results, Stages& stages) {
  if (work.contacts.front().measured.empty()) return;
  if (!work.part_sensors.empty()) {
    spdlog::warn(
        "the part's FRFs were freed of a sensor's mass, those of the assembly were not: if the sensor sat there, too, "
        "the "
        "contact that is found bears its inertia");
  }
  stages.begin("contact");
  results.identification = identify_contact(work, *results.part, *results.robot);
  warn_of_misfit(work, *results.identification);
  work.contacts.front().identified = results.identification->joined;
}

void warn_of_kernel(const cases::Case& work, const CouplingResult& coupled) {
  const coupling::CoupledResponse& receptance = coupled.receptance;
  if (receptance.status == coupling::KernelStatus::ill_conditioned) {
    spdlog::warn(
        "the coupling's kernel is ill-conditioned at some line (condition up to {:.1e}): expect lost digits there",
        receptance.kernel_condition.maxCoeff());
  }
  if (receptance.status == coupling::KernelStatus::regularised) {
    spdlog::warn(
        "coupling.regularisation = \"{}\" changed the kernel, singular values below the threshold at {} of {} lines; a "
        "joint is left open by up to {:.2g} of its opening",
        work.coupling.regularisation, (receptance.dropped.array() > 0).count(), receptance.dropped.size(),
        receptance.compatibility_residual.maxCoeff());
  }
  if (!coupled.no_spatial_route.empty())
    spdlog::warn("no spatial route, so no modes of part and robot together: {}", coupled.no_spatial_route);
}

void run_coupling(Checkpoint& kept, cases::Case& work, Results& results, Stages& stages) {
  find_contact(work, results, stages);
  stages.begin("coupling");
  results.contacts = setup::joined_contacts(work);
  results.coupled = coupling_of_checkpoint(kept, [&] { return couple(work, *results.part, *results.robot); });
  results.reductions = reductions(work, *results.part, *results.coupled);
  warn_of_kernel(work, *results.coupled);
}

void run_responses(Checkpoint& kept, cases::Case& work, Results& results, Stages& stages) {
  const bool reduced = results.finite_elements && results.finite_elements->damped;
  const bool part = reduced || !work.measured_part.empty();
  if (!part && !work.robot) return;
  stages.begin("receptances");
  const dynamics::FrequencyAxis axis = frequency_axis(work);
  if (part) results.part = reduced ? component(*results.finite_elements->damped, axis) : measured_part(work, axis);
  if (work.robot) {
    results.robot_posture = setup::robot_posture(work);
    results.robot = setup::robot_component(work, axis, results.robot_posture->posture);
    warn_of_distance(work, *results.robot_posture);
    results.survey = survey(work, tip_report(*results.robot_posture, *results.robot));
    if (results.survey->tips.empty()) spdlog::warn("the robot reaches no place of its workspace");
  }
  if (!work.measured_part.empty()) setup::warn_of_doubts(results.part->response, "the part's");
  if (work.robot && work.robot->model == "measured") setup::warn_of_doubts(results.robot->response, "the robot's");
  if (part && work.robot && !work.contacts.empty()) run_coupling(kept, work, results, stages);
  stages.begin("error budget");
  try {
    results.errors = error_budget(work, results);
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    spdlog::warn("no error budget: {}", error.what());
  }
}

/// The supported part where the robot has no poles. What cannot be charted from samples leaves the rest of the run.
void add_sampled_chart(const cases::Case& work, const milling::ToolFrame& frame,
                       const std::vector<milling::OperatingPoint>& points, Checkpoint& kept, Results& results) {
  try {
    const auto structure = sampled_structure(work, frame, results.coupled->receptance.response);
    const StructureErrors errors = sampled_structure_errors(work, frame, results);
    results.lobes.push_back(compute_lobes(work, "supported", structure, errors, points, kept));
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    spdlog::warn("no chart of the supported part, which is known by its receptances only: {}", error.what());
  }
}

/// What the contact bears at the operating points of the supported part; not told of a regularised kernel.
void flag_contacts(const cases::Case& work, Results& results) {
  if (work.coupling.regularisation != "none") return;
  for (PointStability& point : results.lobes.back().points) {
    if (results.lobes.back().name != "supported" || !point.forced) continue;
    point.contact = contact_force(work, *results.part, *results.robot, *point.forced);
    if (!point.contact->lost) continue;
    spdlog::warn("at {:.0f} rpm the cut pulls the contact open: its force falls to {:.3g} N of {:.3g} N preload",
                 point.point.spindle_speed_rpm, point.contact->least_n, point.contact->preload_n);
  }
}

void run_lobes(const cases::Case& work, const std::vector<milling::OperatingPoint>& points, Checkpoint& kept,
               Results& results, Stages& stages) {
  if (!work.lobes || !work.cutting || !work.tool) return;
  const milling::ToolFrame frame = setup::milling_process(work).frame;
  const auto chart_of = [&](const std::string& name, const dynamics::ModalModel* part,
                            const dynamics::ModalModel* richer) {
    const CutStructure structure = cut_structure(work, frame, part);
    const StructureErrors errors = structure_errors(work, frame, structure, richer);
    results.lobes.push_back(compute_lobes(work, name, structure, errors, points, kept));
  };
  const auto modal = [](const std::optional<Component>& component) {
    return component && component->modal ? &*component->modal : nullptr;
  };
  stages.begin("lobes");
  if (!work.part && work.measured_part.empty()) return chart_of("tool", nullptr, nullptr);
  if (!results.part || !results.part->modal) {
    throw core::InputError(
        "lobes need a part that is held and known as a model (part.shape with part.supports), not by measured "
        "receptances alone");
  }
  chart_of("part", &*results.part->modal, modal(results.errors.richer_part));
  if (results.coupled && results.coupled->modal) {
    const auto& richer = results.errors.richer_coupled;
    chart_of("supported", &*results.coupled->modal, richer ? &*richer : nullptr);
  } else if (results.coupled) {
    add_sampled_chart(work, frame, points, kept, results);
  }
  const bool pressed = results.coupled && (work.robot->preload != Eigen::Vector3d::Zero() ||
                                           (work.contacts.size() == 1 && work.contacts.front().preload));
  if (pressed) flag_contacts(work, results);
  if (!work.path) return;
  stages.begin("lobes along the path");
  results.path = lobes_along_path(work, results, kept);
}

/// The page is a picture of results that are there; a run does not fail for it.
void write_report(const std::filesystem::path& results, const report::KeptSections& kept) {
  try {
    report::write_page(results / "report.html", {{results}, app::program_name(), kept});
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    spdlog::warn("report.html was not written: {}", error.what());
  }
}

}  // namespace

RunResult run_case(const cases::Case& source, const RunOptions& options) {
  const std::string started = now_utc();
  const auto expectations = cases::read_expectations(source.file);
  require_chart_of(source, options.points);
  Stages stages(options.progress      ? ProgressDisplay::line
                : options.stage_lines ? ProgressDisplay::lines
                                      : ProgressDisplay::none);
  Results results;
  cases::Case work = source;
  if (work.part) run_part(source, work, options, results, stages);
  Checkpoint structure(options.out / "cache" / "structure.bin", structure_key(source), options.fresh);
  if (results.finite_elements && results.finite_elements->reduced)
    run_coupled_updating(structure, work, results, stages);
  run_responses(structure, work, results, stages);
  Checkpoint kept(options.out / "cache" / "lobes.bin", charts_key(source), options.fresh);
  run_lobes(work, options.points, kept, results, stages);
  stages.begin("output");
  const auto staging = core::partial_path(options.out / "results");
  if (!report::take_files(structure, options.out, staging)) {
    report::write_structure(staging, work, results);
    report::keep_files(structure, staging);
  }
  report::write_cuts(staging, source, results);
  report::write_cases(staging, source, work);
  stages.begin("report");
  results.timings_s = stages.timings_s();
  RunResult run{report::summary_of(work, results), true};
  run.expectations_hold = report::add_checks(run.summary, expectations);
  if (!run.expectations_hold) run.summary["status"] = "expectation_not_met";
  nlohmann::json manifest = report::manifest_of(source, run.summary, started);
  report::write_summary(staging, run.summary, manifest);
  write_report(staging, report::kept_sections(structure));
  stages.end();
  for (const auto& [stage, seconds] : stages.timings_s()) run.summary["timings_s"][stage] = seconds;
  report::write_summary(staging, run.summary, manifest);
  report::record_outputs(staging, manifest);
  report::publish(staging, options.out);
  return run;
}

}  // namespace thinwall::study
