#pragma once
// The scatter of the measured FRFs of a set-up, by its own statements.

#include <optional>
#include <string>
#include <vector>

#include "coupling/frf_noise.hpp"
#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// Standard deviation of one file's FRF `H` (its values on `axis`): `noise` times |H|, or by the file's coherence and
/// `averages`; none where the case gives neither. Throws InputError for averages of a file without coherence or a file
/// that was not read, DataError as io::coherence_on().
[[nodiscard]] std::optional<Eigen::VectorXd> deviation_of(const MeasuredFrf& file, const dynamics::FrequencyAxis& axis,
                                                          const Eigen::VectorXcd& H);

/// Of a component's matrix, made of these files (measured_response(), or one file as a 1 × 1): an entry taken from its
/// transpose scatters as that does, an entry without a statement not at all. Empty if no file has one.
[[nodiscard]] coupling::Deviations measured_deviations(const std::vector<MeasuredFrf>& files,
                                                       const dynamics::ResponseModel& response);

/// True if the case states the noise of one of them.
[[nodiscard]] bool any_noise(const std::vector<MeasuredFrf>& files);

/// The reason why `averages` of this file, which was read, tell no noise: no coherence, or one of 0 at some line; empty
/// if they do.
[[nodiscard]] std::string fault_of_coherence(const MeasuredFrf& file);

}  // namespace thinwall::setup
