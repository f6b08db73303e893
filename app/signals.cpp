#include "app/signals.hpp"

#include <semaphore.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <mutex>
#include <string_view>
#include <thread>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/interrupt.hpp"

namespace thinwall::app {

namespace {

constexpr auto patience = std::chrono::milliseconds(300);

sem_t signal_came;
std::mutex ending;  // held while the program may not be cut short, and from then on when it is

extern "C" void on_signal(int signal) {
  core::request_interrupt();
  sem_post(&signal_came);  // one of the few calls that a handler may make
  std::signal(signal, SIG_DFL);
}

/// Ends the process where the request to stop was not heard in time.
[[noreturn]] void end_now() {
  constexpr std::string_view said = "thinwall: interrupted\n";
  ending.lock();
  core::remove_partial_paths();
  if (::isatty(STDERR_FILENO) != 0) (void)!::write(STDERR_FILENO, "\r\033[K", 4);
  (void)!::write(STDERR_FILENO, said.data(), said.size());
  ::_exit(static_cast<int>(core::ExitCode::interrupted));
}

void wait_for_signal() {
  while (sem_wait(&signal_came) != 0 && errno == EINTR) {
  }
  std::this_thread::sleep_for(patience);
  end_now();
}

}  // namespace

void install_signal_handlers() {
  sem_init(&signal_came, 0, 0);
  std::thread(wait_for_signal).detach();
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

Undisturbed::Undisturbed() {
  ending.lock();
}
Undisturbed::~Undisturbed() {
  ending.unlock();
}

}  // namespace thinwall::app
