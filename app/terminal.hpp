#pragma once
// Output that a terminal gets and a file does not: colour, bold, a line that is overwritten.

#include <ostream>
#include <string>

#include "app/stage_display.hpp"

namespace thinwall::app {

/// Marks words where `colour` holds, and leaves them as they are elsewhere. Marks take no room: pad a word first.
struct Style {
  bool colour = false;

  [[nodiscard]] std::string bold(const std::string& text) const { return marked("1", text); }
  [[nodiscard]] std::string good(const std::string& text) const { return marked("32", text); }
  [[nodiscard]] std::string bad(const std::string& text) const { return marked("1;31", text); }
  [[nodiscard]] std::string faint(const std::string& text) const { return marked("2", text); }

 private:
  [[nodiscard]] std::string marked(const char* code, const std::string& text) const {
    return colour ? "\033[" + std::string(code) + "m" + text + "\033[0m" : text;
  }
};

/// Colour for what is written to `stream`: if it is the standard output or error of the program, that is a terminal
/// which knows escape sequences (TERM is not "dumb"), and NO_COLOR is not set (https://no-color.org).
[[nodiscard]] Style style_for(const std::ostream& stream);

/// The report of a run with its title and stable depths bold, headings of tables faint, and what holds or does not in
/// green or red. Without colour the text itself; marks change nothing else.
[[nodiscard]] std::string coloured(const std::string& report, Style style);

/// The display that `--progress` and `-q` ask for. "auto": a line on a terminal, lines elsewhere, nothing with -q;
/// "always": with -q, too; "never": nothing. Escape sequences go to a terminal only, whatever is asked. Throws
/// UsageError for another word.
[[nodiscard]] ProgressDisplay progress_display(const std::string& wanted, bool quiet);

}  // namespace thinwall::app
