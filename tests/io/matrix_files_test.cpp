// Component matrices by way of every format: what comes back, and what is refused with its place.

#include "io/matrices/matrix_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "dynamics/conversion.hpp"
#include "dynamics/sparse_spatial.hpp"
#include "dynamics/unit_system.hpp"
#include "io/matrices/dmig.hpp"
#include "io/matrices/dof_table_csv.hpp"
#include "io/matrices/mat.hpp"
#include "io/matrices/mat_sparse.hpp"
#include "io/matrices/mat_variables.hpp"
#include "io/matrices/matrix_market.hpp"
#include "matrix_model.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::matrix_files_test {

namespace {

using dynamics::NodeDof;
using dynamics::SparseModel;

class MatrixFile : public ScratchFolder {
 protected:
  /// K.mtx, M.mtx, C.mtx and dofs.csv.
  [[nodiscard]] MatrixFiles write_as_matrix_market(const SparseModel& model) const {
    write_matrix_market(path("K.mtx"), model.K);
    write_matrix_market(path("M.mtx"), model.M);
    if (model.has_damping()) write_matrix_market(path("C.mtx"), model.C);
    write_dof_table(path("dofs.csv"), model);
    return si({path("K.mtx"), path("M.mtx"), model.has_damping() ? path("C.mtx") : "", path("dofs.csv")});
  }

  static MatrixFiles si(MatrixFiles files) {
    files.length_unit = "m";
    files.mass_unit = "kg";
    return files;
  }

  /// The message with which two Matrix Market texts and a table are refused.
  std::string complaint(const std::string& K, const std::string& M, const std::string& table) const {
    const MatrixFiles files = si({write("K.mtx", K), write("M.mtx", M), "", write("dofs.csv", table)});
    return message_of<core::DataError>([&] { (void)read_matrices(files); });
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// The largest relative difference of a frequency.
double modes_differ(const SparseModel& a, const SparseModel& b) {
  const Eigen::VectorXd f = dynamics::undamped_modes(dynamics::spatial_model(a)).omega_rad_s;
  const Eigen::VectorXd g = dynamics::undamped_modes(dynamics::spatial_model(b)).omega_rad_s;
  return (f.cwiseQuotient(g).array() - 1.0).abs().maxCoeff();
}

/// "row node, component, column node, component, value" with 15 digits, as Abaqus writes: upper triangle, lower, both.
enum class Triangle { upper, lower, both };
std::string abaqus_text(const Eigen::SparseMatrix<double>& A, const std::vector<NodeDof>& dofs, Triangle triangle) {
  std::string text = "** matrix output\n*MATRIX INPUT, NAME=K\n";
  for (Eigen::Index column = 0; column < A.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(A, column); entry; ++entry) {
      if (triangle == Triangle::upper && entry.row() > column) continue;
      if (triangle == Triangle::lower && entry.row() < column) continue;
      const NodeDof& row = dofs[static_cast<std::size_t>(entry.row())];
      const NodeDof& col = dofs[static_cast<std::size_t>(column)];
      char line[120];
      std::snprintf(line, sizeof line, "%d,%d, %d,%d, %.15e\n", row.node, row.component, col.node, col.component,
                    entry.value());
      text += line;
    }
  }
  return text;
}

/// The same without names, "row column value".
std::string triplet_text(const Eigen::SparseMatrix<double>& A, int digits) {
  std::string text;
  for (Eigen::Index column = 0; column < A.outerSize(); ++column) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(A, column); entry && entry.row() <= column; ++entry) {
      char line[120];
      std::snprintf(line, sizeof line, "%td %td %21.*e\n", entry.row() + 1, column + 1, digits, entry.value());
      text += line;
    }
  }
  return text;
}

}  // namespace

