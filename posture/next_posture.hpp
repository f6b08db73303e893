#pragma once
// The posture that is worth measuring next.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "posture/bands.hpp"
#include "posture/predictor.hpp"

namespace thinwall::posture {

/// The gain that measuring one more posture is expected to bring.
struct NextPosture {
  Eigen::Index best = 0;      ///< number of the candidate
  Eigen::VectorXd reduction;  ///< of each candidate, as a share of the variance along the path, 0 to 1
};

/// The candidate with the largest expected reduction of variance along a path: measuring all modes at c lowers the
/// variance v_p of a number at p by cov(p, c)²/(v_c + noise²) whatever is found there (Seo et al. 2000; Cohn 1996), so
/// that
///
///     reduction(c) = Σ_p Σ_t S_pt cov(p, c)²/(v_p (v_c + noise²)) / Σ_p Σ_t S_pt
///
/// with S_pt the variance that the number t gives to what is wanted at p: to the logarithm of the limiting depth at the
/// speeds of `cut` (depth_slopes() squared), and without one to ln f of all modes. Numbers of unseen modes, of which a
/// posture tells nothing, are left out. Throws InputError for an empty path or no candidate, and as depth_slopes().
/// Cost: depth_slopes() at each place of the path, and covariances of path and candidates.
[[nodiscard]] NextPosture next_posture(const Predictor& predictor, const std::vector<Place>& path,
                                       const std::vector<Place>& candidates,
                                       const std::optional<PostureCut>& cut = std::nullopt);

}  // namespace thinwall::posture
