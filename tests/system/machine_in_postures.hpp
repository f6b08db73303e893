#pragma once
// A machine in postures with either of two tools, which is known without a swap.

#include <gtest/gtest.h>

#include <complex>
#include <string>

#include "coupling/spatial.hpp"
#include "fem/beam.hpp"
#include "tests/replaced.hpp"
#include "tests/system/run_in_folder.hpp"
#include "tests/system/swapped_tools.hpp"
#include "tests/verification/tool_swap/machine.hpp"

namespace thinwall::tests::swap_on_robot {

namespace fs = std::filesystem;
namespace machine = coupling::testing;
using Complex = std::complex<double>;
using Eigen::Vector3d;
using swapped_tools::carbide;
using swapped_tools::reference;
using swapped_tools::target;

/// The machine in posture u, without the rest of its tool: bearings that stiffen along x and soften along y.
inline dynamics::SpatialModel machine_at(double u) {
  fem::BeamFrame frame;
  frame.nodes = {{0.06 * Vector3d::UnitZ(), "nose"},
                 {0.10 * Vector3d::UnitZ()},
                 {0.30 * Vector3d::UnitZ()},
                 {Vector3d::Zero(), "holder"}};
  frame.segments = {{0, 1, dynamics::section(machine::steel(0.060)), 1},
                    {1, 2, dynamics::section(machine::steel(0.055, 0.020)), 2},
                    {3, 0, dynamics::section(machine::steel(0.034, 0.012)), 2}};
  frame.springs = machine::spindle_frame().springs;
  for (fem::NodeSpring& bearing : frame.springs) {
    bearing.stiffness(0, 0) *= 1.0 + 0.1 * u;
    bearing.stiffness(1, 1) *= 1.0 - 0.05 * u;
    bearing.damping *= 3.0 + 0.3 * u;
  }
  dynamics::SpatialModel all = fem::spatial_model(frame);
  all.C += 1e-6 * all.K;
  return all;
}

/// The machine in posture u with a tool, which has no damping of its own.
inline dynamics::SpatialModel assembled(double u, const dynamics::SpatialModel& tool) {
  coupling::Contact held{"root", "holder", {}, {}};
  for (const auto kind : {dynamics::DofKind::translation, dynamics::DofKind::rotation}) {
    for (int axis = 0; axis < 3; ++axis) {
      held.springs.emplace_back();
      held.springs.back().direction = Vector3d::Unit(axis);
      held.springs.back().kind = kind;
    }
  }
  return coupling::couple({tool, machine_at(u)}, {held});
}

inline std::string tools(const std::string& target) {
  return R"([tool]
teeth = 2
diameter = "12 mm"
length = "40 mm"
[tool.swap]
up = "1a"
distance = "20 mm"
to = "6 kHz"
)" + swapped_tools::reference_table +
         "[[tool.swap.target]]\n" + target +
         R"([cutting]
radial_depth = "12 mm"
Kt = "800 N/mm^2"
Kr = "240 N/mm^2"
[lobes]
from = "8000 rpm"
to = "20000 rpm"
count = 8
most_added = 0
)";
}

inline fs::path own_folder() {
  return scratch(std::string("swap_on_robot_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
}

}  // namespace thinwall::tests::swap_on_robot
