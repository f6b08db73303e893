#pragma once
// The files that a set-up names: each is read once, and the set-up holds what it says from then on.

#include <vector>

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// The measured FRFs that the set-up names: of the part, its damping, the contacts, the robot and the tool.
[[nodiscard]] std::vector<MeasuredFrf*> measured_frfs(Setup& source);
/// The measured FRFs of a set-up that stays as it is, in the same order.
[[nodiscard]] std::vector<const MeasuredFrf*> measured_frfs(const Setup& source);

/// Reads the files that the set-up names and does not hold yet: measured FRFs, tables of contacts, the robot's table of
/// modes or those of its postures, observed cuts, the part. A file of which several FRFs are taken is read once. No
/// stage of study/ opens a file, so a set-up that was not read is refused there. Of an FRF the lines that are not
/// believed are left out, and those of a tool are brought to one band (setup/believed_lines.hpp). Throws DataError,
/// with file and line, for a file that cannot be read, and InputError as read_measured(), with_believed_lines(),
/// take_common_band() and read_part_file(). Cost: that of reading all files.
void read_data_files(Setup& source);

/// Puts what the files of `read` hold into `varied`, the same set-up with other numbers. No file is opened. What was
/// identified of them (setup/identified/identify.hpp) is not handed on: it may follow from a number that is another
/// one.
void share_data_files(Setup& varied, const Setup& read);

/// Sends what was odd in the files of measured FRFs as messages (core/messages.hpp): what was filled in, a sensor that
/// points the other way, axes that differ from the set-up's, lines that are not believed.
void tell_of_data_files(const Setup& source);

}  // namespace thinwall::setup
