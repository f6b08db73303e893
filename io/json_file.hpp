#pragma once
// JSON files of this program, read with every value checked.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace thinwall::io {

/// The document of a file. Throws DataError, with the file, if it cannot be read, is no JSON, or has lists and objects
/// nested more than 100 deep.
[[nodiscard]] nlohmann::json read_json(const std::filesystem::path& file);

/// The document as indented text that ends with a line end. Bytes that are no UTF-8 (which a folder's name may contain)
/// become U+FFFD.
[[nodiscard]] std::string json_text(const nlohmann::json& document);

/// Writes json_text() to a file. Throws as core::write_file_atomically() does.
void write_json(const std::filesystem::path& file, const nlohmann::json& document);

/// A value of a document and its place there. If the value is of another kind, every function throws DataError with
/// file, place, the kind found and the kind expected. The document must outlive it.
struct JsonValue {
  const nlohmann::json* json;
  std::string file;
  std::string place;  ///< "axes[0].key"; "" is the document

  /// True if the object has this key with a value other than null.
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
  /// Throws DataError with file and place, followed by `what`, which contains the remedy.
  [[noreturn]] void refuse(const std::string& what) const;
  /// The whole number, which must lie within `lower` to `upper`.
  [[nodiscard]] int integer(int lower, int upper) const;
};

/// The kind of a value in few words, such as "a number", "a list of 3", "an object with name, value and 4 more".
[[nodiscard]] std::string kind_of(const nlohmann::json& value);

}  // namespace thinwall::io
