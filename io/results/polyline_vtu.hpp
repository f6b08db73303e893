#pragma once
// Lines through points with numbers on each line, for ParaView, such as an arm in many postures.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace thinwall::io {

/// One number for each line, in their order.
struct LineNumbers {
  std::string name;
  std::vector<double> values;
};

/// Writes each line (3 × points, m) as a VTK_POLY_LINE, or as a VTK_VERTEX if it has a single point, with its numbers
/// as cell data; zlib, UInt64 headers. The file is written in one step. Throws InputError if there is no line, one has
/// no point, or there are not as many numbers as lines; NumericalError for a position that is not finite; DataError if
/// the file cannot be written.
void write_polylines(const std::filesystem::path& path, const std::vector<Eigen::Matrix3Xd>& lines,
                     const std::vector<LineNumbers>& numbers);

}  // namespace thinwall::io
