#include "app/sweep/sweep.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <exception>
#include <iterator>
#include <new>
#include <optional>
#include <system_error>
#include <utility>

#include "app/log.hpp"
#include "app/signals.hpp"
#include "app/stage_display.hpp"
#include "app/sweep/sweep_jobs.hpp"
#include "app/sweep/sweep_record.hpp"
#include "app/sweep/sweep_table.hpp"
#include "app/terminal.hpp"
#include "case/problem.hpp"
#include "case/reader.hpp"
#include "case/schema/schema.hpp"
#include "core/atomic_file.hpp"
#include "core/interrupt.hpp"
#include "report/result_folder.hpp"

namespace thinwall::app {

namespace {

namespace fs = std::filesystem;
using core::ExitCode;

/// The rows of a grid of which nothing is known yet.
SweepTable empty_table(std::vector<SweepAxis> axes) {
  SweepTable table{std::move(axes), {}};
  for (GridPoint& point : grid_points(table.axes)) {
    table.rows.emplace_back();
    table.rows.back().number = table.rows.size();
    table.rows.back().point = std::move(point);
  }
  return table;
}

void take(SweepRow& row, PointRecord record) {
  row.status = std::move(record.status);
  row.exit_code = record.exit_code;
  row.reason = std::move(record.reason);
  row.figures = std::move(record.figures);
}

/// Fills the row from the folder of a point; false if the point was not computed there, or another one was. Throws
/// DataError as read_point().
bool read_row(const fs::path& folder, const SweepPlan& plan, SweepRow& row) {
  auto record = read_point(folder);
  if (!record || record->sweep != plan.key || record->values != overrides_at(plan.axes, row.point)) return false;
  take(row, std::move(*record));
  return true;
}

/// The record of a point; a damaged one counts as not computed.
void read_row_if_whole(const fs::path& folder, const SweepPlan& plan, SweepRow& row) {
  try {
    (void)read_row(folder, plan, row);
  } catch (const core::DataError& error) {
    spdlog::warn("point {}: {}", row.number, error.what());
  }
}

/// The record that an earlier sweep left of the point with this key, unless it failed or is damaged.
std::optional<PointRecord> kept_point(const fs::path& folder, const std::string& key) {
  try {
    auto record = read_point(folder);
    if (record && record->key == key && record->status != "failed") return record;
  } catch (const core::DataError& error) {
    spdlog::warn("computed anew: {}", error.what());
  }
  return std::nullopt;
}

void fail(SweepRow& row, ExitCode code, std::string reason) {
  std::ranges::replace(reason, '\n', ' ');
  row.status = "failed";
  row.exit_code = static_cast<int>(code);
  row.reason = std::move(reason);
  spdlog::warn("point {}: {}", row.number, row.reason);
}

/// The problems of the case at a point; those of the point's values and of --set have no place in the file.
std::string reason_of(const cases::CaseError& error) {
  std::string reason;
  for (const cases::Problem& problem : error.problems) {
    reason += reason.empty() ? "" : "; ";
    reason += problem.line < 0 ? problem.text : cases::problem_line(error.source.name, problem);
  }
  return reason;
}

/// Runs `body`; what goes wrong with this point only becomes its reason.
template <typename Body>
void guard_point(SweepRow& row, const Body& body) {
  try {
    body();
  } catch (const core::Interrupted&) {
    throw;
  } catch (const cases::CaseError& error) {
    fail(row, error.code(), reason_of(error));
  } catch (const core::Error& error) {
    fail(row, error.code(), error.what());
  } catch (const std::bad_alloc&) {
    fail(row, ExitCode::numerical, "out of memory; take larger elements or fewer modes");
  } catch (const std::exception& error) {
    fail(row, ExitCode::internal, std::string("internal error: ") + error.what());
  }
}

/// On a terminal the line of the stages beneath that of the point; elsewhere stages are told only if they are asked
/// for.
ProgressDisplay stage_display(const SweepRequest& request) {
  const ProgressDisplay display = progress_display(request.progress, request.verbosity < 0);
  return display == ProgressDisplay::lines && request.progress != "always" ? ProgressDisplay::none : display;
}

/// The folder in which the points of a sweep keep their parts: those that differ in the cut only share one.
fs::path shared_parts(const fs::path& sweep) {
  return sweep / "cache";
}

void run_point(const fs::path& folder, const SweepRequest& request, const cases::Case& source, const RunCase& run_case,
               SweepRow& row) {
  report::ResultFolder results(folder);
  fs::remove(folder / "point.json");
  const ProgressDisplay display = stage_display(request);
  log_to_terminal(request.verbosity > 0               ? 1
                  : display == ProgressDisplay::lines ? 0
                                                      : -1,
                  display == ProgressDisplay::line);
  log_to_file(folder / "run.log");
  RunOptions options{folder, request.fresh, request.verbosity, display == ProgressDisplay::line, {}};
  options.parts = shared_parts(folder.parent_path());
  options.held = &results;
  const RunResult found = run_case(source, options);
  row.status = found.summary.status;
  row.exit_code = static_cast<int>(found.expectations_hold ? ExitCode::done : ExitCode::expectation);
  row.figures = sweep_figures(found.summary);
}

void compute_point(const fs::path& folder, const SweepRequest& request, const SweepPlan& plan, const RunCase& run_case,
                   SweepRow& row) {
  const std::vector<std::string> values = overrides_at(plan.axes, row.point);
  std::vector<std::string> overrides = request.overrides;
  std::ranges::copy(values, std::back_inserter(overrides));
  std::string key;
  guard_point(row, [&] {
    const cases::Case source = cases::read_case(request.case_path, overrides);
    key = point_key(source);
    if (auto kept = request.fresh ? std::nullopt : kept_point(folder, key)) {
      take(row, std::move(*kept));
      spdlog::info("point {}: kept", row.number);
    } else {
      run_point(folder, request, source, run_case, row);
    }
  });
  log_to_terminal(request.verbosity);
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  write_point(folder, row.number, {plan.key, key, values, row.status, row.exit_code, row.reason, {}});
}

/// "part.thickness=5 mm, tool.teeth=2".
std::string values_text(const SweepTable& table, const SweepRow& row) {
  std::string values;
  for (const auto& value : overrides_at(table.axes, row.point)) values += (values.empty() ? "" : ", ") + value;
  return values;
}

/// Reads the case of every point of the shard before the first is run. Throws InputError that names the first point
/// whose values make no case, or CaseError where already the first point has nothing wrong but the file itself.
void require_cases(const SweepRequest& request, const SweepTable& table, const Shard& shard) {
  bool first = true;
  for (const SweepRow& row : table.rows) {
    if (!shard.holds(row.number)) continue;
    core::check_interrupt();
    std::vector<std::string> overrides = request.overrides;
    std::ranges::copy(overrides_at(table.axes, row.point), std::back_inserter(overrides));
    try {
      (void)cases::read_case(request.case_path, overrides);
    } catch (const cases::CaseError& error) {
      const auto in_file = [](const cases::Problem& problem) { return problem.line > 0; };
      if (first && std::ranges::all_of(error.problems, in_file)) throw;
      throw core::InputError("point " + std::to_string(row.number) + " of " + std::to_string(table.rows.size()) + ", " +
                             values_text(table, row) + ": " + reason_of(error));
    }
    first = false;
  }
}

void write_tables(const fs::path& folder, const SweepTable& table) {
  core::write_file_atomically(folder / "sweep.csv", sweep_csv(table));
  const std::string svg = sweep_svg(table);
  if (!svg.empty()) core::write_file_atomically(folder / "sweep.svg", svg);
}

ExitCode code_of(const SweepTable& table) {
  ExitCode code = ExitCode::done;
  for (const SweepRow& row : table.rows) {
    if (row.status == "failed") return static_cast<ExitCode>(row.exit_code);
    if (row.exit_code != 0) code = static_cast<ExitCode>(row.exit_code);
  }
  return code;
}

/// "point 3 of 9: part.thickness=5 mm, about 40 s left".
void announce(const SweepTable& table, const SweepRow& row, double seconds_left) {
  std::string values = values_text(table, row);
  if (seconds_left > 0.0) values += "; about " + duration_text(seconds_left) + " left";
  spdlog::info("point {} of {}: {}", row.number, table.rows.size(), values);
}

void make_sweep_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw core::DataError("cannot make \"" + folder.string() + "\": " + error.message() + "; choose another --out");
}

/// A key has one value: that of the grid, or that of --set.
void require_one_value(const std::vector<SweepAxis>& axes, const std::vector<std::string>& overrides) {
  for (const std::string& text : overrides) {
    std::string key = text.substr(0, text.find('='));
    std::erase(key, ' ');
    key = cases::full_path(cases::case_schema(), key);
    if (std::ranges::count(axes, key, &SweepAxis::key) == 0) continue;
    throw core::UsageError("\"" + key + "\" is swept and has a value by --set, too; leave one of them out");
  }
}

void require_same_sweep(const std::string& first, const SweepPlan& plan, const std::string& folder,
                        const SweepPlan& other) {
  const bool same_grid = std::ranges::equal(plan.axes, other.axes, [](const SweepAxis& a, const SweepAxis& b) {
    return a.key == b.key && a.values == b.values;
  });
  if (same_grid && plan.key == other.key) return;
  throw core::UsageError("\"" + folder + "\" is another sweep than \"" + first + "\": " +
                         (same_grid ? "the case, its files, --set or the program differ" : "keys or values differ") +
                         "; merge the shards of one sweep");
}

/// Names the points that no shard has, and the shards that have not ended.
void tell_of_missing(const std::vector<std::string>& folders, const std::vector<std::size_t>& missing,
                     std::ostream& text) {
  for (const std::string& folder : folders)
    for (const OpenShard& shard : open_shards(folder))
      text << "  shard " << shard.number
           << (shard.given_up ? " was killed twice" : " has not ended: it runs, or was killed") << "; see "
           << (fs::path(folder) / "shards" / (shard.number + ".log")).string() << '\n';
  if (missing.empty()) return;
  constexpr std::size_t most_named = 20;
  text << "  " << missing.size() << (missing.size() == 1 ? " point is" : " points are") << " missing:";
  for (std::size_t i = 0; i < std::min(missing.size(), most_named); ++i) text << ' ' << missing[i];
  text << (missing.size() > most_named ? " …" : "") << "; run their shards again, which go on where they stopped\n";
}

}  // namespace

