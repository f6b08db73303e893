// The plate itself: finite elements, Craig-Bampton, a robot of one mode, both routes over the whole band.

#include <gtest/gtest.h>

#include <limits>

#include "coupling/receptance.hpp"
#include "coupling/route_difference.hpp"
#include "coupling/spatial.hpp"
#include "dynamics/conversion.hpp"
#include "fem/model.hpp"
#include "fem/points.hpp"
#include "fem/supports.hpp"
#include "mesh/volume/tetgen.hpp"
#include "reduction/damping.hpp"
#include "reduction/methods/craig_bampton.hpp"
#include "robot/one_mode.hpp"

namespace thinwall::finite_element_plate_test {
namespace {

/// The clamped plate, reduced to P and P2 with 40 fixed-interface modes, 1 % damping.
dynamics::SpatialModel reduced_plate() {
  const mesh::Box box{{0.006, 0.392, 0.100}};
  mesh::TetgenOptions options;
  options.element_size_m = 0.020;
  const auto face = [&](const char* name) { return fem::Support{name, mesh::face_of(box, name), {0, 1, 2}}; };
  const auto model = fem::supported_model(mesh::tetrahedralise(mesh::surface(box), options), 2, {210e9, 0.3, 7850.0},
                                          {face("y_min"), face("y_max")});
  const std::vector<Eigen::Vector3d> xyz{Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()};
  reduction::Interface interface;
  std::vector<Eigen::Triplet<double>> entries;
  for (const auto& [name, y] : {std::pair{"P", 0.196}, std::pair{"P2", 0.216}}) {
    const auto columns = fem::point_columns(model, {name, {0.006, y, 0.095}, 0.003, xyz});
    for (Eigen::Index j = 0; j < 3; ++j) {
      for (linalg::SparseMatrix::InnerIterator it(columns, j); it; ++it) {
        entries.emplace_back(static_cast<int>(it.row()), static_cast<int>(interface.dofs.size()), it.value());
      }
      interface.dofs.push_back({name, xyz[static_cast<std::size_t>(j)], dynamics::DofKind::translation});
    }
  }
  interface.W.resize(model.K.rows(), 6);
  interface.W.setFromTriplets(entries.begin(), entries.end());
  const auto factored = fem::factorise(model);
  const auto reduced =
      reduction::craig_bampton(model.K, model.M, fem::inverse_of(factored), interface, {.modes = 40, .up_to_hz = {}});
  return reduction::with_modal_damping(reduced.model, {0.0104, 0.033}, 0.01);
}

/// All nine entries at P and at P2, 2000 lines over 0.5–5000 Hz.
double worst_difference(const dynamics::SpatialModel& part, double stiffness) {
  const auto axis = dynamics::linear_axis(0.5, 5000.0, 2000);
  const auto robot = robot::spatial_model({robot::one_mode(29.0, 0.02, 1.24e6, Eigen::Vector3d::UnitX())}, "R");
  const std::vector<coupling::Contact> contacts{{"P", "R", {{Eigen::Vector3d::UnitX(), stiffness, 0.0, 0.0}}}};
  const auto H_part = dynamics::to_response(dynamics::to_modal(part), axis);
  const auto H_robot = dynamics::to_response(dynamics::to_modal(robot), axis);
  const auto receptance = coupling::couple(H_part, H_robot, contacts).response;
  const auto spatial = dynamics::direct_response(coupling::couple(part, robot, contacts), axis);
  double worst = 0.0;
  for (const char* point : {"P", "P2"})
    worst = std::max(worst, coupling::route_difference(spatial, receptance, point, point).max_relative);
  std::printf("plate, K = %g N/m: routes differ by %.1e\n", stiffness, worst);
  return worst;
}

TEST(FiniteElementPlate, RoutesAgreeForEveryContactStiffness) {
  const auto part = reduced_plate();
  for (const double stiffness : {1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, std::numeric_limits<double>::infinity()}) {
    EXPECT_LE(worst_difference(part, stiffness), 1e-9) << stiffness;
  }
  EXPECT_LE(worst_difference(part, 1e12), 1e-8);
}

}  // namespace
}  // namespace thinwall::finite_element_plate_test
