#include "report/contact_report.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <limits>

#include "report/finite_number.hpp"

namespace thinwall::report {

namespace {

EntryRows rows_of(const Eigen::MatrixXd& matrix) {
  EntryRows rows;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    rows.emplace_back();
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) rows.back().push_back(finite(matrix(i, j)));
  }
  return rows;
}

IdentifiedContactSummary identified_of(const study::ContactIdentification& identification) {
  const coupling::IdentifiedJoint& found = identification.found;
  IdentifiedContactSummary result;
  result.stiffness_n_per_m = rows_of(found.joint.K);
  result.stiffness_half_width_n_per_m = rows_of(found.half_width.K);
  result.damping_n_s_per_m = rows_of(found.joint.C);
  result.damping_half_width_n_s_per_m = rows_of(found.half_width.C);
  result.lines_used = rows_of(found.lines_used.cast<double>());
  result.lines = identification.lines;
  result.from_hz = identification.from_hz;
  result.to_hz = identification.to_hz;
  result.chi_squared = finite(found.chi_squared);
  result.damping_raised = identification.damping_raised;
  result.status = "identified";
  if (found.loss_factor.size() == 0) return result;
  result.loss_factor = rows_of(found.loss_factor);
  result.loss_factor_half_width = rows_of(found.loss_factor_half_width);
  return result;
}

ContactSummary contact_of(const setup::JoinedContact& joined) {
  const coupling::Contact& contact = joined.contact;
  ContactSummary result;
  result.part = contact.point_a;
  result.robot = contact.point_b;
  result.model = joined.model;
  for (std::size_t i = 0; i < contact.springs.size(); ++i) {
    const ContactAlong values = along(contact, i);
    result.directions.push_back(contact.springs[i].direction);
    result.stiffness_n_per_m.push_back(finite(values.stiffness));
    result.damping_n_s_per_m.push_back(values.damping);
    result.loss_factor.push_back(values.loss_factor);
  }
  result.preload_n = joined.preload_n;
  if (const auto& hertz = joined.hertz) result.hertz = {hertz->contact_radius, hertz->approach, hertz->peak_pressure};
  return result;
}

/// "x", "-z" or "(0.60, 0.80, 0.00)".
std::string direction_text(const Eigen::Vector3d& n) {
  for (int axis = 0; axis < 3; ++axis) {
    const char letter = static_cast<char>('x' + axis);
    if (n == Eigen::Vector3d::Unit(axis)) return {letter};
    if (n == -Eigen::Vector3d::Unit(axis)) return {'-', letter};
  }
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", n.x(), n.y(), n.z());
}

std::string spring_text(const ContactSummary& contact, std::size_t i) {
  if (!contact.stiffness_n_per_m[i]) return "rigid";
  std::string text = fmt::format("{:.4g} N/m", *contact.stiffness_n_per_m[i]);
  const double damping = contact.damping_n_s_per_m[i], loss = contact.loss_factor[i];
  if (damping > 0.0) text += fmt::format(", {:.4g} N s/m", damping);
  if (loss > 0.0) text += fmt::format(", loss factor {:.3g}", loss);
  return text;
}

std::string cause_text(const ContactSummary& contact) {
  if (!contact.preload_n) return "";
  std::string text = fmt::format(" ({}, {:.4g} N", contact.model, *contact.preload_n);
  if (const auto& ball = contact.hertz)
    text += fmt::format("; radius {:.3g} mm, peak pressure {:.4g} MPa", ball->contact_radius_m * 1e3,
                        ball->peak_pressure_pa * 1e-6);
  return text + ")";
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// "1.02e6 ± 3e3" of the entry (i, j).
std::string interval_of(const EntryRows& value, const EntryRows& half_width, std::size_t i, std::size_t j) {
  return fmt::format("{:.5g} ± {:.2g}", value[i][j].value_or(unknown), half_width[i][j].value_or(unknown));
}

std::string identified_text(const ContactSummary& contact) {
  const IdentifiedContactSummary& found = *contact.identified;
  const std::size_t n = contact.directions.size();
  std::string text;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i; j < n; ++j) {
      const std::string entry =
          direction_text(contact.directions[i]) + (i == j ? "" : "/" + direction_text(contact.directions[j]));
      text += fmt::format("    found along {}: {} N/m", entry,
                          interval_of(found.stiffness_n_per_m, found.stiffness_half_width_n_per_m, i, j));
      if (found.damping_half_width_n_s_per_m[i][j] != 0.0)
        text += ", " + interval_of(found.damping_n_s_per_m, found.damping_half_width_n_s_per_m, i, j) + " N s/m";
      if (i == j && found.loss_factor)  // between directions K may be zero
        text += ", loss factor " + interval_of(*found.loss_factor, *found.loss_factor_half_width, i, j);
      text += fmt::format(" (95 %), {:.0f} of {} lines\n", found.lines_used[i][j].value_or(0.0), found.lines);
    }
  }
  return text + fmt::format("    from FRFs of the assembly, {:.4g} to {:.4g} Hz; residuals {:.2g} times the noise\n",
                            found.from_hz, found.to_hz, std::sqrt(found.chi_squared.value_or(unknown)));
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

std::vector<ContactSummary> contacts_summary(const study::Results& results) {
  std::vector<ContactSummary> list;
  for (const setup::JoinedContact& contact : results.contacts) list.push_back(contact_of(contact));
  if (results.identification) list.front().identified = identified_of(*results.identification);
  return list;
}

std::optional<RegularisationSummary> regularisation_summary(coupling::Regularisation regularisation, double threshold,
                                                            const coupling::CoupledResponse& receptance) {
  if (regularisation == coupling::Regularisation::none) return std::nullopt;
  Eigen::Index most = 0, widest = 0;
  const int dropped = receptance.dropped.maxCoeff(&most);
  const double residual = receptance.compatibility_residual.maxCoeff(&widest);
  const auto hz = [&](Eigen::Index line) { return receptance.response.axis.hz(line); };
  RegularisationSummary result;
  result.method = core::word_of(regularisation);
  result.threshold = threshold;
  result.lines = receptance.dropped.size();
  result.lines_with_dropped = (receptance.dropped.array() > 0).count();
  result.most_dropped = dropped;
  if (dropped > 0) result.most_dropped_at_hz = hz(most);
  result.compatibility_residual_max = finite(residual);
  result.compatibility_residual_at_hz = hz(widest);
  return result;
}

std::string contacts_text(const Summary& summary) {
  std::string text;
  for (const ContactSummary& contact : summary.contacts) {
    std::string list;
    for (std::size_t i = 0; i < contact.directions.size(); ++i)
      list += (i == 0 ? "" : "; ") + direction_text(contact.directions[i]) + " " + spring_text(contact, i);
    text += fmt::format("  contact     {}-{}: {}{}\n", contact.part, contact.robot, list, cause_text(contact));
    if (contact.identified) text += identified_text(contact);
  }
  return text;
}

}  // namespace thinwall::report
