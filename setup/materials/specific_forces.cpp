#include "setup/materials/specific_forces.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "setup/materials/cut_materials.hpp"

namespace thinwall::setup {

namespace {

constexpr double MPa = 1e6;

constexpr std::string_view iscar =
    "ISCAR, material groups by DIN/ISO 513 and VDI 3323, turning catalogue 2017, page 558, and Multi-Master, page 88";
constexpr std::string_view iscar_2017 = "ISCAR, material groups by VDI 3323, turning catalogue 2017, page 558";
constexpr std::string_view iscar_2022 = "ISCAR, material groups by VDI 3323, boring systems 2022, page 111";
constexpr std::string_view mitsubishi = "Mitsubishi Materials, technical information, cutting power for face milling";
constexpr std::string_view tungaloy = "Tungaloy, general catalogue 2020-2021, page 1650, milling tools";

/// Feeds per tooth of the two tables of forces, m.
constexpr std::array<double, 5> mitsubishi_feeds{0.1e-3, 0.2e-3, 0.3e-3, 0.4e-3, 0.6e-3};
constexpr std::array<double, 5> tungaloy_feeds{0.1e-3, 0.15e-3, 0.2e-3, 0.3e-3, 0.4e-3};

constexpr PublishedSpecificForce group(std::string_view name, double k_1, double exponent,
                                       std::string_view source = iscar) {
  return {name, k_1 * MPa, exponent, {}, {}, source};
}

using Forces = std::array<double, 5>;

constexpr Forces in_MPa(Forces forces) {
  for (double& force : forces) force *= MPa;
  return forces;
}

constexpr Forces mild_m = in_MPa({2200, 1950, 1820, 1700, 1580}), mild_t = in_MPa({2150, 2000, 1900, 1750, 1650});
constexpr Forces medium_m = in_MPa({1980, 1800, 1730, 1600, 1570});
constexpr Forces hard_m = in_MPa({2520, 2200, 2040, 1850, 1740}), hard_t = in_MPa({1970, 1860, 1800, 1760, 1620});
constexpr Forces chrome_manganese_m = in_MPa({2750, 2300, 2060, 1800, 1780});
constexpr Forces chrome_moly_m = in_MPa({2540, 2250, 2140, 2000, 1800});
constexpr Forces chrome_moly_t = in_MPa({2450, 2350, 2200, 1980, 1710});
constexpr Forces nickel_chrome_m = in_MPa({2000, 1800, 1680, 1600, 1500});
constexpr Forces austenitic_m = in_MPa({2030, 1970, 1900, 1770, 1710});
constexpr Forces grey_m = in_MPa({1750, 1400, 1240, 1050, 970}), grey_t = in_MPa({1660, 1450, 1320, 1150, 1030});
constexpr Forces brass_m = in_MPa({1150, 950, 800, 700, 630}), brass_t = in_MPa({1090, 960, 877, 760, 680});
constexpr Forces al_mg_m = in_MPa({580, 480, 400, 350, 320}), al_zn_m = in_MPa({880, 840, 840, 810, 720});
constexpr Forces al_si_m = in_MPa({700, 600, 490, 450, 390}), al_si_t = in_MPa({660, 580, 522, 460, 410});

constexpr PublishedSpecificForce at_feeds_m(std::string_view name, const Forces& forces) {
  return {name, 0.0, 0.0, mitsubishi_feeds, forces, mitsubishi};
}

constexpr PublishedSpecificForce at_feeds_t(std::string_view name, const Forces& forces) {
  return {name, 0.0, 0.0, tungaloy_feeds, forces, tungaloy};
}

constexpr auto mild_1 = group("group 1, non-alloy steel below 0.25 % C, annealed, 420 N/mm²", 1350, 0.21);
constexpr auto carbon_2 = group("group 2, non-alloy steel from 0.25 % C, annealed, 650 N/mm²", 1500, 0.22);
constexpr auto carbon_4 = group("group 4, non-alloy steel from 0.55 % C, annealed, 750 N/mm²", 1700, 0.24);
constexpr auto low_alloy_6 = group("group 6, low alloy steel, annealed, 600 N/mm²", 1775, 0.24);
constexpr auto low_alloy_7 = group("group 7, low alloy steel, quenched and tempered, 930 N/mm²", 1675, 0.24);
constexpr auto low_alloy_8 = group("group 8, low alloy steel, quenched and tempered, 1000 N/mm²", 1725, 0.24);
constexpr auto martensitic_13 = group("group 13, stainless steel, martensitic, 820 N/mm²", 1875, 0.21);
constexpr auto austenitic_14 = group("group 14, stainless steel, austenitic, 600 N/mm²", 2150, 0.20);
constexpr auto wrought_21 = group("group 21, wrought aluminium, not cureable, 60 HB", 700, 0.25);
constexpr auto wrought_22 = group("group 22, wrought aluminium, cured, 100 HB", 800, 0.25);
constexpr auto cast_24 = group("group 24, cast aluminium up to 12 % Si, cured, 90 HB", 700, 0.25);
constexpr auto brass_27 = group("group 27, brass, 90 HB", 700, 0.27);
constexpr auto iron_32 = group("group 32, Fe based high temperature alloys, cured, 280 HB", 3100, 0.24);
constexpr auto nickel_33 = group("group 33, Ni or Co based high temperature alloys, annealed, 250 HB", 3300, 0.24);
constexpr auto nickel_34 = group("group 34, Ni or Co based high temperature alloys, cured, 350 HB", 3300, 0.24);
constexpr auto titanium_36 = group("group 36, titanium, 400 N/mm²", 1700, 0.23, iscar_2017);
constexpr auto titanium_36_new = group("group 36, titanium, pure, 400 N/mm²", 1160, 0.24, iscar_2022);
constexpr auto titanium_37 = group("group 37, titanium, alpha+beta alloys, cured, 1050 N/mm²", 2110, 0.22, iscar_2017);
constexpr auto titanium_37_new = group("group 37, alpha+beta alloys, hardened, 1050 N/mm²", 1245, 0.24, iscar_2022);

constexpr auto mild_520 = at_feeds_m("mild steel, 520 MPa", mild_m);
constexpr auto mild_ss400 = at_feeds_t("SS400, 520 MPa", mild_t);
constexpr auto medium_620 = at_feeds_m("medium steel, 620 MPa", medium_m);
constexpr auto hard_720 = at_feeds_m("hard steel, 720 MPa", hard_m);
constexpr auto hard_s55c = at_feeds_t("S55C, 770 MPa", hard_t);
constexpr auto chrome_manganese_630 = at_feeds_m("chrome manganese steel, 630 MPa", chrome_manganese_m);
constexpr auto chrome_moly_730 = at_feeds_m("chrome molybdenum steel, 730 MPa", chrome_moly_m);
constexpr auto chrome_moly_scm435 = at_feeds_t("SCM435, 730 MPa", chrome_moly_t);
constexpr auto nickel_chrome_940 = at_feeds_m("nickel chrome molybdenum steel, 940 MPa", nickel_chrome_m);
constexpr auto austenitic_155 = at_feeds_m("austenitic stainless steel, 155 HB", austenitic_m);
constexpr auto grey_200 = at_feeds_m("grey cast iron, 200 HB", grey_m);
constexpr auto grey_fc250 = at_feeds_t("FC250, 200 HB", grey_t);
constexpr auto brass_500 = at_feeds_m("brass, 500 MPa", brass_m);
constexpr auto brass_500_t = at_feeds_t("brass, 500 MPa", brass_t);
constexpr auto al_mg_160 = at_feeds_m("light alloy (Al-Mg), 160 MPa", al_mg_m);
constexpr auto al_zn_570 = at_feeds_m("light alloy (Al-Zn-Mg-Cu), 570 MPa", al_zn_m);
constexpr auto al_si_200 = at_feeds_m("light alloy (Al-Si), 200 MPa", al_si_m);
constexpr auto al_si_200_t = at_feeds_t("Al (Si), 200 MPa", al_si_t);

const std::vector<AlloyClasses>& all_alloys() {
  static const std::vector<AlloyClasses> alloys{
      {"16MnCr5", {&low_alloy_6, &chrome_manganese_630}},
      {"34CrNiMo6", {&low_alloy_8, &nickel_chrome_940}},
      {"42CrMo4", {&low_alloy_7, &chrome_moly_730, &chrome_moly_scm435}},
      {"A286", {&iron_32}},
      {"AISI304", {&austenitic_14, &austenitic_155}},
      {"AISI316L", {&austenitic_14, &austenitic_155}},
      {"Al2024", {&wrought_22}},
      {"Al5083", {&wrought_21, &al_mg_160}},
      {"Al6061", {&wrought_22}},
      {"Al6082", {&wrought_22}},
      {"Al7050", {&wrought_22, &al_zn_570}},
      {"Al7075-T6", {&wrought_22, &al_zn_570}},
      {"AlSi10Mg", {&cast_24, &al_si_200, &al_si_200_t}},
      {"brass", {&brass_27, &brass_500, &brass_500_t}},
      {"C45", {&carbon_2, &medium_620}},
      {"C55", {&carbon_4, &hard_720, &hard_s55c}},
      {"GJL-250", {&grey_200, &grey_fc250}},
      {"Inconel625", {&nickel_33}},
      {"Inconel718", {&nickel_34}},
      {"S235", {&mild_1, &mild_520, &mild_ss400}},
      {"Ti-grade2", {&titanium_36, &titanium_36_new}},
      {"Ti6Al4V", {&titanium_37, &titanium_37_new}},
      {"X20Cr13", {&martensitic_13}},
  };
  return alloys;
}

double log_force(const PublishedSpecificForce& published, double chip_m) {
  const KienzleConstants law = kienzle_constants(published);
  return std::log(law.k_1) - law.exponent * std::log(chip_m / 1e-3);
}

/// The sum of squared deviations of ln k_c at the compared chip from their mean.
double squares_of(const AlloyClasses& alloy) {
  double mean = 0.0, squares = 0.0;
  for (const PublishedSpecificForce* published : alloy.classes) mean += log_force(*published, compared_chip_m);
  mean /= static_cast<double>(alloy.classes.size());
  for (const PublishedSpecificForce* published : alloy.classes)
    squares += std::pow(log_force(*published, compared_chip_m) - mean, 2);
  return squares;
}

double spread_of(const AlloyClasses& alloy) {
  if (alloy.classes.size() < 2) return pooled_spread();
  return std::max(pooled_spread(), std::sqrt(squares_of(alloy) / static_cast<double>(alloy.classes.size() - 1)));
}

}  // namespace

std::span<const AlloyClasses> alloy_classes() {
  return all_alloys();
}

KienzleConstants kienzle_constants(const PublishedSpecificForce& published) {
  if (published.forces.empty()) return {published.k_1, published.exponent};
  const auto count = static_cast<double>(published.forces.size());
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < published.forces.size(); ++i) {
    const double log_chip = std::log(published.chips[i] / 1e-3), log_force = std::log(published.forces[i]);
    x += log_chip;
    y += log_force;
    xx += log_chip * log_chip;
    xy += log_chip * log_force;
  }
  const double slope = (count * xy - x * y) / (count * xx - x * x);
  return {std::exp((y - slope * x) / count), -slope};
}

