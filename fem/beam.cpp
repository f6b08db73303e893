#include "fem/beam.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/faults.hpp"

namespace thinwall::fem {

namespace {

using Eigen::Index;
using Triplets = std::vector<Eigen::Triplet<double>>;
using Sparse = Eigen::SparseMatrix<double>;

std::string place(const std::vector<BeamNode>& nodes, std::size_t node) {
  const std::string& name = nodes[node].name;
  return "node " + std::to_string(node + 1) + (name.empty() ? "" : " (" + name + ")");
}

bool exists(const BeamFrame& frame, std::size_t node, const std::string& where, core::Faults& faults) {
  faults.require(node < frame.nodes.size(), where,
                 "is at node " + std::to_string(node + 1) + " of " + std::to_string(frame.nodes.size()));
  return node < frame.nodes.size();
}

bool is_round(const dynamics::BeamSection& s) {
  return std::abs(s.I_y_m4 - s.I_z_m4) <= 1e-12 * s.I_y_m4 && s.shear_y == s.shear_z;
}

/// The axes of a segment as columns: x along the segment, y as near as possible to the wished direction.
Eigen::Matrix3d axes_of(const Eigen::Vector3d& along, const Eigen::Vector3d& wished) {
  Eigen::Matrix3d R;
  R.col(0) = along.normalized();
  const Eigen::Vector3d any = R.col(0).unitOrthogonal();
  const Eigen::Vector3d y = wished.isZero(0.0) ? any : Eigen::Vector3d(wished - wished.dot(R.col(0)) * R.col(0));
  R.col(1) = y.normalized();
  R.col(2) = R.col(0).cross(R.col(1));
  return R;
}

void check_segment(const BeamFrame& frame, std::size_t i, core::Faults& faults) {
  const BeamSegment& segment = frame.segments[i];
  const std::string where = "segment " + std::to_string(i + 1);
  dynamics::check(segment.section, where, faults);
  faults.require(segment.elements >= 1, where, "has no element: give it one at least");
  const bool both = exists(frame, segment.from, where, faults) && exists(frame, segment.to, where, faults);
  if (!both) return;
  const Eigen::Vector3d along = frame.nodes[segment.to].position_m - frame.nodes[segment.from].position_m;
  faults.require_number(along.norm(), along.norm() > 0.0, where, "length (m)", "be positive");
  const bool given = segment.y.allFinite() && along.normalized().cross(segment.y).norm() > 1e-6 * segment.y.norm();
  faults.require(given || (segment.y.isZero(0.0) && is_round(segment.section)), where,
                 "needs the direction of its section's y axis, across the beam: the section is not round, or the "
                 "direction given lies along the beam");
}

void check_matrix(const dynamics::Matrix6& A, const std::string& where, const char* what, core::Faults& faults) {
  const double scale = A.cwiseAbs().maxCoeff();
  faults.require(
      A.allFinite() && (A - A.transpose()).cwiseAbs().maxCoeff() <= 1e-9 * scale && (A.diagonal().array() >= 0.0).all(),
      where, std::string("has a ") + what + " that is not finite, symmetric and of no negative diagonal");
}

void check_bodies_and_springs(const BeamFrame& frame, core::Faults& faults) {
  for (std::size_t i = 0; i < frame.bodies.size(); ++i) {
    const std::string where = "body " + std::to_string(i + 1);
    dynamics::check(frame.bodies[i].body, where, faults);
    (void)exists(frame, frame.bodies[i].node, where, faults);
  }
  for (std::size_t i = 0; i < frame.springs.size(); ++i) {
    const NodeSpring& spring = frame.springs[i];
    const std::string where = "spring " + std::to_string(i + 1);
    (void)exists(frame, spring.node, where, faults);
    if (spring.other) (void)exists(frame, *spring.other, where, faults);
    check_matrix(spring.stiffness, where, "stiffness", faults);
    check_matrix(spring.damping, where, "damping", faults);
  }
}

/// Checks that the second node of a hinge is carried by that hinge alone, and that its first node, if carried by a
/// hinge, is carried by an earlier one: motions() resolves hinges in their order.
void check_hinges(const BeamFrame& frame, core::Faults& faults) {
  std::vector<bool> hung(frame.nodes.size(), false);
  for (std::size_t i = 0; i < frame.hinges.size(); ++i) {
    const Hinge& hinge = frame.hinges[i];
    const std::string where = "hinge " + std::to_string(i + 1);
    faults.require(std::abs(hinge.axis.norm() - 1.0) <= 1e-9, where, "has an axis that is not a unit vector");
    faults.require_number(hinge.stiffness, hinge.stiffness >= 0.0, where, "stiffness (N m/rad)", "not be negative");
    faults.require_number(hinge.damping, hinge.damping >= 0.0, where, "damping (N m s/rad)", "not be negative");
    const bool both = exists(frame, hinge.from, where, faults) && exists(frame, hinge.to, where, faults);
    if (!both) continue;
    const BeamNode& to = frame.nodes[hinge.to];
    const double apart = (to.position_m - frame.nodes[hinge.from].position_m).norm();
    faults.require_number(apart, apart <= 1e-9, where, "distance between its nodes (m)", "be zero");
    const bool from_later = std::any_of(frame.hinges.begin() + static_cast<std::ptrdiff_t>(i), frame.hinges.end(),
                                        [&](const Hinge& later) { return later.to == hinge.from; });
    faults.require(!hung[hinge.to] && !to.clamped && !from_later, where,
                   "carries " + place(frame.nodes, hinge.to) +
                       ", which is clamped or carried already, or is listed before the hinge that carries its first "
                       "node");
    hung[hinge.to] = true;
  }
}

void check_nodes(const BeamFrame& frame, core::Faults& faults) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const std::string where = place(frame.nodes, i);
    faults.require(frame.nodes[i].position_m.allFinite(), where, "has a position that is not a number");
    const auto is_end = [i](const BeamSegment& segment) { return segment.from == i || segment.to == i; };
    const auto is_here = [i](const NodeBody& body) { return body.node == i; };
    const auto carries = [i](const Hinge& hinge) { return hinge.from == i; };
    faults.require(frame.nodes[i].clamped || std::any_of(frame.segments.begin(), frame.segments.end(), is_end) ||
                       std::any_of(frame.bodies.begin(), frame.bodies.end(), is_here) ||
                       std::any_of(frame.hinges.begin(), frame.hinges.end(), carries),
                   where, "carries no mass: let a segment end there, or give it a body");
    if (!frame.nodes[i].name.empty()) names.push_back(frame.nodes[i].name);
  }
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  faults.require(!names.empty(), "the frame", "names no node: name those whose motions are wanted");
  faults.require(twice == names.end(), "the name \"" + (twice == names.end() ? "" : *twice) + "\"",
                 "stands at two nodes");
}

