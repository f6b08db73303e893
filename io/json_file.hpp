#pragma once
// JSON files of ours: read with every value checked, written whatever bytes a name has.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace thinwall::io {

/// The document of a file. Throws DataError naming the file if it cannot be read, is no JSON, or lists and objects are
/// more than 100 deep in each other.
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& file);

/// The document as text, indented, with a line's end behind it. Bytes that are no UTF-8 (a folder's name may have them)
/// become U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::json& document);

/// json_text() to a file; throws as core::write_file_atomically().
void write_json(const std::filesystem::path& file, const nlohmann::json& document);

/// A value of a document and where it stands there. Every function throws DataError with file, place, what is there and
/// what is expected, if the value is of another kind. The document must outlive it.
struct JsonValue {
  const nlohmann::json* json;
  std::string file;
  std::string place;  ///< "axes[0].key"; "" is the document

  /// True if the object has this key, with something else than null.
  [[nodiscard]] bool has(const std::string& key) const;
  /// The value of this key of the object.
  [[nodiscard]] JsonValue at(const std::string& key) const;
  /// The entries of the list.
  [[nodiscard]] std::vector<JsonValue> items() const;
  /// The text.
  [[nodiscard]] std::string text() const;
  /// The entries of a list of texts.
  [[nodiscard]] std::vector<std::string> texts() const;
  /// The number.
  [[nodiscard]] double number() const;
  /// The entries of a list of numbers.
  [[nodiscard]] std::vector<double> numbers() const;
  /// Throws: "file": place `what`, and the remedy.
  [[noreturn]] void refuse(const std::string& what) const;
  /// The whole number, from `lower` to `upper`.
  [[nodiscard]] int integer(int lower, int upper) const;
};

/// The kind of a value in few words: "a number", "a list of 3", "an object with name, value and 4 more".
[[nodiscard]] std::string kind_of(const nlohmann::json& value);

}  // namespace thinwall::io
