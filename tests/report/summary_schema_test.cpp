// The published schema of summary.json: every value has a kind, and a kind's unit is that of the name.

#include "report/summary/summary_schema.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "report/summary/summary_json.hpp"

namespace thinwall::report::summary_schema_test {
namespace {

using nlohmann::json;

std::string last_key(const std::string& path) {
  const std::string key = path.substr(path.rfind('.') + 1);
  return key.substr(0, key.find('['));
}

/// The unit that a key ends with; empty of one without.
std::string unit_in(const std::string& key) {
  for (const auto& [ending, unit] :
       std::initializer_list<std::pair<const char*, const char*>>{{"_cm3_per_min", "cm^3/min"},
                                                                  {"_n_s_per_m", "N s/m"},
                                                                  {"_n_per_m", "N/m"},
                                                                  {"_m_per_n", "m/N"},
                                                                  {"_n_m", "N m"},
                                                                  {"_m3", "m^3"},
                                                                  {"_rad", "rad"},
                                                                  {"_deg", "deg"},
                                                                  {"_rpm", "rpm"},
                                                                  {"_hz", "Hz"},
                                                                  {"_kg", "kg"},
                                                                  {"_pa", "Pa"},
                                                                  {"_n", "N"},
                                                                  {"_w", "W"},
                                                                  {"_s", "s"},
                                                                  {"_m", "m"}}) {
    if (key.ends_with(ending)) return unit;
  }
  return "";
}

TEST(SummarySchema, TheUnitOfAKindIsThatOfTheName) {
  std::size_t with_unit = 0;
  for (const auto& [path, kind] : summary_kinds()) {
    if (path.ends_with("*")) continue;
    EXPECT_EQ(unit_of(kind), unit_in(last_key(path))) << path;
    with_unit += unit_of(kind).empty() ? 0U : 1U;
  }
  EXPECT_GT(with_unit, 80U);
}

/// True if a schema lets a number stand at its place.
bool takes_numbers(const json& schema) {
  for (const char* type : {"number", "integer"}) {
    if (schema["type"] == type || (schema["type"].is_array() && schema["type"][0] == type)) return true;
  }
  return false;
}

/// Walks over a schema; every number in it must have a kind of numbers at its path, every text a kind of texts.
void expect_kinds(const json& schema, const std::string& path, std::size_t& numbers) {
  if (schema.contains("properties")) {
    for (const auto& [key, value] : schema["properties"].items())
      expect_kinds(value, path.empty() ? key : path + "." + key, numbers);
    return;
  }
  if (schema.contains("items")) return expect_kinds(schema["items"], path + "[]", numbers);
  if (schema["type"] == "object") return expect_kinds(schema["additionalProperties"], path + ".*", numbers);
  ASSERT_TRUE(summary_kinds().contains(path)) << path;
  EXPECT_EQ(is_number(summary_kinds().at(path)), takes_numbers(schema)) << path;
  numbers += takes_numbers(schema) ? 1 : 0;
}

TEST(SummarySchema, EveryNumberHasAKind) {
  std::size_t numbers = 0;
  expect_kinds(json::parse(summary_schema().dump()), "", numbers);
  EXPECT_GT(numbers, 150U);
}

TEST(SummarySchema, AKindIsFoundWhateverTheIndices) {
  EXPECT_EQ(kind_at("lobes[12].at_case_speed.crossings[3].depth_m"), Kind::length);
  EXPECT_EQ(kind_at("contacts[0].identified.stiffness_n_per_m[2][1]"), Kind::stiffness);
  EXPECT_EQ(kind_at("operating_points[0].forced_vibration.surface_location_error_m"), Kind::length);
  EXPECT_EQ(kind_at("part.modes[0].residual"), Kind::residual);
  EXPECT_EQ(kind_at("timings_s.mesh"), Kind::run_time);
  EXPECT_EQ(kind_at("of_another_version[3].x"), Kind::ratio);
}

TEST(SummarySchema, AKeySaysItsTypeItsUnitAndWhetherItIsAlwaysThere) {
  const json schema = json::parse(summary_schema().dump());
  const json& chart = schema["properties"]["lobes"]["items"];
  const json& depth = chart["properties"]["minimum_depth_m"];
  EXPECT_EQ(depth["type"], "number");
  EXPECT_EQ(depth["unit"], "m");
  EXPECT_EQ(depth["kind"], "length");
  EXPECT_FALSE(depth["description"].get<std::string>().empty());
  EXPECT_EQ(chart["properties"]["error_estimate_relative"]["type"], json({"number", "null"}));
  const auto required = chart["required"].get<std::vector<std::string>>();
  const auto among = [&](const char* key) { return std::ranges::count(required, key) == 1; };
  EXPECT_TRUE(among("minimum_depth_m"));
  EXPECT_TRUE(among("error_estimate_relative")) << "null where it is not known";
  EXPECT_FALSE(among("compared")) << "absent where the case asks for no other method";
  EXPECT_FALSE(among("map"));
}

/// A summary with every way in which a value may be there or not.
Summary example() {
  Summary summary;
  summary.case_name = "wall";
  summary.robot.emplace();
  summary.robot->model = "one_mode";
  summary.robot->posture.tip_m = Eigen::Vector3d(0.1, 0.2, 1.0 / 3.0);
  summary.robot->static_stiffness_n_per_m = {1e6, std::nullopt, 2e6};
  summary.robot->least_static_stiffness_n_per_m.emplace();
  summary.lobes.resize(2);
  summary.lobes[1].name = study::ChartOf::supported;
  summary.lobes[1].compared.resize(1);
  summary.lobes[1].at_case_speed.emplace();
  summary.lobes[1].at_case_speed->limiting_depth_m = 0.0137;
  summary.timings_s["total"] = 1.5;
  return summary;
}

TEST(SummaryJson, WhatIsNotThereIsAbsentOrNullAsItsFieldSays) {
  const json written = summary_json(example());
  EXPECT_FALSE(written.contains("part"));
  EXPECT_FALSE(written.contains("path")) << "absent while empty";
  EXPECT_EQ(written["contacts"], json::array()) << "always there";
  EXPECT_EQ(written["robot"]["tip_m"], json({0.1, 0.2, 1.0 / 3.0})) << "the posture is no section of its own";
  EXPECT_EQ(written["robot"]["static_stiffness_n_per_m"], json({1e6, nullptr, 2e6}));
  EXPECT_TRUE(written["robot"]["least_static_stiffness_n_per_m"].is_null()) << "rigid, which is known";
  EXPECT_FALSE(written["lobes"][0].contains("compared"));
  EXPECT_EQ(written["lobes"][1]["compared"].size(), 1U);
  EXPECT_TRUE(written["lobes"][1]["error_budget"].is_null());
  EXPECT_EQ(written["lobes"][1]["at_case_speed"]["limiting_depth_m"], 0.0137) << "fields of the row that it is";
}

TEST(SummaryJson, WhatWasWrittenIsReadToTheLastBit) {
  const json written = summary_json(example());
  EXPECT_EQ(summary_json(summary_from(written, "summary.json")), written);
}

TEST(SummaryJson, AnEnumerationIsOneOfItsWords) {
  json written = summary_json(example());
  EXPECT_EQ(written["lobes"][1]["name"], "supported");
  EXPECT_EQ(summary_schema()["properties"]["lobes"]["items"]["properties"]["name"]["enum"].dump(),
            R"(["part","supported","tool","carried"])");
  written["lobes"][1]["name"] = "suported";
  EXPECT_THROW((void)summary_from(written, "summary.json"), core::DataError);
}

TEST(SummaryJson, AnInfinityIsNullAndReadAsNoNumber) {
  Summary summary;
  summary.part.emplace();
  summary.part->mass_kg = std::numeric_limits<double>::infinity();
  const json written = summary_json(summary);
  EXPECT_TRUE(written["part"]["mass_kg"].is_null());
  EXPECT_TRUE(std::isnan(summary_from(written, "summary.json").part->mass_kg));
}

TEST(SummaryJson, AValueOfAnotherTypeIsRefusedWithItsPlace) {
  json wrong = summary_json(example());
  wrong["lobes"][1]["at_case_speed"]["limiting_depth_m"] = "deep";
  try {
    (void)summary_from(wrong, "results/summary.json");
    FAIL();
  } catch (const core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find("lobes[1].at_case_speed.limiting_depth_m"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace thinwall::report::summary_schema_test
