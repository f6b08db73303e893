#include "case/checks/contact_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "case/checks/part_checks.hpp"
#include "core/error.hpp"
#include "core/overloaded.hpp"
#include "setup/contact_model.hpp"
#include "setup/measured_layout.hpp"

namespace thinwall::cases {

namespace {

// A resolved case writes defaults out: only another value shows that the user meant it.
bool gives_stiffness(const setup::SpringContact& springs) {
  return std::ranges::any_of(springs.stiffness, [](double k) { return std::isfinite(k); });
}

bool gives_damping(const setup::SpringContact& springs) {
  return std::ranges::any_of(springs.damping, [](double c) { return c > 0.0; });
}

void check_directions(const std::string& key, const setup::SupportContact& contact, Findings& findings) {
  const auto& directions = contact.directions;
  if (std::holds_alternative<setup::BallContact>(contact.model)) {
    const bool across = std::all_of(directions.begin() + 1, directions.end(), [&](const Eigen::Vector3d& d) {
      return std::abs(d.dot(directions.front())) <= 1e-6;
    });
    if (!across)
      findings.report(
          key + ".directions",
          "a ball resists along its normal, the first direction, and at right angles to it; turn the others");
  } else if (directions.size() > 1) {
    findings.report(key + ".directions", "\"" + core::word_of(kind(contact)) +
                                             "\" is known along one direction; join the others by a [[contacts]] of "
                                             "their own");
  }
}

void check_preload(const Case& source, const std::string& key, const setup::SupportContact& contact,
                   Findings& findings) {
  if (setup::preload_of(source, contact)) return;
  const std::string text = "missing; the stiffness depends on the force that presses the contact together";
  findings.report(key + ".preload",
                  text + (source.contacts.size() > 1 ? ", and robot.preload is that of all contacts together"
                                                     : ", and robot.preload has none along the first direction"));
}

/// Numbers of the ball, of what it touches and of its damping; NaN among them where one could not be read.
std::vector<double> numbers_of(const Case& source, const setup::SupportContact& contact, const auto& pressed) {
  std::vector<double> numbers{pressed.ball.radius, pressed.ball.steel.E, pressed.ball.steel.nu};
  if (pressed.surface) {
    numbers.insert(numbers.end(), {pressed.surface->E, pressed.surface->nu});
  } else if (source.part && setup::kind(*source.part) != setup::ShapeKind::matrices) {
    const setup::Material& material = source.part->material;
    numbers.insert(numbers.end(), {material.youngs_modulus, material.poisson_ratio});
  }
  if (pressed.damping.size() != contact.directions.size()) numbers.push_back(std::numeric_limits<double>::quiet_NaN());
  return numbers;
}

/// Reports what the model itself refuses of a contact that has all it needs. Numbers that could not be read, or are not
/// there, were reported before.
void try_contact(const Case& source, const std::string& key, const setup::SupportContact& contact, Findings& findings) {
  const auto* tabled = std::get_if<setup::TabledContact>(&contact.model);
  std::error_code ignored;
  if (tabled != nullptr && (!tabled->rows || !std::filesystem::exists(tabled->table, ignored))) return;  // was reported
  std::vector<double> numbers =
      std::visit(core::overloaded{[](const setup::SpringContact&) { return std::vector<double>(); },
                                  [](const setup::TabledContact&) { return std::vector<double>(); },
                                  [&](const setup::BallContact& ball) { return numbers_of(source, contact, ball); },
                                  [&](const setup::CasterContact& caster) {
                                    auto list = numbers_of(source, contact, caster);
                                    list.insert(list.end(), {caster.support_radius, caster.support_angle});
                                    if (caster.supports < 0) list.push_back(std::numeric_limits<double>::quiet_NaN());
                                    return list;
                                  }},
                 contact.model);
  numbers.insert(numbers.end(), {setup::preload_of(source, contact).value_or(0.0), contact.loss_factor});
  if (!std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); })) return;
  try {
    (void)setup::joined_contact(source, source, contact);
  } catch (const core::Error& error) {
    findings.report(key + (tabled != nullptr ? ".table" : ".model"), error.what());
  }
}

