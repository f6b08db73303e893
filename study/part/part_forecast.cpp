#include "study/part/part_forecast.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "core/dense_factorisations.hpp"
#include "core/error.hpp"
#include "fem/closed_part.hpp"
#include "fem/size/solution_bytes.hpp"
#include "mesh/lagrange_nodes.hpp"
#include "mesh/selection.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_attachments.hpp"
#include "setup/part_geometry.hpp"
#include "study/part/discretisation.hpp"

namespace thinwall::study {

namespace {

double dofs(const mesh::TetMesh& mesh, int order) {
  return 3.0 * static_cast<double>(mesh::lagrange_node_count(mesh, order));
}

/// The share of the vertices that lie within the part: 0 of a wall of one layer, most of a bulky mesh.
double inner_share(const mesh::TetMesh& mesh) {
  std::vector<bool> outside(mesh.vertices.size(), false);
  for (const mesh::BoundaryTriangle& triangle : mesh::boundary(mesh))
    for (const int vertex : triangle.vertices) outside[static_cast<std::size_t>(vertex)] = true;
  return static_cast<double>(std::ranges::count(outside, false)) / static_cast<double>(outside.size());
}

/// The time of one solution of an order on two cores, s: of matrices of so many nodes an element, and of the factor,
/// which grows with the power 4/3 of a wall's degrees of freedom and the square of a body's.
double solve_s(const mesh::TetMesh& mesh, int order) {
  const double nodes = (order + 1.0) * (order + 2.0) * (order + 3.0) / 6.0;
  const double elements_s = 3e-7 * static_cast<double>(mesh.tets.size()) * nodes * nodes;
  return elements_s + 0.8 * std::pow(dofs(mesh, order) / 4e4, 1.3 + 0.6 * inner_share(mesh));
}

/// The shares of the third and the fourth order that parts took at a tolerance, and of a finer mesh as well of those
/// that are held by faces, at the edges of which frequencies converge slowly: by plates with holes and slots, panels,
/// profiles, brackets, trays, housings, blocks and bent sheets: of twelve that were held, two took a finer mesh at a
/// tolerance of 0.01. Of six with a point, whose receptances count, four took one at 0.02, where frequencies alone take
/// none.
struct Refinement {
  double third = 1.0, fourth = 1.0;
  double finer = 1.0;
};

Refinement usual_refinement(double tolerance, bool receptances) {
  if (tolerance >= 0.05) return {0.4, 0.0, 0.0};
  if (tolerance >= 0.02) return {0.3, 0.1, receptances ? 0.6 : 0.0};
  return tolerance >= 0.01 ? Refinement{1.0, 0.6, 0.2} : Refinement{};
}

/// The vertices of the faces that supports and clamps hold. Throws InputError for one that holds no face.
std::vector<Eigen::Vector3d> held_vertices(const PartInput& source, const mesh::TetMesh& mesh) {
  const auto boundary = mesh::boundary(mesh);
  std::set<int> held;
  const auto add = [&](const mesh::Region& region, const std::string& name) {
    for (const mesh::BoundaryTriangle& triangle : mesh::select(mesh, boundary, region, name))
      held.insert(triangle.vertices.begin(), triangle.vertices.end());
  };
  for (const fem::Support& support : setup::supports_of(source)) add(support.region, support.name);
  for (const fem::ElasticClamp& clamp : setup::attachments_of(source).clamps) add(clamp.region, clamp.name);
  std::vector<Eigen::Vector3d> at;
  at.reserve(held.size());
  for (const int vertex : held) at.push_back(mesh.vertices[static_cast<std::size_t>(vertex)]);
  return at;
}

/// The largest distance of a vertex, of some hundreds that lie evenly in the list, from what holds the part, m.
double reach_m(const std::vector<Eigen::Vector3d>& held, const mesh::TetMesh& mesh) {
  const std::size_t step = 1 + mesh.vertices.size() / 300;
  double reach = 0.0;
  for (std::size_t i = 0; i < mesh.vertices.size(); i += step) {
    double nearest = INFINITY;
    for (const Eigen::Vector3d& x : held) nearest = std::min(nearest, (mesh.vertices[i] - x).norm());
    reach = std::max(reach, nearest);
  }
  return reach;
}

/// The mean over the elements of their longest edge, m.
double mean_edge_m(const mesh::TetMesh& mesh) {
  double sum = 0.0;
  for (const auto& tet : mesh.tets) {
    const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(tet[i])]; };
    double longest = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) longest = std::max(longest, (at(i) - at(j)).norm());
    }
    sum += longest;
  }
  return sum / static_cast<double>(mesh.tets.size());
}

