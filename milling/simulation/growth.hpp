#pragma once
// The growth of a small vibration in a simulated cut: the Floquet multiplier of the march, beside that of the lobes.

#include <complex>

#include "milling/cut/process.hpp"
#include "milling/simulation/march_grid.hpp"
#include "milling/structure/relative_structure.hpp"

namespace thinwall::milling {

/// The dominant multiplier of a period of the march, which is a tooth's where all teeth are alike and a turn's else.
struct SimulatedGrowth {
  std::complex<double> multiplier;  ///< Im ≥ 0
  double modulus = 0.0;             ///< |μ|: a vibration grows by ln |μ| a period
  double error_estimate = 0.0;      ///< of `modulus`, relative: its change from half as many steps and discs
  double residual = 0.0;            ///< of the eigenvalue, relative
  int steps = 0;                    ///< a period
  bool converged = false;           ///< false: Arnoldi's method or the forces of a node did not settle; no figure
                                    ///< above may be used then
};

/// |μ| of the linear variation about a steady cut: chips may be negative, the feed and the edge forces drop out. The
/// map of a period is the march itself, applied to modes and surfaces, and its largest eigenvalue in modulus is found
/// by Arnoldi's method (dominant_eigenvalue.hpp), which tells pairs of nearly equal modulus apart where a fit to the
/// growth of one motion does not. `structure` in part axes. Throws InputError for a bad process, option, speed or
/// depth. Cost: some 20 to 60 periods of the march, and half of them again.
[[nodiscard]] SimulatedGrowth simulated_growth(const RelativeStructure& structure, const MillingProcess& process,
                                               double spindle_speed_rpm, double depth_m,
                                               const StepOptions& options = {});

}  // namespace thinwall::milling
