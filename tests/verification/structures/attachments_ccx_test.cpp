// CalculiX as an oracle for attachments: two materials, a rigid body with a mass beside the part and springs to ground,
// on the same tet10 mesh. Skipped where ccx is absent.

#include <gtest/gtest.h>
#include <unistd.h>

#include <Eigen/Core>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "io/mesh/inp.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::attachments_ccx_test {
namespace {

const Eigen::Vector3d size(0.2, 0.05, 0.03);
// Next to no mass: CalculiX integrates that of its elements its own way. What moves is the body.
const fem::Material stiff{210e9, 0.3, 1e-3};
const fem::Material soft{70e9, 0.33, 1e-3};
const Eigen::Vector3d body_at(0.23, 0.035, 0.025);
const Eigen::Vector3d k(2e6, 4e6, 3e6);
const Eigen::Vector3d k_turn(8e3, 5e3, 6e3);

std::vector<int> halves(const mesh::TetMesh& mesh) {
  std::vector<int> of_tet;
  for (const auto& tet : mesh.tets) {
    double x = 0.0;
    for (const int v : tet) x += 0.25 * mesh.vertices[static_cast<std::size_t>(v)].x();
    of_tet.push_back(x < 0.1 ? 0 : 1);
  }
  return of_tet;
}

mesh::NodeSet nodes_at(const mesh::LagrangeNodes& nodes, const std::string& name, double x) {
  mesh::NodeSet set{name, {}};
  for (Eigen::Index i = 0; i < nodes.positions.rows(); ++i) {
    if (std::abs(nodes.positions(i, 0) - x) < 1e-9) set.nodes.push_back(static_cast<int>(i));
  }
  return set;
}

std::string material(const std::string& name, const std::string& elements, const fem::Material& m) {
  std::ostringstream text;
  text << "*MATERIAL, NAME=" << name << "\n*ELASTIC\n"
       << m.youngs_modulus_Pa << ", " << m.poisson_ratio << "\n*DENSITY\n"
       << m.density_kg_m3 << "\n*SOLID SECTION, ELSET=" << elements << ", MATERIAL=" << name << "\n";
  return text.str();
}

/// The deck after nodes, elements and node sets. A spring constant is read only with a decimal point.
std::string rest_of_deck(const mesh::LagrangeNodes& nodes, const std::vector<int>& of_tet, bool springs) {
  const auto reference = nodes.positions.rows() + 1;
  auto element = nodes.elements.rows() + 1;
  std::ostringstream text;
  text << "*NODE\n"
       << reference << ", " << body_at.x() << ", " << body_at.y() << ", " << body_at.z() << '\n'
       << reference + 1 << ", " << body_at.x() << ", " << body_at.y() << ", " << body_at.z() << '\n';
  for (const int which : {0, 1}) {
    text << "*ELSET, ELSET=HALF" << which << '\n';
    for (std::size_t tet = 0; tet < of_tet.size(); ++tet) {
      if (of_tet[tet] == which) text << tet + 1 << ",\n";
    }
  }
  text << material("STIFF", "HALF0", stiff) << material("SOFT", "HALF1", soft);
  text << "*ELEMENT, TYPE=MASS, ELSET=BODY\n" << element++ << ", " << reference << "\n*MASS, ELSET=BODY\n1.3\n";
  for (int axis = 0; springs && axis < 3; ++axis) {
    text << "*ELEMENT, TYPE=SPRING1, ELSET=T" << axis << '\n'
         << element++ << ", " << reference << "\n*SPRING, ELSET=T" << axis << '\n'
         << axis + 1 << '\n'
         << std::to_string(k(axis)) << '\n';
    text << "*ELEMENT, TYPE=SPRING1, ELSET=R" << axis << '\n'
         << element++ << ", " << reference + 1 << "\n*SPRING, ELSET=R" << axis << '\n'
         << axis + 1 << '\n'
         << std::to_string(k_turn(axis)) << '\n';
  }
  text << "*RIGID BODY, NSET=TIP, REF NODE=" << reference << ", ROT NODE=" << reference + 1
       << "\n*BOUNDARY\nFOOT, 1, 3\n*STEP\n*FREQUENCY\n3\n*END STEP\n";
  return text.str();
}

/// Frequencies in Hz from the first table of CalculiX's .dat file.
std::vector<double> frequencies_in(const std::filesystem::path& dat) {
  std::ifstream file(dat);
  std::vector<double> frequencies;
  for (std::string line; std::getline(file, line);) {
    if (line.find("P A R T I C I P A T I O N") != std::string::npos) break;
    std::istringstream words(line);
    int mode = 0;
    double lambda = 0.0;
    double omega = 0.0;
    double hz = 0.0;
    double imaginary = 0.0;
    if (words >> mode >> lambda >> omega >> hz >> imaginary) frequencies.push_back(hz);
  }
  return frequencies;
}

Eigen::VectorXd frequencies_here(const mesh::TetMesh& mesh, bool springs) {
  const mesh::Region foot = mesh::PlaneRegion{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX()};
  const mesh::Region tip = mesh::PlaneRegion{{0.2, 0, 0}, Eigen::Vector3d::UnitX()};
  const Eigen::Vector3d offset = body_at - Eigen::Vector3d(0.2, 0.025, 0.015);
  fem::Attachments attachments;
  attachments.points.push_back({"tip", tip, fem::Connection::rigid});
  attachments.masses.push_back({"tip", 1.3, Eigen::Matrix3d::Zero(), offset});
  if (springs) attachments.springs.push_back({"tip", k.asDiagonal(), k_turn.asDiagonal(), offset});
  const fem::Model model = fem::supported_model(mesh, 2, fem::Materials{{stiff, soft}, halves(mesh)},
                                                {{"foot", foot, {0, 1, 2}}}, {}, attachments);
  const fem::Factored factored = fem::factorise(model);
  return fem::modes(model, factored, {.count = 3, .up_to_hz = {}}).frequency_hz;
}

TEST(CalculiXAttachments, HaveTheSameFrequencies) {
  if (std::system("command -v ccx > /dev/null 2>&1") != 0)
    GTEST_SKIP() << "ccx is not installed (Debian's package calculix-ccx)";
  const auto folder =
      std::filesystem::temp_directory_path() / ("thinwall_ccx_attachments_" + std::to_string(::getpid()));
  std::filesystem::create_directories(folder);
  const mesh::TetMesh mesh = mesh::kuhn_box(size, {6, 2, 2});
  const auto nodes = mesh::lagrange_nodes(mesh, 2);
  for (const bool springs : {false, true}) {
    io::write_inp(folder / "part.inp", nodes, {nodes_at(nodes, "FOOT", 0.0), nodes_at(nodes, "TIP", 0.2)}, {});
    std::ofstream(folder / "part.inp", std::ios::app) << rest_of_deck(nodes, halves(mesh), springs);
    const std::string command = "cd '" + folder.string() + "' && OMP_NUM_THREADS=1 ccx part > ccx.log 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << "see ccx.log";
    const std::vector<double> expected = frequencies_in(folder / "part.dat");
    ASSERT_EQ(expected.size(), 3U);
    const Eigen::VectorXd found = frequencies_here(mesh, springs);
    for (Eigen::Index i = 0; i < 3; ++i) {
      EXPECT_NEAR(found(i) / expected[static_cast<std::size_t>(i)], 1.0, 1e-6);
      std::printf("ccx %s springs: %.9g Hz, here %.9g\n", springs ? "with" : "without",
                  expected[static_cast<std::size_t>(i)], found(i));
    }
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace thinwall::attachments_ccx_test
