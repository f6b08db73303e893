#include "report/test_shapes.hpp"

#include <cmath>
#include <complex>
#include <map>
#include <set>
#include <utility>

#include "fem/model.hpp"
#include "io/frf/uff_mesh.hpp"
#include "io/frf/uff_shapes.hpp"
#include "mesh/tet_mesh.hpp"

namespace thinwall::report {

namespace {

/// The corners that an edge joins each corner to.
using Neighbours = std::map<int, std::set<int>>;

Neighbours edges_of(const std::vector<mesh::BoundaryTriangle>& surface) {
  Neighbours edges;
  for (const auto& triangle : surface) {
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = triangle.vertices[k], b = triangle.vertices[(k + 1) % 3];
      edges[a].insert(b);
      edges[b].insert(a);
    }
  }
  return edges;
}

/// Every edge once, as paths from corner to corner that go on as long as they can; −1 between two paths.
std::vector<int> drawn_once(Neighbours edges) {
  std::vector<int> path;
  for (auto& [start, left] : edges) {
    while (!left.empty()) {
      if (!path.empty()) path.push_back(-1);
      path.push_back(start);
      for (int here = start; !edges[here].empty(); here = path.back()) {
        const int next = *edges[here].begin();
        edges[here].erase(next);
        edges[next].erase(here);
        path.push_back(next);
      }
    }
  }
  return path;
}

/// The path in pieces of as many nodes as a trace line holds; each begins with the node at which the one before ends.
std::vector<io::UffTraceLine> trace_lines(const std::vector<int>& path, const std::map<int, long>& labels) {
  constexpr std::size_t longest = 250;
  std::vector<io::UffTraceLine> lines;
  for (const int corner : path) {
    const long label = corner < 0 ? 0 : labels.at(corner);
    if (lines.empty() || lines.back().nodes.size() == longest) {
      const long last = lines.empty() ? 0 : lines.back().nodes.back();
      lines.push_back({static_cast<long>(lines.size()) + 1, "surface", {}});
      if (last != 0) lines.back().nodes.push_back(last);
    }
    lines.back().nodes.push_back(label);
  }
  return lines;
}

io::UffShape shape_of(const fem::Model& model, const Eigen::VectorXd& shape, const std::map<int, long>& labels) {
  const auto moved = fem::displacements(model, shape);
  io::UffShape result;
  result.displacement.resize(std::ssize(labels), 3);
  for (const auto& [corner, label] : labels) {
    result.displacement.row(std::ssize(result.nodes)) = moved.row(corner).cast<std::complex<double>>();
    result.nodes.push_back(label);
  }
  return result;
}

}  // namespace

void write_test_shapes(const std::filesystem::path& path, const study::PartResult& part, const Eigen::MatrixXd& shapes,
                       const ModeValues& modes) {
  const Neighbours edges = edges_of(mesh::boundary(part.model.mesh));
  std::map<int, long> labels;
  io::UffMesh geometry;
  for (const auto& [corner, joined] : edges) {
    const long label = std::ssize(labels) + 1;
    labels.emplace(corner, label);
    geometry.nodes.push_back({label, part.model.nodes.positions.row(corner)});
  }
  geometry.lines = trace_lines(drawn_once(edges), labels);
  std::vector<io::UffShape> drawn;
  for (Eigen::Index k = 0; k < shapes.cols(); ++k) {
    const auto mode = static_cast<std::size_t>(k);
    io::UffShape shape = shape_of(part.model, shapes.col(k), labels);
    shape.number = static_cast<int>(k) + 1;
    shape.frequency_hz = modes.frequency_hz[mode];
    shape.damping_ratio = std::isnan(modes.damping_ratio[mode]) ? 0.0 : modes.damping_ratio[mode];
    shape.modal_mass = modes.modal_mass.empty() ? 0.0 : modes.modal_mass[mode];
    drawn.push_back(std::move(shape));
  }
  io::write_uff_shapes(path, drawn, geometry);
}

}  // namespace thinwall::report
