#pragma once
// The one-DOF benchmark of Insperger & Stepan (2004) and its values of data/lobes_1dof.csv, computed independently of
// this project's method (Chebyshev collocation, three discretisations agreeing to 1e-9; critical depths confirmed by a
// Hill determinant).

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "milling/cut/process.hpp"
#include "milling/direct/lobe_row.hpp"
#include "milling/structure/relative_structure.hpp"
#include "tests/milling/single_mode.hpp"

namespace thinwall::milling::testing {

struct Reference {
  std::string quantity;
  double immersion, rpm, depth_m, modulus;
  std::string kind;
  double base_hz;

  [[nodiscard]] std::string where() const {
    std::ostringstream text;
    text << quantity << " at a/D = " << immersion << ", " << rpm << " rpm, " << depth_m * 1e3 << " mm";
    return text.str();
  }
  [[nodiscard]] Bifurcation bifurcation() const { return kind == "Hopf" ? Bifurcation::hopf : Bifurcation::flip; }
};

/// Rows of "rho" (|μ| at a depth) or "wcrit_mm" (critical depths).
inline std::vector<Reference> references(const std::string& quantity) {
  std::ifstream file(THINWALL_SOURCE_DIR "/tests/milling/data/lobes_1dof.csv");
  std::vector<Reference> rows;
  std::string line;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::vector<std::string> cell;
    for (std::string text; std::getline(cells, text, ',');) cell.push_back(text);
    if (cell.empty() || cell[0] != quantity) continue;
    rows.push_back({cell[0], std::stod(cell[2]), std::stod(cell[3]), std::stod(cell[4]) * 1e-3, std::stod(cell[5]),
                    cell[8], std::stod(cell[11])});
  }
  return rows;
}

inline RelativeStructure benchmark_structure() {
  return relative_structure(modal_model({{922.0, 0.011, 0.03993, Eigen::Vector3d::UnitX()}}), "P");
}

inline MillingProcess benchmark_process(double immersion, MillingDirection direction = MillingDirection::down) {
  MillingProcess process;
  process.cutter = {2, 0.01};
  process.coefficients = {6e8, 2e8, 0.0, 0.0, 0.0, 0.0};
  process.engagement = engagement_of(process.cutter, immersion * 0.01, direction);
  return process;
}

// The chatter frequency is one of (±arg μ + 2πk)/T, so its distance from a multiple of 1/T is the base frequency.
inline double base_frequency(double chatter_hz, double rpm) {
  const double tooth_hz = rpm * 2.0 / 60.0;
  return std::abs(chatter_hz - tooth_hz * std::round(chatter_hz / tooth_hz));
}

}  // namespace thinwall::milling::testing