/// The mean thickness 2 V/A of a part with the volume V and the surface A, m.
double mean_thickness_m(const mesh::TetMesh& mesh) {
  double area = 0.0;
  for (const mesh::BoundaryTriangle& triangle : mesh::boundary(mesh)) {
    const auto at = [&](std::size_t i) { return mesh.vertices[static_cast<std::size_t>(triangle.vertices[i])]; };
    area += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  return 2.0 * mesh::volume(mesh) / area;
}

/// True of thin walls that swing beside a face that is held as a whole, as ribs of a panel on its base do: in waves as
/// short as the elements, which take all orders and a finer mesh.
bool swings_in_short_waves(const std::vector<Eigen::Vector3d>& held, const mesh::TetMesh& mesh) {
  constexpr double thin = 4.0;  // ribs of four panels have 5 to 9, plates, links and flanges on a face 2.3 to 3.3
  if (held.empty()) return false;
  const double reach = reach_m(held, mesh);
  return reach < mean_edge_m(mesh) && reach > thin * mean_thickness_m(mesh);
}

/// The time of the solutions that a tolerance usually takes, from the first order on: two of them in any case, the
/// others within the part's budget. `held`: held_vertices(). `has_rows`: with rows of narrow elements at its edges, of
/// six parts one took a third order to 0.01.
double refinement_s(const PartInput& source, const std::vector<Eigen::Vector3d>& held, const mesh::TetMesh& mesh,
                    bool has_rows, int first_order, int last_order) {
  constexpr Refinement of_short_waves{1.0, 1.0, 0.2}, of_rows{0.2, 0.0, 0.0};
  const setup::Part& part = *source.part;
  const bool short_waves = part.mesh.tolerance < 0.05 && swings_in_short_waves(held, mesh);
  const Refinement by_tolerance = usual_refinement(part.mesh.tolerance, !source.reduction.interface.empty());
  const bool rows_do = has_rows && part.mesh.tolerance >= 0.01;
  const Refinement usual = rows_do ? of_rows : short_waves ? of_short_waves : by_tolerance;
  double first = 0.0, further = 0.0;
  for (int order = first_order; order <= last_order; ++order) {
    const int beyond = order - first_order;
    const double share = beyond < 2 ? 1.0 : beyond == 2 ? usual.third : usual.fourth;
    (beyond < 2 ? first : further) += share * solve_s(mesh, order);
  }
  if (!held.empty()) further += usual.finer * (first + further) * std::pow(3.5, 1.3);
  const double budget = part.mesh.time_budget.value_or(INFINITY);
  return first + std::min(further, std::max(0.0, budget - first));
}

/// The memory that is held at most while orders up to the last one are solved on this mesh, bytes: a solution at its
/// worst, the one before it, and the program itself with its vectors. 0 for a mesh so large that the orders of its
/// rows, which this takes, would need more than seconds.
double most_bytes(const mesh::TetMesh& mesh, int last_order) {
  constexpr std::size_t most_elements = 50000;
  if (mesh.tets.size() > most_elements) return 0.0;
  constexpr double of_program = 1.5e8, vectors = 60.0;
  const double of_vectors = vectors * sizeof(double) * dofs(mesh, last_order);
  const double before = last_order > 1 ? fem::solution_bytes(mesh, last_order - 1) : 0.0;
  return of_program + of_vectors + fem::solution_bytes(mesh, last_order) + before;
}

/// The highest order of a refinement on this mesh that its bound on degrees of freedom admits.
int highest_order(const mesh::TetMesh& mesh, int first_order, int last_order) {
  const auto largest = static_cast<double>(fem::ClosedPartOptions{}.largest_dofs);
  int order = last_order;
  while (order > first_order + 1 && dofs(mesh, order) > largest) --order;
  return order;
}

/// The first order of a refinement to a tolerance that begins on this mesh.
int first_order_of(const PartInput& source, const mesh::TetMesh& mesh) {
  fem::ClosedPartOptions options;
  options.modes = setup::mode_options(source);
  return fem::first_order_on(mesh, options);
}

}  // namespace

