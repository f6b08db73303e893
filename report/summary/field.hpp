#pragma once
// Fields of the sections of summary.json. A section is a plain struct with one list of its fields beside it,
//
//     template <class Visitor, Either<ModeSummary> Section>
//     void fields(Visitor& visit, Section& mode) {
//       visit(Field{"frequency_hz", Kind::frequency, "natural frequency"}, mode.frequency_hz);
//     }
//
// from which follow the JSON (write_json.hpp), the reader (summary_json.cpp), the published schema and the kinds by
// which two results are compared (summary_schema.hpp). A member is a number, a text, a truth value, an
// enumeration with words (core/words.hpp), a Vector3d, a section, a list of these, or a std::optional of one of them.

#include <Eigen/Core>
#include <concepts>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/words.hpp"
#include "report/summary/quantity_kind.hpp"

namespace thinwall::report {

/// The ways of writing a value that a run does not have.
enum class Presence {
  by_type,  ///< a std::optional without a value is absent; everything else is there
  or_null,  ///< a std::optional without a value is null; its key is there
  if_any    ///< an empty list is absent
};

/// The name of a field in JSON, its kind and its meaning, a phrase that a person understands without the key.
struct Field {
  std::string_view key;
  Kind kind;
  std::string_view meaning;
  Presence presence = Presence::by_type;
};

/// The section itself or its const form, so that one list of fields serves writing and reading.
template <class Given, class Section>
concept Either = std::same_as<std::remove_const_t<Given>, Section>;

/// Visits nothing: the concept below asks with it whether a type has a list of fields.
struct NoVisitor {
  template <class T>
  void operator()(const Field&, T&) const {}
};

/// A struct with a list of fields.
template <class T>
concept IsSection = requires(NoVisitor& visit, T& section) {
  fields(visit, section);
};

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

/// An enumeration with words, as which its values are written.
template <class T>
concept IsWord = std::is_enum_v<T> && !core::words<T>.empty();

template <class T>
inline constexpr bool is_list = false;
template <class T>
inline constexpr bool is_list<std::vector<T>> = true;

}  // namespace thinwall::report
