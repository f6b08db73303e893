#include "report/page/page.hpp"

#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "io/base64.hpp"
#include "io/manifest.hpp"
#include "report/page/bundle.hpp"
#include "report/page/document.hpp"
#include "result_folder.hpp"

namespace thinwall::report::page_test {
namespace {

using nlohmann::json;

json hostile() {
  const std::string evil = "</script><script>alert(1)</script><!-- & \xE2\x80\xA8 \xFF {{SCRIPT}}";
  return {{"schema", 1},
          {"headline", {evil}},
          {"runs", {{{"label", evil}, {"summary", {{"title", evil}}}, {"case", evil}}}}};
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(Page, NoTextOfACaseEndsItsElementOrBeginsOne) {
  const std::string html = page(hostile());
  const std::string bare =
      page({{"schema", 1}, {"headline", json::array()}, {"runs", {{{"summary", json::object()}}}}});
  for (const char* what : {"</script", "<script", "<!--", "alert(1)</"})
    EXPECT_EQ(count(html, what), count(bare, what)) << what;
  const std::size_t begin = html.find("id=\"data\">") + 10;
  const std::string data = html.substr(begin, html.find("</script>", begin) - begin);
  const json read = json::parse(data);
  EXPECT_EQ(read["headline"][0].get<std::string>().find("</script><script>alert(1)"), 0U) << "nothing is lost";
  EXPECT_TRUE(std::all_of(data.begin(), data.end(), [](char c) { return static_cast<unsigned char>(c) < 128; }));
}

TEST(Page, AllowsItsOwnScriptAndStyleOnly) {
  const std::string html = page(hostile());
  const auto sum = [](std::string_view text) {
    std::string bytes;
    const std::string hex = io::sha256(text);
    for (std::size_t i = 0; i < hex.size(); i += 2)
      bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
    return "'sha256-" + io::base64(bytes) + "'";
  };
  EXPECT_NE(html.find("script-src " + sum(page_script())), std::string::npos);
  EXPECT_NE(html.find("style-src " + sum(page_style())), std::string::npos);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  const std::size_t script = html.rfind("<script>") + 8;
  EXPECT_EQ(html.substr(script, html.rfind("</script>") - script), page_script())
      << "what was summed is what stands there";
  EXPECT_EQ(html.find("{{TITLE}}"), std::string::npos);
}

/// Receptances of a long axis do not make a page too large to open: the lines that are left out are told.
TEST(Page, StaysSmallWithManyLines) {
  const auto folder = result_folder("page_small");
  const auto response = response_of({"A", "B"}, 25000, false);
  for (const char* name : {"part", "coupled_receptance", "coupled_spatial"})
    io::write_response(folder / "frf" / (std::string(name) + ".csv"), response);
  const json all = document({{folder}, "thinwall 9"});
  EXPECT_FALSE(all["runs"][0]["frf"][0].contains("thinned"));
  EXPECT_GT(all.dump().size(), 500000U);
  write_page(folder / "report.html", {{folder}, "thinwall 9", {}, 500000});
  const std::string html = core::read_file(folder / "report.html");
  const std::size_t begin = html.find("id=\"data\">") + 10, end = html.find("</script>", begin);
  EXPECT_LE(end - begin, 500000U);
  const json light = json::parse(html.substr(begin, end - begin));
  EXPECT_EQ(light["runs"][0]["frf"][0]["thinned"]["from"], 25000);
}

}  // namespace
}  // namespace thinwall::report::page_test
