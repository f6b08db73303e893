// MAT files that others write: whole numbers as SciPy and MATLAB store them, versions 4 and 7.3.
// The bytes are made by hand after the format's description.

#include <gtest/gtest.h>

#include <complex>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "io/matrices/mat4.hpp"
#include "io/matrices/mat_sparse.hpp"
#include "io/matrices/mat_variables.hpp"
#include "io/matrices/mat_version.hpp"
#include "io/matrices/matrix_files.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::mat_versions_test {

namespace {

using MatVersions = ScratchFolder;

template <class Number>
std::string raw(const std::vector<Number>& numbers, bool turned = false) {
  std::string bytes;
  for (const Number number : numbers) {
    std::string one(sizeof number, '\0');
    std::memcpy(one.data(), &number, sizeof number);
    bytes += turned ? std::string(one.rbegin(), one.rend()) : one;
  }
  return bytes;
}

std::string element(std::uint32_t type, const std::string& data) {
  const std::string padding((8 - data.size() % 8) % 8, '\0');
  return raw<std::uint32_t>({type, static_cast<std::uint32_t>(data.size())}) + data + padding;
}

/// A column of version 5: the class of the array (14: int64, 6: double) and the type of its data (12: int64, 9:
/// double).
template <class Number>
std::string column5(const std::string& name, std::uint32_t kind, std::uint32_t type,
                    const std::vector<Number>& values) {
  const std::vector<std::int32_t> size{static_cast<std::int32_t>(values.size()), 1};
  return element(14, element(6, raw<std::uint32_t>({kind, 0})) + element(5, raw(size)) + element(1, name) +
                         element(type, raw(values)));
}

std::string square5(const std::string& name, const std::vector<double>& values) {
  return element(14, element(6, raw<std::uint32_t>({6, 0})) + element(5, raw<std::int32_t>({2, 2})) + element(1, name) +
                         element(9, raw(values)));
}

std::string file5(const std::string& elements) {
  std::string header = "MATLAB 5.0 MAT-file, by hand";
  header.resize(124, ' ');
  return header + std::string("\x00\x01IM", 4) + elements;
}

/// A variable of version 4; `type` is 1000 M + 10 P + T.
template <class Number>
std::string array4(const std::string& name, std::int32_t type, std::int32_t rows, std::int32_t columns,
                   const std::vector<Number>& values, std::int32_t is_complex = 0) {
  const bool turned = type >= 1000;
  const auto length = static_cast<std::int32_t>(name.size() + 1);
  return raw<std::int32_t>({type, rows, columns, is_complex, length}, turned) + name + '\0' + raw(values, turned);
}

const std::vector<double> K{4e6, -1e5, -1e5, 3e6}, M{2.0, 0.25, 0.25, 1.0};

MatrixFiles in_metres(const std::filesystem::path& path) {
  MatrixFiles files{path};
  files.length_unit = "m";
  files.mass_unit = "kg";
  return files;
}

void expect_two_dofs(const dynamics::SparseModel& model) {
  EXPECT_EQ(Eigen::MatrixXd(model.K), (Eigen::Matrix2d() << 4e6, -1e5, -1e5, 3e6).finished());
  EXPECT_EQ(Eigen::MatrixXd(model.M), (Eigen::Matrix2d() << 2.0, 0.25, 0.25, 1.0).finished());
  EXPECT_EQ(model.dofs, (std::vector<dynamics::NodeDof>{{17, 1}, {2147483646, 3}}));
}

}  // namespace

