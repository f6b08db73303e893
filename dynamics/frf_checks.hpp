#pragma once
// Checks of a measured FRF matrix: whether it can belong to a passive, reciprocal structure, and from which frequency
// on it can be used. docs/theory/measured-frfs.md derives the figures. All checks throw InputError for a model whose
// shapes disagree and for values that are not finite.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::dynamics {

/// A response DOF and a force DOF at the same place: equal point and kind, along one line. The force column is turned
/// into the response's direction by `sign`: H(row, column) · sign.
struct Collocated {
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  double sign = 1.0;
};

/// The driving points of a matrix, at most one for each response DOF, in the order of the rows.
[[nodiscard]] std::vector<Collocated> driving_points(const ResponseModel& model);

/// Verdict on the sign of a driving point's power.
enum class SignVerdict {
  passive,     ///< the structure takes up power, as it must
  turned,      ///< −H was given: a sensor or a force is counted in the other direction
  conjugated,  ///< the conjugate of H was given: it follows e^{−iωt}
  unclear,     ///< Im H has no definite sign: noise, or response and force at different points
};

/// The sign of a driving point. The power that a force F puts in is −½ ω Im H |F|², so that Im H ≤ 0 for e^{+iωt}.
struct DrivingPointSign {
  Collocated entry;
  double balance = 0.0;       ///< Σ ω Im H / Σ ω |Im H|: −1 if all lines are passive, 1 if none is
  double frequency_hz = 0.0;  ///< frequency of the line with the largest ω |Im H|, the resonance of largest power
  double share = 0.0;         ///< Im H / |H| at frequency_hz: −1 at a resonance
  SignVerdict verdict = SignVerdict::unclear;
};

/// The sign of every driving point. A balance below −½ is passive, above ½ reversed, else unclear. The two causes of a
/// reversed sign are told apart by Re H: it falls through a resonance, rises if the sign of H is wrong, and still falls
/// if H was conjugated. Lines below from_hz are left out. Cost O(entries · lines).
[[nodiscard]] std::vector<DrivingPointSign> driving_point_signs(const ResponseModel& model, double from_hz = 0.0);

/// The figure of a check over a matrix, and the entry and frequency at which it is worst.
struct MatrixCheck {
  double figure = 0.0;
  double frequency_hz = 0.0;
  Eigen::Index row = 0;     ///< in the model
  Eigen::Index column = 0;  ///< in the model
  bool holds = true;        ///< figure ≤ bound
};

/// The reciprocity error of the matrix (Maxwell, Betti): the largest |H_ab − H_ba| relative to the largest |H_ab| or
/// |H_ba| of all lines, over all pairs of driving points. A single line of noise does not count: the figure is the
/// largest that three lines in a row reach. Empty if there are no two driving points. The bound of a tenth is what two
/// sensors with sensitivities known to 5 % leave. Cost O(points² · lines).
[[nodiscard]] std::optional<MatrixCheck> reciprocity(const ResponseModel& model, double from_hz = 0.0,
                                                     double bound = 0.1);

/// The violation of passivity by the matrix B between the driving points. The power −½ ω fᴴ A f, A = (B − Bᴴ)/(2i), is
/// never negative in a passive structure, so that A is negative semidefinite at every ω > 0. The figure is the largest
/// eigenvalue of A relative to ‖B‖₂, the largest that three lines in a row reach, over the lines on which ‖B‖₂ is at
/// least a hundredth of its largest value; rotations and translations are first brought to one size by 1/√max|B_ii|.
/// Row and column are those of the driving point with the largest entry in the eigenvector. Empty if there is no
/// driving point. Cost O(points³ · lines).
[[nodiscard]] std::optional<MatrixCheck> passivity(const ResponseModel& model, double from_hz = 0.0,
                                                   double bound = 0.1);

/// The cause that makes the lowest lines of a receptance unusable; the criteria of low_frequency_limit().
enum class LowFrequencyCause { none, scatter, coherence, growth };

/// Bounds of low_frequency_limit().
struct LowFrequencyOptions {
  double scatter = 0.2;    ///< largest standard deviation of a line, √E|noise|², relative to |H|
  double coherence = 0.9;  ///< least coherence; with five averages the random error of |H| is then a tenth
  bool supported = false;  ///< true if the structure is supported, so that its receptance levels out towards 0 Hz
};

/// The frequencies (Hz) from which on a receptance meets each criterion and all of them: the first line if nothing is
/// wrong, infinity if no line meets it.
struct LowFrequencyLimit {
  double from_hz = 0.0;
  LowFrequencyCause cause = LowFrequencyCause::none;  ///< the criterion with the highest frequency
  double scatter_from_hz = 0.0;
  double coherence_from_hz = 0.0;
  double growth_from_hz = 0.0;
};

/// The frequency from which on a receptance that was integrated from an accelerometer's signal can be used: noise σ_A
/// of the accelerance becomes σ_A/ω² in the receptance. Three criteria are applied; each gives the first line, from the
/// lowest upwards, on which it holds:
///
/// - scatter: δ_k = H_k − w H_{k−1} − (1 − w) H_{k+1}, the distance from the straight line through the neighbours, has
///   the variance σ² (1 + w² + (1 − w)²) of independent noise and none of a smooth H. σ is estimated by the median of
///   |δ| over 21 lines (a Rayleigh variable: median 0.833 σ) and compared with the median of |H|.
/// - coherence: its median over 21 lines, where there is one (`coherence` has one value for each line, or none).
/// - growth, of a supported structure only: the slope of ln |H| over ln f, fitted over an octave (five lines at least).
///   An error b/ω², of whatever kind, is as large as the static receptance where the slope is −1.
///
/// A resonance among the lowest 21 lines that is not resolved counts as scatter. Throws InputError if sizes differ or
/// there are fewer than 25 lines above 0 Hz. Cost O(lines).
[[nodiscard]] LowFrequencyLimit low_frequency_limit(const FrequencyAxis& axis, const Eigen::VectorXcd& H,
                                                    const Eigen::VectorXd& coherence = {},
                                                    const LowFrequencyOptions& options = {});

}  // namespace thinwall::dynamics
