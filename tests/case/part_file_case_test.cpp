// A part whose shape comes from a file: what the case may say about it, and what reading it refuses.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "case/checks/checks.hpp"
#include "case/numbers.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "io/surface/stl.hpp"
#include "mesh/box.hpp"
#include "mesh/surface/shapes.hpp"
#include "report/geometry_summary.hpp"
#include "setup/graded_mesh.hpp"
#include "setup/imported_part.hpp"
#include "setup/part_geometry.hpp"
#include "setup/part_materials.hpp"
#include "study/kept/stage_keys.hpp"
#include "study/part/discretisation.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::tests::part_file_case_test {

using namespace setup;
using namespace cases;
using namespace study;

namespace {

/// A plate 100 x 60 x 4 mm, or of another thickness, with a corner at `corner` (m), in mm, with its first facets left
/// out.
void write_plate(const std::filesystem::path& file, const Eigen::Vector3d& corner = Eigen::Vector3d::Zero(),
                 int left_out = 0, double thickness_m = 0.004) {
  mesh::TriangleSoup soup = mesh::soup(mesh::triangulated(mesh::surface(mesh::Box{{0.1, 0.06, thickness_m}})));
  for (auto& x : soup.points) x += corner;
  soup.triangles.erase(soup.triangles.begin(), soup.triangles.begin() + left_out);
  io::write_stl(file, soup, 1e-3);
}

std::string surface_case(const std::string& keys) {
  return "[part]\n" + keys +
         "\n[part.material]\nyoungs_modulus = \"71 GPa\"\npoisson_ratio = 0.33\ndensity = \"2810 kg/m^3\"\n";
}

std::string problem_of(const std::string& keys, const std::filesystem::path& folder) {
  try {
    (void)parse_case(surface_case(keys), folder);
  } catch (const CaseError& error) {
    EXPECT_EQ(error.problems.size(), 1U) << error.what();
    return error.problems.front().text;
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no problem";
}

void expect_problem(const std::string& keys, const std::filesystem::path& folder, const std::string& part) {
  const std::string problem = problem_of(keys, folder);
  EXPECT_NE(problem.find(part), std::string::npos) << problem;
  EXPECT_EQ(problem.find('\n'), std::string::npos) << problem;
}

TEST(PartFile, ASurfaceIsReadInItsUnitAndPlaced) {
  const TemporaryFolder folder;
  write_plate(folder.path / "plate.stl", {0.5, 0.5, 0.5});
  const Case plain = parse_case(surface_case("file = \"plate.stl\"\nunit = \"mm\""), folder.path);
  ASSERT_TRUE(plain.part->imported);
  EXPECT_EQ(kind(*plain.part), ShapeKind::surface);
  EXPECT_EQ(plain.part->mesh.time_budget, 30.0);
  const Case slow =
      parse_case(surface_case("file = \"plate.stl\"\nunit = \"mm\"\nmesh.time_budget = \"5 min\""), folder.path);
  EXPECT_EQ(slow.part->mesh.time_budget, 300.0);
  EXPECT_LT((bounds(*plain.part).min() - Eigen::Vector3d::Constant(0.5)).norm(), 1e-7);
  EXPECT_LT((box_size(*plain.part) - Eigen::Vector3d(0.1, 0.06, 0.004)).norm(), 1e-7);
  const Case inch = parse_case(
      surface_case("file = \"plate.stl\"\nunit = \"inch\"\norigin = [\"500 inch\", \"500 inch\", \"500 inch\"]"),
      folder.path);
  EXPECT_LT((box_size(*inch.part) - 25.4 * Eigen::Vector3d(0.1, 0.06, 0.004)).norm(), 1e-6);
  EXPECT_LT(bounds(*inch.part).min().norm(), 1e-6);
  EXPECT_EQ(report::geometry_summary(*inch.part).read.find("2540 x 1524 x 101.6 mm"), 0U);
  EXPECT_EQ(input_files(inch).front(), folder.path / "plate.stl");
  const Case scaled = [&] {
    Case copy = plain;
    set_value(copy, "part.material.density", 2700.0);
    return copy;
  }();
  EXPECT_EQ(scaled.part->imported, plain.part->imported) << "a fit does not read the file again";
}

TEST(PartFile, KeysThatDoNotBelongAreRefused) {
  const TemporaryFolder folder;
  write_plate(folder.path / "plate.stl");
  const std::string good = "file = \"plate.stl\"\nunit = \"mm\"\n";
  EXPECT_EQ(problem_of(good, folder.path), "no problem");
  expect_problem("file = \"plate.stl\"", folder.path, "part.unit: missing; the file does not tell its unit");
  expect_problem("file = \"plate.stl\"\nunit = \"kg\"", folder.path, "part.unit: ");
  expect_problem("file = \"plate.stp2\"\nunit = \"mm\"", folder.path, "has an ending that is not read");
  expect_problem("shape = \"surface\"\nunit = \"mm\"\nthickness = \"4 mm\"\nfile = \"plate.stl\"", folder.path,
                 "part.thickness: belongs to part.shape = \"box\" or \"prism\", but it is \"surface\"");
  expect_problem("shape = \"surface\"\nunit = \"mm\"\n", folder.path, "part.file: missing");
  expect_problem(good + "length = \"100 mm\"", folder.path, "part.length: belongs to part.shape = \"box\"");
  expect_problem("file = \"plate.stl\"\nshape = \"prism\"\noutline = [[0, 0], [1, 0], [0, 1]]\nthickness = 0.1",
                 folder.path, "part.file: belongs to part.shape = \"surface\" or \"mesh\"");
  expect_problem(good + "[part.bend]\nradius = \"1 m\"", folder.path,
                 "part.bend: belongs to part.shape = \"box\" or \"prism\"");
  expect_problem(good + "[points.P]\nposition = [\"200 mm\", 0, 0]", folder.path, "lies outside the part");
  expect_problem(good + "[part.repair]\nlargest_hole = 200", folder.path, "part.repair.largest_hole");
}

TEST(PartFile, WhatTheFileHoldsIsRefusedWithItsNameAndPlace) {
  const TemporaryFolder folder;
  write_plate(folder.path / "open.stl", Eigen::Vector3d::Zero(), 1);
  write_plate(folder.path / "far.stl", {1000.0, 0.0, 0.0});
  core::write_file_atomically(folder.path / "broken.stl", "solid nothing\nfacet normal 0 0\n");
  expect_problem("file = \"open.stl\"\nunit = \"mm\"", folder.path, "3 edges with one triangle: the surface is open");
  expect_problem("file = \"open.stl\"\nunit = \"mm\"", folder.path, "open.stl: ");
  expect_problem("file = \"absent.stl\"\nunit = \"mm\"", folder.path, "absent.stl");
  expect_problem("file = \"broken.stl\"\nunit = \"mm\"", folder.path, "broken.stl:3");
  expect_problem("file = \"far.stl\"\nunit = \"mm\"", folder.path, "set part.origin to a place on it");
  EXPECT_EQ(problem_of("file = \"far.stl\"\nunit = \"mm\"\norigin = [\"1000 m\", 0, 0]", folder.path), "no problem");
  EXPECT_EQ(problem_of("file = \"open.stl\"\nunit = \"mm\"\n[part.repair]\nlargest_hole = 3", folder.path),
            "no problem");
}

TEST(PartFile, AFoilIsRefusedBeforeItIsMeshed) {
  const TemporaryFolder folder;
  const std::string foil = "file = \"foil.stl\"\nunit = \"mm\"";
  for (const double thickness : {1e-6, 1e-5}) {
    write_plate(folder.path / "foil.stl", Eigen::Vector3d::Zero(), 0, thickness);
    expect_problem(foil, folder.path,
                   "at order 2, and a first mesh of more than about 1e+06 is not made; check part.unit, or give "
                   "part.mesh.element_size");
    EXPECT_EQ(problem_of(foil + "\n[part.mesh]\nelement_size = \"5 mm\"", folder.path), "no problem");
    expect_problem(foil + "\n[part.mesh]\nelement_size = \"0.01 mm\"", folder.path, "take larger elements");
  }
  for (const double thickness : {1e-4, 5e-4}) {  // at order 5 a tenth of a millimetre would make 7.6e6
    write_plate(folder.path / "foil.stl", Eigen::Vector3d::Zero(), 0, thickness);
    EXPECT_EQ(problem_of(foil, folder.path), "no problem");
  }
}

TEST(PartFile, APointWithoutAPatchIsToldOfWhereAToleranceIsHeld) {
  const TemporaryFolder folder;
  write_plate(folder.path / "plate.stl");
  const std::string plate = surface_case("file = \"plate.stl\"\nunit = \"mm\"");
  const std::string at = "[points.P]\nposition = [\"50 mm\", \"60 mm\", \"2 mm\"]\n";
  const auto told = [&](const std::string& text) {
    return unreachable_tolerances(parse_case(text, folder.path)).size();
  };
  EXPECT_EQ(told(plate), 0U);
  EXPECT_EQ(told(plate + at), 1U);
  EXPECT_EQ(told(plate + at + "patch_radius = \"2 mm\"\n"), 0U);
  EXPECT_EQ(told(plate + at + "[part.mesh]\nelement_size = \"10 mm\"\n"), 0U);
}

/// Two masses on springs, the first to ground, as Matrix Market in mm and t.
void write_matrices(const std::filesystem::path& folder) {
  core::write_file_atomically(folder / "k.mtx",
                              "%%MatrixMarket matrix coordinate real symmetric\n2 2 3\n1 1 200\n2 1 -100\n2 2 100\n");
  core::write_file_atomically(folder / "m.mtx",
                              "%%MatrixMarket matrix coordinate real symmetric\n2 2 2\n1 1 0.001\n2 2 0.001\n");
  core::write_file_atomically(folder / "dofs.csv", "node,component,point\n3,x,A\n8,x,B\n");
}

const std::string two_masses =
    "mass_unit = \"t\"\nunit = \"mm\"\n[part.matrices]\nstiffness = \"k.mtx\"\n"
    "mass = \"m.mtx\"\ndofs = \"dofs.csv\"\n";

std::string matrix_problem(const std::string& keys, const std::filesystem::path& folder) {
  try {
    (void)parse_case("[part]\n" + keys, folder);
  } catch (const CaseError& error) {
    EXPECT_EQ(error.problems.size(), 1U) << error.what();
    return error.problems.front().text;
  } catch (const core::Error& error) {
    return error.what();
  }
  return "no problem";
}

/// Two tetrahedra, the second of steel by the file: [part.material] is for the first alone.
TEST(PartFile, MaterialsOfAMeshStandBesideThatOfTheCase) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "two.inp", R"(*NODE
1, 0, 0, 0
2, 10, 0, 0
3, 0, 10, 0
4, 0, 0, 10
5, 0, 0, -10
*ELEMENT, TYPE=C3D4, ELSET=UPPER
1, 1, 2, 3, 4
*ELEMENT, TYPE=C3D4, ELSET=LOWER
2, 1, 3, 2, 5
*MATERIAL, NAME=STEEL
*ELASTIC
210000, 0.3
*DENSITY
7.8e-9
*SOLID SECTION, ELSET=LOWER, MATERIAL=STEEL
)");
  const Case source = parse_case(R"([part]
file = "two.inp"
unit = "mm"
mass_unit = "t"
[part.material]
youngs_modulus = "70 GPa"
poisson_ratio = 0.33
density = "2700 kg/m^3"
)",
                                 folder.path);
  const mesh::TetMesh& mesh = source.part->imported->mesh->solid.mesh;
  const fem::Materials materials = materials_on(source, mesh);
  const double volume = 1e-6 / 6.0;
  EXPECT_NEAR(mass(materials, mesh), volume * (2700.0 + 7800.0), 1e-15);
}

