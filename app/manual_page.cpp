#include "app/manual_page.hpp"

namespace thinwall::app {

namespace {

/// Text of the page: hyphens that can be copied, no line that begins a request, no character beyond ASCII.
std::string troff(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '\\' ? std::string("\\e") : c == '-' ? std::string("\\-") : std::string(1, c);
  for (auto at = safe.find("…"); at != std::string::npos; at = safe.find("…", at)) safe.replace(at, 3, "...");
  return safe.starts_with('.') || safe.starts_with('\'') ? "\\&" + safe : safe;
}

std::string sentence(const std::string& text) {
  const bool ended = text.ends_with('.') || text.ends_with(')') || text.ends_with("…");
  return troff(text) + (ended ? "" : ".") + "\n";
}

/// "-o, --out DIR" in bold and italics, then the meaning.
std::string manual_entry(const OptionDescription& option) {
  std::string text = ".TP\n";
  for (std::size_t i = 0; i < option.names.size(); ++i)
    text += (i == 0 ? "" : ", ") + std::string(option.by_place ? "\\fI" : "\\fB") + troff(option.names[i]) + "\\fR";
  if (!option.value.empty() && !option.by_place) text += " \\fI" + troff(option.value) + "\\fR";
  return text + "\n" + sentence(option.meaning) + (option.bounds.empty() ? "" : sentence("Takes " + option.bounds));
}

std::string synopsis(const CommandDescription& command) {
  std::string text = "\\fBthinwall " + troff(command.name) + "\\fR";
  for (const auto& option : command.options) {
    if (!option.by_place) continue;
    const std::string name = "\\fI" + troff(option.names.front()) + "\\fR" + (option.repeated ? " ..." : "");
    text += option.required ? " " + name : " [" + name + "]";
  }
  return text + " [\\fIoptions\\fR]\n";
}

/// Sections that no command's description gives.
constexpr auto rest = R"(.SH EXIT STATUS
.TP
\fB0\fR
Done.
.TP
\fB1\fR
Internal error.
.TP
\fB2\fR
The command line is wrong.
.TP
\fB3\fR
The case is wrong.
.TP
\fB4\fR
A data file cannot be read, or the output not be written.
.TP
\fB5\fR
Numerical failure.
.TP
\fB6\fR
Done, but an expectation of the case does not hold, two results differ, or a model should not be trusted.
.TP
\fB130\fR
Interrupted.
.SH ENVIRONMENT
.TP
\fBNO_COLOR\fR
If set and not empty, no colours on a terminal.
.TP
\fBTERM\fR
With \fBdumb\fR neither colours nor a line of progress that is overwritten.
.SH FILES
.TP
\fIcase.toml\fR
The case: every key is in docs/case\-file.md; \fBthinwall schema\fR prints a JSON Schema for editors.
.TP
\fIexpected.toml\fR
Beside it: figures that the results are compared with.
.TP
\fIresults/CASE/\fR
What a run leaves: \fIsummary.json\fR, \fIreport.html\fR, tables and shapes.
.SH EXAMPLES
.EX
thinwall init \-\-template wall first
thinwall check first
thinwall run first
thinwall run first \-\-set part.thickness="3 mm" \-\-at "9000 rpm, 0.5 mm"
thinwall sweep first part.thickness="2 mm:4 mm:0.5 mm"
.EE
)";

}  // namespace

std::string manual_page(const ProgramDescription& program) {
  std::string text =
      ".\\\" Printed by thinwall man; do not edit.\n.TH THINWALL 1 \"\" \"thinwall\" \"User Commands\"\n.SH "
      "NAME\nthinwall \\- " +
      troff("vibration and stability of thin-walled parts under the cutter") + "\n.SH SYNOPSIS\n";
  for (const auto& command : program.commands) text += synopsis(command) + ".br\n";
  text += ".SH DESCRIPTION\n" + sentence(program.meaning) + ".SH OPTIONS\n";
  for (const auto& option : program.options) text += manual_entry(option);
  text += ".SH COMMANDS\n";
  for (const auto& command : program.commands) {
    text += ".SS " + troff(command.name) + "\n" + sentence(command.meaning);
    for (const auto& option : command.options) text += manual_entry(option);
  }
  return text + rest;
}

}  // namespace thinwall::app