void require_valid(const BeamFrame& frame) {
  core::Faults faults;
  faults.require_number(frame.loss_factor, frame.loss_factor >= 0.0, "the frame", "loss factor", "not be negative");
  check_nodes(frame, faults);
  for (std::size_t i = 0; i < frame.segments.size(); ++i) check_segment(frame, i, faults);
  check_bodies_and_springs(frame, faults);
  check_hinges(frame, faults);
  faults.raise("frame of beams");
}

/// The frame with every segment replaced by its elements, and the nodes between them added.
BeamFrame cut(BeamFrame frame) {
  std::vector<BeamSegment> elements;
  for (const BeamSegment& segment : frame.segments) {
    const Eigen::Vector3d a = frame.nodes[segment.from].position_m;
    const Eigen::Vector3d b = frame.nodes[segment.to].position_m;
    BeamSegment element = segment;
    element.elements = 1;
    for (int i = 1; i <= segment.elements; ++i) {
      element.to = i == segment.elements ? segment.to : frame.nodes.size();
      if (i < segment.elements) frame.nodes.push_back({a + (b - a) * i / segment.elements});
      elements.push_back(element);
      element.from = element.to;
    }
  }
  frame.segments = std::move(elements);
  return frame;
}

/// Adds A to the rows and columns of the motions of `nodes`, six for each node.
void add(Triplets& entries, const std::vector<std::size_t>& nodes, const Eigen::MatrixXd& A) {
  for (Index i = 0; i < A.rows(); ++i) {
    for (Index j = 0; j < A.cols(); ++j) {
      const auto row = 6 * nodes[static_cast<std::size_t>(i / 6)] + static_cast<std::size_t>(i % 6);
      const auto column = 6 * nodes[static_cast<std::size_t>(j / 6)] + static_cast<std::size_t>(j % 6);
      entries.emplace_back(static_cast<int>(row), static_cast<int>(column), A(i, j));
    }
  }
}

/// Entries of the matrices of a frame over the motions of its nodes.
struct FrameTriplets {
  Triplets M, C, K;
};

/// Adds springs and dampers. One between two nodes acts on the difference d = [1, −X] [q_node; q_other] of the motions
/// at the first node, so that its matrix is [1, −X]ᵀ K [1, −X].
void add_springs(const BeamFrame& frame, FrameTriplets& into) {
  for (const NodeSpring& spring : frame.springs) {
    if (!spring.other) {
      add(into.K, {spring.node}, spring.stiffness);
      add(into.C, {spring.node}, spring.damping);
      continue;
    }
    Eigen::Matrix<double, 6, 12> apart;
    apart << dynamics::Matrix6::Identity(),
        -dynamics::transport(frame.nodes[spring.node].position_m - frame.nodes[*spring.other].position_m);
    add(into.K, {spring.node, *spring.other}, apart.transpose() * spring.stiffness * apart);
    add(into.C, {spring.node, *spring.other}, apart.transpose() * spring.damping * apart);
  }
}

