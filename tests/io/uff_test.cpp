#include "io/frf/uff.hpp"

#include <cmath>
#include <complex>
#include <locale>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::uff_test {

namespace {

using dynamics::Dof;
using dynamics::DofKind;
using dynamics::ResponseModel;
using Complex = std::complex<double>;

class UniversalFile : public ScratchFolder {
 protected:
  [[nodiscard]] std::vector<std::string> written_lines(const ResponseModel& model) const {
    write_uff(path("frf.uff"), model);
    std::ifstream file(path("frf.uff"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
  }

  /// The written file with the first `old` replaced, under another name.
  [[nodiscard]] std::filesystem::path damaged(const ResponseModel& model, const std::string& old,
                                              const std::string& fresh) const {
    write_uff(path("frf.uff"), model);
    std::string content = core::read_file(path("frf.uff"));
    const auto at = content.find(old);
    EXPECT_NE(at, std::string::npos) << old;
    return write("damaged.uff", content.replace(at, old.size(), fresh));
  }
};

const Dof p_x{"P", Eigen::Vector3d::UnitX(), DofKind::translation};
const Dof p2_minus_z{"P2", -Eigen::Vector3d::UnitZ(), DofKind::translation};

/// 10, 12.5 and 15 Hz.
ResponseModel three_lines() {
  ResponseModel model;
  model.axis.hz = Eigen::Vector3d(10.0, 12.5, 15.0);
  model.responses = {p_x};
  model.forces = {p2_minus_z};
  for (const Complex value : {Complex(1.0, 0.0), Complex(-2.5e-6, 1.0 / 3.0e-120), Complex(0.0, -6.25e-110)}) {
    model.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, value));
  }
  return model;
}

/// Two responses to three forces over every kind of direction, values over thirty decades.
ResponseModel random_model(const Eigen::VectorXd& hz) {
  ResponseModel model;
  model.axis.hz = hz;
  model.responses = {{"P, \"upper\" edge", Eigen::Vector3d(1.0, 2.0, -3.0).normalized(), DofKind::translation},
                     {"P2", Eigen::Vector3d::UnitY(), DofKind::rotation}};
  model.forces = {{"P2", Eigen::Vector3d(0.6, 0.8, 0.0), DofKind::rotation},
                  {"Stäubli tip", -Eigen::Vector3d::UnitX(), DofKind::translation},
                  {"P2", Eigen::Vector3d(1e-7, -1.0, 1e-200).normalized(), DofKind::translation}};
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> decade(-25.0, 5.0);
  for (Eigen::Index line = 0; line < hz.size(); ++line) {
    Eigen::MatrixXcd H(2, 3);
    for (Complex& entry : H.reshaped()) {
      const double scale = std::pow(10.0, decade(generator));
      entry = {scale * normal(generator), scale * normal(generator)};
    }
    model.H.push_back(H);
  }
  return model;
}

void expect_same_dofs(const dynamics::DofTable& a, const dynamics::DofTable& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].point, b[i].point);
    EXPECT_EQ(a[i].direction, b[i].direction);
    EXPECT_EQ(a[i].kind, b[i].kind);
  }
}

/// Half a unit of the last of `digits` significant digits, relative to the number, and the round-off of reading it.
void expect_digits(double read, double written, int digits) {
  EXPECT_LE(std::abs(read - written), (0.5 * std::pow(10.0, 1 - digits) + 1e-15) * std::abs(written));
}

void expect_same_values(const ResponseModel& read, const ResponseModel& written) {
  expect_same_dofs(read.responses, written.responses);
  expect_same_dofs(read.forces, written.forces);
  ASSERT_EQ(read.H.size(), written.H.size());
  for (std::size_t line = 0; line < written.H.size(); ++line) {
    ASSERT_EQ(read.H[line].rows(), written.H[line].rows());
    ASSERT_EQ(read.H[line].cols(), written.H[line].cols());
    for (Eigen::Index i = 0; i < written.H[line].size(); ++i) {
      expect_digits(read.H[line].reshaped()(i).real(), written.H[line].reshaped()(i).real(), 13);
      expect_digits(read.H[line].reshaped()(i).imag(), written.H[line].reshaped()(i).imag(), 13);
    }
  }
}

