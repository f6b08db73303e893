#include "linalg/large_array.hpp"

#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "core/memory.hpp"

namespace thinwall::linalg {

namespace {
constexpr std::size_t large_page = std::size_t{2} << 20;
}

void FreeLarge::operator()(void* memory) const noexcept {
  std::free(memory);
}

std::unique_ptr<void, FreeLarge> allocate_large(std::size_t bytes) {
  const bool large = bytes > 4 * large_page;
  const std::size_t page = large ? large_page : 64;
  const std::size_t whole = (bytes / page + 1) * page;
  std::unique_ptr<void, FreeLarge> memory(std::aligned_alloc(page, whole));
  if (memory == nullptr) {
    throw core::NumericalError("out of memory for a block of " + std::to_string(static_cast<double>(bytes) * 1e-9) +
                               " GB: use larger elements");
  }
  core::want_large_pages(memory.get(), whole);
  return memory;
}

}  // namespace thinwall::linalg