/// The entries of M, C, K over the motions of all nodes, before hinges and clamps are eliminated.
FrameTriplets assembled(const BeamFrame& frame) {
  FrameTriplets into;
  for (const BeamSegment& element : frame.segments) {
    const Eigen::Vector3d along = frame.nodes[element.to].position_m - frame.nodes[element.from].position_m;
    const dynamics::Matrix6 turned = dynamics::turned(axes_of(along, element.y).transpose());
    dynamics::Matrix12 R = dynamics::Matrix12::Zero();
    R.topLeftCorner<6, 6>() = R.bottomRightCorner<6, 6>() = turned;
    add(into.M, {element.from, element.to}, R.transpose() * dynamics::beam_mass(element.section, along.norm()) * R);
    add(into.K, {element.from, element.to},
        R.transpose() * dynamics::beam_stiffness(element.section, along.norm()) * R);
  }
  for (const NodeBody& body : frame.bodies) add(into.M, {body.node}, dynamics::mass_matrix(body.body));
  add_springs(frame, into);
  return into;
}

/// The matrix L that gives the motions of all nodes from the coordinates y: six for each node that is neither clamped
/// nor carried by a hinge, followed by one angle for each hinge.
Sparse motions(const BeamFrame& frame) {
  std::vector<bool> follows(frame.nodes.size(), false);
  for (const Hinge& hinge : frame.hinges) follows[hinge.to] = true;
  std::vector<std::vector<Eigen::Triplet<double>>> rows(frame.nodes.size());  // entries of each node's rows 0…5
  int n = 0;
  for (std::size_t node = 0; node < frame.nodes.size(); ++node) {
    if (frame.nodes[node].clamped || follows[node]) continue;
    for (int i = 0; i < 6; ++i) rows[node].emplace_back(i, n++, 1.0);
  }
  // The carried node of a hinge has the motion of its carrier and, as its own coordinate, the angle about the axis.
  for (const Hinge& hinge : frame.hinges) {
    rows[hinge.to] = rows[hinge.from];
    for (int i = 0; i < 3; ++i) rows[hinge.to].emplace_back(3 + i, n, hinge.axis(i));
    ++n;
  }
  Triplets entries;
  for (std::size_t node = 0; node < rows.size(); ++node) {
    for (const auto& entry : rows[node])
      entries.emplace_back(static_cast<int>(6 * node) + entry.row(), entry.col(), entry.value());
  }
  Sparse L(static_cast<Index>(6 * frame.nodes.size()), n);
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

/// The matrix Lᵀ A L, made exactly symmetric.
Eigen::MatrixXd over_coordinates(const Triplets& entries, const Sparse& L) {
  Sparse A(L.rows(), L.rows());
  A.setFromTriplets(entries.begin(), entries.end());
  const Eigen::MatrixXd reduced = L.transpose() * A * L;
  return 0.5 * (reduced + reduced.transpose());
}

}  // namespace

dynamics::SpatialModel spatial_model(const BeamFrame& given) {
  require_valid(given);
  const BeamFrame frame = cut(given);
  const Sparse L = motions(frame);
  if (L.cols() == 0) throw core::InputError("frame of beams: all its nodes are clamped; nothing is left to move");
  const FrameTriplets matrices = assembled(frame);
  dynamics::SpatialModel model{
      over_coordinates(matrices.M, L), over_coordinates(matrices.C, L), over_coordinates(matrices.K, L), {}, {}, {}};
  Index column = L.cols() - static_cast<Index>(frame.hinges.size());
  for (const Hinge& hinge : frame.hinges) {
    model.K(column, column) += hinge.stiffness;
    model.C(column, column) += hinge.damping;
    ++column;
  }
  if (frame.loss_factor > 0.0) model.D = frame.loss_factor * model.K;
  std::vector<Index> rows;
  for (std::size_t node = 0; node < given.nodes.size(); ++node) {
    if (given.nodes[node].name.empty()) continue;
    for (Index i = 0; i < 6; ++i) rows.push_back(static_cast<Index>(6 * node) + i);
    const dynamics::DofTable six = dynamics::six_dofs(given.nodes[node].name);
    model.dofs.insert(model.dofs.end(), six.begin(), six.end());
  }
  model.T = Eigen::MatrixXd(L)(rows, Eigen::all);
  return model;
}

dynamics::SpatialModel tool_beam(const std::vector<CylinderStep>& steps, const std::vector<std::string>& names,
                                 const Eigen::Vector3d& axis, double loss_factor) {
  core::Faults faults;
  faults.require(!steps.empty(), "it", "has no step");
  faults.require(names.size() == steps.size() + 1, "it",
                 "has " + std::to_string(names.size()) + " names for " + std::to_string(steps.size() + 1) +
                     " ends of steps; write \"\" for an end that needs none");
  faults.require(std::abs(axis.norm() - 1.0) <= 1e-9, "its axis", "is not a unit vector");
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string where = "step " + std::to_string(i + 1);
    faults.require_number(steps[i].length_m, steps[i].length_m > 0.0, where, "length (m)", "be positive");
    dynamics::check(steps[i].tube, where, faults);
  }
  faults.raise("stepped cylinder");
  BeamFrame frame{.nodes = {{.name = names[0]}}, .segments = {}, .loss_factor = loss_factor};
  double reached = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    reached += steps[i].length_m;
    frame.nodes.push_back({.position_m = reached * axis, .name = names[i + 1]});
    frame.segments.push_back({i, i + 1, dynamics::section(steps[i].tube), steps[i].elements});
  }
  return spatial_model(frame);
}

}  // namespace thinwall::fem
