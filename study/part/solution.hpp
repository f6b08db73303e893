#pragma once
// A part whose modes are computed.

#include "fem/modes.hpp"

namespace thinwall::study {

/// The part's matrices, their factor and the modes that the case asks for.
struct Solution {
  fem::Model model;
  fem::Factored factored;
  fem::Modes modes;
};

}  // namespace thinwall::study
