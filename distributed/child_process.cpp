#include "distributed/child_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "core/error.hpp"
#include "core/interrupt.hpp"

namespace thinwall::distributed {

namespace {

constexpr int poll_ms = 50;

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> list;
  list.reserve(texts.size() + 1);
  for (std::string& text : texts) list.push_back(text.data());
  list.push_back(nullptr);
  return list;
}

/// The environment of this process with some variables changed.
std::vector<std::string> environment_with(const std::map<std::string, std::string>& changed) {
  std::vector<std::string> all;
  for (char** entry = ::environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    if (!changed.contains(text.substr(0, text.find('=')))) all.push_back(text);
  }
  for (const auto& [name, value] : changed) all.push_back(std::string(name).append("=").append(value));
  return all;
}

/// The part of the new process after the fork, of calls alone that are safe there.
[[noreturn]] void become(pid_t parent, int in, int out, int errors, char* const* words, char* const* environment) {
  constexpr int not_started = 127;
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(not_started);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(errors, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  ::execvpe(words[0], words, environment);
  ::_exit(not_started);
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& words, const std::map<std::string, std::string>& environment,
                           const std::filesystem::path& errors) {
  std::vector<std::string> arguments = words, variables = environment_with(environment);
  const std::vector<char*> argv = pointers(arguments), envp = pointers(variables);
  std::array<int, 2> in{}, out{};
  const int log = ::open(errors.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
  if (log < 0 || ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, in.data()) != 0 ||
      ::pipe2(out.data(), O_CLOEXEC) != 0)
    throw core::DataError("cannot start " + words.front() + ": " + std::strerror(errno));
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(parent, in[0], out[1], log, argv.data(), envp.data());
  const int failure = errno;
  for (const int file : {in[0], out[1], log}) ::close(file);
  to_ = in[1];
  from_ = out[0];
  if (pid_ < 0) throw core::DataError("cannot start " + words.front() + ": " + std::strerror(failure));
}

ChildProcess::~ChildProcess() {
  ::close(to_);
  ::close(from_);
  if (ends_within(0.0)) return;
  ::kill(-pid_, SIGTERM);
  if (ends_within(0.1)) return;
  ::kill(-pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
}

void ChildProcess::say(const std::string& line) {
  const std::string text = line + '\n';
  for (std::size_t done = 0; done < text.size();) {
    // Not write(), which raises SIGPIPE where the program has died.
    const ssize_t put = ::send(to_, text.data() + done, text.size() - done, MSG_NOSIGNAL);
    if (put < 0 && errno != EINTR) return;  // hear() finds that it has ended
    if (put > 0) done += static_cast<std::size_t>(put);
  }
}

std::optional<std::string> ChildProcess::hear() {
  while (true) {
    if (const std::size_t end = heard_.find('\n'); end != std::string::npos) {
      std::string line = heard_.substr(0, end);
      heard_.erase(0, end + 1);
      return line;
    }
    core::check_interrupt();
    pollfd waiting{from_, POLLIN, 0};
    if (::poll(&waiting, 1, poll_ms) <= 0) continue;
    std::array<char, 4096> bytes{};
    const ssize_t got = ::read(from_, bytes.data(), bytes.size());
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return std::nullopt;
    heard_.append(bytes.data(), static_cast<std::size_t>(got));
  }
}

bool ChildProcess::ends_within(double seconds) {
  if (pid_ < 0) return true;
  const auto until = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (true) {
    if (::waitpid(pid_, nullptr, WNOHANG) != 0) {
      pid_ = -1;
      return true;
    }
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace thinwall::distributed
