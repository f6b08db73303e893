#include "io/surface/step_triangles.hpp"

#include <BRep_Tool.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace thinwall::io {

namespace {

/// The points of all faces, and the record of those that are equal.
struct Joined {
  std::vector<Eigen::Vector3d> points;
  std::vector<int> parent;
  std::map<int, std::vector<int>> of_edge;  // points along an edge of the shape, from its first use
  std::map<int, int> of_vertex;
};

int root(Joined& joined, int i) {
  while (joined.parent[static_cast<std::size_t>(i)] != i) {
    int& up = joined.parent[static_cast<std::size_t>(i)];
    up = joined.parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

void join(Joined& joined, int a, int b) {
  a = root(joined, a);
  b = root(joined, b);
  joined.parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
}

void join_vertex(Joined& joined, const TopTools_IndexedMapOfShape& vertices, const TopoDS_Vertex& vertex, int point) {
  if (vertex.IsNull()) return;
  const auto [known, is_new] = joined.of_vertex.try_emplace(vertices.FindIndex(vertex), point);
  if (!is_new) join(joined, known->second, point);
}

/// Joins the points of an edge of a face with those that the edge has in other faces.
void join_edge(Joined& joined, const TopTools_IndexedMapOfShape& edges, const TopTools_IndexedMapOfShape& vertices,
               const TopoDS_Edge& edge, const std::vector<int>& along) {
  const auto forward = TopoDS::Edge(edge.Oriented(TopAbs_FORWARD));
  join_vertex(joined, vertices, TopExp::FirstVertex(forward), along.front());
  join_vertex(joined, vertices, TopExp::LastVertex(forward), along.back());
  if (BRep_Tool::Degenerated(edge)) {
    for (const int point : along) join(joined, along.front(), point);
    return;
  }
  const auto [known, is_new] = joined.of_edge.try_emplace(edges.FindIndex(edge), along);
  if (is_new || known->second.size() != along.size()) return;
  for (std::size_t k = 0; k < along.size(); ++k) join(joined, known->second[k], along[k]);
}

int add_points(Joined& joined, const Poly_Triangulation& triangles, const TopLoc_Location& location) {
  const int first = static_cast<int>(joined.points.size());
  for (int i = 1; i <= triangles.NbNodes(); ++i) {
    const gp_Pnt x = triangles.Node(i).Transformed(location.Transformation());
    joined.points.emplace_back(x.X(), x.Y(), x.Z());
    joined.parent.push_back(first + i - 1);
  }
  return first;
}

void add_triangles(std::vector<std::array<int, 3>>& into, const Poly_Triangulation& triangles, int first,
                   bool is_reversed) {
  for (int i = 1; i <= triangles.NbTriangles(); ++i) {
    int a = 0;
    int b = 0;
    int c = 0;
    triangles.Triangle(i).Get(a, b, c);
    if (is_reversed) std::swap(b, c);
    into.push_back({first + a - 1, first + b - 1, first + c - 1});
  }
}

}  // namespace

std::optional<TopoDS_Face> face_without_triangles(const TopoDS_Shape& shape) {
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    TopLoc_Location location;
    const auto triangles = BRep_Tool::Triangulation(TopoDS::Face(at.Current()), location);
    if (triangles.IsNull() || triangles->NbTriangles() == 0) return TopoDS::Face(at.Current());
  }
  return std::nullopt;
}

mesh::TriangleSoup triangles_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape edges;
  TopTools_IndexedMapOfShape vertices;
  TopExp::MapShapes(shape, TopAbs_EDGE, edges);
  TopExp::MapShapes(shape, TopAbs_VERTEX, vertices);
  Joined joined;
  std::vector<std::array<int, 3>> triangles;
  for (TopExp_Explorer at(shape, TopAbs_FACE); at.More(); at.Next()) {
    const TopoDS_Face face = TopoDS::Face(at.Current());
    TopLoc_Location location;
    const auto of_face = BRep_Tool::Triangulation(face, location);
    const int first = add_points(joined, *of_face, location);
    add_triangles(triangles, *of_face, first, face.Orientation() == TopAbs_REVERSED);
    for (TopExp_Explorer side(face, TopAbs_EDGE); side.More(); side.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(side.Current());
      const auto polygon = BRep_Tool::PolygonOnTriangulation(edge, of_face, location);
      if (polygon.IsNull() || polygon->NbNodes() == 0) continue;
      std::vector<int> along;
      for (int k = 1; k <= polygon->NbNodes(); ++k) along.push_back(first + polygon->Node(k) - 1);
      join_edge(joined, edges, vertices, edge, along);
    }
  }
  mesh::TriangleSoup soup{joined.points, {}};
  for (auto& t : triangles) {
    for (int& v : t) v = root(joined, v);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) soup.triangles.push_back(t);
  }
  return mesh::merged_points(soup).soup;
}

}  // namespace thinwall::io
