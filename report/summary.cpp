#include "report/summary.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "milling/direct/stability.hpp"
#include "report/contact_report.hpp"
#include "report/error_summary.hpp"
#include "report/finite_number.hpp"
#include "report/geometry_summary.hpp"
#include "report/lobes_answers.hpp"
#include "report/lobes_summary.hpp"
#include "report/path_report.hpp"
#include "report/robot_report.hpp"
#include "setup/imported_part.hpp"
#include "study/part/part_damping.hpp"
#include "study/support/robot_survey.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

json mode(double frequency_hz, double damping_ratio) {
  return {{"frequency_hz", frequency_hz}, {"damping_ratio", finite(damping_ratio)}};
}

/// The error that the mesh costs, by its own estimate; null where size and order were given.
json estimate_of(const study::PartResult& part) {
  if (!part.estimate) return nullptr;
  json steps = json::array();
  for (const auto& step : part.estimate->steps) {
    json entry = {{"level", step.level}, {"order", step.order}, {"dofs", step.dofs}};
    entry["frequency_change_relative"] = step.frequency_change ? finite(*step.frequency_change) : json(nullptr);
    entry["receptance_change_relative"] = step.receptance_change ? finite(*step.receptance_change) : json(nullptr);
    steps.push_back(entry);
  }
  return {{"tolerance", part.estimate->tolerance},
          {"met", part.estimate->met},
          {"max_relative_frequency_error", part.estimate->frequency},
          {"max_relative_receptance_error", part.estimate->receptance},
          {"steps", steps}};
}

json mesh_of(const study::PartResult& part) {
  return {{"nodes", part.model.nodes.positions.rows()},
          {"elements", part.model.mesh.tets.size()},
          {"order", part.model.nodes.order},
          {"dofs", part.model.K.rows()},
          {"min_quality", part.min_quality},
          {"worst_aspect_ratio", part.quality.aspect_ratio},
          {"smallest_dihedral_deg", part.quality.smallest_dihedral_deg},
          {"curved_elements", part.model.curved_elements},
          {"least_jacobian", part.model.least_jacobian},
          {"frequency_round_off", part.modes.round_off},
          {"error_estimate", estimate_of(part)}};
}

json part_of(const study::Results& results) {
  const study::PartResult& part = *results.finite_elements;
  json modes = json::array();
  const std::vector<double> ratios = study::part_damping_ratios(results);
  for (Eigen::Index k = 0; k < part.modes.frequency_hz.size(); ++k) {
    json entry = mode(part.modes.frequency_hz(k), ratios[static_cast<std::size_t>(k)]);
    entry["residual"] = part.modes.residual(k);
    entry["inverse_residual"] = part.modes.pairs.inverse_residual(k);
    if (k < part.modes.rigid_motions) entry["rigid_body"] = true;
    modes.push_back(entry);
  }
  const auto& mass = part.model.mass;
  json result = {{"mass_kg", mass.mass_kg},
                 {"centre_m", {mass.centre_m.x(), mass.centre_m.y(), mass.centre_m.z()}},
                 {"mass_difference_relative", part.mass_difference},
                 {"rigid_body_modes", part.modes.rigid_motions},
                 {"modes", modes}};
  if (!part.model.mesh.tets.empty()) result["free_motions"] = part.model.free_motions;
  if (const auto& check = part.modes.check) {
    result["mode_check"] = {{"modes_counted", check->counted},
                            {"below_hz", std::sqrt(check->shift) / (2.0 * std::numbers::pi)},
                            {"largest_difference_relative", check->largest_difference},
                            {"of_mode", check->pair + 1}};
  }
  for (const auto& found : part.identified) {
    json entry = mode(found.frequency_hz, found.damping_ratio);
    entry["relative_misfit"] = found.relative_misfit;
    result["identified"].push_back(entry);
  }
  return result;
}

