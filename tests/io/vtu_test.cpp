#include "io/results/vtu.hpp"

#include <vtkCell.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <locale>
#include <random>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "io/results/pvd.hpp"
#include "io/results/vtp.hpp"
#include "mesh/tet_mesh.hpp"
#include "scratch_folder.hpp"

namespace thinwall::io::test::vtu_test {

namespace {

class Vtu : public ScratchFolder {};
class VtuOfOrder : public ScratchFolder, public ::testing::WithParamInterface<int> {};

/// Two skewed tetrahedra that share a face, and a third beside them turned another way round.
mesh::TetMesh three_tets() {
  mesh::TetMesh mesh;
  mesh.vertices = {{0.0, 0.0, 0.0}, {1.0, 0.1, 0.2}, {0.2, 0.9, -0.1},
                   {0.1, 0.3, 1.1}, {1.1, 1.2, 1.3}, {1.6, 0.2, 1.4}};
  mesh.tets = {{0, 1, 2, 3}, {4, 2, 1, 3}, {3, 1, 5, 4}};
  for (int i = 0; i < 3; ++i) {
    auto& tet = mesh.tets[static_cast<std::size_t>(i)];
    if (mesh::volume(mesh, i) < 0.0) std::swap(tet[2], tet[3]);
  }
  return mesh;
}

/// A vector field of full polynomial degree p: any node out of its place spoils its interpolation.
Eigen::Vector3d polynomial(const Eigen::Vector3d& x, int degree) {
  const Eigen::Vector3d a(0.7, -0.4, 0.5);
  const Eigen::Vector3d b(-0.2, 0.8, 0.3);
  return {std::pow(1.0 + a.dot(x), degree), std::pow(0.5 + b.dot(x), degree), std::pow(a.dot(x), degree) - x.y()};
}

NodeVectors displacement(const mesh::LagrangeNodes& nodes) {
  NodeVectors field{"displacement", {}};
  field.values.resize(nodes.positions.rows(), 3);
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    field.values.row(i) = polynomial(nodes.positions.row(i).transpose(), nodes.order).transpose();
  }
  return field;
}

vtkSmartPointer<vtkUnstructuredGrid> read_by_vtk(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

/// Position and displacement at barycentric coordinates (1 − r − s − t, r, s, t) by VTK's own shape functions.
struct Interpolated {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();
};

Interpolated interpolate(vtkUnstructuredGrid& grid, vtkIdType cell_index, const Eigen::Vector3d& rst) {
  vtkCell* cell = grid.GetCell(cell_index);
  auto* field = grid.GetPointData()->GetArray("displacement");
  std::vector<double> weights(static_cast<std::size_t>(cell->GetNumberOfPoints()));
  Interpolated result;
  int sub_id = 0;
  cell->EvaluateLocation(sub_id, rst.data(), result.position.data(), weights.data());
  for (vtkIdType i = 0; i < cell->GetNumberOfPoints(); ++i) {
    Eigen::Vector3d u;
    field->GetTuple(cell->GetPointId(static_cast<int>(i)), u.data());
    result.displacement += weights[static_cast<std::size_t>(i)] * u;
  }
  return result;
}

Eigen::Vector3d random_point(std::mt19937& random) {
  std::exponential_distribution<double> share(1.0);
  const Eigen::Vector4d lambda(share(random), share(random), share(random), share(random));
  return lambda.tail<3>() / lambda.sum();
}

Eigen::Vector3d straight_sided(const mesh::TetMesh& mesh, const std::array<int, 4>& tet, const Eigen::Vector3d& rst) {
  const auto vertex = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(tet[i])]; };
  return (1.0 - rst.sum()) * vertex(0) + rst[0] * vertex(1) + rst[1] * vertex(2) + rst[2] * vertex(3);
}

