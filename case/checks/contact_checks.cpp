#include "case/checks/contact_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "case/checks/part_checks.hpp"
#include "core/error.hpp"
#include "setup/contact_model.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::cases {

namespace {

bool rolls(const setup::Contact& contact) {
  return contact.model == setup::ContactModel::hertz || contact.model == setup::ContactModel::caster;
}

// A resolved case writes defaults out: only another value shows that the user meant it.
bool gives_stiffness(const setup::Contact& contact) {
  return std::ranges::any_of(contact.stiffness, [](double k) { return std::isfinite(k); });
}

bool gives_damping(const setup::Contact& contact) {
  return std::ranges::any_of(contact.damping, [](double c) { return c > 0.0; });
}

void check_directions(const std::string& key, const setup::Contact& contact, Findings& findings) {
  const auto& directions = contact.directions;
  if (contact.model == setup::ContactModel::hertz) {
    const bool across = std::all_of(directions.begin() + 1, directions.end(), [&](const Eigen::Vector3d& d) {
      return std::abs(d.dot(directions.front())) <= 1e-6;
    });
    if (!across)
      findings.report(
          key + ".directions",
          "a ball resists along its normal, the first direction, and at right angles to it; turn the others");
  } else if (directions.size() > 1) {
    findings.report(key + ".directions", "\"" + core::word_of(contact.model) +
                                             "\" is known along one direction; join the others by a [[contacts]] of "
                                             "their own");
  }
}

void check_surface(const Case& source, const std::string& key, const setup::Contact& contact, Findings& findings) {
  if (!source.part && !contact.surface)
    findings.report(key + ".surface", "missing; a measured part does not tell what the ball touches");
}

void check_preload(const Case& source, const std::string& key, const setup::Contact& contact, Findings& findings) {
  if (setup::preload_of(source, contact)) return;
  const std::string text = "missing; the stiffness depends on the force that presses the contact together";
  findings.report(key + ".preload",
                  text + (source.contacts.size() > 1 ? ", and robot.preload is that of all contacts together"
                                                     : ", and robot.preload has none along the first direction"));
}

/// True if the contact has what its model needs; the table of alternatives has told what is missing.
bool complete(const setup::Contact& contact) {
  if (contact.model == setup::ContactModel::table) return !contact.table.empty();
  if (!rolls(contact)) return true;
  const bool caster = contact.model == setup::ContactModel::caster;
  return contact.ball &&
         (!caster || (contact.ball->supports && contact.ball->support_radius && contact.ball->support_angle));
}

/// Reports what the model itself refuses of a contact that has all it needs. Numbers that could not be read were
/// reported before.
void try_contact(const Case& source, const std::string& key, const setup::Contact& contact, Findings& findings) {
  std::error_code ignored;
  if (contact.model == setup::ContactModel::table && !std::filesystem::is_regular_file(contact.table, ignored)) {
    findings.report(key + ".table", "there is no file \"" + contact.table.string() + "\"");
    return;
  }
  std::vector<double> numbers{setup::preload_of(source, contact).value_or(0.0), contact.loss_factor};
  const coupling::Elastic surface =
      contact.surface ? *contact.surface
      : source.part && source.part->shape != setup::PartShape::matrices
          ? coupling::Elastic{source.part->material.youngs_modulus, source.part->material.poisson_ratio}
          : coupling::Elastic{};
  if (rolls(contact)) {
    const setup::ContactBall& ball = *contact.ball;
    for (const double number : {ball.radius, ball.steel.E, ball.steel.nu, ball.support_radius.value_or(0.0),
                                ball.support_angle.value_or(0.0), surface.E, surface.nu})
      numbers.push_back(number);
    if (contact.damping.size() != contact.directions.size()) return;
  }
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) return;
  try {
    (void)setup::joined_contact(source, source, contact);
  } catch (const core::Error& error) {
    findings.report(key + (contact.model == setup::ContactModel::table ? ".table" : ".model"), error.what());
  }
}

void check_preloaded(const Case& source, const std::string& key, const setup::Contact& contact, Findings& findings) {
  if (contact.directions.empty()) return;
  const std::size_t before = findings.problems.size();
  check_directions(key, contact, findings);
  check_preload(source, key, contact, findings);
  if (rolls(contact)) check_surface(source, key, contact, findings);
  if (findings.problems.size() == before && complete(contact)) try_contact(source, key, contact, findings);
}

