#pragma once
// Prismatic parts, held somewhere and solved: what the tests of structures share.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "mesh/planar/prism_mesh.hpp"

namespace thinwall {

inline const fem::Material steel_part{210e9, 0.3, 7850.0};

/// 0 ≤ x ≤ length, 0 ≤ y ≤ width, 0 ≤ z ≤ thickness, m.
inline mesh::Prism plate_prism(double length, double width, double thickness) {
  return {{{0, 0}, {length, 0}, {length, width}, {0, width}}, {}, 0.0, thickness, {}};
}

inline mesh::TetMesh graded_mesh(const mesh::Prism& prism, double size_m, int layers) {
  mesh::PrismMeshOptions options;
  options.size_m = size_m;
  options.layers = layers;
  return mesh::mesh_prism(prism, options);
}

/// Zero displacement in `axes` on the plane where coordinate `axis` has the given value.
inline fem::Support held_plane(int axis, double at, std::vector<int> axes = {0, 1, 2}) {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  point[axis] = at;
  return {std::string(1, "xyz"[axis]) + " = " + std::to_string(at),
          mesh::PlaneRegion{point, Eigen::Vector3d::Unit(axis)}, std::move(axes)};
}

struct Solved {
  fem::Model model;
  fem::Modes modes;
};

inline Solved solved(fem::Model model, int count) {
  const fem::Factored factored = fem::factorise(model);
  fem::Modes modes = fem::modes(model, factored, {.count = count, .up_to_hz = {}});
  return {std::move(model), std::move(modes)};
}

inline Solved solved(const mesh::TetMesh& mesh, int order, const fem::Material& material,
                     const std::vector<fem::Support>& supports, int count, const fem::Shaping& shape = {}) {
  return solved(fem::supported_model(mesh, order, material, supports, shape), count);
}

/// Elastic frequencies, Hz.
inline Eigen::VectorXd elastic(const fem::Modes& modes) {
  return modes.frequency_hz.tail(modes.frequency_hz.size() - modes.rigid_motions);
}

/// Largest |f / reference − 1| over the reference's modes.
inline double worst_error(const Eigen::VectorXd& f, const Eigen::VectorXd& reference) {
  return (f.head(reference.size()).cwiseQuotient(reference).array() - 1.0).abs().maxCoeff();
}

inline Eigen::VectorXd as_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

}  // namespace thinwall