/// Two tetrahedra that share no node, one foot of each in z = 0; the case adds what holds them.
std::string problem_of_two_pieces(const std::string& held) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "two.inp", R"(*NODE, NSET=ALL
1, 0, 0, 0
2, 10, 0, 0
3, 0, 10, 0
4, 0, 0, 10
*NODE, NSET=FAR
11, 50, 0, 0
12, 60, 0, 0
13, 50, 10, 0
14, 50, 0, 10
*ELEMENT, TYPE=C3D4
1, 1, 2, 3, 4
2, 11, 12, 13, 14
)");
  return problem_of("file = \"two.inp\"\nunit = \"mm\"\n" + held, folder.path);
}

TEST(PartFile, APieceOfAMeshThatNothingHoldsBesideOneThatIsHeldIsRefused) {
  const std::string loose =
      "part.file: the mesh is in 2 pieces that share no node, and nothing holds 1 of them, the first with 1 tetrahedra "
      "at (52.5, 2.5, 2.5) mm; join the pieces, hold each, or leave them out";
  EXPECT_EQ(problem_of_two_pieces("[[part.supports]]\non = \"x_min\"\n"), loose);
  EXPECT_EQ(problem_of_two_pieces("[[part.supports]]\non = \"all\"\n"), loose);
  EXPECT_EQ(problem_of_two_pieces("[[part.clamps]]\non = \"x_min\"\nnormal_stiffness = \"5 N/mm^3\"\n"), loose);
  EXPECT_EQ(problem_of_two_pieces("[[part.springs]]\nat = \"P\"\nstiffness = [1e6, 1e6, 1e6]\n[points.P]\n"
                                  "position = [0.003, 0.003, 0]\npatch_radius = \"1 mm\"\n"),
            loose);
  EXPECT_EQ(problem_of_two_pieces("[[part.supports]]\non = \"z_min\"\n"), "no problem");
  EXPECT_EQ(problem_of_two_pieces("[[part.supports]]\non = \"x_min\"\n[[part.supports]]\non = \"FAR\"\n"),
            "no problem");
  EXPECT_EQ(problem_of_two_pieces(""), "no problem") << "a free part is told of otherwise";
}

