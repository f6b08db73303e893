// Compiled by programs_test.sh for several vector units and linked to one library: structs that hold Eigen's fixed-size
// vectors, and storage that one side allocates and the other frees, must mean the same to both.
#include <cstdio>
#include <cstdlib>
#include <thinwall/dynamics/dynamics.hpp>
#include <thinwall/mesh/mesh.hpp>
#include <thinwall/reduction/reduction.hpp>

using namespace thinwall;

namespace {

void require(bool holds, const char* what) {
  if (holds) return;
  std::printf("FAILED: %s\n", what);
  std::exit(1);
}

/// Located holds a Vector4d behind an int: its place and the size of the struct follow from the alignment.
void locations_come_back_in_one_piece() {
  const mesh::TetMesh mesh = mesh::mesh_box({{0.1, 0.1, 0.01}}, {.size_m = 0.05});
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(0.05, 0.05, 0.01), Eigen::Vector3d(0.013, 0.077, 0.004)}) {
    const mesh::Located found = mesh::locate(mesh, x);
    const auto& tet = mesh.tets.at(static_cast<std::size_t>(found.location.tet));
    Eigen::Vector3d back = Eigen::Vector3d::Zero();
    for (int k = 0; k < 4; ++k)
      back += found.location.lambda[k] * mesh.vertices[static_cast<std::size_t>(tet[static_cast<std::size_t>(k)])];
    require(found.distance_m == 0.0, "the place lies in the part");
    require((back - x).norm() < 1e-12, "the coordinates give the place");
  }
}

/// Matrices that this program allocates, the library resizes and frees, and the other way round.
void storage_changes_hands() {
  for (int round = 0; round < 200; ++round) {
    const int n = 1 + round % 7;
    dynamics::SpatialModel model;
    model.M = Eigen::MatrixXd::Identity(n, n);
    model.K = 4.0 * Eigen::MatrixXd::Identity(n, n);
    model.C = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i < n; ++i) model.dofs.push_back({"P" + std::to_string(i), Eigen::Vector3d::UnitX()});
    model = reduction::with_modal_damping(std::move(model), {}, 0.25);  // C = 2 ζ ω M = M
    require((model.C - model.M).norm() < 1e-12, "C = M");
    model.C.resize(n + 3, n + 3);
  }
}

}  // namespace

int main() {
  locations_come_back_in_one_piece();
  storage_changes_hands();
  std::printf("alignment holds\n");
}
