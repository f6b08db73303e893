#include "app/completion.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "case/schema/schema.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::app {

namespace {

std::string joined(const std::vector<std::string>& words, const std::string& between = " ") {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

/// Keys that can be written without knowing the case: the first entry of an array, no table that the user names.
std::vector<std::string> settable_keys() {
  std::vector<std::string> keys;
  for (const cases::Key& key : cases::case_schema().keys) {
    std::string path(key.path);
    if (path.find('*') != std::string::npos) continue;
    for (auto at = path.find("[]"); at != std::string::npos; at = path.find("[]", at)) path.replace(at, 2, "[0]");
    keys.push_back(path + "=");
  }
  return keys;
}

/// In quotes of one stroke, with what may not stand there as the shell wants it.
std::string quoted_word(const std::string& text, const std::string& stroke) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? stroke : std::string(1, c);
  return word + "'";
}

std::vector<std::string> names_of(const std::vector<OptionDescription>& options) {
  std::vector<std::string> names;
  for (const auto& option : options) {
    if (!option.by_place) names.insert(names.end(), option.names.begin(), option.names.end());
  }
  return names;
}

/// The value that an option wants, as an action of bash.
std::string bash_action(const OptionDescription& option) {
  switch (value_kind(option)) {
    case ValueKind::words:
      return "_thinwall_words " + quoted_word(joined(choices_of(option)), "'\\''");
    case ValueKind::file:
      return "_thinwall_files";
    case ValueKind::folder:
      return "_thinwall_folders";
    case ValueKind::case_path:
      return "_thinwall_cases";
    case ValueKind::key:
      return "_thinwall_keys";
    case ValueKind::none:
      break;
  }
  return ":";
}

/// `case $before in` of a command: what each of its options wants, else what stands by its place or its options.
std::string bash_command(const CommandDescription& command) {
  std::string text = "    " + command.name + ")\n      case $before in\n";
  for (const auto& option : command.options) {
    if (option.by_place || option.value.empty()) continue;
    text += "        " + joined(option.names, "|") + ") " + bash_action(option) + "; return ;;\n";
  }
  text += "      esac\n      if [[ $word == -* ]]; then\n        _thinwall_words " +
          quoted_word(joined(names_of(command.options)), "'\\''") +
          "\n        return\n      fi\n      case $place in\n";
  int place = 0;
  for (const auto& option : command.options) {
    if (!option.by_place) continue;
    text += "        " + (option.repeated ? std::string("*") : std::to_string(++place)) + ") " + bash_action(option) +
            " ;;\n";
  }
  return text + "      esac\n      ;;\n";
}

std::string bash_script(const ProgramDescription& program) {
  std::vector<std::string> commands;
  for (const auto& command : program.commands) commands.push_back(command.name);
  std::vector<std::string> valued;
  for (const auto& command : program.commands) {
    for (const auto& option : command.options) {
      if (!option.by_place && !option.value.empty())
        valued.insert(valued.end(), option.names.begin(), option.names.end());
    }
  }
  std::ranges::sort(valued);
  valued.erase(std::unique(valued.begin(), valued.end()), valued.end());
  std::string text = R"(# Completion of thinwall in bash. In ~/.bashrc: source <(thinwall completion bash)

_thinwall_words() { mapfile -t COMPREPLY < <(compgen -W "$1" -- "$word"); }
_thinwall_files() { mapfile -t COMPREPLY < <(compgen -f -- "$word"); compopt -o filenames 2>/dev/null || true; }
_thinwall_folders() { mapfile -t COMPREPLY < <(compgen -d -- "$word"); compopt -o filenames 2>/dev/null || true; }
_thinwall_cases() {
  mapfile -t COMPREPLY < <(compgen -d -- "$word"; compgen -f -X '!*.toml' -- "$word")
  compopt -o filenames 2>/dev/null || true
}
_thinwall_keys() {
  _thinwall_words ')" +
                     joined(settable_keys()) + R"('
  compopt -o nospace 2>/dev/null || true
}

_thinwall() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} place=1 value='' i
  COMPREPLY=()
  if [[ $word == = ]]; then  # bash takes --out=DIR as three words
    word='' value=yes
  elif [[ $before == = ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]} value=yes
  fi
  if [[ -n $value && $before != -* ]]; then return; fi  # the value of a key
  if ((COMP_CWORD == 1)); then
    _thinwall_words ')" +
                     joined(commands) + " " + joined(names_of(program.options)) + R"('
    return
  fi
  for ((i = 2; i < COMP_CWORD; ++i)); do  # words by their place before this one
    case ${COMP_WORDS[i]} in
      )" + joined(valued, "|") +
                     R"() ((++i)) ;;
      -*|=|:) ;;
      *) [[ ${COMP_WORDS[i-1]} == [=:] ]] || ((++place)) ;;
    esac
  done
  case ${COMP_WORDS[1]} in
)";
  for (const auto& command : program.commands) text += bash_command(command);
  return text + "  esac\n}\ncomplete -F _thinwall thinwall ./thinwall\n";
}

/// Within [...] of _arguments and after the name of _describe.
std::string zsh_text(const std::string& text) {
  std::string escaped;
  for (const char c : text)
    escaped += c == '[' || c == ']' || c == ':' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return escaped;
}

