#pragma once
// The data files of a case: read once, when the case is loaded.

#include "case/checks/findings.hpp"
#include "case/machining_case.hpp"

namespace thinwall::cases {

/// Reads the files that the checks of a case look into: the robot's URDF with its joints, its table of modes, and the
/// tables of contacts. A fault of one is a problem of the case, reported at the key that names the file; the case has
/// nothing of that file then.
void read_described_files(Case& source, Findings& findings);

/// Reads the other files that the case names, measured FRFs and the part, and takes the checksum of every file. Throws
/// as setup::read_data_files(). Cost: that of reading all files, and of their checksums.
void read_data_files(Case& source);

/// Puts what the files of `read` hold into `varied`, the same case with other numbers. No file is opened.
void share_data_files(Case& varied, const Case& read);

}  // namespace thinwall::cases
