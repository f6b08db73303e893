#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "mesh/planar/layer_rows.hpp"
#include "mesh/planar/planar_mesh.hpp"

namespace thinwall::mesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;
using FaceBase =
    CGAL::Triangulation_face_base_with_info_2<int, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_tag>;

/// Adds p if it lies in the material and keeps its distance from all points (0.6) and segments (0.4), in units of the
/// wanted size h.
void add_if_free(const Prism& prism, const Eigen::Vector2d& p, double h, Sketch& sketch) {
  if (!extent_at(prism, p) || point_distance(sketch, p) < 0.6 * h || segment_distance(sketch, p) < 0.4 * h) return;
  sketch.points.push_back(p);
}

/// Adds a spot's centre and rings of eight points at radii r, 2r, 4r … up to the size of elements elsewhere.
void add_spots(const Prism& prism, const PrismMeshOptions& options, Sketch& sketch) {
  constexpr int around = 8;
  for (const auto& spot : options.spots) {
    add_if_free(prism, spot.at, spot.radius_m, sketch);
    for (double radius = spot.radius_m; radius < options.size_m; radius *= 2.0) {
      for (int k = 0; k < around; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / around;
        const Eigen::Vector2d p = spot.at + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
        add_if_free(prism, p, radius, sketch);
      }
    }
  }
}

/// Adds a square lattice along the longest border, evenly spaced over the part's extent.
void add_lattice(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options, Sketch& sketch) {
  Eigen::Vector2d along = Eigen::Vector2d::Zero();
  for (const auto& border : graph.borders) {
    const auto [a, b] = segment(graph, border);
    if ((b - a).norm() > along.norm()) along = b - a;
  }
  along.normalize();
  const Eigen::Vector2d across(-along.y(), along.x());
  Eigen::Array2d low = Eigen::Array2d::Constant(INFINITY);
  Eigen::Array2d high = -low;
  for (const auto& p : graph.points) {
    const Eigen::Array2d q(along.dot(p), across.dot(p));
    low = low.min(q);
    high = high.max(q);
  }
  const Eigen::Array2d cells = ((high - low) / options.size_m - 1e-6).ceil().max(1.0);
  for (int j = 1; j < static_cast<int>(cells.y()); ++j) {
    for (int i = 1; i < static_cast<int>(cells.x()); ++i) {
      const Eigen::Array2d q = low + (high - low) * Eigen::Array2d(i, j) / cells;
      const Eigen::Vector2d p = q.x() * along + q.y() * across;
      add_if_free(prism, p, wanted_size(options, p), sketch);
    }
  }
}

/// The constrained Delaunay triangulation; a vertex's info is the number of its point.
Triangulation triangulate(const Sketch& sketch) {
  Triangulation result;
  std::vector<Triangulation::Vertex_handle> handles;
  for (const auto& p : sketch.points) {
    handles.push_back(result.insert({p.x(), p.y()}));
    handles.back()->info() = static_cast<int>(handles.size()) - 1;
  }
  for (const auto& [a, b] : sketch.segments)
    result.insert_constraint(handles[static_cast<std::size_t>(a)], handles[static_cast<std::size_t>(b)]);
  return result;
}

using FaceHandle = Triangulation::Face_handle;

double area(FaceHandle face) {
  const auto& a = face->vertex(0)->point();
  const auto& b = face->vertex(1)->point();
  const auto& c = face->vertex(2)->point();
  return 0.5 * ((b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x()));
}

/// All faces that can be reached from `first` without crossing a border, which are marked by their info.
std::vector<FaceHandle> region(const Triangulation& triangulation, const std::set<std::pair<int, int>>& borders,
                               FaceHandle first) {
  std::vector<FaceHandle> faces{first};
  first->info() = 1;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const FaceHandle next = faces[i]->neighbor(k);
      if (triangulation.is_infinite(next) || next->info() != 0) continue;
      const int a = faces[i]->vertex(Triangulation::ccw(k))->info();
      const int b = faces[i]->vertex(Triangulation::cw(k))->info();
      if (borders.contains(std::minmax(a, b))) continue;
      next->info() = 1;
      faces.push_back(next);
    }
  }
  return faces;
}

/// The triangles with material. The extent of a region between borders is looked up in the middle of its largest
/// triangle. A region of slivers only is left out: round-off makes such regions outside of a straight outline that was
/// cut into pieces.
PlanarMesh with_material(const Prism& prism, const Triangulation& triangulation, const Sketch& sketch) {
  std::set<std::pair<int, int>> borders;
  for (std::size_t i = 0; i < sketch.borders; ++i)
    borders.insert(std::minmax(sketch.segments[i][0], sketch.segments[i][1]));
  for (const FaceHandle face : triangulation.all_face_handles()) face->info() = 0;
  const double sliver = 1e-14 * diagonal(prism) * diagonal(prism);
  PlanarMesh mesh;
  mesh.vertices = sketch.points;
  for (const FaceHandle first : triangulation.finite_face_handles()) {
    if (first->info() != 0) continue;
    const auto faces = region(triangulation, borders, first);
    const FaceHandle largest =
        *std::max_element(faces.begin(), faces.end(), [](FaceHandle a, FaceHandle b) { return area(a) < area(b); });
    Eigen::Vector2d middle = Eigen::Vector2d::Zero();
    for (int k = 0; k < 3; ++k) middle += sketch.points[static_cast<std::size_t>(largest->vertex(k)->info())] / 3.0;
    const auto extent = extent_at(prism, middle);
    if (!extent || area(largest) < sliver) continue;
    for (const FaceHandle face : faces) {
      mesh.triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
      mesh.extents.push_back(*extent);
    }
  }
  return mesh;
}

}  // namespace

PlanarMesh planar_delaunay(const Prism& prism, const BorderGraph& graph, const PrismMeshOptions& options) {
  Sketch sketch = layer_rows(prism, graph, options);
  add_spots(prism, options, sketch);
  add_lattice(prism, graph, options, sketch);
  return with_material(prism, triangulate(sketch), sketch);
}

}  // namespace thinwall::mesh
