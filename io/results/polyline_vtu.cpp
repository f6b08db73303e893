#include "io/results/polyline_vtu.hpp"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::io {

namespace {

void require_sound(const std::vector<Eigen::Matrix3Xd>& lines, const std::vector<LineNumbers>& numbers) {
  if (lines.empty()) throw core::InputError("there is no line to write");
  for (const Eigen::Matrix3Xd& line : lines) {
    if (line.cols() == 0) throw core::InputError("a line to write has no point");
    if (!line.allFinite()) throw core::NumericalError("a line to write holds a position that is not finite");
  }
  for (const LineNumbers& number : numbers) {
    if (number.values.size() != lines.size()) {
      throw core::InputError("\"" + number.name + "\" has " + std::to_string(number.values.size()) + " numbers for " +
                             std::to_string(lines.size()) + " lines");
    }
  }
}

void add_line(const Eigen::Matrix3Xd& line, vtkPoints& points, vtkUnstructuredGrid& grid) {
  std::vector<vtkIdType> ids;
  for (Eigen::Index i = 0; i < line.cols(); ++i) ids.push_back(points.InsertNextPoint(line.col(i).data()));
  grid.InsertNextCell(ids.size() == 1 ? VTK_VERTEX : VTK_POLY_LINE, static_cast<vtkIdType>(ids.size()), ids.data());
}

}  // namespace

void write_polylines(const std::filesystem::path& path, const std::vector<Eigen::Matrix3Xd>& lines,
                     const std::vector<LineNumbers>& numbers) {
  require_sound(lines, numbers);
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  grid->AllocateExact(static_cast<vtkIdType>(lines.size()), static_cast<vtkIdType>(lines.size()));
  for (const Eigen::Matrix3Xd& line : lines) add_line(line, *points, *grid);
  grid->SetPoints(points);
  for (const LineNumbers& number : numbers) {
    vtkNew<vtkDoubleArray> array;
    array->SetName(number.name.c_str());
    for (const double value : number.values) array->InsertNextValue(value);
    grid->GetCellData()->AddArray(array);
  }
  if (!numbers.empty()) grid->GetCellData()->SetActiveScalars(numbers.front().name.c_str());
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetInputData(grid);
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOn();
  writer->SetHeaderTypeToUInt64();
  writer->SetCompressorTypeToZLib();
  writer->WriteToOutputStringOn();
  if (writer->Write() == 0) throw core::DataError("VTK could not encode the lines");
  core::write_file_atomically(path, writer->GetOutputString());
}

}  // namespace thinwall::io
