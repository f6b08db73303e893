#pragma once
// Records of a sweep: sweep.json in its folder, point.json in that of each point.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/sweep/sweep_table.hpp"
#include "case/machining_case.hpp"

namespace thinwall::app {

/// A sweep: its grid, and a hash of all that its points have in common.
struct SweepPlan {
  std::string name;  ///< of the case
  std::string key;   ///< sweep_key()
  std::vector<SweepAxis> axes;
};

/// Hash of the program, the case with `overrides` but without the swept keys, the files that it names and its
/// expected.toml. A case that is none before the swept keys have their values is taken by its text. Throws UsageError
/// for an override that is none, InputError where there is no case.
[[nodiscard]] std::string sweep_key(const std::filesystem::path& case_path, const std::vector<std::string>& overrides,
                                    const std::vector<SweepAxis>& axes);

/// Hash of the program, the case of one point with all its values, the files that it names and its expected.toml.
[[nodiscard]] std::string point_key(const cases::Case& source);

/// Writes sweep.json to the folder; throws DataError.
void write_plan(const std::filesystem::path& folder, const SweepPlan& plan);

/// The plan that write_plan() wrote. Throws DataError for a folder without sweep.json, or with a damaged one.
[[nodiscard]] SweepPlan read_plan(const std::filesystem::path& folder);

/// Removes the half-written sweep.csv, sweep.svg and sweep.json of processes that ended before these were whole: those
/// whose process no longer runs on this machine and that nobody has written to for a minute, which is longer than any
/// of them takes on another machine. What cannot be removed stays. Cost: of listing the folder.
void remove_abandoned_tables(const std::filesystem::path& folder) noexcept;

/// Folder of a point: 001, 002 …; as many digits as the last one has, three at least.
[[nodiscard]] std::filesystem::path point_folder(const std::filesystem::path& sweep, std::size_t number,
                                                 std::size_t count);

/// The outcome of a point, and which point of which sweep it was.
struct PointRecord {
  std::string sweep;                ///< SweepPlan::key
  std::string key;                  ///< point_key(); "" where the values made no case
  std::vector<std::string> values;  ///< overrides_at()
  std::string status;               ///< as of SweepRow, as the following
  int exit_code = 0;
  std::string reason;
  SweepFigures figures;  ///< read from summary.json
};

/// Writes point.json, with the hash of the summary.json that lies beside it; throws DataError.
void write_point(const std::filesystem::path& folder, std::size_t number, const PointRecord& record);

/// The record that write_point() wrote; none where there is no point.json. Throws DataError if it is damaged, or if
/// summary.json is not the one that the sweep left.
[[nodiscard]] std::optional<PointRecord> read_point(const std::filesystem::path& folder);

}  // namespace thinwall::app
