#pragma once
// Meshes and mode shapes for ParaView: VTK's XML format for unstructured grids.

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "mesh/lagrange_nodes.hpp"

namespace thinwall::io {

/// A vector at every node (nodes × 3, part axes), such as the displacement of a mode.
struct NodeVectors {
  std::string name;
  Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> values;
};

/// Throws InputError if the field has another number of rows than there are nodes, NumericalError if one of its values
/// is not finite.
void require_sound(const NodeVectors& field, Eigen::Index nodes);

/// A number that belongs to the whole file, such as "frequency_hz", which is written to the field data.
struct FieldNumber {
  std::string name;
  double value = 0.0;
};

/// Writes nodes and elements of any order with vectors at the nodes: VTK_TETRA for order 1, VTK_QUADRATIC_TETRA for 2,
/// VTK_LAGRANGE_TETRAHEDRON above; appended base64 data (so that the file is well-formed XML), UInt64 headers (for more
/// than 4 GiB), zlib. The file is written in one step. Throws InputError if a field has another number of rows than
/// there are nodes, NumericalError if one of its values is not finite, DataError if the file cannot be written. Cost
/// O(nodes + elements).
void write_vtu(const std::filesystem::path& path, const mesh::LagrangeNodes& nodes,
               const std::vector<NodeVectors>& vectors = {}, const std::vector<FieldNumber>& numbers = {});

/// For each node of VTK's tetrahedron of this order, in VTK's order, the index of the same node in
/// mesh::lattice(order).
[[nodiscard]] std::vector<int> vtk_node_order(int order);

}  // namespace thinwall::io
