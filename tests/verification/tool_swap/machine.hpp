#pragma once
// A machine of beams: a spindle on springs and dampers that couple x and y, a holder, and tools to put into it.

#include <algorithm>
#include <string>
#include <vector>

#include "coupling/spatial.hpp"
#include "coupling/tool_swap.hpp"
#include "dynamics/conversion.hpp"
#include "fem/beam.hpp"

namespace thinwall::coupling::testing {

using dynamics::ResponseModel;
using dynamics::SpatialModel;
using Eigen::Vector3d;

inline dynamics::Tube steel(double outer, double inner = 0.0) {
  return {outer, inner, 210e9, 0.3, 7850.0};
}
inline dynamics::Tube carbide(double outer) {
  return {outer, 0.0, 580e9, 0.22, 14400.0};
}

/// The spindle on two bearings, its nose at z = 0.06.
inline fem::BeamFrame spindle_frame() {
  fem::BeamFrame frame;
  frame.nodes = {{0.06 * Vector3d::UnitZ(), "nose"}, {0.10 * Vector3d::UnitZ()}, {0.30 * Vector3d::UnitZ()}};
  frame.segments = {{0, 1, dynamics::section(steel(0.060)), 3}, {1, 2, dynamics::section(steel(0.055, 0.020)), 5}};
  dynamics::Matrix6 K = dynamics::Matrix6::Zero(), C = dynamics::Matrix6::Zero();
  K.diagonal() << 9e7, 6e7, 2e8, 1e5, 1e5, 1e5;
  K(0, 1) = K(1, 0) = 2.5e7;  // not axisymmetric: x and y act on each other
  C.diagonal() << 900.0, 1400.0, 500.0, 5.0, 5.0, 5.0;
  C(0, 1) = C(1, 0) = -300.0;
  frame.springs = {{1, std::nullopt, K, C}, {2, std::nullopt, 0.7 * K, 0.8 * C}};
  frame.loss_factor = 0.004;
  return frame;
}

/// The machine from "holder", where a tool is held, at z = 0 upwards: holder, then spindle, in one frame.
inline SpatialModel spindle_and_holder() {
  fem::BeamFrame frame = spindle_frame();
  frame.nodes.push_back({Vector3d::Zero(), "holder"});
  frame.segments.push_back({3, 0, dynamics::section(steel(0.034, 0.012)), 4});
  return fem::spatial_model(frame);
}

/// The holder alone, from "holder" to "taper".
inline SpatialModel holder() {
  return fem::tool_beam({{0.06, steel(0.034, 0.012), 4}}, {"holder", "taper"}, Vector3d::UnitZ(), 0.004);
}

/// A tool along z from its tip; named "<prefix>tip", "<prefix>up" at S from it, "<prefix>root".
inline SpatialModel tool(const std::string& prefix, const dynamics::Tube& tube, double overhang, double S) {
  return fem::tool_beam({{S, tube, 4}, {overhang - S, tube, 6}}, {prefix + "tip", prefix + "up", prefix + "root"},
                        Vector3d::UnitZ(), 0.002);
}

/// A joint whose displacement and rotation act on each other, with damping: complex and full in each plane.
inline Contact shrink_fit(const std::string& root, double k, double damping) {
  Contact contact = radial_contact(root, "holder");
  Eigen::Matrix4d K = Eigen::Matrix4d::Zero();  // x, y, rx, ry
  K.diagonal() << k, 1.1 * k, 6e-4 * k, 7e-4 * k;
  K(0, 3) = K(3, 0) = 0.010 * k;
  K(1, 2) = K(2, 1) = -0.012 * k;
  contact.matrices = {K, damping * K, {}};
  return contact;
}

/// The tool in the machine by assembled matrices, without any receptance of a part.
inline ResponseModel assembled(const SpatialModel& tool, const Contact& joint, const dynamics::FrequencyAxis& axis) {
  return dynamics::direct_response(couple({tool, spindle_and_holder()}, {joint}), axis);
}

/// Rows and columns of some DOFs only, by name.
inline ResponseModel only(const ResponseModel& model, const std::vector<std::string>& dofs) {
  std::vector<int> rows;
  dynamics::DofTable table;
  for (const std::string& name : dofs) {
    rows.push_back(dynamics::row_of(model.responses, name));
    table.push_back(model.responses[static_cast<std::size_t>(rows.back())]);
  }
  ResponseModel part{model.axis, table, table, {}};
  for (const Eigen::MatrixXcd& H : model.H) part.H.emplace_back(H(rows, rows));
  return part;
}

/// max over lines and entries of |a_ij − b_ij| / √|b_ii b_jj|: displacements and rotations each beside their own size.
inline double difference(const ResponseModel& a, const ResponseModel& b) {
  double largest = 0.0;
  for (std::size_t line = 0; line < b.H.size(); ++line) {
    const Eigen::VectorXd size = b.H[line].diagonal().cwiseAbs().cwiseSqrt();
    const Eigen::ArrayXXd scale = size * size.transpose();
    largest = std::max(largest, ((a.H[line] - b.H[line]).array().abs() / scale).maxCoeff());
  }
  return largest;
}

}  // namespace thinwall::coupling::testing
