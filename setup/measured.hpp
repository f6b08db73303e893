#pragma once
// Measured FRFs of a case, read and put on the axis of the run.

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "io/frf/measured_response.hpp"
#include "reduction/identification.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The kind of a file of FRFs.
enum class FrfFileKind { csv, lvm, cutpro, universal, mat };
/// The kind of a file of FRFs by its ending .frf, .lvm, .uff, .unv, .mat or .csv; a file of another ending is MAT by
/// its first bytes, or else a CSV.
[[nodiscard]] FrfFileKind frf_file_kind(const std::filesystem::path& file);

/// True if a file of this kind says what was measured, and in which unit.
[[nodiscard]] inline bool tells_quantity(FrfFileKind kind) {
  return kind != FrfFileKind::csv && kind != FrfFileKind::lvm;
}

/// The FRFs of files that were read, by the file and by what is stated of it.
using FrfFiles = std::map<std::string, io::MeasuredEntries>;

/// Reads one FRF of a file as receptance on its own axis. The file is taken from `files` where it was read before, and
/// is put there. Errors as those of its format in io/, and InputError for a file of several FRFs of which the case does
/// not say which (they are listed), or that does not say what it holds.
[[nodiscard]] FrfContent read_measured(const MeasuredFrf& measured, FrfFiles& files);
/// Reads one FRF of a file by itself.
[[nodiscard]] FrfContent read_measured(const MeasuredFrf& measured);

/// All FRFs of a file. Those of a format that tells no DOFs lie between the ones that `measured` names, and a CSV may
/// be a matrix of io::write_response(). Directions against an axis are turned along it, with the sign of the FRF.
/// Errors as those of its format in io/, and InputError for a file that does not say what it holds.
[[nodiscard]] io::MeasuredEntries read_all_measured(const MeasuredFrf& measured);

/// The receptance that was read of the file. Throws InputError where it was not read (setup/data_files.hpp).
[[nodiscard]] const io::MeasuredFrf& receptance_of(const MeasuredFrf& measured);

/// The files of one component as an FRF matrix on `axis`: rows and columns are the DOFs that the files name; an entry
/// that only its transpose gives is taken from there (reciprocity). Throws InputError for files that make no matrix
/// (setup/measured_layout.hpp) or were not read, DataError as io::resample.
[[nodiscard]] dynamics::ResponseModel measured_response(const std::vector<MeasuredFrf>& files,
                                                        const dynamics::FrequencyAxis& axis);

/// Warns of what speaks against a measured matrix: signs, reciprocity, passivity, scatter at low frequencies
/// (dynamics/frf_checks.hpp). `whose`: "the robot's".
void warn_if_implausible(const dynamics::ResponseModel& measured, const std::string& whose);

/// Damping ratios of the reduced model's elastic modes, by rising frequency: each identified one at the mode nearest to
/// it, `rest` at the others. Throws InputError where none is within 10 %.
[[nodiscard]] std::vector<double> matched_ratios(const dynamics::SpatialModel& reduced,
                                                 const std::vector<reduction::IdentifiedMode>& identified, double rest);

}  // namespace thinwall::setup
