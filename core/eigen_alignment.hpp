#pragma once
// A check at compile time that a program which includes thinwall lays out Eigen's matrices as the library does
// (docs/cpp.md). CMake's target and pkg-config pass the right definitions; a program compiled by other means gets this
// message instead of a crash.

#include <Eigen/Core>

static_assert(
    EIGEN_MAX_ALIGN_BYTES == 32 && EIGEN_MAX_STATIC_ALIGN_BYTES == 32,
    "thinwall: compile with -DEIGEN_MAX_ALIGN_BYTES=32 -DEIGEN_MAX_STATIC_ALIGN_BYTES=32, as its library was");
