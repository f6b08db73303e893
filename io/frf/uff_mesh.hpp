#pragma once
// The geometry of a test or a model as a universal file: nodes (2411), elements (2412), trace lines (82).
//
// Layout: "Universal File Datasets Summary" (SDRC, I-DEAS).

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/frf/universal_file.hpp"

namespace thinwall::io {

namespace uff {
/// Descriptors of the elements that a drawing needs.
constexpr int linear_beam = 21;
constexpr int linear_triangle = 91;
constexpr int linear_quadrilateral = 94;
constexpr int linear_tetrahedron = 111;
}  // namespace uff

/// A node with its position in the part's axes, m.
struct UffNode {
  long label = 0;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
};

/// An element of data set 2412.
struct UffElement {
  long label = 0;
  int descriptor = uff::linear_triangle;
  std::vector<long> nodes;  ///< labels
};

/// A drawing: lines from node to node; a label 0 begins a new line.
struct UffTraceLine {
  long label = 0;
  std::string name = "NONE";
  std::vector<long> nodes;
};

/// Nodes, elements and trace lines of a file.
struct UffMesh {
  std::vector<UffNode> nodes;
  std::vector<UffElement> elements;
  std::vector<UffTraceLine> lines;
  UffNotes notes{};  ///< irregularities found when it was read
};

/// Writes data sets 151, 164 (SI), 2411 (coordinates with 17 digits), 2412 and one data set 82 for each trace line;
/// beams (descriptors 11 and 21 to 24) have neither orientation nor cross-sections. The file is written in one step.
/// Throws InputError if labels are not positive or above 9 digits, a node's label occurs twice, an element or a line
/// refers to an unknown node, a line has more than 250 nodes, or a position is not finite; DataError if the file cannot
/// be written.
void write_uff_mesh(const std::filesystem::path& path, const UffMesh& mesh);

/// The data sets of a test's geometry: nodes as data set 15 (positions with six digits), which every program of modal
/// tests reads, and the trace lines. Throws as write_uff_mesh().
[[nodiscard]] std::string test_geometry_text(const UffMesh& mesh);

/// Reads nodes (2411, and 15, their older form with six digits), elements and trace lines of a file; positions in m by
/// data set 164, or times `unit_in_m` if it is given. Elements or lines that refer to unknown nodes, and trace lines of
/// another length than stated, are noted. Throws DataError with file and line for a file without nodes or without a
/// unit, nodes in other coordinate systems than the global one (0 or 1), and fields that are no numbers. Memory and
/// cost O(bytes).
[[nodiscard]] UffMesh uff_mesh(std::string_view bytes, const std::string& source,
                               std::optional<double> unit_in_m = std::nullopt);

/// True if a file has a data set of nodes (2411 or 15), readable or not. Throws as universal_data_sets().
[[nodiscard]] bool has_uff_nodes(const std::filesystem::path& path);

/// The geometry of a file, as uff_mesh() gives it.
[[nodiscard]] UffMesh read_uff_mesh(const std::filesystem::path& path, std::optional<double> unit_in_m = std::nullopt);

}  // namespace thinwall::io
