// Parts from files through the whole pipeline: the same part described in two ways gives the same results.

#include <gtest/gtest.h>

#include "app/case_run.hpp"
#include "app/reduce_command.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "fem/model.hpp"
#include "fem/modes.hpp"
#include "fem/supports.hpp"
#include "io/mesh/mesh_file.hpp"
#include "io/surface/stl.hpp"
#include "mesh/box.hpp"
#include "mesh/surface/shapes.hpp"
#include "report/summary/summary_json.hpp"
#include "report/terminal_report.hpp"
#include "tests/core/temporary_folder.hpp"
#include "tests/mesh/kuhn_box.hpp"

namespace thinwall::tests::part_file_test {

using namespace setup;
using namespace cases;
using namespace study;
using namespace report;
using namespace app;

namespace {

namespace fs = std::filesystem;

const std::string rest = R"(
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
tolerance = 0.005
[[part.supports]]
on = "y_min"
[points.P]
position = ["30 mm", "100 mm", "4 mm"]
patch_radius = "4 mm"
[modes]
count = 5
[damping]
ratio = 0.01
)";

nlohmann::json run(const std::string& part, const fs::path& folder, const std::string& out) {
  return summary_json(run_case(parse_case("[part]\n" + part + rest, folder), {folder / out, true, -1, false}).summary);
}

/// A wall of 60 x 100 x 4 mm as a box, and as the triangles of an STL in inches whose facets are turned and doubled:
/// the meshers, the orders and the checks differ, the frequencies do not.
TEST(PartFile, AnStlOfABoxHasTheModesOfTheBox) {
  const fs::path folder = tests::temporary_files() / "part_file";
  fs::remove_all(folder);
  fs::create_directories(folder);
  mesh::TriangleSoup soup = mesh::soup(mesh::triangulated(mesh::surface(mesh::Box{{0.06, 0.1, 0.004}})));
  std::swap(soup.triangles[3][0], soup.triangles[3][1]);
  soup.triangles.push_back(soup.triangles[5]);
  io::write_stl(folder / "wall.stl", soup, 0.0254);
  const auto box =
      run("length = \"60 mm\"\nheight = \"100 mm\"\nthickness = \"4 mm\"\n"
          "[part.axes]\nlength = \"x\"\nheight = \"y\"\nthickness = \"z\"\n",
          folder, "box");
  const auto surface = run("file = \"wall.stl\"\nunit = \"inch\"\n", folder, "surface");
  for (std::size_t k = 0; k < 5; ++k) {
    const double expected = box["part"]["modes"][k]["frequency_hz"].get<double>();
    EXPECT_NEAR(surface["part"]["modes"][k]["frequency_hz"].get<double>() / expected, 1.0, 0.005 + 0.005) << k;
  }
  EXPECT_NEAR(surface["part"]["mass_kg"].get<double>(), 2810 * 0.06 * 0.1 * 0.004, 1e-6);
  EXPECT_EQ(surface["geometry"]["mended"].size(), 2U) << surface["geometry"]["mended"].dump();
  EXPECT_TRUE(fs::exists(folder / "surface" / "modes" / "wall_thickness.vtp"));
}

const std::string held_plate = R"([part]
length = "60 mm"
height = "100 mm"
thickness = "4 mm"
[part.axes]
length = "x"
height = "y"
thickness = "z"
[part.material]
youngs_modulus = "71 GPa"
poisson_ratio = 0.33
density = "2810 kg/m^3"
[part.mesh]
element_size = "15 mm"
order = 3
[[part.supports]]
on = "y_min"
)";

const std::string rest_of_matrices = R"([points.P]
PLACE
[damping]
model = "DAMPING"
RATIO
[reduction]
modes = 20
[response]
to = "3000 Hz"
lines = 300
[robot]
frequency = "40 Hz"
stiffness = "1e5 N/m"
damping_ratio = 0.02
direction = "z"
[[contacts]]
part = "P"
directions = "z"
stiffness = "1e6 N/m"
[tool]
teeth = 4
diameter = "16 mm"
length = "20 mm"
[cutting]
at = "P"
radial_depth = "0.5 mm"
tool_axis = "y"
feed_direction = "x"
Kt = "800 N/mm^2"
spindle_speed = "5000 rpm"
[lobes]
from = "3000 rpm"
to = "9000 rpm"
count = 5
depth_limit = "20 mm"
)";

