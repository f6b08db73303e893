#include "case/toml_node.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"
#include "dynamics/dof.hpp"

namespace thinwall::cases {

namespace {

using core::InputError;

[[noreturn]] void wrong_type(const toml::node& node, std::string_view expected) {
  throw InputError("got " + std::string(node_type(node)) + ", expected " + std::string(expected));
}

std::string read_text(const toml::node& node) {
  if (!node.is_string()) wrong_type(node, "a text in quotes");
  auto text = *node.value<std::string>();
  // Messages and names of files end at such a character.
  if (text.find('\0') != std::string::npos)
    throw InputError("holds the character U+0000, which no name, file or number has; remove it");
  return text;
}

/// " (K: Matrix Market, .sti of CalculiX)": what a key of a file takes, where its meaning tells endings; else "".
std::string files_taken(const Key& key) {
  if (key.type != Type::file || key.meaning.find("`.") == std::string_view::npos) return "";
  std::string meaning(key.meaning);
  std::erase(meaning, '`');
  if (meaning.ends_with('.')) meaning.pop_back();
  return " (" + meaning + ")";
}

/// A text that names something. An empty one names nothing; it would be taken for a key that is not there. Only where
/// it is the default is it what a key may say.
std::string read_name(const toml::node& node, const Key& key) {
  std::string text = read_text(node);
  if (text.empty() && key.fallback != "\"\"")
    throw InputError(std::string(key.type == Type::file ? "names no file" : "is an empty text") +
                     "; write what is meant" + files_taken(key) + (key.required ? "" : ", or remove the key"));
  return text;
}

/// The quantity that a text states; a range is told as what it is.
double read_quantity_text(const std::string& text, const Key& key) {
  try {
    return core::parse_quantity(text, key.kind);
  } catch (const InputError&) {
    const auto ends = core::range_ends(text);
    if (!ends) throw;
    const bool one_of_many = key.path.find_first_of("[*") != std::string_view::npos;
    throw InputError("\"" + text + "\" is a range, but one value is expected; for many write thinwall sweep CASE " +
                     (one_of_many ? "KEY" : std::string(key.path)) + "=\"" + ends->first + ":" + ends->second +
                     ":STEP\"");
  }
}

double read_quantity(const toml::node& node, const Key& key) {
  double value = 0.0;
  if (node.is_string()) {
    const std::string text = read_text(node);
    const bool infinite = key.bounds.infinity_allowed && (text == "inf" || text == "infinite");
    value = infinite ? std::numeric_limits<double>::infinity() : read_quantity_text(text, key);
  } else if (node.is_integer() || node.is_floating_point()) {
    value = *node.value<double>();
    if (!(key.bounds.infinity_allowed && value > 0.0 && std::isinf(value))) value = core::bare_number(value, key.kind);
  } else {
    wrong_type(node, "a " + std::string(key.kind.name) + " such as \"" + std::string(key.kind.example) + "\"");
  }
  require_within_bounds(key, value);
  return value;
}

double read_integer(const toml::node& node, const Key& key) {
  if (!node.is_integer()) wrong_type(node, "a whole number");
  const auto value = static_cast<double>(*node.value<std::int64_t>());
  require_within_bounds(key, value);
  return value;
}

std::string read_choice(const toml::node& node, const Key& key) {
  const auto allowed = choices(key);
  if (allowed.empty()) return read_name(node, key);
  std::string text = read_text(node);
  if (std::ranges::find(allowed, text) != allowed.end()) return text;
  std::string list;
  for (const auto& choice : allowed) list += (list.empty() ? "\"" : ", \"") + choice + "\"";
  throw InputError("\"" + text + "\" is none of " + list + core::did_you_mean(text, allowed));
}

/// The most entries of a list: modes of which a case gives ratios are at most 2000, and corners of an outline are
/// looked at in pairs.
constexpr std::size_t most_entries = 2000;

void require_few(const toml::array& list) {
  if (list.size() > most_entries)
    throw InputError(std::to_string(list.size()) + " entries are too many, at most " + std::to_string(most_entries) +
                     " are read");
}

/// Applies `read` to every entry of a list, or to a value that stands alone.
template <typename Read>
auto read_list(const toml::node& node, Read read) {
  std::vector<decltype(read(node))> list;
  if (const auto* array = node.as_array()) {
    require_few(*array);
    for (const auto& entry : *array) list.push_back(read(entry));
  } else {
    list.push_back(read(node));
  }
  return list;
}

std::vector<double> read_vector(const toml::node& node, const Key& key) {
  const auto* array = node.as_array();
  if (array == nullptr || array->size() != 3) {
    const std::string one = "\"" + std::string(key.kind.example) + "\"";
    throw InputError("must be a list of three, along x, y, z, such as [" + one + ", " + one + ", " + one + "]");
  }
  return read_list(node, [&](const toml::node& entry) { return read_quantity(entry, key); });
}

/// Corners one after the other: x₀, y₀, x₁, y₁ …
std::vector<double> read_polygon(const toml::node& node, const Key& key) {
  constexpr auto expected = "must be a list of at least three corners [x, y], such as [[\"0 mm\", \"0 mm\"], …]";
  const auto* corners = node.as_array();
  if (corners == nullptr || corners->size() < 3) throw InputError(expected);
  require_few(*corners);
  std::vector<double> list;
  for (const auto& corner : *corners) {
    const auto* pair = corner.as_array();
    if (pair == nullptr || pair->size() != 2) throw InputError(expected);
    for (const auto& coordinate : *pair) list.push_back(read_quantity(coordinate, key));
  }
  return list;
}

/// Positions one after the other: x₀, y₀, z₀, x₁ …
std::vector<double> read_positions(const toml::node& node, const Key& key) {
  const auto* positions = node.as_array();
  if (positions == nullptr || positions->size() < 2 || positions->size() > 200)
    throw InputError("must be a list of 2 to 200 positions [x, y, z], such as [[\"6 mm\", \"0 mm\", \"50 mm\"], …]");
  std::vector<double> list;
  list.reserve(3 * positions->size());
  for (const auto& position : *positions) std::ranges::copy(read_vector(position, key), std::back_inserter(list));
  return list;
}

/// A word that the key allows in place of a number.
bool is_choice(const toml::node& node, const Key& key) {
  const auto allowed = choices(key);
  return node.is_string() && std::ranges::find(allowed, read_text(node)) != allowed.end();
}

Eigen::Vector3d read_direction(const toml::node& node) {
  if (node.is_string()) return dynamics::axis(read_text(node));
  const auto* array = node.as_array();
  if (array == nullptr || array->size() != 3) wrong_type(node, "a direction, \"x\", \"-y\" or [0.6, 0.8, 0]");
  Eigen::Vector3d direction;
  for (int i = 0; i < 3; ++i) {
    const auto component = (*array)[static_cast<std::size_t>(i)].value<double>();
    if (!component || !std::isfinite(*component)) throw InputError("must have three finite numbers");
    direction[i] = *component;
  }
  const double norm = direction.norm();
  if (norm < 1e-12) throw InputError("has no length; write a direction such as [0.6, 0.8, 0]");
  // A unit vector stays as it is written, so that a resolved case reads back to the last bit.
  return std::abs(norm - 1.0) < 1e-12 ? direction : Eigen::Vector3d(direction / norm);
}

/// A list of directions, unless it is a single one written as three numbers.
std::vector<Eigen::Vector3d> read_directions(const toml::node& node) {
  const auto* array = node.as_array();
  if (array == nullptr || (array->size() == 3 && (*array)[0].is_number())) return {read_direction(node)};
  return read_list(node, read_direction);
}

/// The text of a quantity whose dimension is known only later; a bare number as its exact text.
std::string read_amount(const toml::node& node, const Key& key) {
  if (node.is_integer() || node.is_floating_point()) return core::number_text(*node.value<double>());
  return read_name(node, key);
}

/// The node of a value of a key. A quantity is its exact text.
struct NodeOf {
  const Key& key;

