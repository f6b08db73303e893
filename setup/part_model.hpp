#pragma once
// Which modes, which reduced model and which damping of the part are wanted, and on which frequencies.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/words.hpp"
#include "setup/measured_frf.hpp"

namespace thinwall::setup {

/// Modes wanted, by count or by frequency.
struct ModeRange {
  std::optional<int> count;
  std::optional<double> up_to_hz;
};

/// The modes of the whole part that are asked for.
struct Modes {
  ModeRange range;
  bool verify = false;    ///< by a Sturm count and a second eigen-solver
  int substructures = 0;  ///< domains, a power of two; 0 for block Lanczos on the whole part
};

/// Fixed-interface modes of a reduced model where a case does not say how many; fewer of a part that has no more.
inline constexpr int usual_reduction_modes = 30;

/// The reduced model of the part that is asked for.
struct Reduction {
  ModeRange fixed_interface;
  std::optional<double> tolerance;     ///< on the interface's receptance, in place of a range
  std::vector<std::string> interface;  ///< names of points
  int check_frequencies = 5;
};

/// A damping ratio of each mode, given or from a measured driving point.
struct ModalDamping {
  double ratio = 0.0;          ///< of every mode that `ratios` does not name
  std::vector<double> ratios;  ///< of the first modes
  std::optional<MeasuredFrf> from_frf;
};

/// C = αM + βK.
struct RayleighDamping {
  double alpha = 0.0;  ///< 1/s
  double beta = 0.0;   ///< s
};

/// K (1 + iη).
struct StructuralDamping {
  double loss_factor = 0.0;
};

/// The damping matrix of the part's file.
struct MatrixDamping {};

/// Damping of the part: one of the models, with its numbers.
using Damping = std::variant<ModalDamping, RayleighDamping, StructuralDamping, MatrixDamping>;

/// The models of the part's damping, in the order of Damping.
enum class DampingKind { modal, rayleigh, structural, matrices };

/// The frequencies at which receptances are computed, and the points between which.
struct ResponseOptions {
  double from_hz = 1.0, to_hz = 2000.0;
  int lines = 2000;
  bool logarithmic = false;
  std::vector<std::string> points;
};

}  // namespace thinwall::setup

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 4> words<setup::DampingKind>{"modal", "rayleigh", "structural",
                                                                           "matrices"};

}  // namespace thinwall::core
