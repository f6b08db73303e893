#pragma once
// The libraries of this program, and a test that it works here.

#include <string>

namespace thinwall::app {

/// "0.1.0".
[[nodiscard]] std::string program_version();

/// "thinwall 0.1.0".
[[nodiscard]] std::string program_name();

/// The name that git gave to the sources when the program was built, "3a1f0c9d21b4" with "-dirty" where they were
/// changed; empty of sources without a repository.
[[nodiscard]] std::string program_commit();

/// Versions of the libraries compiled in, threads, optional parts; one a line.
[[nodiscard]] std::string doctor_report();

/// The output of `thinwall doctor`: doctor_report(), the machine (memory, the kernel that OpenBLAS chose), a self-test
/// (app/self_test.hpp) and a verdict in the last line. `works` is the verdict: false if the self-test fails. Some
/// tenths of a second. Throws Interrupted.
struct Diagnosis {
  std::string text;
  bool works = false;
};
[[nodiscard]] Diagnosis diagnosis();

}  // namespace thinwall::app