TEST_F(MatrixFile, OfMatrixMarketAndATableComesBackBitByBit) {
  for (const bool damped : {false, true}) {
    SparseModel model = matrix_model(7, damped);
    model.names[103] = "P, \"corner\"";
    const ImportedMatrices read = read_matrices(write_as_matrix_market(model));
    EXPECT_TRUE(same(read.model, model));
    EXPECT_EQ(read.format, "Matrix Market");
    EXPECT_EQ(modes_differ(read.model, model), 0.0);
    ASSERT_EQ(read.notes.size(), damped ? 3U : 2U) << "each holds one triangle, as its heading says";
  }
}

TEST_F(MatrixFile, OfMatComesBackBitByBit) {
  for (const bool damped : {false, true}) {
    SparseModel model = matrix_model(7, damped);
    model.names[102] = "Größe";
    write_mat(path("part.mat"), model);
    EXPECT_TRUE(same(read_matrices(si({path("part.mat")})).model, model));
  }
}

TEST_F(MatrixFile, OfMatWithAReducedModelKeepsItsNames) {
  const dynamics::SpatialModel dense = dynamics::spatial_model(matrix_model(3, true));
  write_mat(path("reduced.mat"), dense);
  const SparseModel read = read_matrices(si({path("reduced.mat")})).model;
  EXPECT_EQ(dynamics::spatial_model(read).K, dense.K);
  EXPECT_EQ(name(dynamics::named(read, read.dofs[4])), name(dense.dofs[4]));
}

TEST_F(MatrixFile, OfMatTakesFromEachFileTheMatrixThatItIsStatedFor) {
  const SparseModel model = matrix_model(3, true);
  std::vector<double> nodes, components;
  for (const NodeDof& dof : model.dofs) {
    nodes.push_back(dof.node);
    components.push_back(dof.component);
  }
  write_mat_variables(path("K.mat"), "a stiffness",
                      {mat_sparse("K", model.K),
                       {"dof_node", {nodes.size(), 1}, nodes},
                       {"dof_component", {nodes.size(), 1}, components}});
  write_mat_variables(path("M.mat"), "a mass", {mat_sparse("M", model.M)});
  write_mat_variables(path("C.mat"), "a damping", {mat_sparse("C", model.C), mat_sparse("K", model.M)});
  const SparseModel read = read_matrices(si({path("K.mat"), path("M.mat"), path("C.mat")})).model;
  EXPECT_TRUE(same(read.K, model.K));
  EXPECT_TRUE(same(read.M, model.M));
  EXPECT_TRUE(same(read.C, model.C));
  EXPECT_EQ(read.dofs, model.dofs);
  write_mat(path("all.mat"), model);
  write_matrix_market(path("M.mtx"), model.M);
  EXPECT_TRUE(same(read_matrices(si({path("all.mat"), path("all.mat"), path("all.mat")})).model, model));
  for (const auto& [files, part] : {
           std::pair{MatrixFiles{path("K.mat")}, "K.mat: has no variable M"},
           {MatrixFiles{path("K.mat"), path("C.mat")}, "C.mat: has no variable M"},
           {MatrixFiles{path("K.mat"), path("M.mtx")}, "M.mtx: is of the format Matrix Market"},
           {MatrixFiles{path("all.mat"), path("M.mat")}, "all.mat: holds M, which"},
           {MatrixFiles{path("all.mat"), "", path("C.mat")}, "all.mat: holds C, which"},
       }) {
    const MatrixFiles stated = si(files);
    const std::string message = message_of<core::DataError>([&] { (void)read_matrices(stated); });
    EXPECT_TRUE(has(message, part)) << message;
  }
}