json reduction_of(const study::PartResult& part) {
  const auto& estimated = part.estimated_receptance_error;
  json by_size = json::array();
  for (const auto& [modes, error] : part.error_by_size)
    by_size.push_back({{"kept_modes", modes}, {"max_relative_frequency_error", error}});
  return {{"error_by_size", by_size},
          {"estimated_receptance_error", estimated ? json(*estimated) : json(nullptr)},
          {"method", "craig_bampton"},
          {"interface_dofs", part.interface.W.cols()},
          {"kept_modes", part.reduced->fixed_interface_hz.size()},
          {"size", part.reduced->model.size()},
          {"full_dofs", part.model.K.rows()},
          {"max_relative_frequency_error", part.frequency_error},
          {"max_relative_receptance_error", part.receptance_error ? json(*part.receptance_error) : json(nullptr)}};
}

json mode_list(const dynamics::ModalModel& model) {
  json modes = json::array();
  for (const int k : dynamics::oscillating_modes(model)) {
    const auto m = dynamics::summarise(model.poles(k));
    modes.push_back(mode(m.frequency_hz, m.damping_ratio));
  }
  return modes;
}

/// The tip as it stands; what the model does not tell is absent.
json robot_of(const setup::Setup& source, const study::Component& robot, const setup::RobotPosture& posture) {
  json result = {{"model", core::word_of(setup::kind(*source.robot))},
                 {"modes", robot.modal ? mode_list(*robot.modal) : json::array()}};
  result.update(posture_summary(posture));
  const study::TipReport report = study::tip_report(posture, robot);
  if (!report.stiffness) return result;
  result["static_stiffness_n_per_m"] = json::array();
  for (const double stiffness : *report.stiffness) result["static_stiffness_n_per_m"].push_back(finite(stiffness));
  result["least_static_stiffness_n_per_m"] = finite(*report.least_stiffness);
  result["softest_direction"] = report.softest;
  return result;
}

json coupling_of(const setup::Setup& source, const study::Results& results) {
  const study::CouplingResult& coupled = *results.coupled;
  json result;
  result["modes"] = coupled.modal ? mode_list(*coupled.modal) : json::array();
  result["main_modes"] = json::array();
  if (coupled.modal && !results.reductions.empty()) {
    for (const auto& m : study::participating_modes(*coupled.modal, results.reductions.front().dof)) {
      result["main_modes"].push_back({{"frequency_hz", m.frequency_hz}, {"static_share_m_per_n", m.share}});
    }
  }
  for (const auto& found : coupled.identified) {
    json entry = mode(found.frequency_hz, found.damping_ratio);
    entry["relative_misfit"] = found.relative_misfit;
    result["main_modes"].push_back(entry);
  }
  if (coupled.difference) {
    result["route_difference"] = {{"max_relative", coupled.difference->max_relative},
                                  {"at_frequency_hz", coupled.difference->at_frequency_hz},
                                  {"entry", coupled.difference->entry}};
  } else {
    result["route_difference"] = nullptr;
  }
  if (!coupled.no_spatial_route.empty()) result["no_spatial_route"] = coupled.no_spatial_route;
  result["regularisation"] =
      regularisation_summary(source.coupling.regularisation, source.coupling.threshold, coupled.receptance);
  result["kernel_condition_max"] = finite(coupled.receptance.kernel_condition.maxCoeff());
  result["reductions"] = json::array();
  for (const study::AmplitudeReduction& r : results.reductions) {
    result["reductions"].push_back({{"dof", r.dof},
                                    {"frequency_hz", r.frequency_hz},
                                    {"alone_m_per_n", r.alone},
                                    {"supported_m_per_n", r.supported},
                                    {"reduction", 1.0 - r.supported / r.alone}});
  }
  return result;
}

json row_of(const milling::LobeRow& row) {
  return {{"spindle_speed_rpm", row.spindle_speed_rpm},
          {"limiting_depth_m", row.limiting_depth_m},
          {"at_depth_limit", row.at_limit},
          {"chatter_frequency_hz", finite(row.chatter_frequency_hz)},
          {"bifurcation", milling::name(row.kind)},
          {"status", milling::name(row.status)},
          {"error_estimate_relative", finite(row.error_estimate)}};
}