std::string with_place(const std::string& place, const std::string& damping, const std::string& ratio) {
  std::string text = rest_of_matrices;
  for (const auto& [from, to] :
       {std::pair<std::string, std::string>{"PLACE", place}, {"DAMPING", damping}, {"RATIO", ratio}})
    text.replace(text.find(from), from.size(), to);
  return text;
}

/// A plate is reduced and written; the files, as a part of matrices without a shape, go through modes, a second
/// reduction with all of their modes, coupling by both routes and lobes to the same results as the plate's own model.
TEST(PartFile, MatricesOfAPartGoThroughThePipelineAsThePartDoes) {
  const fs::path folder = tests::temporary_files() / "part_matrices";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string plate =
      held_plate +
      with_place("position = [\"30 mm\", \"100 mm\", \"4 mm\"]\npatch_radius = \"4 mm\"", "modal", "ratio = 0.01");
  ReduceRequest request;
  request.out = folder / "model";
  request.modes = 20;
  (void)reduce_part(parse_case(plate, folder), request);
  const auto own = summary_json(run_case(parse_case(plate, folder), {folder / "own", true, -1, false}).summary);
  const std::string matrices =
      "[part]\nunit = \"m\"\nmass_unit = \"kg\"\n[part.matrices]\nstiffness = \"model/stiffness.mtx\"\n"
      "mass = \"model/mass.mtx\"\ndamping = \"model/damping.mtx\"\ndofs = \"model/dofs.csv\"\n" +
      with_place("", "matrices", "");
  const auto from_files =
      summary_json(run_case(parse_case(matrices, folder), {folder / "files", true, -1, false}).summary);
  EXPECT_EQ(from_files["reduction"]["full_dofs"], 23);
  EXPECT_LT(from_files["coupling"]["route_difference"]["max_relative"].get<double>(), 1e-9);
  for (std::size_t k = 0; k < 6; ++k) {
    const auto& a = own["coupling"]["modes"][k];
    const auto& b = from_files["coupling"]["modes"][k];
    EXPECT_NEAR(b["frequency_hz"].get<double>() / a["frequency_hz"].get<double>(), 1.0, 1e-8) << k;
    EXPECT_NEAR(b["damping_ratio"].get<double>(), a["damping_ratio"].get<double>(), 1e-8) << k;
  }
  for (const std::size_t chart : {0, 1}) {
    EXPECT_NEAR(from_files["lobes"][chart]["minimum_depth_m"].get<double>() /
                    own["lobes"][chart]["minimum_depth_m"].get<double>(),
                1.0, 1e-5);
  }
}

std::vector<double> frequencies(const nlohmann::json& summary) {
  std::vector<double> hz;
  for (const auto& mode : summary["part"]["modes"]) hz.push_back(mode["frequency_hz"].get<double>());
  return hz;
}

const std::string block_material =
    "[part.material]\nyoungs_modulus = \"71 GPa\"\npoisson_ratio = 0.33\ndensity = \"2810 kg/m^3\"\n";

/// A block of Gmsh held on its named group of faces: the modes of the same mesh through the library.
TEST(PartFile, AMeshIsSolvedOnItsOwnNodesAndHeldByItsSets) {
  const fs::path folder = tests::temporary_files() / "part_mesh";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string source = std::string(THINWALL_SOURCE_DIR) + "/tests/io/data/box_41_binary.msh";
  const auto text = [&](const std::string& on) {
    return "[part]\nfile = \"" + source + "\"\nunit = \"mm\"\n" + block_material + "[[part.supports]]\non = \"" + on +
           "\"\n[modes]\ncount = 6\n";
  };
  const auto by_set =
      summary_json(run_case(parse_case(text("CLAMPED"), folder), {folder / "set", true, -1, false}).summary);
  const mesh::SolidMesh solid = io::read_solid_mesh(source, "mm");
  const auto& held = mesh::node_set(solid, "clamped", "box").nodes;
  const fem::Model model =
      fem::build_model(solid.mesh, solid.nodes, fem::Material{71e9, 0.33, 2810.0}, fem::rows_of(held, {0, 1, 2}));
  const fem::Factored factored = fem::factorise(model);
  fem::ModeOptions options;
  options.count = 6;
  const fem::Modes expected = fem::modes(model, factored, options);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(frequencies(by_set)[k] / expected.frequency_hz(static_cast<Eigen::Index>(k)), 1.0, 1e-9);
  EXPECT_EQ(by_set["mesh"]["order"], 2);
  const auto& estimate = by_set["mesh"]["error_estimate"];
  ASSERT_TRUE(estimate.is_object());
  EXPECT_TRUE(estimate["tolerance"].is_null());
  EXPECT_EQ(estimate["steps"].back()["order"], 3);
  const mesh::LagrangeNodes finer = mesh::lagrange_nodes(solid.mesh, 5);
  const fem::Model fine = fem::build_model(solid.mesh, finer, fem::Material{71e9, 0.33, 2810.0},
                                           fem::rows_of(mesh::set_of_order(solid.nodes, held, finer), {0, 1, 2}));
  const fem::Modes exact = fem::modes(fine, fem::factorise(fine), options);
  const double error = (expected.frequency_hz.array() / exact.frequency_hz.array() - 1.0).abs().maxCoeff();
  EXPECT_GE(estimate["max_relative_frequency_error"].get<double>(), error);
  EXPECT_LE(estimate["max_relative_frequency_error"].get<double>(), 5.0 * error);
  EXPECT_EQ(by_set["geometry"]["notes"].size(), solid.notices.size());
  try {
    (void)parse_case(text("clampd"), folder);
    ADD_FAILURE() << "a set that is not there";
  } catch (const core::Error& refusal) {
    EXPECT_NE(std::string(refusal.what()).find("clamped"), std::string::npos) << refusal.what();
  }
}