// A format that states the whole matrix is not completed: what it lacks is zero, and told as asymmetry.
TEST_F(MatrixFile, OfOneTriangleIsCompletedOnlyWhereTheFormatAllowsIt) {
  const std::string entries = "2 2 3\n1 1 2.5\n2 1 -1\n2 2 3\n";
  const std::string table_text = "node,component\n7,x\n7,y\n";
  const std::string columns = "DMIG,KAAX,7,1,,7,1,2.5\n,7,2,-1.\nDMIG,KAAX,7,2,,7,2,3.\n";
  const std::string mass = "DMIG,MAAX,0,6,2\nDMIG,MAAX,7,1,,7,1,1.\nDMIG,MAAX,7,2,,7,2,1.\n";
  for (const bool symmetric : {false, true}) {
    const auto market = write("K.mtx", std::string("%%MatrixMarket matrix coordinate real ") +
                                           (symmetric ? "symmetric\n" : "general\n") + entries);
    const auto mass_market = write("M.mtx", "%%MatrixMarket matrix coordinate real general\n2 2 2\n1 1 1\n2 2 1\n");
    const auto punch = write("x.pch", std::string("DMIG,KAAX,0,") + (symmetric ? "6" : "1") + ",2\n" + columns + mass);
    for (const MatrixFiles& files :
         {MatrixFiles{market, mass_market, "", write("dofs.csv", table_text)}, MatrixFiles{punch}}) {
      const ImportedMatrices read = read_matrices(si(files));
      EXPECT_EQ(read.model.K.coeff(1, 0), -1.0);
      EXPECT_EQ(read.model.K.coeff(0, 1), symmetric ? -1.0 : 0.0) << files.stiffness;
      EXPECT_EQ(read.notes.empty(), !symmetric);
      if (symmetric) continue;
      EXPECT_THROW(dynamics::require_plausible(read.model), core::InputError);
    }
  }
}

TEST_F(MatrixFile, WhoseDofsAreNotInTheTableBesideItNamesThatTable) {
  const MatrixFiles files =
      si({write("job.mtx", "1,1,1,1,5.0\n1,2,1,2,4.0\n"), write("M.mtx", "1,1,1,1,2.0\n1,2,1,2,2.0\n")});
  const auto beside = write("job.dof", "1.1\n1.3\n");
  const std::string message = message_of<core::DataError>([&] { (void)read_matrices(files); });
  EXPECT_TRUE(message.starts_with(beside.string() + ": node 1, component 2")) << message;
}

// A first export rounds to what sixteen columns hold; what came from a file goes out and comes back as it was.
TEST_F(MatrixFile, OfDmigComesBackToTwelveDigitsAndOnceReadBitByBit) {
  const SparseModel model = matrix_model(7, true);
  const double rounding = write_dmig(path("first.pch"), model);
  EXPECT_LE(rounding, 5e-12);
  EXPECT_GT(rounding, 1e-16);
  const SparseModel first = read_matrices(si({path("first.pch")})).model;
  EXPECT_EQ(first.dofs, model.dofs);
  EXPECT_LT(modes_differ(first, model), 1e-9);
  EXPECT_EQ(write_dmig(path("second.pch"), first), 0.0);
  EXPECT_TRUE(same(read_matrices(si({path("second.pch")})).model, first));
}

// By hand, after the Quick Reference Guide: small, large and free fields of one matrix; a load beside it is not read.
TEST_F(MatrixFile, OfDmigIsReadInAllFields) {
  const auto file = write("a.pch",
                          "$ a comment\nENDDATA\nGRID           7           0.5     1.     -2.-1\n"
                          "DMIG    KAAX           0       6       2       0\n"
                          "DMIG    KAAX           7       1               7       1    3.+2\n"
                          "               9       2   -1.50\n"
                          "DMIG*   KAAX                           9               2\n"
                          "*                      9               2 7.250000000D+02\n"
                          "DMIG,MAAX,0,6,1\nDMIG,MAAX,7,1,,7,1,2.5\nDMIG*,MAAX,9,2,\n*,9,2,1.25E0\n"
                          "DMIG    PAX            0       9       2       0                       1\n"
                          "DMIG*   PAX                            1               0\n"
                          "*                      9               2 1.000000000D+00\n");
  const ImportedMatrices read = read_matrices(si({file}));
  Eigen::Matrix2d K, M;
  K << 300.0, -1.5, -1.5, 725.0;
  M << 2.5, 0.0, 0.0, 1.25;
  EXPECT_EQ(Eigen::MatrixXd(read.model.K), K);
  EXPECT_EQ(Eigen::MatrixXd(read.model.M), M);
  EXPECT_EQ(read.model.dofs, (std::vector<NodeDof>{{7, 1}, {9, 2}}));
  EXPECT_EQ(read.model.positions.at(7), Eigen::Vector3d(0.5, 1.0, -0.2));
}

