#pragma once
// Exceptions of the program. Each type carries the exit code of the command line (docs/conventions.md). A numerical
// outcome that the caller can handle is not an exception: it is a status beside the result.

#include <stdexcept>
#include <string>

namespace thinwall::core {

/// Exit codes of the program (docs/conventions.md, exit codes).
enum class ExitCode : int {
  done = 0,
  internal = 1,
  usage = 2,
  invalid_case = 3,
  unreadable_data = 4,
  numerical = 5,
  expectation = 6,
  interrupted = 130,
};

/// Base of every error that reaches the user. The message names in one line the fault, its place (file, line or key),
/// the bound that was violated and the remedy.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// The exit code of the program if the error is not caught.
  [[nodiscard]] ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// The error of a wrong command line (exit 2).
struct UsageError : Error {
  explicit UsageError(const std::string& message) : Error(ExitCode::usage, message) {}
};

/// The error of a case or an argument that asks for something impossible or contradictory (exit 3).
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::invalid_case, message) {}
};

/// The error of a data file that cannot be read, or of output that cannot be written (exit 4).
struct DataError : Error {
  explicit DataError(const std::string& message) : Error(ExitCode::unreadable_data, message) {}
};

/// The error of a computation that does not reach the accuracy that was asked for (exit 5).
struct NumericalError : Error {
  explicit NumericalError(const std::string& message) : Error(ExitCode::numerical, message) {}
};

/// The interruption of a run by the user (exit 130).
struct Interrupted : Error {
  Interrupted() : Error(ExitCode::interrupted, "interrupted") {}
};

}  // namespace thinwall::core
