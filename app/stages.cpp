#include "app/stages.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstdio>

#include "core/interrupt.hpp"

namespace thinwall::app {

void Stages::begin(const std::string& name) {
  end();
  core::check_interrupt();
  current_ = name;
  stage_start_ = Clock::now();
  if (terminal_) {
    const double elapsed = std::chrono::duration<double>(stage_start_ - start_).count();
    std::fprintf(stderr, "\r\033[K%6.1f s  %s …", elapsed, name.c_str());
    std::fflush(stderr);
    spdlog::debug("stage: {}", name);
  } else {
    spdlog::info("stage: {}", name);
  }
}

void Stages::end() {
  if (current_.empty()) return;
  const double seconds = std::chrono::duration<double>(Clock::now() - stage_start_).count();
  const auto same = std::find_if(timings_.begin(), timings_.end(), [&](const auto& t) { return t.first == current_; });
  if (same == timings_.end()) {
    timings_.emplace_back(current_, seconds);
  } else {
    same->second += seconds;
  }
  current_.clear();
  clear_line();
}

std::vector<std::pair<std::string, double>> Stages::timings_s() const {
  auto all = timings_;
  all.emplace_back("total", std::chrono::duration<double>(Clock::now() - start_).count());
  return all;
}

void Stages::clear_line() const {
  if (terminal_) std::fprintf(stderr, "\r\033[K");
}

}  // namespace thinwall::app
