#pragma once
// `thinwall lobes` in a folder of its own: files of one tool, and what the command answers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>
#include <sstream>
#include <tuple>
#include <utility>

#include "app/case_run.hpp"
#include "app/lobes_input.hpp"
#include "case/reader.hpp"
#include "core/atomic_file.hpp"
#include "io/frf/mat_response.hpp"
#include "io/results/csv_table.hpp"
#include "tests/app/command_call.hpp"
#include "tests/case/case_text.hpp"
#include "tests/core/temporary_folder.hpp"

namespace thinwall::tests {

using namespace setup;
using namespace cases;
using namespace app;

inline const std::string tool_toml = R"([tool]
teeth = 2
diameter = "10 mm"
length = "10 mm"
[cutting]
radial_depth = "1 mm"
feed_direction = "x"
Kt = "600 N/mm^2"
Kr = "200 N/mm^2"
[lobes]
from = "9000 rpm"
to = "16000 rpm"
count = 8
)";

/// The benchmark's tool as tool.toml, modes.csv and tip.csv.
class LobesCommand : public testing::Test {
 protected:
  LobesCommand() {
    write("tool.toml", tool_toml);
    write("modes.csv", "frequency_hz,damping_ratio,mass,direction\n922,0.011,0.03993,x\n");
    write_frf("tip.csv", 0, 1.0);
  }
  void write(const std::string& name, const std::string& text) const {
    core::write_file_atomically(temporary.path / name, text);
  }
  /// The benchmark's mode as receptance (0), mobility (1) or accelerance (2), with the sign of its damping.
  void write_frf(const std::string& name, int derivative, double damping_sign, double to_hz = 6000.0) const {
    std::ostringstream text;
    text.precision(17);
    text << "frequency_hz,real,imaginary\n";
    const double omega_0 = 2.0 * std::numbers::pi * 922.0;
    for (double hz = 2.0; hz <= to_hz; hz += 2.0) {
      const double omega = 2.0 * std::numbers::pi * hz;
      const std::complex<double> stiffness(omega_0 * omega_0 - omega * omega, 0.022 * damping_sign * omega_0 * omega);
      const auto H = std::pow(std::complex<double>(0.0, omega), derivative) / (0.03993 * stiffness);
      text << hz << ',' << H.real() << ',' << H.imag() << '\n';
    }
    write(name, text.str());
  }
  /// A tool's receptance from 0 Hz, as integrated from an accelerometer whose noise hides it below some 10 Hz.
  void write_integrated(const std::string& name, double from_hz) const {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal(0.0, std::pow(2.0 * std::numbers::pi * 10.0, 2) / 2e7);
    std::ostringstream text;
    text.precision(17);
    for (double hz = 0.0; hz <= 2400.0; hz += 1.0) {
      const double r = hz / 620.0, q = hz / 1340.0, omega = 2.0 * std::numbers::pi * std::max(hz, 1.0);
      const double real = normal(random), imaginary = normal(random);
      const std::complex<double> H = 1.0 / (2e7 * std::complex<double>(1.0 - r * r, 0.06 * r)) +
                                     1.0 / (5e7 * std::complex<double>(1.0 - q * q, 0.05 * q)) +
                                     std::complex<double>(real, imaginary) / (omega * omega);
      if (hz >= from_hz) text << hz << ',' << H.real() << ',' << H.imag() << '\n';
    }
    write(name, text.str());
  }
  [[nodiscard]] std::string path(const std::string& name) const { return (temporary.path / name).string(); }
  [[nodiscard]] nlohmann::json summary() const {
    return nlohmann::json::parse(core::read_file(temporary.path / "results" / "summary.json"));
  }
  /// Runs `thinwall lobes` with words after it; results go to results/.
  [[nodiscard]] Outcome lobes(std::vector<std::string> words) const {
    words.insert(words.begin(), "lobes");
    words.insert(words.end(), {"--out", path("results"), "-q"});
    return call(std::move(words), run_case);
  }
  [[nodiscard]] Outcome frf(const std::string& file, std::vector<std::string> more = {},
                            const std::string& quantity = "receptance", const std::string& unit = "m/N") const {
    std::vector<std::string> words{file, "--tool", path("tool.toml"), "--quantity", quantity, "--unit", unit};
    words.insert(words.end(), more.begin(), more.end());
    return lobes(words);
  }

  TemporaryFolder temporary;
};

}  // namespace thinwall::tests
