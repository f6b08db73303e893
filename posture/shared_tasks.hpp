#pragma once
// The comparison of processes that learn each number of a mode alone with processes that learn several together.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/words.hpp"
#include "posture/tapped_posture.hpp"
#include "regression/gaussian_process.hpp"

namespace thinwall::posture {

/// Numbers of a mode (targets_of()) that are alike, as Lei 2022 (sec. 5.2) puts them together.
enum class NumberGroup {
  frequency_and_damping,  ///< ln f, ln ζ
  real_parts,             ///< of the residue
  imaginary_parts,        ///< of the residue
};

/// The gain from learning together.
enum class Sharing {
  gains,  ///< numbers that were held out are told better together, R² more than 0.005 above
  none,   ///< alike: the numbers share nothing that the postures do not tell of each alone
  loses,  ///< worse by as much: one set of lengths does not fit all
};

/// A group of a mode over the postures that have seen it.
struct SharedTasks {
  int label = 0;
  NumberGroup group = NumberGroup::frequency_and_damping;
  std::vector<std::size_t> postures{};   ///< numbers, one a row of what follows
  Eigen::MatrixXd measured{};            ///< postures × numbers
  Eigen::MatrixXd left_out{};            ///< each from all others, alone, in closed form
  Eigen::MatrixXd left_out_deviation{};  ///< with the noise
  Eigen::VectorXd R2_alone{};            ///< of each number over the folds
  Eigen::VectorXd R2_together{};
  double ln_p_alone = 0.0;     ///< the sum of the logarithms of the largest likelihoods, of standardised numbers
  double ln_p_together = 0.0;  ///< of the processes that share lengths and the covariance of the numbers

  /// By the mean of R² over the numbers.
  [[nodiscard]] Sharing sharing() const;
};

/// Learns the numbers of each group of each mode alone (regression::GaussianProcess of one task) and together (of
/// several, intrinsic coregionalisation), from all folds but one, for each fold, and from all. Modes that fewer than
/// eight postures have seen, or fewer than two outside of some fold, are left out. Throws InputError as
/// cross_validate(), and NumericalError as GaussianProcess. Cost: for each group a search (regression::fit()) a number
/// and one together, and one of a single start for each fold, shared out among core::thread_count() threads.
[[nodiscard]] std::vector<SharedTasks> alone_and_together(const std::vector<TappedPosture>& postures,
                                                          const std::vector<int>& fold,
                                                          const regression::SearchOptions& options = {.starts = 4});

/// The numbers of a group as columns of targets_of(), for residues with that many entries.
[[nodiscard]] std::vector<Eigen::Index> numbers_of(NumberGroup group, Eigen::Index entries);

}  // namespace thinwall::posture

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<posture::NumberGroup>{"frequency_and_damping", "real_parts",
                                                                             "imaginary_parts"};
template <>
inline constexpr std::array<std::string_view, 3> words<posture::Sharing>{"gains", "none", "loses"};

}  // namespace thinwall::core
