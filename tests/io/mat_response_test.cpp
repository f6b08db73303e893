#include "io/frf/mat_response.hpp"

#include <cmath>
#include <complex>
#include <cstdint>
#include <cstring>
#include <numbers>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/matrices/mat_variables.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::mat_response_test {

namespace {

using Complex = std::complex<double>;
using dynamics::DofKind;

class MatResponse : public ScratchFolder {};

MeasuredResponse random_response(bool with_coherence) {
  std::srand(11);
  MeasuredResponse measured;
  measured.response.axis = dynamics::logarithmic_axis(1.0 / 3.0, 2000.0, 17);
  measured.response.responses = dynamics::translations("P2 (Stäubli)");
  measured.response.forces = {{"P", Eigen::Vector3d(0.6, 0.0, -0.8), DofKind::translation},
                              {"R", Eigen::Vector3d::UnitZ(), DofKind::rotation}};
  for (int line = 0; line < 17; ++line) measured.response.H.emplace_back(Eigen::MatrixXcd::Random(3, 2) * 1e-7);
  for (Eigen::Index row = 0; with_coherence && row < 3; ++row) {
    for (Eigen::Index column = 0; column < 2; ++column) {
      measured.coherence.push_back({row, column, Eigen::VectorXd::Random(17).cwiseAbs()});
    }
  }
  return measured;
}

/// Frequencies f, a vector H21 and an array FRF of 2 x 3 x 4 whose every number tells its place.
void write_foreign(const std::filesystem::path& file, double first_hz) {
  MatVariable frf{"FRF", {2, 3, 4}, {}}, vector{"H21", {4, 1}, {}};
  for (int line = 0; line < 4; ++line) {
    for (int column = 0; column < 3; ++column) {
      for (int row = 0; row < 2; ++row) {
        frf.re.push_back(100.0 * (row + 1) + 10.0 * (column + 1) + line);
        frf.im.push_back(-1.0);
      }
    }
    vector.re.push_back(line + 0.5);
    vector.im.push_back(0.25);
  }
  write_mat_variables(file, "of another program",
                      {mat_matrix("f", Eigen::Vector4d(first_hz, 1.0, 2.0, 3.0)), frf, vector});
}

// ---- MAT files by hand ("MAT-File Format", MathWorks): 128 bytes of header, then elements of type, bytes, data ----

std::string word(std::uint32_t value) {
  std::string bytes(4, '\0');
  std::memcpy(bytes.data(), &value, 4);
  return bytes;
}

std::string element(std::uint32_t type, const std::string& data) {
  return word(type) + word(static_cast<std::uint32_t>(data.size())) + data +
         std::string((8 - data.size() % 8) % 8, '\0');
}

template <typename Number>
std::string raw(const std::vector<Number>& numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  std::memcpy(bytes.data(), numbers.data(), bytes.size());
  return bytes;
}

/// miMATRIX (14) of flags, dimensions, name, real and imaginary part; class 6 is double with data of type 9, class 7
/// single with 7; flag 0x0800 is complex.
template <typename Number>
std::string array(const std::string& name, const std::vector<std::int32_t>& size, const std::vector<Number>& re,
                  const std::vector<Number>& im = {}) {
  const bool is_double = sizeof(Number) == 8;
  const std::uint32_t type = is_double ? 9 : 7;
  const std::uint32_t flags = (is_double ? 6U : 7U) | (im.empty() ? 0U : 0x0800U);
  std::string data =
      element(6, word(flags) + word(0)) + element(5, raw(size)) + element(1, name) + element(type, raw(re));
  if (!im.empty()) data += element(type, raw(im));
  return element(14, data);
}

std::string mat_file(const std::string& elements) {
  std::string header = "MATLAB 5.0 MAT-file, by hand";
  header.resize(124, ' ');
  return header + std::string("\x00\x01IM", 4) + elements;
}

const dynamics::DofTable p_x{{"P", Eigen::Vector3d::UnitX(), DofKind::translation}};
const FrfFormat metres = frf_format("receptance", "m/N", "Hz");
const std::vector<double> hz{10.0, 20.0, 30.0};
const std::vector<double> re{1.0, 2.0, 3.0};
const std::vector<double> im{-4.0, -5.0, -6.0};

}  // namespace

