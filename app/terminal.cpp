#include "app/terminal.hpp"

#include <unistd.h>

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string_view>

#include "core/error.hpp"

namespace thinwall::app {

namespace {

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

/// A terminal that knows escape sequences.
bool is_capable_terminal(int descriptor) {
  const char* kind = std::getenv("TERM");
  return ::isatty(descriptor) != 0 && kind != nullptr && std::string_view(kind) != "dumb";
}

/// The line's first `word` as `mark` makes it.
template <typename Mark>
void mark_word(std::string& line, const std::string& word, const Mark& mark) {
  const auto at = line.find(word);
  if (at != std::string::npos) line.replace(at, word.size(), mark(word));
}

std::string coloured_line(std::string line, Style style) {
  if (line.starts_with("  stability chart ") || line.starts_with("  expected ")) return style.faint(line);
  if (line.starts_with("  ok   ")) return "  " + style.good("ok") + line.substr(4);
  if (line.starts_with("  MISS ")) return "  " + style.bad("MISS") + line.substr(6);
  if (line.starts_with("  expectation not met")) return style.bad(line);
  if (const auto stable = line.find("stable up to "); stable != std::string::npos) {
    const auto depth = stable + std::string_view("stable up to ").size();
    const auto end = line.find(" at ", depth);
    if (end != std::string::npos) line.replace(depth, end - depth, style.bold(line.substr(depth, end - depth)));
    return line;
  }
  mark_word(line, ": UNSTABLE", [&](const std::string& word) { return ": " + style.bad(word.substr(2)); });
  mark_word(line, ": stable,", [&](const std::string&) { return ": " + style.good("stable") + ","; });
  return line;
}

}  // namespace

std::string coloured(const std::string& report, Style style) {
  if (!style.colour) return report;
  std::istringstream lines(report);
  std::string text, line;
  for (bool title = true; std::getline(lines, line);) {
    const bool is_title = title && !line.empty();
    text += (is_title ? style.bold(line) : coloured_line(line, style)) + "\n";
    title = title && !is_title;
  }
  return text;
}

Style style_for(const std::ostream& stream) {
  const int descriptor = &stream == &std::cout ? STDOUT_FILENO : &stream == &std::cerr ? STDERR_FILENO : -1;
  return {descriptor >= 0 && is_capable_terminal(descriptor) && !is_set("NO_COLOR")};
}

ProgressDisplay progress_display(const std::string& wanted, bool quiet) {
  if (wanted != "auto" && wanted != "always" && wanted != "never")
    throw core::UsageError("--progress \"" + wanted + "\": it is auto, always or never");
  if (wanted == "never" || (wanted == "auto" && quiet)) return ProgressDisplay::none;
  return is_capable_terminal(STDERR_FILENO) ? ProgressDisplay::line : ProgressDisplay::lines;
}

}  // namespace thinwall::app
