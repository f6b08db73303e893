#include "core/memory.hpp"

#include <malloc.h>
#include <sys/mman.h>

#include <fstream>
#include <memory>
#include <string>

namespace thinwall::core {

double available_memory_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  double kilobytes = 0.0;
  std::string unit;
  while (file >> name >> kilobytes >> unit) {
    if (name == "MemAvailable:") return 1024.0 * kilobytes;
  }
  return 0.0;
}

void keep_freed_memory() {
  mallopt(M_MMAP_MAX, 0);  // otherwise blocks above 32 MB are given back to the system, whatever the threshold
  mallopt(M_TRIM_THRESHOLD, -1);
}

void want_large_pages(void* memory, std::size_t bytes) {
  constexpr std::size_t page = std::size_t{2} << 20;
  if (bytes < 4 * page || std::align(page, page, memory, bytes) == nullptr) return;
  madvise(memory, bytes / page * page, MADV_HUGEPAGE);
}

}  // namespace thinwall::core
