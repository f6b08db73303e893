// VTU files that VTK's own writer made, in every encoding it knows, are one mesh.

#include "io/mesh/vtu_reader.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "core/error.hpp"
#include "io/mesh/mesh_file.hpp"
#include "io/results/vtu.hpp"
#include "mesh_bytes.hpp"
#include "scratch_folder.hpp"
#include "tests/mesh/labelled_grids.hpp"

namespace thinwall::io::vtu_reader_test {
namespace {

using VtuFile = test::ScratchFolder;

/// The cells of a labelled mesh as VTK holds them, with a triangle beside them and a number on each.
void fill(vtkUnstructuredGrid& grid, const mesh::LabelledMesh& labelled, int type,
          const std::vector<std::size_t>& order) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  std::map<std::int64_t, vtkIdType> row;
  for (const mesh::LabelledNode& node : labelled.nodes) row[node.label] = points->InsertNextPoint(node.x.data());
  grid.SetPoints(points);
  vtkNew<vtkIntArray> material;
  material->SetName("material");
  for (const mesh::LabelledCell& cell : labelled.cells) {
    std::vector<vtkIdType> nodes(cell.nodes);
    for (std::size_t a = 0; a < cell.nodes; ++a)
      nodes[order.empty() ? a : order[a]] = row.at(labelled.cell_nodes[cell.first + a]);
    grid.InsertNextCell(type, static_cast<vtkIdType>(nodes.size()), nodes.data());
    material->InsertNextValue(grid.GetNumberOfCells() == 1 ? 7 : 3);
  }
  const std::array<vtkIdType, 3> corners{0, 1, 2};
  grid.InsertNextCell(VTK_TRIANGLE, 3, corners.data());
  material->InsertNextValue(9);
  grid.GetCellData()->AddArray(material);
}

struct Encoding {
  const char* name;
  int mode;  ///< ascii 0, binary 1, appended 2
  bool base64;
  bool zlib;
  bool wide;
  bool big_endian;
};

std::string encoded(vtkUnstructuredGrid& grid, const Encoding& encoding) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetDataMode(encoding.mode);
  writer->SetEncodeAppendedData(encoding.base64);
  writer->SetCompressorType(encoding.zlib ? vtkXMLWriter::ZLIB : vtkXMLWriter::NONE);
  writer->SetBlockSize(4096);  // several blocks
  writer->SetHeaderType(encoding.wide ? vtkXMLWriter::UInt64 : vtkXMLWriter::UInt32);
  writer->SetByteOrder(encoding.big_endian ? vtkXMLWriter::BigEndian : vtkXMLWriter::LittleEndian);
  writer->WriteToOutputStringOn();
  EXPECT_EQ(writer->Write(), 1);
  return writer->GetOutputString();
}

const std::vector<Encoding> encodings{{"ascii", 0, false, false, false, false},
                                      {"binary", 1, false, false, false, false},
                                      {"binary zlib", 1, false, true, false, false},
                                      {"binary zlib wide", 1, false, true, true, true},
                                      {"appended raw", 2, false, false, true, false},
                                      {"appended base64", 2, true, false, false, true},
                                      {"appended raw zlib", 2, false, true, false, false},
                                      {"appended base64 zlib", 2, true, true, true, false}};

Eigen::Vector3d sheared(const Eigen::Vector3d& u) {
  return {2.0 * u.x() + 0.3 * u.z(), u.y(), 3.0 * u.z()};
}

struct Kind {
  mesh::CellShape shape;
  std::size_t nodes;
  int type;
  std::vector<std::size_t> order;  ///< for each of our nodes its place in VTK's
};

const std::vector<Kind> kinds{
    {mesh::CellShape::hexahedron, 8, VTK_HEXAHEDRON, {}},
    {mesh::CellShape::hexahedron, 8, VTK_VOXEL, {0, 1, 3, 2, 4, 5, 7, 6}},
    {mesh::CellShape::wedge, 6, VTK_WEDGE, {}},
    {mesh::CellShape::wedge, 6, VTK_WEDGE, {0, 2, 1, 3, 5, 4}},
    {mesh::CellShape::hexahedron, 20, VTK_QUADRATIC_HEXAHEDRON, {}},
    {mesh::CellShape::hexahedron, 27, VTK_TRIQUADRATIC_HEXAHEDRON, {0,  1,  2,  3,  4,  5,  6,  7,  8,
                                                                    9,  10, 11, 12, 13, 14, 15, 16, 17,
                                                                    18, 19, 24, 25, 22, 21, 23, 20, 26}},
    {mesh::CellShape::wedge, 15, VTK_QUADRATIC_WEDGE, {}},
    {mesh::CellShape::wedge, 15, VTK_QUADRATIC_WEDGE, {0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13}},
    {mesh::CellShape::wedge, 18, VTK_BIQUADRATIC_QUADRATIC_WEDGE, {}}};

TEST(VtuFiles, OfEveryEncodingAndCellAreTheSameMesh) {
  for (const Kind& kind : kinds) {
    const mesh::LabelledGrid grid({3, 2, 2}, kind.shape, kind.nodes, sheared);
    vtkNew<vtkUnstructuredGrid> vtk;
    fill(*vtk, grid.mesh, kind.type, kind.order);
    mesh::SolidMesh first;
    for (const Encoding& encoding : encodings) {
      const mesh::SolidMesh solid = mesh::solid_mesh(vtu_mesh(encoded(*vtk, encoding), encoding.name, 1.0));
      EXPECT_NEAR(mesh::volume_of(solid), 6.0, 1e-12) << kind.type << " " << encoding.name;
      EXPECT_EQ(mesh::element_set(solid, "material=7", "").tets.size(), kind.shape == mesh::CellShape::wedge ? 3U : 6U);
      EXPECT_EQ(solid.element_sets.size(), 2U) << "the triangle's number makes no set";
      if (first.mesh.tets.empty()) first = solid;
      EXPECT_TRUE(solid.nodes.positions.isApprox(first.nodes.positions, 1e-9)) << encoding.name;
      EXPECT_TRUE(solid.nodes.elements == first.nodes.elements);
    }
  }
}

