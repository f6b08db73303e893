#include "case/toml_values.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <map>
#include <optional>

#include "case/alternatives.hpp"
#include "case/toml_nesting.hpp"
#include "case/toml_node.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/synonyms.hpp"

namespace thinwall::cases {

namespace {

using core::InputError;

std::string join(const std::string& parent, std::string_view name) {
  return parent.empty() ? std::string(name) : parent + "." + std::string(name);
}

/// A --set that was put over the document: its key in full, and where its value starts in the option's text.
struct Override {
  std::string path;
  int value_column = 1;
};

/// The most tables that an array of tables, or a table whose entries the user names, may have: a hundred times what
/// cases have, and few enough that any file is told about at once.
constexpr std::size_t most_tables = 1000;

/// Problems beyond so many come without the key that was perhaps meant: they are counted, not shown.
constexpr std::size_t most_suggestions = 10 * shown_problems;

/// "[part.mesh]", "[[tool.modes]]".
std::string table_title(std::string_view path) {
  const std::string title = "[" + std::string(path.substr(0, path.size() - (path.ends_with("[]") ? 2 : 0))) + "]";
  return path.ends_with("[]") ? "[" + title + "]" : title;
}

/// Walks the document along the schema and gathers values and problems.
class Walk {
 public:
  Walk(const Schema& schema, const std::vector<Override>& overrides) : schema_(schema), overrides_(overrides) {}

  void table(const toml::table& table, const std::string& path, const std::string& pattern) {
    const std::vector<std::string>& below = names(pattern);
    const bool named_by_user = below.size() == 1 && below.front() == "*";
    if (named_by_user && table.size() > most_tables) return report_many(table.source().begin, path, table.size());
    for (const auto& [name, node] : in_file_order(table)) entry(*name, *node, path, pattern);
    for (const auto& key : schema_.keys) absent_key(key, table, path, pattern);
    for (const auto& section : schema_.sections) implied_section(section, table, path, pattern);
  }

  CaseValues values;
  std::vector<Problem> problems;
  std::optional<Problem> too_many;  ///< tables of one kind, which were not walked: what else seems to lack may be there

 private:
  using Entries = std::vector<std::pair<const toml::key*, const toml::node*>>;

  static Entries in_file_order(const toml::table& table) {
    Entries entries;
    for (const auto& [name, node] : table) entries.emplace_back(&name, &node);
    std::ranges::stable_sort(entries, [](const auto& a, const auto& b) {
      const auto x = a.first->source().begin, y = b.first->source().begin;
      return std::pair(x.line, x.column) < std::pair(y.line, y.column);
    });
    return entries;
  }