std::optional<PowerLawCoefficients> power_law_of(std::string_view material) {
  const auto alloy = std::ranges::find(all_alloys(), material, &AlloyClasses::material);
  if (alloy == all_alloys().end()) return std::nullopt;
  PowerLawCoefficients middle;
  middle.sources = static_cast<int>(alloy->classes.size());
  double log_k_1 = 0.0;
  for (const PublishedSpecificForce* published : alloy->classes) {
    const KienzleConstants law = kienzle_constants(*published);
    log_k_1 += std::log(law.k_1) / middle.sources;
    middle.exponent += law.exponent / middle.sources;
    if (!published->chips.empty()) middle.thinnest_chip_m = published->chips.front();  // the same of all tables
  }
  middle.K_t = std::exp(log_k_1);
  middle.K_r = usual_radial_share() * middle.K_t;
  middle.spread = spread_of(*alloy);
  middle.spread_with_radial = std::hypot(middle.spread, radial_share_deviation());
  return middle;
}

double pooled_spread() {
  double squares = 0.0, freedoms = 0.0;
  std::vector<std::vector<const PublishedSpecificForce*>> seen;
  for (const AlloyClasses& alloy : all_alloys()) {
    if (std::ranges::find(seen, alloy.classes) != seen.end()) continue;
    seen.push_back(alloy.classes);
    squares += squares_of(alloy);
    freedoms += static_cast<double>(alloy.classes.size()) - 1.0;
  }
  return std::sqrt(squares / freedoms);
}

}  // namespace thinwall::setup
