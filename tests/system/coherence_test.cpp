// The coherence of measured FRFs from their files to the result folder, on the lines of the run.

#include <gtest/gtest.h>

#include <complex>
#include <filesystem>
#include <numbers>
#include <sstream>

#include "core/atomic_file.hpp"
#include "tests/system/run_in_folder.hpp"

namespace thinwall::tests::coherence_test {
namespace {

namespace fs = std::filesystem;

/// A mass (kg) on a spring, every 4 Hz, with a coherence that rises with the frequency if it has one.
void write_receptance(const fs::path& file, double mass, bool coherent) {
  std::ostringstream text;
  text.precision(17);
  text << "frequency_hz,real,imaginary" << (coherent ? ",coherence\n" : "\n");
  for (double hz = 4.0; hz <= 1000.0; hz += 4.0) {
    const double omega = 2.0 * std::numbers::pi * hz;
    const std::complex<double> H = 1.0 / std::complex<double>(1e6 - omega * omega * mass, 30.0 * omega);
    text << hz << ',' << H.real() << ',' << H.imag();
    if (coherent) text << ',' << 0.95 + 5e-5 * hz;
    text << '\n';
  }
  core::write_file_atomically(file, text.str());
}

std::string frf(const std::string& owner, const std::string& dof, const std::string& file) {
  return "[[" + owner + ".measured]]\nresponse = \"" + dof + "\"\nforce = \"" + dof + "\"\nfile = \"" + file +
         "\"\nquantity = \"receptance\"\nunit = \"m/N\"\n";
}

TEST(Coherence, OfWhatWasMeasuredIsWrittenOnTheLinesOfTheRun) {
  const fs::path folder = scratch("coherence");
  for (const bool robot_too : {true, false}) {
    write_receptance(folder / "part.csv", 2.0, true);
    write_receptance(folder / "robot.csv", 5.0, robot_too);
    (void)run(frf("part", "P.x", "part.csv") + "[robot]\nmodel = \"measured\"\n" + frf("robot", "R.x", "robot.csv") +
                  "[[contacts]]\npart = \"P\"\n[response]\nfrom = \"21 Hz\"\nto = \"500 Hz\"\nlines = 480\n",
              folder);
    const fs::path file = folder / "frf" / "part_coherence.csv";
    const auto hz = column(file, "frequency_hz"), coherence = column(file, "coherence P.x/P.x");
    ASSERT_EQ(hz.size(), 480U);
    for (std::size_t i = 0; i < hz.size(); ++i) EXPECT_NEAR(coherence[i], 0.95 + 5e-5 * hz[i], 1e-12);
    EXPECT_EQ(fs::exists(folder / "frf" / "robot_coherence.csv"), robot_too);
  }
}

}  // namespace
}  // namespace thinwall::tests::coherence_test
