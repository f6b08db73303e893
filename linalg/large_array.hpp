#pragma once
// Arrays for large blocks of numbers, which are not initialised.

#include <cstddef>
#include <memory>
#include <type_traits>

namespace thinwall::linalg {

/// A deleter that frees the memory of allocate_large().
struct FreeLarge {
  void operator()(void* memory) const noexcept;
};

/// `bytes` bytes of memory with undefined contents, on pages of 2 MB if the system provides them. Throws NumericalError
/// if there is not enough memory.
[[nodiscard]] std::unique_ptr<void, FreeLarge> allocate_large(std::size_t bytes);

/// An array of numbers without initial values. std::vector is not used because it writes zeros, on one thread: the
/// pages of a factor are better touched first by the threads that fill them, and few large pages cost less than many
/// small ones (a third of a factorisation's time went into page faults).
template <class T>
class LargeArray {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  LargeArray() = default;
  explicit LargeArray(std::ptrdiff_t size) : memory_(allocate_large(sizeof(T) * static_cast<std::size_t>(size))) {}

  /// The first number.
  [[nodiscard]] T* data() { return static_cast<T*>(memory_.get()); }
  /// The first number.
  [[nodiscard]] const T* data() const { return static_cast<const T*>(memory_.get()); }
  [[nodiscard]] T& operator[](std::ptrdiff_t i) { return data()[i]; }
  [[nodiscard]] const T& operator[](std::ptrdiff_t i) const { return data()[i]; }

 private:
  std::unique_ptr<void, FreeLarge> memory_;
};

}  // namespace thinwall::linalg
