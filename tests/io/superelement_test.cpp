// Superelements in NetCDF. The files of the corpus were written by other programs: SciPy's netcdf_file (CDF-1, CDF-2)
// and the NetCDF library of Unidata (CDF-5, with single precision and whole numbers of 8 bytes).

#include "io/matrices/superelement.hpp"

#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/matrices/matrix_files.hpp"
#include "io/matrices/matrix_format.hpp"
#include "io/matrices/netcdf.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::superelement_test {

namespace {

using Superelement = ScratchFolder;
using dynamics::NodeDof;

std::filesystem::path corpus(const std::string& name) {
  return std::filesystem::path(THINWALL_SOURCE_DIR) / "fuzz/corpus/superelement" / name;
}

/// The bytes of a file in which the only occurrence of a text is replaced by another of its length.
std::string replaced(const std::string& name, const std::string& text, const std::string& by) {
  std::string bytes = core::read_file(corpus(name));
  const std::size_t at = bytes.find(text);
  EXPECT_NE(at, std::string::npos);
  EXPECT_EQ(text.size(), by.size());
  return bytes.replace(at, text.size(), by);
}

std::string message(const std::string& bytes) {
  return message_of<core::DataError>([&] { (void)read_superelement(bytes, "a.nc"); });
}

}  // namespace

TEST_F(Superelement, OfEachClassicFormatHasTheMatricesThatWereWritten) {
  const Eigen::Matrix4d K =
      (Eigen::Matrix4d() << 4e6, -1e5, 0, 2e4, -1e5, 3e6, 5e3, 0, 0, 5e3, 1e6, 0, 2e4, 0, 0, 9e6).finished();
  const Eigen::Matrix4d M =
      (Eigen::Matrix4d() << 2, 0, 0.25, 0.1, 0, 1.5, 0, 0, 0.25, 0, 1, 0, 0.1, 0, 0, 1).finished();
  for (const char* name : {"scipy_cdf1", "scipy_cdf2"}) {
    const dynamics::SparseModel model = read_superelement(core::read_file(corpus(name)), name);
    EXPECT_EQ(Eigen::MatrixXd(model.K), K);
    EXPECT_EQ(Eigen::MatrixXd(model.M), M);
    EXPECT_EQ(Eigen::MatrixXd(model.C), 1e-5 * K);
    EXPECT_EQ(model.K.nonZeros(), 10);
    // Nodes 2 and 3 are no numbers of the map 11, 17, 40, so that they are places in it.
    EXPECT_EQ(model.dofs, (std::vector<NodeDof>{{17, 1}, {40, 6}, {41, 0}, {42, 0}}));
    EXPECT_EQ(model.positions.at(40), Eigen::Vector3d(0.2, 0.05, 0.01));
  }
  const dynamics::SparseModel single = read_superelement(core::read_file(corpus("library_cdf5")), "a.nc");
  EXPECT_EQ(Eigen::MatrixXd(single.K).diagonal(), Eigen::Vector3d(4e6, 3e6, 1e6));
  EXPECT_EQ(single.dofs, (std::vector<NodeDof>{{5, 1}, {5, 2}, {6, 0}}));
  EXPECT_FALSE(single.has_damping());
  EXPECT_TRUE(single.positions.empty());
}

TEST_F(Superelement, IsAComponentInItsUnits) {
  const ImportedMatrices imported =
      read_matrices({.stiffness = corpus("scipy_cdf2"), .length_unit = "mm", .mass_unit = "t"});
  EXPECT_EQ(imported.format, "NetCDF superelement");
  EXPECT_DOUBLE_EQ(imported.model.K.coeff(0, 0), 4e9);   // N/mm in N/m
  EXPECT_DOUBLE_EQ(imported.model.K.coeff(0, 1), -1e5);  // N in N
  EXPECT_DOUBLE_EQ(imported.model.positions.at(17).x(), 1e-4);
  EXPECT_TRUE(may_hold_several_matrices(corpus("scipy_cdf1")));
}

TEST_F(Superelement, SaysWhatItIsNot) {
  EXPECT_NE(message(replaced("scipy_cdf1", "Mr", "Xr")).find("has no variable Mr"), std::string::npos);
  EXPECT_NE(message(core::read_file(corpus("scipy_cdf1")).substr(0, 300)).find("the file ends"), std::string::npos);
  const std::string whole = core::read_file(corpus("library_cdf5"));
  EXPECT_NE(message(whole.substr(0, whole.size() - 60)).find("beyond the end"), std::string::npos);
  // The rows (2, 1) and (3, 6) of cbmap; the second gets a component, then a node, that is none.
  const std::string rows{"\0\0\0\2\0\0\0\1\0\0\0\3\0\0\0\6", 16};
  std::string component = rows, node = rows;
  component.back() = 7;
  node[11] = 99;
  EXPECT_NE(message(replaced("scipy_cdf1", rows, component)).find("component 7 of node 40"), std::string::npos);
  EXPECT_NE(message(replaced("scipy_cdf1", rows, node)).find("names node 99"), std::string::npos);
  EXPECT_NE(message(core::read_file(corpus("transposed_map"))).find("cbmap is 2 x 4, not 4 x 2"), std::string::npos);
  EXPECT_NE(message(core::read_file(corpus("scalar_at_the_end"))).find("beyond the end"), std::string::npos);
  const auto hdf5 = write("a.nc", "\x89HDF\r\n\x1a\n and _NCProperties");
  const std::string advice = message_of<core::DataError>(
      [&] { (void)read_matrices({.stiffness = hdf5, .length_unit = "m", .mass_unit = "kg"}); });
  EXPECT_NE(advice.find("nccopy -k 64-bit-offset"), std::string::npos) << advice;
  const std::string twice = message_of<core::DataError>([&] {
    (void)read_matrices(
        {.stiffness = corpus("scipy_cdf1"), .mass = corpus("scipy_cdf1"), .length_unit = "m", .mass_unit = "kg"});
  });
  EXPECT_NE(twice.find("as the stiffness alone"), std::string::npos) << twice;
}

}  // namespace thinwall::io::test::superelement_test
