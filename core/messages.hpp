#pragma once
// Messages of a computation to whoever watches it: the library tells them, a program or a page decides where they
// appear.

#include <functional>
#include <string>

namespace thinwall::core {

/// The weight of a message: `info` tells the course of a computation, `warning` a doubt about its result.
enum class MessageLevel { debug, info, warning };

/// A function that is told every message, from whichever thread it comes, one at a time.
using MessageListener = std::function<void(MessageLevel level, const std::string& text)>;

/// Replaces the listener of this process and returns the one before; an empty one drops every message, which is how
/// the library starts.
MessageListener set_message_listener(MessageListener listener);

/// Tells the listener one message. What the listener throws passes through.
void tell(MessageLevel level, const std::string& text);

/// Tells a doubt about a result: the user should read it.
inline void warn(const std::string& text) {
  tell(MessageLevel::warning, text);
}

/// Tells the course of a computation.
inline void inform(const std::string& text) {
  tell(MessageLevel::info, text);
}

/// Tells a detail that only a log holds.
inline void note(const std::string& text) {
  tell(MessageLevel::debug, text);
}

}  // namespace thinwall::core
