// A case that was loaded holds all that its files say: a run gives the same without them, and opens none.

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "core/atomic_file.hpp"
#include "dynamics/conversion.hpp"
#include "io/frf/uff.hpp"
#include "io/results/csv_table.hpp"
#include "io/surface/stl.hpp"
#include "mesh/box.hpp"
#include "mesh/surface/shapes.hpp"
#include "tests/case/case_text.hpp"
#include "tests/case/opened_files.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::data_files_system_test {

using namespace app;
using namespace cases;

namespace {

namespace fs = std::filesystem;

/// A run with its files there, and one whose files are gone after the load, have one summary but for the times.
void expect_no_need_of_files(const std::string& text, const fs::path& folder, std::size_t files) {
  const Case kept = parse_case(text, folder), emptied = parse_case(text, folder);
  ASSERT_EQ(input_files(kept).size(), files);
  OpenedFiles opened(folder);
  nlohmann::json with_files = report::summary_json(run_case(kept, {folder / "kept", true, -1, false}).summary);
  for (const fs::path& file : input_files(kept)) EXPECT_EQ(opened.count(file), 0) << file;
  for (const fs::path& file : input_files(emptied)) fs::remove(file);
  nlohmann::json without_files = report::summary_json(run_case(emptied, {folder / "emptied", true, -1, false}).summary);
  with_files.erase("timings_s");
  without_files.erase("timings_s");
  EXPECT_EQ(with_files, without_files) << nlohmann::json::diff(with_files, without_files).dump(2);
  const auto inputs = [&](const char* name) {
    return nlohmann::json::parse(core::read_file(folder / name / "manifest.json")).at("inputs");
  };
  EXPECT_EQ(inputs("kept"), inputs("emptied"));
}

/// A CSV with the receptance of one mass (kg) on a spring.
void write_receptance(const fs::path& file, double mass) {
  std::ostringstream text;
  text.precision(17);
  for (double hz = 2.0; hz <= 3000.0; hz += 2.0) {
    const double omega = 2.0 * std::numbers::pi * hz;
    const std::complex<double> H = 1.0 / std::complex<double>(1e6 - omega * omega * mass, 30.0 * omega);
    text << hz << ',' << H.real() << ',' << H.imag() << '\n';
  }
  core::write_file_atomically(file, text.str());
}

std::string frf(const std::string& owner, const std::string& dof, const std::string& file) {
  return "[[" + owner + ".measured]]\nresponse = \"" + dof + "\"\nforce = \"" + dof + "\"\nfile = \"" + file +
         "\"\nquantity = \"receptance\"\nunit = \"m/N\"\nnoise = 0.01\n";
}

TEST(DataFiles, AMeasuredPartOnAMeasuredRobotByATableOfAContactIsRunWithoutThem) {
  const fs::path folder = scratch("data_files_measured");
  write_receptance(folder / "part.csv", 2.0);
  write_receptance(folder / "robot.csv", 5.0);
  core::write_file_atomically(folder / "pad.csv",
                              "preload_n,stiffness_n_per_m,damping_n_s_per_m\n10,1e6,20\n40,3e6,35\n80,4e6,30\n");
  expect_no_need_of_files(frf("part", "P.x", "part.csv") + "[robot]\nmodel = \"measured\"\n" +
                              frf("robot", "R.x", "robot.csv") +
                              "[[contacts]]\npart = \"P\"\nmodel = \"table\"\npreload = \"40 N\"\ntable = \"pad.csv\"\n"
                              "[response]\nfrom = \"20 Hz\"\nto = \"500 Hz\"\nlines = 241\n",
                          folder, 3);
}

TEST(DataFiles, AChartOfAMeasuredToolIsRunWithoutItsFile) {
  const fs::path folder = scratch("data_files_tool");
  write_receptance(folder / "tip.csv", 0.04);
  const std::string cutter = cutter_case();
  const auto modes = cutter.find("[[tool.modes]]"), cutting = cutter.find("[cutting]");
  expect_no_need_of_files(cutter.substr(0, modes) + frf("tool", "x", "tip.csv") + cutter.substr(cutting), folder, 1);
}

const std::string wall = R"([part]
file = "wall.stl"
unit = "m"
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "15 mm"
order = 2
[[part.supports]]
on = "y_min"
[points.P]
position = ["30 mm", "100 mm", "4 mm"]
patch_radius = "4 mm"
[modes]
count = 3
[reduction]
modes = 8
[damping]
from_frf = { response = "P.z", force = "P.z", file = "wall.csv", quantity = "receptance", unit = "m/N" }
[response]
to = "1500 Hz"
lines = 50
)";

