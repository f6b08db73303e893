#include "report/model_report_json.hpp"

#include <cmath>

namespace thinwall::report {

namespace {

using nlohmann::json;

json number_or_null(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

json numbers_json(const Eigen::Ref<const Eigen::VectorXd>& values) {
  json result = json::array();
  for (const double value : values) result.push_back(number_or_null(value));
  return result;
}

json effective_mass_json(const reduction::EffectiveMass& effective) {
  if (!effective.available) return nullptr;
  json modes = json::array();
  for (Eigen::Index k = 0; k < effective.mass.rows(); ++k) {
    modes.push_back({{"frequency_hz", number_or_null(effective.frequency_hz(k))},
                     {"kg_and_kg_m2", numbers_json(effective.mass.row(k).transpose())}});
  }
  return {{"modes_with_interface_held", modes},
          {"interface_own", numbers_json(effective.interface_own)},
          {"rigid_body", numbers_json(effective.total)},
          {"closure_relative", number_or_null(effective.closure)}};
}

json rigid_json(const reduction::RigidBodyState& rigid) {
  json known = {{"motions_seen", rigid.sets.seen},
                {"free_motions", rigid.free_motions},
                {"free_motions_in_words", rigid.in_words}};
  if (rigid.sets.seen != 6) return known;
  json inertia = json::array();
  for (int i = 0; i < 3; ++i) inertia.push_back(numbers_json(rigid.body.inertia_kg_m2.row(i).transpose()));
  json result = {{"mass_kg", number_or_null(rigid.body.mass_kg)},
                 {"centre_m", numbers_json(rigid.body.centre_m)},
                 {"inertia_about_centre_kg_m2", inertia},
                 {"reference_m", numbers_json(rigid.reference)},
                 {"grounding_n_per_m_and_n_m_per_rad", numbers_json(rigid.grounding_stiffness)},
                 {"grounding_hz", numbers_json(rigid.grounding_hz)},
                 {"geometry_misfit", number_or_null(rigid.sets.geometry_misfit)},
                 {"stiffness_disagreement", number_or_null(rigid.sets.stiffness_disagreement)},
                 {"eigen_disagreement", number_or_null(rigid.sets.eigen_disagreement)},
                 {"mass_disagreement", number_or_null(rigid.mass_disagreement)},
                 {"effective_mass", effective_mass_json(rigid.effective)}};
  result.update(known);
  return result;
}

}  // namespace

json report_json(const reduction::ReducedModelReport& report) {
  json result = {{"trustworthy", report.trustworthy()},
                 {"coordinates", report.coordinates},
                 {"translations", report.translations},
                 {"rotations", report.rotations},
                 {"amplitudes", report.amplitudes},
                 {"reciprocity_relative", number_or_null(report.reciprocity)},
                 {"least_power_relative", number_or_null(report.least_power)}};
  result["findings"] = json::array();
  for (const auto& found : report.findings) {
    result["findings"].push_back({{"name", found.name},
                                  {"value", number_or_null(found.value)},
                                  {"bound", number_or_null(found.bound)},
                                  {"ok", found.ok},
                                  {"advice", found.ok ? json(nullptr) : json(found.advice)}});
  }
  result["matrices"] = json::array();
  for (const auto& matrix : report.matrices) {
    result["matrices"].push_back({{"name", matrix.name},
                                  {"asymmetry", number_or_null(matrix.asymmetry)},
                                  {"least_eigenvalue_scaled", number_or_null(matrix.least)},
                                  {"negative_eigenvalues", matrix.negative},
                                  {"zero_eigenvalues", matrix.zero}});
  }
  result["frequencies_hz"] = json::array();
  for (const double hz : report.frequencies_hz) result["frequencies_hz"].push_back(number_or_null(hz));
  result["modes_without_energy"] = {{"count", report.without_energy.count},
                                    {"highest_hz", number_or_null(report.without_energy.highest_hz)}};
  result["rigid_body"] = report.rigid ? rigid_json(*report.rigid) : json(nullptr);
  return result;
}

}  // namespace thinwall::report