/// SciPy stores arrays of Python's integers as int64, MATLAB's int32(…) as int32.
TEST_F(MatVersions, WholeNumbersOfEveryWidthTellTheDofs) {
  const std::string matrices = square5("K", K) + square5("M", M);
  const std::string wide = column5<std::int64_t>("dof_node", 14, 12, {17, 2147483646});
  const std::string narrow = column5<std::uint8_t>("dof_component", 9, 2, {1, 3});
  expect_two_dofs(read_matrices(in_metres(write("scipy.mat", file5(matrices + wide + narrow)))).model);
  const std::string node32 = column5<std::int32_t>("dof_node", 12, 5, {17, 2147483646});
  const std::string component64 = column5<std::uint64_t>("dof_component", 15, 13, {1, 3});
  expect_two_dofs(read_matrices(in_metres(write("matlab.mat", file5(matrices + node32 + component64)))).model);
  const std::string beyond = column5<std::int64_t>("dof_node", 14, 12, {17, 2147483648});
  const auto file = write("beyond.mat", file5(matrices + beyond + narrow));
  EXPECT_NE(message_of<core::DataError>([&] { (void)read_matrices(in_metres(file)); }).find("no number of a node"),
            std::string::npos);
}

TEST_F(MatVersions, FourIsReadInBothByteOrdersFullAndSparse) {
  for (const std::int32_t order : {0, 1000}) {
    const std::string dofs = array4<std::int32_t>("dof_node", order + 20, 2, 1, {17, 2147483646}) +
                             array4<std::uint8_t>("dof_component", order + 50, 2, 1, {1, 3});
    const std::string full = array4("K", order, 2, 2, K) + array4("M", order, 2, 2, M) + dofs;
    expect_two_dofs(read_matrices(in_metres(write("full.mat", full))).model);
    // Rows of row, column, value; the last one has the size. An entry that is there twice counts twice.
    const std::vector<double> rows{1, 2, 1, 2, 2, 2, 1, 1, 2, 2, 2, 2, 4e6, -1e5, -1e5, 1e6, 2e6, 0.0};
    const std::string sparse = array4("K", order + 2, 6, 3, rows) + array4("M", order, 2, 2, M) + dofs;
    expect_two_dofs(read_matrices(in_metres(write("sparse.dat", sparse))).model);
  }
}

