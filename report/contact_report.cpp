#include "report/contact_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "report/finite_number.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

json rows_of(const Eigen::MatrixXd& matrix) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    json row = json::array();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) row.push_back(finite(matrix(i, j)));
    rows.push_back(row);
  }
  return rows;
}

json identified_of(const study::ContactIdentification& identification) {
  const coupling::IdentifiedJoint& found = identification.found;
  json result = {{"stiffness_n_per_m", rows_of(found.joint.K)},
                 {"stiffness_half_width_n_per_m", rows_of(found.half_width.K)},
                 {"damping_n_s_per_m", rows_of(found.joint.C)},
                 {"damping_half_width_n_s_per_m", rows_of(found.half_width.C)},
                 {"lines_used", rows_of(found.lines_used.cast<double>())},
                 {"lines", identification.lines},
                 {"from_hz", identification.from_hz},
                 {"to_hz", identification.to_hz},
                 {"chi_squared", finite(found.chi_squared)},
                 {"damping_raised", identification.damping_raised},
                 {"status", "identified"}};
  result["loss_factor"] = found.loss_factor.size() > 0 ? rows_of(found.loss_factor) : json(nullptr);
  result["loss_factor_half_width"] =
      found.loss_factor.size() > 0 ? rows_of(found.loss_factor_half_width) : json(nullptr);
  return result;
}

json contact_of(const setup::JoinedContact& joined) {
  const coupling::Contact& contact = joined.contact;
  json result = {{"part", contact.point_a}, {"robot", contact.point_b}, {"model", joined.model}};
  for (std::size_t i = 0; i < contact.springs.size(); ++i) {
    const ContactAlong values = along(contact, i);
    const Eigen::Vector3d& n = contact.springs[i].direction;
    result["directions"].push_back({n.x(), n.y(), n.z()});
    result["stiffness_n_per_m"].push_back(finite(values.stiffness));
    result["damping_n_s_per_m"].push_back(values.damping);
    result["loss_factor"].push_back(values.loss_factor);
  }
  if (joined.preload_n) result["preload_n"] = *joined.preload_n;
  if (joined.hertz) {
    result["hertz"] = {{"contact_radius_m", joined.hertz->contact_radius},
                       {"approach_m", joined.hertz->approach},
                       {"peak_pressure_pa", joined.hertz->peak_pressure}};
  }
  return result;
}

/// "x", "-z" or "(0.60, 0.80, 0.00)".
std::string direction_text(const json& direction) {
  const Eigen::Vector3d n(direction[0].get<double>(), direction[1].get<double>(), direction[2].get<double>());
  for (int axis = 0; axis < 3; ++axis) {
    const char letter = static_cast<char>('x' + axis);
    if (n == Eigen::Vector3d::Unit(axis)) return {letter};
    if (n == -Eigen::Vector3d::Unit(axis)) return {'-', letter};
  }
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", n.x(), n.y(), n.z());
}

std::string spring_text(const json& contact, std::size_t i) {
  if (contact["stiffness_n_per_m"][i].is_null()) return "rigid";
  std::string text = fmt::format("{:.4g} N/m", contact["stiffness_n_per_m"][i].get<double>());
  const double damping = contact["damping_n_s_per_m"][i].get<double>(), loss = contact["loss_factor"][i].get<double>();
  if (damping > 0.0) text += fmt::format(", {:.4g} N s/m", damping);
  if (loss > 0.0) text += fmt::format(", loss factor {:.3g}", loss);
  return text;
}

std::string cause_text(const json& contact) {
  if (!contact.contains("preload_n")) return "";
  std::string text =
      fmt::format(" ({}, {:.4g} N", contact["model"].get<std::string>(), contact["preload_n"].get<double>());
  if (contact.contains("hertz")) {
    const json& ball = contact["hertz"];
    text += fmt::format("; radius {:.3g} mm, peak pressure {:.4g} MPa", ball["contact_radius_m"].get<double>() * 1e3,
                        ball["peak_pressure_pa"].get<double>() * 1e-6);
  }
  return text + ")";
}

