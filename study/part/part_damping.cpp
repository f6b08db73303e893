#include "study/part/part_damping.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "core/overloaded.hpp"
#include "reduction/damping.hpp"
#include "reduction/identification.hpp"
#include "setup/measured.hpp"

namespace thinwall::study {

namespace {

double least_of(const setup::ModalDamping& damping) {
  double least = 2.0 * damping.ratio;
  for (const double ratio : damping.ratios)
    if (ratio > 0.0) least = least > 0.0 ? std::min(least, 2.0 * ratio) : 2.0 * ratio;
  return least;
}

double least_of(const setup::RayleighDamping& damping, const fem::Modes& modes, double from_hz, double to_hz) {
  double least = 0.0;
  for (const double hz : modes.frequency_hz.tail(modes.frequency_hz.size() - modes.rigid_motions)) {
    if (hz < from_hz || hz > to_hz) continue;
    const double omega = 2.0 * std::numbers::pi * hz;
    const double here = damping.alpha / omega + damping.beta * omega;
    least = least > 0.0 ? std::min(least, here) : here;
  }
  return least;
}

dynamics::SpatialModel damped_by_mode(const setup::ModalDamping& damping, const dynamics::SpatialModel& reduced,
                                      std::vector<reduction::IdentifiedMode>& identified) {
  if (!damping.from_frf) return reduction::with_modal_damping(reduced, damping.ratios, damping.ratio);
  const io::MeasuredFrf& frf = setup::receptance_of(*damping.from_frf);
  identified = reduction::identify_modes(frf.axis, frf.H);
  return reduction::with_modal_damping(reduced, setup::matched_ratios(reduced, identified, damping.ratio),
                                       damping.ratio);
}

}  // namespace

double least_loss_factor(const setup::Damping& damping, const fem::Modes& modes, double from_hz, double to_hz) {
  return std::visit(core::overloaded{[](const setup::ModalDamping& modal) { return least_of(modal); },
                                     [&](const setup::RayleighDamping& rayleigh) {
                                       return least_of(rayleigh, modes, from_hz, to_hz);
                                     },
                                     [](const setup::StructuralDamping& structural) { return structural.loss_factor; },
                                     [](const setup::MatrixDamping&) { return 0.0; }},
                    damping);
}

dynamics::SpatialModel damped(const setup::Damping& damping, const dynamics::SpatialModel& reduced,
                              std::vector<reduction::IdentifiedMode>& identified) {
  return std::visit(
      core::overloaded{[&](const setup::ModalDamping& modal) { return damped_by_mode(modal, reduced, identified); },
                       [&](const setup::RayleighDamping& rayleigh) {
                         return reduction::with_rayleigh_damping(reduced, rayleigh.alpha, rayleigh.beta);
                       },
                       [&](const setup::StructuralDamping& structural) {
                         return reduction::with_structural_damping(reduced, structural.loss_factor);
                       },
                       [&](const setup::MatrixDamping&) { return reduced; }},
      damping);
}

std::vector<double> part_damping_ratios(const Results& results) {
  const fem::Modes& modes = results.finite_elements->modes;
  std::vector<double> ratios(static_cast<std::size_t>(modes.frequency_hz.size()),
                             std::numeric_limits<double>::quiet_NaN());
  if (!results.part || !results.part->modal) return ratios;
  auto mode = static_cast<std::size_t>(modes.rigid_motions);
  for (const int k : dynamics::oscillating_modes(*results.part->modal)) {
    if (mode == ratios.size()) break;
    ratios[mode++] = dynamics::summarise(results.part->modal->poles(k)).damping_ratio;
  }
  return ratios;
}

}  // namespace thinwall::study
