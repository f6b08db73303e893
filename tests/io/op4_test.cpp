// Matrices of Nastran's OUTPUT4, as text and as bytes; the files are made by hand after the format's description.

#include "io/matrices/op4.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "core/error.hpp"
#include "fortran_writer.hpp"
#include "io/matrices/matrix_files.hpp"
#include "io/matrices/matrix_format.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::op4_test {

namespace {

using Op4 = ScratchFolder;

/// K = [4e6 −1e5 0; −1e5 3e6 0; 0 0 1e6]: its columns are one string, one string, and one number in row 3.
const Eigen::Matrix3d K = (Eigen::Matrix3d() << 4e6, -1e5, 0.0, -1e5, 3e6, 0.0, 0.0, 0.0, 1e6).finished();
/// M = diag(2, 0, 1) with 0.25 between rows 1 and 3: its first column has two strings, its second none.
const Eigen::Matrix3d M = (Eigen::Matrix3d() << 2.0, 0.0, 0.25, 0.0, 0.0, 0.0, 0.25, 0.0, 1.0).finished();

// The head of a string is (words + 1) 65536 + row, and a number of double precision has two words: 5 · 65536 + 1 =
// 327681 for two numbers from row 1, 3 · 65536 + 3 = 196611 for one in row 3.
constexpr const char* sparse_text =
    "       3       3       6       2KAA     1P,3E23.16\n"
    "       1       0       5\n      327681\n 4.0000000000000000E+06-1.0000000000000000E+05\n"
    "       2       0       5\n      327681\n-1.0000000000000000E+05 3.0000000000000000E+06\n"
    "       3       0       3\n      196611\n 1.0000000000000000E+06\n"
    "       4       1       1\n 1.0000000000000000E+00\n"
    "       3       3       6       2MAA     1P,3E23.16\n"
    "       1       0       6\n      196609\n 2.0000000000000000E+00\n      196611\n 2.5000000000000000E-01\n"
    "       3       0       6\n      196609\n 2.5000000000000000E-01\n      196611\n 1.0000000000000000E+00\n"
    "       4       1       1\n 1.0000000000000000E+00\n";

/// Dense: the first row and the count of numbers; 2E16.9 puts three of them on two lines. A negative count of rows
/// makes the strings of the second matrix those of a large one: words + 1, and the row.
constexpr const char* dense_and_large_text =
    "       3       3       6       2KAA     1P,2E16.9\n"
    "       1       1       2\n 4.000000000E+06-1.000000000E+05\n"
    "       2       1       3\n-1.000000000D+05 3.000000000D+06\n 0.000000000E+00\n"
    "       3       3       1\n 1.000000000E+06\n"
    "       4       1       1\n 1.000000000E+00\n"
    "       3      -3       1       2MAA     1P,2E16.9\n"
    "       1       0       8\n       3       1\n 2.000000000E+00\n       3       3\n 2.500000000E-01\n"
    "       3       0       8\n       3       1\n 2.500000000E-01\n       3       3\n 1.000000000E+00\n"
    "       4       1       1\n 1.000000000E+00";

/// Matrices as bytes of OUTPUT4.
struct Writer : FortranWriter {
  [[nodiscard]] std::string head(std::int64_t rows, std::int64_t form, std::string name) const {
    name.resize(wide ? 16 : 8, ' ');
    return record(whole({3, rows, form, single ? 1 : 2}) + name);
  }
  [[nodiscard]] std::string end() const { return record(whole({4, 1, words()}) + real({1.0})); }

