#include "app/stage_display.hpp"

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>

#include <cmath>
#include <cstdio>

namespace thinwall::app {

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
  const auto interval = display == ProgressDisplay::line ? std::chrono::milliseconds(100) : std::chrono::seconds(10);
  core::set_progress_listener([this](const core::ProgressReport& report) { show(report); }, interval);
}

StageDisplay::~StageDisplay() {
  if (display_ == ProgressDisplay::none) return;
  core::set_progress_listener({});
  clear_line();
}

study::StageListener StageDisplay::listener() {
  return [this](const std::string& name) { stage(name); };
}

void StageDisplay::stage(const std::string& name) {
  current_ = name;
  if (name.empty()) return clear_line();
  if (display_ == ProgressDisplay::line) write_line(name + " …");
  spdlog::log(display_ == ProgressDisplay::lines ? spdlog::level::info : spdlog::level::debug, "stage: {}", name);
}

/// Called from the loop's threads, while the stage stays what it is.
void StageDisplay::show(const core::ProgressReport& report) const {
  if (display_ == ProgressDisplay::line) {
    write_line(progress_text(current_, report));
  } else if (report.seconds >= 5.0) {  // a short loop needs no more than its stage's line
    spdlog::info("{}", progress_text(current_, report));
  }
}

void StageDisplay::write_line(const std::string& text) const {
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  std::fprintf(stderr, "\r\033[K%6.1f s  %s", elapsed, text.c_str());
  std::fflush(stderr);
}

void StageDisplay::clear_line() const {
  if (display_ != ProgressDisplay::line) return;
  std::fprintf(stderr, "\r\033[K");
  std::fflush(stderr);
}

}  // namespace thinwall::app
