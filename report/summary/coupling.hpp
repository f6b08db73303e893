#pragma once
// Sections of summary.json on part and robot together.

#include <string>
#include <vector>

#include "report/summary/robot.hpp"

namespace thinwall::report {

/// A mode that the cut feels: of a modal model with its share, else found in the coupled receptance.
struct MainModeSummary {
  double frequency_hz = 0.0;
  std::optional<double> static_share_m_per_n;
  std::optional<std::optional<double>> damping_ratio;
  std::optional<double> relative_misfit;
};

template <class Visitor, Either<MainModeSummary> Section>
void fields(Visitor& visit, Section& mode) {
  visit(Field{"frequency_hz", Kind::frequency, "natural frequency"}, mode.frequency_hz);
  visit(Field{"static_share_m_per_n", Kind::compliance, "share of the mode in the static receptance"},
        mode.static_share_m_per_n);
  visit(Field{"damping_ratio", Kind::ratio, "damping ratio of a mode found in the receptance; null: not known"},
        mode.damping_ratio);
  visit(Field{"relative_misfit", Kind::residual,
              "root mean square misfit over that of the receptance, on the lines that were fitted"},
        mode.relative_misfit);
}

/// The difference of spatial and receptance coupling.
struct RouteDifferenceSummary {
  double max_relative = 0.0, at_frequency_hz = 0.0;
  std::string entry;
};

template <class Visitor, Either<RouteDifferenceSummary> Section>
void fields(Visitor& visit, Section& difference) {
  visit(Field{"max_relative", Kind::residual, "largest difference over the largest entry of its line"},
        difference.max_relative);
  visit(Field{"at_frequency_hz", Kind::frequency, "line of that"}, difference.at_frequency_hz);
  visit(Field{"entry", Kind::text, "entry of that"}, difference.entry);
}

/// Singular values that a regularised kernel dropped.
struct RegularisationSummary {
  std::string method;
  double threshold = 0.0;
  long lines = 0, lines_with_dropped = 0;
  int most_dropped = 0;
  std::optional<double> most_dropped_at_hz;
  std::optional<double> compatibility_residual_max;
  double compatibility_residual_at_hz = 0.0;
};

template <class Visitor, Either<RegularisationSummary> Section>
void fields(Visitor& visit, Section& regularisation) {
  visit(Field{"method", Kind::text, "method"}, regularisation.method);
  visit(Field{"threshold", Kind::ratio, "threshold, relative to the largest singular value"}, regularisation.threshold);
  visit(Field{"lines", Kind::count, "frequency lines"}, regularisation.lines);
  visit(Field{"lines_with_dropped", Kind::count, "lines at which a singular value was dropped"},
        regularisation.lines_with_dropped);
  visit(Field{"most_dropped", Kind::count, "most values that were dropped at a line"}, regularisation.most_dropped);
  visit(Field{"most_dropped_at_hz", Kind::frequency, "line of that; null: none was dropped", Presence::or_null},
        regularisation.most_dropped_at_hz);
  visit(Field{"compatibility_residual_max", Kind::residual, "largest relative gap left at rigid joints",
              Presence::or_null},
        regularisation.compatibility_residual_max);
  visit(Field{"compatibility_residual_at_hz", Kind::frequency, "line of that"},
        regularisation.compatibility_residual_at_hz);
}

/// The reduction of the vibration at a resonance of the part.
struct AmplitudeReductionSummary {
  std::string dof;
  double frequency_hz = 0.0, alone_m_per_n = 0.0, supported_m_per_n = 0.0, reduction = 0.0;
};

template <class Visitor, Either<AmplitudeReductionSummary> Section>
void fields(Visitor& visit, Section& reduction) {
  visit(Field{"dof", Kind::text, "degree of freedom"}, reduction.dof);
  visit(Field{"frequency_hz", Kind::frequency, "resonance of the part alone"}, reduction.frequency_hz);
  visit(Field{"alone_m_per_n", Kind::compliance, "receptance of the part alone, modulus"}, reduction.alone_m_per_n);
  visit(Field{"supported_m_per_n", Kind::compliance, "receptance with the robot, modulus"},
        reduction.supported_m_per_n);
  visit(Field{"reduction", Kind::ratio, "1 - supported / alone"}, reduction.reduction);
}

/// Part and robot joined.
struct CouplingSummary {
  std::vector<ModeSummary> modes;
  std::vector<MainModeSummary> main_modes;
  std::optional<RouteDifferenceSummary> route_difference;
  std::optional<std::string> no_spatial_route;
  std::optional<RegularisationSummary> regularisation;
  std::optional<double> kernel_condition_max;
  std::vector<AmplitudeReductionSummary> reductions;
};

template <class Visitor, Either<CouplingSummary> Section>
void fields(Visitor& visit, Section& coupling) {
  visit(Field{"modes", Kind::section, "modes of the assembly; none if a component is known by receptances only"},
        coupling.modes);
  visit(Field{"main_modes", Kind::section, "modes that the first point of the cut feels"}, coupling.main_modes);
  visit(Field{"route_difference", Kind::section, "difference of both routes of coupling; null: there is one only",
              Presence::or_null},
        coupling.route_difference);
  visit(Field{"no_spatial_route", Kind::text, "why matrices that are known were not joined"},
        coupling.no_spatial_route);
  visit(Field{"regularisation", Kind::section, "what a regularised kernel dropped; null: none was asked for",
              Presence::or_null},
        coupling.regularisation);
  visit(Field{"kernel_condition_max", Kind::ratio, "largest condition of the kernel", Presence::or_null},
        coupling.kernel_condition_max);
  visit(Field{"reductions", Kind::section, "by how much the robot lowers the resonances of the part"},
        coupling.reductions);
}

}  // namespace thinwall::report