  [[nodiscard]] std::string dense(const std::string& name, const Eigen::Matrix3d& A) const {
    std::string bytes = head(3, 6, name);
    for (Eigen::Index j = 0; j < 3; ++j)
      bytes += record(whole({j + 1, 1, 3 * words()}) + real({A(0, j), A(1, j), A(2, j)}));
    return bytes + end();
  }
  /// Every number that is not zero is a string of its own.
  [[nodiscard]] std::string sparse(const std::string& name, const Eigen::Matrix3d& A, bool large) const {
    std::string bytes = head(large ? -3 : 3, 6, name);
    for (Eigen::Index j = 0; j < 3; ++j) {
      std::string strings;
      std::int64_t count = 0;
      for (Eigen::Index i = 0; i < 3; ++i) {
        if (A(i, j) == 0.0) continue;
        strings += large ? whole({words() + 1, i + 1}) : whole({(words() + 1) * 65536 + i + 1});
        strings += real({A(i, j)});
        count += words() + (large ? 2 : 1);
      }
      if (count > 0) bytes += record(whole({j + 1, 0, count}) + strings);
    }
    return bytes + end();
  }
};

MatrixFiles in_metres(const std::filesystem::path& path, const std::filesystem::path& dofs) {
  MatrixFiles files{path};
  files.dofs = dofs;
  files.length_unit = "m";
  files.mass_unit = "kg";
  return files;
}

std::string message(const std::string& bytes) {
  return message_of<core::DataError>([&] { (void)nastran_matrix(read_op4(bytes, "a.op4"), "", 'K', "a.op4"); });
}

}  // namespace

TEST_F(Op4, GivesTheMatricesOfTextAndOfBytesInEveryForm) {
  std::vector<std::string> files{sparse_text, dense_and_large_text};
  for (const bool turned : {false, true}) {
    for (const bool wide : {false, true}) {
      const Writer writer{{turned, wide, false}}, single{{turned, wide, true}};
      files.push_back(writer.dense("KAA", K) + single.sparse("MAA", M, false));
      files.push_back(single.dense("KAA", K) + writer.sparse("MAA", M, true));
      files.push_back(writer.sparse("KAA", K, false) + writer.dense("MAA", M));
    }
  }
  const auto dofs = write("dofs.csv", "row,node,component\n1,5,x\n2,5,y\n3,1001,mode\n");
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto file = write("part.op4", files[i]);
    EXPECT_TRUE(is_op4(files[i])) << i;
    EXPECT_TRUE(may_hold_several_matrices(file)) << i;
    const ImportedMatrices read = read_matrices(in_metres(file, dofs));
    EXPECT_EQ(read.format, "Nastran OP4");
    EXPECT_EQ(Eigen::MatrixXd(read.model.K), K) << i;  // all numbers are exact in single precision
    EXPECT_EQ(Eigen::MatrixXd(read.model.M), M) << i;
    EXPECT_EQ(read.model.dofs, (std::vector<dynamics::NodeDof>{{5, 1}, {5, 2}, {1001, 0}}));
  }
}

TEST_F(Op4, NumbersItsRowsOnlySoThatATableMustNameThem) {
  const auto file = write("part.op4", sparse_text);
  EXPECT_NE(message_of<core::DataError>([&] { (void)read_matrices(in_metres(file, "")); }).find("state the DOF table"),
            std::string::npos);
}

TEST_F(Op4, HoldsMatricesOfOtherKindsWhichAreKnownByName) {
  // A complex matrix (two numbers an entry, of two words each), a rectangular one, and one without a column.
  const std::string others =
      "       1       1       6       4KC      1P,3E23.16\n       1       0       5\n      327681\n"
      " 1.0000000000000000E+00 2.0000000000000000E+00\n       2       1       1\n 1.0000000000000000E+00\n"
      "       1       2       2       2PHG_LONG_NAME  1P,3E23.16\n       1       1       2\n"
      " 1.0000000000000000E+00 2.0000000000000000E+00\n       2       1       1\n 1.0000000000000000E+00\n"
      "       2       2       6       2KNULL   1P,3E23.16\n       3       1       1\n 1.0000000000000000E+00\n";
  const std::vector<NastranMatrix> matrices = read_op4(others + sparse_text, "a.op4");
  ASSERT_EQ(matrices.size(), 5U);
  EXPECT_EQ(matrices[1].name, "PHG_LONG_NAME");
  EXPECT_EQ(matrices[2].rows, 2);
  EXPECT_TRUE(matrices[2].entries.empty());
  EXPECT_EQ(nastran_matrix(matrices, "kaa", 'K', "a.op4").size, 3);
  for (const auto& [name, says] : {std::pair{"KC", "type 4"}, {"PHG_LONG_NAME", "2 rows, 1 columns"}, {"X", "KC, PHG"}})
    EXPECT_NE(message_of<core::DataError>([&, wanted = std::string(name)] {
                (void)nastran_matrix(matrices, wanted, 'K', "a.op4");
              }).find(says),
              std::string::npos)
        << name;
  EXPECT_NE(message(others + sparse_text).find("more than one matrix whose name begins with K"), std::string::npos);
}