/// Writes numbers as a German would: 1.234,5.
struct CommaNumbers : std::numpunct<char> {
  [[nodiscard]] char do_decimal_point() const override { return ','; }
  [[nodiscard]] char do_thousands_sep() const override { return '.'; }
  [[nodiscard]] std::string do_grouping() const override { return "\3"; }
};

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

TEST_P(VtuOfOrder, IsInterpolatedByVtkAsTheFieldThatWasWritten) {
  const mesh::TetMesh mesh = three_tets();
  const auto nodes = mesh::lagrange_nodes(mesh, GetParam());
  write_vtu(path("mode.vtu"), nodes, {displacement(nodes)}, {{"frequency_hz", 212.5}, {"damping_ratio", 0.003}});
  const auto grid = read_by_vtk(path("mode.vtu"));
  ASSERT_EQ(grid->GetNumberOfPoints(), nodes.positions.rows());
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  const int expected_type = GetParam() == 1   ? VTK_TETRA
                            : GetParam() == 2 ? VTK_QUADRATIC_TETRA
                                              : VTK_LAGRANGE_TETRAHEDRON;
  std::mt19937 random(3);
  for (int cell = 0; cell < 3; ++cell) {
    EXPECT_EQ(grid->GetCellType(cell), expected_type);
    for (int sample = 0; sample < 20; ++sample) {
      const Eigen::Vector3d rst = random_point(random);
      const Eigen::Vector3d x = straight_sided(mesh, mesh.tets[static_cast<std::size_t>(cell)], rst);
      const auto found = interpolate(*grid, cell, rst);
      // Round-off of order-6 interpolation: Lebesgue constant below 20, field values below 50.
      EXPECT_LE((found.position - x).norm(), 1e-13) << "cell " << cell;
      EXPECT_LE((found.displacement - polynomial(x, GetParam())).norm(), 1e-12) << "cell " << cell;
    }
  }
  EXPECT_EQ(grid->GetFieldData()->GetArray("frequency_hz")->GetTuple1(0), 212.5);
  EXPECT_EQ(grid->GetFieldData()->GetArray("damping_ratio")->GetTuple1(0), 0.003);
  EXPECT_STREQ(grid->GetPointData()->GetVectors()->GetName(), "displacement");
}

INSTANTIATE_TEST_SUITE_P(OneToSix, VtuOfOrder, ::testing::Range(1, 7));

TEST_F(Vtu, FilesWrittenSideBySideAreThoseWrittenOneAfterTheOther) {
  const auto nodes = mesh::lagrange_nodes(three_tets(), 4);
  const std::vector<std::array<int, 3>> triangles{{0, 1, 2}, {0, 1, 3}, {1, 2, 4}};
  const auto write = [&](const std::string& stem, std::size_t i) {
    NodeVectors field = displacement(nodes);
    field.values *= 1.0 + static_cast<double>(i);
    if (i % 2 == 0) {
      write_vtu(path(stem + std::to_string(i)), nodes, {field}, {{"frequency_hz", 1.0 + static_cast<double>(i)}});
    } else {
      write_vtp(path(stem + std::to_string(i)), nodes, triangles, {field});
    }
  };
  constexpr std::size_t count = 200;
  for (std::size_t i = 0; i < count; ++i) write("alone", i);
  const int threads = core::thread_count();
  core::set_thread_count(8);
  core::parallel_for(count, [&](std::size_t i) { write("beside", i); });
  core::set_thread_count(threads);
  for (std::size_t i = 0; i < count; ++i) {
    EXPECT_FALSE(bytes_of(path("alone" + std::to_string(i))).empty());
    EXPECT_EQ(bytes_of(path("alone" + std::to_string(i))), bytes_of(path("beside" + std::to_string(i)))) << i;
  }
}

