#include "core/faults.hpp"

#include <cmath>
#include <sstream>

#include "core/error.hpp"

namespace thinwall::core {

void Faults::require(bool holds, const std::string& where, const std::string& what) {
  if (!holds) text_ += (text_.empty() ? "" : "; ") + where + " " + what;
}

void Faults::require_number(double value, bool holds, const std::string& where, const std::string& what,
                            const std::string& bound) {
  if (holds && std::isfinite(value)) return;
  std::ostringstream text;
  text << "has the " << what << " " << value << ": it must " << bound;
  require(false, where, text.str());
}

void Faults::raise(const std::string& subject) const {
  if (!text_.empty()) throw InputError(subject + ": " + text_);
}

}  // namespace thinwall::core
