#include "study/lobes/stand_in.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "mesh/planar/prism.hpp"
#include "mesh/polygon.hpp"
#include "setup/identified/identify.hpp"
#include "setup/identified/posture_tables.hpp"
#include "setup/imported_part.hpp"
#include "setup/measured.hpp"
#include "setup/robot_tip.hpp"
#include "study/lobes/cut_structure.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

using std::complex;

/// The plate that stands in for a part: its thinnest extent, the floor of a prism with the densest modes, or the
/// mean wall of a surface.
struct Plate {
  double thickness_m = 0.0, area_m2 = 0.0, mass_kg = 0.0, wave_speed_m_s = 5000.0;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();
};

/// Takes the regions of one thickness, t, with the area A together, whose modes are densest (t/A is least) in place of
/// a plate with sparser ones: the lowest modes are theirs. Zones count whole, though later ones may cover them.
void take_densest_floor(const mesh::Prism& prism, Plate& plate) {
  struct Region {
    double thickness_m, area_m2;
  };
  const auto area = [](const mesh::Polygon& outline) { return std::abs(mesh::signed_area(outline)); };
  std::vector<Region> regions{{prism.top - prism.bottom, area(prism.outline)}};
  for (const mesh::Polygon& hole : prism.holes) regions.front().area_m2 -= area(hole);
  for (const mesh::Zone& zone : prism.zones) {
    regions.push_back({zone.top - zone.bottom, area(zone.outline)});
    regions.front().area_m2 -= regions.back().area_m2;
  }
  for (const Region& region : regions) {
    double together = 0.0;
    for (const Region& r : regions) {
      const bool as_thick = std::abs(r.thickness_m - region.thickness_m) <= 0.01 * region.thickness_m;
      if (as_thick && r.area_m2 > 0.0) together += r.area_m2;
    }
    if (region.thickness_m * plate.area_m2 >= together * plate.thickness_m) continue;
    plate = {.thickness_m = region.thickness_m, .area_m2 = together, .normal = Eigen::Vector3d::UnitZ()};
  }
}

Plate plate_like(const setup::Part& part) {
  Eigen::Vector3d size = setup::box_size(part);
  if (!(size.minCoeff() > 0.0)) size = {0.005, 0.2, 0.2};  // matrices without positions
  Eigen::Index thin = 0;
  Plate plate;
  plate.thickness_m = size.minCoeff(&thin);
  plate.normal = Eigen::Vector3d::Unit(thin);
  plate.area_m2 = size.prod() / plate.thickness_m;
  if (const auto* shape = std::get_if<setup::PrismShape>(&part.shape)) take_densest_floor(shape->prism, plate);
  if (part.imported && part.imported->surface) {
    double area = 0.0;
    const mesh::TriangleSurface& surface = part.imported->surface->surface;
    for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t) area += mesh::area_vector(surface, t).norm();
    plate.area_m2 = 0.5 * area;
    plate.thickness_m = part.imported->surface->volume_m3 / plate.area_m2;
  }
  const setup::Material& m = part.material;
  const double density = m.density > 0.0 ? m.density : 2700.0;
  if (m.youngs_modulus > 0.0) plate.wave_speed_m_s = std::sqrt(m.youngs_modulus / density);
  plate.mass_kg = density * plate.area_m2 * plate.thickness_m;
  return plate;
}

/// The direction in which mode k of a part moves: the wall's normal and a tenth along the other axes, for no mode keeps
/// to one direction; the walls of a part from a file stand in any.
Eigen::Vector3d direction_of_mode(const setup::Part& part, const Plate& plate, Eigen::Index k) {
  const Eigen::Vector3d main = setup::from_file(part) ? Eigen::Vector3d(Eigen::Vector3d::Unit(k % 3)) : plate.normal;
  const Eigen::Vector3d beside(1.0, k % 2 == 0 ? 1.0 : -1.0, k % 4 < 2 ? 1.0 : -1.0);
  return (main + 0.1 * beside).normalized();
}

/// A mode at the highest resonance of each measured direction, as damped as tools are.
std::vector<setup::TipMode> highest_resonances(const setup::Tool& tool) {
  constexpr double damping_ratio = 0.02;
  std::vector<setup::TipMode> modes;
  for (const setup::MeasuredFrf& file : tool.measured) {
    if (file.response != file.force) continue;
    const io::MeasuredFrf& lines = setup::receptance_of(file);
    Eigen::Index line = 0;
    const double peak = lines.H.cwiseAbs().maxCoeff(&line);
    if (peak > 0.0)
      modes.push_back({lines.axis.hz(line), damping_ratio, 1.0 / (2.0 * damping_ratio * peak),
                       Eigen::Vector3d::Unit(direction_of_dof(file.response))});
  }
  return modes;
}

}  // namespace

setup::Setup before_identification(setup::Setup source) {
  if (setup::awaits_fit(source)) {
    source.tool->modes = highest_resonances(*source.tool);
    source.tool->measured.clear();
  }
  if (setup::awaits_learning(source)) {
    auto& robot = std::get<setup::TabledRobot>(source.robot->model);
    robot = setup::as_first_posture(robot);
  }
  setup::give_modes_to_swap(source, source);
  return source;
}

milling::RelativeStructure modes_like(const setup::Setup& source) {
  constexpr double damping_ratio = 0.01;
  const Plate plate = plate_like(*source.part);
  const double apart_hz = 2.0 * plate.wave_speed_m_s * plate.thickness_m / (std::sqrt(12.0) * plate.area_m2);
  const setup::ModeRange& range = source.reduction.fixed_interface;
  const double charted_hz = source.lobes ? source.lobes->modes_up_to_hz.value_or(INFINITY) : INFINITY;
  const double highest_hz = std::min(range.up_to_hz.value_or(INFINITY), charted_hz);
  const int most = range.up_to_hz ? 300 : range.count.value_or(setup::usual_reduction_modes);
  const auto count = static_cast<Eigen::Index>(std::clamp(highest_hz / apart_hz, 1.0, static_cast<double>(most)));
  milling::RelativeStructure structure{Eigen::VectorXcd(count), Eigen::Matrix3Xcd(3, count),
                                       Eigen::Matrix3Xcd(3, count)};
  for (Eigen::Index k = 0; k < count; ++k) {
    const double omega = 2.0 * std::numbers::pi * apart_hz * static_cast<double>(k + 1);
    const double damped = omega * std::sqrt(1.0 - damping_ratio * damping_ratio);
    structure.poles(k) = {-damping_ratio * omega, damped};
    structure.phi.col(k) =
        (2.0 / std::sqrt(plate.mass_kg) * direction_of_mode(*source.part, plate, k)).cast<complex<double>>();
    structure.b.col(k) = structure.phi.col(k) / complex<double>(0.0, 2.0 * damped);
  }
  return structure;
}

std::optional<milling::RelativeStructure> poles_like(const setup::Setup& given,
                                                     const std::optional<milling::RelativeStructure>& of_part) {
  const setup::Setup source = before_identification(given);
  std::optional<Component> robot;
  if (setup::robot_beside_tool(source, source)) {
    robot = robot_component(*source.robot, {Eigen::VectorXd::Ones(1)}, setup::robot_posture(source, source).posture);
  }
  std::optional<milling::RelativeStructure> poles =
      cut_poles(source, nullptr, robot ? &carrier_modes(*robot) : nullptr);
  if (!source.part) return poles;
  const milling::RelativeStructure part = of_part ? *of_part : modes_like(source);
  return poles ? milling::sum(*poles, part) : part;
}

}  // namespace thinwall::study
