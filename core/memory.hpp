#pragma once
// The machine's memory, and how the program holds on to what it has.

#include <cstddef>

namespace thinwall::core {

/// Bytes that can be allocated without swapping, as the kernel estimates them (/proc/meminfo, MemAvailable); 0 if it
/// does not say.
[[nodiscard]] double available_memory_bytes();

/// Lets the allocator keep what is freed, for the whole process: a program for one run and then the end. Why: factors
/// and bases are allocated and freed over and over, and half the time of a small factorisation can go into page faults.
/// Each thread keeps an arena of its own: one for all would save 5 % of the memory at 170 000 degrees of freedom, and
/// cost a stability chart, which allocates small matrices all the time, 40 % of its time in waiting for the other.
/// To be called once, first thing in main().
void keep_freed_memory();

/// Asks for pages of 2 MB under the whole ones of these bytes, which have not been written to yet: 1 GB of small pages
/// takes 0.25 s to touch first on two threads, of large ones 0.04 s. A wish; refused, it costs nothing. Blocks below
/// 8 MB are left alone.
void want_large_pages(void* memory, std::size_t bytes);

}  // namespace thinwall::core
