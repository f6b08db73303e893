#include "app/command_description.hpp"

#include <CLI/CLI.hpp>

#include "core/split.hpp"

namespace thinwall::app {

namespace {

OptionDescription description_of_option(const CLI::Option& option) {
  OptionDescription description;
  description.meaning = option.get_description();
  description.required = option.get_required();
  for (const auto& name : option.get_snames()) description.names.push_back("-" + name);
  for (const auto& name : option.get_lnames()) description.names.push_back("--" + name);
  description.by_place = description.names.empty();
  if (description.by_place) description.names.push_back(option.get_name(true));
  if (option.get_items_expected_max() > 0) {  // not a flag; its type, and behind a colon what its checks say
    const std::string type = option.get_type_name();
    const auto colon = type.find(':');
    description.value = type.substr(0, colon);
    if (colon != std::string::npos) description.bounds = type.substr(colon + 1);
  }
  description.repeated = description.by_place && option.get_items_expected_max() > 1;
  return description;
}

std::vector<OptionDescription> described_options(const CLI::App& command) {
  std::vector<OptionDescription> options;
  for (const CLI::Option* option : command.get_options()) options.push_back(description_of_option(*option));
  return options;
}

}  // namespace

ProgramDescription description_of(const CLI::App& program) {
  ProgramDescription description{program.get_name(), program.get_description(), described_options(program), {}};
  for (const CLI::App* command : program.get_subcommands({}))
    description.commands.push_back({command->get_name(), command->get_description(), described_options(*command)});
  return description;
}

ValueKind value_kind(const OptionDescription& option) {
  if (option.value.find('|') != std::string::npos) return ValueKind::words;
  if (option.value == "FILE") return ValueKind::file;
  if (option.value == "DIR") return ValueKind::folder;
  if (option.value == "PATH") return ValueKind::case_path;
  if (option.value.starts_with("KEY=")) return ValueKind::key;
  return ValueKind::none;
}

std::vector<std::string> choices_of(const OptionDescription& option) {
  return core::split(option.value, '|');
}

}  // namespace thinwall::app
