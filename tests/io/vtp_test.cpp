#include "io/results/vtp.hpp"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <limits>

#include "core/error.hpp"
#include "mesh/solid/tessellation.hpp"
#include "mesh/surface/shapes.hpp"
#include "mesh/surface/wall_thickness.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::vtp_test {

namespace {

class Vtp : public ScratchFolder {};

TEST_F(Vtp, VtkReadsBackTheSurfaceAndItsShapes) {
  mesh::TetMesh tet;
  tet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tet.tets = {{0, 1, 2, 3}};
  const mesh::LagrangeNodes nodes = mesh::lagrange_nodes(tet, 4);
  const NodeVectors shape{"mode 01, 100.0 Hz", 2.0 * nodes.positions};
  const auto file = path("surface.vtp");
  write_vtp(file, nodes, mesh::surface_triangles(nodes, mesh::boundary(tet)), {shape});
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData& surface = *reader->GetOutput();
  EXPECT_EQ(surface.GetNumberOfCells(), 4 * 16);
  EXPECT_EQ(surface.GetNumberOfPoints(), 34) << "35 nodes of order 4 less the one inside";
  vtkDataArray* read = surface.GetPointData()->GetArray("mode 01, 100.0 Hz");
  ASSERT_NE(read, nullptr);
  for (vtkIdType i = 0; i < surface.GetNumberOfPoints(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(read->GetComponent(i, axis), 2.0 * surface.GetPoint(i)[axis], 1e-6);
  }
}

TEST_F(Vtp, NaNIsRefused) {
  mesh::TetMesh tet;
  tet.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  tet.tets = {{0, 1, 2, 3}};
  const mesh::LagrangeNodes nodes = mesh::lagrange_nodes(tet, 1);
  NodeVectors shape{"mode", nodes.positions};
  shape.values(2, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(write_vtp(path("surface.vtp"), nodes, {{0, 1, 2}}, {shape}), core::NumericalError);
  EXPECT_FALSE(std::filesystem::exists(path("surface.vtp")));
}

// A plate of 3 mm: beneath its two large sides the wall is that thick.
TEST_F(Vtp, VtkReadsBackTheWallThicknessOfEveryTriangle) {
  const mesh::TriangleSurface plate = mesh::block_surface({0.04, 0.03, 0.003}, 0.01);
  const auto file = path("wall.vtp");
  const std::vector<double> wall = mesh::wall_thickness(plate, mesh::TriangleTree(plate));
  write_vtp(file, plate, {{"wall_thickness_m", wall}});
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  vtkPolyData& read = *reader->GetOutput();
  ASSERT_EQ(read.GetNumberOfCells(), static_cast<vtkIdType>(plate.triangles.size()));
  vtkDataArray* thickness = read.GetCellData()->GetArray("wall_thickness_m");
  ASSERT_NE(thickness, nullptr);
  for (vtkIdType t = 0; t < read.GetNumberOfCells(); ++t) {
    Eigen::Index axis = 0;
    mesh::area_vector(plate, static_cast<int>(t)).cwiseAbs().maxCoeff(&axis);
    EXPECT_EQ(thickness->GetComponent(t, 0), wall[static_cast<std::size_t>(t)]);
    if (axis == 2) {
      EXPECT_NEAR(thickness->GetComponent(t, 0), 0.003, 1e-15);
    }
    for (vtkIdType k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(read.GetCell(t)->GetPointId(k));
      EXPECT_EQ(static_cast<int>(v), plate.triangles[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)]);
      for (int i = 0; i < 3; ++i) EXPECT_NEAR(read.GetPoint(static_cast<vtkIdType>(v))[i], plate.vertices[v](i), 3e-9);
    }
  }
}

TEST_F(Vtp, NumbersThatDoNotFitTheTrianglesAreRefused) {
  const mesh::TriangleSurface plate = mesh::block_surface({0.04, 0.03, 0.003}, 0.04);
  std::vector<double> values(plate.triangles.size(), 1.0);
  values[3] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_vtp(path("wall.vtp"), plate, {{"wall", values}}), core::NumericalError);
  values.pop_back();
  EXPECT_THROW(write_vtp(path("wall.vtp"), plate, {{"wall", values}}), core::InputError);
  EXPECT_TRUE(is_empty());
}

}  // namespace

}  // namespace thinwall::io::test::vtp_test
