#include "study/stages.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/interrupt.hpp"

namespace thinwall::study {

std::string duration_text(double seconds) {
  if (seconds <= 99.0) return fmt::format("{:.0f} s", std::ceil(seconds));
  if (seconds <= 99.0 * 60.0) return fmt::format("{:.0f} min", std::ceil(seconds / 60.0));
  return fmt::format("{:.0f} h", std::ceil(seconds / 3600.0));
}

std::string progress_text(const std::string& stage, const core::ProgressReport& report) {
  std::string text = fmt::format("{}: {} of {} {}", stage, report.done, report.total, report.items);
  const auto left = core::seconds_left(report);
  if (left && report.seconds >= 1.0 && report.done < report.total) text += ", " + duration_text(*left) + " left";
  return text;
}

Stages::Stages(ProgressDisplay display) : display_(display) {
  if (display == ProgressDisplay::none) return;
  const auto interval = display == ProgressDisplay::line ? std::chrono::milliseconds(100) : std::chrono::seconds(10);
  core::set_progress_listener([this](const core::ProgressReport& report) { show(report); }, interval);
}

Stages::~Stages() {
  if (display_ == ProgressDisplay::none) return;
  core::set_progress_listener({});
  clear_line();
}

void Stages::begin(const std::string& name) {
  end();
  core::check_interrupt();
  current_ = name;
  stage_start_ = Clock::now();
  if (display_ == ProgressDisplay::line) write_line(name + " …");
  spdlog::log(display_ == ProgressDisplay::lines ? spdlog::level::info : spdlog::level::debug, "stage: {}", name);
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

/// Called from the loop's threads, while the stage stays what it is.
void Stages::show(const core::ProgressReport& report) const {
  if (display_ == ProgressDisplay::line) {
    write_line(progress_text(current_, report));
  } else if (report.seconds >= 5.0) {  // a short loop needs no more than its stage's line
    spdlog::info("{}", progress_text(current_, report));
  }
}

void Stages::write_line(const std::string& text) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  std::fprintf(stderr, "\r\033[K%6.1f s  %s", elapsed, text.c_str());
  std::fflush(stderr);
}

void Stages::clear_line() const {
  if (display_ != ProgressDisplay::line) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace thinwall::study
