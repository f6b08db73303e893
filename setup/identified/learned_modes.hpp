#pragma once
// The modes of a robot's tip at a posture where it was not tapped, learned from tables at others.

#include "dynamics/modal_table.hpp"
#include "setup/robot.hpp"

namespace thinwall::setup {

/// The modes to be expected at a posture.
struct LearnedModes {
  dynamics::ModalTable table;  ///< of the robot's tip alone
  LearnedPostures learned;
};

/// Reads the postures' list and the table of each, follows the modes over the postures (identification::track()),
/// learns ln f, ln ζ and the residues over the columns, each scaled to −1 … 1 (posture::Predictor, without a model as
/// the mean), and predicts them at the posture that is asked for. A residue of more than rank one, as of modes that
/// overlap, becomes several rows. Doubts: a posture beyond the hull of the tapped ones, modes that were seen at too few
/// of them, labels that neighbours contradict. Throws InputError for a robot without postures, a table without
/// "{posture}" in its name, columns and numbers that are not as many, a column that does not vary, tables with
/// different DOFs of the tip; DataError for files as io::read_csv_text() and io::read_modal_table(). Cost: the reading,
/// then a process for each number of each mode (posture::Predictor).
[[nodiscard]] LearnedModes learned_modes(const TabledRobot& robot);

}  // namespace thinwall::setup
