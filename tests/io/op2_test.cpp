// Matrices of Nastran's OUTPUT2; the files are made by hand after the format's description.

#include "io/matrices/op2.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"
#include "fortran_writer.hpp"
#include "io/matrices/matrix_files.hpp"
#include "io/matrices/matrix_format.hpp"
#include "io/matrices/op4.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::op2_test {

namespace {

using Op2 = ScratchFolder;

const Eigen::Matrix3d K = (Eigen::Matrix3d() << 4e6, -1e5, 0.0, -1e5, 3e6, 0.0, 0.0, 0.0, 1e6).finished();
/// The mass matrix: its first column has two strings, its second none.
const Eigen::Matrix3d M = (Eigen::Matrix3d() << 2.0, 0.0, 0.25, 0.0, 0.0, 0.0, 0.25, 0.0, 1.0).finished();

/// Data blocks of OUTPUT2.
struct Writer : FortranWriter {
  [[nodiscard]] std::string key(std::int64_t value) const { return record(whole({value})); }
  [[nodiscard]] std::string keys(const std::vector<std::int64_t>& values) const {
    std::string bytes;
    for (const std::int64_t value : values) bytes += key(value);
    return bytes;
  }
  /// Two words of four characters, with blanks behind each in words of 8 bytes.
  [[nodiscard]] std::string name(std::string text) const {
    text.resize(8, ' ');
    if (!wide) return record(text);
    return record(text.substr(0, 4) + "    " + text.substr(4) + "    ");
  }
  [[nodiscard]] std::string label() const {
    return key(3) + record(whole({11, 26, 26})) + key(7) + record(std::string(wide ? 56 : 28, 'N')) + key(2) +
           name("XXXXXXXX") + keys({-1, 0});
  }
  [[nodiscard]] std::string block_head(const std::string& block, const std::vector<std::int64_t>& trailer) const {
    return key(2) + name(block) + keys({-1, 7}) + record(whole(trailer)) + keys({-2, 1, 0, 2}) + name(block);
  }
  [[nodiscard]] std::string string(std::int64_t row, const std::vector<double>& values) const {
    return key(words() * static_cast<std::int64_t>(values.size())) + record(whole({row}) + real(values));
  }
  /// Every number that is not zero is a string of its own.
  [[nodiscard]] std::string matrix(const std::string& block, const Eigen::Matrix3d& A, std::int64_t form = 6) const {
    std::string bytes = block_head(block, {101, 3, 3, form, single ? 1 : 2, 6, 5000});
    for (Eigen::Index j = 0; j < 3; ++j) {
      bytes += keys({-3 - j, 1, 1});
      for (Eigen::Index i = 0; i < 3; ++i)
        if (A(i, j) != 0.0) bytes += string(i + 1, {A(i, j)});
    }
    return bytes + keys({-6, 1, 0, 0});
  }
  /// A table of two groups, the first of two records.
  [[nodiscard]] std::string table(const std::string& block) const {
    return block_head(block, {102, 0, 0, 0, 0, 0, 0}) + keys({-3, 1, 0, 2}) + record(whole({7, 8})) + key(1) +
           record(whole({9})) + keys({-4, 1, 0, 3}) + record(whole({1, 2, 3})) + keys({-5, 1, 0, 0});
  }
};

std::string message(const std::string& bytes) {
  return message_of<core::DataError>([&] { (void)nastran_matrix(read_op2(bytes, "a.op2"), "", 'K', "a.op2"); });
}

}  // namespace

TEST_F(Op2, GivesTheMatricesOfEveryOrderOfBytesAndWidthOfWords) {
  const auto dofs = write("dofs.csv", "row,node,component\n1,5,x\n2,5,y\n3,1001,mode\n");
  for (const bool turned : {false, true}) {
    for (const bool wide : {false, true}) {
      const Writer writer{{turned, wide, false}}, single{{turned, wide, true}};
      for (const std::string& bytes :
           {writer.label() + writer.table("GEOM1") + writer.matrix("KAA", K) + single.matrix("MAA", M) + writer.key(0),
            writer.matrix("KAA", K, 1) + writer.table("EQEXIN") + writer.matrix("MAA", M)}) {
        const auto file = write("part.op2", bytes);
        EXPECT_TRUE(is_op2(bytes));
        EXPECT_FALSE(is_op4(bytes));
        EXPECT_TRUE(may_hold_several_matrices(file));
        MatrixFiles files{file};
        files.dofs = dofs;
        files.length_unit = "m";
        files.mass_unit = "kg";
        const ImportedMatrices read = read_matrices(files);
        EXPECT_EQ(read.format, "Nastran OP2");
        EXPECT_EQ(Eigen::MatrixXd(read.model.K), K);  // all numbers are exact in single precision
        EXPECT_EQ(Eigen::MatrixXd(read.model.M), M);
      }
    }
  }
}

TEST_F(Op2, OfTablesAloneIsRefusedByTheirNames) {
  const Writer writer;
  const std::string says = message(writer.label() + writer.table("GEOM1") + writer.table("KAAX") + writer.key(0));
  EXPECT_NE(says.find("only the tables GEOM1, KAAX"), std::string::npos) << says;
}

/// The bytes end with the group that closes the data block, whose last key may be missing at no place before.
TEST_F(Op2, CutShortIsRefused) {
  const std::string bytes = Writer{}.label() + Writer{}.matrix("KAA", K);
  for (std::size_t length = 1; length < bytes.size(); ++length)
    EXPECT_FALSE(message(bytes.substr(0, length)).empty()) << length;
  EXPECT_EQ(nastran_matrix(read_op2(bytes, "a.op2"), "", 'K', "a.op2").size, 3);
}

TEST_F(Op2, TellsTheByteOfAFault) {
  const Writer writer;
  const std::string head = writer.block_head("KAA", {101, 3, 3, 6, 2, 6, 5000}), first = writer.keys({-3, 1, 1}),
                    end = writer.keys({-4, 1, 0, 0});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [bytes, says] : {
           std::pair{head + first + writer.string(2, {1.0}) + writer.string(1, {1.0}) + end, "row 1 of column 1"},
           {head + first + writer.string(3, {1.0, 2.0}) + end, "outside of the matrix"},
           {head + first + writer.string(0, {1.0}) + end, "row 0 of column 1"},
           {head + first + writer.string(1, {nan}) + end, "not finite"},
           {head + first + writer.key(2) + writer.record(writer.whole({1, 2})) + end, "no whole number of entries"},
           {head + first + writer.keys({-4, 1, 1, -5, 1, 1, -6, 1, 1, -7, 1, 0, 0}), "more columns follow"},
           {writer.key(2) + writer.name("KAA") + writer.keys({-2}), "the key -1 is missing"},
           {writer.block_head("KAA", {101, 3, 3, 6, 9, 6, 5000}) + first + end, "trailer of a table"},
       }) {
    const std::string said = message(bytes);
    EXPECT_NE(said.find(says), std::string::npos) << said << "\n" << says;
    EXPECT_EQ(said.rfind("a.op2: byte ", 0), 0U) << said;
  }
}

}  // namespace thinwall::io::test::op2_test
