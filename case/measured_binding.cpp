#include "case/measured_binding.hpp"

#include <optional>
#include <string>

namespace thinwall::cases {

setup::MeasuredFrf bind_measured(const Table& table, const std::filesystem::path& folder) {
  const std::string file = table.text("file");
  const auto integer = [&](const char* key) {
    return table.has(key) ? std::optional(table.integer(key)) : std::nullopt;
  };
  return {table.text("response"), table.text("force"),     file.empty() ? std::filesystem::path() : folder / file,
          table.text("quantity"), table.text("unit"),      table.text("frequency_unit"),
          integer("record"),      table.optional("noise"), integer("averages")};
}

std::vector<setup::MeasuredFrf> bind_all_measured(const std::vector<Table>& tables,
                                                  const std::filesystem::path& folder) {
  std::vector<setup::MeasuredFrf> list;
  list.reserve(tables.size());
  for (const auto& table : tables) list.push_back(bind_measured(table, folder));
  return list;
}

std::vector<setup::Sensor> bind_sensors(const std::vector<Table>& tables) {
  std::vector<setup::Sensor> sensors;
  sensors.reserve(tables.size());
  for (const Table& table : tables) sensors.push_back({table.text("at"), table.number("mass")});
  return sensors;
}

}  // namespace thinwall::cases
