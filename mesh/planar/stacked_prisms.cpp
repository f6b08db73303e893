#include "mesh/planar/stacked_prisms.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <utility>

namespace thinwall::mesh {

namespace {

using EndKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using EndVertex = CGAL::Triangulation_vertex_base_with_info_2<int, EndKernel>;
/// The info of a face is the number of outlines around it, below 0 where it is not known.
using EndFace =
    CGAL::Triangulation_face_base_with_info_2<int, EndKernel, CGAL::Constrained_triangulation_face_base_2<EndKernel>>;
using EndTriangulation =
    CGAL::Constrained_Delaunay_triangulation_2<EndKernel, CGAL::Triangulation_data_structure_2<EndVertex, EndFace>,
                                               CGAL::Exact_predicates_tag>;

/// Sets the info of every face: from the outside, one more outline with each constrained edge that is crossed.
void count_outlines(EndTriangulation& triangulation) {
  for (const auto& face : triangulation.all_face_handles()) face->info() = -1;
  std::vector<EndTriangulation::Face_handle> open{triangulation.infinite_face()};
  open.front()->info() = 0;
  while (!open.empty()) {
    const auto face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info() >= 0) continue;
      next->info() = (face->info() + (triangulation.is_constrained({face, i}) ? 1 : 0)) % 2;
      open.push_back(next);
    }
  }
}

void add_layer(const Layer& layer, TriangleSurface& surface) {
  EndTriangulation triangulation;
  for (const auto& outline : layer.outlines) {
    std::vector<EndKernel::Point_2> corners;
    corners.reserve(outline.size());
    for (const Eigen::Vector2d& p : outline) corners.emplace_back(p.x(), p.y());
    triangulation.insert_constraint(corners.begin(), corners.end(), true);
  }
  if (triangulation.dimension() < 2) return;
  count_outlines(triangulation);
  const auto first = static_cast<int>(surface.vertices.size());
  int number = 0;
  for (const auto& vertex : triangulation.finite_vertex_handles()) {
    vertex->info() = first + 2 * number++;
    surface.vertices.emplace_back(vertex->point().x(), vertex->point().y(), layer.from_m);
    surface.vertices.emplace_back(vertex->point().x(), vertex->point().y(), layer.to_m);
  }
  for (const auto& face : triangulation.finite_face_handles()) {
    if (face->info() != 1) continue;
    const int a = face->vertex(0)->info(), b = face->vertex(1)->info(), c = face->vertex(2)->info();
    surface.triangles.push_back({a, c, b});              // seen from below
    surface.triangles.push_back({a + 1, b + 1, c + 1});  // from above
    for (int i = 0; i < 3; ++i) {
      if (face->neighbor(i)->info() == 1) continue;
      const int p = face->vertex(EndTriangulation::ccw(i))->info(), q = face->vertex(EndTriangulation::cw(i))->info();
      surface.triangles.push_back({p, q, q + 1});
      surface.triangles.push_back({p, q + 1, p + 1});
    }
  }
}

}  // namespace

TriangleSurface stacked_prisms(const std::vector<Layer>& layers) {
  TriangleSurface surface;
  for (const Layer& layer : layers) add_layer(layer, surface);
  return surface;
}

}  // namespace thinwall::mesh
