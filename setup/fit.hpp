#pragma once
// Values of a set-up that are found by fitting it to known results.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/words.hpp"

namespace thinwall::setup {

/// Models whose results are fitted.
enum class FitOf {
  part,
  coupled,  ///< part and robot together
};

/// Known results that a model is to show.
enum class FittedQuantity {
  part_frequency,     ///< Hz
  coupled_frequency,  ///< Hz
  reduction_at,       ///< 1 − |G|/|H| at one frequency
};

/// Rules by which a target finds its mode.
enum class ModeMatch {
  participation,  ///< the rank-th mode that takes part at a DOF
  mac,            ///< the mode most like the reference's
  number,         ///< the rank-th mode
};

/// A number of the set-up that a fit may change, within its bounds.
struct UpdatingParameter {
  std::string key;   ///< name of the number, for setup::Variation
  std::string unit;  ///< of the bounds; empty: a plain number
  double lower = 0.0, upper = 0.0;
};

/// A known result that the model is to show.
struct UpdatingTarget {
  FittedQuantity quantity = FittedQuantity::part_frequency;
  double value = 0.0;  ///< Hz, or 1 for a reduction
  std::string point;   ///< DOF "P.x" at which the mode takes part or the reduction is read
  ModeMatch match = ModeMatch::participation;
  int rank = 1;               ///< the rank-th such mode by rising frequency
  double frequency_hz = 0.0;  ///< of reduction_at; 0: the matched mode of the part
  double weight = 1.0;
};

/// One fit: the numbers that may change and the results that are known.
struct Updating {
  std::string name;
  FitOf on = FitOf::part;
  std::vector<UpdatingParameter> parameters;
  std::vector<UpdatingTarget> targets;
};

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 2> words<setup::FitOf>{"part", "coupled"};
template <>
inline constexpr std::array<std::string_view, 3> words<setup::FittedQuantity>{"part_frequency", "coupled_frequency",
                                                                              "reduction_at"};
template <>
inline constexpr std::array<std::string_view, 3> words<setup::ModeMatch>{"participation", "mac", "number"};

}  // namespace thinwall::core
