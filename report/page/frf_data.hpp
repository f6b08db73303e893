#pragma once
// Receptances of a result folder, as a page shows them.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace thinwall::report {

/// The amount of receptances that a page takes.
struct FrfChoice {
  std::vector<std::string> points_first{};  ///< their DOFs before those of other points
  std::size_t most_dofs = 6;                ///< of each file
  std::size_t most_bytes = 4000000;         ///< of the data as JSON
};

/// "frf", "frf_left_out" and, where part and robot were joined by both routes, "route_difference" of a run
/// (web/document.md): frf/*.csv of a result folder, numbers rounded for a picture; an entry whose mirror image is the
/// same is NaN. Where the data would be larger than `most_bytes`, lines are left out (report/page/thinned_lines.hpp).
/// Throws DataError for a file that cannot be read. Cost O(bytes of the files).
[[nodiscard]] nlohmann::json frf_data(const std::filesystem::path& results, const FrfChoice& choice = {});

}  // namespace thinwall::report