  toml::array operator()(const std::vector<double>& list) const { return each(list); }
  toml::array operator()(const std::vector<std::string>& list) const { return each(list); }
  toml::array operator()(const Eigen::Vector3d& d) const { return toml::array{d.x(), d.y(), d.z()}; }
  /// A single direction stands without a list around it.
  toml::array operator()(const std::vector<Eigen::Vector3d>& list) const {
    return list.size() == 1 ? (*this)(list.front()) : each(list);
  }
  std::string operator()(const std::string& text) const { return text; }
  bool operator()(bool value) const { return value; }
  std::string operator()(double value) const { return core::exact_text(value, key.kind); }

  template <class Item>
  toml::array each(const std::vector<Item>& list) const {
    toml::array nodes;
    for (const Item& item : list) nodes.push_back((*this)(item));
    return nodes;
  }
};

}  // namespace

std::string_view node_type(const toml::node& node) {
  if (node.is_string()) return "a text";
  if (node.is_integer() || node.is_floating_point()) return "a number";
  if (node.is_boolean()) return "true or false";
  if (node.is_array()) return "a list";
  if (node.is_table()) return "a table";
  return "a date or time";
}

Value read_value(const toml::node& node, const Key& key) {
  // Where there is a default, a list without an entry would leave out what nobody means to be without: directions that
  // a support holds or a contact joins, stiffnesses.
  const auto* list = node.as_array();
  if (list != nullptr && list->empty() && !key.fallback.empty())
    throw InputError("is a list without an entry; name what is meant, or leave the key out for its default, " +
                     std::string(key.fallback));
  if (list != nullptr && list->empty() && key.type == Type::quantities)
    throw InputError(std::string("is a list without an entry; write its numbers") +
                     (key.required ? "" : ", or remove the key"));
  switch (key.type) {
    case Type::text:
    case Type::file:
    case Type::name:
      return read_name(node, key);
    case Type::choice:
      return read_choice(node, key);
    case Type::names:
      return read_list(node, [&](const toml::node& entry) { return read_choice(entry, key); });
    case Type::boolean:
      if (!node.is_boolean()) wrong_type(node, "true or false");
      return *node.value<bool>();
    case Type::integer:
      if (is_choice(node, key)) return read_text(node);
      return read_integer(node, key);
    case Type::quantity:
      if (is_choice(node, key)) return read_text(node);
      return read_quantity(node, key);
    case Type::quantities:
      return read_list(node, [&](const toml::node& entry) { return read_quantity(entry, key); });
    case Type::vector:
      return read_vector(node, key);
    case Type::polygon:
      return read_polygon(node, key);
    case Type::positions:
      return read_positions(node, key);
    case Type::direction:
      return std::vector<Eigen::Vector3d>{read_direction(node)};
    case Type::directions:
      return read_directions(node);
    case Type::amount:
      return read_amount(node, key);
  }
  return {};
}

Value unread_value(const Key& key) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  switch (key.type) {
    case Type::integer:
    case Type::quantity:
      return nan;
    case Type::vector:
      return std::vector<double>(3, nan);
    case Type::quantities:
    case Type::polygon:
    case Type::positions:
      return std::vector<double>();
    case Type::boolean:
      return false;
    case Type::names:
      return std::vector<std::string>();
    case Type::direction:
    case Type::directions:
      return std::vector<Eigen::Vector3d>();
    default:
      return std::string();
  }
}

void insert(toml::table& table, const std::string& name, const Key& key, const Value& value) {
  if (key.type == Type::integer) {
    table.insert_or_assign(name, static_cast<std::int64_t>(std::llround(std::get<double>(value))));
    return;
  }
  std::visit([&](const auto& held) { table.insert_or_assign(name, NodeOf{key}(held)); }, value);
}

}  // namespace thinwall::cases