TEST_F(MatResponse, ComesBackToTheLastBitWithItsDofsAndCoherence) {
  for (const bool with_coherence : {false, true}) {
    const MeasuredResponse measured = random_response(with_coherence);
    write_mat_response(path("frf.mat"), measured);
    const MeasuredResponse back = read_mat_response(path("frf.mat"));
    EXPECT_EQ(back.response.axis.hz, measured.response.axis.hz);
    for (std::size_t line = 0; line < 17; ++line) EXPECT_EQ(back.response.H.at(line), measured.response.H[line]);
    ASSERT_EQ(back.coherence.size(), measured.coherence.size());
    for (const EntryCoherence& entry : measured.coherence) {
      EXPECT_EQ(coherence_of(back, entry.row, entry.column), entry.values);
    }
    EXPECT_EQ(back.response.responses[1].point, "P2 (Stäubli)");
    EXPECT_EQ(back.response.forces[0].direction, measured.response.forces[0].direction);
    EXPECT_EQ(back.response.forces[1].kind, DofKind::rotation);
    write_mat_response(path("again.mat"), back);
    EXPECT_EQ(core::read_file(path("frf.mat")), core::read_file(path("again.mat")));
  }
}

TEST_F(MatResponse, OfAsManyLinesAsDofsIsNotTurned) {
  MeasuredResponse measured = random_response(false);
  measured.response.axis = dynamics::linear_axis(1.0, 2.0, 2);
  measured.response.responses.pop_back();
  measured.response.H = {Eigen::Matrix2cd::Random(), Eigen::Matrix2cd::Random()};
  write_mat_response(path("frf.mat"), measured);
  EXPECT_EQ(read_mat_response(path("frf.mat")).response.H[1], measured.response.H[1]);
}

// H(response, force, line) in MATLAB's order, first index fastest.
TEST_F(MatResponse, HoldsResponsesByForcesByLines) {
  const MeasuredResponse measured = random_response(false);
  write_mat_response(path("frf.mat"), measured);
  const MatVariables variables = read_mat_variables(path("frf.mat"), {"H", "frequency_hz", "force_name"});
  const MatVariable& H = variables.at("H");
  EXPECT_EQ(H.size, (std::vector<std::size_t>{3, 2, 17}));
  EXPECT_EQ(H.re.at(5 * 6 + 1 * 3 + 2), measured.response.H[5](2, 1).real());
  EXPECT_EQ(H.im.at(5 * 6 + 1 * 3 + 2), measured.response.H[5](2, 1).imag());
  EXPECT_EQ(variables.at("frequency_hz").size, (std::vector<std::size_t>{17, 1}));
  EXPECT_EQ(variables.at("force_name").texts, (std::vector<std::string>{"P.(0.6,0,-0.8)", "R.rz"}));
}

TEST_F(MatResponse, OfAMeasuringProgramIsReadFromPlainVariables) {
  const auto frequency = array<double>("f", {1, 3}, hz);
  for (const auto& size : {std::vector<std::int32_t>{3, 1}, {1, 3}, {1, 1, 3}, {3, 1, 1}}) {
    const auto file = write("export.mat", mat_file(frequency + array<double>("frf", size, re, im) +
                                                   array<double>("coh", {3, 1}, {0.5, 1.0, 0.75})));
    const MeasuredResponse measured = read_mat_frf(file, {"f", "frf", "coh"}, metres, p_x, p_x);
    EXPECT_EQ(measured.response.axis.hz, Eigen::Vector3d(10.0, 20.0, 30.0));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(measured.response.H[i](0, 0), Complex(re[i], im[i]));
    EXPECT_EQ(coherence_of(measured, 0, 0), Eigen::Vector3d(0.5, 1.0, 0.75));
  }
  const auto singles =
      write("single.mat", mat_file(array<float>("f", {3, 1}, {10.0F, 20.0F, 30.0F}) +
                                   array<float>("frf", {3, 1}, {1.0F, 2.0F, 3.0F}, {0.5F, 1.0F, 2.0F})));
  EXPECT_EQ(read_mat_frf(singles, {"f", "frf"}, metres, p_x, p_x).response.H[2](0, 0), Complex(3.0, 2.0));
}

