#pragma once
// Finished pieces of a run, kept beside its results so that the next run, or one that was interrupted, goes on from
// there.

#include <filesystem>
#include <map>
#include <mutex>
#include <string>

namespace thinwall::study {

/// Pieces of a result by name, in one file that grows as they are finished. They are of one key, which stands for all
/// that they follow from; a file of another key, another program or another format is begun anew, and one whose end is
/// damaged (an interruption while it was written) keeps what comes before. Threads may look and add side by side.
class Checkpoint {
 public:
  /// Keeps nothing and finds nothing.
  Checkpoint() = default;
  /// Reads what `file` holds under this key, unless `fresh`; the folder is made when something is added. A file that
  /// cannot be read or written is told in the log and does without.
  Checkpoint(std::filesystem::path file, const std::string& key, bool fresh);

  /// The bytes of a piece, null if it is not there.
  [[nodiscard]] const std::string* find(const std::string& name) const;
  /// Adds a piece and writes it at once. Cost: its bytes, hashed and written.
  void add(const std::string& name, std::string bytes);
  /// Writes the file again with its pieces in the order of their names, unless they are: threads add them in the order
  /// in which they finish, and two runs of one case leave equal files only so. Cost: all bytes, hashed and written.
  void arrange();

 private:
  void read(bool fresh);
  void write(const std::string& piece);
  void note_place_of(const std::string& name);

  mutable std::mutex mutex_;
  std::filesystem::path file_;
  std::string heading_;
  std::map<std::string, std::string> pieces_;
  std::string last_;    ///< the name of the last piece in the file
  bool begun_ = false;  ///< the file has this heading
  bool sorted_ = true;  ///< the pieces in the file are in the order of their names
};

}  // namespace thinwall::study
