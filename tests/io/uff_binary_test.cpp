// Data set 58b: written and read to the last bit, and as real analysers damage it.

#include <bit>
#include <cmath>
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/frf/uff.hpp"
#include "scratch_folder.hpp"
#include "uff_bytes.hpp"

namespace thinwall::io::test::uff_binary_test {

namespace {

using Complex = std::complex<double>;
using dynamics::DofKind;
using dynamics::ResponseModel;

class BinaryUniversalFile : public ScratchFolder {};

/// Two responses to one force; every bit pattern of a mantissa may occur, and payload bytes that look like text.
ResponseModel random_model(const Eigen::VectorXd& hz) {
  std::srand(3);
  ResponseModel model;
  model.axis.hz = hz;
  model.responses = {{"P", Eigen::Vector3d::UnitX(), DofKind::translation},
                     {"Q", Eigen::Vector3d(0.6, 0.0, -0.8), DofKind::rotation}};
  model.forces = {{"P", -Eigen::Vector3d::UnitZ(), DofKind::translation}};
  for (Eigen::Index line = 0; line < hz.size(); ++line) model.H.emplace_back(Eigen::MatrixXcd::Random(2, 1) * 1e-7);
  model.H.front()(0, 0) = std::bit_cast<double>(std::uint64_t{0x0A310A0D'2D202020});  // "   -\r\n1\n"
  return model;
}

const Eigen::VectorXd even_axis = Eigen::VectorXd::LinSpaced(101, 5.0, 255.0);
const Eigen::VectorXd uneven_axis = dynamics::logarithmic_axis(1.0 / 3.0, 4000.0, 77).hz;

double largest_difference(const ResponseModel& a, const ResponseModel& b) {
  double largest = a.H.size() == b.H.size() ? 0.0 : INFINITY;
  for (std::size_t line = 0; line < std::min(a.H.size(), b.H.size()); ++line) {
    for (Eigen::Index i = 0; i < a.H[line].size(); ++i) {
      const Complex x = a.H[line].reshaped()(i);
      const Complex y = b.H[line].reshaped()(i);
      const auto relative = [](double u, double v) { return u == v ? 0.0 : std::abs(u - v) / std::abs(v); };
      largest = std::max({largest, relative(x.real(), y.real()), relative(x.imag(), y.imag())});
    }
  }
  return largest;
}

// ---- Files by hand: the columns and bytes below are written out from the format's description ----

/// FRF of node 12 +z under a force at node 3 −y, in m/N, 10 to 30 Hz in three lines.
const std::vector<double> values{1.0, -2.0, 0.25, -0.5, 3e-3, 4e-3};

std::string file_of(const std::string& data_set) {
  return units_set(1, 1.0, 1.0) + data_set;
}

MeasuredResponse read(const std::string& bytes) {
  return response_matrix(uff_entries(bytes, "analyser.uff"));
}

void expect_the_values(const MeasuredResponse& measured, const std::vector<double>& hz, double tolerance = 0.0) {
  const ResponseModel& model = measured.response;
  ASSERT_EQ(model.axis.size(), 3);
  EXPECT_EQ(name(model.responses[0]), "node 12.z");
  EXPECT_EQ(model.forces[0].point, "node 3");
  EXPECT_EQ(model.forces[0].direction, -Eigen::Vector3d::UnitY());
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(model.axis.hz(static_cast<Eigen::Index>(i)), hz[i], tolerance * hz[i]);
    EXPECT_NEAR(model.H[i](0, 0).real(), values[2 * i], tolerance);
    EXPECT_NEAR(model.H[i](0, 0).imag(), values[2 * i + 1], tolerance);
  }
}

const std::vector<double> tens{10.0, 20.0, 30.0};
const std::vector<double> unequal{10.0, 11.5, 30.25};

std::vector<double> interleaved(const std::vector<double>& hz) {
  std::vector<double> numbers;
  for (std::size_t i = 0; i < hz.size(); ++i) {
    for (const double number : {hz[i], values[2 * i], values[2 * i + 1]}) numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

TEST_F(BinaryUniversalFile, InDoubleComesBackToTheLastBitInBothByteOrders) {
  for (const bool little_endian : {true, false}) {
    for (const Eigen::VectorXd& hz : {even_axis, uneven_axis}) {
      const ResponseModel model = random_model(hz);
      write_uff(path("frf.uff"), model, {true, little_endian, true});
      const MeasuredResponse back = read_uff(path("frf.uff"));
      EXPECT_TRUE(back.notes.empty()) << back.notes.front();
      EXPECT_EQ(back.response.axis.hz, model.axis.hz);
      ASSERT_EQ(back.response.H.size(), model.H.size());
      for (std::size_t line = 0; line < model.H.size(); ++line) EXPECT_EQ(back.response.H[line], model.H[line]);
      EXPECT_EQ(back.response.responses[1].kind, DofKind::rotation);
      EXPECT_EQ(back.response.responses[1].direction, model.responses[1].direction);
    }
  }
}

// 24 bits: half a unit in the last place is 2^-24.
TEST_F(BinaryUniversalFile, InSingleComesBackToTheBitsOfAFloat) {
  for (const bool little_endian : {true, false}) {
    for (const Eigen::VectorXd& hz : {even_axis, uneven_axis}) {
      ResponseModel model = random_model(hz);
      model.H.front()(0, 0) = 1e-7;
      write_uff(path("frf.uff"), model, {true, little_endian, false});
      const MeasuredResponse back = read_uff(path("frf.uff"));
      EXPECT_TRUE(back.notes.empty()) << back.notes.front();
      EXPECT_LE(largest_difference(back.response, model), std::ldexp(1.0, -24));
      EXPECT_LE(((back.response.axis.hz - hz).array() / hz.array()).abs().maxCoeff(), std::ldexp(1.0, -24));
      write_uff(path("again.uff"), back.response, {true, little_endian, false});
      EXPECT_EQ(core::read_file(path("frf.uff")), core::read_file(path("again.uff")));
    }
  }
}

// E13.5: six digits.
TEST_F(BinaryUniversalFile, AsTextInSingleKeepsSixDigits) {
  for (const Eigen::VectorXd& hz : {even_axis, uneven_axis}) {
    ResponseModel model = random_model(hz);
    model.H.front()(0, 0) = 1e-7;
    write_uff(path("frf.uff"), model, {false, true, false});
    EXPECT_LE(largest_difference(read_uff(path("frf.uff")).response, model), 5.1e-6);
  }
}

TEST_F(BinaryUniversalFile, IsNotWrittenInSingleWhereAValueIsBeyondIt) {
  ResponseModel model = random_model(even_axis);
  for (const double beyond : {1e-60, 1e60}) {
    model.H[3](1, 0) = beyond;
    EXPECT_THROW(write_uff(path("frf.uff"), model, {true, true, false}), core::NumericalError);
  }
  EXPECT_TRUE(is_empty());
}

// Byte by byte: heading I6,1A1,I6,I6,I12,I12,I6,I6,I12,I12, eleven records, then 1.5 − 2i as IEEE doubles, the lowest
// byte first, and the delimiter without a line end before it.
TEST_F(BinaryUniversalFile, HasEveryByteInItsPlace) {
  ResponseModel model;
  model.axis.hz = Eigen::VectorXd::Constant(1, 8.0);
  model.responses = {{"P", Eigen::Vector3d::UnitX(), DofKind::translation}};
  model.forces = model.responses;
  model.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, Complex(1.5, -2.0)));
  write_uff(path("frf.uff"), model, {true, true, true});
  const std::string bytes = core::read_file(path("frf.uff"));
  const std::string heading =
      "    -1\n    58b     1     2          11          24     0     0           0           0\n";
  const auto at = bytes.find(heading);
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(heading.size(), 7U + 80U);
  // 1 Hz has no step: uneven, the abscissa is stored.
  const std::string numbers(
      "\x00\x00\x00\x00\x00\x00\x20\x40\x00\x00\x00\x00\x00\x00\xF8\x3F\x00\x00\x00\x00\x00\x00\x00\xC0", 24);
  EXPECT_EQ(bytes.substr(bytes.size() - 31), numbers + "    -1\n");
  EXPECT_EQ(std::count(bytes.begin() + static_cast<long>(at + heading.size()), bytes.end() - 31, '\n'), 11);
}

TEST_F(BinaryUniversalFile, ByHandIsReadInEveryStorageThatTheFormatKnows) {
  for (const bool little_endian : {true, false}) {
    const std::string even = frf_heading(6, 3, true);
    expect_the_values(read(file_of(binary_set(even, doubles(values, little_endian), 48, little_endian))), tens);
    const std::string single = frf_heading(5, 3, true);
    expect_the_values(read(file_of(binary_set(single, floats(values, little_endian), 24, little_endian))), tens, 1e-7);
    const std::string uneven = frf_heading(6, 3, false);
    const auto numbers = interleaved(unequal);
    const auto measured = read(file_of(binary_set(uneven, doubles(numbers, little_endian), 72, little_endian)));
    expect_the_values(measured, unequal);
    EXPECT_TRUE(measured.notes.empty());
    // E13.5,2E20.12 taken by the letter: the abscissa in single.
    std::string mixed;
    for (std::size_t i = 0; i < 9; ++i) {
      mixed += i % 3 == 0 ? floats({numbers[i]}, little_endian) : doubles({numbers[i]}, little_endian);
    }
    expect_the_values(read(file_of(binary_set(uneven, mixed, 60, little_endian))), unequal);
  }
}

TEST_F(BinaryUniversalFile, WithAStrayLineEndBehindTheValuesIsReadAndNoted) {
  for (const char* line_end : {"\n", "\r\n", "\r"}) {
    const std::string set = binary_set(frf_heading(6, 3, true), doubles(values, true) + line_end, 48, true);
    const MeasuredResponse measured = read(file_of(set + set_of_another_kind()));
    expect_the_values(measured, tens);
    ASSERT_EQ(measured.notes.size(), 1U);
    EXPECT_EQ(measured.notes[0], "analyser.uff:7: a line end after the binary values is passed over");
  }
}

// A complex value counted as one number of eight bytes; with an uneven abscissa that is a third.
TEST_F(BinaryUniversalFile, WithAByteCountOfAHalfOrAThirdIsReadAndNoted) {
  const MeasuredResponse half =
      read(file_of(binary_set(frf_heading(6, 3, true), doubles(values, true), 24, true) + set_of_another_kind()));
  expect_the_values(half, tens);
  ASSERT_EQ(half.notes.size(), 1U);
  EXPECT_NE(half.notes[0].find("24 bytes are stated where 48 are"), std::string::npos) << half.notes[0];
  const MeasuredResponse third = read(file_of(
      binary_set(frf_heading(6, 3, false), doubles(interleaved(unequal), true), 24, true) + set_of_another_kind()));
  expect_the_values(third, unequal);
  ASSERT_EQ(third.notes.size(), 1U);
  EXPECT_NE(third.notes[0].find("24 bytes are stated where 72 are"), std::string::npos) << third.notes[0];
}

TEST_F(BinaryUniversalFile, StatedAsSingleButStoredAsDoubleIsReadAndNoted) {
  for (const bool little_endian : {true, false}) {
    const MeasuredResponse measured =
        read(file_of(binary_set(frf_heading(5, 3, true), doubles(values, little_endian), 48, little_endian)));
    expect_the_values(measured, tens);
    ASSERT_EQ(measured.notes.size(), 1U);
    EXPECT_NE(measured.notes[0].find("stored in double precision, record 7 states single"), std::string::npos);
    const MeasuredResponse other =
        read(file_of(binary_set(frf_heading(6, 3, true), floats(values, little_endian), 24, little_endian)));
    expect_the_values(other, tens, 1e-7);
    EXPECT_NE(other.notes.at(0).find("stored in single precision, record 7 states double"), std::string::npos);
  }
}

TEST_F(BinaryUniversalFile, WithBlankIdLinesIsReadAndNoted) {
  std::string heading = frf_heading(6, 3, true);
  const auto id = std::string("an ID line\n");
  for (auto at = heading.find(id); at != std::string::npos; at = heading.find(id)) heading.replace(at, id.size(), "\n");
  const MeasuredResponse measured = read(file_of(binary_set(heading, doubles(values, true), 48, true)));
  expect_the_values(measured, tens);
  EXPECT_EQ(measured.notes, (UffNotes{"analyser.uff:7: ID lines are blank: 1, 2, 3, 4, 5"}));
}

TEST_F(BinaryUniversalFile, WithAllFaultsAtOnceAndLineEndsOfWindowsIsRead) {
  std::string heading;
  for (const char c : frf_heading(5, 3, true)) heading += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const MeasuredResponse measured = read(file_of(binary_set(heading, doubles(values, false) + "\r\n", 7, false)));
  expect_the_values(measured, tens);
  EXPECT_EQ(measured.notes.size(), 3U);
}

// The bytes of the values hold a delimiter and line ends: only count and type may find the end.
TEST_F(BinaryUniversalFile, IsNotEndedByBytesThatLookLikeADelimiter) {
  const std::string text = "\n    -1\n";
  std::uint64_t bits = 0;
  for (std::size_t k = 0; k < 8; ++k)
    bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(text[k])) << (8 * k);
  std::vector<double> numbers = values;
  numbers[2] = std::bit_cast<double>(bits);
  const MeasuredResponse measured =
      read(file_of(binary_set(frf_heading(6, 3, true), doubles(numbers, true), 48, true) + set_of_another_kind()));
  EXPECT_EQ(measured.response.H[1](0, 0).real(), numbers[2]);
}

TEST_F(BinaryUniversalFile, ThatFitsNoReadingIsRefused) {
  const std::string whole = doubles(values, true);
  const auto message_for = [](const std::string& set) {
    return message_of<core::DataError>([&] { (void)read(file_of(set)); });
  };
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{47}}) {
    const std::string message = message_for(binary_set(frf_heading(6, 3, true), whole.substr(0, size), 48, true));
    EXPECT_NE(message.find("analyser.uff:18: 3 values by record 7"), std::string::npos) << message;
  }
  const std::string set = binary_set(frf_heading(6, 3, true), whole, 48, true);
  const auto with = [&set](const std::string& old, const std::string& fresh) {
    std::string other = set;
    return other.replace(other.find(old), old.size(), fresh);
  };
  EXPECT_NE(message_for(with("    58b     1", "    58b     3")).find("byte order 3"), std::string::npos);
  EXPECT_NE(message_for(with("    58b     1     2", "    58b     1     3")).find("floating-point format 3"),
            std::string::npos);
  EXPECT_NE(message_for(with("    58b", "    55b")).find("only 58b"), std::string::npos);
  EXPECT_NE(message_for(with("         6         3", "         61000000000")).find("1000000000 values"),
            std::string::npos);
  // The other byte order turns 3e-3 into something finite but 1.0 into a denormal: only infinities can be told.
  std::vector<double> infinite = values;
  infinite[1] = INFINITY;
  EXPECT_NE(message_for(binary_set(frf_heading(6, 3, true), doubles(infinite, true), 48, true)).find("not finite"),
            std::string::npos);
}

}  // namespace thinwall::io::test::uff_binary_test
