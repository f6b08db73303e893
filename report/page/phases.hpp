#pragma once
// A mode shape as a film that ParaView plays at once.

#include <filesystem>
#include <string>

namespace thinwall::report {

/// Which shape of a result folder, and how large it is drawn.
struct PhasesRequest {
  std::string of = "part";  ///< "part", or "coupled": with the robot
  int mode = 1;             ///< its number in modes/modes.csv or coupled_modes.csv
  double amplitude = 0.1;   ///< largest displacement over the part's diagonal, 0.001 to 10
};

/// Writes modes/<of>_mode_<NN>_phases.pvd and sixteen surfaces beside it, x + a u cos(2πk/16) of u the shape on
/// modes/<of>_surface.vtp, with |u cos| as data of the triangles to colour by. Returns the path of the .pvd. Throws
/// UsageError for another `of`, InputError for a mode that is not there or an amplitude out of range, DataError for
/// files that cannot be read or written.
std::filesystem::path write_phases(const std::filesystem::path& results, const PhasesRequest& request);

}  // namespace thinwall::report