json crossing_of(const milling::LobePoint& point) {
  return {{"depth_m", point.depth_m},
          {"chatter_frequency_hz", finite(point.chatter_frequency_hz)},
          {"bifurcation", milling::name(point.kind)},
          {"unstable_change", point.unstable_change},
          {"error_estimate_relative", finite(point.error_estimate)}};
}

json lobes_of(const setup::Setup& source, const study::NamedLobes& named) {
  const milling::Lobes& lobes = named.lobes;
  const auto deepest = std::max_element(lobes.rows.begin(), lobes.rows.end(), [](const auto& a, const auto& b) {
    return a.limiting_depth_m < b.limiting_depth_m;
  });
  json result = {{"name", named.name},
                 {"method", lobes.method},
                 {"minimum_depth_m", lobes.minimum_depth_m},
                 {"at_spindle_speed_rpm", lobes.at_spindle_speed_rpm},
                 {"maximum", row_of(*deepest)},
                 {"error_estimate_relative", finite(lobes.worst_error_estimate)},
                 {"static_share", finite(lobes.residual_share)},
                 {"speeds", lobes.rows.size()},
                 {"speeds_stable_to_depth_limit", lobes.rows_at_limit},
                 {"speeds_not_converged", lobes.rows_not_converged}};
  result["main_modes_hz"] = named.main_modes_hz;
  result["best_pockets"] = pockets_summary(source, named.pockets);
  add_what_was_asked(result, source, named);
  result["error_budget"] = chart_errors_summary(named);
  if (named.at_spindle_speed) {
    json row = row_of(*named.at_spindle_speed);
    for (const auto& point : named.at_spindle_speed->crossings) row["crossings"].push_back(crossing_of(point));
    row["sensitivities"] = sensitivities_summary(named.sensitivities);
    if (named.error_at_spindle_speed)
      row["error_budget"] = row_errors_summary(*named.error_at_spindle_speed, named.scatter, source.lobes->seed);
    result["at_case_speed"] = std::move(row);
  }
  return result;
}

json forced_of(const milling::ForcedVibration& v) {
  const auto& q = v.peak_to_peak_m;
  return {{"surface_location_error_m", v.surface_location_error_m ? json(*v.surface_location_error_m) : json(nullptr)},
          {"peak_force_n", v.peak_force_n},
          {"peak_torque_n_m", v.peak_torque_n_m},
          {"mean_power_w", v.mean_power_w},
          {"peak_to_peak_m", {q.x(), q.y(), q.z()}},
          {"status", milling::name(v.status)},
          {"error_estimate_relative", finite(v.error_estimate)}};
}

json point_of(const std::string& chart, const study::PointStability& found) {
  const double depth = found.point.depth_m;
  const bool by_poles = found.multiplier.has_value();
  const auto& boundary = found.depth.boundary;
  const auto known = [](const auto& value) { return value ? json(*value) : json(nullptr); };
  json result = {{"chart", chart},
                 {"spindle_speed_rpm", found.point.spindle_speed_rpm},
                 {"depth_m", depth},
                 {"stable", found.stable},
                 {"multiplier_modulus", by_poles ? json(found.multiplier->modulus) : json(nullptr)},
                 {"depth_margin_m", found.depth.margin_m},
                 {"depth_margin_relative", found.depth.margin_m / depth},
                 {"depth_margin_at_limit", found.depth.at_limit},
                 {"boundary_below_rpm", known(found.speed.below_rpm)},
                 {"boundary_above_rpm", known(found.speed.above_rpm)},
                 {"status", milling::name(found.status)}};
  result["multiplier_error_estimate_relative"] = by_poles ? finite(found.multiplier->error_estimate) : json(nullptr);
  const bool frequency = by_poles || !found.depth.at_limit;
  result["chatter_frequency_hz"] =
      !frequency ? json(nullptr)
                 : finite(by_poles ? found.multiplier->chatter_frequency_hz : boundary.chatter_frequency_hz);
  result["bifurcation"] =
      !frequency ? json(nullptr) : json(milling::name(by_poles ? found.multiplier->kind : boundary.kind));
  result["depth_error_estimate_relative"] = found.depth.at_limit ? json(nullptr) : finite(boundary.error_estimate);
  result["forced_vibration"] = found.forced ? forced_of(*found.forced) : json(nullptr);
  if (found.contact) {
    result["contact"] = {{"preload_n", found.contact->preload_n},
                         {"least_force_n", found.contact->least_n},
                         {"largest_force_n", found.contact->largest_n},
                         {"lost", found.contact->lost}};
  }
  result["sensitivities"] = sensitivities_summary(found.sensitivities);
  return result;
}

