#pragma once
// ParaView's collection files, which combine several VTU files into a series.

#include <filesystem>
#include <string>
#include <vector>

namespace thinwall::io {

/// One file of a series, relative to the collection, and the value at which ParaView's time slider finds it (for modes:
/// the number of the mode).
struct PvdEntry {
  double time = 0.0;
  std::string file;
};

/// Writes the collection in one step. Throws DataError if it cannot be written, NumericalError for a time that is not
/// finite.
void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries);

}  // namespace thinwall::io
