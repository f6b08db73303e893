#include "report/page/document.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <set>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "io/json_file.hpp"
#include "report/page/case_differences.hpp"
#include "report/page/frf_data.hpp"
#include "report/page/headline.hpp"
#include "report/page/lobes_data.hpp"
#include "report/page/shapes_data.hpp"
#include "report/page/simulation_data.hpp"
#include "report/summary/summary_json.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

std::string text_in(const fs::path& file) {
  return fs::exists(file) ? core::read_file(file) : "";
}

/// Gives the content of `file` to `use`; where it is not as expected, the file is named.
template <class Use>
auto as_written(const fs::path& file, const Use& use) {
  try {
    return use();
  } catch (const json::exception& error) {
    throw core::DataError(file.string() + ": not as thinwall writes it (" + error.what() + ")");
  }
}

Summary summary_in(const fs::path& folder) {
  const fs::path file = folder / "summary.json";
  if (!fs::exists(file))
    throw core::DataError("\"" + folder.string() +
                          "\" holds no summary.json: it is no result folder of a finished run");
  return summary_from(io::read_json(file), file);
}

/// Without the list of outputs, of which the page is one.
json manifest_in(const fs::path& folder) {
  const fs::path file = folder / "manifest.json";
  if (!fs::exists(file)) return json::object();
  json manifest = io::read_json(file);
  return as_written(file, [&] {
    if (manifest.contains("program")) (void)manifest.at("program").at("version").get<std::string>();
    manifest.erase("outputs");
    return manifest;
  });
}

/// The points that are cut and touched, whose receptances matter most.
std::vector<std::string> chief_points(const Summary& summary) {
  std::vector<std::string> points;
  if (summary.cutting && summary.cutting->at) points.push_back(*summary.cutting->at);
  for (const ContactSummary& contact : summary.contacts) points.insert(points.end(), {contact.part, contact.robot});
  return points;
}

json section(const KeptSections& kept, const std::string& name, const std::function<json()>& made) {
  const std::string* text = kept.find ? kept.find(name) : nullptr;
  return text != nullptr ? json::parse(*text) : made();
}

void keep(const KeptSections& kept, const std::string& name, const json& section) {
  if (kept.keep && kept.find(name) == nullptr) kept.keep(name, section.dump());
}

/// The summary as its file has it: bytes that are no UTF-8 are replaced there.
json document_of(const Summary& summary) {
  return json::parse(io::json_text(summary_json(summary)));
}

/// Keys of the case with every default and their values; names of files are the user's own affair.
json case_values(const fs::path& folder) {
  json values = json::object();
  for (const auto& [key, value] : values_of_case(text_in(folder / "case.resolved.toml"))) {
    if (!key.ends_with("file")) values[key] = value;
  }
  return values;
}

json run_of(const fs::path& folder, const RunAtHand& at_hand, const KeptSections& kept, std::size_t share) {
  const Summary& summary = at_hand.summary;
  json run = {{"summary", document_of(summary)}, {"manifest", at_hand.manifest}};
  run["case"] = text_in(folder / "case.toml");
  run["case_values"] = case_values(folder);
  const FrfChoice choice{.points_first = chief_points(summary), .most_bytes = 4000000 / share};
  std::string frf = "frf";
  for (const std::string& point : choice.points_first) frf += " " + point;
  const std::array<std::function<json()>, 4> sections{
      [&] { return section(kept, frf, [&] { return frf_data(folder, choice); }); },
      [&] { return section(kept, "shapes", [&] { return shapes_data(folder, summary, 500000 / share); }); },
      [&] { return lobes_data(folder, summary); },
      [&] {
        json simulation = simulation_data(folder, summary);
        return simulation.is_null() ? json::object() : json{{"simulation", std::move(simulation)}};
      }};
  std::array<json, 4> data;
  core::parallel_for(sections.size(), [&](std::size_t i) { data[i] = sections[i](); });
  keep(kept, frf, data[0]);  // in one order, so that what is kept has the same bytes whichever was made first
  keep(kept, "shapes", data[1]);
  for (const json& part : data) run.update(part);
  run["headline"] = headline(summary);
  run["sentences"] = report::sentences(summary);
  return run;
}

/// Names of the cases; where two are equal, of the folders, and where these are, whole paths.
std::vector<std::string> labels_of(const std::vector<fs::path>& folders, const json& runs) {
  const auto all_differ = [](const std::vector<std::string>& names) {
    return std::set<std::string>(names.begin(), names.end()).size() == names.size();
  };
  std::vector<std::string> cases, names, paths;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const fs::path path = fs::absolute(folders[i]).lexically_normal();
    names.push_back((path.has_filename() ? path : path.parent_path()).filename().string());
    paths.push_back(folders[i].string());
    cases.push_back(runs[i].at("summary").value("case", ""));
    if (cases.back().empty()) cases.back() = names.back();
  }
  return all_differ(cases) ? cases : all_differ(names) ? names : paths;
}

/// Bytes of a value's text, but for what is neither text nor a list: nearly all of a document.
std::size_t text_bytes(const json& value) {
  if (value.is_string()) return value.get_ref<const std::string&>().size();
  std::size_t bytes = 8;
  for (const json& item : value.is_structured() ? value : json::array()) bytes += text_bytes(item);
  return bytes;
}

/// Lines of receptances are left out where the document is too large for all.
void make_light(json& document, const DocumentRequest& request, const std::vector<RunAtHand>& runs) {
  const std::size_t size = text_bytes(document);
  if (size <= request.most_bytes) return;
  std::size_t of_frf = 0;
  for (const json& run : document["runs"]) of_frf += text_bytes(run.at("frf"));
  const std::size_t others = size - of_frf;
  const std::size_t left = request.most_bytes > others ? request.most_bytes - others : 0;
  for (std::size_t i = 0; i < request.folders.size(); ++i) {
    json& run = document["runs"][i];
    run.update(frf_data(request.folders[i],
                        {.points_first = chief_points(runs[i].summary), .most_bytes = left / request.folders.size()}));
  }
}

}  // namespace

json document(const DocumentRequest& request) {
  const std::size_t count = request.folders.size();
  json result = {{"schema", 1}, {"program", request.program}, {"headline", json::array()}, {"runs", json::array()}};
  std::vector<std::string> cases;
  std::vector<RunAtHand> runs;
  for (const fs::path& folder : request.folders) {
    runs.push_back(count == 1 && request.at_hand ? *request.at_hand
                                                 : RunAtHand{summary_in(folder), manifest_in(folder)});
    result["runs"].push_back(run_of(folder, runs.back(), count == 1 ? request.kept : KeptSections{}, count));
    cases.push_back(text_in(folder / "case.resolved.toml"));
  }
  const auto labels = labels_of(request.folders, result["runs"]);
  for (std::size_t i = 0; i < count; ++i) {
    json& run = result["runs"][i];
    run["label"] = labels[i];
    for (const json& sentence : run["headline"])
      result["headline"].push_back((count > 1 ? labels[i] + ": " : "") + sentence.get<std::string>());
    run.erase("headline");
  }
  const bool all_there = std::ranges::none_of(cases, &std::string::empty);
  if (count > 1 && all_there) result["differences"] = case_differences(cases);
  make_light(result, request, runs);
  return result;
}

}  // namespace thinwall::report
