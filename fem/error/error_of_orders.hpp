#pragma once
// The estimated errors of solutions of successive orders, from their changes (docs/theory/elements.md).

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "fem/to_tolerance.hpp"

namespace thinwall::fem {

/// The exponents by which an error falls: the least one of the part's edges, and that of the edges that are not
/// re-entrant; 1 where all is regular.
struct Exponent {
  double least = 1.0, otherwise = 1.0;
};

/// The exponents of the two quantities that a tolerance holds.
struct Exponents {
  Exponent frequency, receptance;
};

/// The ratio of the errors of two orders that is assumed before two changes on one mesh have shown it. Changes of
/// orders below `usual_order` do not show it, for at the lowest orders thin walls are locked. On a mesh with rows of
/// narrow elements at all sharp edges the law of re-entrant edges does not count before, and less after.
struct Untold {
  double ratio = 0.5;
  int usual_order = 0;
  bool has_rows = false;
};

/// The relative error to which modes() brings each frequency that it finds by substructures, round-off apart.
inline constexpr double substructures_error = 1e-5;

/// The estimated relative errors of a solution. That of an entry by its own magnitude is told, and held to no
/// tolerance: a stiff direction may be thousands of times stiffer than the one that chatters, and its error falls
/// slowly, for it comes from the edge of the loaded disc, which no edge of an element follows.
struct Errors {
  double frequency = 0.0, receptance = 0.0, entry = 0.0;
  std::string worst_receptance{};
  double shape = 0.0;  ///< the part of `frequency` that the shape of the elements has
  /// The larger of the two errors that a tolerance holds.
  [[nodiscard]] double worst() const { return std::max(frequency, receptance); }
};

/// The step before the last one, if it is of the same mesh and of the usual order at least; otherwise null.
[[nodiscard]] const RefinementStep* usual_step_before(const std::vector<RefinementStep>& steps, int usual_order);

/// The errors of the last two solutions on one mesh, those of the lower first: (1 + e) d of the lower and e d of the
/// higher, with d the last changes and e the error of the last order over the last change.
[[nodiscard]] std::pair<Errors, Errors> errors_of_last_two(const std::vector<RefinementStep>& steps,
                                                           const Exponents& exponent, const Untold& untold);

/// The larger of the errors to which so many levels more reduce these at best.
[[nodiscard]] double error_after(int left, const Errors& errors, const std::vector<RefinementStep>& steps);

}  // namespace thinwall::fem
