// The JSON Schema that editors get says what the table of keys says.

#include "case/schema/json_schema.hpp"

#include <gtest/gtest.h>

#include "case/templates.hpp"
#include "core/atomic_file.hpp"
#include "tests/case/case_text.hpp"
#include "tests/case/validator.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests::json_schema_test {

using namespace cases;

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const Json& schema_of_cases() {
  static const Json schema = json_schema(case_schema(), "case.toml of thinwall");
  return schema;
}

TEST(JsonSchema, AKeyHasItsBoundsItsUnitItsDefaultAndItsMeaning) {
  const Json& part = schema_of_cases()["properties"]["part"]["properties"];
  const Json& poisson = part["material"]["properties"]["poisson_ratio"];
  EXPECT_EQ(poisson["anyOf"][0], Json({{"type", "number"}, {"minimum", 0.0}, {"exclusiveMaximum", 0.5}}));
  const Json& size = part["mesh"]["properties"]["element_size"];
  EXPECT_EQ(size["default"], "auto");
  EXPECT_EQ(size["anyOf"][2], Json({{"enum", {"auto"}}}));
  EXPECT_NE(size["description"].get<std::string>().find("Unit: m. Range: above 0 m."), std::string::npos);
  EXPECT_EQ(part["holes"]["items"]["required"], Json::array({"outline"}));
  EXPECT_EQ(schema_of_cases()["properties"]["points"]["patternProperties"].size(), 1U);
}

/// Number of values in a schema's objects.
std::size_t count_keys(const Json& schema) {
  if (schema.contains("items") && schema["items"].contains("properties")) return count_keys(schema["items"]);
  if (!schema.contains("properties")) return 1;
  std::size_t count = 0;
  for (const auto& [name, value] : schema["properties"].items()) count += count_keys(value);
  if (schema.contains("patternProperties")) {
    for (const auto& [name, value] : schema["patternProperties"].items()) count += count_keys(value);
  }
  return count;
}

TEST(JsonSchema, EveryKeyOfTheTableIsThereOnce) {
  EXPECT_EQ(count_keys(schema_of_cases()), case_schema().keys.size());
  EXPECT_EQ(count_keys(json_schema(expectation_schema(), "")), expectation_schema().keys.size());
}

/// Cases that each break one rule.
std::vector<std::string> wrong_cases() {
  const std::string plate = plate_case();
  return {with(plate, "thickness = \"6 mm\"", "thicknes = \"6 mm\""),
          with(plate, "[points.P]", "[points.\"P 1\"]"),
          with(plate, "poisson_ratio = 0.3", "poisson_ratio = 0.5"),
          with(plate, "teeth = 6", "teeth = 6.5"),
          with(plate, "teeth = 6", "teeth = 0"),
          with(plate, "teeth = 6\n", ""),
          with(plate, "length = \"392 mm\"", "length = \"long\""),
          with(plate, "length = \"392 mm\"", "length = true"),
          with(plate, "at = [1.0, 0.5, 0.95]", "at = [1.0, 0.5]"),
          with(plate, "fixed = [\"x\", \"y\", \"z\"]", "fixed = [\"x\", \"w\"]"),
          with(plate, "from = \"1000 rpm\"", "from = 1000"),
          with(plate, "[lobes]", "[lobes]\nmethod = \"guess\""),
          with(plate, "[[contacts]]", "[contacts]")};
}

TEST(JsonSchema, AValidatorTakesEveryCaseOfOursAndRefusesWrongOnes) {
  const TemporaryFolder temporary;
  std::vector<fs::path> good, bad;
  for (const auto& entry : fs::directory_iterator(fs::path(THINWALL_SOURCE_DIR) / "cases"))
    if (entry.is_directory()) good.push_back(entry.path() / "case.toml");
  for (const auto& name : template_names()) good.push_back(write_template(name, temporary.path / name));
  good.push_back(temporary.path / "plate.toml");
  core::write_file_atomically(good.back(), plate_case());
  int number = 0;
  for (const auto& text : wrong_cases()) {
    ASSERT_FALSE(text.empty()) << "the replacement did not match: " << number;
    bad.push_back(temporary.path / ("wrong_" + std::to_string(number++) + ".toml"));
    core::write_file_atomically(bad.back(), text);
  }
  const Validation validation = validate(temporary.path, good, bad);
  if (validation.status == 77 || validation.status == 127) GTEST_SKIP() << "no validator: " << validation.said;
  EXPECT_EQ(validation.status, 0) << validation.said;
}

}  // namespace
}  // namespace thinwall::tests::json_schema_test
