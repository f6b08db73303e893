#include "report/page/document.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>

#include "core/error.hpp"
#include "report/page/case_differences.hpp"
#include "report/page/page.hpp"
#include "result_folder.hpp"

namespace thinwall::report::document_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

json run_in(const fs::path& folder) {
  return document({{folder}, "thinwall 9"})["runs"][0];
}

/// Refused as data that cannot be read, with the file's name.
void expect_refused(const fs::path& folder, const std::string& file) {
  try {
    write_page(folder / "report.html", {{folder}, "thinwall 9"});
    FAIL() << file;
  } catch (const core::DataError& error) {
    EXPECT_NE(std::string(error.what()).find(file), std::string::npos) << error.what();
    EXPECT_EQ(error.code(), core::ExitCode::unreadable_data);
  }
}

TEST(Document, OfAFolderWithoutResultsIsRefused) {
  const fs::path folder = result_folder("no_results");
  const auto summary = [&](const std::string& text) { core::write_file_atomically(folder / "summary.json", text); };
  fs::remove(folder / "summary.json");
  expect_refused(folder, "no_results");
  summary("{ no json");
  expect_refused(folder, "summary.json");
  summary("[1, 2]");
  expect_refused(folder, "summary.json");
  json good = summary_json(Summary{});
  for (const auto& [key, value] :
       {std::pair{"title", json(7)}, {"sentences", json({3})}, {"lobes", json({{{"name", "part"}}})}}) {
    json wrong = good;
    wrong[key] = value;
    summary(wrong.dump());
    expect_refused(folder, "summary.json");
  }
  good["case"] = "x";
  good["of_a_later_version"] = 1;
  summary(good.dump());
  EXPECT_EQ(run_in(folder)["label"], "x");
  for (const char* manifest : {R"({"program": "x"})", R"({"program": {"version": 3}})", "[]", "{"}) {
    core::write_file_atomically(folder / "manifest.json", manifest);
    expect_refused(folder, "manifest.json");
  }
}

/// The page is the work of this program, its numbers are that of the run's; the list of files, of which the page is
/// one, is not in it.
TEST(Document, NamesTheProgramThatMakesThePageAndThatOfTheRun) {
  const fs::path folder = result_folder("document_program");
  core::write_file_atomically(folder / "manifest.json",
                              R"({"program": {"name": "thinwall", "version": "0.0.3"}, "outputs": [{"name": "a"}]})");
  const json made = document({{folder}, "thinwall 9"});
  EXPECT_EQ(made["program"], "thinwall 9");
  EXPECT_EQ(made["runs"][0]["manifest"]["program"]["version"], "0.0.3");
  EXPECT_FALSE(made["runs"][0]["manifest"].contains("outputs"));
}

/// Kept files of two runs have the same bytes whatever else the machine does meanwhile. The receptances, which are
/// first, wait here until something is kept, or a moment.
TEST(Document, KeepsItsSectionsInOneOrderWhicheverIsMadeFirst) {
  std::mutex mutex;
  std::condition_variable something;
  std::vector<std::string> names;
  const auto find = [&](const std::string& name) -> const std::string* {
    std::unique_lock lock(mutex);
    if (name.starts_with("frf"))
      something.wait_for(lock, std::chrono::milliseconds(100), [&] { return !names.empty(); });
    return nullptr;
  };
  const auto keep = [&](const std::string& name, const std::string& /*text*/) {
    const std::lock_guard lock(mutex);
    names.push_back(name);
    something.notify_all();
  };
  (void)document({.folders = {result_folder("document_kept")}, .program = "thinwall 9", .kept = {find, keep}});
  EXPECT_EQ(names, (std::vector<std::string>{"frf", "shapes"}));
}

TEST(Document, HasTheValuesOfTheCaseWithoutNamesOfFiles) {
  const fs::path folder = result_folder("document_case");
  EXPECT_EQ(run_in(folder)["case_values"], json::object());
  core::write_file_atomically(folder / "case.resolved.toml",
                              "[tool]\nteeth = 4\ndiameter = \"0.02 m\"\n\n[[tool.measured]]\n"
                              "response = \"x\"\nfile = \"/home/somebody/tip.csv\"\n");
  EXPECT_EQ(run_in(folder)["case_values"],
            (json{{"tool.teeth", "4"}, {"tool.diameter", "0.02 m"}, {"tool.measured[0].response", "x"}}));
}

TEST(Document, RunsOfOneCaseAreToldApartByTheirFolders) {
  const fs::path a = result_folder("label_a"), b = result_folder("label_b"), other = result_folder("label_c", "big");
  const auto labels = [](const std::vector<fs::path>& folders) {
    std::vector<std::string> list;
    const json made = document({folders, "thinwall 9"});
    for (const json& run : made["runs"]) list.push_back(run["label"]);
    return list;
  };
  EXPECT_EQ(labels({a, other}), (std::vector<std::string>{"small", "big"}));
  EXPECT_EQ(labels({a, b}), (std::vector<std::string>{"label_a", "label_b"}));
  EXPECT_EQ(labels({a / "", b / "."}), (std::vector<std::string>{"label_a", "label_b"}));
  const fs::path below = result_folder("label_d") / "label_a";
  fs::create_directories(below);
  fs::copy(a / "summary.json", below / "summary.json");
  EXPECT_EQ(labels({a, below}), (std::vector<std::string>{a.string(), below.string()}));
}

TEST(Document, TellsWhatTwoCasesSayDifferently) {
  const fs::path a = result_folder("differ_a"), b = result_folder("differ_b");
  core::write_file_atomically(a / "case.resolved.toml",
                              "title = \"a\"\n[cutting]\nKt = \"2220 N/mm^2\"\nKr = \"1 Pa\"\n");
  EXPECT_FALSE(document({{a, b}, "thinwall 9"}).contains("differences")) << "one of the cases is not there";
  core::write_file_atomically(b / "case.resolved.toml",
                              "title = \"b\"\n[cutting]\nKt = \"2400 N/mm^2\"\nKr = \"1 Pa\"\n");
  EXPECT_EQ(document({{a, b}, "thinwall 9"})["differences"], json({{"cutting.Kt", "2220 N/mm^2", "2400 N/mm^2"}}));
  EXPECT_FALSE(document({{a}, "thinwall 9"}).contains("differences"));
}

TEST(CaseDifferences, KnowTablesListsAndKeysThatOneLacks) {
  const std::string a =
      "[[part.supports]]\non = \"x_min\"\n\n[[part.supports]]\non = \"y_max\"\nfixed = [\"x\", \"y\"]\n";
  const std::string b = "[[part.supports]]\non = \"x_min\"\n\n[[part.supports]]\non = \"y_min\"\n[modes]\ncount = 3\n";
  EXPECT_EQ(case_differences({a, b}), json({{"modes.count", "", "3"},
                                            {"part.supports[1].fixed", "[\"x\", \"y\"]", ""},
                                            {"part.supports[1].on", "y_max", "y_min"}}));
  EXPECT_EQ(case_differences({a, a}), json::array());
}

}  // namespace
}  // namespace thinwall::report::document_test
