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

 private:
  void read(bool fresh);
  void write(const std::string& piece);

  mutable std::mutex mutex_;
  std::filesystem::path file_;
  std::string heading_;
  std::map<std::string, std::string> pieces_;
  bool begun_ = false;  ///< the file has this heading
};

}  // namespace thinwall::study
