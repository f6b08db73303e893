#pragma once
// The machine's memory, and how the program holds on to what it has.

namespace thinwall::core {

/// Bytes that can be allocated without swapping, as the kernel estimates them (/proc/meminfo, MemAvailable); 0 if it
/// does not say.
[[nodiscard]] double available_memory_bytes();

/// Lets the allocator keep what is freed, for the whole process: a program for one run and then the end. Why: factors
/// and bases are allocated and freed over and over, and half the time of a small factorisation can go into page faults.
/// To be called once, first thing in main().
void keep_freed_memory();

}  // namespace thinwall::core
