#pragma once
// The kind of a motion, from samples once a period of the cut.

#include <Eigen/Core>
#include <string>

namespace thinwall::milling {

/// The kinds of a motion.
enum class Motion {
  periodic,        ///< repeats itself with the cut: forced vibration
  period_n,        ///< repeats itself after n ≥ 2 periods: flip chatter and its like
  quasi_periodic,  ///< bounded, without a period up to 24: Hopf chatter, or chaos
  growing,         ///< the second half of the record is larger by half than the first
  settling,        ///< not settled: it has no period yet, and its changes become smaller where small ones decay
};

/// The kind in one word, as files have it.
[[nodiscard]] std::string name(Motion motion);

/// The kind, and the evidence for it.
struct MotionKind {
  Motion motion = Motion::periodic;
  int period = 1;           ///< in periods of the cut; 0 where there is none
  double difference = 0.0;  ///< largest change of a sample after that period, over the size of the motion; where there
                            ///< is none, the least of all that were tried
  double trend = 1.0;  ///< of a motion without a period: the largest change from sample to sample in the last quarter,
                       ///< over that in the second
};

/// Samples are columns (components × samples), `size` the peak to peak value of the motion that they are samples of.
/// The period is the least n ≤ 24 after which no sample of the last half differs by more than `tolerance` × size. A
/// motion without one is growing if the spread of the last quarter of the samples exceeds that of the second quarter by
/// half of it. At least 2 samples. Cost O(24 samples).
[[nodiscard]] MotionKind motion_kind(const Eigen::MatrixXd& samples, double size, double tolerance = 1e-4);

/// The kind where small vibrations are known to decay. From the second quarter of n periods to the last, a small one
/// becomes smaller by |μ|^(n/2), the `expected_trend`, and one that lasts by nothing. A motion without a period whose
/// trend lies nearer to the former, and below 0.95, is `settling`; else it may be chatter that exists beside the stable
/// motion (docs/theory/time-domain.md, section The kind of a motion).
[[nodiscard]] MotionKind kind_beside_decay(const MotionKind& kind, double expected_trend);

}  // namespace thinwall::milling
