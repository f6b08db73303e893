#pragma once
// The contacts in summary.json and on the terminal: what was joined, and what was found of it.

#include <string>
#include <vector>

#include "report/summary/summary.hpp"
#include "study/results.hpp"

namespace thinwall::report {

/// One entry a contact, N/m and N s/m a direction, null for a rigid one; with its preload, what a ball makes of it, and
/// the identified joint with half widths of 95 % intervals, where there are any.
[[nodiscard]] std::vector<ContactSummary> contacts_summary(const study::Results& results);

/// K (N/m), C (N s/m) and η along one direction of a contact.
struct ContactAlong {
  double stiffness = 0.0, damping = 0.0, loss_factor = 0.0;
};
[[nodiscard]] ContactAlong along(const coupling::Contact& contact, std::size_t direction);

/// The summary of what a regularised kernel dropped; none without a regularisation.
[[nodiscard]] std::optional<RegularisationSummary> regularisation_summary(coupling::Regularisation regularisation,
                                                                          double threshold,
                                                                          const coupling::CoupledResponse& receptance);

/// A line a contact, more where it was found from FRFs; from a summary. Empty without a contact.
[[nodiscard]] std::string contacts_text(const Summary& summary);

}  // namespace thinwall::report
