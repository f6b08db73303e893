#include "io/results/csv_table.hpp"

#include <cmath>
#include <limits>
#include <locale>
#include <random>

#include "core/error.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::csv_table_test {

namespace {

class CsvTable : public ScratchFolder {};

/// Writes numbers as a German would: 1.234,5.
struct CommaNumbers : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

std::vector<double> awkward_numbers() {
  std::vector<double> values{0.0,
                             -0.0,
                             0.1,
                             1.0 / 3.0,
                             std::numeric_limits<double>::denorm_min(),
                             std::numeric_limits<double>::max(),
                             std::numeric_limits<double>::infinity()};
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int i = 0; i < 1000; ++i) values.push_back(std::ldexp(mantissa(random), exponent(random)));
  return values;
}

}  // namespace

TEST_F(CsvTable, ComesBackExactlyUnderACommaLocale) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  const auto values = awkward_numbers();
  std::vector<std::string> words(values.size(), "hopf");
  words[1] = "a, \"quoted\" word";
  words[2] = " blank ";
  write_csv(path("table.csv"), {{"speed_rpm", values}, {"kind", words}}, {"down-milling, 6 teeth"});
  const Table table = read_csv(path("table.csv"));
  std::locale::global(before);
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0].name, "speed_rpm");
  EXPECT_EQ(numbers(table, "speed_rpm", "table.csv"), values);
  EXPECT_EQ(std::get<std::vector<std::string>>(table[1].values), words);
}

TEST_F(CsvTable, EmptyCellsAreGapsOfAColumnThatMayHaveThem) {
  const std::vector<double> ratio{std::nan(""), 0.01, std::nan("")}, none(3, std::nan(""));
  write_csv(path("gaps.csv"),
            {{"mode", std::vector<double>{1.0, 2.0, 3.0}}, {"ratio", ratio, true}, {"none", none, true}});
  const Table table = read_csv(path("gaps.csv"));
  const auto read = numbers_or_gaps(table, "ratio", "gaps.csv");
  ASSERT_EQ(read.size(), 3U);
  EXPECT_TRUE(std::isnan(read[0]) && std::isnan(read[2]));
  EXPECT_EQ(read[1], 0.01);
  EXPECT_EQ(numbers_or_gaps(table, "none", "gaps.csv").size(), 3U);
  EXPECT_TRUE(std::isnan(numbers_or_gaps(table, "none", "gaps.csv")[1]));
  const std::string message =
      message_of<core::DataError>([&] { static_cast<void>(numbers(table, "ratio", "gaps.csv")); });
  EXPECT_NE(message.find("\"ratio\" has an empty cell"), std::string::npos) << message << ": no NaN unawares";
}

TEST_F(CsvTable, IsNotWrittenWithNaNOrColumnsOfUnequalLength) {
  const std::string message = message_of<core::NumericalError>([&] {
    write_csv(path("t.csv"), {{"depth_m", std::vector<double>{1.0, std::nan("")}}});
  });
  EXPECT_NE(message.find("\"depth_m\", row 2"), std::string::npos) << message;
  EXPECT_THROW(write_csv(path("t.csv"), {{"a", std::vector<double>{1.0}}, {"b", std::vector<double>{}}}),
               core::InputError);
  EXPECT_THROW(write_csv(path("t.csv"), {}), core::InputError);
  EXPECT_TRUE(is_empty());
}

TEST_F(CsvTable, OffersTheNearestColumnName) {
  const auto file = write("t.csv", "frequency_hz;damping_ratio;kind\n1;2;flip\n");
  const Table table = read_csv(file);
  EXPECT_EQ(numbers(table, "frequency_hz", file), std::vector<double>{1.0});
  const std::string message = message_of<core::DataError>([&] { (void)numbers(table, "frequency", file); });
  EXPECT_NE(message.find("did you mean \"frequency_hz\""), std::string::npos) << message;
  EXPECT_THROW((void)numbers(table, "kind", file), core::DataError);
}

TEST_F(CsvTable, IsRefusedWithoutHeaderOrWithAWordAmongNumbers) {
  EXPECT_THROW((void)read_csv(write("a.csv", "1,2\n3,4\n")), core::DataError);
  const std::string message =
      message_of<core::DataError>([&] { (void)read_csv(write("b.csv", "x,y\n1,2\n3,four\n")); });
  EXPECT_NE(message.find(":3: column 2: \"four\" is not a number"), std::string::npos) << message;
  EXPECT_THROW((void)read_csv(write("c.csv", "x,y\n1,nan\n")), core::DataError);
}

}  // namespace thinwall::io::test::csv_table_test