/// "1.02e6 ± 3e3" of the entry (i, j).
std::string interval(const json& found, const char* value, const char* half_width, std::size_t i, std::size_t j) {
  return fmt::format("{:.5g} ± {:.2g}", found[value][i][j].get<double>(), found[half_width][i][j].get<double>());
}

std::string identified_text(const json& contact) {
  const json& found = contact["identified"];
  const std::size_t n = contact["directions"].size();
  std::string text;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      const std::string entry =
          direction_text(contact["directions"][i]) + (i == j ? "" : "/" + direction_text(contact["directions"][j]));
      text += fmt::format("    found along {}: {} N/m", entry,
                          interval(found, "stiffness_n_per_m", "stiffness_half_width_n_per_m", i, j));
      if (found["damping_half_width_n_s_per_m"][i][j] != 0.0)
        text += ", " + interval(found, "damping_n_s_per_m", "damping_half_width_n_s_per_m", i, j) + " N s/m";
      if (i == j && !found["loss_factor"].is_null())  // between directions K may be zero
        text += ", loss factor " + interval(found, "loss_factor", "loss_factor_half_width", i, j);
      text += fmt::format(" (95 %), {:.0f} of {} lines\n", found["lines_used"][i][j].get<double>(),
                          found["lines"].get<int>());
    }
  }
  return text + fmt::format("    from FRFs of the assembly, {:.4g} to {:.4g} Hz; residuals {:.2g} times the noise\n",
                            found["from_hz"].get<double>(), found["to_hz"].get<double>(),
                            std::sqrt(found["chi_squared"].get<double>()));
}

}  // namespace

ContactAlong along(const coupling::Contact& contact, std::size_t direction) {
  const coupling::ContactSpring& spring = contact.springs[direction];
  if (!contact.has_matrices()) return {spring.stiffness, spring.damping, spring.loss_factor};
  const auto i = static_cast<Eigen::Index>(direction);
  const coupling::JointMatrices& joint = contact.matrices;
  return {joint.K(i, i), joint.C.size() > 0 ? joint.C(i, i) : 0.0,
          joint.D.size() > 0 ? joint.D(i, i) / joint.K(i, i) : 0.0};
}

json contacts_summary(const study::Results& results) {
  json list = json::array();
  for (const setup::JoinedContact& contact : results.contacts) list.push_back(contact_of(contact));
  if (results.identification) list.front()["identified"] = identified_of(*results.identification);
  return list;
}

json regularisation_summary(coupling::Regularisation regularisation, double threshold,
                            const coupling::CoupledResponse& receptance) {
  if (regularisation == coupling::Regularisation::none) return nullptr;
  Eigen::Index most = 0, widest = 0;
  const int dropped = receptance.dropped.maxCoeff(&most);
  const double residual = receptance.compatibility_residual.maxCoeff(&widest);
  const auto hz = [&](Eigen::Index line) { return receptance.response.axis.hz(line); };
  return {{"method", core::word_of(regularisation)},
          {"threshold", threshold},
          {"lines", receptance.dropped.size()},
          {"lines_with_dropped", (receptance.dropped.array() > 0).count()},
          {"most_dropped", dropped},
          {"most_dropped_at_hz", dropped > 0 ? json(hz(most)) : json(nullptr)},
          {"compatibility_residual_max", finite(residual)},
          {"compatibility_residual_at_hz", hz(widest)}};
}

std::string contacts_text(const json& summary) {
  std::string text;
  for (const json& contact : summary["contacts"]) {
    std::string list;
    for (std::size_t i = 0; i < contact["directions"].size(); ++i)
      list += (i == 0 ? "" : "; ") + direction_text(contact["directions"][i]) + " " + spring_text(contact, i);
    text += fmt::format("  contact     {}-{}: {}{}\n", contact["part"].get<std::string>(),
                        contact["robot"].get<std::string>(), list, cause_text(contact));
    if (contact.contains("identified")) text += identified_text(contact);
  }
  return text;
}

}  // namespace thinwall::report