TEST_F(Vtu, KeepsTheVolumeOfTheMesh) {
  const mesh::TetMesh mesh = three_tets();
  write_vtu(path("part.vtu"), mesh::lagrange_nodes(mesh, 4));
  const auto grid = read_by_vtk(path("part.vtu"));
  double volume = 0.0;
  for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell) {
    std::array<Eigen::Vector3d, 4> v;
    for (int i = 0; i < 4; ++i)
      grid->GetPoint(grid->GetCell(cell)->GetPointId(i), v[static_cast<std::size_t>(i)].data());
    volume += (v[1] - v[0]).cross(v[2] - v[0]).dot(v[3] - v[0]) / 6.0;
  }
  EXPECT_NEAR(volume, mesh::volume(mesh), 1e-14);
}

TEST_F(Vtu, IsTheSameUnderACommaLocale) {
  // more than 999 nodes, so that a grouping locale would show
  mesh::TetMesh mesh;
  for (int i = 0; i < 60; ++i) {
    const auto first = static_cast<int>(mesh.vertices.size());
    const Eigen::Vector3d corner(2.0 * i, 0.0, 0.0);
    mesh.vertices.insert(mesh.vertices.end(), {corner, corner + Eigen::Vector3d::UnitX(),
                                               corner + Eigen::Vector3d::UnitY(), corner + Eigen::Vector3d::UnitZ()});
    mesh.tets.push_back({first, first + 1, first + 2, first + 3});
  }
  const auto nodes = mesh::lagrange_nodes(mesh, 3);
  ASSERT_EQ(nodes.positions.rows(), 1200);
  write_vtu(path("a.vtu"), nodes, {displacement(nodes)}, {{"frequency_hz", 1234.5}});
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
  write_vtu(path("b.vtu"), nodes, {displacement(nodes)}, {{"frequency_hz", 1234.5}});
  std::locale::global(before);
  EXPECT_EQ(core::read_file(path("a.vtu")), core::read_file(path("b.vtu")));
}

TEST_F(Vtu, HasWideHeadersAndNothingThatXmlForbids) {
  const auto nodes = mesh::lagrange_nodes(three_tets(), 2);
  write_vtu(path("mode.vtu"), nodes, {displacement(nodes)});
  const std::string text = core::read_file(path("mode.vtu"));
  EXPECT_NE(text.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(text.find("<AppendedData encoding=\"base64\">"), std::string::npos);
  for (const char c : text) ASSERT_TRUE(c == '\n' || (c >= 0x20 && c < 0x7F));
}

TEST_F(Vtu, IsNotWrittenFromABrokenField) {
  const auto nodes = mesh::lagrange_nodes(three_tets(), 2);
  auto field = displacement(nodes);
  field.values(3, 1) = std::nan("");
  EXPECT_THROW(write_vtu(path("mode.vtu"), nodes, {field}), core::NumericalError);
  field.values.conservativeResize(4, 3);
  EXPECT_THROW(write_vtu(path("mode.vtu"), nodes, {field}), core::InputError);
  EXPECT_THROW(write_vtu(path("mode.vtu"), nodes, {}, {{"frequency_hz", std::nan("")}}), core::NumericalError);
  EXPECT_THROW(write_vtu(path("absent/mode.vtu"), nodes), core::DataError);
  EXPECT_TRUE(is_empty());
}

TEST_F(Vtu, CollectionNamesItsFilesEscaped) {
  write_pvd(path("part.pvd"), {{1.0, "part_mode_01.vtu"}, {2.5, "a&\"b\".vtu"}});
  const std::string text = core::read_file(path("part.pvd"));
  EXPECT_NE(text.find("<DataSet timestep=\"1\" part=\"0\" file=\"part_mode_01.vtu\"/>"), std::string::npos);
  EXPECT_NE(text.find("timestep=\"2.5\" part=\"0\" file=\"a&amp;&quot;b&quot;.vtu\""), std::string::npos);
  EXPECT_THROW(write_pvd(path("x.pvd"), {{std::nan(""), "a.vtu"}}), core::NumericalError);
}

}  // namespace thinwall::io::test::vtu_test
