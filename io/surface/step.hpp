#pragma once
// Solids of STEP files (ISO 10303-21; AP203, AP214, AP242), as triangles.

#include <filesystem>
#include <string>

#include "mesh/confined.hpp"
#include "mesh/triangle_soup.hpp"

namespace thinwall::io {

/// The fineness with which a STEP file's faces become triangles.
struct StepOptions {
  /// The distance by which a triangle may lie off the true surface, as a fraction of the diagonal of the part's block,
  /// 1e-6 to 0.1.
  double linear_deflection = 1e-3;
  /// Turning between neighbouring triangles of a curved face, 0.01 to 1.5: a tube loses θ²/6 of its volume to the
  /// chords, a thousandth.
  double angular_deflection_rad = 0.08;
  double metres_per_unit = 0.0;  ///< unit used instead of the file's own; 0: the file's own
  mesh::ProcessLimits limits;
};

/// A solid of a STEP file.
struct StepSurface {
  mesh::TriangleSoup soup;  ///< m; points that faces share are equal
  std::string unit;         ///< the file's unit of length as it names it: "MILLIMETRE", "INCH"
  double metres_per_unit = 0.0;
};

/// Reads a file with one solid and triangulates its faces (Open CASCADE: STEPControl_Reader, BRepMesh_IncrementalMesh;
/// the volume of the solid by BRepGProp),
/// in a process of its own with limits, because some files crash Open CASCADE or occupy it for very long. Throws
/// InputError for options out of range and if the program was built without Open CASCADE; DataError for a file that
/// cannot be opened, is no STEP file (no ISO-10303-21 at its begin), ends early, states no or several units of length,
/// contains no solid (shells and faces only) or several, with their places, or whose solid cannot be triangulated.
/// Cost: seconds.
[[nodiscard]] StepSurface read_step(const std::filesystem::path& path, const StepOptions& options = {});

/// True if this program can read STEP.
[[nodiscard]] bool reads_step();

}  // namespace thinwall::io
