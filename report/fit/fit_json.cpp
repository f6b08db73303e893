#include "report/fit/fit_json.hpp"

#include "identification/fitted_model.hpp"

namespace thinwall::report {

namespace {

using identification::FittedMode;
using nlohmann::json;

json matrix_json(const Eigen::MatrixXd& values) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < values.cols(); ++j) row.push_back(values(i, j));
    rows.push_back(row);
  }
  return rows;
}

json mode_json(const FittedMode& mode, const std::optional<identification::PointMode>& point) {
  const Interval f = interval(mode.frequency_hz, mode.sd_ln_frequency),
                 z = interval(mode.damping_ratio, mode.sd_ln_damping);
  json entry{{"frequency_hz", mode.frequency_hz},
             {"frequency_95_hz", {f.low, f.high}},
             {"damping_ratio", mode.damping_ratio},
             {"damping_ratio_95", {z.low, z.high}},
             {"second_singular", mode.second_singular},
             {"residue_re", matrix_json(mode.residue.real())},
             {"residue_im", matrix_json(mode.residue.imag())}};
  if (point) {
    entry["mass_kg"] = point->mass_kg;
    entry["stiffness_n_m"] = point->stiffness_N_m;
    entry["direction"] = std::vector<double>(point->direction.begin(), point->direction.end());
  }
  return entry;
}

}  // namespace

Eigen::MatrixXd mac_of_residues(const std::vector<FittedMode>& modes) {
  Eigen::MatrixXd mac(static_cast<Eigen::Index>(modes.size()), static_cast<Eigen::Index>(modes.size()));
  for (Eigen::Index i = 0; i < mac.rows(); ++i) {
    for (Eigen::Index j = 0; j < mac.cols(); ++j) {
      const Eigen::MatrixXcd &a = modes[static_cast<std::size_t>(i)].residue,
                             &b = modes[static_cast<std::size_t>(j)].residue;
      mac(i, j) = std::norm(a.reshaped().dot(b.reshaped())) / (a.squaredNorm() * b.squaredNorm());
    }
  }
  return mac;
}

json fit_json(const FitReport& found) {
  const identification::ModalFit& fit = found.fit.found.fit;
  const auto points = identification::point_modes(fit, found.measured.responses, found.measured.forces);
  json document{
      {"modes", json::array()},
      {"chi2_per_dof", fit.chi2_per_dof()},
      {"converged", fit.converged},
      {"weights", core::word_of(found.fit.weights)},
      {"terms", {{"inertia", found.fit.found.terms.inertia}, {"highest_power", found.fit.found.terms.highest_power}}},
      {"lines",
       {{"count", found.fit.lines.lines()},
        {"from_hz", found.fit.lines.hz(0)},
        {"to_hz", found.fit.lines.hz(found.fit.lines.lines() - 1)}}},
      {"misfit", matrix_json(found.fit.misfit)},
      {"mac", matrix_json(mac_of_residues(fit.modes))},
      {"warnings", found.doubts}};
  if (found.fit.passive)
    document["passive"] = {{"before", found.fit.passive->before},
                           {"after", found.fit.passive->after},
                           {"moved", found.fit.passive->moved}};
  for (std::size_t r = 0; r < fit.modes.size(); ++r) document["modes"].push_back(mode_json(fit.modes[r], points[r]));
  for (const auto& [key, dofs] :
       {std::pair{"responses", &found.measured.responses}, {"forces", &found.measured.forces}}) {
    document[key] = json::array();
    for (const dynamics::Dof& dof : *dofs) document[key].push_back(dynamics::name(dof));
  }
  return document;
}

}  // namespace thinwall::report
