#pragma once
// An input file of Abaqus or CalculiX in its own numbers, before it becomes a mesh (io/inp.hpp).

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::io {

/// A line of *NODE: the node's number, where it stands, its position in m.
struct InpTextNode {
  int label = 0;
  int line = 0;
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
};

/// An element of *ELEMENT: its number, where it starts, its nodes' numbers (the first four, or all ten).
struct InpTextElement {
  int label = 0;
  int line = 0;
  std::array<int, 10> nodes{};
};

/// Labels first, first + step, ... up to last; of a range by GENERATE some may be absent.
struct InpLabelRange {
  int first = 0;
  int last = 0;
  int step = 1;
  int line = 0;
  bool gaps_allowed = false;
};

/// Nodes, elements and sets in the order of the file; names in capitals.
struct InpText {
  std::string path;
  std::vector<InpTextNode> nodes;
  std::vector<InpTextElement> elements;
  int order = 0;  ///< 1 for C3D4, 2 for C3D10, 0 without elements
  std::map<std::string, std::vector<InpLabelRange>> sets;
};

/// Number of nodes of an element of this order: 4 or 10.
[[nodiscard]] constexpr std::size_t inp_node_count(int order) {
  return order == 1 ? 4 : 10;
}

/// Reads the lines, coordinates times `metres_per_unit`. Throws DataError with file and line for whatever a line alone
/// can have wrong (io/inp.hpp lists it). Cost O(bytes).
[[nodiscard]] InpText read_inp_text(const std::filesystem::path& path, double metres_per_unit);

/// Throws DataError "file.inp:12: what".
[[noreturn]] void fail_at(const InpText& text, int line, const std::string& what);

/// a…z to A…Z, whatever the locale: the format's names do not depend on case.
[[nodiscard]] std::string capitals(std::string_view text);

}  // namespace thinwall::io
