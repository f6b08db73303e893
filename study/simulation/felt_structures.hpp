#pragma once
// The structures that a simulated cut feels, with their poles.

#include <optional>
#include <vector>

#include "milling/simulation/one_sided_contact.hpp"
#include "milling/structure/relative_structure.hpp"
#include "setup/machining_setup.hpp"
#include "study/lobes/chart_of.hpp"

namespace thinwall::study {

struct Results;

/// A structure at the cut, and the contact of its support where that may open.
struct FeltStructure {
  ChartOf of = ChartOf::part;
  milling::RelativeStructure structure;
  std::optional<milling::OneSidedContact> contact;
};

/// The structures that setup.simulation asks for, with their poles (part axes). `results` are those of run() without
/// charts. Throws InputError for one that the set-up does not have or that has no poles (lines of a measured FRF need a
/// fit by modes first).
[[nodiscard]] std::vector<FeltStructure> felt_structures(const setup::Setup& setup, const Results& results);

}  // namespace thinwall::study
