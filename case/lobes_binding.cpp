#include "case/lobes_binding.hpp"

namespace thinwall::cases {

setup::LobesOptions bind_lobes(const Table& table, const std::optional<setup::Tool>& tool) {
  setup::LobesOptions lobes;
  lobes.from_rpm = table.number("from");
  lobes.to_rpm = table.number("to");
  lobes.count = table.integer("count");
  lobes.line_tolerance = table.number("line_tolerance");
  lobes.depth_limit = table.optional("depth_limit").value_or(tool ? tool->length : NAN);
  lobes.tolerance = table.number("tolerance");
  lobes.modes_up_to_hz = table.optional("modes_up_to");
  lobes.method = table.choice<milling::Method>("method");
  for (const std::string& name : table.names("compare"))
    if (const auto method = core::from_word<milling::Method>(name)) lobes.compare.push_back(*method);
  const auto integer = [&](const char* key) {
    return table.has(key) ? std::optional(table.integer(key)) : std::nullopt;
  };
  lobes.steps_per_period = integer("steps_per_period");
  lobes.harmonics = integer("harmonics");
  lobes.map_depths = integer("map_depths");
  lobes.most_added = integer("most_added");
  lobes.noise_samples = integer("noise_samples");
  lobes.seed = table.integer("seed");
  if (const Table u = table.table("uncertainty"); u.exists()) {
    lobes.robust = setup::RobustOptions{
        {u.number("frequency"), u.number("damping_ratio"), u.number("receptance"), u.number("coefficients")},
        u.number("confidence")};
  }
  return lobes;
}

std::vector<setup::ObservedCuts> bind_observed(const std::vector<Table>& tables, const std::filesystem::path& folder) {
  std::vector<setup::ObservedCuts> list;
  list.reserve(tables.size());
  for (const Table& table : tables) {
    if (table.has("file")) {
      list.push_back({folder / table.text("file"), {}});
      continue;
    }
    list.push_back({{},
                    {{table.number("spindle_speed"), table.number("depth"),
                      table.choice<milling::CutOutcome>("observed"), table.optional("chatter_frequency")}}});
  }
  return list;
}

setup::Calibration bind_calibration(const Table& table) {
  setup::Calibration calibration{
      table.integer("draws"),           table.integer("seed"), {}, table.optional("spindle_speed"),
      table.optional("speed_exponent"), table.optional("risk")};
  if (table.has("folds")) calibration.folds = table.integer("folds");
  return calibration;
}

milling::MachineLimits bind_machine(const Table& table) {
  milling::MachineLimits machine;
  const auto bound = [&](const char* key, double& value) { value = table.optional(key).value_or(value); };
  bound("min_spindle_speed", machine.min_spindle_speed_rpm);
  bound("max_spindle_speed", machine.max_spindle_speed_rpm);
  bound("max_power", machine.max_power_W);
  bound("max_torque", machine.max_torque_Nm);
  bound("max_feed_rate", machine.max_feed_rate_m_s);
  machine.efficiency = table.number("efficiency");
  return machine;
}

setup::Path bind_path(const Table& table) {
  setup::Path path{{}, table.text("support") == "follows"};
  const auto list = table.numbers("points");
  for (std::size_t i = 0; i + 2 < list.size(); i += 3) path.positions.emplace_back(list[i], list[i + 1], list[i + 2]);
  const int count = table.has("positions") ? table.integer("positions") : 11;
  if (!table.has("from") || !table.has("to") || table.has("points") || count < 2) return path;
  const Eigen::Vector3d from = table.vector("from"), to = table.vector("to");
  path.positions.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) path.positions.emplace_back(from + (to - from) * i / (count - 1));
  return path;
}

}  // namespace thinwall::cases