TEST_F(MatResponse, OfAccelerationsInGsIsConverted) {
  const auto file = write(
      "export.mat", mat_file(array<double>("f", {1, 3}, {0.0, 20.0, 30.0}) + array<double>("frf", {3, 1}, re, im)));
  const auto measured = read_mat_frf(file, {"f", "frf"}, frf_format("accelerance", "g/N", "Hz"), p_x, p_x);
  ASSERT_EQ(measured.response.axis.size(), 2) << "0 Hz has no receptance";
  EXPECT_EQ(measured.notes.size(), 1U);
  const double omega = 2.0 * std::numbers::pi * 20.0;
  const Complex exact = -9.80665 * Complex(2.0, -5.0) / (omega * omega);
  EXPECT_LE(std::abs(measured.response.H[0](0, 0) - exact), 1e-15 * std::abs(exact));
}

TEST_F(MatResponse, WithLinesFirstIsToldByItsSize) {
  // Three lines of two responses to one force, and of two by two.
  const std::vector<double> six{1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  const auto responses = dynamics::DofTable{dynamics::translations("P")[0], dynamics::translations("P")[1]};
  const auto file = write("export.mat", mat_file(array<double>("f", {3, 1}, hz) + array<double>("a", {3, 2}, six) +
                                                 array<double>("b", {2, 3}, six)));
  EXPECT_EQ(read_mat_frf(file, {"f", "a"}, metres, responses, p_x).response.H[1], Eigen::Vector2cd(2.0, 5.0));
  EXPECT_EQ(read_mat_frf(file, {"f", "b"}, metres, responses, p_x).response.H[1], Eigen::Vector2cd(3.0, 4.0));
  EXPECT_EQ(read_mat_frf(file, {"f", "b"}, metres, p_x, responses).response.H[1], Eigen::RowVector2cd(3.0, 4.0));
}

TEST_F(MatResponse, OfAnotherShapeOrKindIsRefusedByName) {
  const auto refused = [&](const std::string& elements, const MatFrfNames& names = {"f", "frf", ""}) {
    const auto file = write("export.mat", mat_file(elements));
    return message_of<core::DataError>([&] { (void)read_mat_frf(file, names, metres, p_x, p_x); });
  };
  const auto expect = [](const std::string& message, const std::string& cause) {
    EXPECT_NE(message.find(cause), std::string::npos) << message;
  };
  const std::string f = array<double>("f", {1, 3}, hz);
  const std::string frf = array<double>("frf", {3, 1}, re, im);
  expect(refused(frf), "has no variable f");
  expect(refused(f), "has no variable frf");
  expect(refused(f + array<double>("frf", {2, 1}, {1.0, 2.0})), "the variable frf is 2 x 1; expected 1 x 1 x 3");
  expect(refused(array<double>("f", {1, 3}, {10.0, 30.0, 20.0}) + frf), "the variable f does not rise at 3");
  expect(refused(array<double>("f", {1, 3}, {-1.0, 30.0, 40.0}) + frf), "the variable f starts below 0");
  expect(refused(f + array<double>("frf", {3, 1}, {1.0, std::nan(""), 2.0})), "holds NaN");
  expect(refused(f + frf + array<double>("c", {3, 1}, {1.0, 1.5, 0.5}), {"f", "frf", "c"}), "outside of 0 to 1");
  expect(refused(f + frf, {"f", "frf", "c"}), "has no variable c");
  const auto three = dynamics::translations("P");
  const auto square = write("square.mat", mat_file(f + array<double>("frf", {3, 3}, std::vector<double>(9, 1.0))));
  expect(message_of<core::DataError>([&] {
           (void)read_mat_frf(square, {"f", "frf"}, metres, three, p_x);
         }),
         "cannot be told apart");
  EXPECT_THROW((void)read_mat_frf(square, {"f", "frf"}, metres, {}, p_x), core::InputError);
}

TEST_F(MatResponse, IsNotWrittenWithHoles) {
  MeasuredResponse measured = random_response(true);
  measured.coherence.pop_back();
  EXPECT_THROW(write_mat_response(path("frf.mat"), measured), core::InputError);
  measured = random_response(false);
  measured.response.H[3](0, 0) = std::nan("");
  EXPECT_THROW(write_mat_response(path("frf.mat"), measured), core::InputError);
  measured.response.H.pop_back();
  EXPECT_THROW(write_mat_response(path("frf.mat"), measured), core::InputError);
  EXPECT_TRUE(is_empty());
}

TEST_F(MatResponse, AnEntryOfAnotherProgramsArrayIsReadByItsIndices) {
  write_foreign(path("rig.mat"), 0.5);
  const FrfFormat format = frf_format(FrfQuantity::receptance, "um/N", "Hz");
  const auto frf = [&](const std::string& name) {
    return read_mat_entry(path("rig.mat"), {"f", name}, format).entries.at(0).frf;
  };
  EXPECT_EQ(frf("H21").axis.hz, Eigen::Vector4d(0.5, 1.0, 2.0, 3.0));
  EXPECT_LT(std::abs(frf("H21").H(2) - Complex(2.5e-6, 0.25e-6)), 1e-20);
  for (const char* name : {"FRF(2,3,:)", "FRF( 2, 3, : )"}) {
    const Eigen::VectorXcd H = frf(name).H;
    for (int line = 0; line < 4; ++line)
      EXPECT_LT(std::abs(H(line) - Complex(1e-6 * (230.0 + line), -1e-6)), 1e-18) << name;
  }
  const auto refused = [&](const std::string& name) {
    return message_of<core::DataError>([&] { (void)read_mat_entry(path("rig.mat"), {"f", name}, format); });
  };
  EXPECT_NE(refused("FRF").find("2 x 3 x 4 for 4 frequencies; of an array write the entry"), std::string::npos);
  EXPECT_NE(refused("FRF(3,1,:)").find("index 3 lies beyond"), std::string::npos);
  EXPECT_NE(refused("FRF(1,:,1)").find("3 lines for 4 frequencies"), std::string::npos);
  EXPECT_NE(refused("FRF(1,:)").find("has 3 indices, not 2"), std::string::npos);
  EXPECT_NE(refused("H22").find("has no variable H22"), std::string::npos);
  for (const char* name : {"", "(1,:)", "FRF(1,1,1)", "FRF(:,1,:)", "FRF(0,1,:)", "FRF(1,1,:", "FRF(1,x,:)", "FRF()"})
    EXPECT_THROW((void)read_mat_entry(path("rig.mat"), {"f", name}, format), core::InputError) << name;
  EXPECT_NE(
      message_of<core::DataError>([&] { (void)read_mat_response(path("rig.mat")); }).find("it holds f, FRF, H21: name"),
      std::string::npos);
}

TEST_F(MatResponse, AnEntryAtZeroHertzOfAnAccelerometerIsLeftOut) {
  write_foreign(path("rig.mat"), 0.0);
  const FrfFormat format = frf_format(FrfQuantity::accelerance, "m/s^2/N", "Hz");
  const MeasuredEntries read = read_mat_entry(path("rig.mat"), {"f", "H21"}, format);
  EXPECT_EQ(read.notes.size(), 1U);
  ASSERT_EQ(read.entries[0].frf.H.size(), 3);
  const double omega = 2.0 * std::numbers::pi * 1.0;
  EXPECT_LT(std::abs(read.entries[0].frf.H(0) + Complex(1.5, 0.25) / (omega * omega)), 1e-15);
}

}  // namespace thinwall::io::test::mat_response_test
