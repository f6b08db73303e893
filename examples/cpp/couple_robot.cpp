// The same strip, reduced to its tip and joined there to a robot of one mode, by matrices and by receptances.
#include <cstdio>
#include <thinwall/coupling/coupling.hpp>
#include <thinwall/fem/fem.hpp>
#include <thinwall/mesh/mesh.hpp>
#include <thinwall/reduction/reduction.hpp>
#include <thinwall/robot/robot.hpp>

using namespace thinwall;

int main() {
  const mesh::Box strip{{0.2, 0.02, 0.002}};
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const fem::Material steel{.youngs_modulus_Pa = 210e9, .poisson_ratio = 0.3, .density_kg_m3 = 7850.0};
  const fem::Support clamp{"foot", mesh::face_of(strip, "x_min")};
  const fem::Model model = fem::supported_model(mesh::mesh_box(strip, {.size_m = 0.02}), 4, steel, {clamp});
  const fem::Factored factored = fem::factorise(model);

  const fem::NamedPoint tip{.name = "P", .directions = {z}, .faces = mesh::face_of(strip, "x_max")};
  const reduction::Interface interface {
    fem::point_columns(model, tip), {
      { "P", z }
    }
  };
  const auto reduced = reduction::craig_bampton(model.K, model.M, fem::inverse_of(factored), interface, {.modes = 15});
  const auto part = reduction::with_modal_damping(reduced.model, {}, 0.01);
  const auto robot = robot::spatial_model({robot::one_mode(30.0, 0.02, 2e3, z)}, "R");

  const coupling::Contact contact{"P", "R", {{.direction = z}}};
  const auto together = dynamics::to_modal(coupling::couple(part, robot, {contact}));
  for (const int k : dynamics::oscillating_modes(together))
    std::printf("mode %.3f Hz\n", dynamics::summarise(together.poles(k)).frequency_hz);

  const auto axis = dynamics::linear_axis(1.0, 400.0, 400);
  const auto response = [&](const dynamics::SpatialModel& component) {
    return dynamics::to_response(dynamics::to_modal(component), axis);
  };
  const auto coupled = coupling::couple(response(part), response(robot), {contact});
  const auto difference = coupling::route_difference(dynamics::to_response(together, axis), coupled.response);
  std::printf("routes differ by %.1e\n", difference.max_relative);
}
