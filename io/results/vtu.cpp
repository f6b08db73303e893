#include "io/results/vtu.hpp"

#include <vtkCellArray.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkHigherOrderTetra.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::io {

namespace {

int cell_type(int order) {
  if (order == 1) return VTK_TETRA;
  return order == 2 ? VTK_QUADRATIC_TETRA : VTK_LAGRANGE_TETRAHEDRON;
}

void set_geometry(vtkUnstructuredGrid& grid, const mesh::LagrangeNodes& nodes) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(nodes.positions.rows());
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) points->SetPoint(i, nodes.positions.row(i).data());
  grid.SetPoints(points);

  const std::vector<int> order = vtk_node_order(nodes.order);
  vtkNew<vtkCellArray> cells;
  std::vector<vtkIdType> cell(order.size());
  for (Eigen::Index element = 0; element < nodes.elements.rows(); ++element) {
    std::transform(order.begin(), order.end(), cell.begin(), [&](int local) { return nodes.elements(element, local); });
    cells->InsertNextCell(static_cast<vtkIdType>(cell.size()), cell.data());
  }
  grid.SetCells(cell_type(nodes.order), cells);
}

void add_vectors(vtkUnstructuredGrid& grid, const NodeVectors& field) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(field.values.rows());
  std::copy_n(field.values.data(), field.values.size(), array->GetPointer(0));
  grid.GetPointData()->AddArray(array);
}

void add_number(vtkUnstructuredGrid& grid, const FieldNumber& number) {
  if (!std::isfinite(number.value)) throw core::NumericalError("the field value \"" + number.name + "\" is not finite");
  vtkNew<vtkDoubleArray> array;
  array->SetName(number.name.c_str());
  array->InsertNextValue(number.value);
  grid.GetFieldData()->AddArray(array);
}

std::string xml_text(vtkUnstructuredGrid& grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(&grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // speed before size
  // The text is made in memory, so that the file appears in one step and a full disk is reported by this program.
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw core::DataError("VTK could not encode the mesh");
  return writer->GetOutputString();
}

}  // namespace

void require_sound(const NodeVectors& field, Eigen::Index nodes) {
  if (field.values.rows() != nodes) {
    throw core::InputError("the field \"" + field.name + "\" has " + std::to_string(field.values.rows()) +
                           " rows for " + std::to_string(nodes) + " nodes");
  }
  if (!field.values.allFinite()) throw core::NumericalError("the field \"" + field.name + "\" holds NaN or infinity");
}

std::vector<int> vtk_node_order(int order) {
  const auto lattice = mesh::lattice(order);
  std::map<std::array<int, 4>, int> local;
  for (const auto& alpha : lattice) local.emplace(alpha, static_cast<int>(local.size()));
  std::vector<int> result;
  for (std::size_t node = 0; node < lattice.size(); ++node) {
    std::array<vtkIdType, 4> b{};
    vtkHigherOrderTetra::BarycentricIndex(static_cast<vtkIdType>(node), b.data(), order);
    // VTK lists the coordinate of its first vertex last.
    const std::array alpha{static_cast<int>(b[3]), static_cast<int>(b[0]), static_cast<int>(b[1]),
                           static_cast<int>(b[2])};
    result.push_back(local.at(alpha));
  }
  return result;
}

void write_vtu(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes,
               const std::vector<NodeVectors>& vectors, const std::vector<FieldNumber>& numbers) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_geometry(*grid, nodes);
  for (const NodeVectors& field : vectors) {
    require_sound(field, nodes.positions.rows());
    add_vectors(*grid, field);
  }
  if (!vectors.empty()) grid->GetPointData()->SetActiveVectors(vectors.front().name.c_str());
  for (const FieldNumber& number : numbers) add_number(*grid, number);
  core::write_file_atomically(path, xml_text(*grid));
}

}  // namespace thinwall::io
