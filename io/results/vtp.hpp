#pragma once
// The surface of a part with its mode shapes, light enough to mail: VTK's XML format for polygons.

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "io/results/vtu.hpp"
#include "mesh/faceted_surface.hpp"
#include "mesh/lagrange_nodes.hpp"

namespace thinwall::io {

/// A number of every triangle, such as mesh::wall_thickness in m.
struct TriangleNumbers {
  std::string name;
  std::vector<double> values;
};

/// Writes flat triangles between nodes (mesh::surface_triangles) with vectors at the nodes that they use, in single
/// precision, and numbers on the triangles, compressed; all vectors in one file, so that a viewer switches between
/// modes without opening another. The whole nodes and vectors are passed (nodes × 3), what the triangles do not use is
/// left out. Written in one step. Throws as write_vtu(), and InputError for numbers that are not as many as triangles.
void write_vtp(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes,
               const std::vector<std::array<int, 3>>& triangles, const std::vector<NodeVectors>& vectors,
               const std::vector<TriangleNumbers>& numbers = {});

/// Writes a surface, positions in single precision, with numbers on its triangles in double precision. Written in one
/// step. Throws InputError if numbers are not as many as triangles, NumericalError if one is not finite, DataError if
/// the file cannot be written. Cost O(triangles).
void write_vtp(const std::filesystem::path& path, const mesh::TriangleSurface& surface,
               const std::vector<TriangleNumbers>& numbers);

/// A surface with what is known at its vertices (vertices × 3) and on its triangles.
struct SurfaceFields {
  mesh::TriangleSurface surface;
  std::vector<NodeVectors> vectors;
  std::vector<TriangleNumbers> numbers;
};

/// Reads what write_vtp wrote; arrays of other shapes are passed over. Throws DataError, naming the file, for one that
/// cannot be read, is no surface of triangles or names a vertex that it does not have.
[[nodiscard]] SurfaceFields read_vtp(const std::filesystem::path& path);

}  // namespace thinwall::io