std::string padded(std::string text, std::size_t width) {
  text.resize(width, ' ');
  return text;
}

}  // namespace

// Written by hand from the FORMAT statements of data sets 151, 164 and 58 (case 7: complex double even, 4E20.12).
TEST_F(UniversalFile, HasEveryFieldInItsColumns) {
  const std::vector<std::string> expected{
      "    -1",
      "   151",
      padded("thinwall responses", 80),
      padded("receptance, e^{+i omega t}", 80),
      padded("thinwall", 80),
      // 10A1,10A1,3I10
      "NONE      NONE               0         0         0",
      "NONE      NONE      ",
      padded("thinwall", 80),
      "NONE      NONE      ",
      "    -1",
      "    -1",
      "   164",
      // I10,20A1,I10
      "         1SI: Meter (newton)           2",
      // 3D25.17, 23 characters each after two blanks
      "  1.00000000000000000D+00  1.00000000000000000D+00  1.00000000000000000D+00",
      "  2.73149999999999977D+02",
      "    -1",
      "    -1",
      "    58",
      padded("receptance at P", 80),
      padded("force at P2", 80),
      padded("NONE", 80),
      padded("response 1 0 0", 80),
      padded("force 0 0 -1", 80),
      // 2(I5,I10),2(1X,10A1,I10,I4)
      "    4         1    0         0 NONE               1   1 NONE               2  -3",
      // 3I10,3E13.5
      "         6         3         1  1.00000E+01  2.50000E+00  0.00000E+00",
      // I10,3I5,2(1X,20A1)
      "        18    0    0    0 Frequency            Hz                  ",
      "         8    0    0    0 Displacement         m                   ",
      "        13    0    0    0 Excitation force     N                   ",
      "         0    0    0    0 NONE                 NONE                ",
      "  1.000000000000E+00  0.000000000000E+00 -2.500000000000E-06 3.333333333333E+119",
      "  0.000000000000E+00-6.250000000000E-110",
      "    -1",
  };
  EXPECT_EQ(written_lines(three_lines()), expected);
}

// Case 8: complex double uneven, E13.5,2E20.12.
TEST_F(UniversalFile, GivesEachLineOfAnUnevenAxisItsFrequency) {
  ResponseModel model = three_lines();
  model.axis.hz(1) = 11.23456789;
  const std::vector<std::string> lines = written_lines(model);
  EXPECT_EQ(lines[24], "         6         3         0  0.00000E+00  0.00000E+00  0.00000E+00");
  EXPECT_EQ(lines[29], "  1.00000E+01  1.000000000000E+00  0.000000000000E+00");
  EXPECT_EQ(lines[30], "  1.12346E+01 -2.500000000000E-06 3.333333333333E+119");
  EXPECT_EQ(lines[31], "  1.50000E+01  0.000000000000E+00-6.250000000000E-110");
}

// The standard asks for the exponents of length and force where it cannot tell them from the direction (0, scalar):
// displacement m and rotation 1, force N and moment N m.
TEST_F(UniversalFile, TellsRotationsMomentsAndObliqueDirections) {
  const Eigen::Vector3d oblique(0.6, 0.8, 0.0);
  ResponseModel model = three_lines();
  model.responses = {{"P", -Eigen::Vector3d::UnitY(), DofKind::rotation}};
  model.forces = {{"R", Eigen::Vector3d::UnitZ(), DofKind::rotation}};
  std::vector<std::string> lines = written_lines(model);
  EXPECT_EQ(lines[23], "    4         1    0         0 NONE               1  -5 NONE               2   6");
  EXPECT_EQ(lines[26], "         8    0    0    0 Displacement         rad                 ");
  EXPECT_EQ(lines[27], "        13    0    0    0 Excitation force     N m                 ");

  model.responses = {{"P", oblique, DofKind::translation}};
  model.forces = {{"P", oblique, DofKind::translation}};
  lines = written_lines(model);
  EXPECT_EQ(lines[21], padded("response 0.6 0.8 0", 80));
  EXPECT_EQ(lines[23], "    4         1    0         0 NONE               1   0 NONE               1   0");
  EXPECT_EQ(lines[26], "         8    1    0    0 Displacement         m                   ");
  EXPECT_EQ(lines[27], "        13    0    1    0 Excitation force     N                   ");

  model.responses = {{"P", oblique, DofKind::rotation}};
  model.forces = {{"P", oblique, DofKind::rotation}};
  lines = written_lines(model);
  EXPECT_EQ(lines[26], "         8    0    0    0 Displacement         rad                 ");
  EXPECT_EQ(lines[27], "        13    1    1    0 Excitation force     N m                 ");
}

