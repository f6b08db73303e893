#include "core/memory.hpp"

#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

#include "core/error.hpp"
#include "core/units.hpp"

namespace thinwall::core {

namespace {

std::atomic<double> limit_bytes{0.0};

/// The number in a file of one number; infinity for another text ("max") or no file.
double number_in(const char* path) {
  std::ifstream file(path);
  double number = 0.0;
  return file >> number ? number : std::numeric_limits<double>::infinity();
}

/// The memory that the control group of a container leaves, bytes; infinity where there is none.
double left_by_control_group() {
  const double most = number_in("/sys/fs/cgroup/memory.max"), now = number_in("/sys/fs/cgroup/memory.current");
  return std::isfinite(most) && std::isfinite(now) ? std::max(1.0, most - now) : most;
}

/// Bytes that the allocator has taken from the system and that nobody uses.
double unused_bytes() {
  return static_cast<double>(::mallinfo2().fordblks);
}

}  // namespace

double available_memory_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string name;
  double kilobytes = 0.0;
  std::string unit;
  while (file >> name >> kilobytes >> unit) {
    if (name != "MemAvailable:") continue;
    return std::min(1024.0 * kilobytes, left_by_control_group());
  }
  return 0.0;
}

double held_memory_bytes() {
  std::ifstream file("/proc/self/statm");
  double whole = 0.0, resident = 0.0;
  return file >> whole >> resident ? resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) : 0.0;
}

void set_memory_limit(double bytes) {
  limit_bytes = bytes;
}

double memory_limit_bytes() {
  return limit_bytes;
}

double memory_left_bytes() {
  const double limit = limit_bytes;
  if (limit > 0.0) return std::max(1.0, limit - held_memory_bytes() + unused_bytes());
  const double available = available_memory_bytes();
  return available > 0.0 ? available + unused_bytes() : 0.0;
}

std::string memory_left_text() {
  const std::string left = readable_text(memory_left_bytes(), kind::memory);
  if (!(limit_bytes > 0.0)) return left + " are free";
  return left + " are left of the " + readable_text(limit_bytes, kind::memory) + " of --memory";
}

void require_memory(double bytes, const std::string& stage) {
  const double left = memory_left_bytes();
  if (left <= 0.0 || bytes <= left) return;
  throw NumericalError(stage + " needs " + readable_text(bytes, kind::memory) + ", and " + memory_left_text() +
                       "; take larger elements, a lower order or fewer modes, or give more by --memory");
}

void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);  // the largest that the allocator takes
  mallopt(M_TRIM_THRESHOLD, -1);
}

void want_large_pages(void* memory, std::size_t bytes) {
  constexpr std::size_t page = std::size_t{2} << 20;
  if (bytes < 4 * page || std::align(page, page, memory, bytes) == nullptr) return;
  madvise(memory, bytes / page * page, MADV_HUGEPAGE);
}

}  // namespace thinwall::core
