// Data sets 58 as other programs write them: quantities, units, exponents, coherence, and what is refused.

#include <cmath>
#include <complex>
#include <cstdio>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "io/frf/uff.hpp"
#include "scratch_folder.hpp"
#include "uff_bytes.hpp"

namespace thinwall::io::test::uff_foreign_test {

namespace {

using Complex = std::complex<double>;

class ForeignUniversalFile : public ScratchFolder {};

constexpr double pi = std::numbers::pi;
const std::vector<Complex> numbers{{1.0, -2.0}, {0.25, -0.5}, {3e-3, 4e-3}};

/// 4E20.12 or 6E13.5, filled to the last record.
std::string text_values(const std::vector<double>& values, const char* format, std::size_t per_record) {
  std::string text;
  for (std::size_t i = 0; i < values.size(); ++i) {
    char field[40];
    std::snprintf(field, sizeof field, format, values[i]);
    text += field;
    if ((i + 1) % per_record == 0 || i + 1 == values.size()) text += "\n";
  }
  return text;
}

std::string complex_values() {
  return text_values({1.0, -2.0, 0.25, -0.5, 3e-3, 4e-3}, "%20.12E", 4);
}

MeasuredEntries entries(const std::string& bytes, const UffReading& reading = {}) {
  return uff_entries(bytes, "analyser.uff", reading);
}

/// The values as receptance: factor · Y / (iω)^derivative.
void expect_receptance(const MeasuredEntry& entry, double factor, int derivative) {
  ASSERT_EQ(entry.frf.H.size(), 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double omega = 2.0 * pi * 10.0 * static_cast<double>(i + 1);
    const Complex exact = factor * numbers[i] / std::pow(Complex(0.0, omega), derivative);
    const Complex found = entry.frf.H(static_cast<Eigen::Index>(i));
    EXPECT_LE(std::abs(found - exact), 1e-12 * std::abs(exact)) << i;
  }
}

std::string frf_set(const FrfWords& words = {}) {
  return text_set(frf_heading(6, 3, true, words), complex_values());
}

std::string refusal(const std::string& bytes) {
  return message_of<core::DataError>([&] { (void)entries(bytes); });
}

void expect_refused(const std::string& bytes, const std::string& cause) {
  const std::string message = refusal(bytes);
  EXPECT_NE(message.find(cause), std::string::npos) << message;
}

}  // namespace

TEST_F(ForeignUniversalFile, GivesItsQuantityByTheNumeratorsType) {
  expect_receptance(entries(frf_set()).entries.at(0), 1.0, 0);
  FrfWords words;
  words.numerator = 11;
  words.numerator_unit = "m/s";
  expect_receptance(entries(frf_set(words)).entries.at(0), 1.0, 1);
  words.numerator = 12;
  for (const char* unit : {"m/s^2", "m/s2", "m/s²"}) {
    words.numerator_unit = unit;
    expect_receptance(entries(frf_set(words)).entries.at(0), 1.0, 2);
  }
}

TEST_F(ForeignUniversalFile, GivesItsUnitsByTheLabels) {
  FrfWords words;
  words.numerator = 12;
  words.numerator_unit = "g";
  words.denominator_unit = "lbf";
  // Standard gravity cancels: a pound force is 0.45359237 kg times it.
  expect_receptance(entries(frf_set(words)).entries.at(0), 1.0 / 0.45359237, 2);
  words = {};
  words.numerator_unit = "um";
  words.denominator_unit = "kN";
  expect_receptance(entries(frf_set(words)).entries.at(0), 1e-9, 0);
  // Rotation about y over a moment about z.
  words.dofs = " wing              12   5 NONE               3   6";
  words.numerator_unit = "deg";
  words.denominator_unit = "Nm";
  const MeasuredEntry entry = entries(frf_set(words)).entries.at(0);
  expect_receptance(entry, pi / 180.0, 0);
  EXPECT_EQ(name(entry.response), "wing:12.ry");
  EXPECT_EQ(name(entry.force), "node 3.rz");
}

TEST_F(ForeignUniversalFile, GivesItsUnitsByDataSet164WhereThereAreNoLabels) {
  FrfWords words;
  words.numerator = 12;
  words.numerator_unit = words.denominator_unit = "NONE";
  // Inch and pound force, 39.37 in a metre and 0.2248 in a newton; user-defined: millimetres and kilonewtons.
  const double inch_system = 0.0254 / (0.45359237 * 9.80665);
  const std::string inches = units_set(7, 1.0 / 0.0254, 1.0 / (0.45359237 * 9.80665));
  expect_receptance(entries(inches + frf_set(words)).entries.at(0), inch_system, 2);
  expect_receptance(entries(units_set(9, 1000.0, 0.001) + frf_set(words)).entries.at(0), 1e-6, 2);
  words.numerator_unit = words.denominator_unit = "";
  expect_receptance(entries(units_set(10, 1000.0, 1.0) + frf_set(words)).entries.at(0), 1e-3, 2);
  // rad/s² per N mm.
  words.dofs = " NONE              12   4 NONE               3   4";
  expect_receptance(entries(units_set(10, 1000.0, 1.0) + frf_set(words)).entries.at(0), 1e3, 2);
  // The units that stand before a function are its own.
  words = {};
  words.numerator_unit = words.denominator_unit = "";
  const auto both = entries(units_set(1, 1.0, 1.0) + frf_set(words) + units_set(10, 1000.0, 1.0) + frf_set(words));
  expect_receptance(both.entries.at(0), 1.0, 0);
  expect_receptance(both.entries.at(1), 1e-3, 0);
}

TEST_F(ForeignUniversalFile, WhoseLabelsContradictItsUnitsIsNoted) {
  FrfWords words;
  words.numerator_unit = "mm";
  const MeasuredEntries measured = entries(units_set(1, 1.0, 1.0) + frf_set(words));
  expect_receptance(measured.entries.at(0), 1e-3, 0);
  ASSERT_EQ(measured.notes.size(), 1U);
  EXPECT_EQ(measured.notes[0],
            "analyser.uff:7: the response's unit \"mm\" is taken although data set 164 names another");
}

TEST_F(ForeignUniversalFile, OfAnUnknownQuantityOrUnitIsRefused) {
  FrfWords words;
  for (const int type : {0, 1, 9, 15, 16}) {
    words.numerator = type;
    expect_refused(frf_set(words), "specific data type " + std::to_string(type));
  }
  words = {};
  words.denominator = 0;
  expect_refused(frf_set(words), "specific data type 0 of the denominator");
  words = {};
  words.numerator_unit = "furlong";
  expect_refused(frf_set(words), "the response's unit \"furlong\" is unknown; state the quantity");
  words.numerator_unit = "m/s^2";
  expect_refused(frf_set(words), "is not of the dimension");
  words = {};
  words.denominator_unit = "N m";
  expect_refused(frf_set(words), "the force's unit \"N m\" is not of the dimension");
  words = {};
  words.numerator_unit = "NONE";
  expect_refused(frf_set(words), "neither by a label nor by a data set 164");
  words.dofs = " NONE              12   0 NONE               3  -2";
  expect_refused(units_set(1, 1.0, 1.0) + frf_set(words), "its direction is 0 (scalar)");
  words = {};
  words.abscissa_unit = "m";
  expect_refused(frf_set(words), "specific data type 18 of the abscissa in \"m\"");
  expect_refused(units_set(5, 1.0, 1.0) + frf_set(), "not those of units code 5");
  expect_refused(units_set(12, 1.0, 1.0) + frf_set(), "units code 12");
  expect_refused(units_set(9, -1.0, 1.0) + frf_set(), "must be positive");
  words = {};
  words.function_type = 2;
  expect_refused(frf_set(words), "no data set 58 of function type 4");
}

TEST_F(ForeignUniversalFile, LeavesOpenWhatTheCallerStatesAndThatIsNoted) {
  for (const auto& [numerator, denominator] : {std::pair{0, 0}, {0, 13}, {1, 1}, {12, 0}, {12, 9}}) {
    FrfWords words;
    words.numerator = numerator;
    words.numerator_unit = "counts";
    words.denominator = denominator;
    const MeasuredEntries measured = entries(frf_set(words), {frf_format("accelerance", "g/N", "Hz")});
    expect_receptance(measured.entries.at(0), 9.80665, 2);
    ASSERT_EQ(measured.notes.size(), 1U);
    EXPECT_NE(measured.notes[0].find("read as accelerance in 9.80665 m/s^2/N, as stated; the file has data types " +
                                     std::to_string(numerator) + " over " + std::to_string(denominator)),
              std::string::npos)
        << measured.notes[0];
  }
  FrfWords words;
  words.numerator_unit = "NONE";  // and no data set 164: no unit
  expect_receptance(entries(frf_set(words), {frf_format("receptance", "um/N", "Hz")}).entries.at(0), 1e-6, 0);
  words = {};
  words.abscissa_unit = "NONE";
  const MeasuredEntries slower = entries(frf_set(words), {frf_format("receptance", "m/N", "rad/s")});
  EXPECT_NEAR(slower.entries.at(0).frf.axis.hz(0), 10.0 / (2.0 * pi), 1e-12);
  ASSERT_EQ(slower.notes.size(), 1U);
  EXPECT_NE(slower.notes[0].find("taken in the unit that is stated"), std::string::npos);
  words.abscissa_unit = "rad/s";
  EXPECT_NEAR(entries(frf_set(words)).entries.at(0).frf.axis.hz(2), 30.0 / (2.0 * pi), 1e-12);
}

TEST_F(ForeignUniversalFile, ThatSaysWhatTheCallerStatesIsReadWithoutANote) {
  EXPECT_TRUE(entries(frf_set(), {frf_format("receptance", "m/N", "Hz")}).notes.empty());
  FrfWords words;
  words.numerator_unit = "mm";
  EXPECT_TRUE(entries(frf_set(words), {frf_format("receptance", "mm/N", "Hz")}).notes.empty());
  words.numerator_unit = words.denominator_unit = "NONE";
  const std::string in_inches = units_set(7, 1.0 / 0.0254, 1.0 / (0.45359237 * 9.80665)) + frf_set(words);
  EXPECT_TRUE(
      entries(in_inches, {FrfFormat{FrfQuantity::receptance, 0.0254 / (0.45359237 * 9.80665), 1.0}}).notes.empty());
}

TEST_F(ForeignUniversalFile, ThatSaysAnotherQuantityOrUnitThanTheCallerIsRefused) {
  const auto refused = [](const std::string& bytes, const FrfFormat& stated, const std::string& part) {
    const std::string text = message_of<core::DataError>([&] { (void)entries(bytes, {stated}); });
    EXPECT_NE(text.find(part), std::string::npos) << text;
    EXPECT_EQ(text.find("analyser.uff:"), 0U) << text;
  };
  const FrfFormat receptance = frf_format("receptance", "m/N", "Hz");
  FrfWords words;
  for (const int type : {2, 11, 12, 15}) {
    words.numerator = type;
    refused(frf_set(words), receptance,
            "receptance in m/N is stated, but the file says data type " + std::to_string(type) +
                " over 13 (data set 58, records 9 and 10)");
  }
  refused(frf_set(words), receptance, "leave out quantity and unit, or correct the one that is wrong");
  words = {};
  words.denominator = 12;  // a transmissibility
  refused(frf_set(words), receptance, "data type 8 over 12");
  refused(frf_set(), frf_format("receptance", "um/N", "Hz"),
          "receptance in 1e-06 m/N is stated, but the file says receptance in m/N");
  words = {};
  words.numerator = 0;  // open, but not its label
  words.numerator_unit = "m/s^2";
  refused(frf_set(words), receptance, "the unit \"m/s^2\" of the response (data set 58, record 9)");
  words = {};
  words.numerator_unit = words.denominator_unit = "NONE";
  refused(units_set(5, 1000.0, 1000.0) + frf_set(words), frf_format("receptance", "mm/N", "Hz"),
          "receptance in m/N (data set 164)");
  refused(frf_set(), frf_format("receptance", "m/N", "rad/s"), "data type 18 in \"Hz\" (data set 58, record 8)");
  words = {};
  words.numerator_unit = "mm";
  words.denominator_unit = "NONE";  // newtons, as long as nothing says otherwise
  refused(frf_set(words), receptance, "receptance in 0.001 m/N");
  words = {};
  words.abscissa_unit = "s";
  std::string over_time = frf_set(words);
  over_time.replace(over_time.find("        18    0"), 10, "        17");
  refused(over_time, receptance, "data type 17 in \"s\"");
}

// 1.0D+00 and 1.0+000, which Fortran writes where the exponent needs three digits; filled columns leave no blank.
TEST_F(ForeignUniversalFile, MayHaveTheExponentsOfFortran) {
  const std::string values =
      "  1.000000000000D+00 -2.000000000000d+00  0.250000000000+000 -5.000000000000E-01\n"
      "  3.000000000000-003+4.000000000000D-03\n";
  expect_receptance(entries(text_set(frf_heading(6, 3, true), values)).entries.at(0), 1.0, 0);
}

TEST_F(ForeignUniversalFile, IsReadInEveryFormOfRecord12) {
  const std::vector<double> flat{1.0, -2.0, 0.25, -0.5, 3e-3, 4e-3};
  const std::vector<double> with_x{10.0, 1.0, -2.0, 20.0, 0.25, -0.5, 30.0, 3e-3, 4e-3};
  expect_receptance(entries(text_set(frf_heading(5, 3, true), text_values(flat, "%13.5E", 6))).entries.at(0), 1.0, 0);
  expect_receptance(entries(text_set(frf_heading(5, 3, false), text_values(with_x, "%13.5E", 6))).entries.at(0), 1.0,
                    0);
  std::string mixed;
  std::string real_mixed;
  for (std::size_t i = 0; i < 3; ++i) {
    char record[100];
    std::snprintf(record, sizeof record, "%13.5E%20.12E%20.12E\n", with_x[3 * i], with_x[3 * i + 1], with_x[3 * i + 2]);
    mixed += record;
    std::snprintf(record, sizeof record, "%13.5E%20.12E%s", with_x[3 * i], with_x[3 * i + 1], i == 0 ? "" : "\n");
    real_mixed += record;
  }
  expect_receptance(entries(text_set(frf_heading(6, 3, false), mixed)).entries.at(0), 1.0, 0);
  const auto expect_real = [](const std::string& set) {
    const MeasuredFrf frf = entries(set).entries.at(0).frf;
    EXPECT_EQ(frf.axis.hz, Eigen::Vector3d(10.0, 20.0, 30.0));
    EXPECT_EQ(frf.H, Eigen::Vector3cd(1.0, 0.25, 3e-3));
  };
  expect_real(text_set(frf_heading(2, 3, true), text_values({1.0, 0.25, 3e-3}, "%13.5E", 6)));
  expect_real(text_set(frf_heading(2, 3, false), text_values({10.0, 1.0, 20.0, 0.25, 30.0, 3e-3}, "%13.5E", 6)));
  expect_real(text_set(frf_heading(4, 3, true), text_values({1.0, 0.25, 3e-3}, "%20.12E", 4)));
  expect_real(text_set(frf_heading(4, 3, false), real_mixed));
}

TEST_F(ForeignUniversalFile, FilledUpWithZerosIsReadAndNoted) {
  std::vector<double> values{10.0, 1.0, -2.0, 20.0, 0.25, -0.5, 30.0, 3e-3, 4e-3, 0.0, 0.0, 0.0};
  const MeasuredEntries measured = entries(text_set(frf_heading(5, 3, false), text_values(values, "%13.5E", 6)));
  expect_receptance(measured.entries.at(0), 1.0, 0);
  EXPECT_EQ(measured.notes, (UffNotes{"analyser.uff:2: zeros behind the last value are passed over"}));
  values.back() = 1.0;
  expect_refused(text_set(frf_heading(5, 3, false), text_values(values, "%13.5E", 6)), "a value more than record 7");
}

TEST_F(ForeignUniversalFile, LosesItsLineAtZeroHertzUnlessItIsAReceptance) {
  FrfWords words;
  words.first = 0.0;
  EXPECT_EQ(entries(frf_set(words)).entries.at(0).frf.axis.size(), 3);
  words.numerator = 12;
  words.numerator_unit = "m/s^2";
  const MeasuredEntries measured = entries(frf_set(words));
  EXPECT_EQ(measured.entries.at(0).frf.axis.hz, Eigen::Vector2d(10.0, 20.0));
  EXPECT_EQ(measured.notes, (UffNotes{"analyser.uff:2: the line at 0 Hz has no receptance and is left out"}));
  words.first = -10.0;
  expect_refused(frf_set(words), "the first frequency is negative");
  words.first = 10.0;
  words.step = 0.0;
  expect_refused(frf_set(words), "does not rise");
}

TEST_F(ForeignUniversalFile, BringsTheCoherenceOfItsEntries) {
  FrfWords coherence;
  coherence.function_type = 6;
  coherence.numerator = coherence.denominator = 0;
  coherence.numerator_unit = coherence.denominator_unit = "NONE";
  FrfWords other = coherence;
  other.dofs = " NONE              13   3 NONE               3  -2";
  const auto set = [](const FrfWords& words, const std::vector<double>& values) {
    return text_set(frf_heading(2, 3, true, words), text_values(values, "%13.5E", 6));
  };
  // A rounding above 1 is 1; of another response there is no FRF.
  const MeasuredEntries measured = entries(set(coherence, {0.5, 1.0000005, 0.75}) + frf_set() +
                                           set(other, {1.0, 1.0, 1.0}) + set(coherence, {1.0, 1.0, 1.0}));
  EXPECT_EQ(measured.entries.at(0).frf.coherence, Eigen::Vector3d(0.5, 1.0, 0.75));
  ASSERT_EQ(measured.notes.size(), 2U);
  EXPECT_NE(measured.notes[0].find("there twice"), std::string::npos);
  EXPECT_NE(measured.notes[1].find("belongs to no FRF"), std::string::npos);
  expect_refused(frf_set() + set(coherence, {0.5, 1.5, 0.5}), "a coherence of 1.5");
  expect_refused(frf_set() + set(coherence, {0.5, -0.5, 0.5}), "a coherence of -0.5");
  const MeasuredResponse matrix = response_matrix(entries(frf_set() + set(coherence, {0.5, 1.0, 0.75})));
  EXPECT_EQ(coherence_of(matrix, 0, 0), Eigen::Vector3d(0.5, 1.0, 0.75));
}

TEST_F(ForeignUniversalFile, OfOtherFunctionsTellsHowManyArePassedOver) {
  FrfWords words;
  words.function_type = 2;
  const MeasuredEntries measured = entries(frf_set() + frf_set(words) + frf_set(words) + set_of_another_kind());
  EXPECT_EQ(measured.notes, (UffNotes{"analyser.uff: 2 functions of type 2 are passed over"}));
}

TEST_F(ForeignUniversalFile, MakesAMatrixOrSaysAllThatIsInItsWay) {
  FrfWords cross;
  cross.dofs = " NONE              13  -1 NONE               3  -2";
  const MeasuredResponse column = response_matrix(entries(frf_set() + frf_set(cross)));
  EXPECT_EQ(column.response.H.front().rows(), 2);
  EXPECT_EQ(column.response.responses[1].direction, -Eigen::Vector3d::UnitX());
  FrfWords third;
  third.dofs = " NONE              12   3 NONE              14   1";
  const std::string twice_and_absent = frf_set() + frf_set(cross) + frf_set(third) + frf_set();
  const std::string message = message_of<core::DataError>([&] { (void)response_matrix(entries(twice_and_absent)); });
  EXPECT_NE(message.find("node 12.z/node 3.(0,-1,0) is there twice"), std::string::npos) << message;
  EXPECT_NE(message.find("the entry node 13.(-1,0,0)/node 14.x is absent"), std::string::npos) << message;
  FrfWords scalar;
  scalar.dofs = "                    0   0                    0   0";
  const MeasuredEntries unplaced = entries(frf_set(scalar));
  expect_receptance(unplaced.entries.at(0), 1.0, 0);
  EXPECT_NE(message_of<core::DataError>([&] { (void)response_matrix(unplaced); }).find("the direction at \"node 0\""),
            std::string::npos);
}

TEST_F(ForeignUniversalFile, OfOursKeepsItsCoherence) {
  MeasuredResponse measured;
  measured.response.axis.hz = Eigen::Vector3d(1.0, 2.0, 4.0);
  measured.response.responses = {{"P", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation},
                                 {"Q", Eigen::Vector3d(0.6, 0.8, 0.0), dynamics::DofKind::rotation}};
  measured.response.forces = {{"P", Eigen::Vector3d(0.0, 0.8, 0.6), dynamics::DofKind::translation}};
  for (int line = 0; line < 3; ++line) measured.response.H.emplace_back(Eigen::MatrixXcd::Random(2, 1));
  measured.coherence = {{1, 0, Eigen::Vector3d(0.1, 0.25, 1.0 / 3.0)}};
  for (const UffForm& form : {UffForm{}, UffForm{true, false, true}}) {
    write_uff(path("frf.uff"), measured, form);
    const MeasuredResponse back = read_uff(path("frf.uff"));
    EXPECT_TRUE(back.notes.empty()) << back.notes.front();
    EXPECT_EQ(coherence_of(back, 0, 0).size(), 0);
    const Eigen::VectorXd coherence = coherence_of(back, 1, 0);
    ASSERT_EQ(coherence.size(), 3);
    // 13 digits as text, every bit as bytes.
    EXPECT_LE((coherence - measured.coherence[0].values).cwiseAbs().maxCoeff(), form.binary ? 0.0 : 5e-14);
  }
}

}  // namespace thinwall::io::test::uff_foreign_test