TEST_F(MatrixFile, OfAbaqusIsReadFromEitherTriangleOrBoth) {
  const SparseModel model = matrix_model(5, false);
  for (const Triangle triangle : {Triangle::upper, Triangle::lower, Triangle::both}) {
    const MatrixFiles files = si({write("STIF.mtx", abaqus_text(model.K, model.dofs, triangle)),
                                  write("MASS.mtx", abaqus_text(model.M, model.dofs, triangle))});
    const ImportedMatrices read = read_matrices(files);
    EXPECT_EQ(read.model.dofs, model.dofs);
    EXPECT_LT(modes_differ(read.model, model), 1e-12);
    EXPECT_EQ(read.notes.size(), triangle == Triangle::both ? 0U : 2U);
  }
}

TEST_F(MatrixFile, OfRowsAndColumnsTakesItsNamesFromTheDofFileBesideIt) {
  SparseModel model = matrix_model(5, false);
  const Eigen::Index n = model.size() - 2;  // .dof holds no amplitudes
  model.K = Eigen::SparseMatrix<double>(model.K.topLeftCorner(n, n));
  model.M = Eigen::SparseMatrix<double>(model.M.topLeftCorner(n, n));
  model.dofs.resize(static_cast<std::size_t>(n));
  std::string dofs;
  for (const NodeDof& dof : model.dofs) dofs += std::to_string(dof.node) + "." + std::to_string(dof.component) + "\n";
  write("job.dof", dofs);
  MatrixFiles files = si({write("job.sti", triplet_text(model.K, 16)), write("job.mas", triplet_text(model.M, 16))});
  EXPECT_EQ(read_matrices(files).model.dofs, model.dofs);
  EXPECT_LT(modes_differ(read_matrices(files).model, model), 1e-13);
  write("job.dof", dofs.substr(dofs.find('\n') + 1));
  EXPECT_TRUE(has(message_of<core::DataError>([&] { (void)read_matrices(files); }), "30 rows and the DOF table 29"));
}

TEST_F(MatrixFile, OfAnotherSystemOfUnitsIsConverted) {
  const SparseModel model = matrix_model(4, false);
  MatrixFiles files = write_as_matrix_market(model);
  files.length_unit = "mm";
  files.mass_unit = "t";
  const SparseModel read = read_matrices(files).model;
  EXPECT_TRUE(same(read.K, dynamics::in_si(model, {1e-3, 1e3}).K));
  EXPECT_EQ(read.positions, model.positions) << "x_m is in m";
  for (auto unit : {&MatrixFiles::length_unit, &MatrixFiles::mass_unit}) {
    MatrixFiles without = files;
    without.*unit = "";
    EXPECT_TRUE(has(message_of<core::InputError>([&] { (void)read_matrices(without); }), "do not tell their unit"));
    without.*unit = "MPa";
    EXPECT_TRUE(has(message_of<core::InputError>([&] { (void)read_matrices(without); }), "\"MPa\", a stress"));
  }
}

