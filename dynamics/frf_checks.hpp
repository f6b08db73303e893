#pragma once
// Does a measured FRF matrix look like a passive, reciprocal structure, and from which frequency on is it worth
// anything? docs/theory/measured-frfs.md derives the figures. All checks throw InputError for a model whose shapes
// disagree and for values that are not finite.

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "dynamics/response_model.hpp"

namespace thinwall::dynamics {

/// Response and force DOFs that are one: same point and kind, along one line. Force columns are turned into the
/// response's direction: H(row, column) · sign.
struct Collocated {
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  double sign = 1.0;
};

/// The driving points of a matrix, one a response DOF, in the order of the rows.
[[nodiscard]] std::vector<Collocated> driving_points(const ResponseModel& model);

/// Which way a driving point's power goes.
enum class SignVerdict {
  passive,     ///< as it should be
  turned,      ///< −H: a sensor or a force counted in the other direction
  conjugated,  ///< the conjugate of H: e^{−iωt}
  unclear,     ///< Im H has no sign: noise, or points that are not one
};

/// Sign of a driving point. The power that a force F puts in is −½ ω Im H |F|², so that Im H ≤ 0 for e^{+iωt}.
struct DrivingPointSign {
  Collocated entry;
  double balance = 0.0;       ///< Σ ω Im H / Σ ω |Im H|: −1 where all is passive, 1 where nothing is
  double frequency_hz = 0.0;  ///< the line with the largest ω |Im H|, the highest resonance as a power
  double share = 0.0;         ///< Im H / |H| there: −1 at a resonance
  SignVerdict verdict = SignVerdict::unclear;
};

/// A balance below −½ is passive, above ½ reversed, else unclear. What is reversed is told apart by Re H, which falls
/// through a resonance; it rises where the sign of H is wrong and still falls where its conjugate was taken. Lines
/// below from_hz are left out. Cost O(entries · lines).
[[nodiscard]] std::vector<DrivingPointSign> driving_point_signs(const ResponseModel& model, double from_hz = 0.0);

/// Figure of a check over a matrix, and where it is worst.
struct MatrixCheck {
  double figure = 0.0;
  double frequency_hz = 0.0;
  Eigen::Index row = 0;     ///< of the model
  Eigen::Index column = 0;  ///< of the model
  bool holds = true;        ///< figure ≤ bound
};

/// Reciprocity (Maxwell, Betti): the largest |H_ab − H_ba| relative to the largest |H_ab| or |H_ba| of all lines, over
/// all pairs of driving points. A single line of noise does not count: the figure is the largest that three lines in a
/// row reach. Empty if there are no two driving points. The bound of a tenth is what two sensors with sensitivities
/// known to 5 % leave. Cost O(points² · lines).
[[nodiscard]] std::optional<MatrixCheck> reciprocity(const ResponseModel& model, double from_hz = 0.0,
                                                     double bound = 0.1);

/// Passivity of the matrix B between the driving points: the power −½ ω fᴴ A f, A = (B − Bᴴ)/(2i), is never negative,
/// so that A is negative semidefinite at every ω > 0. The figure is the largest eigenvalue of A relative to ‖B‖₂, the
/// largest that three lines in a row reach, where ‖B‖₂ is at least a hundredth of its largest; rotations and
/// translations are brought to one size first, by 1/√max|B_ii|. Row and column are the driving point with the largest
/// part in the eigenvector. Empty if there is no driving point. Cost O(points³ · lines).
[[nodiscard]] std::optional<MatrixCheck> passivity(const ResponseModel& model, double from_hz = 0.0,
                                                   double bound = 0.1);

/// What makes the lowest lines of a receptance worthless.
enum class LowFrequencyCause { none, scatter, coherence, growth };

/// Bounds of low_frequency_limit().
struct LowFrequencyOptions {
  double scatter = 0.2;    ///< standard deviation of a line, √E|noise|², relative to |H|
  double coherence = 0.9;  ///< with five averages the random error of |H| is then a tenth
  bool supported = false;  ///< the structure stands on a support: its receptance levels out towards 0 Hz
};

/// From where on a receptance can be used, Hz; the first line where nothing is wrong, infinity where no line is right.
struct LowFrequencyLimit {
  double from_hz = 0.0;
  LowFrequencyCause cause = LowFrequencyCause::none;  ///< the one that reaches highest
  double scatter_from_hz = 0.0;
  double coherence_from_hz = 0.0;
  double growth_from_hz = 0.0;
};

/// From where on a receptance that was integrated from an accelerometer is worth anything. Noise σ_A of the
/// accelerance is σ_A/ω² in the receptance. Three criteria, each by the lines from the lowest one upwards until it
/// holds for the first time:
///
/// - scatter: δ_k = H_k − w H_{k−1} − (1 − w) H_{k+1}, the distance from the straight line through the neighbours, has
///   the variance σ² (1 + w² + (1 − w)²) of independent noise and none of a smooth H. σ is estimated by the median of
///   |δ| over 21 lines (a Rayleigh variable: median 0.833 σ) and compared with the median of |H|.
/// - coherence: its median over 21 lines, where there is one (`coherence` has a value a line, or none).
/// - growth, of a supported structure only: the slope of ln |H| over ln f, fitted over an octave (five lines at least).
///   An error b/ω², of whatever kind, is as large as the static receptance where the slope is −1.
///
/// A resonance among the lowest 21 lines that is not resolved counts as scatter. Throws InputError if sizes differ or
/// there are fewer than 25 lines above 0 Hz. Cost O(lines).
[[nodiscard]] LowFrequencyLimit low_frequency_limit(const FrequencyAxis& axis, const Eigen::VectorXcd& H,
                                                    const Eigen::VectorXd& coherence = {},
                                                    const LowFrequencyOptions& options = {});

}  // namespace thinwall::dynamics
