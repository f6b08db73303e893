#pragma once
// The memory of the machine, and settings of the allocator.

#include <cstddef>

namespace thinwall::core {

/// Number of bytes that can be allocated without swapping, as the kernel estimates it (MemAvailable in /proc/meminfo);
/// 0 if the kernel gives no estimate.
[[nodiscard]] double available_memory_bytes();

/// Makes the allocator keep freed memory for the whole process, which suits a program that does one run and ends:
/// factors and bases are allocated and freed over and over, and half the time of a small factorisation can go into page
/// faults. Each thread keeps an arena of its own. A single arena for all threads would save 5 % of the memory at 170
/// 000 degrees of freedom; but in a stability chart, which allocates small matrices all the time, threads would spend
/// 40 % of the time waiting for each other. Call it once, first thing in main().
void keep_freed_memory();

/// Asks the kernel to use pages of 2 MB for this memory, which must not have been written to yet; only whole pages
/// within it are concerned. Touching 1 GB for the first time on two threads takes 0.25 s with small pages and 0.04 s
/// with large ones. The kernel may refuse, which costs nothing. Blocks below 8 MB are left alone.
void want_large_pages(void* memory, std::size_t bytes);

}  // namespace thinwall::core
