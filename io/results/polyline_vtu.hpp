#pragma once
// Lines through points, with numbers on each line: an arm in many postures, for ParaView.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace thinwall::io {

/// A number of every line, in their order.
struct LineNumbers {
  std::string name;
  std::vector<double> values;
};

/// Writes each line (3 × points, m) as a VTK_POLY_LINE, one of a single point as a VTK_VERTEX, with its numbers as cell
/// data; zlib, UInt64 headers. Written in one step. Throws InputError if there is no line, one has no point, or numbers
/// are not as many as lines; NumericalError for a position that is not finite; DataError if the file cannot be written.
void write_polylines(const std::filesystem::path& path, const std::vector<Eigen::Matrix3Xd>& lines,
                     const std::vector<LineNumbers>& numbers);

}  // namespace thinwall::io
