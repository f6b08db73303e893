// Faults of the system, injected into a program that is started with this library in LD_PRELOAD.
//
// THINWALL_FAULT="CALL K HOW" concerns the K-th of the calls of one kind, counted over all threads of a process:
//   CALL  write, rename, unlink, fsync, mmap, fork; each stands for its variants, too
//   HOW   fail: that call fails as it would by a full disk, a lost device, no memory or no process;
//         short: a write takes half of what it is given; kill: the process is killed in place of the call
// THINWALL_FAULT_COUNT=FILE: in the end FILE holds the number of calls of every kind, a line each.
//
// A call that the C library makes for itself (malloc's mmap, fwrite's write) does not pass here; fwrite itself does.

#include <dlfcn.h>
#include <fcntl.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

namespace {

constexpr const char* kinds[] = {"write", "rename", "unlink", "fsync", "mmap", "fork"};
constexpr int errors[] = {ENOSPC, EIO, EIO, EIO, ENOMEM, EAGAIN};
enum Kind { write_call, rename_call, unlink_call, fsync_call, mmap_call, fork_call, kind_count };
enum class How { not_at_all, fail, shorten };

std::atomic<long> calls[kind_count];

struct Fault {
  int kind = -1;
  long at = 0;
  char how[8] = "";
};

const Fault& fault() {
  static const Fault read = [] {
    Fault found;
    char name[8] = "";
    const char* text = std::getenv("THINWALL_FAULT");
    if (text == nullptr || std::sscanf(text, "%7s %ld %7s", name, &found.at, found.how) != 3) return Fault{};
    for (int k = 0; k < kind_count; ++k)
      if (std::strcmp(name, kinds[k]) == 0) found.kind = k;
    return found;
  }();
  return read;
}

/// Counts a call; what is to become of it, with errno as it fails by.
How next(Kind kind) {
  const long number = ++calls[kind];
  if (fault().kind != kind || fault().at != number) return How::not_at_all;
  if (std::strcmp(fault().how, "kill") == 0) ::kill(::getpid(), SIGKILL);
  if (std::strcmp(fault().how, "short") == 0) return How::shorten;
  errno = errors[kind];
  return How::fail;
}

template <typename Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

__attribute__((destructor)) void write_counts() {
  const char* file = std::getenv("THINWALL_FAULT_COUNT");
  if (file == nullptr) return;
  char text[256];
  int length = 0;
  for (int k = 0; k < kind_count; ++k)
    length += std::snprintf(text + length, sizeof text - static_cast<std::size_t>(length), "%s %ld\n", kinds[k],
                            calls[k].load());
  const int descriptor = ::open(file, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  static const auto write_itself = real<ssize_t(int, const void*, size_t)>("write");
  if (write_itself(descriptor, text, static_cast<std::size_t>(length)) != length) std::abort();
  ::close(descriptor);
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t count) {
  static const auto itself = real<ssize_t(int, const void*, size_t)>("write");
  const How how = next(write_call);
  return how == How::fail ? -1 : itself(descriptor, bytes, how == How::shorten ? (count + 1) / 2 : count);
}

ssize_t writev(int descriptor, const iovec* pieces, int count) {
  static const auto itself = real<ssize_t(int, const iovec*, int)>("writev");
  const How how = next(write_call);
  return how == How::fail ? -1 : itself(descriptor, pieces, how == How::shorten ? (count + 1) / 2 : count);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t count, off_t at) {
  static const auto itself = real<ssize_t(int, const void*, size_t, off_t)>("pwrite");
  const How how = next(write_call);
  return how == How::fail ? -1 : itself(descriptor, bytes, how == How::shorten ? (count + 1) / 2 : count, at);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t count, off64_t at) {
  static const auto itself = real<ssize_t(int, const void*, size_t, off64_t)>("pwrite64");
  const How how = next(write_call);
  return how == How::fail ? -1 : itself(descriptor, bytes, how == How::shorten ? (count + 1) / 2 : count, at);
}

size_t fwrite(const void* bytes, size_t size, size_t count, FILE* file) {
  static const auto itself = real<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
  return next(write_call) == How::fail ? 0 : itself(bytes, size, count, file);  // it never writes less unless it fails
}

int rename(const char* from, const char* to) noexcept {
  static const auto itself = real<int(const char*, const char*)>("rename");
  return next(rename_call) == How::fail ? -1 : itself(from, to);
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned int flags) noexcept {
  static const auto itself = real<int(int, const char*, int, const char*, unsigned int)>("renameat2");
  return next(rename_call) == How::fail ? -1 : itself(from_folder, from, to_folder, to, flags);
}

int unlink(const char* path) noexcept {
  static const auto itself = real<int(const char*)>("unlink");
  return next(unlink_call) == How::fail ? -1 : itself(path);
}

int unlinkat(int folder, const char* path, int flags) noexcept {
  static const auto itself = real<int(int, const char*, int)>("unlinkat");
  return next(unlink_call) == How::fail ? -1 : itself(folder, path, flags);
}

int remove(const char* path) noexcept {
  static const auto itself = real<int(const char*)>("remove");
  return next(unlink_call) == How::fail ? -1 : itself(path);
}

int rmdir(const char* path) noexcept {
  static const auto itself = real<int(const char*)>("rmdir");
  return next(unlink_call) == How::fail ? -1 : itself(path);
}

int fsync(int descriptor) {
  static const auto itself = real<int(int)>("fsync");
  return next(fsync_call) == How::fail ? -1 : itself(descriptor);
}

void* mmap(void* address, size_t length, int protection, int flags, int descriptor, off_t at) noexcept {
  static const auto itself = real<void*(void*, size_t, int, int, int, off_t)>("mmap");
  return next(mmap_call) == How::fail ? MAP_FAILED : itself(address, length, protection, flags, descriptor, at);
}

void* mmap64(void* address, size_t length, int protection, int flags, int descriptor, off64_t at) noexcept {
  return mmap(address, length, protection, flags, descriptor, at);
}

pid_t fork() noexcept {
  static const auto itself = real<pid_t()>("fork");
  return next(fork_call) == How::fail ? -1 : itself();
}

}  // extern "C"
