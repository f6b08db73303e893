#include "study/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "core/error.hpp"
#include "core/messages.hpp"
#include "setup/data_files.hpp"
#include "setup/identified/identify.hpp"
#include "setup/measured.hpp"
#include "setup/milling_process.hpp"
#include "study/error_budget.hpp"
#include "study/kept/kept_coupling.hpp"
#include "study/kept/kept_identified.hpp"
#include "study/kept/kept_part.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/lobes/drawn_structures.hpp"
#include "study/lobes/forced_over_speed.hpp"
#include "study/lobes/lobes_stage.hpp"
#include "study/lobes/path_stage.hpp"
#include "study/part/part_damping.hpp"
#include "study/part/part_stage.hpp"
#include "study/simulation/point_simulation.hpp"
#include "study/support/added_lines.hpp"
#include "study/support/contact_force.hpp"
#include "study/support/contact_identification.hpp"
#include "study/support/robot_survey.hpp"
#include "study/support/support_stage.hpp"
#include "study/updating.hpp"

namespace thinwall::study {

namespace {

/// Mesh, fits of the part, the part itself. Parameters that were fitted are put into `work`.
void compute_part_of(const setup::Variation& variation, setup::VariedSetup& work, const RunOptions& options,
                     Results& results, Stages& stages) {
  stages.begin(work.setup.part->mesh.element_size ? "mesh" : "mesh, order and modes");
  Discretisation discretisation = discretise(part_input(work.setup), options.first_mesh);
  const mesh::TetMesh& mesh = discretisation.mesh;
  const Eigen::Vector3d meshed_size = setup::box_size(*work.setup.part);
  core::inform(fmt::format("{} tetrahedra, {} vertices, order {}", mesh.tets.size(), mesh.vertices.size(),
                           discretisation.order));
  const std::vector<setup::Updating> fits = work.setup.updating;  // a fit rewrites `work`
  for (const setup::Updating& updating : fits) {
    if (updating.on != setup::FitOf::part) continue;
    stages.begin("updating");
    const Eigen::Vector3d size_before = setup::box_size(*work.setup.part);
    discretisation.solved.reset();  // the part changes: mesh and order stay, the solution does not
    PartUpdating fit =
        update_part(variation, work, updating, stretched(mesh, meshed_size, size_before), discretisation.order);
    results.updating.push_back(std::move(fit.result));
    discretisation.solved = std::move(fit.solved);
    core::inform(fmt::format("{}: {} evaluations", updating.name, results.updating.back().evaluations));
  }
  discretisation.mesh = stretched(std::move(discretisation.mesh), meshed_size, setup::box_size(*work.setup.part));
  results.finite_elements = compute_part(part_input(work.setup), std::move(discretisation), stages);
}

/// The part of an earlier run of the same input, or computed now.
void run_part(const setup::Variation& variation, setup::VariedSetup& work, const RunOptions& options, Checkpoint& kept,
              Results& results, Stages& stages) {
  stages.begin("kept results");
  part_of_checkpoint(kept, variation, work, results,
                     [&](setup::VariedSetup& w, Results& r) { compute_part_of(variation, w, options, r, stages); });
  PartResult& part = *results.finite_elements;
  if (part.reduced && !part.damped) part.damped = damped(work.setup.damping, part.reduced->model, part.identified);
}

/// Fits on the reduced part; damping may be among the parameters, so it is applied anew.
void run_coupled_updating(const setup::Variation& variation, setup::VariedSetup& work, Checkpoint& kept,
                          Results& results, Stages& stages) {
  if (std::ranges::count(work.setup.updating, setup::FitOf::coupled, &setup::Updating::on) == 0) return;
  stages.begin("updating");
  fits_of_checkpoint(kept, variation, work, results, [&variation](setup::VariedSetup& w, Results& r) {
    const std::vector<setup::Updating> fits = w.setup.updating;  // a fit rewrites the set-up
    for (const setup::Updating& updating : fits) {
      if (updating.on != setup::FitOf::coupled) continue;
      r.updating.push_back(update_coupled(variation, w, updating, r.finite_elements->reduced->model));
    }
  });
  PartResult& part = *results.finite_elements;
  part.damped = damped(work.setup.damping, part.reduced->model, part.identified);
}

/// An arm that stands by its joints may stand elsewhere than at its contact or at the cut.
void warn_of_distance(const setup::PartSetup& part, const setup::SupportSetup& support,
                      const setup::RobotPosture& robot) {
  const auto place = setup::tip_place(part, support);
  if (!robot.tip || !place || (*robot.tip - *place).norm() <= 1e-3) return;
  core::warn(fmt::format(
      "the robot's tip stands {:.1f} mm from {} \"{}\": it is joined as if it touched; check robot.base and "
      "robot.posture",
      (*robot.tip - *place).norm() * 1e3, setup::carries_tool(support.robot) ? "the cut at" : "its contact at",
      setup::tip_point(support)));
}

/// Finds the joint of the first contact where FRFs of the assembly are given.
void find_contact(const setup::Setup& work, Results& results, Stages& stages) {
  if (setup::measured_assembly(work.contacts.front()).empty()) return;
  if (!work.part_sensors.empty()) {
    core::warn(
        "the part's FRFs were freed of a sensor's mass, those of the assembly were not: if the sensor sat there, too, "
        "the "
        "contact that is found bears its inertia");
  }
  stages.begin("contact");
  results.identification = identify_contact(work.contacts.front(), *results.part, *results.robot);
  warn_of_misfit(work.contacts.front(), *results.identification);
}

void warn_of_kernel(const setup::Setup& work, const CouplingResult& coupled) {
  const coupling::CoupledResponse& receptance = coupled.receptance;
  if (receptance.status == coupling::KernelStatus::ill_conditioned) {
    core::warn(fmt::format(
        "the coupling's kernel is ill-conditioned at some line (condition up to {:.1e}): expect lost digits there",
        receptance.kernel_condition.maxCoeff()));
  }
  if (receptance.status == coupling::KernelStatus::regularised) {
    core::warn(fmt::format(
        "coupling.regularisation = \"{}\" changed the kernel, singular values below the threshold at {} of {} lines; a "
        "joint is left open by up to {:.2g} of its opening",
        core::word_of(work.coupling.regularisation), (receptance.dropped.array() > 0).count(),
        receptance.dropped.size(), receptance.compatibility_residual.maxCoeff()));
  }
  if (!coupled.no_spatial_route.empty())
    core::warn(fmt::format("no spatial route, so no modes of part and robot together: {}", coupled.no_spatial_route));
}

void run_coupling(Checkpoint& kept, const setup::Setup& work, Results& results, Stages& stages) {
  find_contact(work, results, stages);
  stages.begin("coupling");
  const auto identified = results.identification ? std::optional(results.identification->joined) : std::nullopt;
  results.contacts = setup::joined_contacts(work, work, identified);
  const std::vector<coupling::Contact> contacts = contacts_of(results.contacts);
  results.coupled = coupling_of_checkpoint(
      kept, [&] { return couple(contacts, coupling_options(work.coupling), *results.part, *results.robot); });
  results.reductions = reductions(contacts, *results.part, *results.coupled);
  warn_of_kernel(work, *results.coupled);
}

void run_responses(Checkpoint& kept, const setup::Setup& work, Results& results, Stages& stages) {
  const bool reduced = results.finite_elements && results.finite_elements->damped;
  const bool part = reduced || !work.measured_part.empty();
  if (!part && !work.robot) return;
  stages.begin("receptances");
  const dynamics::FrequencyAxis axis = frequency_axis(work.response, work, work);
  if (part) results.part = reduced ? component(*results.finite_elements->damped, axis) : measured_part(work, axis);
  if (work.robot) {
    results.robot_posture = setup::robot_posture(work, work);
    results.robot = robot_component(*work.robot, axis, results.robot_posture->posture);
    warn_of_distance(work, work, *results.robot_posture);
    results.survey = survey(survey_input(work), tip_report(*results.robot_posture, *results.robot));
    if (results.survey->tips.empty()) core::warn("the robot reaches no place of its workspace");
  }
  if (!work.measured_part.empty()) setup::warn_if_implausible(results.part->response, "the part's");
  if (work.robot && std::holds_alternative<setup::MeasuredRobot>(work.robot->model))
    setup::warn_if_implausible(results.robot->response, "the robot's");
  if (part && work.robot && !work.contacts.empty()) run_coupling(kept, work, results, stages);
  results.added = added_lines(coupling_options(work.coupling), results);
  stages.begin("error budget");
  try {
    results.errors = error_budget(budget_input(work), results);
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    core::warn(fmt::format("no error budget: {}", error.what()));
  }
}

/// The changes in each draw of what was identified; none, with a warning, where one of them cannot be coupled.
std::vector<std::vector<Eigen::Matrix3cd>> drawn_changes_or_none(const setup::Setup& work,
                                                                 const milling::ToolFrame& frame,
                                                                 const Results& results) {
  try {
    return drawn_changes(work, frame, results);
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    core::warn(fmt::format("no range of depths by what was identified: {}", error.what()));
    return {};
  }
}

/// The supported part where the robot has no poles. What cannot be charted from samples leaves the rest of the run.
void add_sampled_chart(const setup::Setup& work, const milling::ToolFrame& frame,
                       const std::vector<milling::OperatingPoint>& points, Checkpoint& kept, Results& results) {
  try {
    const auto structure = sampled_structure(work, frame, results.coupled->receptance.response);
    StructureErrors errors = sampled_structure_errors(work, frame, results);
    errors.drawn_changes = drawn_changes_or_none(work, frame, results);
    results.lobes.push_back(compute_lobes(work, ChartOf::supported, structure, errors, points, kept));
  } catch (const core::Interrupted&) {
    throw;
  } catch (const core::Error& error) {
    core::warn(fmt::format("no chart of the supported part, which is known by its receptances only: {}", error.what()));
  }
}

/// Looks for the depth at which the contact is lost at the case's own speed, up to the limit. What the library does not
/// model is told and left out.
void find_contact_limit(const setup::Setup& work, const milling::MillingProcess& process, Results& results,
                        const ContactForceOf& force_of) {
  StructureLobes& chart = results.lobes.back();
  const auto feed = setup::feed_per_tooth(work);
  if (!chart.at_spindle_speed || !feed || !results.coupled->modal || setup::known_by_lines(*work.tool) ||
      !(chart.at_spindle_speed->limiting_depth_m > 0.0))
    return;
  const auto poles = cut_poles(work, &*results.coupled->modal);
  ContactLimit limit;
  try {
    limit.lost_above_m = depth_of_lost_contact(
        [&](double depth_m) {
          const ContactForce force = force_of(
              milling::forced_vibration(*poles, process, chart.at_spindle_speed->spindle_speed_rpm, depth_m, *feed));
          limit.preload_n = force.preload_n;
          return force;
        },
        chart.at_spindle_speed->limiting_depth_m);
    chart.contact = limit;
  } catch (const core::InputError& error) {
    core::warn(fmt::format("whether the contact holds is not known: {}", error.what()));
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("whether the contact holds is not known: {}", error.what()));
  }
}

/// The force on the contact of the supported part; empty where no contact has a preload, and with a regularised kernel,
/// of which it is not told.
ContactForceOf contact_force_of(const setup::Setup& work, const Results& results) {
  const bool pressed = results.coupled && (work.robot->preload != Eigen::Vector3d::Zero() ||
                                           (work.contacts.size() == 1 && setup::own_preload(work.contacts.front())));
  if (!pressed || work.coupling.regularisation != coupling::Regularisation::none) return {};
  const CutPlace place{work.cutting->at, setup::milling_process(work).frame.rotation()};
  return [&work, &results, place](const milling::ForcedVibration& forced) {
    return contact_force(work, contacts_of(results.contacts), place, *results.part, *results.robot, forced);
  };
}

/// Computes the force on the contact of the supported part at its operating points, and up to which depth it holds at
/// the case's own speed.
void flag_contacts(const setup::Setup& work, const ContactForceOf& force_of, Results& results) {
  if (results.lobes.back().of != ChartOf::supported) return;
  const milling::MillingProcess process = setup::milling_process(work);
  find_contact_limit(work, process, results, force_of);
  for (PointStability& point : results.lobes.back().points) {
    if (!point.forced) continue;
    point.contact = force_of(*point.forced);
    if (!point.contact->lost) continue;
    core::warn(
        fmt::format("at {:.0f} rpm the cut pulls the contact open: its force falls to {:.3g} N of {:.3g} N preload",
                    point.point.spindle_speed_rpm, point.contact->least_n, point.contact->preload_n));
  }
}

const dynamics::ModalModel* modes_or_null(const std::optional<Component>& component) {
  return component && component->modal ? &*component->modal : nullptr;
}

/// The poles of which a chart is; none if it is of samples.
std::optional<milling::RelativeStructure> poles_of(const setup::Setup& work, ChartOf chart, const Results& results) {
  if (setup::known_by_lines(*work.tool)) return std::nullopt;
  if (chart == ChartOf::tool) return cut_poles(work, nullptr);
  if (chart == ChartOf::carried) return cut_poles(work, modes_or_null(results.part), &carrier_modes(*results.robot));
  const auto& modal = chart == ChartOf::part ? results.part->modal : results.coupled->modal;
  return modal ? cut_poles(work, &*modal) : std::nullopt;
}

/// Surface, force and contact over the speeds of every chart, at the depths of its operating points. What the library
/// does not model is told and left out.
void add_forced_over_speed(const setup::Setup& work, const ContactForceOf& force_of, Results& results, Stages& stages) {
  const auto feed = setup::feed_per_tooth(work);
  if (!feed || results.lobes.front().points.empty()) return;
  stages.begin("forced vibration");
  try {
    for (StructureLobes& chart : results.lobes) {
      const auto poles = poles_of(work, chart.of, results);
      if (!poles) continue;
      for (const double depth_m : depths_of(chart.points)) {
        chart.forced_over_speed.push_back(
            forced_over_speed(*poles, setup::milling_process(work), chart.lobes.rows, {depth_m, *feed},
                              chart.of == ChartOf::supported ? force_of : ContactForceOf{}));
      }
    }
  } catch (const core::InputError& error) {
    core::warn(fmt::format("no forced vibration over the speed: {}", error.what()));
  } catch (const core::NumericalError& error) {
    core::warn(fmt::format("no forced vibration over the speed: {}", error.what()));
  }
}

/// Sets the bound of the modes that charts and simulations resolve where a case leaves it open and a reduction gives
/// it.
void bound_modes(const PartResult& part, setup::Setup& work) {
  if (!work.lobes || !work.cutting || !work.tool || work.lobes->modes_up_to_hz || !part.reduced) return;
  work.lobes->modes_up_to_hz = usual_modes_up_to_hz(part.reduced->fixed_interface_hz);
  if (!work.lobes->modes_up_to_hz) return;
  core::inform(fmt::format(
      "modes of the part above {:.1f} kHz, one and a half times the highest of its reduction, act by their static "
      "compliance in the charts; lobes.modes_up_to gives another bound",
      *work.lobes->modes_up_to_hz * 1e-3));
}

void run_lobes(const setup::Setup& work, const std::vector<milling::OperatingPoint>& points, Checkpoint& kept,
               Results& results, Stages& stages) {
  if (!work.lobes || !work.cutting || !work.tool) return;
  const milling::ToolFrame frame = setup::milling_process(work).frame;
  const bool carried = setup::robot_beside_tool(work, work);
  // The cuts were made on the last of the charts: only that one learns from them.
  const auto chart_of = [&](ChartOf of, const dynamics::ModalModel* part, const dynamics::ModalModel* richer,
                            bool is_last) {
    const dynamics::ModalModel* carrier = of == ChartOf::carried ? &carrier_modes(*results.robot) : nullptr;
    const CutStructure structure = cut_structure(work, frame, part, carrier);
    if (!results.synthesised_tip) results.synthesised_tip = synthesised_tip(work, structure);
    StructureErrors errors = structure_errors(work, frame, structure, richer, carrier);
    errors.draws = drawn_poles(work, of, part, results);
    if (setup::swapped_on_robot(*work.tool)) errors.drawn_changes = drawn_swaps(work, frame);
    setup::CutSetup cut = work;
    if (!is_last) cut.calibration.reset();
    results.lobes.push_back(compute_lobes(cut, of, structure, errors, points, kept));
  };
  stages.begin("lobes");
  if (!work.part && work.measured_part.empty()) {
    chart_of(carried ? ChartOf::carried : ChartOf::tool, nullptr, nullptr, true);
    return add_forced_over_speed(work, {}, results, stages);
  }
  if (!results.part || !results.part->modal) {
    throw core::InputError(
        "lobes need a part that is held and known as a model (part.shape with part.supports), not by measured "
        "receptances alone");
  }
  chart_of(ChartOf::part, &*results.part->modal, modes_or_null(results.errors.richer_part),
           !carried && !results.coupled);
  if (carried)
    chart_of(ChartOf::carried, &*results.part->modal, modes_or_null(results.errors.richer_part), !results.coupled);
  if (results.coupled && results.coupled->modal) {
    const auto& richer = results.errors.richer_coupled;
    chart_of(ChartOf::supported, &*results.coupled->modal, richer ? &*richer : nullptr, true);
  } else if (results.coupled) {
    add_sampled_chart(work, frame, points, kept, results);
  }
  const ContactForceOf force_of = contact_force_of(work, results);
  if (force_of) flag_contacts(work, force_of, results);
  add_forced_over_speed(work, force_of, results, stages);
  if (!work.path) return;
  stages.begin("lobes along the path");
  results.path = lobes_along_path(path_input(work), results, kept);
}

/// The points of [simulation], and its map.
void run_simulation(const setup::Setup& work, const std::vector<milling::OperatingPoint>& points, Checkpoint& kept,
                    Results& results, Stages& stages) {
  if (!work.simulation) return;
  stages.begin("simulation");
  results.simulations = simulate_points(work, results, points, kept);
  results.amplitude_maps = amplitude_maps(work, results, kept);
}

/// Finds the models of tool and robot that are identified from measurements.
void run_identification(Kept& kept, setup::Setup& work, Stages& stages) {
  const bool awaits = setup::awaits_fit(work) || setup::awaits_learning(work);
  if (awaits) stages.begin("identification");
  identify_or_take(kept.tool, kept.robot, work);
  if (awaits) setup::tell_of_identified(work);
}

}  // namespace

Results run(const setup::Setup& setup, const setup::Variation& variation, Kept& kept, const RunOptions& options) {
  require_chart_of(setup, options.points);
  require_simulation(setup, options.points);
  setup::tell_of_data_files(setup);
  Stages stages(options.on_stage);
  Results results;
  setup::VariedSetup work{setup, {}};
  run_identification(kept, work.setup, stages);
  const setup::Variation varied = identified_variation(variation, work.setup);
  if (work.setup.part) run_part(varied, work, options, kept.part, results, stages);
  if (results.finite_elements && results.finite_elements->reduced)
    run_coupled_updating(varied, work, kept.structure, results, stages);
  if (results.finite_elements) bound_modes(*results.finite_elements, work.setup);
  run_responses(kept.structure, work.setup, results, stages);
  run_lobes(work.setup, options.points, kept.charts, results, stages);
  kept.charts.arrange();
  run_simulation(work.setup, options.points, kept.simulations, results, stages);
  kept.simulations.arrange();
  stages.end();
  results.setup = std::move(work.setup);
  results.timings_s = stages.timings_s();
  return results;
}

}  // namespace thinwall::study