/// An arm of two joints, both about y, and what its URDF does not tell.
void write_arm(const fs::path& folder) {
  core::write_file_atomically(folder / "two.urdf", R"(<robot name="two"><link name="base"/>
<link name="a"><inertial><origin xyz="0 0 0.3"/><mass value="30"/><inertia ixx="2" iyy="2" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="b"><inertial><origin xyz="0 0 0.2"/><mass value="10"/><inertia ixx="1" iyy="1" izz="0.5" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="tool"/>
<joint name="j1" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/></joint>
<joint name="j2" type="continuous"><parent link="a"/><child link="b"/><origin xyz="0 0 0.7"/><axis xyz="0 1 0"/></joint>
<joint name="f" type="fixed"><parent link="b"/><child link="tool"/><origin xyz="0 0 0.5"/></joint>
</robot>)");
  core::write_file_atomically(folder / "joints.toml",
                              "[[joints]]\nname = \"j1\"\nstiffness = \"2e6 N m/rad\"\n"
                              "[[joints]]\nname = \"j2\"\nstiffness = \"1e6 N m/rad\"\n");
}

/// The wall's first resonance as a measurement of it gives it, some per cent beside the model's.
void write_wall_frf(const fs::path& file, double hz) {
  std::ostringstream text;
  text.precision(17);
  for (double f = 2.0; f <= 3000.0; f += 1.0) {
    const std::complex<double> H = 1.0 / (1.0 - std::pow(f / hz, 2) + std::complex<double>(0.0, 0.04 * f / hz));
    text << f << ',' << 1e-6 * H.real() << ',' << 1e-6 * H.imag() << '\n';
  }
  core::write_file_atomically(file, text.str());
}

TEST(DataFiles, AFitOfASurfaceHeldByAnArmFromAUrdfIsRunWithoutThem) {
  const fs::path folder = scratch("data_files_urdf");
  io::write_stl(folder / "wall.stl", mesh::soup(mesh::triangulated(mesh::surface(mesh::Box{{0.06, 0.1, 0.004}}))), 1.0);
  write_arm(folder);
  write_wall_frf(folder / "wall.csv", 325.0);  // (3.516/2π) √(E/12ρ) t/l² of a beam is 324 Hz
  const std::string text = wall + R"([robot]
model = "flexible_joints"
urdf = "two.urdf"
joints = "joints.toml"
[robot.base]
position = ["0.1 m", 0, 0]
[robot.posture]
joints = [0.3, 0.4]
[[contacts]]
part = "P"
directions = "z"
stiffness = "1e5 N/m"
[[updating]]
name = "contact"
on = "coupled"
parameters = [{ key = "contacts[0].stiffness", lower = "1e3 N/m", upper = "1e7 N/m" }]
targets = [{ quantity = "coupled_frequency", value = "500 Hz", point = "P.z", match = "number", rank = 3 }]
)";
  expect_no_need_of_files(text, folder, 4);
  const nlohmann::json fits =
      nlohmann::json::parse(core::read_file(folder / "emptied" / "summary.json")).at("updating");
  ASSERT_EQ(fits.size(), 1U);
  EXPECT_GE(fits[0]["evaluations"].get<int>(), 3) << "the arm is bound anew for each of them";
}

TEST(DataFiles, APartOfMatricesIsRunWithoutThem) {
  const fs::path folder = scratch("data_files_matrices");
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n2 2 ";
  core::write_file_atomically(folder / "k.mtx", head + "3\n1 1 200\n2 1 -100\n2 2 100\n");
  core::write_file_atomically(folder / "m.mtx", head + "2\n1 1 0.001\n2 2 0.001\n");
  core::write_file_atomically(folder / "dofs.csv", "node,component,point\n3,x,A\n8,x,B\n");
  expect_no_need_of_files(
      "[part]\nmass_unit = \"t\"\nunit = \"mm\"\n[part.matrices]\nstiffness = \"k.mtx\"\nmass = \"m.mtx\"\ndofs = "
      "\"dofs.csv\"\n[points.B]\ndirections = \"x\"\n[modes]\ncount = 1\n[reduction]\nmodes = 1\n[damping]\nratio = "
      "0.01\n[response]\nto = \"200 Hz\"\nlines = 20\n",
      folder, 3);
}

}  // namespace
}  // namespace thinwall::tests::data_files_system_test
