#include "report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "milling/direct/stability.hpp"
#include "report/contact_report.hpp"
#include "report/error_summary.hpp"
#include "report/finite_number.hpp"
#include "report/geometry_summary.hpp"
#include "report/lobes/lobes_answers.hpp"
#include "report/lobes/lobes_summary.hpp"
#include "report/path_report.hpp"
#include "report/robot_report.hpp"
#include "report/simulation/simulation_summary.hpp"
#include "setup/imported_part.hpp"
#include "study/part/part_damping.hpp"
#include "study/support/robot_survey.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::report {

namespace {

/// The error that the mesh costs, by its own estimate; none where size and order were given.
std::optional<MeshEstimateSummary> estimate_of(const study::PartResult& part) {
  if (!part.estimate) return std::nullopt;
  const double tolerance = part.estimate->tolerance;
  MeshEstimateSummary result{.tolerance = tolerance > 0.0 ? std::optional(tolerance) : std::nullopt,
                             .met = part.estimate->met,
                             .max_relative_frequency_error = part.estimate->frequency,
                             .max_relative_receptance_error = part.estimate->receptance,
                             .max_relative_entry_error = part.estimate->entry,
                             .worst_receptance = part.estimate->worst_receptance,
                             .held_back_by = part.estimate->held_back_by,
                             .steps = {}};
  for (const auto& step : part.estimate->steps) {
    result.steps.push_back({.level = step.level,
                            .order = step.order,
                            .dofs = step.dofs,
                            .frequency_change_relative = step.frequency_change,
                            .receptance_change_relative = step.receptance_change});
  }
  return result;
}

MeshSummary mesh_of(const study::PartResult& part) {
  return {.nodes = part.model.nodes.positions.rows(),
          .elements = std::ssize(part.model.mesh.tets),
          .order = part.model.nodes.order,
          .dofs = part.model.K.rows(),
          .min_quality = part.min_quality,
          .worst_aspect_ratio = part.quality.aspect_ratio,
          .smallest_dihedral_deg = part.quality.smallest_dihedral_deg,
          .curved_elements = static_cast<long>(part.model.curved_elements),
          .least_jacobian = part.model.least_jacobian,
          .frequency_round_off = part.modes.round_off,
          .error_estimate = estimate_of(part)};
}

PartSummary part_of(const study::Results& results) {
  const study::PartResult& part = *results.finite_elements;
  const auto& mass = part.model.mass;
  PartSummary result{.mass_kg = mass.mass_kg,
                     .centre_m = mass.centre_m,
                     .mass_difference_relative = part.mass_difference,
                     .rigid_body_modes = part.modes.rigid_motions,
                     .modes = {},
                     .free_motions = {},
                     .mode_check = {},
                     .identified = {}};
  const std::vector<double> ratios = study::part_damping_ratios(results);
  for (Eigen::Index k = 0; k < part.modes.frequency_hz.size(); ++k) {
    result.modes.push_back({.frequency_hz = part.modes.frequency_hz(k),
                            .damping_ratio = finite(ratios[static_cast<std::size_t>(k)]),
                            .residual = part.modes.residual(k),
                            .inverse_residual = part.modes.pairs.inverse_residual(k),
                            .rigid_body = {}});
    if (k < part.modes.rigid_motions) result.modes.back().rigid_body = true;
  }
  if (!part.model.mesh.tets.empty()) result.free_motions = part.model.free_motions;
  if (const auto& check = part.modes.check) {
    result.mode_check = {.modes_counted = check->counted,
                         .below_hz = std::sqrt(std::max(check->shift, 0.0)) / (2.0 * std::numbers::pi),
                         .largest_difference_relative = check->largest_difference,
                         .of_mode = check->pair + 1};
  }
  for (const auto& found : part.identified)
    result.identified.push_back({found.frequency_hz, finite(found.damping_ratio), found.relative_misfit});
  return result;
}

ReductionSummary reduction_of(const study::PartResult& part) {
  ReductionSummary result{.error_by_size = {},
                          .estimated_receptance_error = part.estimated_receptance_error,
                          .method = "craig_bampton",
                          .interface_dofs = part.interface.W.cols(),
                          .kept_modes = part.reduced->fixed_interface_hz.size(),
                          .size = part.reduced->model.size(),
                          .full_dofs = part.model.K.rows(),
                          .max_relative_frequency_error = part.frequency_error,
                          .max_relative_receptance_error = part.receptance_error};
  for (const auto& [modes, error] : part.error_by_size) result.error_by_size.push_back({modes, error});
  return result;
}

std::vector<ModeSummary> mode_list(const dynamics::ModalModel& model) {
  std::vector<ModeSummary> modes;
  for (const int k : dynamics::oscillating_modes(model)) {
    const auto m = dynamics::summarise(model.poles(k));
    modes.push_back({m.frequency_hz, finite(m.damping_ratio)});
  }
  return modes;
}

/// The tip as it stands; what the model does not tell is absent.
RobotSummary robot_of(const setup::Setup& source, const study::Component& robot, const setup::RobotPosture& posture) {
  RobotSummary result;
  result.model = core::word_of(setup::kind(*source.robot));
  if (setup::carries_tool(source.robot)) result.carries = core::word_of(source.robot->carries);
  if (robot.modal) result.modes = mode_list(*robot.modal);
  result.posture = posture_summary(posture);
  const study::TipReport report = study::tip_report(posture, robot);
  if (!report.stiffness) return result;
  result.static_stiffness_n_per_m.emplace();
  for (const double stiffness : *report.stiffness) result.static_stiffness_n_per_m->push_back(finite(stiffness));
  result.least_static_stiffness_n_per_m.emplace(finite(*report.least_stiffness));
  result.softest_direction = report.softest;
  return result;
}

/// Modes that the first point of the cut feels: of the modal model, and those found in the receptance.
std::vector<MainModeSummary> main_modes_of(const study::Results& results) {
  const study::CouplingResult& coupled = *results.coupled;
  std::vector<MainModeSummary> modes;
  if (coupled.modal && !results.reductions.empty()) {
    for (const auto& m : study::participating_modes(*coupled.modal, results.reductions.front().dof))
      modes.push_back({m.frequency_hz, m.share, {}, {}});
  }
  for (const auto& found : coupled.identified)
    modes.push_back({found.frequency_hz, {}, finite(found.damping_ratio), found.relative_misfit});
  return modes;
}

CouplingSummary coupling_of(const setup::Setup& source, const study::Results& results) {
  const study::CouplingResult& coupled = *results.coupled;
  CouplingSummary result;
  if (coupled.modal) result.modes = mode_list(*coupled.modal);
  result.main_modes = main_modes_of(results);
  if (const auto& difference = coupled.difference)
    result.route_difference = {difference->max_relative, difference->at_frequency_hz, difference->entry};
  if (!coupled.no_spatial_route.empty()) result.no_spatial_route = coupled.no_spatial_route;
  result.regularisation =
      regularisation_summary(source.coupling.regularisation, source.coupling.threshold, coupled.receptance);
  result.kernel_condition_max = finite(coupled.receptance.kernel_condition.maxCoeff());
  for (const study::AmplitudeReduction& r : results.reductions)
    result.reductions.push_back({r.dof, r.frequency_hz, r.alone, r.supported, 1.0 - r.supported / r.alone});
  return result;
}

RowSummary row_of(const milling::LobeRow& row) {
  return {.spindle_speed_rpm = row.spindle_speed_rpm,
          .limiting_depth_m = row.limiting_depth_m,
          .at_depth_limit = row.at_limit,
          .chatter_frequency_hz = finite(row.chatter_frequency_hz),
          .bifurcation = milling::name(row.kind),
          .status = milling::name(row.status),
          .error_estimate_relative = finite(row.error_estimate)};
}

CrossingSummary crossing_of(const milling::LobePoint& point) {
  return {.depth_m = point.depth_m,
          .chatter_frequency_hz = finite(point.chatter_frequency_hz),
          .bifurcation = milling::name(point.kind),
          .unstable_change = point.unstable_change,
          .error_estimate_relative = finite(point.error_estimate)};
}

CaseSpeedSummary case_speed_of(const setup::Setup& source, const study::StructureLobes& named) {
  CaseSpeedSummary row{row_of(*named.at_spindle_speed), {}, sensitivities_summary(named.sensitivities), {}, {}};
  for (const auto& point : named.at_spindle_speed->crossings) row.crossings.push_back(crossing_of(point));
  if (named.error_at_spindle_speed)
    row.error_budget = row_errors_summary(*named.error_at_spindle_speed, named.scatter, source.lobes->seed);
  if (const auto& contact = named.contact) row.contact = {contact->preload_n, contact->lost_above_m};
  return row;
}

LobesSummary lobes_of(const setup::Setup& source, const study::StructureLobes& named) {
  const milling::Lobes& lobes = named.lobes;
  const auto deepest = std::ranges::max_element(lobes.rows, {}, &milling::LobeRow::limiting_depth_m);
  LobesSummary result;
  result.name = named.of;
  result.method = lobes.method;
  result.minimum_depth_m = lobes.minimum_depth_m;
  result.at_spindle_speed_rpm = lobes.at_spindle_speed_rpm;
  result.maximum = row_of(*deepest);
  result.error_estimate_relative = finite(lobes.worst_error_estimate);
  result.static_share = finite(lobes.residual_share);
  if (source.part) result.modes_up_to_hz = source.lobes->modes_up_to_hz;
  result.speeds = std::ssize(lobes.rows);
  result.speeds_stable_to_depth_limit = lobes.rows_at_limit;
  result.speeds_not_converged = lobes.rows_not_converged;
  result.main_modes_hz = named.main_modes_hz;
  result.best_pockets = pockets_summary(source, named.pockets);
  add_what_was_asked(result, source, named);
  const auto& pockets = result.robust ? result.robust->best_pockets : result.best_pockets;
  if (!pockets.empty()) result.best_pocket = pockets.front();
  result.error_budget = chart_errors_summary(named);
  if (named.at_spindle_speed) result.at_case_speed = case_speed_of(source, named);
  if (const auto& doubtful = named.doubtful)
    result.below_first_resonance = {doubtful->chatter_frequency_hz, doubtful->first_resonance_hz};
  return result;
}

ForcedVibrationSummary forced_of(const milling::ForcedVibration& v) {
  return {.surface_location_error_m = v.surface_location_error_m,
          .peak_force_n = v.peak_force_n,
          .peak_torque_n_m = v.peak_torque_n_m,
          .mean_power_w = v.mean_power_w,
          .peak_to_peak_m = v.peak_to_peak_m,
          .status = milling::name(v.status),
          .error_estimate_relative = finite(v.error_estimate)};
}

OperatingPointSummary operating_point_of(study::ChartOf chart, const study::PointStability& found) {
  const auto& boundary = found.depth.boundary;
  OperatingPointSummary result;
  result.chart = chart;
  result.spindle_speed_rpm = found.point.spindle_speed_rpm;
  result.depth_m = found.point.depth_m;
  result.stable = found.stable;
  result.depth_margin_m = found.depth.margin_m;
  result.depth_margin_relative = found.depth.margin_m / found.point.depth_m;
  result.depth_margin_at_limit = found.depth.at_limit;
  result.boundary_below_rpm = found.speed.below_rpm;
  result.boundary_above_rpm = found.speed.above_rpm;
  result.status = milling::name(found.status);
  if (const auto& multiplier = found.multiplier) {
    result.multiplier_modulus = multiplier->modulus;
    result.multiplier_error_estimate_relative = finite(multiplier->error_estimate);
    result.chatter_frequency_hz = finite(multiplier->chatter_frequency_hz);
    result.bifurcation = milling::name(multiplier->kind);
  } else if (!found.depth.at_limit) {
    result.chatter_frequency_hz = finite(boundary.chatter_frequency_hz);
    result.bifurcation = milling::name(boundary.kind);
  }
  if (!found.depth.at_limit) result.depth_error_estimate_relative = finite(boundary.error_estimate);
  if (found.forced) result.forced_vibration = forced_of(*found.forced);
  if (const auto& force = found.contact)
    result.contact = {force->preload_n, force->least_n, force->largest_n, force->lost};
  result.sensitivities = sensitivities_summary(found.sensitivities);
  return result;
}

UpdatingSummary updating_of(const study::UpdatingResult& fit) {
  UpdatingSummary result{fit.name, fit.evaluations, fit.converged, {}, {}};
  for (const auto& p : fit.parameters)
    result.parameters.push_back({p.key, p.unit, p.start, p.fitted, p.lower, p.upper, p.at_bound});
  for (const auto& t : fit.targets) result.targets.push_back({t.quantity, t.wanted, t.reached, t.sensitivity});
  return result;
}

/// Directions in which contacts hold a point of the part: those of springs that resist.
std::vector<Eigen::Vector3d> joined_at(const std::string& point, const std::vector<setup::JoinedContact>& contacts) {
  std::vector<Eigen::Vector3d> joined;
  for (const setup::JoinedContact& contact : contacts) {
    if (contact.contact.point_a != point) continue;
    const auto& springs = contact.contact.springs;
    for (std::size_t i = 0; i < springs.size(); ++i) {
      const ContactAlong here = along(contact.contact, i);
      if (here.stiffness != 0.0 || here.damping != 0.0) joined.push_back(springs[i].direction);
    }
  }
  return joined;
}

/// The named points of a part whose shape is known.
std::vector<PointSummary> points_of(const setup::Setup& source, const std::vector<setup::JoinedContact>& contacts) {
  std::vector<PointSummary> points;
  if (!source.part) return points;
  for (const setup::Point& p : source.points) {
    const Eigen::Vector3d x = setup::position(*source.part, p);
    if (!x.allFinite()) continue;
    const bool touched = std::ranges::count(source.contacts, p.name, &setup::SupportContact::part_point) > 0;
    points.push_back({p.name, x, p.patch_radius, touched, p.directions, joined_at(p.name, contacts)});
  }
  return points;
}

}  // namespace

