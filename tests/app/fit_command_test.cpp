// `thinwall fit`: from files of a structure that is known to tables that a case reads.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/case_run.hpp"
#include "core/atomic_file.hpp"
#include "dynamics/conversion.hpp"
#include "identification/fit_response.hpp"
#include "io/frf/mat_response.hpp"
#include "io/frf/modal_table_csv.hpp"
#include "io/frf/response_csv.hpp"
#include "io/frf/uff.hpp"
#include "io/frf/uff_shapes.hpp"
#include "robot/modal_table.hpp"
#include "tests/app/lobes_command.hpp"
#include "tests/identification/random_structure.hpp"
#include "tests/robot/modes_of_matrices.hpp"

namespace thinwall::tests::fit_command_test {
namespace {

using identification::FittedMode;
using identification::testing::Draw;

Outcome command(std::vector<std::string> words) {
  return call(std::move(words), run_case);
}

/// Two points along x and y with modes that are not reciprocal, and noise.
class Fit : public testing::Test {
 protected:
  Fit() {
    Draw draw(31);
    truth = identification::testing::random_modes(draw, 3, 2, 2, 0.03);
    // Passive, and not reciprocal by a tenth or two.
    for (FittedMode& mode : truth) {
      mode.left = mode.left.real().cast<std::complex<double>>();
      const Eigen::Vector2cd off(1.0 + draw.between(-0.2, 0.2), 1.0 + draw.between(-0.2, 0.2));
      mode.right = mode.left.cwiseProduct(off) / std::complex<double>(0.0, 2.0 * mode.pole().imag());
      mode.residue = mode.right * mode.left.transpose();
    }
    const auto lines = identification::testing::lines_of(truth, 700, noise, draw);
    measured = {{lines.hz}, dofs, dofs, lines.H};
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (temporary.path / name).string(); }
  [[nodiscard]] nlohmann::json figures() const {
    return nlohmann::json::parse(core::read_file(temporary.path / "out" / "fit.json"));
  }

