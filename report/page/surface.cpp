#include "report/page/surface.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <tuple>

namespace thinwall::report {

namespace {

using Key = std::tuple<long, long, long, int>;

/// Sums of the area vectors of the triangles about each vertex.
std::vector<Eigen::Vector3d> normals(const mesh::TriangleSurface& surface) {
  std::vector<Eigen::Vector3d> result(surface.vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& t : surface.triangles) {
    const auto vertex = [&](std::size_t k) { return surface.vertices[static_cast<std::size_t>(t[k])]; };
    const Eigen::Vector3d area = (vertex(1) - vertex(0)).cross(vertex(2) - vertex(0));
    for (const int v : t) result[static_cast<std::size_t>(v)] += area;
  }
  return result;
}

int octant(const Eigen::Vector3d& n) {
  return (n.x() > 0.0 ? 1 : 0) + (n.y() > 0.0 ? 2 : 0) + (n.z() > 0.0 ? 4 : 0);
}

/// For each vertex the first one of its cell.
std::vector<int> clustered(const mesh::TriangleSurface& surface, const std::vector<Eigen::Vector3d>& normal,
                           double cell) {
  std::map<Key, int> first;
  std::vector<int> of_vertex;
  for (std::size_t v = 0; v < surface.vertices.size(); ++v) {
    const Eigen::Vector3d x = surface.vertices[v] / cell;
    const Key key{std::lround(x.x()), std::lround(x.y()), std::lround(x.z()), octant(normal[v])};
    of_vertex.push_back(first.try_emplace(key, static_cast<int>(v)).first->second);
  }
  return of_vertex;
}

Thinned kept(const mesh::TriangleSurface& surface, const std::vector<int>& of_vertex) {
  Thinned result;
  std::vector<int> number(of_vertex.size(), -1);
  for (std::size_t v = 0; v < of_vertex.size(); ++v) {
    if (of_vertex[v] != static_cast<int>(v)) continue;
    number[v] = static_cast<int>(result.vertices.size());
    result.vertices.push_back(static_cast<int>(v));
  }
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<int, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const int leader = of_vertex[static_cast<std::size_t>(surface.triangles[t][k])];
      corners[k] = number[static_cast<std::size_t>(leader)];
    }
    if (corners[0] == corners[1] || corners[1] == corners[2] || corners[2] == corners[0]) continue;
    result.triangles.push_back(corners);
    result.of_triangle.push_back(static_cast<int>(t));
  }
  return result;
}

}  // namespace

Thinned thinned(const mesh::TriangleSurface& surface, std::size_t most) {
  std::vector<int> of_vertex(surface.vertices.size());
  for (std::size_t v = 0; v < of_vertex.size(); ++v) of_vertex[v] = static_cast<int>(v);
  if (surface.vertices.size() <= most) return kept(surface, of_vertex);
  Eigen::AlignedBox3d box;
  for (const auto& x : surface.vertices) box.extend(x);
  const auto normal = normals(surface);
  double cell = box.diagonal().norm() / 1000.0;
  Thinned result = kept(surface, clustered(surface, normal, cell));
  for (int step = 0; step < 40 && result.vertices.size() > most; ++step) {
    cell *= std::max(1.1, std::sqrt(static_cast<double>(result.vertices.size()) / static_cast<double>(most)));
    result = kept(surface, clustered(surface, normal, cell));
  }
  return result;
}

Quantised quantised(const Eigen::Ref<const Eigen::MatrixXd>& values, int largest, bool centred) {
  Quantised result;
  const Eigen::RowVectorXd low = values.colwise().minCoeff(), high = values.colwise().maxCoeff();
  result.origin = centred ? Eigen::RowVectorXd(0.5 * (low + high)) : Eigen::RowVectorXd::Zero(values.cols());
  const double reach =
      std::max((high - result.origin).cwiseAbs().maxCoeff(), (low - result.origin).cwiseAbs().maxCoeff());
  if (reach > 0.0) result.step = reach / largest;
  result.numbers.reserve(static_cast<std::size_t>(values.size()));
  for (Eigen::Index i = 0; i < values.rows(); ++i) {
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      result.numbers.push_back(static_cast<std::int16_t>(std::lround((values(i, j) - result.origin(j)) / result.step)));
  }
  return result;
}

}  // namespace thinwall::report
