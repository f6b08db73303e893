// The lowest modes of a steel strip, 200 × 20 × 2 mm, clamped at one end.
#include <cstdio>
#include <thinwall/fem/fem.hpp>
#include <thinwall/mesh/mesh.hpp>

using namespace thinwall;

int main() {
  const mesh::Box strip{{0.2, 0.02, 0.002}};
  const fem::Material steel{.youngs_modulus_Pa = 210e9, .poisson_ratio = 0.3, .density_kg_m3 = 7850.0};
  const fem::Support clamp{"foot", mesh::face_of(strip, "x_min")};

  const fem::Model model = fem::supported_model(mesh::mesh_box(strip, {.size_m = 0.02}), 4, steel, {clamp});
  const fem::Modes modes = fem::modes(model, fem::factorise(model), {.count = 6});

  std::printf("mass %.6f kg\n", model.mass.mass_kg);
  for (const double hz : modes.frequency_hz) std::printf("mode %.3f Hz\n", hz);
}
