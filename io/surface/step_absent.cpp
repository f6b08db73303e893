// In place of step.cpp in a program that is built without Open CASCADE.

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface/step.hpp"

namespace thinwall::io {

bool reads_step() {
  return false;
}

StepSurface read_step(const std::filesystem::path& path, const StepOptions& /*options*/) {
  (void)core::read_file(path);  // throws for a file that is not there: a reader would not help
  throw core::InputError("\"" + path.string() +
                         "\": this build has no STEP reader; install libocct-data-exchange-dev and build again, or "
                         "export the part as STL");
}

}  // namespace thinwall::io