  /// True if the key or table `inner` is `outer` or lies in it.
  static bool within(const std::string& inner, const std::string& outer) {
    return inner.starts_with(outer) &&
           (inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[');
  }

  /// The place of the --set of that number, at its value if its key is one.
  [[nodiscard]] Problem place_of_option(std::size_t number) const {
    const Override& option = overrides_[number];
    const bool key = find_key(schema_, pattern_of(schema_, option.path)) != nullptr;
    return {-static_cast<int>(number) - 1, key ? option.value_column : 1, ""};
  }

  /// The place of `path`: in the last --set that it lies in, whose own text a table counts its lines from; else in the
  /// file; else in the last --set that lies in it.
  [[nodiscard]] Problem place_of(const toml::source_position& place, const std::string& path) const {
    for (auto i = overrides_.size(); i > 0; --i) {
      if (within(path, overrides_[i - 1].path)) return place_of_option(i - 1);
    }
    if (place.line > 0) return {static_cast<int>(place.line), static_cast<int>(place.column), ""};
    for (auto i = overrides_.size(); i > 0; --i) {
      const std::string& option = overrides_[i - 1].path;
      if (within(option, path) || within(path, option.substr(0, option.find('[')))) return place_of_option(i - 1);
    }
    return {};
  }

  /// The place of what is wrong with a list: in the last --set of an entry that is at fault by itself, else the list's.
  [[nodiscard]] Problem place_in_list(const Key& key, const toml::node& node, const std::string& path,
                                      const Problem& of_list) const {
    const toml::array* list = node.as_array();
    Key one = key;
    if (key.type == Type::vector) one.type = Type::quantities;
    for (auto i = overrides_.size(); list != nullptr && i > 0; --i) {
      const std::string& option = overrides_[i - 1].path;
      if (!option.starts_with(path + "[") || !option.ends_with(']')) continue;
      const auto entry = std::stoul("0" + option.substr(path.size() + 1));
      try {
        if (entry < list->size()) (void)read_value(*list->get(entry), one);
      } catch (const InputError&) {
        return place_of_option(i - 1);
      }
    }
    return of_list;
  }

  void report(const toml::source_position& place, const std::string& path, const std::string& text) {
    problems.push_back(place_of(place, path));
    problems.back().text = path + ": " + text;
  }

  void report_many(const toml::source_position& place, const std::string& path, std::size_t count) {
    report(place, path,
           std::to_string(count) + " tables are too many, at most " + std::to_string(most_tables) +
               " are read; remove those that are not needed");
    too_many = problems.back();
  }

  /// names_below(), which are asked for again and again.
  const std::vector<std::string>& names(const std::string& pattern) {
    const auto [known, is_new] = names_.try_emplace(pattern);
    if (is_new) known->second = names_below(schema_, pattern);
    return known->second;
  }

  void report_unknown(const toml::key& name, const std::string& path, const std::string& pattern,
                      const std::vector<std::string>& known) {
    std::string hint;
    if (problems.size() < most_suggestions) {
      if (core::meant_name(name.str(), known).empty()) hint = meant_elsewhere(name.str(), pattern);
      if (hint.empty()) hint = core::did_you_mean(name.str(), known) + place_hint(name);
    }
    report(name.source().begin, path, "unknown key" + hint);
  }

  void entry(const toml::key& name, const toml::node& node, const std::string& path, const std::string& pattern) {
    const std::vector<std::string>& below = names(pattern);
    const bool named_by_user = below.size() == 1 && below.front() == "*";
    const std::string child_path = join(path, name.str());
    const std::string child = join(pattern, named_by_user ? "*" : name.str());
    if (named_by_user && !is_name(name.str())) {
      report(name.source().begin, child_path, "a name starts with a letter and goes on with letters, digits and _");
    } else if (!named_by_user && std::ranges::find(below, name.str()) == below.end()) {
      report_unknown(name, child_path, pattern, below);
    } else if (const Key* key = find_key(schema_, child)) {
      value(*key, node, child_path);
    } else if (find_section(schema_, child + "[]") != nullptr) {
      array(name, node, child_path, child + "[]");
    } else if (const auto* inner = node.as_table()) {
      table(*inner, child_path, child);
    } else {
      report(name.source().begin, child_path,
             "got " + std::string(node_type(node)) + ", expected a table [" + child_path + "]");
    }
  }

  /// " (did you mean "depth_limit" of [lobes]?)", with the synonym's remark, where another table has what a name means:
  /// the first table below this one, else the only one.
  [[nodiscard]] std::string meant_elsewhere(std::string_view name, const std::string& pattern) const {
    for (const core::Synonym& row : core::meanings(name)) {
      std::vector<std::string_view> tables;
      bool below = false;
      for (auto key = schema_.keys.begin(); key != schema_.keys.end() && !below; ++key) {
        if (last_name(key->path) != row.meant || table_of(key->path).empty()) continue;
        below = !pattern.empty() && key->path.starts_with(pattern + ".");
        if (below) tables.clear();
        tables.push_back(table_of(key->path));
      }
      if (tables.size() == 1) {
        return " (did you mean \"" + std::string(row.meant) + "\" of " + table_title(tables.front()) + "?)" +
               (row.remark.empty() ? "" : "; " + std::string(row.remark));
      }
    }
    return "";
  }

  /// "; it belongs to [part.mesh]" where exactly one other table knows the name.
  [[nodiscard]] std::string place_hint(const toml::key& name) const {
    std::vector<std::string> places;
    for (const auto& key : schema_.keys) {
      const auto dot = key.path.rfind('.');
      if (dot != std::string_view::npos && key.path.substr(dot + 1) == name.str()) {
        places.emplace_back(key.path.substr(0, dot));
      }
    }
    return places.size() == 1 ? "; " + std::string(name.str()) + " belongs to " + table_title(places.front()) : "";
  }

  static bool is_name(std::string_view name) {
    return !name.empty() && std::isalpha(static_cast<unsigned char>(name.front())) != 0 &&
           std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  }

  void array(const toml::key& name, const toml::node& node, const std::string& path, const std::string& pattern) {
    const auto* list = node.as_array();
    if (list == nullptr || !std::ranges::all_of(*list, [](const toml::node& entry) { return entry.is_table(); })) {
      return report(name.source().begin, path,
                    "got " + std::string(node_type(node)) + ", expected tables [[" + path + "]], one for each");
    }
    if (list->size() > most_tables) return report_many(name.source().begin, path, list->size());
    for (std::size_t i = 0; i < list->size(); ++i) {
      const std::string item = path + "[" + std::to_string(i) + "]";
      table_place_ = (*list)[i].source().begin;
      table(*(*list)[i].as_table(), item, pattern);
    }
  }

  void value(const Key& key, const toml::node& node, const std::string& path) {
    // A value that --set puts into the document has no place in the file: toml++ says line 0.
    const auto source = node.source().begin;
    const Problem place = place_of(source, path);
    CaseValue read{path, {}, place.line, place.column, true, node.is_number()};
    try {
      read.value = read_value(node, key);
    } catch (const InputError& error) {
      read.value = unread_value(key);
      problems.push_back(place_in_list(key, node, path, place));
      problems.back().text = path + ": " + error.what();
    }
    values.push_back(std::move(read));
  }

  void absent_key(const Key& key, const toml::table& table, const std::string& path, const std::string& pattern) {
    const auto dot = key.path.rfind('.');
    const std::string_view parent = dot == std::string_view::npos ? std::string_view() : key.path.substr(0, dot);
    const std::string_view name = dot == std::string_view::npos ? key.path : key.path.substr(dot + 1);
    if (parent != pattern || table.contains(name)) return;
    if (key.required) {
      const auto place = table.source().begin.line == 0 ? table_place_ : table.source().begin;
      problems.push_back(place_of(place, path));
      problems.back().text = join(path, name) + ": missing; " + std::string(key.meaning);
      values.push_back({join(path, name), unread_value(key)});
    } else if (const std::string word = told_word(schema_, values, key.path); !word.empty()) {
      values.push_back({join(path, name), word});
    } else if (!key.fallback.empty() && fits_alternative(schema_, values, join(path, name))) {
      const auto document = toml::parse("value = " + std::string(key.fallback));
      values.push_back({join(path, name), read_value(*document.get("value"), key)});
    }
  }

  void implied_section(const Section& section, const toml::table& table, const std::string& path,
                       const std::string& pattern) {
    const auto dot = section.path.rfind('.');
    const std::string_view parent = dot == std::string_view::npos ? std::string_view() : section.path.substr(0, dot);
    const std::string_view name = dot == std::string_view::npos ? section.path : section.path.substr(dot + 1);
    if (section.implied_by.empty() || parent != pattern || table.contains(name)) return;
    const auto there = [&](const std::string& key) { return find(values, key) != nullptr || has_table(values, key); };
    if (std::ranges::none_of(implying_keys(section), there)) return;
    if (!fits_alternative(schema_, values, join(path, name))) return;
    table_place_ = table.source().begin;
    this->table(toml::table{}, join(path, name), join(pattern, name));
  }

  const Schema& schema_;
  const std::vector<Override>& overrides_;
  std::map<std::string, std::vector<std::string>> names_;  // by pattern
  toml::source_position table_place_{};
};

toml::table parse_document(const std::string& text, const std::string& name) {
  if (const auto problem = too_deep(text)) throw CaseError({name, text}, {*problem});
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const auto place = error.source().begin;
    const bool is_text = error.description().find("utf-8") == std::string_view::npos;
    throw CaseError({name, text},
                    {{static_cast<int>(place.line), static_cast<int>(place.column),
                      "not TOML: " + std::string(error.description()) +
                          (is_text ? "; quantities with units go in quotes, \"6 mm\"" : "; save the file as UTF-8")}});
  }
}

/// The place in `list` that the brackets of `name` ("contacts[1]") tell.
std::size_t list_place(std::string_view name, const toml::array* list, const std::string& path) {
  const auto bracket = name.find('[');
  const std::string bare(name.substr(0, bracket));
  const std::size_t count = list == nullptr ? 0 : list->size();
  if (count == 0) throw InputError("--set " + path + ": the case has no list " + bare);
  std::size_t place = 0;
  const char* const last = name.data() + name.size();
  const auto [end, error] = std::from_chars(name.data() + bracket + 1, last, place);
  const bool number = error != std::errc::invalid_argument && std::string_view(end, last) == "]";
  if (number && error == std::errc() && place < count) return place;
  throw InputError("--set " + path + ": there is no " + std::string(name) + "; entries of lists are numbered from 0: " +
                   bare + "[0]" + (count == 1 ? " is the only one" : " to [" + std::to_string(count - 1) + "]"));
}

/// The table or array entry `name` ("part", "contacts[1]") below `table`; made if it is a plain table that is not
/// there.
toml::table& descend(toml::table& table, std::string_view name, const std::string& path) {
  const auto bracket = name.find('[');
  if (bracket == std::string_view::npos) {
    table.insert(name, toml::table{});
    if (auto* inner = table.get(name)->as_table()) return *inner;
  } else {
    auto* array = table[name.substr(0, bracket)].as_array();
    if (auto* inner = array == nullptr ? nullptr : (*array)[list_place(name, array, path)].as_table()) return *inner;
  }
  const auto* list = bracket == std::string_view::npos ? table.get(name)->as_array() : nullptr;
  if (list == nullptr) throw InputError("--set " + path + ": the case has no " + std::string(name));
  throw InputError("--set " + path + ": " + std::string(name) + " is a list of " + std::to_string(list->size()) +
                   "; name the entry, as in " + std::string(name) + "[0]");
}

/// The value of an override: TOML if it is TOML, else a text, so that the quotes of "8 mm" may be left to the shell.
toml::table override_document(const std::string& text) {
  try {
    return toml::parse("value = " + text);
  } catch (const toml::parse_error&) {
    return toml::table{{"value", text}};
  }
}

Override apply_override(toml::table& document, const Schema& schema, const std::string& assignment) {
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw core::UsageError("--set \"" + assignment + "\": write key=value, for example --set part.length=\"390 mm\"");
  }
  if (const auto problem = too_deep(assignment))
    throw InputError("--set " + assignment.substr(0, 40) + "…: " + problem->text);
  const std::string path = full_path(schema, assignment.substr(0, equals));
  Override applied{path, static_cast<int>(equals) + 2};
  toml::table* table = &document;
  std::string_view rest = path;
  for (auto dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
    table = &descend(*table, rest.substr(0, dot), path);
    rest.remove_prefix(dot + 1);
  }
  auto value = override_document(assignment.substr(equals + 1));
  const auto bracket = rest.find('[');
  if (bracket == std::string_view::npos) {
    table->insert_or_assign(rest, *value.get("value"));
    return applied;
  }
  auto* list = (*table)[rest.substr(0, bracket)].as_array();
  const std::size_t place = list_place(rest, list, path);
  list->replace(list->cbegin() + static_cast<std::ptrdiff_t>(place), *value.get("value"));
  return applied;
}

/// The array at a dotted path, made if it is not there; null where something else stands on the way, which Walk
/// reports.
toml::array* array_at(toml::table& document, std::string_view path) {
  toml::table* table = &document;
  for (auto dot = path.find('.'); dot != std::string_view::npos; dot = path.find('.')) {
    table->insert(path.substr(0, dot), toml::table{});
    table = table->get(path.substr(0, dot))->as_table();
    if (table == nullptr) return nullptr;
    path.remove_prefix(dot + 1);
  }
  table->insert(path, toml::array{});
  return table->get(path)->as_array();
}

/// Puts the tables of `added` behind those that the document's arrays have.
void append_tables(toml::table& document, const Schema& schema, const CaseValues& added) {
  std::map<std::string, std::size_t> counts;  // of the tables that stood there before
  for (const CaseValue& value : added) {
    const auto open = value.key.find('['), close = value.key.find("].");
    const std::string path = value.key.substr(0, open);
    toml::array* tables = array_at(document, path);
    if (tables == nullptr) continue;
    const std::size_t before = counts.try_emplace(path, tables->size()).first->second;
    const std::size_t index = before + std::stoul(value.key.substr(open + 1, close - open - 1));
    while (tables->size() <= index) tables->push_back(toml::table{});
    insert(*(*tables)[index].as_table(), value.key.substr(close + 2), *find_key(schema, pattern_of(schema, value.key)),
           value.value);
  }
}

}  // namespace

ReadValues read_values(const std::string& text, const std::string& name, const Schema& schema,
                       const std::vector<std::string>& overrides, const CaseValues& added) {
  toml::table document = parse_document(text, name);
  append_tables(document, schema, added);
  std::vector<Override> applied;
  applied.reserve(overrides.size());
  for (const auto& assignment : overrides) applied.push_back(apply_override(document, schema, assignment));
  Walk walk(schema, applied);
  walk.table(document, "", "");
  if (walk.too_many) throw CaseError({name, text, overrides}, {*walk.too_many});
  return {std::move(walk.values), std::move(walk.problems)};
}

}  // namespace thinwall::cases
