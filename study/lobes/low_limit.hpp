#pragma once
// Limits of measured structures that hang on lines below all resonances.

#include <optional>

#include "study/lobes/cut_structure.hpp"
#include "study/results.hpp"

namespace thinwall::study {

/// A limit of a sampled structure that is due to what lies below its first resonance: chatter more than two half widths
/// below the lowest of its resonances, where a sound structure is as stiff as at rest. Resonances are those that at
/// least five lines within their half-power width show, for lower ones may be noise, and those of modes that are given
/// beside the samples. None of a structure that is known by poles, without such a resonance, or without a limit. Cost
/// that of milling::resonances().
[[nodiscard]] std::optional<LimitBelowResonance> limit_below_resonance(const CutStructure& structure,
                                                                       const milling::LobeRow& row);

}  // namespace thinwall::study
