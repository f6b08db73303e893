#pragma once
// The lines of an input file of Abaqus or CalculiX, with those of the files that it includes in their places.

#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/solid/labelled_mesh.hpp"

namespace thinwall::io {

/// A function that returns the bytes of an included file. Throws DataError if it cannot be read.
using InpInclude = std::function<std::string(const std::filesystem::path&)>;

/// The bytes of a plain file on the disk; what is none, such as a device or a pipe, is refused with DataError.
[[nodiscard]] std::string included_file(const std::filesystem::path& path);

/// The lines of a file and of those that it includes, one by one. They have running numbers, from 1, through all of the
/// files; mesh::LabelledMesh::origins leads from such a number to file and line.
class InpLines {
 public:
  /// The lines of these bytes, which must outlive it. Faults are told with `mesh`.path as the file's name, and the
  /// origins of lines are written there.
  InpLines(std::string_view bytes, InpInclude include, mesh::LabelledMesh& mesh);

  /// The next line without blanks around it; empty lines and comments are passed over. False at the end.
  [[nodiscard]] bool next(std::string_view& line);

  /// Continues with the lines of an included file. Its name is relative to the folder of the first file, as Abaqus and
  /// CalculiX take it if they are started there. Throws DataError for a file that is not there, that includes itself,
  /// that has nodes or elements and is included again, more than ten files within each other, and more than a thousand.
  void include(const std::string& name);

  /// The running number of the line, for mesh::fail_at().
  [[nodiscard]] int number() const { return number_; }
  /// The included files, each once.
  [[nodiscard]] std::vector<std::filesystem::path> included() const { return {known_.begin(), known_.end()}; }

 private:
  /// A file that is read: its lines follow those of the one below it in the stack.
  struct OpenFile {
    std::filesystem::path path;
    std::string bytes;  ///< of an included file
    std::size_t at = 0;
    std::int64_t line = 0;
    std::size_t mesh_size = 0;  ///< the nodes and elements before it
  };

  [[nodiscard]] std::string_view text(const OpenFile& file) const;
  void note_origin();
  void close();

  std::string_view bytes_;
  InpInclude include_;
  mesh::LabelledMesh& mesh_;
  std::deque<OpenFile> open_;  ///< a deque keeps a line in its place while another file is opened
  std::set<std::filesystem::path> known_;
  std::set<std::filesystem::path> with_mesh_;  ///< included files that have nodes or elements
  int inclusions_ = 0;
  int number_ = 0;
};

/// The text without blanks at its ends.
[[nodiscard]] std::string_view without_blanks(std::string_view text);

}  // namespace thinwall::io
