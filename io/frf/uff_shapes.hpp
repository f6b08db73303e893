#pragma once
// Mode shapes in universal files: data set 55, data at nodes.
//
// Layout: "Universal File Datasets Summary" (SDRC, I-DEAS; data set 55).

#include <Eigen/Core>
#include <complex>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "dynamics/modal_model.hpp"
#include "io/frf/uff_mesh.hpp"
#include "io/frf/universal_file.hpp"

namespace thinwall::io {

/// A mode: normal (real shape, analysis type 2) or complex (analysis type 3; type 7 is read too).
struct UffShape {
  int number = 0;
  bool is_complex = false;
  double frequency_hz = 0.0;     ///< |λ|/2π
  double damping_ratio = 0.0;    ///< −Re λ/|λ|
  double modal_mass = 0.0;       ///< m of a normal mode, kg times the square of the shape's unit
  std::complex<double> pole;     ///< λ of a complex mode, rad/s
  std::complex<double> modal_a;  ///< a of a complex mode: residues are φφᵀ/a
  std::vector<long> nodes;
  Eigen::MatrixXcd displacement;  ///< nodes × 3, or × 6 with rotations (rad)
};

/// The shapes of a file, and notes on irregularities.
struct UffShapes {
  std::vector<UffShape> shapes;
  UffNotes notes{};
};

/// The oscillating modes of a model by rising frequency, λ with Im λ > 0. A shape is normal if it is real but for a
/// phase and a = 2iω_d m with a real positive m (relative 1e-6), otherwise complex. Points get the labels of `nodes`;
/// the displacement of a point is the sum of its DOFs' amplitudes times their directions, zero along directions in
/// which it has no DOF. Throws InputError if a point has no label or ψ differs from φ (relative 1e-9), because the
/// format has no place for a left shape.
[[nodiscard]] std::vector<UffShape> shapes_of(const dynamics::ModalModel& model,
                                              const std::map<std::string, long>& nodes);

/// Writes data sets 151, 164 (SI), the test's geometry where there are nodes (test_geometry_text()), and one data set
/// 55 for each shape: displacement (8) in six digits, E13.5; modal B is −λa. The file is written in one step. Throws
/// InputError if labels and displacements disagree in number,
/// NumericalError if a value is not finite, DataError if the file cannot be written.
void write_uff_shapes(const std::filesystem::path& path, const std::vector<UffShape>& shapes,
                      const UffMesh& geometry = {});

/// Reads the normal and complex modes of a file, with three or six values at a node. Other data sets 55 are skipped and
/// noted; a missing data set 164 is noted. Throws DataError with file and line for a file without shapes, fields that
/// are no numbers, and units other than SI (a shape has no unit by which it could be converted). Memory and cost
/// O(bytes).
[[nodiscard]] UffShapes uff_shapes(std::string_view bytes, const std::string& source);

/// The shapes of a file, as uff_shapes() gives them.
[[nodiscard]] UffShapes read_uff_shapes(const std::filesystem::path& path);

}  // namespace thinwall::io
