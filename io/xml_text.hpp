#pragma once
// Text as XML and HTML want it.

#include <string>
#include <string_view>

namespace thinwall::io {

/// `text` with &, <, > and " as entities: between two tags and within an attribute in double quotes it is what it was.
[[nodiscard]] std::string xml_escaped(std::string_view text);

}  // namespace thinwall::io
