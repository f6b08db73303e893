#include <algorithm>
#include <cmath>
#include <sstream>

#include "case/schema/physical_range.hpp"
#include "case/schema/schema.hpp"
#include "core/error.hpp"
#include "core/split.hpp"

namespace thinwall::cases {

namespace {

/// First name of a dotted path, and the rest.
std::pair<std::string_view, std::string_view> split(std::string_view path) {
  const auto dot = path.find('.');
  if (dot == std::string_view::npos) return {path, {}};
  return {path.substr(0, dot), path.substr(dot + 1)};
}

std::string_view without_index(std::string_view name) {
  return name.substr(0, name.find('['));
}

std::string join(std::string_view parent, std::string_view name) {
  return parent.empty() ? std::string(name) : std::string(parent) + "." + std::string(name);
}

std::string_view type_text(const Key& key) {
  switch (key.type) {
    case Type::text:
      return "text";
    case Type::file:
      return "file";
    case Type::choice:
      return "one of";
    case Type::name:
      return "name";
    case Type::names:
      return "list of names";
    case Type::boolean:
      return "true or false";
    case Type::integer:
      return "whole number";
    case Type::quantity:
      return key.kind.name;
    case Type::quantities:
      return "list";
    case Type::vector:
      return "x, y, z";
    case Type::polygon:
      return "list of corners";
    case Type::positions:
      return "list of x, y, z";
    case Type::direction:
      return "direction";
    case Type::directions:
      return "list of directions";
    case Type::amount:
      return "quantity";
  }
  return "";
}

std::string type_cell(const Key& key) {
  std::string text(type_text(key));
  if (key.type == Type::quantities || key.type == Type::vector || key.type == Type::polygon ||
      key.type == Type::positions)
    text += " (" + std::string(key.kind.name) + ")";
  for (const auto& choice : choices(key)) text += " `" + choice + "`";
  if (!key.kind.unit.empty()) text += ", " + std::string(key.kind.unit);
  return text;
}

/// A bound as people write it, in the key's own unit.
std::string bound_text(const Key& key, double bound) {
  return key.kind.unit.empty() ? core::number_text(bound) : core::readable_text(bound, key.kind);
}

bool is_numeric(Type type) {
  return type == Type::integer || type == Type::quantity || type == Type::quantities || type == Type::vector ||
         type == Type::polygon || type == Type::positions;
}

/// The text of a key's range on the page: numbers without bounds take any.
std::string range_cell(const Key& key) {
  if (!is_numeric(key.type)) return "";
  const std::string bounds = bounds_text(key);
  return (bounds.empty() ? "any" : bounds) + (key.bounds.infinity_allowed ? ", or `inf`" : "");
}

/// "`[part.mesh]`", "`[[updating.targets]]`".
std::string title_text(const Section& section) {
  if (section.path.empty()) return "Top level";
  std::string name;
  for (const char c : section.path) {
    if (c != '[' && c != ']') name += c == '*' ? std::string("NAME") : std::string(1, c);
  }
  return section.path.ends_with("[]") ? "`[[" + name + "]]`" : "`[" + name + "]`";
}

/// The row that says which alternative a key or table belongs to; nullptr of one that belongs to all.
const Belonging* belonging_of(const Schema& schema, std::string_view pattern) {
  const auto found = std::ranges::find(schema.belongings, pattern, &Belonging::path);
  return found == schema.belongings.end() ? nullptr : &*found;
}

/// "`model`: `hertz`, `caster`", by the chooser's whole name where it is of another table.
std::string alternative_text(const Belonging& belonging, std::string_view table) {
  std::string name(table_of(belonging.chooser) == table ? last_name(belonging.chooser) : belonging.chooser);
  std::erase_if(name, [](char c) { return c == '[' || c == ']'; });
  std::string text = "`" + name + "`:";
  for (const std::string& word : words_of(belonging.words)) text += (text.back() == ':' ? " `" : ", `") + word + "`";
  return text;
}

/// The default of a key on the page.
std::string default_cell(const Key& key, const Belonging* belonging) {
  if (belonging != nullptr && belonging->needed && !belonging->unless.empty())
    return "required, or `" + std::string(last_name(belonging->unless)) + "`";
  if (key.required || (belonging != nullptr && belonging->needed)) return "required";
  return key.fallback.empty() ? "–" : "`" + std::string(key.fallback) + "`";
}

/// The text above a section's keys.
std::string section_text(const Schema& schema, const Section& section) {
  std::string text(section.meaning);
  if (const Belonging* belonging = belonging_of(schema, section.path))
    text += std::string(belonging->needed ? " Required by " : " Only with ") +
            alternative_text(*belonging, "of another table") + ".";
  const auto implying = implying_keys(section);
  for (std::size_t i = 0; i < implying.size(); ++i)
    text += (i == 0 ? " Filled with its defaults where `" : "` or `") + implying[i];
  return text + (implying.empty() ? "" : "` is given.");
}

}  // namespace

std::vector<std::string> words_of(std::string_view list) {
  return core::split(list, '|');
}

std::string_view table_of(std::string_view path) {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? std::string_view() : path.substr(0, dot);
}

std::string_view last_name(std::string_view path) {
  const auto dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(dot + 1);
}

const Key* find_key(const Schema& schema, std::string_view pattern) {
  const auto found = std::ranges::find(schema.keys, pattern, &Key::path);
  return found == schema.keys.end() ? nullptr : &*found;
}

const Section* find_section(const Schema& schema, std::string_view pattern) {
  const auto found = std::ranges::find(schema.sections, pattern, &Section::path);
  return found == schema.sections.end() ? nullptr : &*found;
}

std::vector<std::string> names_below(const Schema& schema, std::string_view pattern) {
  std::vector<std::string> names;
  const auto add = [&](std::string_view path) {
    if (!pattern.empty()) {
      if (!path.starts_with(pattern) || path.size() <= pattern.size() || path[pattern.size()] != '.') return;
      path.remove_prefix(pattern.size() + 1);
    }
    const std::string name(without_index(split(path).first));
    if (!name.empty() && std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const auto& key : schema.keys) add(key.path);
  for (const auto& section : schema.sections) add(section.path);
  return names;
}

std::string pattern_of(const Schema& schema, std::string_view path) {
  std::string pattern;
  while (!path.empty()) {
    const auto [name, rest] = split(path);
    const auto below = names_below(schema, pattern);
    const std::string_view bare = without_index(name);
    const bool named_by_user = below.size() == 1 && below.front() == "*";
    std::string next = join(pattern, named_by_user ? "*" : bare);
    if (bare.size() < name.size() && find_key(schema, next) == nullptr) next += "[]";
    pattern = std::move(next);
    path = rest;
  }
  return pattern;
}

std::string full_path(const Schema& schema, const std::string& path) {
  if (find_key(schema, pattern_of(schema, path)) != nullptr) return path;
  const std::string_view first = split(path).first, last = last_name(path);
  std::vector<std::string> matches;
  for (const auto& key : schema.keys) {
    const bool plain = key.path.find_first_of("[*") == std::string_view::npos;
    if (plain && split(key.path).first == first && last_name(key.path) == without_index(last)) {
      matches.push_back(std::string(key.path) + std::string(last.substr(without_index(last).size())));
    }
  }
  return matches.size() == 1 ? matches.front() : path;
}

std::vector<std::string> choices(const Key& key) {
  return words_of(key.choices);
}

std::vector<std::string> implying_keys(const Section& section) {
  return words_of(section.implied_by);
}

std::string bounds_text(const Key& key) {
  const Bounds& bounds = key.bounds;
  std::string text;
  if (std::isfinite(bounds.lower)) text = (bounds.lower_open ? "above " : "at least ") + bound_text(key, bounds.lower);
  if (std::isfinite(bounds.upper)) {
    text += (text.empty() ? "" : ", ") + std::string(bounds.upper_open ? "below " : "at most ") +
            bound_text(key, bounds.upper);
  }
  return text;
}

void require_within_bounds(const Key& key, double value) {
  const Bounds& bounds = key.bounds;
  if (bounds.infinity_allowed && value == std::numeric_limits<double>::infinity()) return;
  const bool above = bounds.lower_open ? value > bounds.lower : value >= bounds.lower;
  const bool below = bounds.upper_open ? value < bounds.upper : value <= bounds.upper;
  if (std::isfinite(value) && above && below) return require_physical(key, value);
  const std::string allowed = bounds_text(key);
  throw core::InputError(core::exact_text(value, key.kind) + " is out of range: it must be " +
                         (allowed.empty() ? "finite" : allowed) +
                         (bounds.hint.empty() ? "" : "; " + std::string(bounds.hint)));
}

std::string schema_markdown(const Schema& schema) {
  std::ostringstream text;
  for (const auto& section : schema.sections) {
    const auto here = [&](const auto& row) { return table_of(row.path) == section.path; };
    const bool alternatives = std::ranges::any_of(schema.belongings, [&](const Belonging& belonging) {
      return here(belonging) && find_key(schema, belonging.path) != nullptr;
    });
    text << "### " << title_text(section) << "\n\n"
         << section_text(schema, section) << "\n\n| key | " << (alternatives ? "only with | " : "")
         << "what it takes | default | bounds | meaning |\n|---|" << (alternatives ? "---|" : "")
         << "---|---|---|---|\n";
    for (const auto& key : schema.keys) {
      if (!here(key)) continue;
      const Belonging* belonging = belonging_of(schema, key.path);
      text << "| `" << last_name(key.path) << "` | ";
      if (alternatives) text << (belonging == nullptr ? "" : alternative_text(*belonging, section.path)) << " | ";
      text << type_cell(key) << " | " << default_cell(key, belonging) << " | " << range_cell(key) << " | "
           << key.meaning << " |\n";
    }
    text << "\n";
  }
  return text.str();
}

}  // namespace thinwall::cases
