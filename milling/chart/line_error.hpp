#pragma once
// The distance of a chart's line, which is straight between its speeds, from the boundary that it stands for.

#include <vector>

#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"

namespace thinwall::milling {

/// The gap between two neighbouring speeds of a chart, as far as the rows around it tell of the boundary within.
struct LineGap {
  double error = 0.0;       ///< relative, of the line between the two; infinite: the rows do not tell
  bool corner = false;      ///< two lobes meet within
  bool one_sided = false;   ///< no corner, but the rows of one side alone tell how the boundary bends
  double corner_rpm = 0.0;  ///< where, as far as is known; else the middle
  double row_error = 0.0;   ///< the larger estimate of the two rows, relative: what no speed between them can mend
};

/// A gap is narrow where its speeds differ by this share: a step of the boundary within is drawn as one.
constexpr double narrow_gap = 1e-5;

/// That share in a chart from lines, which tell the speed of a step no better, while no spindle holds its speed so
/// well.
constexpr double narrow_gap_by_lines = 1e-4;

/// A flip or fold lobe that is narrower than this share of the speed is not searched for: no spindle holds its speed
/// better.
constexpr double narrow_real_lobe = 1e-3;

/// The gaps of a chart. Where both rows lie on one lobe (the kind of the instability and ⌊f_c T⌋ are equal, f_c hardly
/// differs, and the lobe of two rows on one side does not go on as a deeper crossing of the row on the other; T the
/// period of the cut) the boundary within is smooth, and a chord of width h is off by
///
///     e = 2 |w[n_i−1, n_i, n_i+1]| h²/4 / √(w_i w_i+1)
///
/// with the larger of the divided differences of both sides, doubled for what it changes within the gap, and doubled
/// again where the two have opposite signs or one alone is known: the rows do not resolve the bend then. Where two
/// lobes meet the boundary is the lower of them, and each is continued into the gap, in 1/w by the parabola of three of
/// its rows, or by its last chord where it has two, or through the deeper crossing that the other row has of it: the
/// error is twice the distance of the line from the lower of both, and, where they do not meet, of each from the
/// other's row; at least half the logarithm of the ratio of both rows' depths, since a lobe may end otherwise than its
/// rows tell; and at least the step down to a flip or fold lobe of which a row knows both edges, since they meet
/// upright at its end, anywhere within the gap. A gap beside which a lobe has one row only tells nothing: the error is
/// infinite. Where 2 f_c T passes a whole number, a pair of multipliers passes −1 or +1 and a flip or fold lobe may lie
/// within (strong resonances 1:2 and 1:1; Kuznetsov, Elements of Applied Bifurcation Theory, 2004, sections 9.5.2 and
/// 9.5.3): of a Hopf lobe that both rows show, of one that rises to the depth limit, on to the least stable motion
/// there, or of that motion at both rows. The error of such a gap is infinite, too, unless it is narrower than
/// `narrow_real_lobe`, and its corner is that passage, linearly between the rows. The error is 0 of a gap that is
/// narrower than the share `narrow`. `rows` by rising speed. Cost O(rows).
[[nodiscard]] std::vector<LineGap> line_gaps(const std::vector<LobeRow>& rows, const MillingProcess& process,
                                             double narrow = narrow_gap);

}  // namespace thinwall::milling
