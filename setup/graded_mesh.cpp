#include "setup/graded_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/planar/box_mesh.hpp"
#include "mesh/planar/prism_mesh.hpp"
#include "setup/part_geometry.hpp"

namespace thinwall::setup {

namespace {

double thinnest(const mesh::Prism& prism) {
  double t = prism.top - prism.bottom;
  for (const auto& zone : prism.zones) t = std::min(t, zone.top - zone.bottom);
  return t;
}

/// About the frequency (Hz) of the highest mode wanted: of a plate N modes lie below N · 2 c_L t / (√12 A), less what
/// free edges add to their number; c_L the speed of longitudinal waves in a plate (Cremer, Heckl & Petersson 2005).
double highest_frequency(const PartSetup& source, const mesh::Prism& prism) {
  if (source.modes.range.up_to_hz) return *source.modes.range.up_to_hz;
  const Material& m = source.part->material;
  const double wave_speed = std::sqrt(m.youngs_modulus / (m.density * (1.0 - m.poisson_ratio * m.poisson_ratio)));
  const double t = thinnest(prism);
  const double area = mesh::volume(prism) / t;
  return 0.6 * source.modes.range.count.value_or(10) * 2.0 * wave_speed * t / (std::sqrt(12.0) * area);
}

/// Length of a bending wave of a plate, 2π (E t² / (12 (1−ν²) ρ ω²))^¼, m.
double bending_wavelength(const Material& m, double thickness, double hz) {
  const double omega = 2.0 * std::numbers::pi * hz;
  const double stiffness_over_mass = m.youngs_modulus * thickness * thickness /
                                     (12.0 * (1.0 - m.poisson_ratio * m.poisson_ratio) * m.density * omega * omega);
  return 2.0 * std::numbers::pi * std::pow(stiffness_over_mass, 0.25);
}

}  // namespace

mesh::TetMesh graded_mesh(const PartSetup& source, int level) {
  const PlanarPart part = planar(*source.part);
  const Eigen::Vector3d size = box_size(*source.part);
  const double wave =
      bending_wavelength(source.part->material, thinnest(part.prism), highest_frequency(source, part.prism));
  const double widest = std::max(size[part.axes[0]], size[part.axes[1]]);
  mesh::PrismMeshOptions options;
  options.size_m = source.part->mesh.element_size.value_or(std::min(0.3 * wave, 0.5 * widest) / std::pow(1.5, level));
  options.layers = (mesh::has_reentrant_edge(part.prism) ? 2 : 1) + level;
  options.spot_growth = level == 0 ? 4.0 : 2.0;
  for (const Point& p : source.points) {
    if (p.patch_radius <= 0.0) continue;
    const Eigen::Vector3d x = position(*source.part, p);
    options.spots.push_back({{x[part.axes[0]], x[part.axes[1]]}, p.patch_radius});
  }
  return mesh::in_axes(mesh::mesh_prism(part.prism, options), part.axes);
}

}  // namespace thinwall::setup