TEST_F(VtuFile, ThatThinwallWritesIsReadBack) {
  for (const int order : {1, 2}) {
    const mesh::SolidMesh solid = mesh::with_order(
        mesh::solid_mesh(mesh::LabelledGrid({2, 2, 2}, mesh::CellShape::wedge, 6, sheared).mesh), order);
    write_vtu(path("own.vtu"), solid.nodes);
    const mesh::SolidMesh back = read_solid_mesh(path("own.vtu"), "m");
    EXPECT_TRUE(back.nodes.positions == solid.nodes.positions);
    EXPECT_TRUE(back.nodes.elements == solid.nodes.elements);
  }
}

/// Gmsh's order of the last two in VTK's cells, as a converter that forgets it leaves them.
TEST_F(VtuFile, WithTheLastTwoOfTen_NodeTetrahedraExchangedIsPutRight) {
  const mesh::SolidMesh solid =
      mesh::with_order(mesh::solid_mesh(mesh::LabelledGrid({2, 1, 1}, mesh::CellShape::wedge, 6, sheared).mesh), 2);
  mesh::LagrangeNodes swapped = solid.nodes;
  const std::vector<int> order = vtk_node_order(2);
  for (Eigen::Index e = 0; e < swapped.elements.rows(); ++e)
    std::swap(swapped.elements(e, order[8]), swapped.elements(e, order[9]));
  write_vtu(path("swapped.vtu"), swapped);
  const mesh::SolidMesh back = read_solid_mesh(path("swapped.vtu"), "m");
  EXPECT_TRUE(back.nodes.elements == solid.nodes.elements);
  EXPECT_LT(back.midside_offset, 1e-12);
}

std::string text_of(const std::string& points, const std::string& connectivity, const std::string& offsets,
                    const std::string& types, int count = 4) {
  return "<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid><Piece NumberOfPoints=\"" + std::to_string(count) +
         "\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
         points + "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
         connectivity + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + offsets +
         "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
         "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

TEST(VtuFiles, ThatAreWrongAreToldInALine) {
  const std::string x = "0 0 0 1 0 0 0 1 0 0 0 1";
  EXPECT_EQ(mesh::solid_mesh(vtu_mesh(text_of(x, "0 1 2 3", "4", "10"), "a", 1.0)).mesh.tets.size(), 1U);
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"", "XML"},
      {"<a/>", "VTKFile"},
      {"<VTKFile type=\"PolyData\"/>", "PolyData"},
      {"<VTKFile type=\"UnstructuredGrid\" compressor=\"vtkLZ4DataCompressor\"/>", "zlib"},
      {"<VTKFile type=\"UnstructuredGrid\"/>", "no solid element"},
      {text_of(x, "0 1 2 3", "4", "10").substr(0, 300), "XML"},
      {text_of(x, "0 1 2 4", "4", "10"), "point 4 of 4"},
      {text_of(x, "0 1 2 -1", "4", "10"), "point -1"},
      {text_of(x, "0 1 2 3", "5", "10"), "offset of cell 0 is 5"},
      {text_of(x, "0 1 2 3", "-1", "10"), "offset"},
      {text_of(x, "0 1 2 3", "4", "10 10"), "2 types"},
      {text_of(x, "0 1 2 3", "4", "42"), "type 42"},
      {text_of(x, "0 1 2", "3", "10"), "has 3 nodes"},
      {text_of(x, "0 2 1 3", "4", "10"), "element 0 has no positive volume"},
      {text_of(x, "0 1 2 3", "4", "10", 5), "5 points"},
      {text_of(x, "0 1 2 3", "4", "10", 2000000000), "2000000000 points"},
      {text_of("0 0 0 1 0 0 0 1 0 0 0 nan", "0 1 2 3", "4", "10"), "finite"},
      {text_of("0 0 0 1 0 0 0 1 0 0 0 zero", "0 1 2 3", "4", "10"), "zero"}};
  for (const auto& [text, part] : wrong) {
    const std::string bytes = text;
    const std::string message =
        test::message_of<core::DataError>([&] { (void)mesh::solid_mesh(vtu_mesh(bytes, "a.vtu", 1.0)); });
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_NE(message.find("a.vtu"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
  EXPECT_THROW((void)vtu_mesh(text_of(x, "0 1 2 3", "4", "10"), "a", 0.0), core::InputError);
}

TEST(VtuFiles, CutAnywhereAreRefused) {
  const mesh::LabelledGrid grid({1, 1, 1}, mesh::CellShape::hexahedron, 8, sheared);
  vtkNew<vtkUnstructuredGrid> vtk;
  fill(*vtk, grid.mesh, VTK_HEXAHEDRON, {});
  for (const Encoding& encoding : encodings) {
    const std::string bytes = encoded(*vtk, encoding);
    for (std::size_t size = 0; size + 40 < bytes.size(); ++size) {
      try {
        (void)mesh::solid_mesh(vtu_mesh(bytes.substr(0, size), "a", 1.0));
        // The last array may be whole although what closes the file is cut.
        EXPECT_GT(size, bytes.find("AppendedData")) << encoding.name;
      } catch (const core::DataError&) {
      }
    }
  }
}

}  // namespace
}  // namespace thinwall::io::vtu_reader_test
