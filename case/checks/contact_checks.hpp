#pragma once
// Checks of where a contact's stiffness comes from, and of [coupling].

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// The keys of each contact's model, its preload, its table, its ball; what a joint that is found from FRFs of the
/// assembly needs. A contact whose model is complete is tried, so that what the model itself refuses is told too.
void check_contact_models(const Case& source, Findings& findings);

/// The keys of [coupling].
void check_coupling(const Case& source, Findings& findings);

}  // namespace thinwall::cases