/// A measured part does not tell what a ball touches.
bool lacks_surface(const Case& source, const setup::SupportContact& contact) {
  const auto lacks = [&](const auto& pressed) { return !source.part && !pressed.surface; };
  return std::visit(core::overloaded{lacks, [](const setup::SpringContact&) { return false; },
                                     [](const setup::TabledContact&) { return false; }},
                    contact.model);
}

void check_preloaded(const Case& source, const std::string& key, const setup::SupportContact& contact,
                     Findings& findings) {
  if (contact.directions.empty()) return;
  const std::size_t before = findings.problems.size();
  check_directions(key, contact, findings);
  check_preload(source, key, contact, findings);
  if (lacks_surface(source, contact))
    findings.report(key + ".surface", "missing; a measured part does not tell what the ball touches");
  if (findings.problems.size() == before) try_contact(source, key, contact, findings);
}

/// The points where the assembly moves (`response`), or where it is excited: one, that the part's model knows in the
/// contact's directions.
void check_measured_end(const Case& source, const std::string& key, const setup::SupportContact& contact, bool response,
                        Findings& findings) {
  const auto end = [&](const setup::MeasuredFrf& frf) { return response ? frf.response : frf.force; };
  const auto measured = setup::measured_assembly(contact);
  const std::string point = setup::point_of(end(measured.front()));
  const auto points = part_points(source);
  std::vector<Eigen::Vector3d> seen;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const std::string dof = end(measured[i]);
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

void check_measured_points(const Case& source, const std::string& key, const setup::SupportContact& contact,
                           Findings& findings) {
  const auto unnamed = [](const setup::MeasuredFrf& frf) { return frf.response.empty() || frf.force.empty(); };
  const auto measured = setup::measured_assembly(contact);
  if (std::ranges::any_of(measured, unnamed)) return;
  const std::size_t before = findings.problems.size();
  check_measured_end(source, key, contact, true, findings);
  const setup::MeasuredFrf& first = measured.front();
  const bool same = setup::point_of(first.response) == setup::point_of(first.force);
  if (!same || findings.problems.size() == before) check_measured_end(source, key, contact, false, findings);
}

void check_identification(const Case& source, const std::string& key, const setup::SupportContact& contact,
                          const setup::SpringContact& springs, Findings& findings) {
  if (source.contacts.size() > 1)
    findings.report(key + ".measured", "a joint is found where the robot has one contact; remove the other contacts");
  if (gives_stiffness(springs) || gives_damping(springs) || contact.loss_factor > 0.0)
    findings.report(key + ".measured",
                    "finds stiffness and damping; remove stiffness, damping and loss_factor, or the FRFs");
  check_measured_points(source, key, contact, findings);
  const auto coupled = [](const setup::Updating& updating) { return updating.on == setup::FitOf::coupled; };
  if (std::ranges::any_of(source.updating, coupled))
    findings.report(
        key + ".measured",
        "the contact is found after fits, so none with on = \"coupled\" may need it; remove one of the two");
}

void check_springs(const Case& source, const std::string& key, const setup::SupportContact& contact,
                   const setup::SpringContact& springs, Findings& findings) {
  if (!springs.noise.empty() && springs.noise.size() != 3)
    findings.report(key + ".noise", "give one value, or three: of the assembly, of the part, of the robot");
  if (!springs.measured.empty()) return check_identification(source, key, contact, springs, findings);
  const std::vector<double> usual(3, 0.01);
  if (springs.noise.size() == 3 && springs.noise != usual)
    findings.report(key + ".noise", "is that of [[contacts.measured]], which are not there; remove it, or add them");
  if (springs.damping_sought != setup::DampingSought::viscous)
    findings.report(key + ".damping_model",
                    "is what [[contacts.measured]] are searched for, which are not there; remove it, or add them");
}

}  // namespace

void check_contact_models(const Case& source, Findings& findings) {
  for (std::size_t i = 0; i < source.contacts.size(); ++i) {
    const std::string key = indexed("contacts", i);
    const setup::SupportContact& contact = source.contacts[i];
    if (findings.unreadable(key + ".model")) continue;  // it could not be read
    if (const auto* springs = std::get_if<setup::SpringContact>(&contact.model)) {
      check_springs(source, key, contact, *springs, findings);
    } else {
      check_preloaded(source, key, contact, findings);
    }
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
