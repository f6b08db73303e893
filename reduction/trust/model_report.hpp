#pragma once
// May I trust this matrix? Checks on any reduced model, our own or imported.

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

/// What the report is told beside the matrices, and what it holds them to.
struct ReportOptions {
  Positions positions{};                       ///< m, of every point of the table; empty: nothing about rigid motions
  std::optional<Eigen::Vector3d> reference{};  ///< m, where rotations turn about; left out: the mean of the points
  std::optional<int> rigid_motions{};  ///< how many must be free (0: a held part, 6: a free one); left out: told
  double symmetry = 1e-9;              ///< largest |A − Aᵀ| over the largest |A|
  double definiteness = 1e-9;          ///< least eigenvalue over that of a unit diagonal may be minus this
  double rigid_motion = 1e-4;          ///< disagreement of the three sets; of mass along the axes
  double grounding = 1e-6;             ///< yᵀKy / yᵀMy of a free rigid motion over λ of the lowest elastic mode
  double effective_mass = 1e-6;        ///< closure of the sum over all modes
  double reciprocity = 1e-9;           ///< |H − Hᵀ| over |H|
};

/// A matrix: symmetry and eigenvalues, rows and columns scaled to a unit diagonal (K's to no less than M's would be at
/// the lowest elastic frequency, so that amplitudes of rigid-body modes, without stiffness, do not show round-off).
struct MatrixState {
  std::string name;
  double asymmetry = 0.0;  ///< largest |A − Aᵀ| over the largest |A|, as scaled
  double least = 0.0;      ///< eigenvalue of the symmetric part, as scaled
  int negative = 0;        ///< eigenvalues below −bound
  int zero = 0;            ///< eigenvalues within ±bound: for K, rigid motions and massless mechanisms
  bool told = true;  ///< whether the eigenvalues could be counted (sparse models: no shift without a vanishing pivot)
  std::string place{};  ///< the DOF, or pair, that shows what is wrong; "" where nothing is
};

/// What moving the model as a rigid body costs and weighs.
struct RigidBodyState {
  RigidSets sets;
  Eigen::Vector3d reference = Eigen::Vector3d::Zero();
  Eigen::Matrix<double, 6, 1> grounding_stiffness = Eigen::Matrix<double, 6, 1>::Zero();  ///< N/m, N m/rad: YᵀKY
  Eigen::Matrix<double, 6, 1> grounding_hz = Eigen::Matrix<double, 6, 1>::Zero();         ///< √(YᵀKY / YᵀMY)/2π
  int free_motions = 0;                                ///< with grounding in the bound, whatever their axes
  std::vector<std::string> in_words;                   ///< the free ones (dynamics/motion_words.hpp)
  dynamics::Matrix6 mass = dynamics::Matrix6::Zero();  ///< YᵀMY about the reference
  double mass_disagreement = 0.0;  ///< of the three sets' and of the masses along x, y, z, over the mean
  dynamics::RigidBody body;        ///< centre from the origin of the positions
  EffectiveMass effective;
};

/// One line of the verdict.
struct Finding {
  std::string name;
  double value = 0.0;
  double bound = 0.0;
  bool ok = true;
  std::string advice;  ///< what to do if it is not
};

/// After pyYeti's cbcheck, for any DOF table.
struct [[nodiscard]] ReducedModelReport {
  int coordinates = 0, translations = 0, rotations = 0, amplitudes = 0;
  std::vector<MatrixState> matrices;    ///< M, C, K, D
  std::optional<RigidBodyState> rigid;  ///< if there are positions
  ModesWithoutEnergy without_energy;    ///< that are counted as free
  std::vector<double> frequencies_hz;   ///< the lowest twenty beyond those without energy
  /// Largest |H − Hᵀ| / |H| over five frequencies, loss factor 0.02; least eigenvalue of −Im H there over |H|: ≥ 0 for
  /// a passive model. NaN, and no finding, where no receptance was computed: of sparse models, or without frequencies.
  double reciprocity = std::numeric_limits<double>::quiet_NaN();
  double least_power = std::numeric_limits<double>::quiet_NaN();
  std::vector<Finding> findings;
  [[nodiscard]] bool trustworthy() const;  ///< every finding is ok
};

/// Checks M, C, K, D and the table of a model (docs/theory/reductions.md, Eq. 16-18). Never throws for what it is there
/// to find (asymmetric, indefinite, grounded); InputError for a model that is no model (require_consistent()), without
/// a DOF of a point, or whose points have no positions although some are given. Cost O(n³).
ReducedModelReport report(const dynamics::SpatialModel& model, const ReportOptions& options = {});

/// The report as lines for a terminal, findings first.
[[nodiscard]] std::string text(const ReducedModelReport& report);

}  // namespace thinwall::reduction
