#include "mesh/surface/hole_filling.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <map>
#include <span>
#include <vector>

#include "mesh/surface/edge_uses.hpp"

namespace thinwall::mesh {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Loop = std::vector<int>;

/// For each point on a border the neighbouring points on that border.
std::map<int, std::vector<int>> border_neighbours(const TriangleSoup& soup) {
  std::map<int, std::vector<int>> beside;
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 1) return;
    beside[uses[0].ends[0]].push_back(uses[0].ends[1]);
    beside[uses[0].ends[1]].push_back(uses[0].ends[0]);
  });
  return beside;
}

/// The closed lines of the border that contain no point at which lines meet.
std::vector<Loop> border_loops(const TriangleSoup& soup) {
  auto beside = border_neighbours(soup);
  std::vector<Loop> loops;
  std::map<int, bool> is_visited;
  for (const auto& [start, ignored] : beside) {
    Loop loop;
    bool is_simple = true;
    int previous = -1;
    for (int p = start; !is_visited[p];) {
      is_visited[p] = true;
      loop.push_back(p);
      const auto& next = beside[p];
      if (next.size() != 2) {
        is_simple = false;
        break;
      }
      const int onwards = next[0] == previous ? next[1] : next[0];
      previous = p;
      p = onwards;
    }
    const bool is_closed =
        is_simple && loop.size() >= 3 && std::count(beside[loop.back()].begin(), beside[loop.back()].end(), start) == 1;
    if (is_closed) loops.push_back(std::move(loop));
  }
  return loops;
}

std::vector<char> triangulated(const TriangleSoup& soup, const std::vector<Loop>& loops) {
  std::vector<std::array<int, 3>> triangles;
  for (const Loop& loop : loops) {
    std::vector<Kernel::Point_3> line;
    for (const int p : loop) {
      const auto& x = soup.points[static_cast<std::size_t>(p)];
      line.emplace_back(x(0), x(1), x(2));
    }
    std::vector<CGAL::Triple<int, int, int>> found;
    CGAL::Polygon_mesh_processing::triangulate_hole_polyline(line, std::back_inserter(found));
    const auto at = [&loop](int k) { return loop[static_cast<std::size_t>(k)]; };
    for (const auto& t : found) triangles.push_back({at(t.first), at(t.second), at(t.third)});
  }
  std::vector<char> bytes(triangles.size() * sizeof triangles[0]);
  if (!bytes.empty()) std::memcpy(bytes.data(), triangles.data(), bytes.size());
  return bytes;
}

}  // namespace

SurfaceFinding fill_holes(TriangleSoup& soup, int largest_edges, const ProcessLimits& limits) {
  SurfaceFinding finding{.what = "holes filled"};
  std::vector<Loop> loops = border_loops(soup);
  std::erase_if(loops,
                [&](const Loop& loop) { return loop.size() > static_cast<std::size_t>(std::max(0, largest_edges)); });
  if (loops.empty()) return finding;
  const auto bytes = run_confined([&] { return triangulated(soup, loops); }, limits.time_s, limits.memory_bytes);
  std::vector<std::array<int, 3>> triangles(bytes.size() / sizeof(std::array<int, 3>));
  if (!triangles.empty()) std::memcpy(triangles.data(), bytes.data(), triangles.size() * sizeof triangles[0]);
  soup.triangles.insert(soup.triangles.end(), triangles.begin(), triangles.end());
  for (const Loop& loop : loops) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int p : loop) sum += soup.points[static_cast<std::size_t>(p)];
    finding.add(sum / static_cast<double>(loop.size()));
  }
  return finding;
}

SurfaceFinding open_edges(const TriangleSoup& soup) {
  SurfaceFinding finding{.what = "edges with one triangle: the surface is open",
                         .remedy = "close it, or let small holes be filled (repair.largest_hole)"};
  for_each_edge(sorted_edges(soup.triangles), [&](std::span<const EdgeUse> uses) {
    if (uses.size() != 1) return;
    const auto at = [&](std::size_t k) { return soup.points[static_cast<std::size_t>(uses[0].ends[k])]; };
    finding.add(0.5 * (at(0) + at(1)));
  });
  return finding;
}

}  // namespace thinwall::mesh
