#include "io/results/vtp.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::io {

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

/// The nodes that triangles use, in order of first use, and the number of each among them (−1: not used).
struct UsedNodes {
  std::vector<int> nodes;
  std::vector<vtkIdType> number;
};

UsedNodes used_by(const std::vector<std::array<int, 3>>& triangles, Eigen::Index count) {
  UsedNodes used{{}, std::vector<vtkIdType>(static_cast<std::size_t>(count), -1)};
  for (const auto& triangle : triangles) {
    for (const int node : triangle) {
      vtkIdType& number = used.number[static_cast<std::size_t>(node)];
      if (number >= 0) continue;
      number = static_cast<vtkIdType>(used.nodes.size());
      used.nodes.push_back(node);
    }
  }
  return used;
}

vtkNew<vtkFloatArray> single_precision(const Rows& values, const UsedNodes& used, const char* name) {
  vtkNew<vtkFloatArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(used.nodes.size()));
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i) {
    const auto row = values.row(used.nodes[static_cast<std::size_t>(i)]);
    array->SetTuple3(i, row.x(), row.y(), row.z());
  }
  return array;
}

/// Writes the surface as appended base64 data with UInt64 headers and zlib.
void write(const std::filesystem::path& path, vtkPolyData& surface) {
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputData(&surface);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(1);  // speed before size
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw core::DataError("VTK could not encode the surface");
  core::write_file_atomically(path, writer->GetOutputString());
}

vtkNew<vtkDoubleArray> of_whole(const FieldNumber& number) {
  if (!std::isfinite(number.value)) throw core::NumericalError("the field value \"" + number.name + "\" is not finite");
  vtkNew<vtkDoubleArray> array;
  array->SetName(number.name.c_str());
  array->InsertNextValue(number.value);
  return array;
}

vtkNew<vtkDoubleArray> on_triangles(const TriangleNumbers& field, std::size_t triangles) {
  if (field.values.size() != triangles) {
    throw core::InputError("the field \"" + field.name + "\" has " + std::to_string(field.values.size()) +
                           " values for " + std::to_string(triangles) + " triangles");
  }
  if (!std::all_of(field.values.begin(), field.values.end(), [](double value) { return std::isfinite(value); }))
    throw core::NumericalError("the field \"" + field.name + "\" holds NaN or infinity");
  vtkNew<vtkDoubleArray> array;
  array->SetName(field.name.c_str());
  for (const double value : field.values) array->InsertNextValue(value);
  return array;
}

}  // namespace

void write_vtp(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes,
               const std::vector<std::array<int, 3>>& triangles, const std::vector<NodeVectors>& vectors,
               const std::vector<TriangleNumbers>& numbers, const std::vector<FieldNumber>& of_file) {
  const UsedNodes used = used_by(triangles, nodes.positions.rows());
  vtkNew<vtkPolyData> surface;
  vtkNew<vtkPoints> points;
  points->SetData(single_precision(nodes.positions, used, "points").Get());
  surface->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : triangles) {
    cells->InsertNextCell(3);
    for (const int node : triangle) cells->InsertCellPoint(used.number[static_cast<std::size_t>(node)]);
  }
  surface->SetPolys(cells);
  for (const NodeVectors& field : vectors) {
    require_sound(field, nodes.positions.rows());
    surface->GetPointData()->AddArray(single_precision(field.values, used, field.name.c_str()).Get());
  }
  if (!vectors.empty()) surface->GetPointData()->SetActiveVectors(vectors.front().name.c_str());
  for (const TriangleNumbers& field : numbers)
    surface->GetCellData()->AddArray(on_triangles(field, triangles.size()).Get());
  for (const FieldNumber& number : of_file) surface->GetFieldData()->AddArray(of_whole(number).Get());
  write(path, *surface);
}