TEST_F(UniversalFile, ComesBackWithinTheDigitsOfTheFormatOnAnEvenAxis) {
  const ResponseModel model = random_model(Eigen::VectorXd::LinSpaced(2001, 0.5, 5000.5));
  write_uff(path("frf.uff"), model);
  const ResponseModel back = read_uff(path("frf.uff")).response;
  EXPECT_NO_THROW(dynamics::require_equal(back.axis, model.axis));
  expect_same_values(back, model);
}

TEST_F(UniversalFile, ComesBackWithinTheDigitsOfTheFormatOnAnUnevenAxis) {
  const ResponseModel model = random_model(dynamics::logarithmic_axis(0.3, 5000.0, 500).hz);
  write_uff(path("frf.uff"), model);
  const ResponseModel back = read_uff(path("frf.uff")).response;
  ASSERT_EQ(back.axis.size(), model.axis.size());
  for (Eigen::Index line = 0; line < back.axis.size(); ++line)
    expect_digits(back.axis.hz(line), model.axis.hz(line), 6);
  expect_same_values(back, model);
}

TEST_F(UniversalFile, IsWrittenTheSameOnceMoreAfterReading) {
  for (const Eigen::VectorXd& hz : {Eigen::VectorXd(Eigen::VectorXd::LinSpaced(12, 1.0, 12.0)),
                                    Eigen::VectorXd(Eigen::VectorXd::LinSpaced(12, 1.0 / 3.0, 5000.0 / 7.0)),
                                    Eigen::VectorXd(Eigen::VectorXd::Constant(1, 212.3456789))}) {
    write_uff(path("first.uff"), random_model(hz));
    write_uff(path("second.uff"), read_uff(path("first.uff")).response);
    EXPECT_EQ(core::read_file(path("first.uff")), core::read_file(path("second.uff")));
  }
}

// A step that six digits do not hold adds up: over 2000 lines of 2.5010005 Hz the last would be 1 mHz off.
TEST_F(UniversalFile, IsEvenOnlyIfSixDigitsGiveTheAxisBack) {
  const auto spacing = [this](const Eigen::VectorXd& hz) { return written_lines(random_model(hz))[24].substr(20, 10); };
  EXPECT_EQ(spacing(Eigen::VectorXd::LinSpaced(2001, 0.0, 5000.0)), "         1");
  EXPECT_EQ(spacing(Eigen::VectorXd::LinSpaced(1000, 0.1, 100.0)), "         1");
  EXPECT_EQ(spacing(Eigen::VectorXd::LinSpaced(2000, 0.5, 5000.0)), "         0");
  EXPECT_EQ(spacing(Eigen::VectorXd::LinSpaced(100, 1.234567, 100.234567)), "         0");
  EXPECT_EQ(spacing(Eigen::VectorXd::Constant(1, 10.0)), "         0");
}

TEST_F(UniversalFile, OpensAndClosesEveryDataSet) {
  const std::vector<std::string> lines = written_lines(random_model(Eigen::VectorXd::LinSpaced(9, 1.0, 9.0)));
  std::vector<std::string> kinds;
  bool open = false;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] != "    -1") {
      EXPECT_TRUE(open) << "line " << i + 1 << " lies outside";
      continue;
    }
    open = !open;
    if (open) kinds.push_back(lines.at(i + 1));
  }
  EXPECT_FALSE(open);
  EXPECT_EQ(kinds,
            (std::vector<std::string>{"   151", "   164", "    58", "    58", "    58", "    58", "    58", "    58"}));
}

