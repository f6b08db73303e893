#pragma once
// Messages of a computation: the library sends them, and the listener that a program has set decides where they appear.

#include <functional>
#include <string>
#include <utility>

namespace thinwall::core {

/// The importance of a message: `debug` is a detail for a log, `info` reports the course of a computation, `warning` a
/// doubt about its result.
enum class MessageLevel { debug, info, warning };

/// A function that receives every message. Calls come from any thread, but one at a time.
using MessageListener = std::function<void(MessageLevel level, const std::string& text)>;

/// Replaces the listener of this process and returns the previous one. An empty listener drops every message; the
/// process starts with an empty one.
MessageListener set_message_listener(MessageListener listener);

/// Sends one message to the listener. An exception of the listener passes through to the caller.
void tell(MessageLevel level, const std::string& text);

/// Drops every message of the process while the object lives, as of what a forecast tries out and the run says again.
class Silence {
 public:
  Silence() : before_(set_message_listener({})) {}
  ~Silence() { set_message_listener(std::move(before_)); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  MessageListener before_;
};

/// Sends a warning: a doubt about a result that the user should read.
inline void warn(const std::string& text) {
  tell(MessageLevel::warning, text);
}

/// Sends an information about the course of a computation.
inline void inform(const std::string& text) {
  tell(MessageLevel::info, text);
}

/// Sends a detail that is meant for a log only.
inline void note(const std::string& text) {
  tell(MessageLevel::debug, text);
}

}  // namespace thinwall::core
