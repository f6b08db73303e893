#include "app/stage_display.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>

namespace thinwall::app {

namespace {

constexpr std::chrono::milliseconds between_counts = std::chrono::seconds(10);  // of a long loop, in a log
constexpr std::chrono::milliseconds quiet_for = std::chrono::seconds(15);       // a log at most: a count comes before

}  // namespace

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

StageDisplay::StageDisplay(ProgressDisplay display) : display_(display) {
  if (display == ProgressDisplay::none) return;
  const auto interval = display == ProgressDisplay::line ? std::chrono::milliseconds(100) : between_counts;
  core::set_progress_listener([this](const core::ProgressReport& report) { show(report); }, interval);
  ticker_ = std::jthread([this](const std::stop_token& stop) { tell_that_it_goes_on(stop); });
}

StageDisplay::~StageDisplay() {
  if (display_ == ProgressDisplay::none) return;
  core::set_progress_listener({});
  ticker_.request_stop();
  ticker_.join();
  clear_line();
}

study::StageListener StageDisplay::listener() {
  return [this](const std::string& name) { stage(name); };
}

void StageDisplay::stage(const std::string& name) {
  const std::scoped_lock lock(mutex_);
  current_ = name;
  if (name.empty()) return clear_line();
  stage_start_ = told_ = Clock::now();
  text_ = name + " …";
  if (display_ == ProgressDisplay::line) write_line();
  spdlog::log(display_ == ProgressDisplay::lines ? spdlog::level::info : spdlog::level::debug, "stage: {}", name);
}

void StageDisplay::show(const core::ProgressReport& report) {
  const std::scoped_lock lock(mutex_);
  text_ = progress_text(current_, report);
  if (display_ == ProgressDisplay::line) {
    write_line();
  } else if (report.seconds >= 5.0) {  // a short loop needs no more than its stage's line
    told_ = Clock::now();
    spdlog::info("{}", text_);
  }
}

void StageDisplay::tell_that_it_goes_on(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    stopped_.wait_for(lock, stop, std::chrono::seconds(1), [] { return false; });
    if (current_.empty() || stop.stop_requested()) continue;
    const Clock::time_point now = Clock::now();
    if (display_ == ProgressDisplay::line) {
      write_line();
    } else if (now - told_ >= quiet_for) {
      told_ = now;
      const double seconds = std::chrono::duration<double>(now - stage_start_).count();
      spdlog::info("{}: has taken {} so far", current_, duration_text(seconds));
    }
  }
}

void StageDisplay::write_line() const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  std::fprintf(stderr, "\r\033[K%6.1f s  %s", elapsed, text_.c_str());
  std::fflush(stderr);
}

void StageDisplay::clear_line() const {
  if (display_ != ProgressDisplay::line) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace thinwall::app
