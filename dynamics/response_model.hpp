#pragma once
// An FRF matrix on a frequency axis.

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "dynamics/dof.hpp"
#include "dynamics/frequency_axis.hpp"

namespace thinwall::dynamics {

/// Receptance H(ω) in m/N (rad/N, m/(N m), rad/(N m) where rotations take part), e^{+iωt}. One matrix a line:
/// row = response (`responses`), column = force (`forces`).
struct ResponseModel {
  FrequencyAxis axis;
  DofTable responses;
  DofTable forces;
  std::vector<Eigen::MatrixXcd> H;
};

/// Throws InputError unless there is one matrix a line, each as high as the table of responses and as wide as that of
/// forces. Cost: that of the lines.
void require_consistent(const ResponseModel& model);

/// Throws InputError unless there is one matrix a line, each as high as the table of responses, as wide as that of
/// forces, and finite; says at which frequency the first fault lies. Cost lines · entries.
void require_complete(const ResponseModel& model);

/// The entry (response, force) over frequency, both by DOF name; throws InputError if either is absent.
[[nodiscard]] Eigen::VectorXcd entry(const ResponseModel& model, const std::string& response, const std::string& force);

/// Rows and columns of two points only: each line becomes (translations of a) × (translations of b).
[[nodiscard]] ResponseModel between(const ResponseModel& model, const std::string& response_point,
                                    const std::string& force_point);

}  // namespace thinwall::dynamics
