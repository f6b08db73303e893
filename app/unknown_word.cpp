#include "app/unknown_word.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "core/nearest_name.hpp"
#include "core/synonyms.hpp"

namespace thinwall::app {

namespace {

/// "--out" of "--out=DIR".
std::string option_name(const std::string& word) {
  return word.substr(0, word.find('='));
}

/// True if a word certainly is an option, or meant as one: what starts with one - may be a negative number, or -qv.
bool looks_like_option(const std::string& word) {
  if (word.starts_with("--")) return word != "--";
  return std::ranges::any_of(core::meanings(option_name(word)),
                             [](const core::Synonym& row) { return row.kind == core::WordKind::option; });
}

/// Of these words, which look like options.
std::string unknown_option(const std::vector<OptionDescription>& options, const std::string& command,
                           const std::vector<std::string>& words) {
  std::vector<std::string> names{"--help", "-h"};
  for (const auto& option : options) std::ranges::copy(option.names, std::back_inserter(names));
  for (const auto& word : words) {
    const std::string name = option_name(word);
    if (std::ranges::count(names, name) > 0) continue;
    return fmt::format("\"{}\" has no option \"{}\"{}; \"{} --help\" lists them", command, name,
                       core::did_you_mean(name, names), command);
  }
  return "";
}

}  // namespace

std::string unknown_word(const ProgramDescription& program, const std::vector<std::string>& words) {
  if (words.empty()) return "";
  if (words.front().starts_with('-')) return unknown_option(program.options, program.name, {words.front()});
  const auto command = std::ranges::find(program.commands, words.front(), &CommandDescription::name);
  if (command != program.commands.end()) {
    std::vector<std::string> options = words;
    std::erase_if(options, [](const std::string& word) { return !looks_like_option(word); });
    return unknown_option(command->options, program.name + " " + command->name, options);
  }
  std::vector<std::string> names;
  for (const auto& known : program.commands) names.push_back(known.name);
  return "there is no command \"" + words.front() + "\"" + core::did_you_mean(words.front(), names) + "; \"" +
         program.name + " --help\" lists the commands";
}

}  // namespace thinwall::app
