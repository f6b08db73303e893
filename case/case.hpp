#pragma once
// What a case file says, in SI and typed (frequencies in Hz, spindle speeds in rpm, as their names tell).
// Every key is described in case/schema.cpp and docs/case-file.md. The pipeline does what the case holds.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "case/values.hpp"
#include "coupling/contact.hpp"
#include "coupling/hertz_contact.hpp"
#include "io/matrices/matrix_files.hpp"
#include "mesh/planar/prism.hpp"
#include "mesh/surface/surface_repair.hpp"
#include "milling/chart/machine_limits.hpp"
#include "milling/chart/sensitivity.hpp"
#include "robot/serial_arm.hpp"
#include "robot/virtual_joints.hpp"

namespace thinwall::app {

struct Material {
  double youngs_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.0;
  double density = 0.0;  ///< kg/m³
};

struct MeshOptions {
  std::optional<double> element_size;        ///< m; none: from the tolerance
  double tolerance = 1e-3;                   ///< on frequencies and receptances, where the size is not given
  std::optional<int> order;                  ///< none: from the tolerance; 2 with a given size
  double quality = 1.4;                      ///< TetGen's bound on circumradius over shortest edge
  std::optional<double> grading;             ///< growth of the size away from the named points
  std::optional<double> point_element_size;  ///< m, near the named points
  double time_limit = 120.0;                 ///< s
  double memory_limit = 4e9;                 ///< bytes
};

/// A named set of boundary points of the part: exactly one of the three predicates.
struct Selection {
  struct Plane {
    Eigen::Vector3d point, normal;
  };
  struct Box {
    Eigen::Vector3d min, max;
  };
  struct Sphere {
    Eigen::Vector3d centre;
    double radius = 0.0;
  };
  std::string name;
  std::optional<Plane> plane;
  std::optional<Box> box;
  std::optional<Sphere> sphere;
};

/// Directions held at zero on a face (`x_min` … `z_max`) or on a selection.
struct Support {
  std::string on;
  std::vector<int> fixed;  ///< 0, 1, 2 for x, y, z
};

/// Another material than the part's, of a set of elements or of a selection.
struct MaterialRegion {
  std::string on;
  Material material;
};

/// A bed of springs on a face or a selection, stiffness per area.
struct Clamp {
  std::string on;
  double normal = 0.0, tangential = 0.0;  ///< N/m³
};

/// A rigid body on a point.
struct PointMass {
  std::string at;
  double mass = 0.0;                                  ///< kg
  Eigen::Vector3d inertia = Eigen::Vector3d::Zero();  ///< kg m², about its own centre and x, y, z
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();   ///< m
};

/// Springs from a point to ground.
struct PointSpring {
  std::string at;
  Eigen::Vector3d stiffness = Eigen::Vector3d::Zero();           ///< N/m
  Eigen::Vector3d rotation_stiffness = Eigen::Vector3d::Zero();  ///< N m/rad
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();              ///< m
};

/// The part is bent about a cylinder; the middle of its extent along `along` stays where it is.
struct Bend {
  double radius = 0.0;       ///< m, of the mid-surface
  std::optional<int> along;  ///< 0, 1, 2 for x, y, z
};

struct ImportedPart;

/// A file that a part's shape comes from, and how it is read.
struct PartFile {
  std::filesystem::path path;
  std::string unit;                                  ///< of length; no default
  std::string mass_unit;                             ///< of matrices, and of materials in a mesh
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m: the point of the file where the part's axes begin
  mesh::SurfaceRepairOptions repair;                 ///< of a surface
  io::MatrixFiles matrices;                          ///< of shape matrices; `path` is empty then
};

/// A box with one corner at the origin, a prism, or what a file holds.
struct Part {
  std::string shape = "box";                                 ///< box, prism, surface, mesh, matrices
  double length = 0.0, height = 0.0, thickness = 0.0;        ///< m
  int length_axis = 1, height_axis = 2, thickness_axis = 0;  ///< 0, 1, 2 for x, y, z
  mesh::Prism prism;                                         ///< of shape prism: outline in x, y; height along z
  std::optional<Bend> bend;
  PartFile file;                                 ///< of shapes surface, mesh, matrices
  std::shared_ptr<const ImportedPart> imported;  ///< what the file holds, once it is read (setup/imported_part.hpp)
  Material material;
  std::vector<MaterialRegion> materials;  ///< others; later ones win
  MeshOptions mesh;
  std::vector<Support> supports;  ///< none: a free part, unless clamps or springs hold it
  std::vector<Clamp> clamps;
  std::vector<PointMass> masses;
  std::vector<PointSpring> springs;
};

/// One measured FRF in a file, converted by io/ to receptance.
struct MeasuredFrf {
  std::string response;  ///< DOF name, "P.x"
  std::string force;
  std::filesystem::path file;     ///< absolute, or relative to the working directory
  std::string quantity;           ///< receptance, mobility, accelerance; empty: the file says it
  std::string unit;               ///< of the FRF, "um/N"; empty: the file says it
  std::string frequency_unit;     ///< "Hz", "rad/s"
  std::optional<int> record;      ///< number of the FRF in the file, from 1; none: its only one
  std::optional<double> noise{};  ///< standard deviation of real and imaginary part alike, relative to |H|
  std::optional<int> averages{};  ///< that the file's coherence belongs to, in place of `noise`
};

/// An accelerometer that sat on a component while its FRFs were measured.
struct Sensor {
  std::string point;
  double mass = 0.0;  ///< kg
};

/// A named point of the part: a fraction of the box along x, y, z or a position, then an offset.
struct Point {
  std::string name;
  std::optional<Eigen::Vector3d> at;
  std::optional<Eigen::Vector3d> position;           ///< m
  std::optional<int> node;                           ///< number of a node
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< m
  double patch_radius = 0.0;                         ///< m; 0: the nearest node alone
  bool rigid = false;                                ///< the patch moves as one body
  std::vector<Eigen::Vector3d> directions;           ///< unit vectors
};

/// Modes wanted, by count or by frequency.
struct ModeRange {
  std::optional<int> count;
  std::optional<double> up_to_hz;
};

struct Modes {
  ModeRange range;
  bool verify_count = false;
};

struct Reduction {
  std::string method = "craig_bampton";
  ModeRange fixed_interface;
  std::optional<double> tolerance;     ///< on the interface's receptance, in place of a range
  std::vector<std::string> interface;  ///< names of points
  int check_frequencies = 5;
};

struct Damping {
  std::string model = "modal";  ///< modal, rayleigh, structural, matrices
  double ratio = 0.0;           ///< of every mode that `ratios` does not name
  std::vector<double> ratios;   ///< of the first modes
  std::optional<MeasuredFrf> from_frf;
  double alpha = 0.0;  ///< 1/s
  double beta = 0.0;   ///< s
  double loss_factor = 0.0;
};

/// A mode of a tip along a direction.
struct TipMode {
  double frequency_hz = 0.0, damping_ratio = 0.0, stiffness = 0.0;
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
};

/// How an arm is to stand: by its joints, or by the place of its tip (in the part's axes) with a pitch or an approach.
struct PostureWish {
  std::vector<double> joints;               ///< rad; empty: by the place
  std::optional<Eigen::Vector3d> tip;       ///< m; none: the place of the first contact
  std::optional<double> pitch;              ///< rad
  bool elbow_up = true, ahead = true;       ///< of the postures for a pitch
  std::optional<Eigen::Vector3d> approach;  ///< unit vector
  double angle = 0.0;                       ///< rad, about it
  std::vector<double> start;                ///< rad; empty: zeros
};

/// What is known of the robot's tip. `one_mode`: stiffness with frequency and damping ratio, or mass with stiffness and
/// damping (or damping ratio); what was not given is empty.
struct Robot {
  std::string model = "one_mode";  ///< one_mode, modes, measured, modal_table, flexible_joints,
                                   ///< virtual_joints
  std::string point = "R";
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();
  std::optional<double> frequency_hz, damping_ratio, mass, stiffness, damping;
  std::vector<TipMode> modes;
  std::vector<MeasuredFrf> measured;
  robot::SerialArm arm;              ///< world: the part's axes
  std::vector<robot::Chain> chains;  ///< of virtual_joints, world: the part's axes
  std::filesystem::path table;       ///< of modal_table
  std::string table_point, left_unit, right_unit;
  bool cross_terms = true;
  std::filesystem::path urdf, joints;  ///< that the arm was read from; empty: from the case
  PostureWish posture;
  Eigen::Vector3d preload = Eigen::Vector3d::Zero();  ///< N, on the tip
  std::vector<Eigen::Vector3d> workspace;             ///< places of the tip, m
  std::vector<Sensor> sensors = {};                   ///< during all of `measured`
};

/// The ball by which a robot touches; the supports are a caster's.
struct ContactBall {
  double radius = 0.0;        ///< m
  coupling::Elastic steel{};  ///< of all balls and of the cup
  std::optional<int> supports;
  std::optional<double> support_radius, support_angle;  ///< m, rad
};

struct Contact {
  std::string part_point, robot_point;
  std::vector<Eigen::Vector3d> directions;  ///< the first is the contact's normal
  std::vector<double> stiffness;            ///< N/m, one per direction; infinite allowed
  std::vector<double> damping;              ///< N s/m, one per direction
  double loss_factor = 0.0;
  std::string model = "springs";    ///< springs, table, hertz, caster
  std::optional<double> preload{};  ///< N; none: from robot.preload
  std::filesystem::path table{};    ///< of model table
  std::optional<ContactBall> ball{};
  std::optional<coupling::Elastic> surface{};           ///< that the ball touches; none: part.material
  std::vector<MeasuredFrf> measured{};                  ///< of the assembly, from which the joint is found
  std::string damping_model = "viscous";                ///< that is sought: viscous, structural, both
  std::vector<double> noise{};                          ///< relative: of the assembly, of the part, of the robot
  std::optional<coupling::JointMatrices> identified{};  ///< what was found; the file knows it not, the run sets it
};

/// How the receptance route solves its kernel.
struct CouplingChoice {
  std::string regularisation = "none";  ///< none, truncated, tikhonov
  double threshold = 1e-10;             ///< of the largest singular value
};

struct ResponseOptions {
  double from_hz = 1.0, to_hz = 2000.0;
  int lines = 2000;
  bool logarithmic = false;
  std::vector<std::string> points;
};

struct UpdatingParameter {
  std::string key;  ///< full dotted key for get_value and set_value
  double lower = 0.0, upper = 0.0;
};

struct UpdatingTarget {
  std::string quantity;                 ///< part_frequency, coupled_frequency, reduction_at
  double value = 0.0;                   ///< Hz, or 1 for a reduction
  std::string point;                    ///< DOF "P.x" at which the mode takes part or the reduction is read
  std::string match = "participation";  ///< participation, mac, number
  int rank = 1;                         ///< the rank-th such mode by rising frequency
  double frequency_hz = 0.0;            ///< of reduction_at; 0: the matched mode of the part
  double weight = 1.0;
};

struct Updating {
  std::string name;
  std::string on = "part";  ///< part, coupled
  std::vector<UpdatingParameter> parameters;
  std::vector<UpdatingTarget> targets;
};

/// A cylinder of a tool, in order from the tip to the root.
struct ToolStep {
  double length = 0.0;                                ///< m
  double outer_diameter = 0.0, inner_diameter = 0.0;  ///< m
  double youngs_modulus = 0.0, poisson_ratio = 0.0, density = 0.0;
};

/// The tip of a tool from FRFs that were measured with another in its place.
struct ToolSwap {
  std::vector<MeasuredFrf> measured;  ///< between two directions of two points
  std::string tip, up;                ///< names of the points
  double distance = 0.0;              ///< m, of `up` from the tip
  std::string rotations = "none";     ///< none, second_difference, corrected, rank_one
  std::vector<ToolStep> reference, target;
};

struct Tool {
  int teeth = 0;
  double diameter = 0.0;                           ///< m
  double length = 0.0;                             ///< m
  std::vector<double> pitches;                     ///< rad; empty: equal
  std::vector<double> helices;                     ///< rad, one a tooth; empty: none
  std::vector<double> runout;                      ///< m, one a tooth; empty: none
  std::string end = "flat";                        ///< flat, ball, bull_nose, general
  double corner_radius = 0.0;                      ///< m; of bull_nose and general, the next four of general alone
  double corner_radial = 0.0, corner_axial = 0.0;  ///< m
  double tip_angle = 0.0, taper = 0.0;             ///< rad
  std::vector<TipMode> modes;
  std::vector<MeasuredFrf> measured;  ///< DOFs "tool.x", "tool.y", "tool.z"
  std::optional<ToolSwap> swap;
};

/// What turning tells of a material: coefficients follow by the tool's helix.
struct OrthogonalData {
  std::optional<double> shear_stress;                             ///< Pa
  std::optional<double> shear_angle, friction_angle, rake_angle;  ///< rad
};

struct Cutting {
  std::optional<double> radial_depth;             ///< m; none: the angles are given
  std::vector<double> entry_angles, exit_angles;  ///< rad, one an arc
  bool down_milling = true;
  double lead_angle = 0.0;  ///< rad
  Eigen::Vector3d feed_direction = Eigen::Vector3d::UnitY();
  Eigen::Vector3d tool_axis = Eigen::Vector3d::UnitZ();
  std::string at;                                                ///< name of the point that is cut
  double Kt = 0.0, Kr = 0.0, Ka = 0.0;                           ///< N/m²
  double Kte = 0.0, Kre = 0.0, Kae = 0.0;                        ///< N/m
  std::string law = "linear";                                    ///< linear, power, fractional, oblique
  std::vector<double> exponents;                                 ///< of power: for Kt, Kr, Ka
  std::optional<double> chip_scale, stiffness_ratio;             ///< of fractional: m, 1
  OrthogonalData orthogonal;                                     ///< of oblique
  double process_damping = 0.0, process_damping_friction = 0.3;  ///< N/m, 1
  std::optional<double> spindle_speed_rpm;
  std::optional<double> feed_rate;       ///< m/s
  std::optional<double> feed_per_tooth;  ///< m
};

/// What a robust chart allows for.
struct RobustOptions {
  milling::Uncertainty uncertainty;
  double confidence = 2.0;  ///< k, standard uncertainties
};

struct LobesOptions {
  double from_rpm = 0.0, to_rpm = 0.0;
  int count = 400;
  double depth_limit = 0.0;  ///< m
  double tolerance = 1e-4;   ///< bound on the estimated relative error of the limiting depth
  std::optional<double> modes_up_to_hz;
  std::string method = "direct";                   ///< a name of milling::Method
  std::vector<std::string> compare = {};           ///< others
  std::optional<int> steps_per_period, harmonics;  ///< none: milling::MethodOptions' own
  std::optional<int> map_depths;                   ///< none: no map
  std::optional<RobustOptions> robust;
  std::optional<int> noise_samples;  ///< draws of what is measured, at the case's own speed; none: first order only
  int seed = 1;                      ///< of these
};

/// Where the cut goes along the part, and what the robot does meanwhile.
struct Path {
  std::vector<Eigen::Vector3d> positions;  ///< m, of the point that is cut, in order
  bool robot_follows = false;              ///< its contacts keep their distance to the cut; else they stay
};

struct Case {
  std::string name;  ///< name of the case's folder
  std::string title;
  std::filesystem::path file;
  std::filesystem::path folder;  ///< where relative names of data files start
  std::string source;            ///< text of the file, as read
  std::optional<Part> part;
  std::vector<MeasuredFrf> measured_part;
  std::vector<Sensor> part_sensors;  ///< during all of `measured_part`
  std::vector<Selection> selections;
  std::vector<Point> points;
  Modes modes;
  Reduction reduction;
  Damping damping;
  std::optional<Robot> robot;
  std::vector<Contact> contacts;
  CouplingChoice coupling;
  ResponseOptions response;
  std::vector<Updating> updating;
  std::optional<Tool> tool;
  std::optional<Cutting> cutting;
  std::optional<LobesOptions> lobes;
  std::optional<milling::MachineLimits> machine;
  std::optional<Path> path;
  CaseValues values;  ///< what all of the above was bound from, defaults included
};

/// The block around the part, before it is bent, m.
[[nodiscard]] Eigen::AlignedBox3d bounds(const Part& part);

/// part.mesh.tolerance where the case does not give it: 0.01 of a surface from a file, 0.001 of other parts.
[[nodiscard]] double usual_tolerance(const Part& part);

/// Whether a name of part.supports is a set of nodes of the mesh file: no face of the box around the part (x_min …),
/// no selection.
[[nodiscard]] bool names_node_set(const Case& source, const std::string& name);

/// Whether something holds the part, as far as the case tells: matrices may be those of a held part.
[[nodiscard]] bool may_be_held(const Part& part);

/// Its extents along x, y, z, m.
[[nodiscard]] Eigen::Vector3d box_size(const Part& part);

/// Position of a point in the part's axes, m: fractions of the box (or the given position) plus the offset.
[[nodiscard]] Eigen::Vector3d position(const Part& part, const Point& point);

/// The point of that name; throws InputError with the nearest name if there is none.
[[nodiscard]] const Point& point(const Case& source, const std::string& name);

/// True if `p` (m) satisfies the predicate within `tolerance` (m).
[[nodiscard]] bool contains(const Selection& selection, const Eigen::Vector3d& p, double tolerance);

/// Data files that the case names, besides the case file itself.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Case& source);

/// The same without those that only the given sections name ("robot", "tool").
[[nodiscard]] std::vector<std::filesystem::path> input_files(const Case& source,
                                                             const std::vector<std::string>& without_sections);

/// Value of a numeric key by its dotted name, "part.length", "damping.ratios[0]", "robot.stiffness", in the unit of the
/// schema (SI; Hz; rpm). Tables in the middle may be left out where that is unambiguous ("part.element_size"). Throws
/// InputError with the nearest key if the case has no such number.
[[nodiscard]] double get_value(const Case& source, const std::string& key);

/// Sets it and binds the case anew, so that everything that follows from the key follows. Throws InputError if the
/// value is not finite or outside the schema's bounds. Cost: microseconds; for model updating and sweeps.
void set_value(Case& target, const std::string& key, double value);

}  // namespace thinwall::app
