#include "mesh/surface/remesh.hpp"

#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <deque>
#include <list>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/interrupt.hpp"
#include "core/units.hpp"
#include "mesh/surface/placed_triangle.hpp"

namespace thinwall::mesh {

namespace {

using Mesh = CGAL::Surface_mesh<Eigen::Vector3d>;
using Vertex = Mesh::Vertex_index;
using Half = Mesh::Halfedge_index;
using Edge = Mesh::Edge_index;
using Face = Mesh::Face_index;

constexpr double too_long = 1.4142135623730951;
constexpr double too_short = 0.7;
constexpr int rounds = 8;
constexpr double better = 1e-3;  // least gain in quality of a flip or a move

/// The surface during remeshing, with its patches and lines.
struct Work {
  const SizeSpace& space;
  Mesh mesh;
  Mesh::Property_map<Face, int> patch;
  Mesh::Property_map<Edge, int> line;  // −1: not sharp
  Mesh::Property_map<Vertex, bool> is_corner;
  Mesh::Property_map<Vertex, std::list<Place>> places;  // a place stays where it is while others are added
  std::size_t most_vertices = 500000;                   // models of a tenth of that are too large to be solved

  explicit Work(const SizeSpace& size_space)
      : space(size_space),
        patch(mesh.add_property_map<Face, int>("f:patch", -1).first),
        line(mesh.add_property_map<Edge, int>("e:line", -1).first),
        is_corner(mesh.add_property_map<Vertex, bool>("v:corner", false).first),
        places(mesh.add_property_map<Vertex, std::list<Place>>("v:places").first) {}
};

/// The place of a vertex on a patch, which is kept, and the reference valid, until the vertex moves.
const Place& place_of(Work& work, Vertex v, int patch) {
  auto& known = work.places[v];
  for (const Place& place : known)
    if (place.patch == patch) return place;
  return known.emplace_back(make_place(work.space, patch, work.mesh.point(v)));
}

/// The patches on the two sides of an edge.
std::array<int, 2> patches_along(const Work& work, Edge e) {
  const Half h = work.mesh.halfedge(e);
  return {work.patch[work.mesh.face(h)], work.patch[work.mesh.face(work.mesh.opposite(h))]};
}

/// The length of an edge in that of its two patches in which it is longer, and this patch.
std::pair<double, int> longest(Work& work, Edge e) {
  const Vertex a = work.mesh.vertex(e, 0);
  const Vertex b = work.mesh.vertex(e, 1);
  std::pair<double, int> result{-1.0, -1};
  for (const int patch : patches_along(work, e)) {
    if (patch == result.second) continue;
    result = std::max(result, {length(work.space, place_of(work, a, patch), place_of(work, b, patch)), patch});
  }
  return result;
}

/// The sharp edges at a vertex, as halfedges that point to it.
std::vector<Half> sharp_halfedges(const Work& work, Vertex v) {
  std::vector<Half> result;
  for (const Half h : work.mesh.halfedges_around_target(work.mesh.halfedge(v)))
    if (work.line[work.mesh.edge(h)] >= 0) result.push_back(h);
  return result;
}

/// All edges with their lengths, ascending.
std::vector<std::pair<double, Edge>> measured_edges(Work& work) {
  std::vector<std::pair<double, Edge>> result;
  for (const Edge e : work.mesh.edges()) {
    core::check_interrupt();
    result.emplace_back(longest(work, e).first, e);
  }
  std::sort(result.begin(), result.end());
  return result;
}

/// The point that halves the edge's wanted length, projected onto the line or the patch. It is not the middle of an
/// edge along which the wanted size changes.
Eigen::Vector3d halving_point(Work& work, Edge e, int patch) {
  constexpr int samples = 64;
  const Place& a = place_of(work, work.mesh.vertex(e, 0), patch);
  const Place& b = place_of(work, work.mesh.vertex(e, 1), patch);
  std::vector<double> way{0.0};
  Eigen::VectorXd last = a.wanted;
  for (int k = 1; k <= samples; ++k) {
    const double s = static_cast<double>(k) / samples;
    const Eigen::VectorXd next = work.space.at(patch, a.x + s * (b.x - a.x), a.normal + s * (b.normal - a.normal));
    way.push_back(way.back() + (next - last).norm());
    last = next;
  }
  const auto half = std::lower_bound(way.begin(), way.end(), 0.5 * way.back()) - way.begin();
  const double before = way[static_cast<std::size_t>(half - 1)];
  const double s =
      (static_cast<double>(half - 1) + (0.5 * way.back() - before) / (way[static_cast<std::size_t>(half)] - before)) /
      samples;
  const Eigen::Vector3d x = a.x + s * (b.x - a.x);
  if (work.line[e] >= 0) return work.space.on_line(work.line[e], x);
  return work.space.is_planar(patch) ? x : work.space.on_patch(patch, x);
}

/// Splits an edge and the two triangles beside it at a new vertex at x.
void split(Work& work, Edge e, const Eigen::Vector3d& x) {
  Mesh& mesh = work.mesh;
  const Half h = mesh.halfedge(e);
  const Half before = CGAL::Euler::split_edge(h, mesh);
  mesh.point(mesh.target(before)) = x;
  work.line[mesh.edge(before)] = work.line[e];
  for (const Half to_new : {before, mesh.opposite(h)}) {
    const int patch = work.patch[mesh.face(to_new)];
    const Half across = CGAL::Euler::split_face(to_new, mesh.next(mesh.next(to_new)), mesh);
    for (const Half side : {across, mesh.opposite(across)}) work.patch[mesh.face(side)] = patch;
  }
}

[[noreturn]] void refuse_so_fine(const Work& work, Edge e) {
  const Eigen::Vector3d x = 1e3 * work.mesh.point(work.mesh.vertex(e, 0));
  throw core::InputError(
      "a surface of more than " + std::to_string(work.most_vertices) + " vertices would be needed, at last near (" +
      core::number_text(x(0), 3) + ", " + core::number_text(x(1), 3) + ", " + core::number_text(x(2), 3) +
      ") mm: the wall is too thin there for a part of this size; check the unit, thicken it, or take "
      "larger elements");
}

/// Splits edges that are too long, the longest first; returns their number.
int split_long_edges(Work& work) {
  int splits = 0;
  auto edges = measured_edges(work);
  for (auto it = edges.rbegin(); it != edges.rend() && it->first > too_long; ++it) {
    const auto [now, patch] = longest(work, it->second);
    if (!(now > too_long)) continue;  // an edge that a split of this sweep has shortened
    core::check_interrupt();
    if (work.mesh.number_of_vertices() > work.most_vertices) refuse_so_fine(work, it->second);
    split(work, it->second, halving_point(work, it->second, patch));
    ++splits;
  }
  return splits;
}

/// True if moving source(h) into target(h) keeps the lines, the corners, the topology (link condition), edges that are
/// not too long, and the surface's shape.
bool may_collapse(Work& work, Half h) {
  Mesh& mesh = work.mesh;
  const Vertex gone = mesh.source(h);
  const Vertex kept = mesh.target(h);
  if (work.is_corner[gone]) return false;
  const bool on_line = !sharp_halfedges(work, gone).empty();
  if (on_line && work.line[mesh.edge(h)] < 0) return false;
  for (const Half side : {h, mesh.opposite(h)}) {
    const Half apex_to_source = side == h ? mesh.prev(side) : mesh.next(side);
    if (work.line[mesh.edge(apex_to_source)] >= 0) return false;
  }
  if (!CGAL::Euler::does_satisfy_link_condition(mesh.edge(h), mesh)) return false;
  for (const Half to_gone : mesh.halfedges_around_target(mesh.halfedge(gone))) {
    const Face f = mesh.face(to_gone);
    if (f == mesh.face(h) || f == mesh.face(mesh.opposite(h))) continue;
    const int patch = work.patch[f];
    const Place& moved = place_of(work, kept, patch);
    const Place& b = place_of(work, mesh.target(mesh.next(to_gone)), patch);
    const Place& c = place_of(work, mesh.source(to_gone), patch);
    if (length(work.space, moved, b) > too_long || length(work.space, moved, c) > too_long) return false;
    if (!is_faithful(work.space, moved, b, c)) return false;
  }
  return true;
}

/// Moves source(h) into target(h).
void collapse(Work& work, Half h) {
  Mesh& mesh = work.mesh;
  const Vertex kept = mesh.target(h);
  const Eigen::Vector3d x = mesh.point(kept);
  const bool corner = work.is_corner[kept];
  auto places = work.places[kept];
  // At each apex two edges become one. The one of the kept vertex may be sharp (may_collapse() excludes the other), and
  // CGAL decides which of the two remains, so that its line is set again.
  std::array<std::pair<Vertex, int>, 2> apexes;
  std::size_t k = 0;
  for (const Half side : {h, mesh.opposite(h)}) {
    const Half kept_edge = side == h ? mesh.next(side) : mesh.prev(side);
    apexes[k++] = {mesh.target(mesh.next(side)), work.line[mesh.edge(kept_edge)]};
  }
  const Vertex left = CGAL::Euler::collapse_edge(mesh.edge(h), mesh);
  mesh.point(left) = x;
  work.is_corner[left] = corner;
  work.places[left] = std::move(places);
  for (const auto& [apex, line] : apexes) work.line[mesh.edge(mesh.halfedge(left, apex))] = line;
}

/// Collapses edges that are too short, the shortest first; returns their number.
int collapse_short_edges(Work& work) {
  int collapses = 0;
  for (const auto& [measured, e] : measured_edges(work)) {
    if (measured >= too_short) break;
    core::check_interrupt();
    if (work.mesh.is_removed(e) || longest(work, e).first >= too_short) continue;
    const Half h = work.mesh.halfedge(e);
    for (const Half direction : {h, work.mesh.opposite(h)}) {
      if (!may_collapse(work, direction)) continue;
      collapse(work, direction);
      ++collapses;
      break;
    }
  }
  return collapses;
}

/// The outcome of a look at an edge, which is the same until one of its two triangles changes, unless it is blocked: a
/// flip would make an edge that stands elsewhere.
enum class Look { settled, blocked, flipped };

/// Flips an edge that is not sharp if that improves the worse of its two triangles.
Look flip_if_better(Work& work, Edge e) {
  Mesh& mesh = work.mesh;
  if (work.line[e] >= 0) return Look::settled;
  const Half h = mesh.halfedge(e);
  const std::array<Vertex, 4> v{mesh.source(h), mesh.target(h), mesh.target(mesh.next(h)),
                                mesh.target(mesh.next(mesh.opposite(h)))};
  if (mesh.halfedge(v[2], v[3]) != Mesh::null_halfedge()) return Look::blocked;
  const int patch = work.patch[mesh.face(h)];
  const Place& a = place_of(work, v[0], patch);
  const Place& b = place_of(work, v[1], patch);
  const Place& c = place_of(work, v[2], patch);
  const Place& d = place_of(work, v[3], patch);
  const double now = std::min(quality(work.space, a, b, c), quality(work.space, b, a, d));
  const double then = std::min(quality(work.space, a, d, c), quality(work.space, d, b, c));
  if (!(then > now + better) || !is_faithful(work.space, a, d, c) || !is_faithful(work.space, d, b, c))
    return Look::settled;
  CGAL::Euler::flip_edge(h, mesh);
  return Look::flipped;
}

/// Flips edges in several sweeps, because a flip can make another one worthwhile: those around it.
void flip_edges(Work& work) {
  constexpr int sweeps = 10;
  Mesh& mesh = work.mesh;
  std::vector<bool> settled(mesh.num_edges(), false);
  bool changed = true;
  for (int sweep = 0; sweep < sweeps && changed; ++sweep) {
    changed = false;
    for (const Edge e : mesh.edges()) {
      if (settled[e.idx()]) continue;
      core::check_interrupt();
      const Look look = flip_if_better(work, e);
      settled[e.idx()] = look == Look::settled;
      if (look != Look::flipped) continue;
      changed = true;
      for (const Half h : {mesh.halfedge(e), mesh.opposite(mesh.halfedge(e))})
        for (const Half beside : {mesh.next(h), mesh.prev(h)}) settled[mesh.edge(beside).idx()] = false;
    }
  }
}

/// Quality of the worst triangle around v if v were at x; empty if it does not exceed `to_beat` or if a triangle would
/// not be faithful.
std::optional<double> worst_around(Work& work, Vertex v, const Eigen::Vector3d& x, double to_beat) {
  Mesh& mesh = work.mesh;
  std::deque<Place> moved;
  std::vector<std::array<const Place*, 3>> triangles;
  double worst = 1.0;
  for (const Half h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    const int patch = work.patch[mesh.face(h)];
    auto known = std::ranges::find(moved, patch, &Place::patch);
    if (known == moved.end()) known = moved.insert(moved.end(), make_place(work.space, patch, x));
    const Place& b = place_of(work, mesh.target(mesh.next(h)), patch);
    const Place& c = place_of(work, mesh.source(h), patch);
    triangles.push_back({&*known, &b, &c});
    worst = std::min(worst, quality(work.space, *known, b, c));
    if (!(worst > to_beat)) return std::nullopt;
  }
  for (const auto& [a, b, c] : triangles)
    if (!is_faithful(work.space, *a, *b, *c)) return std::nullopt;
  return worst;
}

/// Places to which a vertex may go: a step towards each of its neighbours, or along its line if it lies on one, and the
/// mean of its neighbours.
std::vector<Eigen::Vector3d> candidates(const Work& work, Vertex v) {
  constexpr double step = 0.2;
  const Mesh& mesh = work.mesh;
  const Eigen::Vector3d x = mesh.point(v);
  std::vector<Eigen::Vector3d> result;
  if (const auto sharp = sharp_halfedges(work, v); !sharp.empty()) {
    for (const Half h : sharp)
      result.push_back(work.space.on_line(work.line[mesh.edge(h)], x + step * (mesh.point(mesh.source(h)) - x)));
    return result;
  }
  const int patch = work.patch[mesh.face(mesh.halfedge(v))];
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  int neighbours = 0;
  for (const Half h : mesh.halfedges_around_target(mesh.halfedge(v))) {
    result.push_back(x + step * (mesh.point(mesh.source(h)) - x));
    mean += mesh.point(mesh.source(h));
    ++neighbours;
  }
  result.push_back(mean / neighbours);
  if (!work.space.is_planar(patch))
    for (auto& candidate : result) candidate = work.space.on_patch(patch, candidate);
  return result;
}

/// Moves each vertex that is no corner to the candidate with the best quality, if that is an improvement.
void move_vertices(Work& work) {
  for (const Vertex v : work.mesh.vertices()) {
    if (work.is_corner[v]) continue;
    core::check_interrupt();
    const Eigen::Vector3d before = work.mesh.point(v);
    double best = worst_around(work, v, before, -1.0).value_or(0.0) + better;
    Eigen::Vector3d where = before;
    for (const auto& candidate : candidates(work, v)) {
      const auto worst = worst_around(work, v, candidate, best);
      if (!worst) continue;
      best = *worst;
      where = candidate;
    }
    if (where == before) continue;
    work.mesh.point(v) = where;
    work.places[v].clear();
  }
}

/// Splits long edges in sweeps, because a long edge needs several halvings and its neighbours have to follow; returns
/// the number of splits.
int split_down(Work& work) {
  constexpr int halvings = 20;
  int splits = 0;
  for (int sweep = 0; sweep < halvings; ++sweep) {
    const int now = split_long_edges(work);
    if (now == 0) break;
    flip_edges(work);
    splits += now;
  }
  return splits;
}

/// Fills the mesh with the input surface and its features.
void load(Work& work, const TriangleSurface& surface, const SurfaceFeatures& features) {
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    work.is_corner[work.mesh.add_vertex(surface.vertices[v])] = features.is_corner[v];
  const auto index = [](int v) { return Vertex(static_cast<std::uint32_t>(v)); };
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    const auto& v = surface.triangles[t];
    work.patch[work.mesh.add_face(index(v[0]), index(v[1]), index(v[2]))] = features.patch_of_triangle[t];
  }
  for (std::size_t l = 0; l < features.lines.size(); ++l) {
    const auto& line = features.lines[l].vertices;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Half h = work.mesh.halfedge(index(line[i]), index(line[i + 1]));
      work.line[work.mesh.edge(h)] = static_cast<int>(l);
    }
  }
}

