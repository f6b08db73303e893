#pragma once
// The largest value of something smooth that is known at equal steps.

#include <Eigen/Core>

namespace thinwall::milling {

/// The vertex of the parabola through the largest sample and its neighbours (at an end, the two beside it) where it
/// lies between them, else the largest sample: error O(step⁴) of a maximum inside. `value`: at least three samples.
[[nodiscard]] double sampled_peak(const Eigen::Ref<const Eigen::VectorXd>& value);

}  // namespace thinwall::milling