/// A section whose material lacks something is named, with what it lacks, unless the case gives another.
TEST(PartFile, AMaterialOfAMeshThatLacksSomethingIsNamed) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "one.inp", R"(*NODE
1, 0, 0, 0
2, 10, 0, 0
3, 0, 10, 0
4, 0, 0, 10
*ELEMENT, TYPE=C3D4, ELSET=UPPER
1, 1, 2, 3, 4
*MATERIAL, NAME=STEEL
*ELASTIC
210000, 0.3
*SOLID SECTION, ELSET=UPPER, MATERIAL=STEEL
)");
  const std::string keys = "[part]\nfile = \"one.inp\"\nunit = \"mm\"\nmass_unit = \"t\"\n";
  const std::string given = "youngs_modulus = \"70 GPa\"\npoisson_ratio = 0.3\ndensity = \"2700 kg/m^3\"\n";
  EXPECT_NE(matrix_problem(keys.substr(7), folder.path)
                .find("part.file: the material \"STEEL\" of the set UPPER has no density"),
            std::string::npos)
      << matrix_problem(keys.substr(7), folder.path);
  EXPECT_EQ(matrix_problem(keys.substr(7) + "[[part.materials]]\non = \"UPPER\"\n" + given, folder.path), "no problem");
  const Case taken = parse_case(keys + "[part.material]\n" + given, folder.path);
  EXPECT_NE(taken.part->imported->notes.back().find("has no density: the case's takes its place"), std::string::npos);
}

