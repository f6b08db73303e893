#pragma once
// The response model: an FRF matrix on a frequency axis.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/dof.hpp"
#include "dynamics/frequency_axis.hpp"

namespace thinwall::dynamics {

/// Receptance H(ω) in m/N (rad/N, m/(N m), rad/(N m) where rotations take part), e^{+iωt}. There is one matrix for each
/// frequency line: row = response (`responses`), column = force (`forces`).
struct ResponseModel {
  FrequencyAxis axis;
  DofTable responses;
  DofTable forces;
  std::vector<Eigen::MatrixXcd> H;
};

/// Throws InputError unless there is one matrix for each frequency line, with as many rows as the table of responses
/// and as many columns as that of forces. Cost O(lines).
void require_consistent(const ResponseModel& model);

/// Throws InputError unless there is one matrix for each frequency line, with as many rows as the table of responses
/// and as many columns as that of forces, all finite; the message names the frequency of the first fault. Cost lines ·
/// entries.
void require_complete(const ResponseModel& model);

/// The entry (response, force), both given by DOF name, over frequency. Throws InputError if either name is absent.
[[nodiscard]] Eigen::VectorXcd entry(const ResponseModel& model, const std::string& response, const std::string& force);

/// The response of one point to forces at another: each matrix is reduced to (translations of response_point) ×
/// (translations of force_point). Throws InputError if a point has no translation.
[[nodiscard]] ResponseModel between(const ResponseModel& model, const std::string& response_point,
                                    const std::string& force_point);

}  // namespace thinwall::dynamics
