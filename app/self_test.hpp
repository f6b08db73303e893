#pragma once
// A test that the program computes on this machine what it should.

#include <string>

namespace thinwall::app {

/// The first bending frequency of a slender cantilever by mesh, assembly, factorisation and eigen-solver, beside that
/// of beam theory, with a check of the modes by a Sturm count and by a second eigen-solver; the theory's is 1.8751^2 /
/// (2 pi l^2) sqrt(E I / (rho A)) (Timoshenko, Young & Weaver 1974).
struct SelfTest {
  double found_hz = 0.0;
  double expected_hz = 0.0;
  double seconds = 0.0;
  std::string failure;           ///< what was thrown, if anything: that the check of the modes disagrees, too
  double mode_difference = 0.0;  ///< of an eigenvalue from that of the second eigen-solver, relative

  /// Within 1 %: at a twentieth of the length, shear and rotary inertia take 0.3 % (Timoshenko's beam).
  [[nodiscard]] bool ok() const;
};

/// Some tenths of a second. Throws Interrupted, nothing else.
[[nodiscard]] SelfTest self_test();

}  // namespace thinwall::app
