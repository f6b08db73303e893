#include "mesh/planar/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <unordered_map>

#include "core/error.hpp"

namespace thinwall::mesh {

namespace {

/// True if the material reaches from `bottom` to `top`.
bool fills(const Extent& extent, double bottom, double top) {
  return extent.bottom <= bottom && extent.top >= top;
}

/// 2 area / perimeter of the material that fills the slab, m, which is the thickness of a long strip, straight or not.
double foot_thickness(const PlanarMesh& mesh, double bottom, double top) {
  double area = 0.0;
  std::set<std::pair<int, int>> border;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (!fills(mesh.extents[t], bottom, top)) continue;
    std::array<Eigen::Vector2d, 3> corner;
    for (std::size_t k = 0; k < 3; ++k) {
      const int from = mesh.triangles[t][k];
      const int to = mesh.triangles[t][(k + 1) % 3];
      corner[k] = mesh.vertices[static_cast<std::size_t>(from)];
      if (border.erase({to, from}) == 0) border.insert({from, to});
    }
    area += 0.5 * cross(corner[1] - corner[0], corner[2] - corner[0]);
  }
  double perimeter = 0.0;
  for (const auto& [from, to] : border) {
    perimeter += (mesh.vertices[static_cast<std::size_t>(to)] - mesh.vertices[static_cast<std::size_t>(from)]).norm();
  }
  return perimeter > 0.0 ? 2.0 * area / perimeter : 0.0;
}

/// The levels strictly inside a slab.
std::vector<double> inner_levels(double bottom, double top, double thickness, const PrismMeshOptions& options,
                                 double narrowest_m) {
  const double height = top - bottom;
  std::vector<double> lines{bottom, top};
  const auto unit = layer_distances(options.layers, options.layer_factor);
  if (!unit.empty() && height > 1.5 * thickness && thickness > 0.0) {
    const double wanted = options.layer_width_m > 0.0 ? options.layer_width_m : thickness;
    const double width = std::min({wanted, options.size_m, height / (3.0 * unit.back())});
    if (width * unit.front() < narrowest_m) {
      std::ostringstream text;
      text << "the innermost of " << options.layers << " layers would be " << width * unit.front() * 1e3
           << " mm high between z = " << bottom * 1e3 << " and " << top * 1e3 << " mm; it must be at least "
           << narrowest_m * 1e3 << " mm (1e-6 of the part's diagonal): fewer layers, or a larger layer_factor or "
           << "layer_width";
      throw core::InputError(text.str());
    }
    for (const double distance : unit) lines.insert(lines.end(), {bottom + width * distance, top - width * distance});
  }
  std::sort(lines.begin(), lines.end());
  std::vector<double> inner;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const auto cuts = divide(lines[i + 1] - lines[i], [&](double) { return options.size_m; });
    for (const double t : cuts) {
      const double z = (1.0 - t) * lines[i] + t * lines[i + 1];
      if (t < 1.0 && z > bottom) inner.push_back(z);
    }
  }
  return inner;
}

/// Appends the three tetrahedra of the prism over the triangle; vertex(i, upper) gives the prism's vertices. With the
/// corners in ascending order i < j < k, each side face is cut along the diagonal from its lower vertex of smaller
/// number to its upper vertex of larger number, which is the same seen from both sides. An odd permutation would turn
/// the tetrahedra inside out, so that two of their vertices are exchanged.
template <typename Vertex>
void cut_prism(std::array<int, 3> triangle, const Vertex& vertex, std::vector<std::array<int, 4>>& tets) {
  bool even = true;
  for (const auto& [a, b] : {std::pair{0U, 1U}, std::pair{1U, 2U}, std::pair{0U, 1U}}) {
    if (triangle[a] < triangle[b]) continue;
    std::swap(triangle[a], triangle[b]);
    even = !even;
  }
  const auto [i, j, k] = triangle;
  for (std::array<int, 4> tet : {std::array{vertex(i, false), vertex(j, false), vertex(k, false), vertex(k, true)},
                                 std::array{vertex(i, false), vertex(j, false), vertex(k, true), vertex(j, true)},
                                 std::array{vertex(i, false), vertex(j, true), vertex(k, true), vertex(i, true)}}) {
    if (!even) std::swap(tet[1], tet[2]);
    tets.push_back(tet);
  }
}

}  // namespace

std::vector<double> levels(const PlanarMesh& mesh, const PrismMeshOptions& options, double narrowest_m) {
  std::set<double> ends;
  for (const auto& extent : mesh.extents) ends.insert({extent.bottom, extent.top});
  std::vector<double> all;
  for (auto top = std::next(ends.begin()); top != ends.end(); ++top) {
    const double bottom = *std::prev(top);
    all.push_back(bottom);
    const auto inner = inner_levels(bottom, *top, foot_thickness(mesh, bottom, *top), options, narrowest_m);
    all.insert(all.end(), inner.begin(), inner.end());
  }
  all.push_back(*ends.rbegin());
  return all;
}

TetMesh sweep(const PlanarMesh& mesh, const std::vector<double>& levels) {
  TetMesh result;
  std::unordered_map<std::size_t, int> number;
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    const auto vertex = [&](int planar, bool upper) {
      const std::size_t at_level = level + (upper ? 1 : 0);
      const auto index = static_cast<std::size_t>(planar);
      const auto [found, inserted] =
          number.try_emplace(at_level * mesh.vertices.size() + index, static_cast<int>(result.vertices.size()));
      if (inserted) result.vertices.emplace_back(mesh.vertices[index].x(), mesh.vertices[index].y(), levels[at_level]);
      return found->second;
    };
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      if (fills(mesh.extents[t], levels[level], levels[level + 1])) cut_prism(mesh.triangles[t], vertex, result.tets);
    }
  }
  return result;
}

}  // namespace thinwall::mesh