TEST_F(MatVersions, FourHasSixKindsOfNumbersAndComplexOnes) {
  const std::string bytes = array4<float>("a", 10, 1, 2, {0.5F, -2.0F}) + array4<std::int16_t>("b", 30, 1, 1, {-3}) +
                            array4<std::uint16_t>("c", 1040, 1, 1, {65535}) +
                            array4<double>("d", 0, 2, 1, {1.0, 2.0, 3.0, 4.0}, 1) +
                            array4<double>("text", 1, 1, 2, {65.0, 66.0});
  const MatVariables read = mat4_variables(bytes, {"a", "b", "c", "d"}, "four.mat");
  EXPECT_EQ(read.at("a").re, (std::vector{0.5, -2.0}));
  EXPECT_EQ(read.at("a").size, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(read.at("b").re, std::vector{-3.0});
  EXPECT_EQ(read.at("c").re, std::vector{65535.0});
  EXPECT_EQ(read.at("d").re, (std::vector{1.0, 2.0}));
  EXPECT_EQ(read.at("d").im, (std::vector{3.0, 4.0}));
  EXPECT_NE(message_of<core::DataError>([&] { (void)mat4_variables(bytes, {"text"}, "four.mat"); }).find("is a text"),
            std::string::npos);
}

TEST_F(MatVersions, FourIsRefusedWhereItIsDamaged) {
  const std::string whole = array4("K", 0, 2, 2, K);
  for (std::size_t length = whole.size() - 1; length > 22; --length)
    EXPECT_NE(message_of<core::DataError>([&] {
                (void)mat4_variables(whole.substr(0, length), {"K"}, "k.mat");
              }).find("no whole MAT file of version 4"),
              std::string::npos)
        << length;
  const auto refused = [](const std::string& bytes) {
    return message_of<core::DataError>([&] { (void)mat4_variables(bytes, {"K"}, "k.mat"); });
  };
  EXPECT_NE(refused(array4<double>("K", 0, 1, 1, {std::nan("")})).find("NaN"), std::string::npos);
  EXPECT_NE(refused(array4<double>("K", 2, 2, 3, {3, 2, 1, 2, 5.0, 0.0})).find("no row"), std::string::npos);
  EXPECT_NE(refused(array4<double>("K", 2, 2, 3, {1, 2e9, 1, 2e9, 5.0, 0.0})).find("too many"), std::string::npos)
      << "gigabytes for a few bytes";
  EXPECT_NE(refused(array4<double>("K", 2, 1, 4, {1, 1, 0, 0})).find("no real sparse"), std::string::npos);
  EXPECT_NE(refused(whole + "K = 3;").find("no whole"), std::string::npos);
}

/// data/frf_73.mat holds two modes, 40 Hz and 120 Hz, of 1 µm/N at H(1,1,:) and half of it, the second one turned, at
/// H(2,1,:).
TEST(MatFilesOfHdf5, AreReadAsThoseOfVersionFive) {
  const std::filesystem::path file = std::filesystem::path(THINWALL_SOURCE_DIR) / "tests/io/data/frf_73.mat";
  ASSERT_EQ(mat_version_of_file(file), MatVersion::hdf5);
  EXPECT_EQ(mat_variable_names(file), (std::vector<std::string>{"H", "f"}));
  const MatVariables variables = read_mat_variables(file, {"H", "f", "none"});
  EXPECT_EQ(variables.size(), 2U);
  const MatVariable& H = variables.at("H");
  ASSERT_EQ(H.size, (std::vector<std::size_t>{2, 1, 96}));
  ASSERT_EQ(variables.at("f").re.size(), 96U);
  for (std::size_t line = 0; line < 96; ++line) {
    const double f = variables.at("f").re[line];
    EXPECT_NEAR(f, 10.0 + 2.0 * static_cast<double>(line), 1e-12);
    const auto mode = [f](double f0, double zeta) {
      return 1e-6 / std::complex<double>(1.0 - f * f / (f0 * f0), 2.0 * zeta * f / f0);
    };
    const std::complex<double> expected[] = {mode(40.0, 0.02) + mode(120.0, 0.03),
                                             0.5 * (mode(40.0, 0.02) - mode(120.0, 0.03))};
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_LT(std::abs(std::complex<double>(H.re[2 * line + i], H.im[2 * line + i]) - expected[i]), 1e-18);
  }
}

TEST_F(MatVersions, SevenPointThreeThatIsDamagedIsNamedWithTheRemedy) {
  std::string titled = "MATLAB 7.3 MAT-file, Platform: GLNXA64";
  titled.resize(512, '\0');
  const std::string signature = "\x89HDF\r\n\x1a\n";
  for (const std::string& bytes : {titled + signature + std::string(100, '\0'), signature + std::string(600, '\0')}) {
    const auto file = write("new.mat", bytes);
    const std::string message = message_of<core::DataError>([&] { (void)read_matrices(in_metres(file)); });
    EXPECT_NE(message.find("new.mat: cannot be read as a MAT file"), std::string::npos) << message;
    EXPECT_NE(message.find("'-v7'"), std::string::npos) << message;
  }
}

TEST_F(MatVersions, AreKnownByTheFirstBytes) {
  EXPECT_EQ(mat_version(file5("")), MatVersion::five);
  EXPECT_EQ(mat_version(array4("K", 1000, 2, 2, K)), MatVersion::four);
  EXPECT_EQ(mat_version("frequency_hz,real,imaginary\n1,2,3\n"), MatVersion::none);
  EXPECT_EQ(mat_version(std::string(64, '\0')), MatVersion::none);
  EXPECT_EQ(mat_version(""), MatVersion::none);
  EXPECT_EQ(mat_version_of_file(path("absent.mat")), MatVersion::none);
  EXPECT_EQ(mat_version_of_file(path(".")), MatVersion::none);
}

}  // namespace thinwall::io::test::mat_versions_test
