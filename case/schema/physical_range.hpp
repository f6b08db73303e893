#pragma once
// Magnitudes beyond which a value is no quantity of a machine or a part, whatever its key allows.

#include <span>

#include "case/schema/schema.hpp"

namespace thinwall::cases {

/// The magnitudes that a kind of quantity has in machining. The smallest holds for keys that do not take zero: others
/// take round-off, as coordinates do.
struct PhysicalRange {
  core::QuantityKind kind;
  double smallest = 0.0;
  double largest = 0.0;
};

/// The range of every kind that has one.
[[nodiscard]] std::span<const PhysicalRange> physical_ranges();

/// Throws InputError with the value and the range of the key's kind unless the number lies in it.
void require_physical(const Key& key, double value);

/// require_physical() of a quantity that has no key; `takes_zero`: there is no smallest magnitude.
void require_physical(const core::QuantityKind& quantity, double value, bool takes_zero = false);

}  // namespace thinwall::cases
