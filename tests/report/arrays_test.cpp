#include "report/page/arrays.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "io/base64.hpp"
#include "unpacked.hpp"

namespace thinwall::report::arrays_test {
namespace {

TEST(Packed, ComesBackAsItWas) {
  const std::vector<double> numbers{0.0, -1.5, 1e-300, std::numeric_limits<double>::infinity()};
  const auto array = packed(numbers, {2, 2});
  EXPECT_EQ(array["type"], "f64");
  EXPECT_EQ(array["shape"], (std::vector<int>{2, 2}));
  EXPECT_EQ(unpacked<double>(array), numbers);
  const std::vector<std::int16_t> small{-32768, 0, 7, 32767};
  EXPECT_EQ(unpacked<std::int16_t>(packed(small, {4})), small);
  const std::vector<std::uint32_t> large{0, 70000, 4294967295U};
  EXPECT_EQ(unpacked<std::uint32_t>(packed(large, {3})), large);
  EXPECT_TRUE(std::isnan(unpacked<float>(packed(std::vector<float>{NAN}, {1})).front()));
}

TEST(Packed, OfAnotherShapeIsRefused) {
  EXPECT_THROW((void)packed(std::vector<float>{1.0F, 2.0F}, {3}), core::InputError);
}

TEST(ForPicture, KeepsTheBitsThatAPictureShows) {
  for (const double value : {1.0, -3.14159265, 2.5e-9, 6.02e23, 0.0}) {
    EXPECT_NEAR(for_picture(value), value, std::abs(value) * std::ldexp(1.0, -16)) << value;
    EXPECT_NEAR(for_picture(value, 7), value, std::abs(value) * std::ldexp(1.0, -8)) << value;
  }
  EXPECT_TRUE(std::isnan(for_picture(NAN)));
  EXPECT_TRUE(std::isinf(for_picture(INFINITY)));
  EXPECT_EQ(for_picture(std::numeric_limits<float>::max()), std::numeric_limits<float>::max()) << "no overflow";
}

TEST(Base64, OfTheStandard) {  // RFC 4648, section 10
  for (const auto& [bytes, text] : std::vector<std::pair<std::string, std::string>>{
           {"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(io::base64(bytes), text);
    EXPECT_EQ(io::from_base64(text), bytes);
  }
  EXPECT_THROW((void)io::from_base64("Zg="), core::DataError);
  EXPECT_THROW((void)io::from_base64("Z*=="), core::DataError);
  EXPECT_THROW((void)io::inflated("no zlib", 100), core::DataError);
}

}  // namespace
}  // namespace thinwall::report::arrays_test