/// Stiff elastic clamps hold as a support does, soft ones leave the part free; a mass lowers what it rides on.
TEST(PartFile, ClampsGoFromFreeToHeldAndMassesCount) {
  const fs::path folder = tests::temporary_files() / "part_attached";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string plate =
      "[part]\nlength = \"60 mm\"\nheight = \"100 mm\"\nthickness = \"4 mm\"\n"
      "[part.axes]\nlength = \"x\"\nheight = \"y\"\nthickness = \"z\"\n[part.mesh]\nelement_size = \"15 mm\"\n"
      "order = 3\n[modes]\ncount = 4\n" +
      block_material;
  const auto run_with = [&](const std::string& more, const std::string& out) {
    return summary_json(run_case(parse_case(plate + more, folder), {folder / out, true, -1, false}).summary);
  };
  const auto clamps = [](const std::string& k) {
    return "[[part.clamps]]\non = \"y_min\"\nnormal_stiffness = \"" + k + "\"\ntangential_stiffness = \"" + k + "\"\n";
  };
  const auto held = frequencies(run_with("[[part.supports]]\non = \"y_min\"\n", "held"));
  const auto stiff = frequencies(run_with(clamps("1e20 N/m^3"), "stiff"));
  const auto half = frequencies(run_with(clamps("1e12 N/m^3"), "half"));
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(stiff[k] / held[k], 1.0, 1e-6);
    EXPECT_LT(half[k], held[k]);
  }
  const auto free = run_with("", "free");
  const auto soft = run_with(clamps("1 N/m^3"), "soft");
  EXPECT_EQ(free["part"]["rigid_body_modes"], 6);
  EXPECT_EQ(free["part"]["free_motions"].size(), 6U) << free["part"].dump();
  EXPECT_NE(terminal_report(summary_from(free, "summary.json"), "r").find("6: translation along x, "),
            std::string::npos)
      << terminal_report(summary_from(free, "summary.json"), "r");
  EXPECT_NEAR(frequencies(soft).back() / frequencies(free).back(), 1.0, 1e-6);
  const std::string mass =
      "[[part.masses]]\nat = \"P\"\nmass = \"20 g\"\n[points.P]\nposition = [0.03, 0.1, 0.004]\npatch_radius = \"5 "
      "mm\"\n";
  const auto loaded = frequencies(run_with("[[part.supports]]\non = \"y_min\"\n" + mass, "loaded"));
  // A cantilever of mass M with m on its tip, by Rayleigh's quotient of its own first shape: 4.12 = tip² over mean.
  const double M = 2810 * 0.06 * 0.1 * 0.004;
  EXPECT_NEAR(loaded[0] / held[0], 1.0 / std::sqrt(1.0 + 4.12 * 0.02 / M), 0.03);
}

