#include "study/kept/input_key.hpp"

#include "io/manifest.hpp"
#include "io/program_id.hpp"

namespace thinwall::study {

std::string key_of_bytes(const std::string& bytes) {
  return io::sha256(io::program_id() + "\n" + bytes);
}

}  // namespace thinwall::study
