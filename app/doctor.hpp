#pragma once
// What this program was made of.

#include <string>

namespace thinwall::app {

/// "0.1.0".
[[nodiscard]] std::string program_version();

/// Versions of the libraries compiled in, threads, optional parts; one a line.
[[nodiscard]] std::string doctor_report();

}  // namespace thinwall::app
