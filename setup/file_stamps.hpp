#pragma once
// Checksums of the files that a set-up names, by which kept results know that a file has changed.

#include "setup/machining_setup.hpp"

namespace thinwall::setup {

/// Sets the SHA-256 of each measured FRF, contact table and modal table that the set-up names. The checksum of a file
/// that cannot be read stays empty; the stage that needs the file says why. Parts from files and URDF arms need none,
/// since the set-up holds all of their content. Cost: the bytes of the files are read and hashed.
void stamp_files(Setup& source);

}  // namespace thinwall::setup