  static constexpr double noise = 0.01;
  const dynamics::DofTable dofs{{"1", Eigen::Vector3d::UnitX(), dynamics::DofKind::translation},
                                {"1", Eigen::Vector3d::UnitY(), dynamics::DofKind::translation}};
  std::vector<FittedMode> truth;
  dynamics::ResponseModel measured;
  TemporaryFolder temporary;
};

/// Receptances with a mass on point 1 give the poles of the structure without it, and the table that goes with them.
TEST_F(Fit, TakesASensorsMassOffBeforeItFits) {
  const Matrices bare = two_points(1.0);
  Matrices loaded = bare;
  loaded.M.diagonal().head<2>().array() += 0.3;
  io::write_uff(path("loaded.uff"),
                dynamics::to_response(robot::modal_model(table_of(loaded)), dynamics::linear_axis(20.0, 140.0, 900)));
  const Outcome done = command({"fit", path("loaded.uff"), "--sensor", "1=300 g", "--out", path("out")});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("0.3 kg at 1 is taken off, which changes 1.x by up to"), std::string::npos) << done.out;
  const auto truth_there = table_of(bare).rows;
  const nlohmann::json modes = figures()["modes"];
  ASSERT_EQ(modes.size(), truth_there.size());
  for (std::size_t k = 0; k < modes.size(); ++k) {
    EXPECT_NEAR(modes[k]["frequency_hz"].get<double>() / truth_there[k].frequency_hz, 1.0, 1e-6);
    EXPECT_NEAR(modes[k]["damping_ratio"].get<double>() / truth_there[k].damping_ratio, 1.0, 1e-5);
  }
  EXPECT_EQ(command({"fit", path("loaded.uff"), "--sensor", "300 g", "--out", path("out")}).code, 2);
  EXPECT_EQ(command({"fit", path("loaded.uff"), "--sensor", "b=300 g", "--out", path("out")}).code, 2);
  // A mass of which a mode is most: the kernel 1 + ω² m H is all but singular at resonances of what is left.
  const Outcome heavy = command({"fit", path("loaded.uff"), "--sensor", "1=3 kg", "--out", path("out")});
  EXPECT_NE(heavy.out.find("without 3 kg at 1 errors of the line at"), std::string::npos) << heavy.out << heavy.err;
}

/// The table that a robot is read from has the receptances of the truth, but for the static part of the lines.
TEST_F(Fit, WritesATableThatARobotIsReadFrom) {
  io::write_uff(path("robot.uff"), measured);
  const Outcome done = command({"fit", path("robot.uff"), "--out", path("out")});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(done.out.find("warning"), std::string::npos) << done.out;
  const auto table = io::read_modal_table(temporary.path / "out" / "modal_table.csv", {1.0, 1.0, {}});
  ASSERT_EQ(table.rows.size(), truth.size());
  const auto again = dynamics::to_response(robot::modal_model(table, robot::PointPlaces::may_differ), measured.axis);
  identification::ModalFit exact;
  exact.modes = truth;
  for (std::size_t r = 0; r < truth.size(); ++r) {
    const auto line = static_cast<Eigen::Index>((truth[r].frequency_hz - 20.0) / (380.0 / 699.0));
    const Eigen::MatrixXcd H = value(exact, measured.axis.hz(line));
    EXPECT_LT((again.H[static_cast<std::size_t>(line)] - H).norm(), 0.01 * H.norm()) << r;
    const auto hz = figures()["modes"][r]["frequency_95_hz"];
    EXPECT_LT(hz[0].get<double>(), hz[1].get<double>());
    EXPECT_LT(std::abs(std::log(table.rows[r].frequency_hz / truth[r].frequency_hz)),
              2.0 * std::log(hz[1].get<double>() / hz[0].get<double>()));
  }
  EXPECT_EQ(io::read_uff_shapes(temporary.path / "out" / "modes.uff").shapes.size(), truth.size());
  EXPECT_NEAR(figures()["chi2_per_dof"].get<double>(), 1.0, 0.15);
}

/// UFF, our CSV, and accelerance in a file that says so are one structure.
TEST_F(Fit, GivesTheSameModesFromFilesOfAnyKind) {
  io::write_response(path("robot.csv"), measured);
  ASSERT_EQ(command({"fit", path("robot.csv"), "--out", path("out")}).code, 0);
  const nlohmann::json from_csv = figures();
  io::write_uff(path("robot.uff"), measured);
  ASSERT_EQ(command({"fit", path("robot.uff"), "--out", path("out")}).code, 0);
  for (std::size_t r = 0; r < truth.size(); ++r)
    EXPECT_NEAR(figures()["modes"][r]["frequency_hz"].get<double>(), from_csv["modes"][r]["frequency_hz"].get<double>(),
                1e-6 * truth[r].frequency_hz);
  std::vector<std::string> words{"fit"};
  for (const auto& [name, row, column] :
       {std::tuple{"xx", 0, 0}, std::tuple{"xy", 0, 1}, std::tuple{"yx", 1, 0}, std::tuple{"yy", 1, 1}}) {
    std::ostringstream text;
    text.precision(17);
    text << "frequency_hz,real,imaginary\n";
    for (std::size_t i = 0; i < measured.H.size(); ++i) {
      const double omega = measured.axis.omega_rad_s(static_cast<Eigen::Index>(i));
      const std::complex<double> A = -omega * omega * measured.H[i](row, column);
      text << measured.axis.hz(static_cast<Eigen::Index>(i)) << ',' << A.real() << ',' << A.imag() << '\n';
    }
    core::write_file_atomically(path(std::string(name) + ".csv"), text.str());
    words.push_back(std::string(name) + "=" + path(std::string(name) + ".csv"));
  }
  for (const char* word : {"--quantity", "accelerance", "--unit", "m/s^2/N", "--out"}) words.emplace_back(word);
  words.push_back(path("out"));
  const Outcome done = command(words);
  ASSERT_EQ(done.code, 0) << done.err;
  for (std::size_t r = 0; r < truth.size(); ++r)
    EXPECT_NEAR(figures()["modes"][r]["frequency_hz"].get<double>(), from_csv["modes"][r]["frequency_hz"].get<double>(),
                1e-6 * truth[r].frequency_hz);
  EXPECT_EQ(figures()["responses"], (nlohmann::json{"tool.x", "tool.y"}));
}

TEST_F(Fit, TellsWhatIsMissingOrWrong) {
  io::write_uff(path("robot.uff"), measured);
  const Outcome symmetric = command({"fit", path("robot.uff"), "--residues", "symmetric", "--out", path("out")});
  EXPECT_EQ(symmetric.code, 0);
  EXPECT_NE(symmetric.out.find("symmetric residues do not fit"), std::string::npos) << symmetric.out;
  std::string text = core::read_file(path("robot.uff"));
  // The last entry is left out, then the last but two: "-1" lines delimit data sets.
  const auto without_last = [&] { text.resize(text.rfind("    -1\n    58")); };
  without_last();
  core::write_file_atomically(path("part.uff"), text);
  const Outcome part = command({"fit", path("part.uff"), "--out", path("out")});
  EXPECT_EQ(part.code, 4);
  EXPECT_NE(part.err.find("1.y"), std::string::npos) << part.err;
  without_last();
  core::write_file_atomically(path("part.uff"), text);
  EXPECT_EQ(command({"fit", path("part.uff"), "--out", path("out")}).code, 0);  // a row
  EXPECT_EQ(command({"fit", path("robot.uff"), "--from", "30 mm"}).code, 2);
  EXPECT_EQ(command({"fit", path("robot.uff"), "--from", "30 Hz", "--to", "20 Hz"}).code, 2);
  EXPECT_EQ(command({"fit", path("robot.uff"), "--terms", "9"}).code, 2);
  EXPECT_EQ(command({"fit", path("robot.uff"), "--residues", "round"}).code, 2);
  EXPECT_EQ(command({"fit", path("robot.uff"), "--exclude", "50 Hz:"}).code, 2);
  EXPECT_EQ(command({"fit", "A=" + path("robot.uff")}).code, 2);
  EXPECT_EQ(command({"fit", path("none.uff")}).code, 4);
  EXPECT_EQ(command({"fit", path("robot.uff"), "--from", "399 Hz", "--out", path("out")}).code, 3);
}

/// One cross FRF serves for both, as in `lobes`.
TEST_F(Fit, TakesACrossEntryForItsReverse) {
  for (auto& H : measured.H) H(0, 1) = H(1, 0);
  const auto write_entry = [&](const std::string& name, Eigen::Index row, Eigen::Index column) {
    dynamics::ResponseModel entry{
        measured.axis, {dofs[static_cast<std::size_t>(row)]}, {dofs[static_cast<std::size_t>(column)]}, {}};
    for (const auto& H : measured.H) entry.H.emplace_back(Eigen::MatrixXcd::Constant(1, 1, H(row, column)));
    io::write_response(path(name), entry);
    return path(name);
  };
  const Outcome three = command({"fit", write_entry("a.csv", 0, 0), write_entry("b.csv", 1, 0),
                                 write_entry("c.csv", 1, 1), "--out", path("out")});
  ASSERT_EQ(three.code, 0) << three.err;
  EXPECT_NE(three.out.find("1.x/1.y is taken from 1.y/1.x by reciprocity"), std::string::npos) << three.out;
  const nlohmann::json of_three = figures();
  io::write_response(path("all.csv"), measured);
  ASSERT_EQ(command({"fit", path("all.csv"), "--out", path("out")}).code, 0);
  EXPECT_EQ(figures()["modes"], of_three["modes"]);
}

TEST_F(Fit, StartsFromTheNamedPoles) {
  io::write_uff(path("robot.uff"), measured);
  std::ostringstream named;
  named << truth[0].frequency_hz << " Hz, " << truth[2].frequency_hz << " Hz";
  const Outcome done = command({"fit", path("robot.uff"), "--poles", named.str(), "--out", path("out")});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(figures()["modes"].size(), 2u);
  EXPECT_NE(done.out.find("chi2 a degree of freedom is"), std::string::npos) << done.out;
}

TEST_F(Fit, TakesEachNamedPoleOnceAndWithinTheBand) {
  io::write_uff(path("robot.uff"), measured);
  const auto with = [&](const std::string& poles) {
    return command({"fit", path("robot.uff"), "--poles", poles, "--out", path("out")});
  };
  EXPECT_NE(with("60 Hz, 60.00000001 Hz").err.find("60 Hz stands twice"), std::string::npos);
  EXPECT_EQ(with("60 Hz, 60 Hz").code, 2);
  EXPECT_EQ(with("10 Hz, 60 Hz").code, 2);
  EXPECT_NE(with("60 Hz, 500 Hz").err.find("500 Hz is outside of the band from 20 to 400 Hz"), std::string::npos);
  // Two names near one pole of the diagram start apart.
  std::ostringstream close;
  close << 0.99 * truth[0].frequency_hz << " Hz, " << 1.01 * truth[0].frequency_hz << " Hz, " << truth[1].frequency_hz
        << " Hz, " << truth[2].frequency_hz << " Hz";
  const Outcome apart = with(close.str());
  ASSERT_EQ(apart.code, 0) << apart.err;
  EXPECT_EQ(figures()["modes"].size(), 4U);
}

TEST_F(Fit, RefusesWordsThatSayNothingByThemselves) {
  io::write_uff(path("robot.uff"), measured);
  const auto refused = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"fit", path("robot.uff"), "--out", path("out")});
    const Outcome done = command(words);
    EXPECT_EQ(done.code, 2) << words.back() << ": " << done.err;
    return done.err;
  };
  EXPECT_NE(refused({"--noise", "nan"}).find("0.01 stands for 1 %"), std::string::npos);
  EXPECT_NE(refused({"--noise", "0"}).find("above 0"), std::string::npos);
  EXPECT_NE(refused({"--averages", "8"}).find("these files do not have"), std::string::npos);
  EXPECT_NE(refused({"--averages", "8", "--noise", "0.01"}).find("one of the two"), std::string::npos);
  EXPECT_NE(refused({"--frequency-unit", "Hz"}).find("--frequency-unit"), std::string::npos);
  EXPECT_NE(refused({"--variable", "H"}).find("--frequency-variable"), std::string::npos);
  EXPECT_NE(refused({"--responses", "1.x"}).find("--forces"), std::string::npos);
  EXPECT_NE(refused({"--exclude", ""}).find("--exclude"), std::string::npos);
  for (const char* option : {"--swap", "--geometry"})
    EXPECT_TRUE(refused({option, ""}).starts_with(std::string("thinwall: ") + option + ": the name is empty"))
        << option;
  for (const char* option : {"--from", "--to", "--poles", "--terms", "--residues"})
    EXPECT_TRUE(refused({option, ""}).starts_with(std::string("thinwall: ") + option + ": the value is empty"))
        << option;
  const Outcome empty = command({"fit", path("robot.uff"), "--from", "399.9 Hz", "--out", path("out")});
  EXPECT_EQ(empty.code, 3);
  EXPECT_NE(empty.err.find("widen it: the file has 700 from 20 to 400 Hz"), std::string::npos) << empty.err;
}

