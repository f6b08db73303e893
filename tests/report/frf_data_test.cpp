#include "report/page/frf_data.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "report/coherence_files.hpp"
#include "report/page/thinned_lines.hpp"
#include "result_folder.hpp"
#include "unpacked.hpp"

namespace thinwall::report::frf_data_test {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

/// Every number of the file is where the page looks for it: row the response, column the force, Re before Im.
TEST(FrfData, TheArrayIsTheFile) {
  const fs::path folder = result_folder("frf_array");
  const auto response = response_of({"P", "Q"}, 50, false);
  io::write_response(folder / "frf" / "part.csv", response);
  const json entry = frf_data(folder)["frf"][0];
  const auto hz = unpacked<double>(entry["hz"]);
  const auto H = unpacked<float>(entry["H"]);
  ASSERT_EQ(entry["H"]["shape"], (std::vector<int>{2, 2, 50, 2}));
  ASSERT_EQ(entry["responses"], (std::vector<std::string>{"P.x", "Q.x"}));
  EXPECT_LT(H[2 * 49 + 1], 0.0) << "a passive driving point has Im < 0";
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t line = 0; line < 50; ++line) {
        const auto expected = response.H[line](static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        const std::size_t at = ((i * 2 + j) * 50 + line) * 2;
        const double close = 2e-5 * std::abs(expected);  // 15 bits
        ASSERT_NEAR(H[at], expected.real(), close);
        ASSERT_NEAR(H[at + 1], expected.imag(), close);
        ASSERT_EQ(hz[line], response.axis.hz(static_cast<Eigen::Index>(line)));
      }
    }
  }
}

/// The picture has the lines that were added between those of the response, and the band of errors goes on there.
TEST(FrfData, HoldsTheLinesThatWereAdded) {
  const fs::path folder = result_folder("frf_added");
  const auto all = response_of({"P"}, 50, false);
  dynamics::ResponseModel own{{}, all.responses, all.forces, {}}, added = own;
  for (Eigen::Index line = 0; line < 50; ++line) {
    dynamics::ResponseModel& one = line % 7 == 3 ? added : own;
    one.axis.hz.conservativeResize(one.axis.size() + 1);
    one.axis.hz(one.axis.size() - 1) = all.axis.hz(line);
    one.H.push_back(all.H[static_cast<std::size_t>(line)]);
  }
  io::write_response(folder / "frf" / "part.csv", own);
  io::write_response(folder / "frf" / "part_added.csv", added);
  std::string errors = "frequency_hz,truncation P.x/P.x\n";
  for (const double hz : own.axis.hz) errors += fmt::format("{:.17g},{:.17g}\n", hz, 2.0 * hz);
  core::write_file_atomically(folder / "frf" / "part_error.csv", errors);
  const json entry = frf_data(folder)["frf"][0];
  const auto hz = unpacked<double>(entry["hz"]);
  const auto H = unpacked<float>(entry["H"]), deviation = unpacked<float>(entry["deviation"]);
  ASSERT_EQ(hz.size(), 50U);
  for (std::size_t line = 0; line < 50; ++line) {
    EXPECT_EQ(hz[line], all.axis.hz(static_cast<Eigen::Index>(line)));
    EXPECT_NEAR(H[2 * line], all.H[line](0, 0).real(), 2e-5 * std::abs(all.H[line](0, 0)));
    EXPECT_NEAR(deviation[line], 2.0 * hz[line], 0.02 * hz[line]) << "a straight line, at 7 bits";
  }
}

/// What was measured of one entry alone is that of its transpose, too; a component without a file has none.
TEST(FrfData, HoldsTheCoherenceOfWhatWasMeasured) {
  const fs::path folder = result_folder("frf_coherence");
  const auto response = response_of({"P", "Q"}, 50, false);
  const auto measured = [&](const std::string& r, const std::string& f, bool coherent) {
    auto content = std::make_shared<setup::FrfContent>();
    content->frf.axis = response.axis;
    content->frf.H = Eigen::VectorXcd::Ones(50);
    if (coherent) content->frf.coherence = Eigen::VectorXd::LinSpaced(50, 0.5, 1.0);
    setup::MeasuredFrf file{.response = r, .force = f, .file = "hammer.csv"};
    file.content = content;
    return file;
  };
  io::write_response(folder / "frf" / "part.csv", response);
  const fs::path file = folder / "frf" / "part_coherence.csv";
  write_coherence(file, {measured("P.x", "P.x", false)}, response.axis);
  EXPECT_FALSE(frf_data(folder)["frf"][0].contains("coherence"));
  write_coherence(file, {measured("P.x", "P.x", false), measured("Q.x", "P.x", true)}, response.axis);
  const json part = frf_data(folder)["frf"][0];
  const auto coherence = unpacked<float>(part["coherence"]);
  ASSERT_EQ(coherence.size(), 4U * 50U);
  EXPECT_TRUE(std::isnan(coherence[0]) && std::isnan(coherence[150])) << "P.x/P.x has none, Q.x/Q.x was not measured";
  for (std::size_t line = 0; line < 50; ++line) {
    const double expected = 0.5 + 0.5 * static_cast<double>(line) / 49.0;
    EXPECT_NEAR(coherence[100 + line], expected, 1e-4);
    EXPECT_EQ(coherence[50 + line], coherence[100 + line]) << "P.x/Q.x is what Q.x/P.x is";
  }
}

