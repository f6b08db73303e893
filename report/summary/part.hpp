#pragma once
// Sections of summary.json on the part: its file, mesh, modes, reduction and points.

#include <string>
#include <vector>

#include "report/summary/field.hpp"

namespace thinwall::report {

/// A mode of the part.
struct PartModeSummary {
  double frequency_hz = 0.0;
  std::optional<double> damping_ratio;
  double residual = 0.0, inverse_residual = 0.0;
  std::optional<bool> rigid_body;
};

template <class Visitor, Either<PartModeSummary> Section>
void fields(Visitor& visit, Section& mode) {
  visit(Field{"frequency_hz", Kind::frequency, "natural frequency"}, mode.frequency_hz);
  visit(Field{"damping_ratio", Kind::ratio, "damping ratio; null: not known", Presence::or_null}, mode.damping_ratio);
  visit(Field{"residual", Kind::residual, "|K phi - lambda M phi| over lambda |M phi|, 0 of rigid-body modes"},
        mode.residual);
  visit(Field{"inverse_residual", Kind::residual, "the residual of the inverse problem that was solved, relative"},
        mode.inverse_residual);
  visit(Field{"rigid_body", Kind::truth, "true of a rigid-body mode, absent of others"}, mode.rigid_body);
}

/// A mode found in a measured FRF.
struct IdentifiedModeSummary {
  double frequency_hz = 0.0;
  std::optional<double> damping_ratio;
  double relative_misfit = 0.0;
};

template <class Visitor, Either<IdentifiedModeSummary> Section>
void fields(Visitor& visit, Section& mode) {
  visit(Field{"frequency_hz", Kind::frequency, "natural frequency"}, mode.frequency_hz);
  visit(Field{"damping_ratio", Kind::ratio, "damping ratio; null: not known", Presence::or_null}, mode.damping_ratio);
  visit(Field{"relative_misfit", Kind::residual,
              "root mean square misfit over that of the FRF, on the lines that were fitted"},
        mode.relative_misfit);
}

/// One of the meshes by which the mesh's error was estimated.
struct EstimateStepSummary {
  int level = 0, order = 0;
  long dofs = 0;
  std::optional<double> frequency_change_relative, receptance_change_relative;
};

template <class Visitor, Either<EstimateStepSummary> Section>
void fields(Visitor& visit, Section& step) {
  visit(Field{"level", Kind::count, "level of refinement"}, step.level);
  visit(Field{"order", Kind::count, "order of the elements"}, step.order);
  visit(Field{"dofs", Kind::count, "degrees of freedom"}, step.dofs);
  visit(Field{"frequency_change_relative", Kind::error_estimate,
              "largest relative change of a frequency from the mesh before; null: there is none", Presence::or_null},
        step.frequency_change_relative);
  visit(Field{"receptance_change_relative", Kind::error_estimate,
              "largest change of a receptance of the points, relative to the largest of them; null: not known",
              Presence::or_null},
        step.receptance_change_relative);
}

/// The error that the mesh costs, by its own estimate.
struct MeshEstimateSummary {
  std::optional<double> tolerance;
  bool met = false;
  double max_relative_frequency_error = 0.0, max_relative_receptance_error = 0.0, max_relative_entry_error = 0.0;
  std::string worst_receptance, held_back_by;
  std::vector<EstimateStepSummary> steps;
};

template <class Visitor, Either<MeshEstimateSummary> Section>
void fields(Visitor& visit, Section& estimate) {
  visit(Field{"tolerance", Kind::ratio, "tolerance that the case asks for, relative; null: the mesh was given",
              Presence::or_null},
        estimate.tolerance);
  visit(Field{"met", Kind::truth, "true if both estimates are within the tolerance, or none was asked for"},
        estimate.met);
  visit(Field{"max_relative_frequency_error", Kind::error_estimate, "estimated largest relative error of a frequency"},
        estimate.max_relative_frequency_error);
  visit(Field{"max_relative_receptance_error", Kind::error_estimate,
              "estimated largest error of a receptance of the points, relative to the largest of them"},
        estimate.max_relative_receptance_error);
  visit(Field{"max_relative_entry_error", Kind::error_estimate,
              "estimated largest error of a receptance of the points, relative to itself"},
        estimate.max_relative_entry_error);
  visit(Field{"worst_receptance", Kind::text, "name of the receptance of that error: P.x, or P.x to Q.z"},
        estimate.worst_receptance);
  visit(Field{"held_back_by", Kind::text,
              "what ended the refinement before the tolerance was met; empty: it was met, or all levels were used"},
        estimate.held_back_by);
  visit(Field{"steps", Kind::section, "meshes that were compared"}, estimate.steps);
}

/// The mesh of the part.
struct MeshSummary {
  long nodes = 0, elements = 0;
  int order = 0;
  long dofs = 0;
  double min_quality = 0.0, worst_aspect_ratio = 0.0, smallest_dihedral_deg = 0.0;
  long curved_elements = 0;
  double least_jacobian = 0.0, frequency_round_off = 0.0;
  std::optional<MeshEstimateSummary> error_estimate;
};

template <class Visitor, Either<MeshSummary> Section>
void fields(Visitor& visit, Section& mesh) {
  visit(Field{"nodes", Kind::count, "nodes"}, mesh.nodes);
  visit(Field{"elements", Kind::count, "tetrahedra"}, mesh.elements);
  visit(Field{"order", Kind::count, "order of the elements"}, mesh.order);
  visit(Field{"dofs", Kind::count, "free degrees of freedom"}, mesh.dofs);
  visit(Field{"min_quality", Kind::ratio, "lowest mean ratio of an element, 1 of a regular one"}, mesh.min_quality);
  visit(Field{"worst_aspect_ratio", Kind::ratio, "largest aspect ratio of an element"}, mesh.worst_aspect_ratio);
  visit(Field{"smallest_dihedral_deg", Kind::angle_deg, "smallest dihedral angle of an element"},
        mesh.smallest_dihedral_deg);
  visit(Field{"curved_elements", Kind::count, "elements with a curved edge"}, mesh.curved_elements);
  visit(Field{"least_jacobian", Kind::ratio, "smallest det J over its mean in an element"}, mesh.least_jacobian);
  visit(Field{"frequency_round_off", Kind::residual, "relative change of the lowest frequency that rounding may cause"},
        mesh.frequency_round_off);
  visit(Field{"error_estimate", Kind::section,
              "the error that the mesh costs, by its own estimate; null where size and order were given, or it is not "
              "known",
              Presence::or_null},
        mesh.error_estimate);
}

/// The check of the part's modes that `modes.verify` asks for.
struct ModeCheckSummary {
  int modes_counted = 0;
  double below_hz = 0.0;
  double largest_difference_relative = 0.0;
  int of_mode = 0;  ///< from 1
};

template <class Visitor, Either<ModeCheckSummary> Section>
void fields(Visitor& visit, Section& check) {
  visit(Field{"modes_counted", Kind::count, "modes that the Sturm count finds below the frequency"},
        check.modes_counted);
  visit(Field{"below_hz", Kind::frequency, "frequency below which modes were counted"}, check.below_hz);
  visit(Field{"largest_difference_relative", Kind::residual,
              "largest difference of an eigenvalue between both solvers, relative to its distance from the shift"},
        check.largest_difference_relative);
  visit(Field{"of_mode", Kind::count, "number of the mode with this difference, from 1"}, check.of_mode);
}

/// The part and its modes.
struct PartSummary {
  double mass_kg = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double mass_difference_relative = 0.0;
  int rigid_body_modes = 0;
  std::vector<PartModeSummary> modes;
  std::optional<std::vector<std::string>> free_motions;
  std::optional<ModeCheckSummary> mode_check;
  std::vector<IdentifiedModeSummary> identified;
};

template <class Visitor, Either<PartSummary> Section>
void fields(Visitor& visit, Section& part) {
  visit(Field{"mass_kg", Kind::mass, "mass"}, part.mass_kg);
  visit(Field{"centre_m", Kind::length, "centre of mass, part axes"}, part.centre_m);
  visit(Field{"mass_difference_relative", Kind::residual,
              "difference of mass, centre and inertia between matrix and geometry"},
        part.mass_difference_relative);
  visit(Field{"rigid_body_modes", Kind::count, "rigid-body modes, which are the first ones"}, part.rigid_body_modes);
  visit(Field{"modes", Kind::section, "modes in ascending order"}, part.modes);
  visit(Field{"free_motions", Kind::text, "rigid motions that the supports leave, in words"}, part.free_motions);
  visit(Field{"mode_check", Kind::section, "check of the modes by a Sturm count and by a second solver, if asked for"},
        part.mode_check);
  visit(Field{"identified", Kind::section, "modes found in measured FRFs, whose damping was taken", Presence::if_any},
        part.identified);
}

/// The reduced model's error with fewer modes.
struct ErrorBySizeSummary {
  int kept_modes = 0;
  double max_relative_frequency_error = 0.0;
};

template <class Visitor, Either<ErrorBySizeSummary> Section>
void fields(Visitor& visit, Section& size) {
  visit(Field{"kept_modes", Kind::count, "kept fixed-interface modes"}, size.kept_modes);
  visit(Field{"max_relative_frequency_error", Kind::error_estimate, "largest relative error of a frequency"},
        size.max_relative_frequency_error);
}

/// The reduced model of the part.
struct ReductionSummary {
  std::vector<ErrorBySizeSummary> error_by_size;
  std::optional<double> estimated_receptance_error;
  std::string method;
  long interface_dofs = 0, kept_modes = 0, size = 0, full_dofs = 0;
  double max_relative_frequency_error = 0.0;
  std::optional<double> max_relative_receptance_error;
};

template <class Visitor, Either<ReductionSummary> Section>
void fields(Visitor& visit, Section& reduction) {
  visit(Field{"method", Kind::text, "method of reduction"}, reduction.method);
  visit(Field{"interface_dofs", Kind::count, "interface degrees of freedom"}, reduction.interface_dofs);
  visit(Field{"kept_modes", Kind::count, "kept fixed-interface modes"}, reduction.kept_modes);
  visit(Field{"size", Kind::count, "degrees of freedom of the reduced model"}, reduction.size);
  visit(Field{"full_dofs", Kind::count, "degrees of freedom of the full model"}, reduction.full_dofs);
  visit(Field{"max_relative_frequency_error", Kind::error_estimate,
              "largest relative error of a frequency against the full model"},
        reduction.max_relative_frequency_error);
  visit(Field{"max_relative_receptance_error", Kind::error_estimate,
              "largest relative error of a receptance against direct solves of the full model; null: not checked",
              Presence::or_null},
        reduction.max_relative_receptance_error);
  visit(Field{"estimated_receptance_error", Kind::error_estimate,
              "estimated relative error of the receptance over the band; null without reduction.tolerance",
              Presence::or_null},
        reduction.estimated_receptance_error);
  visit(Field{"error_by_size", Kind::section, "errors of smaller models"}, reduction.error_by_size);
}

/// A repair of the surface of a part's file.
struct MendedSummary {
  std::string what;
  long count = 0;
  Eigen::Vector3d first_m = Eigen::Vector3d::Zero();
};

template <class Visitor, Either<MendedSummary> Section>
void fields(Visitor& visit, Section& mended) {
  visit(Field{"what", Kind::text, "kind of fault"}, mended.what);
  visit(Field{"count", Kind::count, "number of such faults"}, mended.count);
  visit(Field{"first_m", Kind::length, "place of the first, frame of the file"}, mended.first_m);
}

/// The file that a part's shape comes from.
struct GeometrySummary {
  std::string file, unit, read;
  std::optional<Eigen::Vector3d> size_m;
  std::vector<std::string> notes;
  std::optional<long> triangles;
  std::optional<double> volume_m3, largest_movement_m;
  std::optional<std::vector<MendedSummary>> mended;
  std::optional<double> least_jacobian;
};

template <class Visitor, Either<GeometrySummary> Section>
void fields(Visitor& visit, Section& geometry) {
  visit(Field{"file", Kind::text, "name of the file"}, geometry.file);
  visit(Field{"unit", Kind::text, "unit of its lengths"}, geometry.unit);
  visit(Field{"read", Kind::text, "what was read, in one line"}, geometry.read);
  visit(Field{"size_m", Kind::length, "extent along x, y and z; null: no shape is known", Presence::or_null},
        geometry.size_m);
  visit(Field{"notes", Kind::text, "remarks of the reader"}, geometry.notes);
  visit(Field{"triangles", Kind::count, "triangles of the surface"}, geometry.triangles);
  visit(Field{"volume_m3", Kind::volume, "volume that the surface encloses"}, geometry.volume_m3);
  visit(Field{"largest_movement_m", Kind::length, "largest movement of a vertex that was merged"},
        geometry.largest_movement_m);
  visit(Field{"mended", Kind::section, "repairs of the surface"}, geometry.mended);
  visit(Field{"least_jacobian", Kind::ratio, "smallest det J over its mean in an element of the file"},
        geometry.least_jacobian);
}

/// A named point of the part.
struct PointSummary {
  std::string name;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double patch_radius_m = 0.0;
  bool contact = false;
  std::vector<Eigen::Vector3d> directions, joined;
};

template <class Visitor, Either<PointSummary> Section>
void fields(Visitor& visit, Section& point) {
  visit(Field{"name", Kind::text, "name"}, point.name);
  visit(Field{"position_m", Kind::length, "position, part axes"}, point.position_m);
  visit(Field{"patch_radius_m", Kind::length, "radius of the patch that moves with the point; 0: the point alone"},
        point.patch_radius_m);
  visit(Field{"contact", Kind::truth, "true if a contact holds it"}, point.contact);
  visit(Field{"directions", Kind::ratio, "unit vectors along which it is an interface"}, point.directions);
  visit(Field{"joined", Kind::ratio, "unit vectors along which contacts resist"}, point.joined);
}

}  // namespace thinwall::report
