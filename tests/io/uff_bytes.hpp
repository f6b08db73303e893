#pragma once
// Universal files put together by hand, without our writer: columns and bytes as the format's description gives them.

#include <bit>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace thinwall::io::test {

/// Data set 164: I10,20A1,I10 and 3D25.17.
inline std::string units_set(int code, double length, double force) {
  char text[200];
  std::snprintf(text, sizeof text, "    -1\n   164\n%10d%-20s%10d\n%25.17E%25.17E%25.17E\n    -1\n", code, "units", 2,
                length, force, 1.0);
  return text;
}

/// A data set that no reader of ours knows.
inline std::string set_of_another_kind() {
  return "    -1\n    15\n         1         0         0        11  0.00000E+00  0.00000E+00  0.00000E+00\n    -1\n";
}

/// Record 9 or 10 or 8 or 11: I10,3I5,2(1X,20A1).
inline std::string axis_record(int type, const std::string& unit) {
  char text[100];
  std::snprintf(text, sizeof text, "%10d    0    0    0 %-20s %-20s\n", type, "NONE", unit.c_str());
  return text;
}

/// What an FRF is of: types and labels of numerator and denominator.
struct FrfWords {
  int function_type = 4;
  int numerator = 8;
  std::string numerator_unit = "m";
  int denominator = 13;
  std::string denominator_unit = "N";
  std::string dofs = " NONE              12   3 NONE               3  -2";
  std::string abscissa_unit = "Hz";
  double first = 10.0;
  double step = 10.0;
};

/// Records 1 to 11 of data set 58: node 12 in +z under a force at node 3 in −y, 10 Hz on in steps of 10 Hz.
inline std::string frf_heading(int ordinate_type, int count, bool even, const FrfWords& words = {}) {
  char text[200];
  std::string records = "an ID line\nan ID line\nan ID line\nan ID line\nan ID line\n";
  std::snprintf(text, sizeof text, "%5d         1    0         0%s\n", words.function_type, words.dofs.c_str());
  records += text;
  std::snprintf(text, sizeof text, "%10d%10d%10d%13.5E%13.5E%13.5E\n", ordinate_type, count, even ? 1 : 0,
                even ? words.first : 0.0, even ? words.step : 0.0, 0.0);
  records += text;
  return records + axis_record(18, words.abscissa_unit) + axis_record(words.numerator, words.numerator_unit) +
         axis_record(words.denominator, words.denominator_unit) + axis_record(0, "NONE");
}

template <typename Number, typename Bits>
std::string bytes_of(const std::vector<double>& numbers, bool little_endian) {
  std::string bytes;
  for (const double number : numbers) {
    const Bits bits = std::bit_cast<Bits>(static_cast<Number>(number));
    std::string word;
    for (std::size_t k = 0; k < sizeof bits; ++k) word += static_cast<char>(bits >> (8 * k) & 0xFFU);
    bytes += little_endian ? word : std::string(word.rbegin(), word.rend());
  }
  return bytes;
}

inline std::string doubles(const std::vector<double>& numbers, bool little_endian) {
  return bytes_of<double, std::uint64_t>(numbers, little_endian);
}

inline std::string floats(const std::vector<double>& numbers, bool little_endian) {
  return bytes_of<float, std::uint32_t>(numbers, little_endian);
}

/// A data set 58b: heading I6,1A1,I6,I6,I12,I12,I6,I6,I12,I12, records, bytes, and the delimiter right behind them.
inline std::string binary_set(const std::string& records, const std::string& bytes, int stated_bytes,
                              bool little_endian) {
  char text[120];
  std::snprintf(text, sizeof text, "    -1\n    58b%6d%6d%12d%12d%6d%6d%12d%12d\n", little_endian ? 1 : 2, 2, 11,
                stated_bytes, 0, 0, 0, 0);
  return text + records + bytes + "    -1\n";
}

/// A data set 58 with its record 12.
inline std::string text_set(const std::string& records, const std::string& values) {
  return "    -1\n    58\n" + records + values + "    -1\n";
}

}  // namespace thinwall::io::test