std::string zsh_action(const OptionDescription& option) {
  switch (value_kind(option)) {
    case ValueKind::words:
      return "(" + joined(choices_of(option)) + ")";
    case ValueKind::file:
      return "_files";
    case ValueKind::folder:
      return "_files -/";
    case ValueKind::case_path:
      return "_files -g \"*.toml(-.)\"";
    case ValueKind::key:
      return "_thinwall_keys";
    case ValueKind::none:
      break;
  }
  return " ";
}

/// The arguments of _arguments for one option: one for each of its names, which exclude each other.
std::vector<std::string> zsh_specs(const OptionDescription& option) {
  const std::string value = option.value.empty() ? "" : ":" + zsh_text(option.names.back()) + ":" + zsh_action(option);
  if (option.by_place) return {quoted_word((option.repeated ? "*" : "") + value, "'\\''")};
  std::vector<std::string> specs;
  const bool several = value_kind(option) == ValueKind::key || option.names.back() == "--at";
  const std::string before = several ? "*" : option.names.size() > 1 ? "(" + joined(option.names) + ")" : "";
  for (const auto& name : option.names) {
    const std::string equals = name.starts_with("--") && !value.empty() ? "=" : "";  // --out DIR and --out=DIR
    const std::string spec = fmt::format("{}{}{}[{}]{}", before, name, equals, zsh_text(option.meaning), value);
    specs.push_back(quoted_word(spec, "'\\''"));
  }
  return specs;
}

std::string zsh_script(const ProgramDescription& program) {
  std::string text =
      "#compdef thinwall\n# Completion of thinwall in zsh: thinwall completion zsh > a folder of $fpath/_thinwall\n\n"
      "_thinwall_keys() {\n  local -a keys\n  keys=(";
  for (const auto& key : settable_keys()) text += "\n    " + quoted_word(key, "'\\''");
  text += "\n  )\n  compadd -S '' -a keys\n}\n\n_thinwall() {\n  local -a commands\n  commands=(\n";
  for (const auto& command : program.commands)
    text += "    " + quoted_word(command.name + ":" + zsh_text(command.meaning), "'\\''") + "\n";
  text +=
      "  )\n  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n  local "
      "command=$words[2]\n"
      "  shift words\n  (( CURRENT-- ))\n  case $command in\n";
  for (const auto& command : program.commands) {
    text += "    " + command.name + ")\n      _arguments -s";
    for (const auto& option : command.options) {
      for (const auto& spec : zsh_specs(option)) text += " \\\n        " + spec;
    }
    text += "\n      ;;\n";
  }
  return text +
         "  esac\n}\n\nif [[ $funcstack[1] == _thinwall ]]; then\n  _thinwall \"$@\"\nelse\n  compdef _thinwall "
         "thinwall\nfi\n";
}

/// In quotes of one stroke a backslash and a stroke take a backslash.
std::string fish_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  return word + "'";
}

std::string fish_action(const OptionDescription& option) {
  switch (value_kind(option)) {
    case ValueKind::words:
      return " -xa " + fish_word(joined(choices_of(option)));
    case ValueKind::file:
      return " -rF";
    case ValueKind::folder:
      return " -xa '(__fish_complete_directories)'";
    case ValueKind::case_path:
      return " -xa '(__fish_complete_suffix .toml)'";
    case ValueKind::key:
      return " -xa '$__thinwall_keys'";
    case ValueKind::none:
      break;
  }
  return option.value.empty() ? "" : " -x";
}

std::string fish_script(const ProgramDescription& program) {
  std::string text =
      "# Completion of thinwall in fish: thinwall completion fish > ~/.config/fish/completions/thinwall.fish\n\n"
      "set -g __thinwall_keys";
  for (const auto& key : settable_keys()) text += " \\\n    " + fish_word(key);
  text += "\n\ncomplete -c thinwall -f\n";
  for (const auto& command : program.commands) {
    text += "\ncomplete -c thinwall -n __fish_use_subcommand -a " + command.name + " -d " + fish_word(command.meaning) +
            "\n";
    const std::string there = "complete -c thinwall -n '__fish_seen_subcommand_from " + command.name + "'";
    for (const auto& option : command.options) {
      text += there;
      for (const auto& name : option.names) {
        if (!option.by_place) text += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      }
      std::string action = fish_action(option);
      if (option.by_place && action == " -rF") action = " -F";
      if (option.by_place && action == " -x") action = " -f";
      text += action + (option.by_place ? "" : " -d " + fish_word(option.meaning)) + "\n";
    }
  }
  return text;
}

}  // namespace

std::vector<std::string> completed_shells() {
  return {"bash", "zsh", "fish"};
}

std::string completion_script(const ProgramDescription& program, const std::string& shell) {
  if (shell == "bash") return bash_script(program);
  if (shell == "zsh") return zsh_script(program);
  if (shell == "fish") return fish_script(program);
  throw core::UsageError("there is no completion for \"" + shell + "\"" +
                         core::did_you_mean(shell, completed_shells()) + "; there are " +
                         joined(completed_shells(), ", "));
}

}  // namespace thinwall::app
