#include "io/results/pvd.hpp"

#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "io/xml_text.hpp"

namespace thinwall::io {

void write_pvd(const std::filesystem::path& path, const std::vector<PvdEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  for (const PvdEntry& entry : entries) {
    if (!std::isfinite(entry.time)) throw core::NumericalError("the time of \"" + entry.file + "\" is not finite");
    text += "    <DataSet timestep=\"" + core::number_text(entry.time) + "\" part=\"0\" file=\"" +
            xml_escaped(entry.file) + "\"/>\n";
  }
  core::write_file_atomically(path, text + "  </Collection>\n</VTKFile>\n");
}

}  // namespace thinwall::io
