#pragma once
// The surface of a part with its mode shapes as a small file in VTK's XML format for polygons.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "io/results/vtu.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::io {

/// One number for each triangle, such as mesh::wall_thickness() in m.
struct TriangleNumbers {
  std::string name;
  std::vector<double> values;
};

/// Writes flat triangles between nodes (mesh::surface_triangles()) with vectors at the nodes that they use, in single
/// precision, and numbers on the triangles, compressed. All vectors are in one file, so that a viewer can change
/// between modes without opening another. nodes and vectors (nodes × 3) are those of the whole mesh; nodes that the
/// triangles do not use are left out. `of_file` are numbers of the whole file. The file is written in one step. Throws
/// as write_vtu() does, and InputError if there are not as many numbers as triangles.
void write_vtp(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes,
               const std::vector<std::array<int, 3>>& triangles, const std::vector<NodeVectors>& vectors,
               const std::vector<TriangleNumbers>& numbers = {}, const std::vector<FieldNumber>& of_file = {});

/// Writes a surface, positions in single precision, with numbers on its triangles in double precision. The file is
/// written in one step. Throws InputError if there are not as many numbers as triangles, NumericalError if one is not
/// finite, DataError if the file cannot be written. Cost O(triangles).
void write_vtp(const std::filesystem::path& path, const mesh::TriangleSurface& surface,
               const std::vector<TriangleNumbers>& numbers);

/// A surface with vectors at its vertices (vertices × 3), numbers on its triangles, and numbers of the whole file.
struct SurfaceFields {
  mesh::TriangleSurface surface;
  std::vector<NodeVectors> vectors;
  std::vector<TriangleNumbers> numbers;
  std::vector<FieldNumber> of_file{};
};

/// Reads a file of write_vtp(); arrays of other shapes are skipped. Throws DataError, with the file, if it cannot be
/// read, contains no surface of triangles or refers to a vertex that does not exist.
[[nodiscard]] SurfaceFields read_vtp(const std::filesystem::path& path);

}  // namespace thinwall::io