TEST_F(MatrixFile, TakesPositionsFromATableOrAnInputFile) {
  MatrixFiles files = write_as_matrix_market(matrix_model(2, false));
  files.length_unit = "mm";
  files.mass_unit = "t";
  write(
      "dofs.csv", "node,component\n" + [] {
        std::string rows;
        for (const char* node : {"101", "102"})
          for (const char* component : {"x", "y", "z", "rx", "ry", "rz"})
            rows += std::string(node) + "," + component + "\n";
        return rows + "7,mode\n8,mode\n";
      }());
  files.positions = write("nodes.csv", "node,x,y,z\n101,0,0,0\n102,400,0,5\n999,1,1,1\n");
  const ImportedMatrices read = read_matrices(files);
  EXPECT_EQ(read.model.positions.at(102), Eigen::Vector3d(0.4, 0.0, 0.005));
  EXPECT_FALSE(read.model.positions.contains(999)) << "has no DOF";
  files.positions = write("job.inp", "*NODE\n101,0.,0.,0.\n");
  const ImportedMatrices partly = read_matrices(files);
  EXPECT_EQ(partly.model.positions.size(), 1U);
  ASSERT_FALSE(partly.notes.empty());
  EXPECT_TRUE(has(partly.notes.back(), "without a position, the first of node 102")) << partly.notes.back();
}

TEST_F(MatrixFile, TakesPositionsFromAnInputFileOfWhateverElements) {
  const std::string nodes = "*NODE\n3,0.,0.,0.\n9,0.,5.,0.\n4,1.,0.,0.\n";
  for (const char* elements : {"", "*ELEMENT, TYPE=S3\n1,3,4,9\n", "*ELEMENT, TYPE=B31\n1,3,4\n2,4,9\n"}) {
    const auto positions = read_node_positions(write("job.inp", nodes + elements));
    EXPECT_EQ(positions.size(), 3U);
    EXPECT_EQ(positions.at(9), Eigen::Vector3d(0.0, 5.0, 0.0));
  }
  for (const auto& [text, part] : {std::pair{nodes + "9,0.,6.,0.\n", "job.inp:5: node 9 is there already, in line 3"},
                                   {std::string("*HEADING\n"), "job.inp: holds no *NODE"}}) {
    const auto file = write("job.inp", text);
    EXPECT_TRUE(has(message_of<core::DataError>([&] { (void)read_node_positions(file); }), part));
  }
}

TEST_F(MatrixFile, HasNoTableOfPositionsThatAreNotFinite) {
  SparseModel model = matrix_model(2, false);
  model.positions[102].y() = std::nan("");
  const std::string message = message_of<core::InputError>([&] { write_dof_table(path("dofs.csv"), model); });
  EXPECT_TRUE(has(message, "the position of node 102 is not finite")) << message;
  EXPECT_TRUE(is_empty());
}

const std::string two = "%%MatrixMarket matrix coordinate real symmetric\n% c\n2 2 3\n1 1 2.5\n2 1 -1\n2 2 3\n";
const std::string table = "row,node,component\n1,7,x\n2,7,y\n";

TEST_F(MatrixFile, OfMatrixMarketIsRefusedWithItsLine) {
  const auto replaced = [](std::string text, const std::string& what, const std::string& by) {
    return text.replace(text.find(what), what.size(), by);
  };
  for (const auto& [text, part] : {
           std::pair{replaced(two, "symmetric", "skew-symmetric"), "K.mtx:1: is \"skew-symmetric\""},
           {replaced(two, "real", "pattern"), "K.mtx:1: holds \"pattern\""},
           {replaced(two, "real", "complex"), "K.mtx:1: holds \"complex\""},
           {replaced(two, "2 2 3\n1", "2 3 3\n1"), "is 2 x 3"},
           {replaced(two, "2 2 3\n1", "2 2 4\n1"), "states 4 entries and holds 3"},
           {replaced(two, "2 2 3\n1", "2 2 9999999999\n1"), "states 9999999999 entries and holds 3"},
           {replaced(two, "2 1 -1", "2 1 nan"), "K.mtx:5: an entry is \"nan\", not finite"},
           {replaced(two, "2 1 -1", "2 1 1,5"), "K.mtx:5: \"1,5\" where an entry belongs"},
           {replaced(two, "2 1 -1", "3 1 -1"), "K.mtx:5: a row is \"3\""},
           {replaced(two, "2 1 -1", "1 2 -1"), "K.mtx:5: an entry above the diagonal"},
           {replaced(two, "2 1 -1", "1 1 -1"), "K.mtx:5: the entry of row 1 and column 1 is there twice"},
           {two.substr(0, two.size() - 3), "truncated"},
           {replaced(two, "%%", "%"), "is no matrix that is known"},
           {replaced(two, "2 2 3\n1", "2000000000 2000000000 3\n1"), "has 2000000000 rows and the DOF table 2"},
       }) {
    const std::string message = complaint(text, two, table);
    EXPECT_TRUE(has(message, part)) << message;
  }
}