TEST_F(UniversalFile, NumbersThePointsAsTheyAppear) {
  const std::vector<std::string> lines = written_lines(random_model(Eigen::VectorXd::LinSpaced(1, 1.0, 1.0)));
  std::vector<std::pair<std::string, std::string>> nodes;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i] == "    58") nodes.emplace_back(lines[i + 6].substr(41, 14), lines[i + 6].substr(66, 14));
    // No ID line may be blank.
    for (std::size_t id = 1; lines[i] == "    58" && id <= 5; ++id) {
      EXPECT_NE(lines[i + id].find_first_not_of(' '), std::string::npos);
    }
  }
  const std::vector<std::pair<std::string, std::string>> expected{
      {"         1   0", "         2   0"}, {"         1   0", "         3  -1"}, {"         1   0", "         2   0"},
      {"         2   5", "         2   0"}, {"         2   5", "         3  -1"}, {"         2   5", "         2   0"}};
  EXPECT_EQ(nodes, expected);
}

TEST_F(UniversalFile, DoesNotDependOnTheLocale) {
  struct CommaNumbers : std::numpunct<char> {
    [[nodiscard]] char do_decimal_point() const override { return ','; }
    [[nodiscard]] char do_thousands_sep() const override { return '.'; }
    [[nodiscard]] std::string do_grouping() const override { return "\3"; }
  };
  const ResponseModel model = random_model(Eigen::VectorXd::LinSpaced(1500, 1.0, 1500.0));
  write_uff(path("plain.uff"), model);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  write_uff(path("comma.uff"), model);
  const ResponseModel back = read_uff(path("comma.uff")).response;
  std::locale::global(before);
  EXPECT_EQ(core::read_file(path("plain.uff")), core::read_file(path("comma.uff")));
  expect_same_values(back, model);
}

TEST_F(UniversalFile, IsReadWithOtherTrailingBlanksLineEndsAndDataSets) {
  const ResponseModel model = random_model(Eigen::VectorXd::LinSpaced(5, 1.0, 5.0));
  std::string bare;
  std::string wide;
  for (std::string line : written_lines(model)) {
    wide += line + "   \r\n";
    line.erase(line.find_last_not_of(' ') + 1);
    bare += line + "\n";
  }
  bare += "\n    -1\n    15\n         1         0         0        11  0.00000E+00  0.00000E+00  0.00000E+00\n    -1";
  expect_same_values(read_uff(write("bare.uff", bare)).response, model);
  expect_same_values(read_uff(write("wide.uff", wide)).response, model);
}

TEST_F(UniversalFile, IsNotWrittenWithHoles) {
  for (const Complex hole : {Complex(std::nan(""), 0.0), Complex(0.0, INFINITY)}) {
    ResponseModel model = three_lines();
    model.H[1](0, 0) = hole;
    const std::string message = message_of<core::NumericalError>([&] { write_uff(path("frf.uff"), model); });
    EXPECT_NE(message.find("not finite at 12.5 Hz"), std::string::npos) << message;
  }
  ResponseModel model = three_lines();
  model.axis.hz(2) = std::nan("");
  EXPECT_THROW(write_uff(path("frf.uff"), model), core::NumericalError);
  EXPECT_TRUE(is_empty());
}

TEST_F(UniversalFile, IsNotWrittenFromWhatItCannotHold) {
  std::vector<ResponseModel> refused(9, three_lines());
  refused[0].H.pop_back();
  refused[1].H[2].resize(1, 2);
  refused[2].responses.clear();
  refused[3].responses[0] = {"mode 3", Eigen::Vector3d::Zero(), DofKind::modal};
  refused[4].forces[0].point = "P\nQ";
  refused[5].forces[0].point = "";
  refused[6].responses[0].point = std::string(67, 'P');
  refused[7].responses[0].direction *= 1.001;
  refused[8].axis.hz(1) = 10.000001;
  for (std::size_t i = 0; i < refused.size(); ++i) {
    EXPECT_THROW(write_uff(path("frf.uff"), refused[i]), core::InputError) << i;
  }
  const std::string message = message_of<core::InputError>([&] { write_uff(path("frf.uff"), refused[8]); });
  EXPECT_NE(message.find("10 Hz and 10.000001 Hz"), std::string::npos) << message;
  EXPECT_TRUE(is_empty());
}

TEST_F(UniversalFile, HoldsTheLongestPointName) {
  ResponseModel model = three_lines();
  model.responses[0].point = std::string(66, 'P');
  write_uff(path("frf.uff"), model);
  expect_same_values(read_uff(path("frf.uff")).response, model);
}

