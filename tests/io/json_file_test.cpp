// JSON files: a wrong value is told with file and place; bytes that are no UTF-8 are written.

#include "io/json_file.hpp"

#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/xml_text.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::json_file_test {

namespace {

class JsonFile : public ScratchFolder {};

/// What is said of a value that is of another kind than asked for.
template <typename Ask>
std::string refusal(const nlohmann::json& document, const Ask& ask) {
  return message_of<core::DataError>([&] { ask(JsonValue{&document, "f.json", ""}); });
}

}  // namespace

TEST_F(JsonFile, ValuesComeBackAsTheyWereWritten) {
  const nlohmann::json document = {{"name", "Kraft \"x\""}, {"list", {{{"n", 3}}, {{"n", 4}}}}, {"r", {0.1, 1e-300}}};
  write_json(path("a.json"), document);
  const nlohmann::json read = read_json(path("a.json"));
  const JsonValue value{&read, "a.json", ""};
  EXPECT_EQ(value.at("name").text(), "Kraft \"x\"");
  EXPECT_EQ(value.at("list").items().at(1).at("n").integer(0, 4), 4);
  EXPECT_EQ(value.at("r").numbers(), (std::vector<double>{0.1, 1e-300}));
}

TEST_F(JsonFile, WhatIsWrongIsToldWithFilePlaceAndKind) {
  const nlohmann::json document = {{"axes", {{{"key", 3}, {"values", {"1", 2}}, {"n", 2.5}}}}, {"none", nullptr}};
  const std::string end = "; the file is damaged or not of thinwall, make it anew";
  const auto axis = [](const JsonValue& value) { return value.at("axes").items().at(0); };
  EXPECT_EQ(refusal(document, [](const JsonValue& v) { (void)v.at("case"); }), "\"f.json\": case is missing" + end);
  EXPECT_EQ(refusal(document, [&](const JsonValue& v) { (void)axis(v).at("key").text(); }),
            "\"f.json\": axes[0].key is a number where a text is expected" + end);
  EXPECT_EQ(refusal(document, [&](const JsonValue& v) { (void)axis(v).at("values").texts(); }),
            "\"f.json\": axes[0].values[1] is a number where a text is expected" + end);
  EXPECT_EQ(refusal(document, [&](const JsonValue& v) { (void)axis(v).at("n").integer(0, 9); }),
            "\"f.json\": axes[0].n is 2.5 where a whole number from 0 to 9 is expected" + end);
  EXPECT_EQ(refusal(document, [](const JsonValue& v) { (void)v.at("axes").at("key"); }),
            "\"f.json\": axes is a list of 1 where an object is expected" + end);
  EXPECT_EQ(refusal(3, [](const JsonValue& v) { (void)v.has("key"); }),
            "\"f.json\": the document is a number where an object is expected" + end);
  EXPECT_EQ(refusal(1e300, [](const JsonValue& v) { (void)v.integer(0, 9); }),
            "\"f.json\": the document is 1e+300 where a whole number from 0 to 9 is expected" + end);
  EXPECT_FALSE((JsonValue{&document, "f.json", ""}).has("none"));
}

TEST_F(JsonFile, WhatIsNoJsonIsRefusedWithTheFile) {
  for (const std::string text : {"", "{", "{\"a\": 1,", "nan", "\"\xe9\"", "[1e999]"}) {
    const auto file = write("bad.json", text);
    const std::string said = message_of<core::DataError>([&] { (void)read_json(file); });
    EXPECT_NE(said.find("\"" + file.string() + "\": "), std::string::npos) << said;
  }
  EXPECT_THROW((void)read_json(path("absent.json")), core::DataError);
  const auto nested = [](int depth) {
    return std::string(static_cast<std::size_t>(depth), '[') + std::string(static_cast<std::size_t>(depth), ']');
  };
  EXPECT_NO_THROW((void)read_json(write("deep.json", nested(100))));
  EXPECT_THROW((void)read_json(write("deeper.json", nested(102))), core::DataError);
  EXPECT_THROW((void)read_json(write("deepest.json", nested(1000000))), core::DataError);
}

TEST_F(JsonFile, BytesThatAreNoUtf8AreReplaced) {
  EXPECT_EQ(json_text({{"case", "caf\xe9"}}), "{\n  \"case\": \"caf\xef\xbf\xbd\"\n}\n");
}

TEST_F(JsonFile, AKindIsSaidInFewWords) {
  EXPECT_EQ(kind_of({{"a", 1}, {"b", 2}, {"c", 3}, {"d", 4}, {"e", 5}}), "an object with a, b, c and 2 more");
  EXPECT_EQ(kind_of({{"a", 1}, {"b", 2}, {"c", 3}}), "an object with a, b, c");
  EXPECT_EQ(kind_of(nlohmann::json::array({1, 2, 3})), "a list of 3");
}

TEST(XmlText, MarksBecomeEntities) {
  EXPECT_EQ(xml_escaped("a<b & \"c\">d"), "a&lt;b &amp; &quot;c&quot;&gt;d");
}

}  // namespace thinwall::io::test::json_file_test
