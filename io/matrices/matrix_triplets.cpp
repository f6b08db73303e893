#include "io/matrices/matrix_triplets.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "io/matrices/matrix_entries.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

using dynamics::NodeDof;

/// The text with blanks in place of commas, which is unambiguous because no field of these lines is empty.
std::string without_commas(std::string_view bytes) {
  std::string text(bytes);
  std::replace(text.begin(), text.end(), ',', ' ');
  return text;
}

/// The first word of the next line that is neither empty nor begins with '*'.
std::string_view first_word(SurfaceText& text) {
  std::string_view word = text.word();
  while (word.starts_with('*')) {
    text.skip_line();
    word = text.word();
  }
  return word;
}

void require_end_of_line(SurfaceText& text, const char* form) {
  const std::string_view more = text.word_of_line();
  if (!more.empty()) text.fail(quoted(more) + " follows where the line ends, of the form \"" + form + "\"");
}

NodeDof dof(SurfaceText& text, std::string_view node_word) {
  const auto node = static_cast<int>(text.whole_number(node_word, "a node", -largest_label, largest_label));
  const auto component =
      static_cast<int>(text.whole_number(text.word_of_line(), "a component (1 to 6, or 0 for an amplitude)", 0, 6));
  return {node, component};
}

}  // namespace

int fields_of_first_line(std::string_view bytes) {
  const auto start = bytes.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return 0;
  // These bytes suffice for the comments of a heading and one line; a large file is not copied.
  const std::string head = without_commas(bytes.substr(start, 10000));
  SurfaceText text(head, "", '\0');
  int count = first_word(text).empty() ? 0 : 1;
  while (count > 0 && !text.word_of_line().empty()) ++count;
  return count;
}

MatrixEntries triplet_entries(std::string_view bytes, const std::string& name) {
  const std::string plain = without_commas(bytes);
  SurfaceText text(plain, name, '\0');
  MatrixEntries matrix{name, 0, {}};
  for (std::string_view word = first_word(text); !word.empty(); word = first_word(text)) {
    const auto row = static_cast<int>(text.whole_number(word, "a row", 1, largest_label) - 1);
    const auto column = static_cast<int>(text.whole_number(text.word_of_line(), "a column", 1, largest_label) - 1);
    const double value = text.number(text.word_of_line(), "an entry");
    require_end_of_line(text, "row column value");
    matrix.size = std::max({matrix.size, row + 1, column + 1});
    matrix.entries.push_back({row, column, value, text.line()});
  }
  if (matrix.entries.empty()) text.fail("holds no entry");
  return matrix;
}

LabelledEntries labelled_triplets(std::string_view bytes, const std::string& name) {
  const std::string plain = without_commas(bytes);
  SurfaceText text(plain, name, '\0');
  LabelledEntries matrix{name, {}, {}};
  for (std::string_view word = first_word(text); !word.empty(); word = first_word(text)) {
    const NodeDof row = dof(text, word);
    const NodeDof column = dof(text, text.word_of_line());
    const double value = text.number(text.word_of_line(), "an entry");
    require_end_of_line(text, "row node, component, column node, component, value");
    matrix.entries.push_back({row, column, value, text.line()});
  }
  if (matrix.entries.empty()) text.fail("holds no entry");
  return matrix;
}

std::vector<NodeDof> ccx_dofs(std::string_view bytes, const std::string& name) {
  SurfaceText text(bytes, name, '\0');
  std::vector<NodeDof> dofs;
  for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
    const auto point = word.find('.');
    if (point == std::string_view::npos) text.fail(quoted(word) + " where \"node.component\" belongs");
    const auto node = text.whole_number(word.substr(0, point), "a node", 1, largest_label);
    const auto component = text.whole_number(word.substr(point + 1), "a component", 1, 6);
    require_end_of_line(text, "node.component");
    dofs.push_back({static_cast<int>(node), static_cast<int>(component)});
  }
  if (dofs.empty()) text.fail("holds no DOF");
  return dofs;
}

}  // namespace thinwall::io
