#include "setup/materials/cut_materials.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <vector>

namespace thinwall::setup {

namespace {

constexpr std::string_view carbide = "cemented carbide, dry";

/// Milling Force Model for Aviation Aluminum Alloy: Academic Insight and Perspective Analysis, Chinese Journal of
/// Mechanical Engineering 34 (2021), DOI 10.1186/s10033-021-00536-9, Table 5, by the number of its reference; and
/// cases/lei-2022.
constexpr std::array<PublishedCut, 6> table{{
    {"Al6061", 243.77e6, 113.5e6, carbide, "DOI 10.1186/s10033-021-00536-9, Table 5, reference 160 (T6)"},
    {"Al6061", 880e6, 52e6, "end mill of two teeth, 18 mm, slot", "Lei 2022, trials (cases/lei-2022)"},
    {"Al7075-T6", 600.46e6, 180.96e6, carbide, "DOI 10.1186/s10033-021-00536-9, Table 5, reference 160"},
    {"Al7075-T6", 767.01e6, 168.8e6, carbide, "DOI 10.1186/s10033-021-00536-9, Table 5, reference 190"},
    {"Al7075-T6", 951.365e6, 262.597e6, "high-speed steel, dry",
     "DOI 10.1186/s10033-021-00536-9, Table 5, reference 156 (temper not printed)"},
    {"Al7075-T6", 1319.41e6, 788.83e6, carbide,
     "DOI 10.1186/s10033-021-00536-9, Table 5, reference 47 (temper not printed)"},
}};

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The standard deviation that the values estimate, of two at least.
double deviation_of(const std::vector<double>& values) {
  const double mean = mean_of(values);
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return std::sqrt(squares / static_cast<double>(values.size() - 1));
}

std::vector<double> log_radial_shares() {
  std::vector<double> logs;
  logs.reserve(table.size());
  for (const PublishedCut& cut : table) logs.push_back(std::log(cut.K_r / cut.K_t));
  return logs;
}

}  // namespace

std::span<const PublishedCut> published_cuts() {
  return table;
}

double usual_radial_share() {
  return std::exp(mean_of(log_radial_shares()));
}

double radial_share_deviation() {
  return deviation_of(log_radial_shares());
}

std::optional<MaterialCoefficients> coefficients_of(std::string_view material) {
  MaterialCoefficients middle;
  std::vector<double> tangential, radial;
  for (const PublishedCut& cut : table) {
    if (cut.material != material) continue;
    tangential.push_back(std::log(cut.K_t));
    radial.push_back(std::log(cut.K_r));
  }
  middle.tools = static_cast<int>(tangential.size());
  if (middle.tools < 2) return std::nullopt;
  middle.K_t = std::exp(mean_of(tangential));
  middle.K_r = std::exp(mean_of(radial));
  middle.spread = std::max(deviation_of(tangential), deviation_of(radial));
  return middle;
}

}  // namespace thinwall::setup
