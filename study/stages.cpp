#include "study/stages.hpp"

#include <algorithm>

#include "core/interrupt.hpp"

namespace thinwall::study {

void Stages::begin(const std::string& name) {
  end();
  core::check_interrupt();
  current_ = name;
  stage_start_ = Clock::now();
  if (listener_) listener_(name);
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
  if (listener_) listener_("");
}

std::vector<std::pair<std::string, double>> Stages::timings_s() const {
  auto all = timings_;
  all.emplace_back("total", std::chrono::duration<double>(Clock::now() - start_).count());
  return all;
}

}  // namespace thinwall::study