ExitCode run_sweep(const SweepRequest& request, const RunCase& run_case, std::ostream& out) {
  using Clock = std::chrono::steady_clock;
  if (request.shards > 0 && !request.slurm && !request.parallel)
    throw core::UsageError("--shards is for --slurm and --parallel; one shard is computed by --shard I/N");
  const Shard shard = shard_of(request.shard);
  (void)stage_display(request);
  SweepTable table = empty_table(sweep_axes(request.keys));
  require_one_value(table.axes, request.overrides);
  const std::string name =
      fs::absolute(cases::case_file(request.case_path)).lexically_normal().parent_path().filename().string();
  const SweepPlan plan{name, sweep_key(request.case_path, request.overrides, table.axes), table.axes};
  const fs::path folder = request.out.empty() ? fs::path("results") / (name + "-sweep") : fs::path(request.out);
  log_to_terminal(request.verbosity);
  require_cases(request, table, shard);
  make_sweep_folder(folder);
  remove_abandoned_tables(folder);
  if (std::error_code ignored; request.fresh) fs::remove_all(shared_parts(folder), ignored);
  write_plan(folder, plan);
  if (request.slurm || request.parallel) {
    write_jobs(request, sweep_jobs(request, table, folder, name), out);
    return ExitCode::done;
  }
  const auto start = Clock::now();
  std::size_t done = 0;
  const auto mine = static_cast<std::size_t>(
      std::ranges::count_if(table.rows, [&](const SweepRow& row) { return shard.holds(row.number); }));
  std::exception_ptr stopped;
  std::optional<Undisturbed> writing;  // the table of what is done, after an interruption
  for (SweepRow& row : table.rows) {
    const fs::path there = point_folder(folder, row.number, table.rows.size());
    if (!shard.holds(row.number) || stopped) {
      read_row_if_whole(there, plan, row);
      continue;
    }
    const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
    announce(table, row, done == 0 ? 0.0 : seconds / static_cast<double>(done) * static_cast<double>(mine - done));
    try {
      core::check_interrupt();
      compute_point(there, request, plan, run_case, row);
      ++done;
    } catch (const core::Interrupted&) {
      writing.emplace();
      stopped = std::current_exception();
    }
  }
  write_tables(folder, table);
  if (stopped) std::rethrow_exception(stopped);
  out << sweep_text(table) << "\n  table: " << (folder / "sweep.csv").string() << '\n';
  return code_of(table);
}

ExitCode merge_sweeps(const std::vector<std::string>& folders, const fs::path& out, std::ostream& text) {
  const SweepPlan plan = read_plan(folders.front());
  for (const std::string& folder : folders) require_same_sweep(folders.front(), plan, folder, read_plan(folder));
  SweepTable table = empty_table(plan.axes);
  std::vector<std::size_t> missing;
  for (SweepRow& row : table.rows) {
    const bool found = std::ranges::any_of(folders, [&](const fs::path& folder) {
      return read_row(point_folder(folder, row.number, table.rows.size()), plan, row);
    });
    if (!found) missing.push_back(row.number);
  }
  make_sweep_folder(out);
  write_tables(out, table);
  text << sweep_text(table) << "\n  table: " << (out / "sweep.csv").string() << '\n';
  tell_of_missing(folders, missing, text);
  const ExitCode code = code_of(table);
  return code == ExitCode::done && !missing.empty() ? ExitCode::numerical : code;
}

}  // namespace thinwall::app