/// The remeshed surface.
Remeshed unload(Work& work) {
  Remeshed result;
  for (const Edge e : work.mesh.edges()) {
    core::check_interrupt();
    result.longest_edge = std::max(result.longest_edge, longest(work, e).first);
  }
  work.mesh.collect_garbage();
  for (const Vertex v : work.mesh.vertices()) result.surface.vertices.push_back(work.mesh.point(v));
  for (const Face f : work.mesh.faces()) {
    std::array<int, 3> corners{};
    Half h = work.mesh.halfedge(f);
    for (int& corner : corners) {
      corner = static_cast<int>(work.mesh.target(h).idx());
      h = work.mesh.next(h);
    }
    result.surface.triangles.push_back(corners);
    result.patch_of_triangle.push_back(work.patch[f]);
  }
  return result;
}

}  // namespace

Remeshed remesh(const TriangleSurface& surface, const SurfaceFeatures& features, const SizeSpace& space) {
  Work work(space);
  load(work, surface, features);
  work.most_vertices = std::max(work.most_vertices, 2 * surface.vertices.size());
  for (int round = 0; round < rounds; ++round) {
    core::check_interrupt();
    const int changes = split_down(work) + collapse_short_edges(work);
    flip_edges(work);
    move_vertices(work);
    if (changes == 0) break;
  }
  flip_edges(work);
  return unload(work);
}

}  // namespace thinwall::mesh
