#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <new>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "mesh/tetgen.hpp"

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

/// The forked process: works, writes, never returns.
[[noreturn]] void child(const std::function<std::vector<char>()>& work, int out, double time_limit_s,
                        double memory_limit_bytes) {
  // The parent's handlers and its terminal output are not this process's business.
  for (const int signal_number : {SIGINT, SIGTERM, SIGABRT, SIGSEGV, SIGBUS, SIGFPE})
    std::signal(signal_number, SIG_DFL);
  std::signal(SIGINT, SIG_IGN);  // the parent decides and kills
  const int null = open("/dev/null", O_WRONLY);
  if (null >= 0) {
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
  }
  limit_resources(time_limit_s, memory_limit_bytes);
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

struct Outcome {
  std::vector<char> bytes;
  bool timed_out = false;
  bool interrupted = false;
};

Outcome read_until_closed(int in, double time_limit_s) {
  using Clock = std::chrono::steady_clock;
  const auto deadline = Clock::now() + std::chrono::duration<double>(time_limit_s);
  Outcome outcome;
  std::vector<char> buffer(1U << 18U);
  for (;;) {
    if (core::interrupt_requested()) {
      outcome.interrupted = true;
      return outcome;
    }
    if (Clock::now() > deadline) {
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

std::string cause(int status) {
  if (WIFSIGNALED(status)) {
    const int signal_number = WTERMSIG(status);
    if (signal_number == SIGXCPU || signal_number == SIGKILL) return "it was killed at its limit";
    return std::string("it crashed (") + strsignal(signal_number) + ")";
  }
  if (WEXITSTATUS(status) == out_of_memory) return "it ran out of its memory limit";
  return "it gave up with an internal error, or for lack of memory";
}

}  // namespace

std::vector<char> run_confined(const std::function<std::vector<char>()>& work, double time_limit_s,
                               double memory_limit_bytes) {
  int ends[2];
  if (pipe(ends) != 0) throw core::NumericalError("the mesher could not be started: no pipe");
  const pid_t pid = fork();
  if (pid < 0) throw core::NumericalError("the mesher could not be started: no process");
  if (pid == 0) {
    close(ends[0]);
    child(work, ends[1], time_limit_s, memory_limit_bytes);
  }
  close(ends[1]);
  Outcome outcome = read_until_closed(ends[0], time_limit_s);
  close(ends[0]);
  if (outcome.timed_out || outcome.interrupted) kill(pid, SIGKILL);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (outcome.interrupted) throw core::Interrupted();
  if (outcome.timed_out) throw core::NumericalError("it did not finish within " + std::to_string(time_limit_s) + " s");
  if (!WIFEXITED(status) || WEXITSTATUS(status) != wrote_all) throw core::NumericalError(cause(status));
  return std::move(outcome.bytes);
}

}  // namespace thinwall::mesh
