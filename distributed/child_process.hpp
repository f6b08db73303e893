#pragma once
// A program that runs beside this one and answers its orders, line by line.

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace thinwall::distributed {

/// A program that was started with pipes to its input and from its output. It has a process group of its own, so that
/// an interruption from the keyboard reaches this process alone, and it is told to end when this process dies.
class ChildProcess {
 public:
  /// Starts words[0], looked up on the PATH, with `environment` put over that of this process; what it writes as errors
  /// goes to a file. Throws DataError if it cannot be started. To be called from a thread that lives as long as the
  /// program is needed, for its end is what the system tells the program.
  ChildProcess(const std::vector<std::string>& words, const std::map<std::string, std::string>& environment,
               const std::filesystem::path& errors);
  /// Ends the program: it is asked to, and killed if it has not ended after a tenth of a second.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Writes a line to the program's input; nothing happens if it has ended.
  void say(const std::string& line);
  /// The next line of its output, without its end; none if the program has ended. Throws Interrupted within a tenth of
  /// a second of a request (core/interrupt.hpp).
  [[nodiscard]] std::optional<std::string> hear();
  /// Waits up to `seconds` for the end of the program. True if it has ended.
  bool ends_within(double seconds);

 private:
  pid_t pid_ = -1;
  int to_ = -1, from_ = -1;
  std::string heard_;
};

}  // namespace thinwall::distributed
