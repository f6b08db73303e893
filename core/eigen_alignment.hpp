#pragma once
// Whether this file lays out Eigen's matrices as the library does (docs/cpp.md): CMake's target and pkg-config see to
// it; whoever compiles by other means is told here rather than by a crash.

#include <Eigen/Core>

static_assert(
    EIGEN_MAX_ALIGN_BYTES == 32 && EIGEN_MAX_STATIC_ALIGN_BYTES == 32,
    "thinwall: compile with -DEIGEN_MAX_ALIGN_BYTES=32 -DEIGEN_MAX_STATIC_ALIGN_BYTES=32, as its library was");