TEST_F(UniversalFile, OfAnotherFormIsRefusedWithItsLine) {
  struct Damage {
    std::string old;
    std::string fresh;
    int line;
    std::string cause;
  };
  const std::vector<Damage> damages{
      {"    58\n", "    58b     1     2\n", 29, "no \"    -1\" closes the data set"},
      {"    58\n", "    5x8\n", 18, "\"5x8\" where the number of a data set"},
      {"         1SI: Meter", "         5SI: Meter", 14, "not those of units code 5"},
      {"         1SI: Meter", "        11SI: Meter", 14, "units code 11"},
      {"response 1 0 0", "response 1 0", 18, "columns"},
      {"    4         1", "    5         1", 0, "no data set 58 of function type 4"},
      {"  -3\n", "   3\n", 18, "record 6"},
      {"  -3\n", "   7\n", 18, "direction 7"},
      {"         6         3", "         7         3", 25, "ordinate data type 7"},
      {"         6         3", "         5         3", 30, "is no finite number"},
      {"         6         3", "         6         0", 25, "positive number"},
      {"         6         3", "         6         5", 31, "\"\" in columns 41 to 60"},
      {"         6         3", "         6         2", 31, "more values than record 7 states"},
      {"         6         3", "         6   3000000", 29, "more than the data set has room for"},
      {"         8    0", "        15    0", 18, "specific data type 15"},
      {"        13    0", "        16    0", 18, "specific data type 16 of the denominator"},
      {"        18    0", "        19    0", 18, "specific data type 19 of the abscissa"},
      {" m   ", " N   ", 18, "is not of the dimension"},
      {" N   ", " zyx ", 18, "\"zyx\" is unknown"},
      {"  2.50000E+00", " -2.50000E+00", 18, "does not rise"},
      {"-2.500000000000E-06", "-2,500000000000E-06", 30, "columns 41 to 60"},
      {"  1.000000000000E+00", "                 nan", 30, "is no finite number"},
      {"-6.250000000000E-110", "-6.250000000000E-999", 31, "is no finite number"},
      {"    -1\n    -1\n   164", "    -1\nstray\n    -1\n   164", 11, "opens a data set"},
  };
  for (const Damage& damage : damages) {
    const auto file = damaged(three_lines(), damage.old, damage.fresh);
    const std::string message = message_of<core::DataError>([&] { (void)read_uff(file); });
    const std::string line = damage.line > 0 ? ":" + std::to_string(damage.line) : "";
    EXPECT_NE(message.find("damaged.uff" + line + ": "), std::string::npos) << message;
    EXPECT_NE(message.find(damage.cause), std::string::npos) << message;
  }
}

TEST_F(UniversalFile, CutShortIsRefusedWhereverItEnds) {
  const std::vector<std::string> lines = written_lines(three_lines());
  std::string content;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    content += lines[i] + "\n";
    EXPECT_THROW((void)read_uff(write("cut.uff", content)), core::DataError) << i;
  }
  EXPECT_NO_THROW((void)read_uff(write("whole.uff", content + "    -1")));
  EXPECT_THROW((void)read_uff(write("empty.uff", "")), core::DataError);
  EXPECT_THROW((void)read_uff(path("missing.uff")), core::DataError);
}

TEST_F(UniversalFile, WithAnEntryTooFewTooManyOrOnAnotherAxisIsRefused) {
  const ResponseModel model = random_model(Eigen::VectorXd::LinSpaced(3, 1.0, 3.0));
  write_uff(path("frf.uff"), model);
  const std::string content = core::read_file(path("frf.uff"));
  const std::string last = content.substr(content.rfind("    -1\n    58\n"));
  const auto message_for = [this](const std::string& text) {
    return message_of<core::DataError>([&] { (void)read_uff(write("other.uff", text)); });
  };
  EXPECT_NE(message_for(content.substr(0, content.size() - last.size())).find("5 entries where"), std::string::npos);
  EXPECT_NE(message_for(content + last).find("there twice"), std::string::npos);
  std::string moved = last;
  moved.replace(moved.find("  1.00000E+00"), 13, "  1.10000E+00");
  EXPECT_NE(message_for(content.substr(0, content.size() - last.size()) + moved).find("other frequencies"),
            std::string::npos);
}

}  // namespace thinwall::io::test::uff_test