/// The volume that coarse elements misplace falls with their size, and is none where no sphere is.
TEST(PartFile, WhatASphereMisplacesFallsWithTheElements) {
  const TemporaryFolder folder;
  write_plate(folder.path / "plate.stl");
  const auto share = [&](const std::string& predicate, int n) {
    const Case source = parse_case(
        surface_case(
            "file = \"plate.stl\"\nunit = \"mm\"\n[[part.materials]]\non = \"end\"\nyoungs_modulus = \"210 GPa\"\n"
            "poisson_ratio = 0.3\ndensity = \"7800 kg/m^3\"\n[selections.end." +
            predicate),
        folder.path);
    return misplaced_share(source, mesh::kuhn_box({0.1, 0.06, 0.004}, {5 * n, 3 * n, 1}));
  };
  const std::string sphere = "sphere]\ncentre = [0.1, 0.03, 0]\nradius = 0.043\n";
  const double coarse = share(sphere, 2), fine = share(sphere, 8);
  EXPECT_GT(coarse, 0.01);
  EXPECT_LT(coarse, 0.1);
  EXPECT_NEAR(fine / coarse, 0.25, 0.1) << "a band of one element along the border";
  EXPECT_EQ(share("box]\nmin = [0.043, 0, 0]\nmax = [1, 1, 1]\n", 2), 0.0) << "the mesh is cut there";
}

