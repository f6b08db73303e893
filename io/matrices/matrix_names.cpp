#include "io/matrices/matrix_names.hpp"

#include "core/error.hpp"
#include "io/mesh/inp_text.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

std::size_t matrix_by_name(const std::vector<std::string>& names, const std::string& wanted, char letter,
                           const std::string& path) {
  std::vector<std::size_t> found;
  std::string list;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const bool by_letter = names[i].starts_with(letter) && !names[i].starts_with("K4");
    if (wanted.empty() ? by_letter : names[i] == capitals(wanted)) found.push_back(i);
    list += (i == 0 ? "" : ", ") + names[i];
  }
  if (found.size() == 1) return found.front();
  throw core::DataError(path + ": has " + (found.empty() ? "no" : "more than one") + " matrix " +
                        (wanted.empty() ? std::string("whose name begins with ") + letter : io::quoted(wanted)) +
                        "; state the name, one of " + list);
}

}  // namespace thinwall::io