std::optional<setup::PartSize> forecast(const PartInput& source, const std::shared_ptr<const fem::FirstMesh>& first) {
  const setup::Part& part = *source.part;
  const setup::ShapeKind kind = setup::kind(part);
  if (kind != setup::ShapeKind::surface && kind != setup::ShapeKind::mesh) return {};
  const mesh::TetMesh mesh = first ? first->mesh : coarsest_mesh(source);
  const std::vector<Eigen::Vector3d> held = held_vertices(source, mesh);
  setup::PartSize result;
  result.elements = static_cast<double>(mesh.tets.size());
  const bool to_tolerance = kind == setup::ShapeKind::surface && !part.mesh.element_size;
  const int usual = to_tolerance                     ? first_order_of(source, mesh) + 1
                    : kind == setup::ShapeKind::mesh ? part.imported->mesh->solid.nodes.order
                                                     : 2;
  result.order = std::max(to_tolerance ? 2 : 1, part.mesh.order.value_or(std::max(2, usual)));
  result.dofs = dofs(mesh, result.order);
  const int last = part.mesh.order ? result.order : fem::ClosedPartOptions{}.last_order;
  result.seconds = to_tolerance ? refinement_s(source, held, mesh, first && first->has_rows, result.order - 1, last)
                                : solve_s(mesh, result.order);
  const bool is_solved_higher = is_solved_one_order_higher(part, result.order);
  if (is_solved_higher) result.seconds += solve_s(mesh, result.order + 1);
  // Modes are added to such a reduction until its error is met: on the pocketed rib that takes as long as the mesh.
  if (source.reduction.tolerance && !source.reduction.interface.empty()) result.seconds *= 2.0;
  result.memory_bytes = most_bytes(
      mesh, to_tolerance ? highest_order(mesh, result.order - 1, last) : result.order + (is_solved_higher ? 1 : 0));
  return result;
}

void require_points_hold(const setup::PartSetup& source) {
  const setup::Part& part = *source.part;
  if (setup::may_be_held(part) || source.reduction.interface.empty()) return;
  const Eigen::AlignedBox3d box = setup::bounds(part);
  std::vector<Eigen::Matrix<double, 6, 1>> seen;
  for (const std::string& name : source.reduction.interface) {
    const setup::Point& point = setup::point(source, name);
    const Eigen::Vector3d arm = (setup::position(part, point) - box.center()) / box.diagonal().norm();
    for (const Eigen::Vector3d& d : point.directions) {
      seen.emplace_back();
      seen.back() << d, arm.cross(d);
    }
  }
  Eigen::MatrixXd motions(6, static_cast<Eigen::Index>(seen.size()));
  for (std::size_t i = 0; i < seen.size(); ++i) motions.col(static_cast<Eigen::Index>(i)) = seen[i];
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(motions);
  svd.setThreshold(1e-6);
  if (svd.rank() == 6) return;
  throw core::InputError("nothing holds the part, and its points see " + std::to_string(svd.rank()) +
                         " of its 6 rigid motions: add a support, or a point off the line of the others; without "
                         "points, modes alone are computed");
}

}  // namespace thinwall::study
