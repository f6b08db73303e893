#pragma once
// The page's template, script and style, as web/dist and web/template.html hold them when the program is built.

#include <string_view>

namespace thinwall::report {

[[nodiscard]] std::string_view page_template();  ///< HTML with {{TITLE}}, {{STYLE}}, {{SCRIPT}}, {{DATA}} …
[[nodiscard]] std::string_view page_script();    ///< web/dist/page.js
[[nodiscard]] std::string_view page_style();     ///< web/dist/page.css

}  // namespace thinwall::report
