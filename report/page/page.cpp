#include "report/page/page.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/base64.hpp"
#include "io/manifest.hpp"
#include "io/xml_text.hpp"
#include "report/page/bundle.hpp"
#include "report/page/document.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

/// The checksum that a policy calls 'sha256-…': base64 of the sum's bytes.
std::string sum_of(std::string_view text) {
  const std::string hex = io::sha256(text);
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return io::base64(bytes);
}

/// JSON in ASCII in which no element can end and none begin: < > & stand in strings only.
std::string data_text(const json& document) {
  const std::string text = document.dump(-1, ' ', true, json::error_handler_t::replace);
  std::string result;
  result.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "\\u003c";
        break;
      case '>':
        result += "\\u003e";
        break;
      case '&':
        result += "\\u0026";
        break;
      default:
        result += c;
    }
  }
  return result;
}

std::string title_of(const json& document) {
  std::string title = document.value("title", std::string());
  for (const json& run : document.at("runs")) {
    const auto given = run["summary"].value("title", std::string());
    title += (title.empty() ? "" : " | ") + (given.empty() ? run.value("label", std::string("results")) : given);
  }
  return title;
}

}  // namespace

std::string page(const json& document) {
  const std::array<std::pair<std::string_view, std::string>, 6> fields{
      {{"{{TITLE}}", io::xml_escaped(title_of(document))},
       {"{{STYLE_HASH}}", sum_of(page_style())},
       {"{{SCRIPT_HASH}}", sum_of(page_script())},
       {"{{STYLE}}", std::string(page_style())},
       {"{{SCRIPT}}", std::string(page_script())},
       {"{{DATA}}", data_text(document)}}};
  // One pass over the template alone: what is filled in is not looked through.
  std::string result;
  std::string_view rest = page_template();
  for (std::size_t at = rest.find("{{"); at != std::string_view::npos; at = rest.find("{{")) {
    result += rest.substr(0, at);
    rest.remove_prefix(at);
    const auto field = std::ranges::find_if(fields, [&](const auto& f) { return rest.starts_with(f.first); });
    if (field == fields.end()) throw std::logic_error("the template of the page has a field of no meaning");
    result += field->second;
    rest.remove_prefix(field->first.size());
  }
  return result.append(rest);
}

void write_page(const std::filesystem::path& file, DocumentRequest request) {
  constexpr std::size_t most = 7500000;  // bytes of the page; escapes in a case's text may add some
  const std::size_t bundle = page_template().size() + page_script().size() + page_style().size();
  request.most_bytes = std::min(request.most_bytes, most - std::min(bundle, most));
  core::write_file_atomically(file, page(document(request)));
}

}  // namespace thinwall::report