/// A plate whose end is of steel from x = 60 mm on: the generated mesh, cut there, gives the modes of a regular mesh
/// whose elements end there by themselves. Elements that lie across would be 1 % off.
TEST(PartFile, ABoxOfAnotherMaterialEndsWhereItEnds) {
  const fs::path folder = tests::temporary_files() / "part_two_materials";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto summary =
      summary_json(run_case(parse_case("[part]\nlength = \"100 mm\"\nheight = \"40 mm\"\nthickness = \"5 mm\"\n"
                                       "[part.axes]\nlength = \"x\"\nheight = \"y\"\nthickness = \"z\"\n"
                                       "[part.mesh]\ntolerance = 0.001\n[modes]\ncount = 4\n" +
                                           block_material +
                                           "[[part.materials]]\non = \"end\"\nyoungs_modulus = \"210 GPa\"\n"
                                           "poisson_ratio = 0.3\ndensity = \"7850 kg/m^3\"\n"
                                           "[selections.end.box]\nmin = [\"60 mm\", \"-1 mm\", \"-1 mm\"]\n"
                                           "max = [\"101 mm\", \"41 mm\", \"6 mm\"]\n",
                                       folder),
                            {folder / "out", true, -1, false})
                       .summary);
  mesh::TetMesh mesh = mesh::kuhn_box({0.1, 0.04, 0.005}, {10, 4, 1});
  fem::Materials materials{{{71e9, 0.33, 2810.0}, {210e9, 0.3, 7850.0}}, {}};
  for (const auto& tet : mesh.tets) {
    double x = 0.0;
    for (const int v : tet) x += 0.25 * mesh.vertices[static_cast<std::size_t>(v)].x();
    materials.of_tet.push_back(x > 0.06 ? 1 : 0);
  }
  EXPECT_NEAR(summary["part"]["mass_kg"].get<double>(), 2e-4 * 0.1 * (0.6 * 2810.0 + 0.4 * 7850.0), 1e-10);
  const fem::Model model = fem::supported_model(std::move(mesh), 4, materials, {}, {}, {});
  fem::ModeOptions options;
  options.count = 4;
  const fem::Modes expected = fem::modes(model, fem::factorise(model), options);
  for (std::size_t k = 6; k < 10; ++k) {
    EXPECT_NEAR(frequencies(summary)[k] / expected.frequency_hz(static_cast<Eigen::Index>(k)), 1.0, 1.5e-3) << k;
  }
}

/// Matrices that nothing holds: their free motions are counted by themselves.
TEST(PartFile, FreeMatricesAreFree) {
  const fs::path folder = tests::temporary_files() / "part_free_matrices";
  fs::remove_all(folder);
  fs::create_directories(folder);
  std::string plate = held_plate + with_place(
                                       "position = [\"30 mm\", \"100 mm\", \"4 mm\"]\npatch_radius = \"4 mm\"\n"
                                       "[points.A]\nposition = [\"10 mm\", \"20 mm\", \"4 mm\"]\n"
                                       "patch_radius = \"4 mm\"\n[points.B]\nposition = [\"50 mm\", \"30 mm\", 0]\n"
                                       "patch_radius = \"4 mm\"\n",
                                       "modal", "ratio = 0.01");
  const auto support = plate.find("[[part.supports]]");
  plate.erase(support, plate.find("[points.P]") - support);
  plate.erase(plate.find("[robot]"));
  ReduceRequest request;
  request.out = folder / "model";
  request.modes = 40;
  const Case part = parse_case(plate, folder);
  (void)reduce_part(part, request);
  const std::string matrices =
      "[part]\nunit = \"m\"\nmass_unit = \"kg\"\n[part.matrices]\nstiffness = \"model/stiffness.mtx\"\n"
      "mass = \"model/mass.mtx\"\ndofs = \"model/dofs.csv\"\n[points.P]\n[points.A]\n[points.B]\n[modes]\ncount = 4\n"
      "[reduction]\nmodes = 10\n[damping]\nratio = 0.01\n";
  const auto own = summary_json(run_case(part, {folder / "own", true, -1, false}).summary);
  const auto from_files =
      summary_json(run_case(parse_case(matrices, folder), {folder / "files", true, -1, false}).summary);
  EXPECT_EQ(from_files["part"]["rigid_body_modes"], 6);
  for (std::size_t k = 6; k < 10; ++k) EXPECT_NEAR(frequencies(from_files)[k] / frequencies(own)[k], 1.0, 2e-3) << k;
}

