#include "case/writer.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "case/schema/schema.hpp"
#include "core/units.hpp"

namespace thinwall::cases {

namespace {

std::string quoted(const std::string& text) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (code < 0x20 || code == 0x7f) {
      result += "\\u00";
      result += {digits[code >> 4U], digits[code & 15U]};
    } else {
      result += c;
    }
  }
  return result + "\"";
}

/// TOML wants a point or an exponent in a float, and an exponent needs no point.
std::string float_text(double value) {
  const std::string text = core::number_text(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string quantity_text(double value, const core::QuantityKind& kind) {
  if (std::isinf(value)) return "\"inf\"";
  return kind.unit.empty() ? float_text(value) : quoted(core::exact_text(value, kind));
}

template <typename List, typename Text>
std::string list_text(const List& list, Text text) {
  std::string result = "[";
  for (const auto& item : list) result += (result.size() > 1 ? ", " : "") + text(item);
  return result + "]";
}

std::string direction_text(const Eigen::Vector3d& d) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::string letter(1, static_cast<char>('x' + axis));
    if (d == Eigen::Vector3d::Unit(axis)) return quoted(letter);
    if (d == -Eigen::Vector3d::Unit(axis)) return quoted("-" + letter);
  }
  return list_text(std::vector<double>{d[0], d[1], d[2]}, float_text);
}

/// The value of a key as TOML.
struct ValueText {
  const Key& key;
  const std::filesystem::path& folder;

  std::string operator()(double value) const {
    return key.type == Type::integer ? std::to_string(std::llround(value)) : quantity_text(value, key.kind);
  }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(const std::string& value) const {
    return quoted(key.type == Type::file ? std::filesystem::absolute(folder / value).lexically_normal().string()
                                         : value);
  }
  std::string operator()(const std::vector<double>& list) const {
    const auto number = [this](double value) { return quantity_text(value, key.kind); };
    if (key.type != Type::polygon && key.type != Type::positions) return list_text(list, number);
    const std::size_t width = key.type == Type::polygon ? 2 : 3;
    std::vector<std::vector<double>> places;
    places.reserve(list.size() / width);
    for (auto place = list.begin(); place != list.end(); place += static_cast<std::ptrdiff_t>(width))
      places.emplace_back(place, place + static_cast<std::ptrdiff_t>(width));
    return list_text(places, [&](const std::vector<double>& place) { return list_text(place, number); });
  }
  std::string operator()(const std::vector<std::string>& list) const { return list_text(list, quoted); }
  std::string operator()(const std::vector<Eigen::Vector3d>& list) const {
    return key.type == Type::direction ? direction_text(list.front()) : list_text(list, direction_text);
  }
};

std::string table_of(const std::string& key) {
  const auto dot = key.rfind('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

/// "updating[0].targets[1]" → "[[updating.targets]]", "part.mesh" → "[part.mesh]".
std::string header(const std::string& table) {
  std::string name;
  bool inside_index = false;
  for (const char c : table) {
    if (c == '[') inside_index = true;
    if (!inside_index) name += c;
    if (c == ']') inside_index = false;
  }
  return table.ends_with(']') ? "[[" + name + "]]" : "[" + name + "]";
}

/// Tables by their first key; the top level first, and an entry of an array before the tables within it.
std::vector<std::string> tables_in_order(const CaseValues& values) {
  std::vector<std::string> tables{""};
  const auto add = [&](const std::string& table) {
    if (std::ranges::find(tables, table) == tables.end()) tables.push_back(table);
  };
  for (const auto& value : values) {
    const std::string table = table_of(value.key);
    for (auto end = table.find("]."); end != std::string::npos; end = table.find("].", end + 1)) {
      add(table.substr(0, end + 1));
    }
    add(table);
  }
  return tables;
}

}  // namespace

std::string values_text(const CaseValues& values, const std::filesystem::path& folder) {
  std::string text;
  for (const auto& table : tables_in_order(values)) {
    if (!table.empty()) text += "\n" + header(table) + "\n";
    for (const auto& value : values) {
      if (table_of(value.key) != table) continue;
      const Key& key = *find_key(case_schema(), pattern_of(case_schema(), value.key));
      const auto name = table.empty() ? value.key : value.key.substr(table.size() + 1);
      text += name + " = " + std::visit(ValueText{key, folder}, value.value) + "\n";
    }
  }
  return text;
}

std::string resolved_text(const Case& source) {
  return values_text(source.values, source.folder);
}

}  // namespace thinwall::cases