/// The page holds the figures of fit.json, and the command without the poles that it was given.
TEST_F(Fit, LeavesAPage) {
  io::write_uff(path("robot.uff"), measured);
  std::ostringstream named;
  for (const FittedMode& mode : truth) named << (named.str().empty() ? "" : ", ") << mode.frequency_hz << " Hz";
  ASSERT_EQ(command({"fit", path("robot.uff"), "--poles", named.str(), "--order", "20", "--out", path("out")}).code, 0);
  const std::string page = core::read_file(temporary.path / "out" / "fit.html");
  const std::string opening = R"(<script type="application/json" id="data">)";
  const auto begin = page.find(opening) + opening.size();
  const auto document = nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  const nlohmann::json& fit = document.at("fit");
  EXPECT_EQ(fit.at("figures"), figures());
  EXPECT_EQ(fit.at("command"),
            (nlohmann::json{"thinwall", "fit", path("robot.uff"), "--order", "20", "--out", path("out")}));
  EXPECT_EQ(fit.at("frf").at("H").at("shape"), (nlohmann::json{2, 2, 700, 2}));
  EXPECT_EQ(fit.at("frf").at("synthesised").at("shape"), fit.at("frf").at("H").at("shape"));
  EXPECT_GT(fit.at("diagram").at("hz").at("shape")[0].get<int>(), 20);
  EXPECT_FALSE(fit.contains("shapes")) << "the points have no places";
  EXPECT_EQ(document.at("title"), "Fit of 2 x 2 receptances: robot.uff");
}

