#include "mesh/planar/prism_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/error.hpp"
#include "mesh/planar/border_graph.hpp"
#include "mesh/planar/planar_mesh.hpp"
#include "mesh/planar/sweep.hpp"
#include "mesh/solid/quality.hpp"

namespace thinwall::mesh {

namespace {

/// Largest number of cells; a size that would give more is most likely in the wrong unit.
constexpr double most_cells = 1e6;

void check_size(const PrismMeshOptions& options, const Prism& prism, std::vector<std::string>& found) {
  std::ostringstream text;
  if (!(options.size_m > 0.0) || !std::isfinite(options.size_m)) {
    text << "size is " << options.size_m * 1e3 << " mm; it must be above 0";
    found.push_back(text.str());
    return;
  }
  const double area = std::abs(signed_area(prism.outline));
  if (area / (options.size_m * options.size_m) <= most_cells) return;
  text << "size is " << options.size_m * 1e3 << " mm, which makes more than " << most_cells
       << " cells in the plane; it must be at least " << std::sqrt(area / most_cells) * 1e3 << " mm";
  found.push_back(text.str());
}

void check_spots(const PrismMeshOptions& options, const Prism& prism, std::vector<std::string>& found) {
  const double least = 1e-6 * diagonal(prism);
  for (std::size_t i = 0; i < options.spots.size(); ++i) {
    const Spot& spot = options.spots[i];
    if (spot.at.allFinite() && spot.radius_m >= least && std::isfinite(spot.radius_m)) continue;
    std::ostringstream text;
    text << "spot " << i + 1 << " at (" << spot.at.x() * 1e3 << ", " << spot.at.y() * 1e3 << ") mm has radius "
         << spot.radius_m * 1e3 << " mm; it must be at least " << least * 1e3 << " mm (1e-6 of the part's diagonal)";
    found.push_back(text.str());
  }
}

void check_heights(const TetMesh& mesh, double diagonal) {
  const double least = 1e-9 * diagonal;
  for (std::size_t tet = 0; tet < mesh.tets.size(); ++tet) {
    const double height = smallest_height(mesh, static_cast<int>(tet));
    if (height > least) continue;
    const Eigen::Vector3d p = 1e3 * mesh.vertices[static_cast<std::size_t>(mesh.tets[tet][0])];
    std::ostringstream text;
    text << "the grading collapses an element at (" << p.x() << ", " << p.y() << ", " << p.z() << ") mm to a height of "
         << height * 1e3 << " mm; it must be above " << least * 1e3
         << " mm (1e-9 of the part's diagonal): take fewer layers or a larger size";
    throw core::InputError(text.str());
  }
}

void check_volume(const TetMesh& mesh, const Prism& prism) {
  const double found = volume(mesh);
  const double expected = volume(prism);
  if (std::abs(found - expected) <= 1e-12 * expected) return;
  std::ostringstream text;
  text.precision(15);
  text << "the mesh's volume is " << found * 1e9 << " mm³, the part's " << expected * 1e9
       << " mm³, and they must agree to 1e-12: move borders that nearly touch apart, or take fewer layers";
  throw core::NumericalError(text.str());
}

}  // namespace

std::vector<std::string> violations(const PrismMeshOptions& options, const Prism& prism) {
  std::vector<std::string> found;
  const auto check = [&](bool holds, const std::string& name, double value, const std::string& bound) {
    if (holds) return;
    std::ostringstream text;
    text << name << " is " << value << "; " << bound;
    found.push_back(text.str());
  };
  check_size(options, prism, found);
  check(options.layers >= 0 && options.layers <= 8, "layers", options.layers, "give 0 to 8");
  check(options.layer_width_m >= 0.0 && std::isfinite(options.layer_width_m), "layer_width (m)", options.layer_width_m,
        "give a length, or 0 for the wall's thickness");
  check(options.layer_factor >= 0.1 && options.layer_factor <= 0.5, "layer_factor", options.layer_factor,
        "give 0.1 to 0.5");
  check(options.spot_growth >= 0.2 && options.spot_growth <= 10.0, "spot_growth", options.spot_growth,
        "give 0.2 to 10");
  check_spots(options, prism, found);
  return found;
}

double wanted_size(const PrismMeshOptions& options, const Eigen::Vector2d& p) {
  double size = options.size_m;
  for (const auto& spot : options.spots)
    size = std::min(size, std::max(spot.radius_m, options.spot_growth * (p - spot.at).norm()));
  return size;
}

std::vector<double> layer_distances(int layers, double factor) {
  std::vector<double> distances;
  double sum = 0.0;
  for (int layer = 0; layer < layers; ++layer) {
    sum += std::pow(factor, layers - 1 - layer);
    distances.push_back(sum);
  }
  return distances;
}

TetMesh mesh_prism(const Prism& prism, const PrismMeshOptions& options) {
  validate(prism);
  std::string faults;
  for (const auto& violation : violations(options, prism)) faults += (faults.empty() ? "" : "; ") + violation;
  if (!faults.empty()) throw core::InputError(faults);
  const Prism clean = cleaned(prism);
  const BorderGraph graph = border_graph(clean);
  const PlanarMesh plane =
      rectilinear(graph) ? tensor_grid(clean, graph, options) : planar_delaunay(clean, graph, options);
  TetMesh mesh = sweep(plane, levels(plane, options, 1e-6 * diagonal(clean)));
  check_heights(mesh, diagonal(clean));
  check_volume(mesh, clean);
  return mesh;
}

}  // namespace thinwall::mesh
