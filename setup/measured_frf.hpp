#pragma once
// A measured frequency response function, and the sensors that it was measured with.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace thinwall::setup {

/// One measured FRF in a file, converted by io/ to receptance.
struct MeasuredFrf {
  std::string response;  ///< DOF name, "P.x"
  std::string force;
  std::filesystem::path file;     ///< absolute, or relative to the working directory
  std::string quantity;           ///< receptance, mobility, accelerance; empty: the file says it
  std::string unit;               ///< of the FRF, "um/N"; empty: the file says it
  std::string frequency_unit;     ///< "Hz", "rad/s"
  std::optional<int> record;      ///< number of the FRF in the file, from 1; none: its only one
  std::optional<double> noise{};  ///< standard deviation of real and imaginary part alike, relative to |H|
  std::optional<int> averages{};  ///< that the file's coherence belongs to, in place of `noise`
  std::string sha256 = {};        ///< checksum of the file (setup/file_stamps.hpp); empty: not known
};

/// An accelerometer that sat on a component while its FRFs were measured.
struct Sensor {
  std::string point;
  double mass = 0.0;  ///< kg
};

}  // namespace thinwall::setup
