#pragma once
// The one table of what a case file may say: names, types, dimensions, bounds, defaults, meanings. The reader validates
// by it, the writer fills defaults from it, docs/case-file.md is printed from it.
//
// A path is dotted; `[]` marks an array of tables, `*` a table that the user names: "part.supports[].on",
// "points.*.at".

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/units.hpp"

namespace thinwall::cases {

/// The type of a key's value.
enum class Type {
  text,        ///< any string
  file,        ///< path of a data file, relative to the case's folder
  choice,      ///< one of `choices`
  name,        ///< name of something else in the case
  names,       ///< list of names, or one; of `choices` where there are any
  boolean,     ///< true or false
  integer,     ///< whole number
  quantity,    ///< number with the key's dimension
  quantities,  ///< list of them, or one
  vector,      ///< three quantities along x, y, z
  polygon,     ///< list of corners, each two quantities along x, y
  positions,   ///< list of positions, each three quantities along x, y, z
  direction,   ///< "x", "-y" or three numbers, made a unit vector
  directions,  ///< list of directions, or one
  amount,      ///< quantity whose dimension follows from another key of the same table
};

/// Closed interval unless marked open; `hint` is the remedy shown when a value lies outside.
struct Bounds {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool lower_open = false;
  bool upper_open = false;
  bool infinity_allowed = false;
  std::string_view hint;
};

/// A key of the file with all that is known of it.
struct Key {
  std::string_view path;
  Type type;
  core::QuantityKind kind;
  std::string_view fallback;  ///< default as TOML text, "" for none
  Bounds bounds;
  std::string_view choices;  ///< separated by '|'; words that may stand in place of a number or quantity
  std::string_view meaning;
  bool required = false;  ///< wherever its table stands
};

/// A table of the file. `implied_by` names a key whose presence brings the table in with its defaults, or several,
/// separated by '|', of which one is enough.
struct Section {
  std::string_view path;
  std::string_view meaning;
  std::string_view implied_by;
};

/// A key or table of an alternative: it may stand only where another key, the chooser, has one of certain words.
struct Belonging {
  std::string_view path;         ///< of the key or table, "contacts[].ball"; a table goes before what it holds
  std::string_view chooser;      ///< a key of the same table or of one around it, "contacts[].model"
  std::string_view words;        ///< the chooser's words, separated by '|'
  bool needed = false;           ///< must be given with each of these words
  std::string_view unless = {};  ///< a key of the same table that gives it, too
};

/// The word of a chooser that is not given, told by another key that is. The first that applies counts.
struct Telling {
  std::string_view chooser;
  std::string_view word;
  std::string_view by;            ///< keys or tables, separated by '|', of which one is enough
  std::string_view endings = {};  ///< of the file that the key names, separated by '|'; any if empty
};

/// The tables and keys that one kind of file may have, and which of them belong to which alternative.
struct Schema {
  std::span<const Section> sections;
  std::span<const Key> keys;
  std::span<const Belonging> belongings = {};
  std::span<const Telling> tellings = {};
};

/// Schema of case.toml.
[[nodiscard]] const Schema& case_schema();

/// Schema of expected.toml.
[[nodiscard]] const Schema& expectation_schema();

/// Schema of the file of joints beside a URDF.
[[nodiscard]] const Schema& joints_schema();

/// The key or section of that pattern; nullptr if there is none.
[[nodiscard]] const Key* find_key(const Schema& schema, std::string_view pattern);
/// The section of that pattern; nullptr if there is none.
[[nodiscard]] const Section* find_section(const Schema& schema, std::string_view pattern);

/// Names that may follow `pattern` ("" for the top level), in the order of the table; "*" where the user names.
[[nodiscard]] std::vector<std::string> names_below(const Schema& schema, std::string_view pattern);

/// Pattern of a concrete path: "points.P.at" → "points.*.at", "contacts[2].part" → "contacts[].part"; a trailing index
/// into a list of numbers is dropped ("damping.ratios[0]" → "damping.ratios").
[[nodiscard]] std::string pattern_of(const Schema& schema, std::string_view path);

/// `path` itself if it is a key of the schema; else the one full path that has the same first and last names with
/// tables left out between them ("part.element_size" → "part.mesh.element_size"); else `path`.
[[nodiscard]] std::string full_path(const Schema& schema, const std::string& path);

/// Choices of a key, and keys that imply a section, as separate words.
[[nodiscard]] std::vector<std::string> choices(const Key& key);
/// The keys whose presence brings a section in, as separate words.
[[nodiscard]] std::vector<std::string> implying_keys(const Section& section);

/// The words of a list that is separated by '|'.
[[nodiscard]] std::vector<std::string> words_of(std::string_view list);

/// The part of a path before its last dot: "contacts[].ball" of "contacts[].ball.radius"; "" of a name alone.
[[nodiscard]] std::string_view table_of(std::string_view path);
/// The part of a path after its last dot.
[[nodiscard]] std::string_view last_name(std::string_view path);

/// "0 < ν < 0.5" as text: "above 0, below 0.5"; "" if unbounded.
[[nodiscard]] std::string bounds_text(const Key& key);

/// Throws InputError with the value, the bound and the remedy unless the number lies within the key's bounds and is one
/// that its kind of quantity can have.
void require_within_bounds(const Key& key, double value);

/// The tables of docs/case-file.md, one a section, as Markdown.
[[nodiscard]] std::string schema_markdown(const Schema& schema);

}  // namespace thinwall::cases
