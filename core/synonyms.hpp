#pragma once
// Words of the field for what the program calls by another name: a suggestion by meaning, before one by spelling.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace thinwall::core {

/// The kinds of words of which people know several.
enum class WordKind { key, word, unit, command, option };

/// Words for one thing: those that people write, separated by '|', and the one that is understood here.
struct Synonym {
  WordKind kind;
  std::string_view written;
  std::string_view meant;
  std::string_view remark = {};  ///< a clause for the page and for messages
};

/// The one table of synonyms.
[[nodiscard]] std::span<const Synonym> synonyms();

/// Every row whose written words hold `name`, in whatever case of letters; one word may have several meanings
/// ("damping": a ratio, or a coefficient), of which those among the known names count.
[[nodiscard]] std::vector<Synonym> meanings(std::string_view name);

/// The candidate that `name` means: the one that differs in the case of letters only, else one that a synonym of its
/// last part means ("cutting.ae": "cutting.radial_depth"), in its own table before another; "" if there is none.
[[nodiscard]] std::string meant_name(std::string_view name, const std::vector<std::string>& candidates);

/// The unit that `text` means ("1/min": "rpm"); "" if no synonym is one.
[[nodiscard]] std::string meant_unit(std::string_view text);

/// The table of synonyms as Markdown, for docs/case-file.md.
[[nodiscard]] std::string synonyms_markdown();

}  // namespace thinwall::core
