#pragma once
// Results that the stages of a run hand to each other and to the output: one plain struct a stage.

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/words.hpp"
#include "coupling/frf_noise.hpp"
#include "coupling/hertz_contact.hpp"
#include "coupling/joint_identification.hpp"
#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"
#include "dynamics/modal_model.hpp"
#include "dynamics/response_model.hpp"
#include "dynamics/spatial_model.hpp"
#include "fem/modes.hpp"
#include "fem/to_tolerance.hpp"
#include "learning/calibration.hpp"
#include "learning/next_cut.hpp"
#include "mesh/solid/quality.hpp"
#include "milling/chart/lobes.hpp"
#include "milling/chart/operating_point.hpp"
#include "milling/chart/pockets.hpp"
#include "milling/chart/robust_lobes.hpp"
#include "milling/chart/sampled_uncertainty.hpp"
#include "milling/chart/stability_map.hpp"
#include "milling/forced/forced_vibration.hpp"
#include "milling/observed/observed_cut.hpp"
#include "reduction/identification.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "reduction/trust/accuracy.hpp"
#include "reduction/trust/truncation.hpp"
#include "setup/contact_model.hpp"
#include "setup/machining_setup.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/chart_of.hpp"
#include "study/simulation/amplitude_map.hpp"
#include "study/simulation/point_simulation.hpp"

