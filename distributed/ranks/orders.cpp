#include "distributed/ranks/orders.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <thread>

#include "core/error.hpp"
#include "distributed/ranks/rank_factor.hpp"

namespace thinwall::distributed {

namespace {

namespace fs = std::filesystem;

bool first_rank() {
  int number = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &number);
  return number == 0;
}

/// Broadcasts from the first rank; the others sleep until it comes, where MPI_Bcast would poll.
void broadcast(void* data, int bytes) {
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Ibcast(data, bytes, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
  for (int came = 0; came == 0;) {
    MPI_Test(&request, &came, MPI_STATUS_IGNORE);
    if (came == 0) std::this_thread::sleep_for(std::chrono::microseconds(200));
  }
}

/// The next line of the first rank's input, on all ranks.
std::string next_order() {
  std::string line;
  if (first_rank() && !std::getline(std::cin, line)) line = "quit";
  int length = static_cast<int>(line.size());
  broadcast(&length, sizeof length);
  line.resize(static_cast<std::size_t>(length));
  broadcast(line.data(), length);
  return line;
}

void answer(const std::string& text) {
  if (first_rank()) std::cout << "= " << text << std::endl;
}

/// The name of the MPI library, without the lines and details behind it.
std::string library() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = "";
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string all(text, static_cast<std::size_t>(length));
  return all.substr(0, all.find_first_of(",\n"));
}

/// Throws DataError unless every rank sees the scratch folder.
void require_shared(const fs::path& folder) {
  if (::access(folder.c_str(), R_OK | W_OK) == 0) return;
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  throw core::DataError("a rank on " + std::string(host) + " does not see " + folder.string() +
                        ": set TMPDIR to a folder that all machines share");
}

std::string text_of(const Forecast& told) {
  return fmt::format("analysed {} {} {} {} {} {} {} {}", told.machine_bytes, told.free_bytes, told.least_bytes,
                     told.most_bytes, told.seconds, told.entries, told.flops, told.analysis_s);
}

/// The answer to a numeric phase that has failed; none if it has not.
std::optional<std::string> failure(const Outcome& outcome) {
  constexpr int not_definite_root = -40, singular = -10;
  if (outcome.error == not_definite_root || outcome.error == singular || outcome.negative_pivots > 0)
    return "the matrix is not positive definite: a motion without stiffness, an element turned inside out, or a wall "
           "too thin for double precision";
  constexpr int disk = -90;
  if (outcome.error == disk) return "MUMPS cannot keep the factor on the disk of TMPDIR: is it full?";
  if (outcome.error < 0)
    return fmt::format("MUMPS ends with error {} ({}) of its manual: take more ranks or more memory", outcome.error,
                       outcome.detail);
  return std::nullopt;
}

/// The factors by their numbers.
using Factors = std::map<int, std::unique_ptr<RankFactor>>;

void carry_out(const std::string& order, std::istream& words, const fs::path& folder, Factors& factors) {
  int number = 0, count = 0;
  words >> number >> count;
  if (order == "hello") {
    int size = 0;
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    answer(fmt::format("ready {} {}", size, library()));
  } else if (order == "analyse") {
    factors[number] = std::make_unique<RankFactor>(folder / "matrix", folder / "order");
    answer(text_of(factors.at(number)->analyse(count != 0 ? folder : fs::path())));
  } else if (order == "factorise") {
    const Outcome outcome = factors.at(number)->factorise();
    const std::optional<std::string> failed = failure(outcome);
    if (failed) factors.erase(number);
    answer(failed ? "failed " + *failed : fmt::format("factorised {} {}", outcome.seconds, outcome.peak_bytes));
  } else if (order == "solve") {
    factors.at(number)->solve(folder / "columns", count);
    answer("solved");
  } else if (order == "drop") {
    factors.erase(number);
    answer("dropped");
  }
}

}  // namespace

void carry_out_orders(const fs::path& folder) {
  require_shared(folder);
  Factors factors;
  while (true) {
    std::istringstream words(next_order());
    std::string order;
    words >> order;
    if (order == "quit") return;
    carry_out(order, words, folder, factors);
  }
}

}  // namespace thinwall::distributed