TEST_F(MatrixFile, WithATableThatDoesNotFitIsRefused) {
  for (const auto& [text, part] : {
           std::pair{table + "3,8,z\n", "has 2 rows and the DOF table 3"},
           {std::string("row,node,component\n1,7,x\n"), "has 2 rows and the DOF table 1"},
           {std::string("row,node,component\n1,7,x\n3,7,y\n"), "dofs.csv:3: row 3, but the table has 2"},
           {std::string("row,node,component\n1,7,x\n1,7,y\n"), "dofs.csv:3: row 1 is there twice"},
           {std::string("row,node,component\n1,7,x\n2,7,11\n"), "dofs.csv:3: the component is \"11\""},
           {std::string("row,node,component\n1,7,x\n2,7.5,y\n"), "dofs.csv:3: column 2: \"7.5\""},
           {std::string("row,node\n1,7\n2,8\n"), "no column \"component\""},
           {std::string("row,node,dof\n1,7,x\n2,7,y\n"), "the column \"dof\" is not known"},
           {std::string("node,component,x_m,y_m,z_m\n7,x,0,0,0\n7,y,0,0,1\n"), "node 7 has two positions"},
           {std::string("node,component,x_m\n7,x,0\n7,y,0\n"), "of x_m, y_m, z_m some are missing"},
       }) {
    const std::string message = complaint(two, two, text);
    EXPECT_TRUE(has(message, part)) << message;
  }
  const MatrixFiles twice = si({path("K.mtx"), path("M.mtx"), "", write("dofs.csv", "node,component\n7,x\n7,x\n")});
  const std::string both = message_of<core::DataError>([&] { (void)read_matrices(twice); });
  EXPECT_TRUE(has(both, "dofs.csv: rows 1 and 2 are both node 7.x")) << both;
  const MatrixFiles none = si({path("K.mtx"), path("M.mtx")});
  EXPECT_TRUE(has(message_of<core::DataError>([&] { (void)read_matrices(none); }), "state the DOF table"));
}

TEST_F(MatrixFile, OfLinesOfNumbersIsRefusedWithItsLine) {
  const std::string mass = "1,1,1,1,2.0\n1,2,1,2,2.0\n";
  for (const auto& [text, part] : {
           std::pair{"1,1,1,1,5.0\n1,2,1,2,inf\n", "K.mtx:2: an entry is \"inf\", not finite"},
           {"1,1,1,1,5.0\n1,2,1,11,4.\n", "K.mtx:2: a component (1 to 6, or 0 for an amplitude) is \"11\""},
           {"1,1,1,1,5.0\n1,2,1,2\n", "K.mtx:2: nothing stands where an entry belongs"},
           {"1,1,1,1,5.0\n1,2,1,2,3.,4.\n", "K.mtx:2: \"4.\" follows"},
           {"1,1,1,1,5.0\n1,1,1,1,5.0\n", "K.mtx:2: the entry of row 1 and column 1 is there twice"},
           {"1 1 5.0\n2 2 4.0\n", "M.mtx: is of the format Abaqus matrix input"},
       }) {
    const MatrixFiles files = si({write("K.mtx", text), write("M.mtx", mass)});
    const std::string message = message_of<core::DataError>([&] { (void)read_matrices(files); });
    EXPECT_TRUE(has(message, part)) << message;
  }
}

