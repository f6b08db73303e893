#pragma once
// The words of the command line as data: what completion and the manual page are made from.

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace thinwall::app {

/// One option, or one argument by its place.
struct OptionDescription {
  std::vector<std::string> names;  ///< "-q", "--quiet"; of an argument by its place its name, "CASE"
  std::string value;               ///< what it takes: "DIR", "auto|always|never", "KEY=VALUE", "INT"; "" for a flag
  std::string bounds;              ///< "INT in [1 - 1024]", where there are any
  std::string meaning;
  bool by_place = false;
  bool required = false;
  bool repeated = false;  ///< by its place: several words may stand there
};

struct CommandDescription {
  std::string name;
  std::string meaning;
  std::vector<OptionDescription> options;
};

/// The program's own options, and its commands.
struct ProgramDescription {
  std::string name;
  std::string meaning;
  std::vector<OptionDescription> options;
  std::vector<CommandDescription> commands;
};

[[nodiscard]] ProgramDescription description_of(const CLI::App& program);

/// The word that stands where an option wants a value, for completion.
enum class ValueKind {
  none,       ///< no words can be proposed
  words,      ///< choices, "a|b"
  file,       ///< FILE
  folder,     ///< DIR
  case_path,  ///< PATH: a folder, or a .toml file
  key,        ///< KEY=…: a key of a case
};
[[nodiscard]] ValueKind value_kind(const OptionDescription& option);

/// The choices of a value "a|b".
[[nodiscard]] std::vector<std::string> choices_of(const OptionDescription& option);

}  // namespace thinwall::app
