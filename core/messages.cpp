#include "core/messages.hpp"

#include <mutex>
#include <utility>

namespace thinwall::core {

namespace {

struct Outlet {
  std::recursive_mutex mutex;  // recursive, because a listener may itself send a message
  MessageListener listener;
};

Outlet& outlet() {
  static Outlet one;
  return one;
}

}  // namespace

MessageListener set_message_listener(MessageListener listener) {
  const std::lock_guard lock(outlet().mutex);
  std::swap(outlet().listener, listener);
  return listener;
}

void tell(MessageLevel level, const std::string& text) {
  const std::lock_guard lock(outlet().mutex);
  if (outlet().listener) outlet().listener(level, text);
}

}  // namespace thinwall::core
