#pragma once
// Sections of summary.json on the contacts between part and robot.

#include <string>
#include <vector>

#include "report/summary/field.hpp"

namespace thinwall::report {

/// A matrix over the directions of a contact; null where an entry is not known.
using EntryRows = std::vector<std::vector<std::optional<double>>>;

/// A contact as it was found from FRFs of the assembly, with half widths of 95 % intervals.
struct IdentifiedContactSummary {
  EntryRows stiffness_n_per_m, stiffness_half_width_n_per_m, damping_n_s_per_m, damping_half_width_n_s_per_m;
  std::optional<EntryRows> loss_factor, loss_factor_half_width;
  EntryRows lines_used;
  long lines = 0;
  double from_hz = 0.0, to_hz = 0.0;
  std::optional<double> chi_squared;
  bool damping_raised = false;
  std::string status;
};

template <class Visitor, Either<IdentifiedContactSummary> Section>
void fields(Visitor& visit, Section& found) {
  visit(Field{"stiffness_n_per_m", Kind::stiffness, "stiffness, a row a direction"}, found.stiffness_n_per_m);
  visit(Field{"stiffness_half_width_n_per_m", Kind::stiffness, "half width of its 95 % interval"},
        found.stiffness_half_width_n_per_m);
  visit(Field{"damping_n_s_per_m", Kind::damping, "viscous damping"}, found.damping_n_s_per_m);
  visit(Field{"damping_half_width_n_s_per_m", Kind::damping, "half width of its 95 % interval"},
        found.damping_half_width_n_s_per_m);
  visit(Field{"loss_factor", Kind::ratio, "loss factor; null: none was looked for", Presence::or_null},
        found.loss_factor);
  visit(Field{"loss_factor_half_width", Kind::ratio, "half width of its 95 % interval", Presence::or_null},
        found.loss_factor_half_width);
  visit(Field{"lines_used", Kind::count, "lines that each entry was found from"}, found.lines_used);
  visit(Field{"lines", Kind::count, "lines that were compared"}, found.lines);
  visit(Field{"from_hz", Kind::frequency, "the first of them"}, found.from_hz);
  visit(Field{"to_hz", Kind::frequency, "the last of them"}, found.to_hz);
  visit(Field{"chi_squared", Kind::ratio,
              "squared residuals over the noise, a degree of freedom: 1 if the noise is as said", Presence::or_null},
        found.chi_squared);
  visit(Field{"damping_raised", Kind::truth, "true if more damping was joined than was found"}, found.damping_raised);
  visit(Field{"status", Kind::text, "\"identified\""}, found.status);
}

/// The contact of a ball and a plane.
struct HertzSummary {
  double contact_radius_m = 0.0, approach_m = 0.0, peak_pressure_pa = 0.0;
};

template <class Visitor, Either<HertzSummary> Section>
void fields(Visitor& visit, Section& hertz) {
  visit(Field{"contact_radius_m", Kind::length, "radius of the area of contact"}, hertz.contact_radius_m);
  visit(Field{"approach_m", Kind::length, "approach of the bodies"}, hertz.approach_m);
  visit(Field{"peak_pressure_pa", Kind::pressure, "pressure in the middle"}, hertz.peak_pressure_pa);
}

/// A contact as it was joined.
struct ContactSummary {
  std::string part, robot, model;
  std::vector<Eigen::Vector3d> directions;
  std::vector<std::optional<double>> stiffness_n_per_m;
  std::vector<double> damping_n_s_per_m, loss_factor;
  std::optional<double> preload_n;
  std::optional<HertzSummary> hertz;
  std::optional<IdentifiedContactSummary> identified;
};

template <class Visitor, Either<ContactSummary> Section>
void fields(Visitor& visit, Section& contact) {
  visit(Field{"part", Kind::text, "point of the part"}, contact.part);
  visit(Field{"robot", Kind::text, "point of the robot"}, contact.robot);
  visit(Field{"model", Kind::text, "model of the contact"}, contact.model);
  visit(Field{"directions", Kind::ratio, "unit vectors along which it resists"}, contact.directions);
  visit(Field{"stiffness_n_per_m", Kind::stiffness, "stiffness along each; null: rigid"}, contact.stiffness_n_per_m);
  visit(Field{"damping_n_s_per_m", Kind::damping, "viscous damping along each"}, contact.damping_n_s_per_m);
  visit(Field{"loss_factor", Kind::ratio, "loss factor along each"}, contact.loss_factor);
  visit(Field{"preload_n", Kind::force, "force that presses it; absent: not asked for"}, contact.preload_n);
  visit(Field{"hertz", Kind::section, "the contact of a ball that the preload makes"}, contact.hertz);
  visit(Field{"identified", Kind::section, "the joint as FRFs of the assembly tell it"}, contact.identified);
}

}  // namespace thinwall::report
