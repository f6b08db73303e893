#include "report/page/case_differences.hpp"

#include <algorithm>
#include <set>
#include <sstream>

namespace thinwall::report {

namespace {

/// "cutting" of "[cutting]"; "part.supports[1]" of the second "[[part.supports]]".
std::string table_name(const std::string& line, std::map<std::string, int>& counts) {
  if (!line.starts_with("[[")) return line.substr(1, line.find(']') - 1);
  const std::string list = line.substr(2, line.find("]]") - 2);
  return list + "[" + std::to_string(counts[list]++) + "]";
}

std::string unquoted(const std::string& value) {
  const bool plain = value.size() >= 2 && value.front() == '"' && value.find('"', 1) == value.size() - 1;
  return plain ? value.substr(1, value.size() - 2) : value;
}

}  // namespace

std::map<std::string, std::string> values_of_case(const std::string& text) {
  std::map<std::string, std::string> values;
  std::map<std::string, int> counts;
  std::string table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('[')) {
      table = table_name(line, counts);
      continue;
    }
    const std::size_t equal = line.find(" = ");
    if (line.starts_with('#') || equal == std::string::npos) continue;
    values[(table.empty() ? "" : table + ".") + line.substr(0, equal)] = unquoted(line.substr(equal + 3));
  }
  return values;
}

nlohmann::json case_differences(const std::vector<std::string>& texts) {
  std::vector<std::map<std::string, std::string>> cases;
  std::set<std::string> keys;
  for (const std::string& text : texts) {
    cases.push_back(values_of_case(text));
    for (const auto& [key, value] : cases.back()) keys.insert(key);
  }
  keys.erase("title");
  nlohmann::json rows = nlohmann::json::array();
  for (const std::string& key : keys) {
    std::vector<std::string> row{key};
    for (auto& values : cases) row.push_back(values[key]);
    if (std::adjacent_find(row.begin() + 1, row.end(), std::not_equal_to()) != row.end()) rows.push_back(row);
  }
  return rows;
}

}  // namespace thinwall::report
