#include "report/page/bundle.hpp"

// The assembler takes the files' bytes as they are; THINWALL_WEB is the folder web/.
#define THINWALL_EMBED(name, file)                                                                           \
  asm(".section .rodata\n.global " #name "\n.global " #name "_end\n" #name ":\n.incbin \"" file "\"\n" #name \
      "_end:\n.byte 0\n.previous\n");                                                                        \
  extern "C" const char name[], name##_end[] /* NOLINT(bugprone-macro-parentheses): names cannot have any */

THINWALL_EMBED(thinwall_page_template, THINWALL_WEB "/template.html");
THINWALL_EMBED(thinwall_page_script, THINWALL_WEB "/dist/page.js");
THINWALL_EMBED(thinwall_page_style, THINWALL_WEB "/dist/page.css");

namespace thinwall::report {

std::string_view page_template() {
  return {thinwall_page_template, thinwall_page_template_end};
}

std::string_view page_script() {
  return {thinwall_page_script, thinwall_page_script_end};
}

std::string_view page_style() {
  return {thinwall_page_style, thinwall_page_style_end};
}

}  // namespace thinwall::report
