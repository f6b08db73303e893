#pragma once
// The list in which a check puts what it finds.

#include <string>
#include <vector>

#include "case/problem.hpp"
#include "case/values.hpp"

namespace thinwall::cases {

/// Gathers problems, each placed at the key it is about (or at the first key of its table).
struct Findings {
  const CaseValues& values;
  std::vector<Problem> problems;

  /// "key: text" at the place of the key.
  void report(const std::string& key, const std::string& text);

  /// True if the case gives a value to this key, or a default fills it.
  [[nodiscard]] bool given(const std::string& key) const { return find(values, key) != nullptr; }

  /// True if the case's text gives a value to this key: no default, nothing told by other keys.
  [[nodiscard]] bool written(const std::string& key) const;

  /// True if the key was given a text that stands for nothing it takes, which is reported already.
  [[nodiscard]] bool unreadable(const std::string& key) const;

  /// True if something was found about this key.
  [[nodiscard]] bool reported(const std::string& key) const;

  /// Reports unless `name` is among `known`, naming the nearest; an empty name was reported before.
  void require_known(const std::string& key, const std::string& name, const std::vector<std::string>& known,
                     const std::string& what);
};

/// The key of an item of an array of tables: "contacts[0]".
[[nodiscard]] std::string indexed(const std::string& table, std::size_t index);

}  // namespace thinwall::cases