/// Points from a table, lines from nothing: a shape at two places.
TEST_F(Fit, ShowsShapesOnPointsWithPlaces) {
  measured.responses[1].point = "2";
  io::write_response(path("robot.csv"), measured);
  core::write_file_atomically(path("points.csv"), "point,x_m,y_m,z_m\n1,0,0,0\n2,0.5,0,0.1\n");
  const Outcome done =
      command({"fit", path("robot.csv"), "--geometry", path("points.csv"), "--residues", "free", "--out", path("out")});
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string page = core::read_file(temporary.path / "out" / "fit.html");
  EXPECT_NE(page.find(R"("position_m":[0.5,0.0,0.1])"), std::string::npos);
  EXPECT_EQ(command({"fit", path("robot.csv"), "--geometry", path("none.csv"), "--out", path("out")}).code, 4);
}

/// Nodes of a measured file that cannot be read are told; a file of FRFs alone has nothing to tell.
TEST_F(Fit, TellsOfNodesThatItCannotRead) {
  io::write_uff(path("alone.uff"), measured);
  const std::string frfs = core::read_file(path("alone.uff"));
  const auto with_nodes = [&](const std::string& name, const std::string& x) {
    core::write_file_atomically(path(name), frfs + "    -1\n    15\n         1         0         0         7" + x +
                                                "  0.00000e+00  0.00000e+00\n    -1\n");
    return command({"fit", path(name), "--out", path("out")});
  };
  const Outcome alone = command({"fit", path("alone.uff"), "--out", path("out")});
  EXPECT_EQ(alone.out.find("no shapes are drawn"), std::string::npos) << alone.out;
  const Outcome broken = with_nodes("broken.uff", "  1.0000metre");
  ASSERT_EQ(broken.code, 0) << broken.err;
  EXPECT_NE(broken.out.find("no shapes are drawn"), std::string::npos) << broken.out;
  EXPECT_NE(broken.out.find("broken.uff:"), std::string::npos) << broken.out;
  const Outcome whole = with_nodes("whole.uff", "  1.00000e+00");
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(whole.out.find("no shapes are drawn"), std::string::npos) << whole.out;
}