TEST(PartFile, AMaterialOfAPlaceThatMissesThePartIsRefused) {
  const TemporaryFolder folder;
  write_plate(folder.path / "plate.stl");
  const auto keys = [](const std::string& min) {
    return "file = \"plate.stl\"\nunit = \"mm\"\n[[part.materials]]\non = \"end\"\nyoungs_modulus = \"210 GPa\"\n"
           "poisson_ratio = 0.3\ndensity = \"7800 kg/m^3\"\n[selections.end.box]\nmin = [" +
           min + ", 0, 0]\nmax = [0.3, 1, 1]\n";
  };
  expect_problem(keys("0.2"), folder.path, "the selection \"end\" does not meet the part, which reaches from");
  EXPECT_EQ(problem_of(keys("0.05"), folder.path), "no problem");
}

TEST(PartFile, MatricesAreReadInTheirUnitsAndTheirNodesNamed) {
  const TemporaryFolder folder;
  write_matrices(folder.path);
  const Case source = parse_case("[part]\n" + two_masses + "[points.B]\ndirections = \"x\"\n", folder.path);
  ASSERT_TRUE(source.part->imported);
  EXPECT_EQ(kind(*source.part), ShapeKind::matrices);
  EXPECT_EQ(source.part->imported->matrices->K.coeff(0, 0), 200.0 * 1000.0);  // t/s² = N/mm
  EXPECT_EQ(source.part->imported->matrices->M.coeff(1, 1), 1.0);
  EXPECT_EQ(node_of(*source.part->imported, source.points.front()), 8);
  EXPECT_EQ(input_files(source).size(), 3U);
}

TEST(PartFile, ATableThatIsReadBesideItsMatrixIsAnInput) {
  const TemporaryFolder folder;
  core::write_file_atomically(folder.path / "job.sti", "1 1 200\n2 1 -100\n2 2 100\n");
  core::write_file_atomically(folder.path / "job.mas", "1 1 0.001\n2 2 0.001\n");
  const auto with_dofs = [&](const std::string& dofs) {
    core::write_file_atomically(folder.path / "job.dof", dofs);
    return parse_case(
        "[part]\nunit = \"mm\"\nmass_unit = \"t\"\n[part.matrices]\nstiffness = \"job.sti\"\nmass = \"job.mas\"\n"
        "[points.B]\nnode = 8\ndirections = \"x\"\n",
        folder.path);
  };
  const Case source = with_dofs("3.1\n8.1\n");
  EXPECT_EQ(std::ranges::count(input_files(source), folder.path / "job.dof"), 1);
  const std::string key = study::part_key(source);
  EXPECT_EQ(study::part_key(with_dofs("3.1\n8.1\n")), key);
  EXPECT_NE(study::part_key(with_dofs("8.1\n3.1\n")), key) << "the nodes have changed places";
}

TEST(PartFile, WhatMatricesDoNotTellIsRefused) {
  const TemporaryFolder folder;
  write_matrices(folder.path);
  const auto expect = [&](const std::string& keys, const std::string& part) {
    const std::string problem = matrix_problem(keys, folder.path);
    EXPECT_NE(problem.find(part), std::string::npos) << problem;
  };
  expect(two_masses + "[points.C]\ndirections = \"x\"\n", "no point of this name; give its node");
  expect(two_masses + "[points.C]\nnode = 4\ndirections = \"x\"\n", "points.C.node: the part's file has no node 4");
  expect(two_masses + "[points.C]\nat = [0, 0, 0]\n", "give the node = its number, and neither at nor position");
  expect(two_masses + "[[part.supports]]\non = \"x_min\"\n", "part.supports: belongs to part.shape = ");
  expect("unit = \"mm\"\n[part.matrices]\nstiffness = \"k.mtx\"\nmass = \"m.mtx\"\n",
         "set part.unit and part.mass_unit");
  expect("unit = \"mm\"\nmass_unit = \"s\"\n[part.matrices]\nstiffness = \"k.mtx\"\nmass = \"m.mtx\"\n",
         "part.matrices: ");
  expect("unit = \"mm\"\nmass_unit = \"t\"\n[part.matrices]\nstiffness = \"k.mtx\"\nmass = \"m.mtx\"\n", "k.mtx");
  core::write_file_atomically(
      folder.path / "k.mtx",
      "%%MatrixMarket matrix coordinate real general\n2 2 4\n1 1 200\n1 2 -100\n2 1 -90\n2 2 100\n");
  expect(two_masses, "A.x");
}

}  // namespace
}  // namespace thinwall::tests::part_file_case_test
