#include "app/sweep/sweep_record.hpp"

#include <signal.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/doctor.hpp"
#include "case/keys.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/json_file.hpp"
#include "io/manifest.hpp"
#include "report/summary/summary_json.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;
using io::JsonValue;
using nlohmann::json;

/// The checksum of the expectations beside a case; "" where it has none.
std::string hash_if_there(const fs::path& file) {
  return fs::exists(file) ? io::sha256_of_file(file) : "";
}

std::string with_expectations(const std::string& key, const fs::path& case_file) {
  return io::sha256(key + "\n" + hash_if_there(case_file.parent_path() / "expected.toml"));
}

SweepAxis axis_of(const JsonValue& value) {
  SweepAxis axis{value.at("key").text(), value.at("values").texts(), value.at("unit").text(),
                 value.at("numbers").numbers()};
  if (axis.values.empty()) value.at("values").refuse("is empty");
  if (!axis.numbers.empty() && axis.numbers.size() != axis.values.size())
    value.at("numbers").refuse("has " + std::to_string(axis.numbers.size()) + " numbers for " +
                               std::to_string(axis.values.size()) + " values");
  return axis;
}

SweepFigures figures_of(const fs::path& folder, const std::string& sha256) {
  const fs::path file = folder / "summary.json";
  const json summary = io::read_json(file);
  if (io::sha256_of_file(file) != sha256)
    throw core::DataError("\"" + file.string() + "\" is not the one that the sweep left there; call the sweep again");
  return sweep_figures(report::summary_from(summary, file));
}

/// True of the name that a table of the sweep has while it is written.
bool is_table_half_written(const fs::path& path, const fs::path& folder) {
  return std::ranges::any_of(std::array{"sweep.csv", "sweep.svg", "sweep.json"},
                             [&](const char* table) { return core::is_partial_name_of(path, folder / table); });
}

/// True if the process whose number is in a half-written file's name does not run here, and the file is a minute old.
bool is_abandoned(const fs::directory_entry& file) {
  const std::string name = file.path().filename().string();
  const std::size_t number = name.find_first_of("0123456789", name.find(".partial-"));
  const auto process = static_cast<pid_t>(std::strtol(name.c_str() + number, nullptr, 10));
  const bool runs = ::kill(process, 0) == 0 || errno != ESRCH;
  return !runs && fs::file_time_type::clock::now() - file.last_write_time() > std::chrono::minutes(1);
}

}  // namespace

std::string sweep_key(const fs::path& case_path, const std::vector<std::string>& overrides,
                      const std::vector<SweepAxis>& axes) {
  const fs::path file = cases::case_file(case_path);
  std::vector<std::string> swept(axes.size());
  std::ranges::transform(axes, swept.begin(), &SweepAxis::key);
  try {
    return with_expectations(cases::key_of(cases::read_case(case_path, overrides), swept), file);
  } catch (const core::UsageError&) {
    throw;
  } catch (const core::Error&) {  // what is wrong with it, if the swept keys do not mend it, each point tells
    std::string text = program_version() + "\n" + core::read_file(file);
    for (const std::string& value : overrides) text += "\n" + value;
    return with_expectations(text, file);
  }
}

std::string point_key(const cases::Case& source) {
  return with_expectations(cases::key_of(source, {}), source.file);
}

void write_plan(const fs::path& folder, const SweepPlan& plan) {
  json document = {{"schema", 1}, {"case", plan.name}, {"key", plan.key}, {"axes", json::array()}};
  for (const SweepAxis& axis : plan.axes)
    document["axes"].push_back(
        {{"key", axis.key}, {"unit", axis.unit}, {"values", axis.values}, {"numbers", axis.numbers}});
  io::write_json(folder / "sweep.json", document);
}

SweepPlan read_plan(const fs::path& folder) {
  const fs::path file = folder / "sweep.json";
  std::error_code ignored;
  if (!fs::exists(file, ignored))
    throw core::DataError("no sweep in \"" + folder.string() +
                          "\": it has no sweep.json; \"thinwall sweep --out\" makes one");
  const json document = io::read_json(file);
  const JsonValue value{&document, file.string(), ""};
  SweepPlan plan{value.at("case").text(), value.at("key").text(), {}};
  for (const JsonValue& axis : value.at("axes").items()) plan.axes.push_back(axis_of(axis));
  if (plan.axes.empty()) value.at("axes").refuse("is empty");
  return plan;
}

void remove_abandoned_tables(const fs::path& folder) noexcept {
  try {
    std::vector<fs::path> abandoned;
    for (const auto& entry : fs::directory_iterator(folder)) {
      if (entry.is_regular_file() && is_table_half_written(entry.path(), folder) && is_abandoned(entry))
        abandoned.push_back(entry.path());
    }
    for (const fs::path& path : abandoned) fs::remove(path);
  } catch (const std::exception&) {
    // It is in nobody's way but that of the eye.
  }
}

fs::path point_folder(const fs::path& sweep, std::size_t number, std::size_t count) {
  const std::size_t digits = std::max<std::size_t>(3, std::to_string(count).size());
  const std::string text = std::to_string(number);
  return sweep / (std::string(digits - text.size(), '0') + text);
}

void write_point(const fs::path& folder, std::size_t number, const PointRecord& record) {
  io::write_json(folder / "point.json",
                 {{"number", number},
                  {"sweep", record.sweep},
                  {"key", record.key},
                  {"values", record.values},
                  {"status", record.status},
                  {"exit_code", record.exit_code},
                  {"reason", record.reason},
                  {"summary_sha256", record.status == "failed" ? "" : hash_if_there(folder / "summary.json")}});
}

std::optional<PointRecord> read_point(const fs::path& folder) {
  const fs::path file = folder / "point.json";
  std::error_code ignored;
  if (!fs::exists(file, ignored)) return std::nullopt;
  const json document = io::read_json(file);
  const JsonValue value{&document, file.string(), ""};
  PointRecord record{value.at("sweep").text(),
                     value.at("key").text(),
                     value.at("values").texts(),
                     value.at("status").text(),
                     value.at("exit_code").integer(0, static_cast<int>(core::ExitCode::interrupted)),
                     value.at("reason").text(),
                     {}};
  if (record.status != "failed") record.figures = figures_of(folder, value.at("summary_sha256").text());
  return record;
}

}  // namespace thinwall::app
