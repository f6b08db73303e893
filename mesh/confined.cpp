#include "mesh/confined.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <exception>
#include <fstream>
#include <new>
#include <string>
#include <utility>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/memory.hpp"
#include "core/units.hpp"
#include "mesh/curve_order.hpp"

namespace thinwall::mesh {

namespace {

constexpr int threw = 70;
constexpr int out_of_memory = 71;
constexpr int wrote_all = 0;

/// Address space in use now, bytes.
double address_space() {
  std::ifstream statm("/proc/self/statm");
  double pages = 0.0;
  statm >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// Limits the processor time and memory of this process, and lets it leave no core file.
void limit_resources(double time_limit_s, double memory_limit_bytes) {
  const auto seconds = static_cast<rlim_t>(time_limit_s) + 2;
  const rlimit cpu{seconds, seconds};
  setrlimit(RLIMIT_CPU, &cpu);
  const auto bytes = static_cast<rlim_t>(address_space() + memory_limit_bytes);
  const rlimit memory{bytes, bytes};
  setrlimit(RLIMIT_AS, &memory);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
}

/// Lets this process end with the one that forked it, and hold none of its files but `out`: a lock that the parent has
/// on a folder would last beyond its death.
void belong_to(pid_t parent, int out) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(threw);  // it died before this process had asked for the signal
  if (out > STDERR_FILENO + 1) close_range(STDERR_FILENO + 1, static_cast<unsigned int>(out) - 1, 0);
  close_range(static_cast<unsigned int>(out) + 1, ~0U, 0);
}

/// The forked process: does the work, writes the bytes to `out` and exits.
[[noreturn]] void child(const std::function<std::vector<char>()>& work, int out, double time_limit_s,
                        double memory_limit_bytes) {
  // Signals that the parent handles get their default action, and output of the mesher is discarded.
  for (const int signal_number : {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE})
    std::signal(signal_number, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // the parent kills this process if the user interrupts
  const int null = open("/dev/null", O_WRONLY);
  if (null >= 0) {
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
  }
  const double left = core::memory_left_bytes();
  limit_resources(time_limit_s, left > 0.0 ? std::min(left, memory_limit_bytes) : memory_limit_bytes);
  int status = threw;
  try {
    const std::vector<char> bytes = work();
    std::size_t done = 0;
    while (done < bytes.size()) {
      const ssize_t written = write(out, bytes.data() + done, bytes.size() - done);
      if (written <= 0) _exit(threw);
      done += static_cast<std::size_t>(written);
    }
    status = wrote_all;
  } catch (const std::bad_alloc&) {
    status = out_of_memory;
  } catch (...) {
    status = threw;
  }
  _exit(status);
}

/// The bytes that the child has written, and why reading ended.
struct Outcome {
  std::vector<char> bytes;
  bool timed_out = false;
  std::exception_ptr stopped;  // what core::check_interrupt() threw, if it did
};

/// The processor time that a child has used, s.
double processor_time_s(pid_t child) {
  clockid_t clock{};
  timespec used{};
  if (clock_getcpuclockid(child, &clock) != 0 || clock_gettime(clock, &used) != 0) return 0.0;
  return static_cast<double>(used.tv_sec) + 1e-9 * static_cast<double>(used.tv_nsec);
}

/// Reads from the pipe to which a child writes until it is closed, the child has used the time limit in processor time
/// or has lasted longest_wait times as long, or the computation is to stop.
Outcome read_until_closed(int in, pid_t child, double time_limit_s) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(longest_wait * time_limit_s);
  Outcome outcome;
  std::vector<char> buffer(1U << 18U);
  for (;;) {
    try {
      core::check_interrupt();
    } catch (...) {
      outcome.stopped = std::current_exception();
      return outcome;
    }
    if (processor_time_s(child) > time_limit_s || Clock::now() > deadline) {
      outcome.timed_out = true;
      return outcome;
    }
    pollfd waiting{in, POLLIN, 0};
    if (poll(&waiting, 1, 50) <= 0) continue;
    const ssize_t got = read(in, buffer.data(), buffer.size());
    if (got == 0) return outcome;
    if (got < 0) continue;
    outcome.bytes.insert(outcome.bytes.end(), buffer.begin(), buffer.begin() + got);
  }
}

/// The reason why the child failed, in words.
std::string cause(int status) {
  if (WIFSIGNALED(status)) {
    const int signal_number = WTERMSIG(status);
    if (signal_number == SIGXCPU || signal_number == SIGKILL) return "it was killed at its limit";
    return std::string("it crashed (") + strsignal(signal_number) + ")";
  }
  if (WEXITSTATUS(status) == out_of_memory) return "it ran out of its memory limit";
  return "it gave up with an internal error, or for lack of memory";
}

template <class T>
void append(std::vector<char>& bytes, const T* data, std::size_t count) {
  const auto* begin = reinterpret_cast<const char*>(data);
  bytes.insert(bytes.end(), begin, begin + count * sizeof(T));
}

std::vector<char> serialise(const TetMesh& mesh) {
  std::vector<char> bytes;
  const std::array<std::size_t, 2> counts{mesh.vertices.size(), mesh.tets.size()};
  append(bytes, counts.data(), counts.size());
  append(bytes, mesh.vertices.data(), mesh.vertices.size());
  append(bytes, mesh.tets.data(), mesh.tets.size());
  return bytes;
}

TetMesh deserialise(const std::vector<char>& bytes) {
  TetMesh mesh;
  std::array<std::size_t, 2> counts{};
  if (bytes.size() < sizeof counts) return mesh;
  std::memcpy(counts.data(), bytes.data(), sizeof counts);
  if (counts[1] == 0) return mesh;  // TetGen returns no tetrahedra for an open surface
  mesh.vertices.resize(counts[0]);
  mesh.tets.resize(counts[1]);
  const char* points = bytes.data() + sizeof counts;
  const std::size_t point_bytes = counts[0] * sizeof(Eigen::Vector3d);
  std::memcpy(static_cast<void*>(mesh.vertices.data()), points, point_bytes);
  std::memcpy(static_cast<void*>(mesh.tets.data()), points + point_bytes, counts[1] * sizeof(std::array<int, 4>));
  return mesh;
}

void turn_positive(TetMesh& mesh) {
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet)
    if (volume(mesh, static_cast<int>(tet)) < 0.0) std::swap(mesh.tets[tet][2], mesh.tets[tet][3]);
}

}  // namespace