namespace thinwall::study {

/// The part by finite elements, and its reduced model.
struct PartResult {
  fem::Model model;
  fem::Modes modes;
  double min_quality = 0.0;  ///< mean ratio
  mesh::Quality quality;
  std::optional<fem::Estimate> estimate;  ///< of what the mesh costs in accuracy; none for a given size
  std::vector<double> wall_thickness_m;   ///< beneath each triangle of mesh::surface_triangles; empty: not known
  double mass_difference = 0.0;           ///< mass, centre, inertia: matrix against geometry, relative
  reduction::Interface interface;
  std::optional<reduction::CraigBampton> reduced;     ///< none without an interface
  std::optional<reduction::Truncation> truncation;    ///< of what it leaves out
  double frequency_error = 0.0;                       ///< of the reduced model, largest relative
  std::vector<reduction::ErrorBySize> error_by_size;  ///< the same with fewer modes
  std::optional<double> estimated_receptance_error;   ///< of the reduced model over the band, with reduction.tolerance
  std::optional<double> receptance_error;             ///< against direct solves of the full model, largest relative
  std::vector<reduction::IdentifiedMode> identified;  ///< damping found in a measured FRF
  std::optional<dynamics::SpatialModel> damped;       ///< the reduced model with its damping
  std::vector<dynamics::SpatialModel> along_path;     ///< reduced at each position of the path; undamped
};

/// A component as the coupling sees it: matrices where they are known, and its response on the axis of the run.
struct Component {
  std::optional<dynamics::SpatialModel> spatial;
  std::optional<dynamics::ModalModel> modal;
  dynamics::ResponseModel response;
};

/// The tip in one posture. Stiffnesses are static, N/m: force over displacement along the same direction with the other
/// forces zero, 1/H_nn(0); infinite where the tip does not move. None of a robot known by measured receptances.
struct TipReport {
  setup::RobotPosture robot;
  std::vector<dynamics::ModeSummary> modes;
  std::optional<Eigen::Vector3d> stiffness;           ///< along x, y, z of the part
  std::optional<double> least_stiffness;              ///< over all directions
  Eigen::Vector3d softest = Eigen::Vector3d::Zero();  ///< the direction of that, a unit vector
};

/// A place that the arm does not take, and why.
struct OutOfReach {
  Eigen::Vector3d place;
  std::string reason;
};

/// The places over which a robot is surveyed: its one posture, the positions of a path, or its workspace.
enum class SurveyPlaces { posture, path, workspace };

/// The robot's tip over many postures.
struct RobotSurvey {
  SurveyPlaces over = SurveyPlaces::posture;
  std::vector<TipReport> tips;
  std::vector<OutOfReach> out_of_reach;
};

/// A contact that was found from FRFs of the assembly.
struct ContactIdentification {
  coupling::IdentifiedJoint found;
  coupling::JointMatrices joined;     ///< what was found, damping that gives energy taken as none
  Eigen::Index lines = 0;             ///< that were compared
  double from_hz = 0.0, to_hz = 0.0;  ///< the first of them and the last
  bool damping_raised = false;        ///< `joined` has more damping than was found
};

/// Part and robot joined by both routes.
struct CouplingResult {
  coupling::CoupledResponse receptance;
  std::optional<dynamics::SpatialModel> model;  ///< none if a component is known by measurement only
  std::optional<dynamics::ModalModel> modal;
  std::optional<dynamics::ResponseModel> spatial_response;  ///< between the part's DOFs
  std::optional<coupling::RouteDifference> difference;      ///< none if both components are measured
  std::vector<reduction::IdentifiedMode> identified;  ///< peaks of the coupled receptance where there is no modal model
  std::string no_spatial_route;  ///< why matrices that are known were not joined; empty: nothing hindered it
};

/// Responses at further lines for plots, ascending; none of what has none (support/added_lines.hpp).
struct AddedLines {
  std::optional<dynamics::ResponseModel> part, robot, coupled, coupled_spatial;
};

/// The error of a response, in its shape, one matrix a line; empty where nothing is known to be wrong.
struct ResponseErrors {
  coupling::Deviations noise{};                ///< standard deviation of real and imaginary part alike
  std::vector<Eigen::MatrixXcd> truncation{};  ///< signed: this model less that with what its reduction left out
};

/// Errors of all components, and the models with what was left out.
struct ErrorBudget {
  ResponseErrors part, robot, coupled;
  std::optional<Component> richer_part;
  std::optional<dynamics::ModalModel> richer_coupled;
};

/// The error of a limiting depth, m; none where it is not known: no limit there, or not found again.
struct DepthError {
  std::optional<double> truncation_m;   ///< signed: this depth less that with what the part's reduction left out
  std::optional<double> noise_m;        ///< standard deviation by the noise of what was measured, first order
  std::optional<double> low_m, high_m;  ///< 95 % of the limits lie between by the uncertainty of what was identified
};

/// The reduction by which the coupled receptance is at a resonance of the part.
struct AmplitudeReduction {
  std::string dof;
  double frequency_hz = 0.0;
  double alone = 0.0;      ///< |H|, m/N
  double supported = 0.0;  ///< |G|, m/N
};

/// By how many percent a limiting depth rises if a parameter rises by one percent, d ln w / d ln p.
struct ParameterSensitivity {
  std::string parameter;                    ///< frequency, damping_ratio, receptance (of a mode); K_t, K_r, K_a
  std::optional<double> mode_frequency_hz;  ///< the mode's own; none of a coefficient
  double value = 0.0;
};

/// The force of the part on the tip along the preload while the cutter cuts, N: pressing while positive.
struct ContactForce {
  double preload_n = 0.0;
  double least_n = 0.0;
  double largest_n = 0.0;
  bool lost = false;  ///< least_n < 0: the contact opens, and what is linear here no longer holds
};

/// Up to which depth of the cut at the case's own speed a contact with a preload holds.
struct ContactLimit {
  double preload_n = 0.0;
  std::optional<double> lost_above_m;  ///< none: it holds up to the limiting depth
};

/// The forced motion at one speed, in figures.
struct ForcedFigures {
  std::optional<double> surface_location_error_m;  ///< positive: overcut; none without a wall
  double peak_force_n = 0.0;
  double error_estimate = 0.0;          ///< relative, of the worst of these
  std::optional<ContactForce> contact;  ///< of the supported part with a preload
};

/// A speed, and its forced motion where the cut is stable.
struct ForcedRow {
  double spindle_speed_rpm = 0.0;
  std::optional<ForcedFigures> figures;
};

/// The forced motion of a depth of cut over the speeds of a chart.
struct ForcedOverSpeed {
  double depth_m = 0.0;
  double feed_per_tooth_m = 0.0;
  std::vector<ForcedRow> rows;
};

/// The answer of a chart for one operating point.
struct PointStability {
  milling::OperatingPoint point;
  bool stable = false;
  std::optional<milling::Multiplier> multiplier;  ///< none from samples: there are no poles
  milling::DepthMargin depth;
  milling::SpeedMargin speed;
  milling::StabilityStatus status = milling::StabilityStatus::converged;
  std::optional<milling::ForcedVibration> forced;   ///< of a stable point where poles and the feed are known
  std::optional<ContactForce> contact;              ///< of the supported part with a preload, where `forced` is known
  std::vector<ParameterSensitivity> sensitivities;  ///< of the boundary in depth, largest first; by the direct method
};

/// The verdict of an uncertain prediction on a cut.
enum class Certainty { certainly_stable, open, certainly_unstable };

/// A cut that was made, and what a chart says of it.
struct JudgedCut {
  milling::ObservedCut observed;
  PointStability predicted;
  std::optional<double> chatter_probability;  ///< by draws of [lobes.uncertainty]; none: nothing is uncertain
  std::optional<Certainty> certainty;         ///< that follows
  std::optional<bool> textbook_stable;        ///< by the zeroth-order method; none: it cannot take the cut
};

/// A chart after the cuts that were made taught it.
struct LearnedChart {
  /// The limits of the draws at one speed, m.
  struct Row {
    double spindle_speed_rpm = 0.0;
    double before_m = 0.0;                        ///< of the nominal cut
    double median_m = 0.0;                        ///< stable with 50 %
    double stable_90_m = 0.0, stable_95_m = 0.0;  ///< stable with so many percent of the draws
  };
  learning::Calibration calibration;
  std::optional<milling::Score> before;           ///< cuts that the nominal cut predicts rightly
  std::optional<milling::Score> cross_validated;  ///< that likeliest parameters of other cuts do
  std::optional<learning::NextCut> next;          ///< narrows the limit at `next_for_rpm`, without it the best speed
  std::optional<double> next_for_rpm;
  std::optional<learning::NextCut> productive;  ///< removes most at the wanted risk
  std::vector<Row> rows;
};

/// A chart of the same cut by another method, and where it differs most.
struct ComparedLobes {
  std::string method;  ///< name of milling::Method
  milling::Lobes lobes;
  double largest_difference = 0.0;  ///< |w' − w|/w of limiting depths
  double at_spindle_speed_rpm = 0.0;
};

/// A limit that hangs on lines below the first resonance, which hold hardly more than noise, an offset or the drift of
/// a sensor.
struct LimitBelowResonance {
  double chatter_frequency_hz = 0.0;
  double first_resonance_hz = 0.0;
};

/// The stability chart of a structure, with all that was asked of it.
struct StructureLobes {
  ChartOf of = ChartOf::part;
  milling::Lobes lobes;
  std::optional<milling::LobeRow> at_spindle_speed;  ///< at the case's own speed
  std::optional<LimitBelowResonance> doubtful;       ///< there, else at the least depth; none of a limit that is sound
  std::optional<ContactLimit> contact;               ///< there, of a supported part with a preload, poles and a feed
  std::vector<PointStability> points;                ///< that were asked for
  std::vector<ForcedOverSpeed> forced_over_speed;    ///< of the depths of `points`, where poles and the feed are known
  std::vector<ParameterSensitivity> sensitivities;   ///< at the case's own speed, largest first
  std::vector<double> main_modes_hz;                 ///< that the cut feels most, ascending
  std::vector<milling::Pocket> pockets;              ///< within the machine's limits, best first
  std::vector<ComparedLobes> compared;
  std::optional<milling::StabilityMap> map;
  std::optional<milling::RobustLobes> robust;
  std::vector<milling::Pocket> robust_pockets;
  std::vector<JudgedCut> observed;                   ///< the cuts that were made, in the order of the case
  std::optional<LearnedChart> learned;               ///< from these cuts, where it was asked for
  std::vector<DepthError> errors;                    ///< of every row; empty: nothing is known to be wrong
  std::optional<DepthError> error_at_spindle_speed;  ///< at the case's own speed
  std::optional<milling::DepthScatter> scatter;      ///< of drawn samples, at the case's own speed
};

/// Charts of one structure at the positions of the path.
struct PathLobes {
  ChartOf of = ChartOf::part;                        ///< part, supported or carried
  std::vector<milling::Lobes> lobes;                 ///< of each position
  std::vector<milling::LobeRow> at_spindle_speed{};  ///< of each, at the case's own speed; empty without one
  std::vector<setup::RobotPosture> robot{};          ///< how it stands at each; empty for the part alone
};

/// One fit of model updating.
struct UpdatingResult {
  /// A number that the fit could change: before and after, and its bounds.
  struct Parameter {
    std::string key;
    std::string unit;  ///< of the numbers that follow; empty: a plain number
    double start = 0.0, fitted = 0.0, lower = 0.0, upper = 0.0;
    bool at_bound = false;
  };
  /// A known result: wanted, reached, and its sensitivity to each number.
  struct Target {
    std::string quantity;
    double wanted = 0.0, reached = 0.0;
    std::vector<double> sensitivity;  ///< relative change of the quantity per relative change of each parameter
  };
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<Target> targets;
  int evaluations = 0;
  bool converged = false;
};

/// Everything that a run has computed; what the set-up does not hold is empty.
struct Results {
  setup::Setup setup;  ///< with the values that the fits found
  std::vector<UpdatingResult> updating;
  std::optional<PartResult> finite_elements;
  std::optional<Component> part;
  std::optional<setup::RobotPosture> robot_posture;
  std::optional<Component> robot;
  std::optional<RobotSurvey> survey;
  std::optional<ContactIdentification> identification;  ///< of the only contact, where it was asked for
  std::vector<setup::JoinedContact> contacts;           ///< in the order of the case
  std::optional<CouplingResult> coupled;
  AddedLines added;  ///< between those of part, robot and both
  std::vector<AmplitudeReduction> reductions;
  ErrorBudget errors;
  std::optional<milling::SampledReceptance> synthesised_tip;  ///< of a measured tool, by its fitted poles; part axes
  std::vector<StructureLobes> lobes;
  std::vector<PathLobes> path;
  std::vector<PointSimulation> simulations;               ///< structure by structure
  std::vector<AmplitudeMap> amplitude_maps;               ///< of each structure, where a map is asked for
  std::vector<std::pair<std::string, double>> timings_s;  ///< stage, seconds, in the order they ran
};

}  // namespace thinwall::study

namespace thinwall::core {

template <>
inline constexpr std::array<std::string_view, 3> words<study::Certainty>{"certainly_stable", "open",
                                                                         "certainly_unstable"};
template <>
inline constexpr std::array<std::string_view, 3> words<study::SurveyPlaces>{"posture", "path", "workspace"};

}  // namespace thinwall::core
