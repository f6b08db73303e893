#pragma once
// A report on whether a reduced model, of this program or imported, can be trusted.

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/rigid_body.hpp"
#include "dynamics/spatial_model.hpp"
#include "reduction/trust/effective_mass.hpp"
#include "reduction/trust/rigid_sets.hpp"

namespace thinwall::reduction {

/// Data beside the matrices, and the bounds of the checks.
struct ReportOptions {
  Positions positions{};                       ///< m, of every point; if empty, rigid motions are not checked
  std::optional<Eigen::Vector3d> reference{};  ///< m, centre of rotations; by default the mean of the points
  std::optional<int> rigid_motions{};  ///< expected number of free ones (0 held, 6 free); only reported if left out
  double symmetry = 1e-9;              ///< largest |A − Aᵀ| over the largest |A|
  double definiteness = 1e-9;    ///< least eigenvalue of a matrix scaled to a unit diagonal ≥ minus this; what of
                                 ///< K and M is smaller in a motion is neither stiffness nor mass
  double rigid_motion = 1e-4;    ///< disagreement of the three sets, and of the mass along the axes
  double grounding = 1e-6;       ///< yᵀKy / yᵀMy of a free rigid motion over λ of the lowest elastic mode
  double effective_mass = 1e-6;  ///< closure of the sum over all modes
  double reciprocity = 1e-9;     ///< |H − Hᵀ| over |H|
};

/// Symmetry and eigenvalues of a matrix, with rows and columns scaled to a unit diagonal. The diagonal of K is taken as
/// at least that of M at the lowest elastic frequency, so that amplitudes of rigid-body modes, which have no stiffness,
/// do not show round-off.
struct MatrixState {
  std::string name;
  double asymmetry = 0.0;  ///< largest |A − Aᵀ| over the largest |A|, as scaled
  double least = 0.0;      ///< least eigenvalue of the symmetric part, as scaled
  int negative = 0;        ///< eigenvalues below −bound
  int zero = 0;            ///< eigenvalues within ±bound: for K, rigid motions and massless mechanisms
  bool told = true;        ///< true if the eigenvalues could be counted (for sparse models, not at vanishing pivots)
  std::string place{};     ///< DOF, or pair of DOFs, at fault; "" if none is
};

/// Stiffness and mass of the model for rigid-body motions.
struct RigidBodyState {
  RigidSets sets;
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 1> grounding_stiffness = Eigen::Matrix<double, 6, 1>::Zero();  ///< N/m, N m/rad: YᵀKY
  Eigen::Matrix<double, 6, 1> grounding_hz = Eigen::Matrix<double, 6, 1>::Zero();         ///< √(YᵀKY / YᵀMY)/2π
  int free_motions = 0;                                ///< number with grounding within the bound, about any axes
  std::vector<std::string> in_words;                   ///< free motions in words (dynamics/motion_words.hpp)
  dynamics::Matrix6 mass = dynamics::Matrix6::Zero();  ///< YᵀMY about the reference
  double mass_disagreement = 0.0;                      ///< of masses along x, y, z and by the three sets, over the mean
  dynamics::RigidBody body;                            ///< centre relative to the origin of the positions
  EffectiveMass effective;
};

/// The result of one check.
struct Finding {
  std::string name;
  double value = 0.0;
  double bound = 0.0;
  bool ok = true;
  std::string advice;  ///< advice if it is not ok
};

/// The report on a model, after pyYeti's cbcheck, for any DOF table.
struct [[nodiscard]] ReducedModelReport {
  int coordinates = 0, translations = 0, rotations = 0, amplitudes = 0;
  std::vector<MatrixState> matrices;    ///< M, C, K, D
  std::optional<RigidBodyState> rigid;  ///< if there are positions
  ModesWithoutEnergy without_energy;    ///< modes counted as free
  std::vector<double> frequencies_hz;   ///< lowest twenty beyond those without energy
  /// Largest |H − Hᵀ| / |H| over five frequencies with the loss factor 0.02, and the least eigenvalue of −Im H there
  /// over |H|, which is ≥ 0 for a passive model. Both are NaN, without a finding, if no receptance was computed: for
  /// sparse models, or without frequencies.
  double reciprocity = std::numeric_limits<double>::quiet_NaN();
  double least_power = std::numeric_limits<double>::quiet_NaN();
  std::vector<Finding> findings;
  [[nodiscard]] bool trustworthy() const;  ///< true if every finding is ok
};

/// The report on M, C, K, D and the table of a model (docs/theory/reductions.md, Eq. 16-18). Faults that it is meant to
/// find (asymmetric, indefinite, grounded matrices) are reported and never thrown. Throws InputError for a model that
/// is inconsistent (require_consistent()), has no DOF of a point, or has points without positions although some are
/// given. Cost O(n³).
ReducedModelReport report(const dynamics::SpatialModel& model, const ReportOptions& options = {});

/// The report as lines for a terminal, findings first.
[[nodiscard]] std::string text(const ReducedModelReport& report);

}  // namespace thinwall::reduction