TEST(FrfData, OfMirrorImagesTheUpperOneIsThere) {
  const fs::path folder = result_folder("frf_mirror");
  io::write_response(folder / "frf" / "part.csv", response_of({"P", "Q"}, 5, true));
  const auto H = unpacked<float>(frf_data(folder)["frf"][0]["H"]);
  EXPECT_FALSE(std::isnan(H[1 * 10]));
  EXPECT_TRUE(std::isnan(H[2 * 10]));
}

TEST(FrfData, ChiefPointsComeFirstAndWhatIsLeftOutIsNamed) {
  const fs::path folder = result_folder("frf_first");
  const auto response = response_of({"A", "B", "C", "D"}, 20, false);
  io::write_response(folder / "frf" / "part.csv", response);
  const json run = frf_data(folder, {.points_first = {"D", "B"}, .most_dofs = 3});
  const json& entry = run["frf"][0];
  EXPECT_EQ(entry["responses"], (std::vector<std::string>{"D.x", "B.x", "A.x"}));
  EXPECT_EQ(run["frf_left_out"], (std::vector<std::string>{"C.x"}));
  const auto H = unpacked<float>(entry["H"]);
  EXPECT_NEAR(H[(0 * 3 + 1) * 20 * 2], response.H[0](3, 1).real(), 1e-4 * std::abs(response.H[0](3, 1)))
      << "response D, force B";
  EXPECT_EQ(frf_data(folder)["frf_left_out"], json::array());
}

TEST(FrfData, IsThinnedToItsShareWithTheResonance) {
  const fs::path folder = result_folder("frf_thinned");
  const auto response = response_of({"A", "B"}, 30000, false);
  io::write_response(folder / "frf" / "part.csv", response);
  io::write_response(folder / "frf" / "coupled_receptance.csv", response);
  io::write_response(folder / "frf" / "coupled_spatial.csv", response);
  const json run = frf_data(folder, {.most_bytes = 100000});
  EXPECT_LE(run.dump().size(), 100000U);
  EXPECT_GT(run.dump().size(), 50000U) << "no more than needed";
  const json& entry = run["frf"][0];
  const auto lines = entry["thinned"]["to"].get<std::size_t>();
  EXPECT_EQ(entry["thinned"]["from"], 30000);
  EXPECT_EQ(entry["hz"]["shape"][0].get<std::size_t>(), lines);
  EXPECT_EQ(run["route_difference"]["shape"][0].get<std::size_t>(), lines) << "beside the coupled lines";
  double highest = 0.0, found = 0.0;
  for (const auto& H : response.H) highest = std::max(highest, std::abs(H(0, 0)));
  const auto H = unpacked<float>(entry["H"]);
  for (std::size_t line = 0; line < lines; ++line)
    found = std::max<double>(found, std::hypot(H[2 * line], H[2 * line + 1]));
  EXPECT_NEAR(found / highest, 1.0, 1e-4);
}

/// A peak one line wide, far below the largest value of the response, and a zero.
TEST(ThinnedLines, KeepTheEndsThePeaksAndTheZeros) {
  dynamics::ResponseModel response;
  response.H.assign(10000, Eigen::MatrixXcd::Constant(1, 1, 1.0));
  for (std::size_t line = 0; line < 10000; ++line) response.H[line](0, 0) = 1.0 / (1.0 + static_cast<double>(line));
  response.H[7777] *= 5.0;
  response.H[8888] *= 0.1;
  const auto kept = thinned_lines({&response}, 100);
  EXPECT_LE(kept.size(), 100U);
  EXPECT_GT(kept.size(), 80U);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  for (const std::size_t line : {0U, 7777U, 8888U, 9999U}) EXPECT_EQ(std::ranges::count(kept, line), 1) << line;
  EXPECT_EQ(thinned_lines({&response}, 10000).size(), 10000U);
}

}  // namespace
}  // namespace thinwall::report::frf_data_test