json updating_of(const study::UpdatingResult& fit) {
  json result = {{"name", fit.name}, {"evaluations", fit.evaluations}, {"converged", fit.converged}};
  for (const auto& p : fit.parameters) {
    result["parameters"].push_back({{"key", p.key},
                                    {"unit", p.unit},
                                    {"start", p.start},
                                    {"fitted", p.fitted},
                                    {"lower", p.lower},
                                    {"upper", p.upper},
                                    {"at_bound", p.at_bound}});
  }
  for (const auto& t : fit.targets) {
    result["targets"].push_back(
        {{"quantity", t.quantity}, {"wanted", t.wanted}, {"reached", t.reached}, {"sensitivity", t.sensitivity}});
  }
  return result;
}

/// Directions in which contacts hold a point of the part: those of springs that resist.
json joined_at(const std::string& point, const std::vector<setup::JoinedContact>& contacts) {
  json joined = json::array();
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
json points_of(const setup::Setup& source, const std::vector<setup::JoinedContact>& contacts) {
  json points = json::array();
  if (!source.part) return points;
  for (const setup::Point& p : source.points) {
    const Eigen::Vector3d x = setup::position(*source.part, p);
    if (!x.allFinite()) continue;
    const bool touched = std::ranges::count(source.contacts, p.name, &setup::Contact::part_point) > 0;
    points.push_back({{"name", p.name}, {"position_m", x}, {"patch_radius_m", p.patch_radius}, {"contact", touched}});
    points.back()["directions"] = json::array();
    for (const Eigen::Vector3d& direction : p.directions) points.back()["directions"].push_back(direction);
    points.back()["joined"] = joined_at(p.name, contacts);
  }
  return points;
}

}  // namespace

json summary_of(const setup::Setup& source, const study::Results& results) {
  json summary = {{"schema", 1}, {"case", ""}, {"title", ""}, {"status", "ok"}};
  summary["updating"] = json::array();
  for (const auto& fit : results.updating) summary["updating"].push_back(updating_of(fit));
  if (source.part && source.part->imported) summary["geometry"] = geometry_summary(*source.part);
  if (results.finite_elements) {
    if (!results.finite_elements->model.mesh.tets.empty()) summary["mesh"] = mesh_of(*results.finite_elements);
    summary["part"] = part_of(results);
    if (results.finite_elements->reduced) summary["reduction"] = reduction_of(*results.finite_elements);
  }
  summary["points"] = points_of(source, results.contacts);
  if (results.robot) summary["robot"] = robot_of(source, *results.robot, *results.robot_posture);
  summary["contacts"] = contacts_summary(results);
  if (results.coupled) summary["coupling"] = coupling_of(source, results);
  summary["error_budget"] = error_budget_summary(results);
  if (!results.lobes.empty()) summary["cutting"] = cutting_summary(source);
  summary["lobes"] = json::array();
  for (const auto& lobes : results.lobes) summary["lobes"].push_back(lobes_of(source, lobes));
  for (const auto& path : results.path) summary["path"].push_back(path_summary(source, path));
  summary["operating_points"] = json::array();
  for (const auto& lobes : results.lobes) {
    for (const auto& point : lobes.points) summary["operating_points"].push_back(point_of(lobes.name, point));
  }
  summary["sentences"] = answer_sentences(summary);
  summary["checks"] = json::array();
  summary["timings_s"] = json::object();
  for (const auto& [stage, seconds] : results.timings_s) summary["timings_s"][stage] = seconds;
  return summary;
}

}  // namespace thinwall::report
