#pragma once
// Values of a set-up that are found by fitting it to known results.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace thinwall::setup {

/// A number of the set-up that a fit may change, within its bounds.
struct UpdatingParameter {
  std::string key;   ///< name of the number, for setup::Variation
  std::string unit;  ///< of the bounds; empty: a plain number
  double lower = 0.0, upper = 0.0;
};

/// A known result that the model is to show.
struct UpdatingTarget {
  std::string quantity;                 ///< part_frequency, coupled_frequency, reduction_at
  double value = 0.0;                   ///< Hz, or 1 for a reduction
  std::string point;                    ///< DOF "P.x" at which the mode takes part or the reduction is read
  std::string match = "participation";  ///< participation, mac, number
  int rank = 1;                         ///< the rank-th such mode by rising frequency
  double frequency_hz = 0.0;            ///< of reduction_at; 0: the matched mode of the part
  double weight = 1.0;
};

/// One fit: the numbers that may change and the results that are known.
struct Updating {
  std::string name;
  std::string on = "part";  ///< part, coupled
  std::vector<UpdatingParameter> parameters;
  std::vector<UpdatingTarget> targets;
};

}  // namespace thinwall::setup
