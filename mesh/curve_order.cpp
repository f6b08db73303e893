#include "mesh/curve_order.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <numeric>
#include <utility>
#include <vector>

namespace thinwall::mesh {

namespace {

using SortingKernel = CGAL::Simple_cartesian<double>;
using Centres = CGAL::Pointer_property_map<SortingKernel::Point_3>::type;

/// Four times the centres of the tetrahedra; the factor does not change their order.
std::vector<SortingKernel::Point_3> centres(const TetMesh& mesh) {
  std::vector<SortingKernel::Point_3> all;
  all.reserve(mesh.tets.size());
  for (const auto& tet : mesh.tets) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int v : tet) sum += mesh.vertices[static_cast<std::size_t>(v)];
    all.emplace_back(sum.x(), sum.y(), sum.z());
  }
  return all;
}

/// Numbers the vertices in the order in which the tetrahedra first use them, and drops the others.
void number_vertices_by_use(TetMesh& mesh) {
  std::vector<int> number(mesh.vertices.size(), -1);
  std::vector<Eigen::Vector3d> used;
  for (auto& tet : mesh.tets) {
    for (int& v : tet) {
      int& n = number[static_cast<std::size_t>(v)];
      if (n < 0) {
        n = static_cast<int>(used.size());
        used.push_back(mesh.vertices[static_cast<std::size_t>(v)]);
      }
      v = n;
    }
  }
  mesh.vertices = std::move(used);
}

}  // namespace

void order_along_curve(TetMesh& mesh) {
  std::vector<SortingKernel::Point_3> at = centres(mesh);
  std::vector<std::size_t> order(at.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const CGAL::Spatial_sort_traits_adapter_3<SortingKernel, Centres> traits(CGAL::make_property_map(at));
  CGAL::hilbert_sort(order.begin(), order.end(), traits);
  std::vector<std::array<int, 4>> sorted;
  sorted.reserve(order.size());
  for (const std::size_t tet : order) sorted.push_back(mesh.tets[tet]);
  mesh.tets = std::move(sorted);
  number_vertices_by_use(mesh);
}

}  // namespace thinwall::mesh
