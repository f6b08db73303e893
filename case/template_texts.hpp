#pragma once
// Texts of the cases that `thinwall init` writes. Every key is in docs/case-file.md.

namespace thinwall::cases {

extern const char* const plate_template;
extern const char* const wall_template;
extern const char* const stl_part_template;
extern const char* const robot_template;
extern const char* const frf_only_template;
extern const char* const lobes_template;

}  // namespace thinwall::cases
