#include "app/log.hpp"

#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>

#include "core/error.hpp"
#include "core/messages.hpp"

namespace thinwall::app {

void log_to_terminal(int verbosity, bool over_a_line) {
  auto terminal = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  terminal->set_level(verbosity < 0 ? spdlog::level::warn : verbosity > 0 ? spdlog::level::debug : spdlog::level::info);
  terminal->set_pattern(over_a_line ? "\r\033[K%v" : "%v");
  auto logger = std::make_shared<spdlog::logger>("thinwall", terminal);
  logger->set_level(spdlog::level::debug);
  spdlog::set_default_logger(logger);
}

void log_to_file(const std::filesystem::path& file) {
  try {
    auto sink = std::make_shared<spdlog::sinks::basic_file_sink_mt>(file.string(), true);
    sink->set_pattern("%Y-%m-%dT%H:%M:%S%z %l %v");
    spdlog::default_logger()->sinks().push_back(sink);
    spdlog::default_logger()->flush_on(spdlog::level::info);
    spdlog::default_logger()->set_error_handler([name = file.string(), told = false](const std::string& cause) mutable {
      if (!told) std::fprintf(stderr, "thinwall: messages are missing in \"%s\": %s\n", name.c_str(), cause.c_str());
      told = true;
    });
  } catch (const spdlog::spdlog_ex& error) {
    throw core::DataError("cannot write \"" + file.string() + "\": " + error.what() +
                          "; choose another folder with --out");
  }
}

void messages_to_log() {
  core::set_message_listener([](core::MessageLevel level, const std::string& text) {
    spdlog::log(level == core::MessageLevel::warning ? spdlog::level::warn
                : level == core::MessageLevel::info  ? spdlog::level::info
                                                     : spdlog::level::debug,
                "{}", text);
  });
}

}  // namespace thinwall::app