/// Two masses on springs have two modes; the usual counts of ten and thirty yield.
TEST(PartFile, SmallMatricesGiveTheModesThatTheyHave) {
  const fs::path folder = tests::temporary_files() / "part_small";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string head = "%%MatrixMarket matrix coordinate real symmetric\n";
  core::write_file_atomically(folder / "k.mtx", head + "3 3 5\n1 1 2e6\n2 1 -1e6\n2 2 2e6\n3 2 -1e6\n3 3 1e6\n");
  core::write_file_atomically(folder / "m.mtx", head + "3 3 3\n1 1 1\n2 2 1\n3 3 1\n");
  core::write_file_atomically(folder / "dofs.csv", "node,component,point\n1,x,A\n2,x,B\n3,x,C\n");
  const auto summary =
      summary_json(run_case(parse_case("[part]\nunit = \"m\"\nmass_unit = \"kg\"\n[part.matrices]\n"
                                       "stiffness = \"k.mtx\"\nmass = \"m.mtx\"\ndofs = \"dofs.csv\"\n[points.C]\n"
                                       "directions = \"x\"\n",
                                       folder),
                            {folder / "out", true, -1, false})
                       .summary);
  ASSERT_EQ(summary["part"]["modes"].size(), 2U);
  for (int k = 1; k <= 2; ++k) {  // λ_k = 4 (k/m) sin²((2k − 1) π / 14) of a chain of three, held at one end
    const double omega = 2e3 * std::sin((2 * k - 1) * M_PI / 14);
    EXPECT_NEAR(frequencies(summary)[static_cast<std::size_t>(k - 1)], omega / (2 * M_PI), 1e-6);
  }
  EXPECT_FALSE(fs::exists(folder / "out" / "robot")) << "nothing was written there";
}

/// A point of the curved surface of a file, to the digits that people give, with a patch and without.
TEST(PartFile, APointOnACurvedSurfaceIsHeldToTheFileAndMovedToTheMesh) {
  const fs::path folder = tests::temporary_files() / "part_curved";
  fs::remove_all(folder);
  fs::create_directories(folder);
  const auto text = [](const std::string& position, const std::string& more) {
    return "[part]\nfile = \"" + std::string(THINWALL_SOURCE_DIR) + "/tests/data/parts/blade.stl\"\nunit = \"mm\"\n" +
           block_material +
           "[part.mesh]\ntolerance = 0.05\n[[part.supports]]\non = \"z_min\"\n[modes]\ncount = 4\n[points.P]\n"
           "position = " +
           position + "\n" + more;
  };
  const std::string there = "[\"3.158 mm\", \"4.509 mm\", \"60 mm\"]";
  const auto at_point =
      summary_json(run_case(parse_case(text(there, ""), folder), {folder / "point", true, -1, false}).summary);
  const auto over_disc = summary_json(
      run_case(parse_case(text(there, "patch_radius = \"2 mm\"\n"), folder), {folder / "disc", true, -1, false})
          .summary);
  EXPECT_EQ(at_point["status"], "ok");
  // What the mesh costs stands in the answer, and whether that is what was asked for; and no free motion is there.
  const std::string text_of_run = terminal_report(summary_from(at_point, "summary.json"), "results");
  const auto& estimate = at_point["mesh"]["error_estimate"];
  EXPECT_NE(text_of_run.find("by estimate frequencies within"), std::string::npos) << text_of_run;
  EXPECT_EQ(text_of_run.find("NOT MET") == std::string::npos, estimate["met"].get<bool>()) << text_of_run;
  nlohmann::json missed = at_point;
  missed["mesh"]["error_estimate"]["met"] = !estimate["met"].get<bool>();
  missed["mesh"]["error_estimate"]["held_back_by"] = "its time was over";
  EXPECT_EQ(terminal_report(summary_from(missed, "summary.json"), "results").find("NOT MET") == std::string::npos,
            !estimate["met"].get<bool>());
  missed["mesh"]["error_estimate"]["met"] = false;
  const std::string text_of_missed = terminal_report(summary_from(missed, "summary.json"), "results");
  EXPECT_NE(text_of_missed.find("0.05 was asked for; its time was over"), std::string::npos) << text_of_missed;
  EXPECT_LT(text_of_missed.find("the tolerance is not met"), text_of_missed.find("modes of the part"));
  EXPECT_TRUE(at_point["part"]["free_motions"].empty());
  EXPECT_EQ(text_of_run.find("rigid-body modes"), std::string::npos) << text_of_run;
  EXPECT_EQ(over_disc["status"], "ok");
  try {
    (void)parse_case(text("[\"3.158 mm\", \"3.4 mm\", \"60 mm\"]", ""), folder);
    ADD_FAILURE() << "a millimetre off";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("off the part's surface"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace thinwall::tests::part_file_test
