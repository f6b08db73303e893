#pragma once
// Text for XML and HTML.

#include <string>
#include <string_view>

namespace thinwall::io {

/// The text with &, <, > and " as entities, for use between two tags or in an attribute in double quotes.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace thinwall::io