/// A symmetric matrix of which a program has written one triangle is completed; in one of another form it is all.
TEST_F(Op4, OfOneTriangleIsCompletedIfItsFormIsSymmetric) {
  const Eigen::Matrix3d lower = K.triangularView<Eigen::Lower>();
  const MatrixEntries half = nastran_matrix(read_op4(Writer{}.dense("KAA", lower), "a.op4"), "", 'K', "a.op4");
  EXPECT_TRUE(whole_matrix(half).was_half);
  EXPECT_EQ(Eigen::MatrixXd(whole_matrix(half).A), K);
}

TEST_F(Op4, CutShortIsRefused) {
  const std::string bytes = Writer{}.sparse("KAA", K, false);
  for (std::size_t length = 1; length < bytes.size(); ++length)
    EXPECT_FALSE(message(bytes.substr(0, length)).empty()) << length;
  const std::string text = sparse_text;
  const std::size_t last = text.find("       4       1       1\n");
  for (std::size_t length = 1; length < last; ++length) EXPECT_FALSE(message(text.substr(0, length)).empty()) << length;
}

TEST_F(Op4, TellsTheLineOrTheByteOfAFault) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  for (const auto& [text, says] : {
           std::pair{with(sparse_text, "-1.0000000000000000E+05", "-1.000000zero0000E+05 "), "a.op4:4:"},
           {with(sparse_text, " 4.0000000000000000E+06", "                    NaN"), "a finite real number"},
           {with(sparse_text, "       2       0       5", "       1       0       5"), "a.op4:5: column 1 follows"},
           {with(sparse_text, "      327681", "      327683"), "a.op4:4: row 3 of column 1"},
           {with(sparse_text, "      327681", "      327680"), "row 0 of column 1"},
           {with(sparse_text, "      327681", "      393217"), "another length than its column"},
           {with(sparse_text, "       1       0       5", "       1       0    five"), "a.op4:2: \"five\""},
           {std::string("       1       1       6      1\n"), "a.op4:1: no head of a matrix"},
           {with(sparse_text, "3E23.16", "3I23.16"), "a.op4:4:"},
           {with(sparse_text, "3E23.16", "3E99.16"), "is not read"},
           {with(sparse_text, "      327681", "3276810000000000000"), "no whole number that belongs"},
           {with(dense_and_large_text, "       1       1       2", "       1       199999999"), "more numbers are"},
       })
    EXPECT_NE(message(text).find(says), std::string::npos) << message(text) << "\n" << says;
  std::string bytes = Writer{}.dense("KAA", K);
  bytes[32 + 4 + 12 + 24] = '\1';  // behind the head, its length, three whole numbers and three numbers
  EXPECT_NE(message(bytes).find("different lengths"), std::string::npos) << message(bytes);
  Eigen::Matrix3d broken = K;
  broken(1, 1) = std::nan("");
  EXPECT_NE(message(Writer{}.dense("KAA", broken)).find("not finite"), std::string::npos);
}

/// None of the other formats of matrices begins as this one does.
TEST_F(Op4, IsNotWhatOtherFormatsAre) {
  for (const char* other :
       {"%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1.0\n", "1 1 2.0\n", "1,1,1,1,2.0\n",
        "       1       1       1       1 2.0\n", "DMIG    KAAX    0       6       2       0\n", "", "MATLAB 5.0"})
    EXPECT_FALSE(is_op4(other)) << other;
}

}  // namespace thinwall::io::test::op4_test
