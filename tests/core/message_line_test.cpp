#include "core/message_line.hpp"

#include <gtest/gtest.h>

#include <string>

namespace thinwall::core::message_line_test {
namespace {

TEST(MessageLine, AnUsualMessageStaysAsItIs) {
  const std::string text = "case.toml:8:13: part.thickness: \"2 µm/m\" is a number,\tbut a length is expected";
  EXPECT_EQ(message_line(text), text);
  EXPECT_EQ(message_line(std::string(600, 'x')), std::string(600, 'x'));
}

TEST(MessageLine, ControlCharactersNeitherEndTheLineNorMoveTheCursor) {
  EXPECT_EQ(message_line("no case at \"a\nb\x1b[2J\x7f\r\""), "no case at \"a?b?[2J??\"");
}

TEST(MessageLine, CharactersThatAreNotSeenNeitherTurnNorHideATextAndAreOneMarkEach) {
  EXPECT_EQ(message_line("a\u202Eb\u202A\u2066\u2069\u200E\u200F\u061Cc"), "a?b??????c");
  EXPECT_EQ(message_line("a\u200B\u200D\uFEFF\u2028\u2060\u00ADb"), "a??????b");
  EXPECT_EQ(message_line("\xc2\x80\xc2\x9b"
                         "2J\xc2\x9f"),
            "??2J?")
      << "controls of one byte in Latin-1";
  EXPECT_EQ(message_line("\u00A0\u061B\u061D\u200A\u2010\u2027\u202F\u2065é"),
            "\u00A0\u061B\u061D\u200A\u2010\u2027\u202F?é");
}

TEST(MessageLine, BytesThatAreNoUtf8DoNotReachTheTerminal) {
  EXPECT_EQ(message_line("no case at \"a\xff\xfe"
                         "b\""),
            "no case at \"a??b\"");
  EXPECT_EQ(message_line("\xc2"), "?") << "a character that is cut short";
  EXPECT_EQ(message_line("\xc0\x80 \xe2\x82 \xb5"), "?? ?? ?");
  EXPECT_EQ(message_line("µ € 😀"), "µ € 😀");
}

TEST(MessageLine, OfALongOnePlaceAndRemedyStay) {
  for (std::size_t shift = 0; shift < 2; ++shift) {
    std::string value(shift, 'x');
    for (int i = 0; i < 50000; ++i) value += "µ";
    const std::string line = message_line("--set key: " + value + "; write 6 mm");
    EXPECT_LE(line.size(), 600U);
    EXPECT_TRUE(line.starts_with("--set key: ")) << line;
    EXPECT_TRUE(line.ends_with("; write 6 mm")) << line;
    std::size_t halves = 0;  // every µ is whole: as many second bytes as first ones
    for (const char byte : line) halves += byte == '\xC2' ? 1 : byte == '\xB5' ? static_cast<std::size_t>(-1) : 0;
    EXPECT_EQ(halves, 0U);
  }
}

}  // namespace
}  // namespace thinwall::core::message_line_test