/// Arrays of another program, by the names of their variables.
TEST_F(Fit, ReadsArraysOfMatFiles) {
  io::write_mat_response(path("ours.mat"), {measured, {}, {}});
  const std::vector<std::string> array{
      "--variable", "H",   "--frequency-variable", "frequency_hz", "--quantity", "receptance",
      "--unit",     "m/N", "--responses",          "1.x, 1.y",     "--forces",   "1.x,1.y"};
  std::vector<std::string> words{"fit", path("ours.mat"), "--out", path("out")};
  ASSERT_EQ(command(words).code, 0);
  const nlohmann::json ours = figures();
  words.insert(words.end(), array.begin(), array.end());
  const Outcome done = command(words);
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_EQ(figures()["modes"], ours["modes"]);
  EXPECT_EQ(figures()["responses"], ours["responses"]);
  const std::string hdf5 = std::string(THINWALL_SOURCE_DIR) + "/tests/io/data/frf_73.mat";
  const Outcome of_hdf5 =
      command({"fit", hdf5, "--variable", "H", "--frequency-variable", "f", "--quantity", "receptance", "--unit", "m/N",
               "--responses", "1.x, 2.x", "--forces", "1.x", "--out", path("out")});
  ASSERT_EQ(of_hdf5.code, 0) << of_hdf5.err;
  ASSERT_EQ(figures()["modes"].size(), 2U);
  EXPECT_NEAR(figures()["modes"][0]["frequency_hz"].get<double>(), 40.0, 1e-6);
  EXPECT_NEAR(figures()["modes"][1]["damping_ratio"].get<double>(), 0.03, 1e-8);
  const Outcome one = command({"fit", "2.x/1.x=" + hdf5, "--variable", "H(2,1,:)", "--frequency-variable", "f",
                               "--quantity", "receptance", "--unit", "m/N", "--out", path("out")});
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(figures()["responses"], (nlohmann::json{"2.x"}));
}

