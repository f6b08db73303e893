// Real numbers in the fields of Nastran's cards.

#include "io/matrices/nastran_cards.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace thinwall::io::test::nastran_cards_test {

TEST(NastranReal, FitsSixteenColumnsAndComesBack) {
  for (const double value :
       {1.0, -1.0, 0.1, 123456789012345.0, -2.5e-7, 1e300, -1e-300, 7.25e2, 0.0, -0.25, 0.30000000000001}) {
    const std::string text = nastran_real_text(value);
    EXPECT_LE(text.size(), 16U);
    EXPECT_NE(text.find('.'), std::string::npos) << text;
    EXPECT_EQ(nastran_real(text, "x", 1), value) << text;
  }
  for (const double value : {1.0 / 3.0, -2.0 / 3.0 * 1e7, -1.0 / 3.0 * 1e-9, 2.0 / 3.0 * 1e200}) {
    const std::string text = nastran_real_text(value);
    EXPECT_LE(text.size(), 16U);
    EXPECT_LT(std::abs(nastran_real(text, "x", 1) / value - 1.0), 2e-11) << text;
    EXPECT_EQ(nastran_real_text(nastran_real(text, "x", 1)), text);
  }
}

}  // namespace thinwall::io::test::nastran_cards_test
