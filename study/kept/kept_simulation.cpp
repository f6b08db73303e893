#include "study/kept/kept_simulation.hpp"

#include <concepts>
#include <string>

#include "core/fields.hpp"
#include "core/units.hpp"
#include "study/kept/archive.hpp"

namespace thinwall {

namespace study {

/// The structs that are kept member by member.
template <class T, class... Structs>
concept OneOf = (std::same_as<T, Structs> || ...);

}  // namespace study

namespace milling {
template <class Archive, study::OneOf<OperatingPoint, Extremes, ToothPass, MotionKind, Trace, Wall, SimulatedCut,
                                      ContactOutcome, Approach, PartSlice, SimulatedGrowth, Multiplier>
                             Struct>
void serialize(Archive& archive, Struct& value) {
  std::apply([&archive](auto&... member) { archive(member...); }, core::fields_of(value));
}
}  // namespace milling

namespace study {

template <class Archive, OneOf<ForcedAgreement, PointSimulation, AmplitudeMap> Struct>
void serialize(Archive& archive, Struct& value) {
  std::apply([&archive](auto&... member) { archive(member...); }, core::fields_of(value));
}

void point_of_checkpoint(Checkpoint& kept, PointSimulation& point,
                         const std::function<void(PointSimulation& point)>& compute) {
  const std::string name = "point of the " + core::word_of(point.of) + ": " +
                           core::exact_text(point.point.spindle_speed_rpm, core::kind::spindle_speed) + ", " +
                           core::exact_text(point.point.depth_m, core::kind::length);
  if (const std::string* bytes = kept.find(name)) return from_bytes(*bytes, point);
  compute(point);
  kept.add(name, to_bytes(point));
}

AmplitudeMap map_of_checkpoint(Checkpoint& kept, ChartOf of, const std::function<AmplitudeMap()>& compute) {
  const std::string name = "map of the " + core::word_of(of);
  AmplitudeMap map;
  if (const std::string* bytes = kept.find(name)) {
    from_bytes(*bytes, map);
    return map;
  }
  map = compute();
  kept.add(name, to_bytes(map));
  return map;
}

}  // namespace study

}  // namespace thinwall
