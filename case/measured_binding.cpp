#include "case/measured_binding.hpp"

#include <optional>
#include <string>

namespace thinwall::cases {

setup::MeasuredFrf bind_measured(const Table& table, const std::filesystem::path& folder) {
  const std::string file = table.text("file");
  const auto integer = [&](const char* key) {
    return table.has(key) ? std::optional(table.integer(key)) : std::nullopt;
  };
  return {.response = table.text("response"),
          .force = table.text("force"),
          .file = file.empty() ? std::filesystem::path() : folder / file,
          .quantity = table.optional_choice<io::FrfQuantity>("quantity"),
          .unit = table.text("unit"),
          .frequency_unit = table.text("frequency_unit"),
          .record = integer("record"),
          .noise = table.optional("noise"),
          .variable = table.text("variable"),
          .frequency_variable = table.text("frequency_variable"),
          .averages = integer("averages"),
          .from_hz = table.optional("from"),
          .to_hz = table.optional("to")};
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
