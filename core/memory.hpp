#pragma once
// The memory of the machine, and settings of the allocator.

#include <cstddef>
#include <string>

namespace thinwall::core {

/// Number of bytes that can be allocated without swapping, as the kernel estimates it (MemAvailable in /proc/meminfo),
/// and no more than a control group leaves (memory.max of a container); 0 if the kernel gives no estimate.
[[nodiscard]] double available_memory_bytes();

/// Number of bytes of physical memory that this process holds; 0 if the kernel does not tell.
[[nodiscard]] double held_memory_bytes();

/// Sets the memory that the whole process may hold, in bytes, for memory_left_bytes(); 0: what the machine has free.
void set_memory_limit(double bytes);

/// The limit that set_memory_limit() set last; 0 if none.
[[nodiscard]] double memory_limit_bytes();

/// Number of bytes that the process may still take: of the limit what it does not hold, without a limit what the
/// machine has free; with what the allocator holds unused. 0 if that is not known. Cost: some ten microseconds.
[[nodiscard]] double memory_left_bytes();

/// The memory that is left, in words: "0.8 GB are left of the 2 GB of --memory", "3.1 GB are free".
[[nodiscard]] std::string memory_left_text();

/// Throws NumericalError if a stage needs more bytes than are left; nothing is thrown where that is not known. `stage`
/// begins the message: "the stiffness matrix of 4000000 degrees of freedom".
void require_memory(double bytes, const std::string& stage);

/// Makes the allocator keep freed blocks of up to 32 MB for the whole process, which suits a program that does one run
/// and ends: factors and bases are allocated and freed over and over, and half the time of a small factorisation can go
/// into page faults. Larger blocks are given back: kept, each would be too small for the next larger model, and the
/// memory of all models would add up (4.5 GB in place of 3.9 GB at 219 000 degrees of freedom of order 5). Each thread
/// keeps an arena of its own. A single arena for all threads would save 5 % of the memory at 170 000 degrees of
/// freedom; but in a stability chart, which allocates small matrices all the time, threads would spend 40 % of the time
/// waiting for each other. Call it once, first thing in main().
void keep_freed_memory();

/// Asks the kernel to use pages of 2 MB for this memory, which must not have been written to yet; only whole pages
/// within it are concerned. Touching 1 GB for the first time on two threads takes 0.25 s with small pages and 0.04 s
/// with large ones. The kernel may refuse, which costs nothing. Blocks below 8 MB are left alone.
void want_large_pages(void* memory, std::size_t bytes);

}  // namespace thinwall::core
