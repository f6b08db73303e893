#pragma once
// Measured FRFs of a case, read and put on the axis of the run.

#include <vector>

#include "app/case.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "io/frf_csv.hpp"
#include "reduction/identification.hpp"

namespace thinwall::app {

/// One file as receptance on its own axis. Errors as io::read_frf.
[[nodiscard]] io::MeasuredFrf read_measured(const MeasuredFrf& measured);

/// The files of one component as an FRF matrix on `axis`: rows and columns are the DOFs that the files name; an entry
/// that only its transpose gives is taken from there (reciprocity). Throws InputError for an entry that no file gives,
/// DataError as io::resample.
[[nodiscard]] dynamics::ResponseModel measured_response(const std::vector<MeasuredFrf>& files,
                                                        const dynamics::FrequencyAxis& axis);

/// Damping ratios of the reduced model's elastic modes, by rising frequency: each identified one at the mode nearest to
/// it, `rest` at the others. Throws InputError where none is within 10 %.
[[nodiscard]] std::vector<double> matched_ratios(const dynamics::SpatialModel& reduced,
                                                 const std::vector<reduction::IdentifiedMode>& identified, double rest);

}  // namespace thinwall::app