TetMesh mesh_confined(const char* name, const std::function<TetMesh()>& work, const ProcessLimits& limits) {
  TetMesh mesh;
  try {
    mesh = deserialise(run_confined([&] { return serialise(work()); }, limits.time_s, limits.memory_bytes));
  } catch (const core::NumericalError& error) {
    throw core::NumericalError(std::string(name) + " failed on the part's surface: " + error.what());
  }
  if (mesh.tets.empty())
    throw core::NumericalError(std::string(name) + " returned no tetrahedra: the surface is not closed");
  turn_positive(mesh);
  order_along_curve(mesh);
  return mesh;
}

std::vector<char> run_confined(const std::function<std::vector<char>()>& work, double time_limit_s,
                               double memory_limit_bytes) {
  int ends[2];
  if (pipe(ends) != 0) throw core::NumericalError("the mesher could not be started: no pipe");
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) throw core::NumericalError("the mesher could not be started: no process");
  if (pid == 0) {
    belong_to(parent, ends[1]);
    child(work, ends[1], time_limit_s, memory_limit_bytes);
  }
  close(ends[1]);
  Outcome outcome = read_until_closed(ends[0], pid, time_limit_s);
  close(ends[0]);
  if (outcome.timed_out || outcome.stopped) kill(pid, SIGKILL);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (outcome.stopped) std::rethrow_exception(outcome.stopped);
  if (outcome.timed_out)
    throw core::NumericalError("it did not finish within " + core::number_text(time_limit_s, 3) + " s");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != wrote_all) throw core::NumericalError(cause(status));
  return std::move(outcome.bytes);
}

}  // namespace thinwall::mesh
