#include "app/memory_option.hpp"

#include <unistd.h>

#include <chrono>
#include <string>
#include <thread>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/units.hpp"

namespace thinwall::app {

namespace {

constexpr double least_bytes = 1e8, most_bytes = 1e15;  // the latter is the bound of part.mesh.memory_limit, too

/// Ends the process as soon as it holds more than the limit; memory that the estimates of the stages do not foresee.
/// The process looks at itself a hundred times a second, in which it can take some 20 MB: so much is kept away from the
/// limit.
[[noreturn]] void watch(double limit_bytes) {
  constexpr double margin_bytes = 2e7;
  while (core::held_memory_bytes() < limit_bytes - margin_bytes)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  const std::string text = "thinwall: out of memory: the process has come to hold the " +
                           core::readable_text(limit_bytes, core::kind::memory) +
                           " of --memory; take larger elements, a lower order or fewer modes, or give more\n";
  core::remove_partial_paths();
  (void)!::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(static_cast<int>(core::ExitCode::numerical));
}

void limit_memory(const std::string& text) {
  double bytes = 0.0;
  try {
    bytes = core::parse_quantity(text, core::kind::memory);
  } catch (const core::InputError& error) {
    throw core::UsageError(std::string("--memory: ") + error.what());
  }
  if (bytes < least_bytes)
    throw core::UsageError("--memory: " + text + " is less than the program itself takes; give at least " +
                           core::readable_text(least_bytes, core::kind::memory));
  if (!(bytes <= most_bytes))
    throw core::UsageError("--memory: " + text + " is more than a machine has; give at most " +
                           core::readable_text(most_bytes, core::kind::memory));
  core::set_memory_limit(bytes);
  std::thread(watch, bytes).detach();
}

}  // namespace

void add_memory_option(CLI::App& command) {
  command
      .add_option_function<std::string>(
          "--memory", limit_memory, "memory that the process may hold, \"4 GB\" (default: what the machine has free)")
      ->type_name("BYTES");
}

}  // namespace thinwall::app
