#include "study/kept/kept_coupling.hpp"

#include "study/kept/archive_models.hpp"

namespace thinwall {

namespace reduction {
template <class Archive>
void serialize(Archive& archive, IdentifiedMode& m) {
  archive(m.frequency_hz, m.damping_ratio, m.relative_misfit);
}
}  // namespace reduction

namespace coupling {
template <class Archive>
void serialize(Archive& archive, CoupledResponse& r) {
  archive(r.response, r.kernel_condition, r.status, r.dropped, r.compatibility_residual, r.error);
}
template <class Archive>
void serialize(Archive& archive, RouteDifference& d) {
  archive(d.max_relative, d.at_frequency_hz, d.entry);
}
}  // namespace coupling

namespace study {

template <class Archive>
void serialize(Archive& archive, CouplingResult& r) {
  archive(r.receptance, r.model, r.modal, r.spatial_response, r.difference, r.identified, r.no_spatial_route);
}
CouplingResult coupling_of_checkpoint(Checkpoint& kept, const std::function<CouplingResult()>& compute) {
  CouplingResult result;
  if (const std::string* bytes = kept.find("coupling")) {
    from_bytes(*bytes, result);
    return result;
  }
  result = compute();
  kept.add("coupling", to_bytes(result));
  return result;
}

}  // namespace study

}  // namespace thinwall
