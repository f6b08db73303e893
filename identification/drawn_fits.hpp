#pragma once
// Fits of lines that are drawn anew: how far a fit hangs on the noise of its lines.

#include <Eigen/Core>
#include <vector>

#include "identification/modal_fit.hpp"

namespace thinwall::identification {

/// Fits to `draws` sets of lines, each the model of `fit` and normal noise of the lines' variances, raised by χ² a
/// degree of freedom where that is above 1 (parametric bootstrap; Efron & Tibshirani 1993, ch. 6.5). The search starts
/// from the poles of `fit`, whose terms and residues `options` tell. Entries with the same number in `source`
/// (responses × references) come from one measurement and have its noise in common. Modes are in the order of rising
/// frequency. Throws InputError as modal_fit(), and for another shape of `source`. Cost: draws × a search of a few
/// steps, shared out among core::thread_count() threads; the result does not depend on their number.
[[nodiscard]] std::vector<ModalFit> drawn_fits(const MeasuredLines& measured, const ModalFit& fit,
                                               const ModalFitOptions& options, const Eigen::MatrixXi& source, int draws,
                                               unsigned seed = 1);

}  // namespace thinwall::identification
