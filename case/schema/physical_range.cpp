#include "case/schema/physical_range.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace thinwall::cases {

namespace {

namespace kind = core::kind;

constexpr PhysicalRange ranges[] = {
    {kind::length, 1e-9, 1e3},
    {kind::mass, 1e-9, 1e7},
    {kind::time, 1e-15, 1e9},
    {kind::angle, 1e-9, 1e3},
    {kind::frequency, 1e-3, 1e6},
    {kind::spindle_speed, 20.0, 1e6},  // lobes grow in number as speeds fall: at 10 rpm a row takes a minute
    {kind::velocity, 1e-9, 1e4},
    {kind::stiffness, 1.0, 1e18},
    {kind::torsional_stiffness, 1e-3, 1e18},
    {kind::bed_stiffness, 1.0, 1e22},
    {kind::power, 1e-3, 1e8},
    {kind::torque, 1e-6, 1e7},
    {kind::force, 1e-6, 1e9},
    {kind::acceleration, 1e-6, 1e5},
};

}  // namespace

std::span<const PhysicalRange> physical_ranges() {
  return ranges;
}

void require_physical(const Key& key, double value) {
  require_physical(key.kind, value, !(key.bounds.lower == 0.0 && key.bounds.lower_open));
}

void require_physical(const core::QuantityKind& quantity, double value, bool takes_zero) {
  const auto of_kind = [&](const PhysicalRange& range) { return range.kind.name == quantity.name; };
  const auto* range = std::ranges::find_if(ranges, of_kind);
  if (range == std::end(ranges) || !std::isfinite(value)) return;
  const bool large_enough = takes_zero || std::abs(value) >= range->smallest;
  if (large_enough && std::abs(value) <= range->largest) return;
  const auto text = [&](double bound) { return core::readable_text(bound, quantity); };
  const std::string name(quantity.name);
  throw core::InputError(core::exact_text(value, quantity) + " is no " + name + " in machining: these lie " +
                         (takes_zero ? "below " : "between " + text(range->smallest) + " and ") + text(range->largest) +
                         "; check number and unit");
}

}  // namespace thinwall::cases