/// Files that an earlier fit left and this one does not have are gone; other files stay.
TEST_F(Fit, ReplacesAnEarlierResultAsAWhole) {
  io::write_uff(path("robot.uff"), measured);
  ASSERT_EQ(command({"fit", path("robot.uff"), "--out", path("out")}).code, 0);
  core::write_file_atomically(temporary.path / "out" / "notes.txt", "mine");
  const std::filesystem::path of_a_killed_fit = core::partial_path(temporary.path / "out" / "fit");
  std::filesystem::create_directory(of_a_killed_fit);
  core::write_file_atomically(of_a_killed_fit / "modes.csv", "half of");
  ASSERT_TRUE(std::filesystem::exists(temporary.path / "out" / "modes.uff"));
  dynamics::ResponseModel cross{measured.axis, {dofs[0]}, {dofs[1]}, {}};
  for (const auto& H : measured.H) cross.H.emplace_back(H.block(0, 1, 1, 1));
  io::write_response(path("cross.csv"), cross);
  ASSERT_EQ(command({"fit", path("cross.csv"), "--out", path("out")}).code, 0);
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(temporary.path / "out"))
    names.insert(entry.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"fit.html", "fit.json", "fitted.csv", "modes.csv", "notes.txt"}));
}

TEST_F(Fit, KeepsTheFilesThatItReads) {
  std::filesystem::create_directories(temporary.path / "out");
  const std::filesystem::path file = temporary.path / "out" / "fitted.csv";
  io::write_response(file, measured);
  const std::string before = core::read_file(file);
  const Outcome refused = command({"fit", file.string(), "--out", path("out")});
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(refused.err.find("fitted.csv there is a file that is read"), std::string::npos) << refused.err;
  EXPECT_EQ(core::read_file(file), before);
  EXPECT_EQ(command({"fit", file.string(), "--out", path("elsewhere")}).code, 0);
}

/// A tool that is nearly round has one pole for two directions; a row of modes.csv is a mode along one.
TEST_F(Fit, TakesADoublePoleAsItIsAndTellsWhatModesAloneLeaveOut) {
  dynamics::ResponseModel round = measured;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(0.5).toRotationMatrix();
  const Eigen::Matrix2d compliance = turn * Eigen::Vector2d(1e-6, 5e-7).asDiagonal() * turn.transpose();
  for (std::size_t i = 0; i < round.H.size(); ++i) {
    const double r = round.axis.hz(static_cast<Eigen::Index>(i)) / round.axis.hz(350);
    round.H[i] = compliance / std::complex<double>(1.0 - r * r, 0.04 * r);
  }
  io::write_uff(path("round.uff"), round);
  const Outcome done = command({"fit", path("round.uff"), "--noise", "0.01", "--terms", "none", "--out", path("out")});
  ASSERT_EQ(done.code, 0) << done.err;
  EXPECT_NE(done.out.find("residues are free"), std::string::npos) << done.out;
  ASSERT_EQ(figures()["modes"].size(), 1U);
  EXPECT_NEAR(figures()["modes"][0]["damping_ratio"].get<double>(), 0.02, 1e-6);
  // The softer direction stays: 0.5/sqrt(1 + 0.25) of the matrix is left out.
  EXPECT_NE(done.out.find("modes.csv leave out 45 % of the fit"), std::string::npos) << done.out;
}

/// The modes of a tip, as `lobes` reads them, give the chart of the tip's own modes.
class FitOfATip : public LobesCommand {};

TEST_F(FitOfATip, WritesModesThatLobesReads) {
  ASSERT_EQ(command({"fit", path("tip.csv"), "--quantity", "receptance", "--unit", "m/N", "--terms", "0", "--to",
                     "3 kHz", "--out", path("out")})
                .code,
            0);
  ASSERT_EQ(lobes({path("modes.csv"), "--tool", path("tool.toml")}).code, 0);
  const auto depths = [&] {
    return io::numbers(io::read_csv(temporary.path / "results" / "lobes" / "tool.csv"), "limiting_depth_m", "lobes");
  };
  const std::vector<double> of_modes = depths();
  const Outcome done = lobes({path("out") + "/modes.csv", "--tool", path("tool.toml")});
  ASSERT_EQ(done.code, 0) << done.err;
  const std::vector<double> of_fit = depths();
  ASSERT_EQ(of_fit.size(), of_modes.size());
  for (std::size_t i = 0; i < of_fit.size(); ++i) EXPECT_NEAR(of_fit[i], of_modes[i], 1e-5 * of_modes[i]) << i;
}

}  // namespace
}  // namespace thinwall::tests::fit_command_test