/// The points where the assembly moves (`response`), or where it is excited: one, that the part's model knows in the
/// contact's directions.
void check_measured_end(const Case& source, const std::string& key, const setup::Contact& contact, bool response,
                        Findings& findings) {
  const auto end = [&](const setup::MeasuredFrf& frf) { return response ? frf.response : frf.force; };
  const std::string point = setup::point_of(end(contact.measured.front()));
  const auto points = part_points(source);
  std::vector<Eigen::Vector3d> seen;
  for (std::size_t i = 0; i < contact.measured.size(); ++i) {
    const std::string dof = end(contact.measured[i]);
    const std::string item = fmt::format("{}.measured[{}].{}", key, i, response ? "response" : "force");
    if (const auto direction = direction_of(dof)) seen.push_back(*direction);
    findings.require_known(item, setup::point_of(dof), points, "point");
    if (setup::point_of(dof) != point)
      findings.report(item, fmt::format("\"{}\" is of another point than \"{}\"; a joint is found between one point "
                                        "that moves and one that is excited",
                                        dof, point));
  }
  if (std::ranges::find(points, point) == points.end()) return;
  if (source.part && std::ranges::count(source.reduction.interface, point) == 0)
    findings.report(key + ".measured",
                    "point \"" + point + "\" is not kept by the reduction; add it to reduction.interface");
  const auto here = directions_at(source, point);
  const auto told = [&](const Eigen::Vector3d& n) { return spanned(seen, n) && (here.empty() || spanned(here, n)); };
  if (!std::ranges::all_of(contact.directions, told))
    findings.report(key + ".measured", "the FRFs at \"" + point +
                                           "\" do not tell all directions of the contact; measure the others, or join "
                                           "fewer");
}

void check_measured_points(const Case& source, const std::string& key, const setup::Contact& contact,
                           Findings& findings) {
  const auto unnamed = [](const setup::MeasuredFrf& frf) { return frf.response.empty() || frf.force.empty(); };
  if (std::ranges::any_of(contact.measured, unnamed)) return;
  const std::size_t before = findings.problems.size();
  check_measured_end(source, key, contact, true, findings);
  const setup::MeasuredFrf& first = contact.measured.front();
  const bool same = setup::point_of(first.response) == setup::point_of(first.force);
  if (!same || findings.problems.size() == before) check_measured_end(source, key, contact, false, findings);
}

void check_identification(const Case& source, const std::string& key, const setup::Contact& contact,
                          Findings& findings) {
  if (source.contacts.size() > 1)
    findings.report(key + ".measured", "a joint is found where the robot has one contact; remove the other contacts");
  if (contact.model == setup::ContactModel::springs &&
      (gives_stiffness(contact) || gives_damping(contact) || contact.loss_factor > 0.0))
    findings.report(key + ".measured",
                    "finds stiffness and damping; remove stiffness, damping and loss_factor, or the FRFs");
  check_measured_points(source, key, contact, findings);
  const auto coupled = [](const setup::Updating& updating) { return updating.on == setup::FitOf::coupled; };
  if (std::ranges::any_of(source.updating, coupled))
    findings.report(
        key + ".measured",
        "the contact is found after fits, so none with on = \"coupled\" may need it; remove one of the two");
}

}  // namespace

void check_contact_models(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.contacts.size(); ++i) {
    const std::string key = "contacts[" + std::to_string(i) + "]";
    const setup::Contact& contact = source.contacts[i];
    if (findings.unreadable(key + ".model")) continue;  // it could not be read
    if (!contact.noise.empty() && contact.noise.size() != 3)
      findings.report(key + ".noise", "give one value, or three: of the assembly, of the part, of the robot");
    if (!contact.measured.empty()) {
      check_identification(source, key, contact, findings);
      continue;
    }
    const std::vector<double> usual(3, 0.01);
    if (contact.noise.size() == 3 && contact.noise != usual)
      findings.report(key + ".noise", "is that of [[contacts.measured]], which are not there; remove it, or add them");
    if (contact.damping_sought != setup::DampingSought::viscous)
      findings.report(key + ".damping_model",
                      "is what [[contacts.measured]] are searched for, which are not there; remove it, or add them");
    if (contact.model != setup::ContactModel::springs) check_preloaded(source, key, contact, findings);
  }
}

void check_coupling(const Case& source, Findings& findings) {
  const setup::CouplingChoice& choice = source.coupling;
  if (choice.regularisation != coupling::Regularisation::none && source.contacts.empty())
    findings.report("coupling.regularisation", "nothing is coupled; add [[contacts]], or remove it");
  if (choice.regularisation == coupling::Regularisation::none) return;
  for (std::size_t i = 0; i < source.updating.size(); ++i) {
    if (std::ranges::any_of(source.updating[i].targets, [](const setup::UpdatingTarget& target) {
          return target.quantity == setup::FittedQuantity::coupled_frequency;
        }))
      findings.report(
          "updating[" + std::to_string(i) + "]",
          "coupled_frequency joins matrices, which coupling.regularisation does not reach; take reduction_at, "
          "or remove the regularisation");
  }
}

}  // namespace thinwall::cases
