#pragma once
// Rows of a table of modes as an identification gives them, and back.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "dynamics/modal_table.hpp"
#include "identification/modal_fit.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// A fault of a robot that is known by tables, and the key of the robot that is at fault: "table", "table_point",
/// "postures", "over", "at", "joint_columns", "sensors".
struct TabledRobotError : core::Error {
  TabledRobotError(std::string key_at_fault, const core::Error& fault)
      : core::Error(fault.code(), fault.what()), key(std::move(key_at_fault)) {}
  std::string key;
};

/// The modes of a tip without the sensors with which they were found.
struct TipTable {
  dynamics::ModalTable table;
  double condition = 1.0;  ///< by which errors of the file's modes grow (robot::FreedTable), product over the sensors
};

/// Reads a table of modes in the units of the robot, with its tip at one place, and frees it of the robot's sensors
/// (robot::without_point_mass()). Throws TabledRobotError for a file without the tip's point and for a mass that cannot
/// be taken off, and errors as io::modal_unit() and io::read_modal_table().
[[nodiscard]] TipTable read_tip_table(const std::filesystem::path& file, const TabledRobot& robot);

/// The part of a table that the robot's model takes: of its tip, or of the tip and the point up, across the tool, where
/// there is one. Throws InputError for a point that the table has not.
[[nodiscard]] dynamics::ModalTable used_part(const TabledRobot& robot, const dynamics::ModalTable& table);

/// A sentence on sensors that make errors of a table larger by more than a factor of ten; empty if they do not.
/// `where`: "at posture \"p3\"" or the name of the file.
[[nodiscard]] std::string doubt_about_sensors(double condition, const std::string& where);

/// The rows of a table as an identification would give them: residue R Lᵀ, largest entry of the left vector 1. Throws
/// DataError, with the file's name, for a mode that moves nothing.
[[nodiscard]] std::vector<identification::FittedMode> modes_of(const dynamics::ModalTable& table,
                                                               const std::string& file);

/// Modes as a table over DOFs that are responses and references, in the order of the residues' rows. A residue of more
/// than rank one, as of modes that overlap, becomes several rows. Places of all points are 0: they are one.
[[nodiscard]] dynamics::ModalTable table_of(std::vector<identification::FittedMode> modes,
                                            const dynamics::DofTable& dofs);

}  // namespace thinwall::setup
