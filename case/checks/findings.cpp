#include "case/checks/findings.hpp"

#include <algorithm>

#include "core/nearest_name.hpp"

namespace thinwall::cases {

void Findings::report(const std::string& key, const std::string& text) {
  const CaseValue* place = find(values, key);
  if (place != nullptr && place->line == 0) place = nullptr;  // a default stands nowhere: point at its table
  for (std::string table = key; place == nullptr && !table.empty();) {
    const auto found = std::ranges::find_if(values, [&](const CaseValue& value) {
      return value.from_file && value.key.starts_with(table) && value.key.size() > table.size();
    });
    if (found != values.end()) place = &*found;
    const auto dot = table.rfind('.');
    table = dot == std::string::npos ? "" : table.substr(0, dot);
  }
  problems.push_back({place == nullptr ? 0 : place->line, place == nullptr ? 0 : place->column, key + ": " + text});
}

bool Findings::written(const std::string& key) const {
  const CaseValue* value = find(values, key);
  return value != nullptr && value->from_file;
}

bool Findings::unreadable(const std::string& key) const {
  const CaseValue* value = find(values, key);
  const auto* text = value == nullptr ? nullptr : std::get_if<std::string>(&value->value);
  return text != nullptr && text->empty();
}

bool Findings::reported(const std::string& key) const {
  return std::ranges::any_of(problems, [&](const Problem& problem) { return problem.text.starts_with(key + ": "); });
}

void Findings::require_known(const std::string& key, const std::string& name, const std::vector<std::string>& known,
                             const std::string& what) {
  if (name.empty() || std::ranges::find(known, name) != known.end()) return;
  std::string list;
  for (const auto& candidate : known) list += (list.empty() ? "" : ", ") + candidate;
  report(key, "there is no " + what + " \"" + name + "\"" + core::did_you_mean(name, known) +
                  (list.empty() ? "; the case names none" : "; the case has " + list));
}

std::string indexed(const std::string& table, std::size_t index) {
  return table + "[" + std::to_string(index) + "]";
}

}  // namespace thinwall::cases