Summary summary_of(const setup::Setup& source, const study::Results& results) {
  Summary summary;
  for (const auto& fit : results.updating) summary.updating.push_back(updating_of(fit));
  if (source.part && source.part->imported) summary.geometry = geometry_summary(*source.part);
  if (results.finite_elements) {
    if (!results.finite_elements->model.mesh.tets.empty()) summary.mesh = mesh_of(*results.finite_elements);
    summary.part = part_of(results);
    if (results.finite_elements->reduced) summary.reduction = reduction_of(*results.finite_elements);
  }
  summary.points = points_of(source, results.contacts);
  if (results.robot) summary.robot = robot_of(source, *results.robot, *results.robot_posture);
  summary.contacts = contacts_summary(results);
  if (results.coupled) summary.coupling = coupling_of(source, results);
  summary.error_budget = error_budget_summary(results);
  if (!results.lobes.empty()) summary.cutting = cutting_summary(source);
  for (const auto& lobes : results.lobes) summary.lobes.push_back(lobes_of(source, lobes));
  for (const auto& path : results.path) summary.path.push_back(path_summary(source, path));
  for (const auto& lobes : results.lobes) {
    for (const auto& point : lobes.points) summary.operating_points.push_back(operating_point_of(lobes.of, point));
  }
  summary.simulation = simulation_summary(results);
  summary.sentences = answer_sentences(summary);
  summary.timings_s.insert(results.timings_s.begin(), results.timings_s.end());
  return summary;
}

}  // namespace thinwall::report
