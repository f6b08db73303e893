#pragma once
// A measured frequency response function, and the sensors that it was measured with.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "io/frf/frf_quantity.hpp"
#include "io/frf/measured_response.hpp"

namespace thinwall::setup {

/// The FRF that a file gives where a set-up names it, with the signs of the DOFs that the set-up says.
struct FrfContent {
  io::MeasuredFrf frf;                ///< receptance on its own axis
  std::vector<std::string> notes;     ///< what was odd in the file, was filled in, or turned
  std::vector<std::string> warnings;  ///< where file and set-up disagree, and which lines are not believed
  bool lines_left_out = false;        ///< lines of the file are not in `frf` (setup/believed_lines.hpp)
};

/// One measured FRF in a file, converted by io/ to receptance.
struct MeasuredFrf {
  std::string response;  ///< DOF name, "P.x"
  std::string force;
  std::filesystem::path file;                 ///< absolute, or relative to the working directory
  std::optional<io::FrfQuantity> quantity{};  ///< none: the file says it
  std::string unit{};                         ///< of the FRF, "um/N"; empty: the file says it
  std::string frequency_unit{};               ///< "Hz", "rad/s"
  std::optional<int> record{};                ///< number of the FRF in the file, from 1; none: its only one
  std::optional<double> noise{};              ///< standard deviation of real and imaginary part alike, relative to |H|
  std::string variable{};            ///< of another program's MAT file, "H(2,1,:)"; empty: the file is one of ours
  std::string frequency_variable{};  ///< beside it
  std::optional<int> averages{};     ///< that the file's coherence belongs to, in place of `noise`
  std::optional<double> from_hz{}, to_hz{};        ///< bounds of its lines; none: where they are believed
  std::shared_ptr<const FrfContent> content = {};  ///< what the file holds, once it is read (setup/data_files.hpp)
};

/// An accelerometer that sat on a component while its FRFs were measured.
struct Sensor {
  std::string point;
  double mass = 0.0;  ///< kg
};

}  // namespace thinwall::setup