void write_vtp(const std::filesystem::path& path, const mesh::TriangleSurface& surface,
               const std::vector<TriangleNumbers>& numbers) {
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  for (const auto& x : surface.vertices) points->InsertNextPoint(x.data());
  data->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  for (const auto& triangle : surface.triangles) {
    cells->InsertNextCell(3);
    for (const int vertex : triangle) cells->InsertCellPoint(vertex);
  }
  data->SetPolys(cells);
  for (const TriangleNumbers& field : numbers)
    data->GetCellData()->AddArray(on_triangles(field, surface.triangles.size()).Get());
  if (!numbers.empty()) data->GetCellData()->SetActiveScalars(numbers.front().name.c_str());
  write(path, *data);
}

namespace {

[[noreturn]] void no_surface(const std::filesystem::path& path, const std::string& why) {
  throw core::DataError(path.string() + ": not a surface as thinwall writes it: " + why);
}

mesh::TriangleSurface triangles_of(vtkPolyData& data, const std::filesystem::path& path) {
  mesh::TriangleSurface surface;
  const vtkIdType vertices = data.GetNumberOfPoints();
  for (vtkIdType v = 0; v < vertices; ++v) surface.vertices.emplace_back(data.GetPoint(v));
  vtkNew<vtkIdList> cell;
  vtkCellArray& cells = *data.GetPolys();
  for (cells.InitTraversal(); cells.GetNextCell(cell) != 0;) {
    if (cell->GetNumberOfIds() != 3) no_surface(path, "a polygon is no triangle");
    std::array<int, 3> triangle{};
    for (vtkIdType k = 0; k < 3; ++k) {
      if (cell->GetId(k) < 0 || cell->GetId(k) >= vertices)
        no_surface(path, "a triangle names a vertex that is missing");
      triangle[static_cast<std::size_t>(k)] = static_cast<int>(cell->GetId(k));
    }
    surface.triangles.push_back(triangle);
  }
  return surface;
}

std::string name_of(vtkDataArray& array) {
  return array.GetName() == nullptr ? "" : array.GetName();
}

}  // namespace

SurfaceFields read_vtp(const std::filesystem::path& path) {
  const std::string bytes = core::read_file(path);
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(bytes);
  reader->GlobalWarningDisplayOff();
  reader->Update();
  if (reader->GetErrorCode() != 0 || reader->GetOutput() == nullptr || reader->GetOutput()->GetNumberOfPolys() == 0)
    no_surface(path, "VTK cannot read it");
  vtkPolyData& data = *reader->GetOutput();
  SurfaceFields fields{triangles_of(data, path), {}, {}, {}};
  const auto vertices = static_cast<vtkIdType>(fields.surface.vertices.size());
  const auto triangles = static_cast<vtkIdType>(fields.surface.triangles.size());
  for (int i = 0; i < data.GetPointData()->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetPointData()->GetArray(i);
    if (array == nullptr || array->GetNumberOfComponents() != 3 || array->GetNumberOfTuples() != vertices) continue;
    NodeVectors field{name_of(*array), {}};
    field.values.resize(vertices, 3);
    for (vtkIdType v = 0; v < vertices; ++v) array->GetTuple(v, field.values.row(v).data());
    fields.vectors.push_back(std::move(field));
  }
  for (int i = 0; i < data.GetCellData()->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetCellData()->GetArray(i);
    if (array == nullptr || array->GetNumberOfComponents() != 1 || array->GetNumberOfTuples() != triangles) continue;
    TriangleNumbers field{name_of(*array), {}};
    for (vtkIdType t = 0; t < triangles; ++t) field.values.push_back(array->GetTuple1(t));
    fields.numbers.push_back(std::move(field));
  }
  for (int i = 0; i < data.GetFieldData()->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = data.GetFieldData()->GetArray(i);
    if (array != nullptr && array->GetNumberOfValues() == 1)
      fields.of_file.push_back({name_of(*array), array->GetTuple1(0)});
  }
  return fields;
}

}  // namespace thinwall::io