TEST_F(MatrixFile, OfDmigIsRefusedWithItsLine) {
  const std::string heading = "DMIG,KAAX,0,6,2\nDMIG,MAAX,0,6,2\n", good = "DMIG,KAAX,7,1,,7,1,1.5\n";
  for (const auto& [text, part] : {
           std::pair{good + heading, "x.pch:1: a column of \"KAAX\" before its heading"},
           {heading + heading, "x.pch:3: the heading of KAAX is there twice"},
           {heading + "DMIG,KAAX,7,1,,7,1,1.5x\n", "x.pch:3: \"1.5x\" where a finite real number belongs"},
           {heading + "DMIG,KAAX,7,1,,7,1,\n", "x.pch:3: \"\" where a finite real number belongs"},
           {heading + "DMIG,KAAX,7,9,,7,1,1.\n", "x.pch:3: a component is \"9\""},
           {heading + "DMIG,KAAX,-7,1,,7,1,1.\n", "x.pch:3: a grid point is \"-7\""},
           {"GRID,7,3,0.,0.,0.\n" + heading, "x.pch:1: grid point \"7\" stands in coordinate system \"3\""},
           {"GRID,7,,0.,0.,0.,3\n" + heading, "coordinate system \"3\""},
           {std::string("DMIG,KAAX,0,6,4\nDMIG,MAAX,0,6,2\n"), "x.pch:1: KAAX is complex (type 4)"},
           {std::string("DMIG,KAAX,0,9,2\nDMIG,MAAX,0,6,2\n"), "x.pch:1: KAAX is not square (form 9"},
           {"DMIG,K2GG,0,6,2\n" + heading, "more than one matrix whose name begins with K"},
           {std::string("DMIG,K4AAX,0,6,2\nDMIG,MAAX,0,6,2\n"), "no matrix whose name begins with K; state the name"},
       }) {
    const MatrixFiles files = si({write("x.pch", text)});
    const std::string message = message_of<core::DataError>([&] { (void)read_matrices(files); });
    EXPECT_TRUE(has(message, part)) << message;
  }
  MatrixFiles named = si({write("x.pch", heading + good + "DMIG,MAAX,7,1,,7,1,1.5\nDMIG,K2GG,0,6,2\n")});
  named.stiffness_name = "kaax";
  EXPECT_EQ(read_matrices(named).model.K.coeff(0, 0), 1.5);
}

TEST_F(MatrixFile, CutShortIsRefusedOrLacksRows) {
  const MatrixFiles files = write_as_matrix_market(matrix_model(2, false));
  const std::string whole = core::read_file(files.stiffness);
  for (std::size_t size = 0; size < whole.rfind('\n', whole.size() - 2); size += 7) {
    write("K.mtx", whole.substr(0, size));
    EXPECT_THROW((void)read_matrices(files), core::DataError) << size;
  }
}

TEST_F(MatrixFile, IsNotWrittenFromAnInconsistentModel) {
  SparseModel model = matrix_model(2, false);
  model.dofs.pop_back();
  EXPECT_THROW(write_mat(path("a.mat"), model), core::InputError);
  EXPECT_THROW((void)write_dmig(path("a.pch"), model), core::InputError);
  model = matrix_model(2, false);
  model.dofs[0].node = -3;
  EXPECT_THROW((void)write_dmig(path("a.pch"), model), core::InputError);
  model.K.coeffRef(0, 0) = std::nan("");
  EXPECT_THROW(write_matrix_market(path("a.mtx"), model.K), core::NumericalError);
  EXPECT_TRUE(is_empty());
}

}  // namespace thinwall::io::test::matrix_files_test
