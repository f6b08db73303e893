#pragma once
// The schema of summary.json, and the kinds of its values.

#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "report/summary/summary.hpp"

namespace thinwall::report {

/// summary.json as JSON Schema (draft 2020-12): every key with its type, its meaning ("description"), its kind ("kind")
/// and the unit of that ("unit"); what a run may lack is not among "required". Nothing else may be in a summary.
[[nodiscard]] nlohmann::ordered_json summary_schema();

/// The kind of every value of summary.json, and of every section and list, by its path, in which "[]" stands for an
/// index and "*" for a name that a run gives: "lobes[].minimum_depth_m", "timings_s.*". Made at the first call.
[[nodiscard]] const std::map<std::string, Kind>& summary_kinds();

/// True if the schema knows the path of a value, "lobes[0].minimum_depth_m".
[[nodiscard]] bool is_known(const std::string& path);

/// The meaning of the value at a path of a summary in words; empty where the path is not known.
[[nodiscard]] std::string meaning_at(const std::string& path);

/// The kind of the value at a path of a summary, "lobes[0].minimum_depth_m"; a ratio where the path is not known, as
/// of a summary by another version.
[[nodiscard]] Kind kind_at(const std::string& path);

}  // namespace thinwall::report
