#include "distributed/rank_team.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <mutex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/messages.hpp"
#include "core/units.hpp"
#include "distributed/child_process.hpp"
#include "distributed/matrix_file.hpp"
#include "distributed/open_file.hpp"
#include "linalg/matrix_graph.hpp"
#include "linalg/ordering.hpp"

namespace thinwall::distributed {

namespace fs = std::filesystem;

namespace {

using Access = OpenFile::Access;
using Clock = std::chrono::steady_clock;

constexpr const char* program_name = "thinwall-mpi";

std::string variable(const char* name, const std::string& otherwise) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0' ? value : otherwise;
}

/// The place of a program: the name itself if it is a path, else the first on the PATH; empty if there is none.
fs::path found_program(const std::string& name) {
  if (name.find('/') != std::string::npos) return ::access(name.c_str(), X_OK) == 0 ? fs::path(name) : fs::path();
  std::istringstream folders(variable("PATH", "/usr/bin:/bin"));
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path(folder) / name;
    if (::access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

/// The words that start the ranks, without the program and its folder.
std::vector<std::string> launcher(int ranks) {
  std::vector<std::string> words;
  std::istringstream text(variable("THINWALL_MPIRUN", "mpirun"));
  for (std::string word; text >> word;) words.push_back(word);
  words.insert(words.end(), {"-n", std::to_string(ranks)});
  return words;
}

/// The environment of the ranks. Open MPI would pin each rank with all its threads to one core, poll while a rank
/// waits, count cores before it starts a process, refuse root, as which it runs in containers (this program's own user
/// is the one who asked), and wait for a second before it ends ranks, in which it is ended itself and leaves its files.
std::map<std::string, std::string> environment(int threads) {
  std::map<std::string, std::string> result{
      {"OMP_NUM_THREADS", std::to_string(threads)},   {"OPENBLAS_NUM_THREADS", std::to_string(threads)},
      {"OMPI_MCA_hwloc_base_binding_policy", "none"}, {"OMPI_MCA_mpi_yield_when_idle", "1"},
      {"OMPI_MCA_rmaps_base_oversubscribe", "1"},     {"OMPI_MCA_odls_base_sigkill_timeout", "0"}};
  if (::geteuid() == 0) {
    result["OMPI_ALLOW_RUN_AS_ROOT"] = "1";
    result["OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"] = "1";
  }
  return result;
}

/// The line of the launcher's errors that tells most: that of a rank's end, else the first that has letters.
std::string told_by(const fs::path& log) {
  std::ifstream file(log);
  std::string told;
  for (std::string line; std::getline(file, line);) {
    if (line.find("exited on signal") != std::string::npos) return line;
    const bool has_letters = std::ranges::any_of(line, [](unsigned char c) { return std::isalpha(c) != 0; });
    if (told.empty() && has_letters) told = line;
  }
  return told;
}

/// A name for the folder of the files that program and ranks share. Throws DataError without a folder to make it in.
fs::path scratch_name() {
  std::error_code failed;
  const fs::path folder = fs::temp_directory_path(failed);
  if (failed || ::access(folder.c_str(), W_OK | X_OK) != 0) {
    throw core::DataError("--ranks: \"" + variable("TMPDIR", "/tmp") +
                          "\" is no folder that can be written: set TMPDIR to one with space that all ranks share");
  }
  return core::partial_path(folder / "thinwall-ranks");
}

std::string ranks_text(int count) {
  return std::to_string(count) + (count == 1 ? " rank" : " ranks");
}

std::string memory_text(double bytes) {
  return core::readable_text(bytes, core::kind::memory);
}

}  // namespace

fs::path rank_program() {
  const std::string named = variable("THINWALL_MPI", "");
  if (!named.empty()) return found_program(named);
  std::error_code none;
  const fs::path beside = fs::read_symlink("/proc/self/exe", none).parent_path() / program_name;
  return ::access(beside.c_str(), X_OK) == 0 ? beside : found_program(program_name);
}

std::string ranks_in_words() {
  const fs::path program = rank_program();
  if (program.empty()) return "absent: install libmumps-dev and build again, or the package thinwall-mpi";
  const std::string command = launcher(1).front();
  if (found_program(command).empty()) return "thinwall-mpi without " + command + ": install openmpi-bin";
  return "there (" + program.string() + ", started by " + found_program(command).string() + ")";
}

struct RankTeam::Impl {
  TeamOptions options;
  fs::path scratch;
  std::unique_ptr<ChildProcess> ranks;
  bool begun = false;  // they have answered
  std::mutex busy;     // one order at a time
  int factors = 0;     // made so far
  int unheard = 0;     // orders whose answers are to come
  RankCost latest{};

  [[nodiscard]] fs::path matrix() const { return scratch / "matrix"; }
  [[nodiscard]] fs::path order() const { return scratch / "order"; }
  [[nodiscard]] fs::path columns() const { return scratch / "columns"; }
  [[nodiscard]] fs::path log() const { return scratch / "errors"; }

  /// The error of a team that has ended, or has never begun.
  [[noreturn]] void ended() const {
    ranks->ends_within(0.5);  // its last words
    const std::string told = told_by(log());
    if (!begun) {
      throw core::UsageError("--ranks: the command \"" + launcher(options.ranks).front() +
                             "\" did not start the ranks" + (told.empty() ? "" : ": " + told) +
                             "; name another with its options in THINWALL_MPIRUN");
    }
    throw core::NumericalError("the ranks of --ranks " + std::to_string(options.ranks) + " have ended" +
                               (told.empty() ? "" : ": " + told) +
                               "; run again: with more memory or more ranks if one ran out of it");
  }

  /// The next line of the ranks. An interruption ends them, for an answer to come would be taken for the next one's.
  std::optional<std::string> next_line() {
    try {
      return ranks->hear();
    } catch (const core::Error&) {
      ranks.reset();
      throw;
    }
  }

  /// Gives an order without waiting for its answer.
  void tell(const std::string& words) {
    if (!ranks) return;
    ranks->say(words);
    ++unheard;
  }

  /// The next answer, without its "=". Other lines are what libraries print.
  std::string next_answer() {
    while (true) {
      const std::optional<std::string> line = next_line();
      if (!line) ended();
      if (!line->starts_with("= ")) continue;
      --unheard;
      return line->substr(2);
    }
  }

  /// Hears the answers that are to come, so that the ranks touch no file any more. There are some where a TimeLimit has
  /// ended the wait for one.
  void settle() {
    if (!ranks) throw core::NumericalError("the ranks have ended after an interruption: start them anew");
    while (unheard > 0) (void)next_answer();
  }

  /// The answer to an order: the words behind the first, which is the expected one.
  std::istringstream ask(const std::string& words, const std::string& expected) {
    settle();
    tell(words);
    std::istringstream answer(next_answer());
    std::string first, rest;
    answer >> first;
    if (first == expected) return answer;
    std::getline(answer >> std::ws, rest);
    if (first == "data_error") throw core::DataError(rest);
    throw core::NumericalError("the ranks: " + rest);
  }

  void start();
  linalg::FactorStatistics factorise(const std::string& number, const linalg::SparseMatrix& A,
                                     const linalg::FactorOptions& limits);
  Eigen::MatrixXd solve(const std::string& number, const Eigen::Ref<const Eigen::MatrixXd>& B);
};

void RankTeam::Impl::start() {
  const fs::path program = rank_program();
  if (program.empty()) {
    throw core::UsageError("--ranks and --low-memory need " + std::string(program_name) +
                           ", which is not there: install the package thinwall-mpi, or libmumps-dev and build "
                           "again; without them nothing is needed");
  }
  std::vector<std::string> words = launcher(options.ranks);
  if (found_program(words.front()).empty()) {
    throw core::UsageError("--ranks: there is no " + words.front() +
                           " on the PATH: install openmpi-bin, or name the command in THINWALL_MPIRUN");
  }
  fs::create_directory(scratch);
  words.insert(words.end(), {program.string(), scratch.string()});
  ranks = std::make_unique<ChildProcess>(words, environment(options.threads), log());
  std::istringstream ready = ask("hello", "ready");
  begun = true;
  int size = 0;
  std::string library;
  ready >> size;
  std::getline(ready, library);
  if (size != options.ranks) {
    throw core::UsageError("--ranks " + std::to_string(options.ranks) + ": " + words.front() +
                           " started processes of " + std::to_string(size) + " rank each: it is not the one of" +
                           library + ", with which thinwall-mpi was built; name that in THINWALL_MPIRUN");
  }
  core::inform(fmt::format("{} of {} thread{} each,{}", ranks_text(size), options.threads,
                           options.threads == 1 ? "" : "s", library));
}

/// The memory and time that the analysis of a matrix foresees (docs/scaling.md).
struct RankForecast {
  double machine_bytes = 0.0;  ///< that the ranks on the fullest machine will take beside what they hold now
  double free_bytes = 0.0;     ///< there
  double least_bytes = 0.0, most_bytes = 0.0;  ///< peak of a rank
  double seconds = 0.0;
  linalg::FactorStatistics statistics{};
};

namespace {

RankForecast forecast_of(std::istream& words) {
  RankForecast told;
  words >> told.machine_bytes >> told.free_bytes >> told.least_bytes >> told.most_bytes >> told.seconds >>
      told.statistics.nonzeros >> told.statistics.flops >> told.statistics.seconds_analysis;
  told.statistics.bytes = 8.0 * told.statistics.nonzeros;
  told.statistics.bytes_held = told.statistics.bytes;
  return told;
}

/// For each row its place in the elimination, from 1 on: that of this process's own factors.
std::vector<int> elimination_places(const linalg::SparseMatrix& A) {
  const linalg::MatrixGraph graph = linalg::pattern_graph(A);
  std::vector<int> places(static_cast<std::size_t>(A.rows()));
  int next = 0;
  for (const int node : linalg::least_fill_order(graph)) {
    for (const int row : graph.rows[static_cast<std::size_t>(node)]) places[static_cast<std::size_t>(row)] = ++next;
  }
  return places;
}

/// Throws MemoryLimitError where the ranks of a machine would take more than it has.
void require_memory(const RankForecast& told, const TeamOptions& options, double limit_bytes, Eigen::Index rows) {
  const int ranks = options.ranks;
  double limit = told.free_bytes;
  for (const double other : {limit_bytes, core::memory_left_bytes()}) {  // 0 where there is no limit
    if (other > 0.0) limit = std::min(limit, other);
  }
  if (limit <= 0.0 || told.machine_bytes <= limit) return;
  constexpr double most = 1e6;
  const int enough = static_cast<int>(std::min(std::ceil(ranks * told.machine_bytes / limit), most));
  throw linalg::MemoryLimitError(
      fmt::format(
          "the factor of a matrix of {} rows takes {} with {} on one machine, more than the {} that it has: take "
          "{} ranks, spread over more machines{}",
          rows, memory_text(told.machine_bytes), ranks_text(ranks), memory_text(limit), std::max(enough, ranks + 1),
          options.on_disk ? "" : ", or --low-memory, which keeps the factor on disk"),
      told.machine_bytes, limit);
}

/// Throws MemoryLimitError where the disk of a folder has less free than the factor takes.
void require_space(double bytes, const fs::path& folder) {
  const auto free = static_cast<double>(fs::space(folder).available);
  if (bytes <= free) return;
  throw linalg::MemoryLimitError(
      fmt::format("--low-memory: the factor takes {} on the disk of {}, which has {} free: set TMPDIR to a folder with "
                  "more",
                  memory_text(bytes), folder.parent_path().string(), memory_text(free)),
      bytes, free);
}

}  // namespace

linalg::FactorStatistics RankTeam::Impl::factorise(const std::string& number, const linalg::SparseMatrix& A,
                                                   const linalg::FactorOptions& limits) {
  const auto start = Clock::now();
  const std::vector<int> places = elimination_places(A);
  const double ordering_s = std::chrono::duration<double>(Clock::now() - start).count();
  settle();
  write_upper_rows(A, matrix());
  OpenFile written(order(), Access::write);
  written.write(places.data(), sizeof(int) * places.size(), 0);
  written.finish();
  std::istringstream words = ask("analyse " + number + (options.on_disk ? " 1" : " 0"), "analysed");
  const RankForecast told = forecast_of(words);
  fs::remove(matrix());
  core::inform(fmt::format("{} rows on {}: {} to {} a rank{}, about {} for the factor", A.rows(),
                           ranks_text(options.ranks), memory_text(told.least_bytes), memory_text(told.most_bytes),
                           options.on_disk ? ", " + memory_text(told.statistics.bytes) + " on disk" : "",
                           core::readable_text(told.seconds, core::kind::time)));
  require_memory(told, options, limits.memory_limit_bytes, A.rows());
  if (options.on_disk) require_space(told.statistics.bytes, scratch);
  linalg::FactorStatistics statistics = told.statistics;
  statistics.seconds_ordering = ordering_s;
  latest = {told.most_bytes, 0.0, told.seconds, 0.0};
  ask("factorise " + number, "factorised") >> latest.factor_s >> latest.peak_bytes;
  statistics.seconds_numeric = latest.factor_s;
  core::note(fmt::format("the factor took {:.3g} s and at most {} a rank", statistics.seconds_numeric,
                         memory_text(latest.peak_bytes)));
  return statistics;
}

Eigen::MatrixXd RankTeam::Impl::solve(const std::string& number, const Eigen::Ref<const Eigen::MatrixXd>& B) {
  const std::lock_guard lock(busy);
  Eigen::MatrixXd X = B;
  const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(X.size());
  if (bytes == 0) return X;
  settle();
  OpenFile written(columns(), Access::write);
  written.write(X.data(), bytes, 0);
  written.finish();
  (void)ask("solve " + number + " " + std::to_string(X.cols()), "solved");
  OpenFile(columns(), Access::read).read(X.data(), bytes, 0);
  return X;
}

RankTeam::RankTeam(const TeamOptions& options) : impl_(std::make_unique<Impl>()) {
  impl_->options = options;
  impl_->scratch = scratch_name();
  try {
    impl_->start();
  } catch (...) {
    impl_->ranks.reset();
    fs::remove_all(impl_->scratch);
    throw;
  }
}

RankTeam::~RankTeam() {
  if (impl_->ranks) impl_->ranks->say("quit");
  if (impl_->ranks) impl_->ranks->ends_within(0.2);
  impl_->ranks.reset();
  std::error_code ignored;
  fs::remove_all(impl_->scratch, ignored);
}

namespace {

/// A factor on the ranks, by its number there.
class FactorOnRanks : public linalg::ExternalFactor {
 public:
  using Solve = std::function<Eigen::MatrixXd(const Eigen::Ref<const Eigen::MatrixXd>&)>;
  FactorOnRanks(Solve solve, std::function<void()> drop, const linalg::FactorStatistics& statistics)
      : solve_(std::move(solve)), drop_(std::move(drop)), statistics_(statistics) {}
  ~FactorOnRanks() override { drop_(); }
  FactorOnRanks(const FactorOnRanks&) = delete;
  FactorOnRanks& operator=(const FactorOnRanks&) = delete;

  [[nodiscard]] Eigen::MatrixXd solve(const Eigen::Ref<const Eigen::MatrixXd>& B) const override { return solve_(B); }
  [[nodiscard]] linalg::FactorStatistics statistics() const override { return statistics_; }

 private:
  Solve solve_;
  std::function<void()> drop_;
  linalg::FactorStatistics statistics_;
};

}  // namespace

std::unique_ptr<linalg::ExternalFactor> RankTeam::factorise(const linalg::SparseMatrix& A,
                                                            const linalg::FactorOptions& options) {
  Impl& team = *impl_;
  const std::lock_guard lock(team.busy);
  const std::string number = std::to_string(++team.factors);
  linalg::FactorStatistics statistics;
  try {
    statistics = team.factorise(number, A, options);
  } catch (...) {  // a TimeLimit throws what is no Error
    team.tell("drop " + number);
    throw;
  }
  return std::make_unique<FactorOnRanks>(
      [&team, number](const Eigen::Ref<const Eigen::MatrixXd>& B) { return team.solve(number, B); },
      [&team, number] {
        const std::lock_guard dropping(team.busy);
        team.tell("drop " + number);
      },
      statistics);
}

const RankCost& RankTeam::latest() const {
  return impl_->latest;
}

DistributedFactors::DistributedFactors(const TeamOptions& options)
    : team_(options),
      before_(
          linalg::set_factoriser([this, least = options.least_rows](
                                     const linalg::SparseMatrix& A,
                                     const linalg::FactorOptions& limits) -> std::unique_ptr<linalg::ExternalFactor> {
            return A.rows() < least ? nullptr : team_.factorise(A, limits);
          })) {}

DistributedFactors::~DistributedFactors() {
  linalg::set_factoriser(std::move(before_));
}

}  // namespace thinwall::distributed
