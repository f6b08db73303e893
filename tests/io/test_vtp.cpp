#include <gtest/gtest.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>

#include <limits>

#include "core/error.hpp"
#include "io/vtp.hpp"
#include "mesh/tessellation.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test {

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

}  // namespace

}  // namespace thinwall::io::test
