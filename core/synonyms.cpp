#include "core/synonyms.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

namespace thinwall::core {

namespace {

// clang-format off
constexpr std::array table{
    Synonym{WordKind::key, "ae|a_e|woc|width_of_cut|radial_engagement|radial_immersion|stepover|step_over", "radial_depth"},
    Synonym{WordKind::key, "ap|a_p|doc|depth|depth_of_cut|axial_depth", "depth_limit", "a chart finds the depth, up to this limit; --at \"5000 rpm, 0.5 mm\" asks about one"},
    Synonym{WordKind::key, "fz|f_z|ft|chip_load", "feed_per_tooth"},
    Synonym{WordKind::key, "vf|v_f|feed|feed_speed", "feed_rate"},
    Synonym{WordKind::key, "n|rpm|speed|spindle", "spindle_speed"},
    Synonym{WordKind::key, "climb|milling|milling_mode|milling_direction", "mode"},
    Synonym{WordKind::key, "phi_st|phi_in|start_angle", "entry_angle"},
    Synonym{WordKind::key, "phi_ex|phi_out|end_angle", "exit_angle"},
    Synonym{WordKind::key, "Ktc|K_tc|kc|Ks|kc1.1|kc11", "Kt"},
    Synonym{WordKind::key, "Krc|K_rc|Kn", "Kr"},
    Synonym{WordKind::key, "Kac|K_ac", "Ka"},
    Synonym{WordKind::key, "mc|m_c", "exponents"},
    Synonym{WordKind::key, "z|flutes|tooth_count|number_of_teeth|number_of_flutes", "teeth"},
    Synonym{WordKind::key, "d|dc|dia", "diameter"},
    Synonym{WordKind::key, "flute_length|cutting_length|apmx", "length"},
    Synonym{WordKind::key, "helix|helix_angle|beta", "helices"},
    Synonym{WordKind::key, "pitch|pitch_angles", "pitches"},
    Synonym{WordKind::key, "E|young|elastic_modulus", "youngs_modulus"},
    Synonym{WordKind::key, "nu|poisson", "poisson_ratio"},
    Synonym{WordKind::key, "rho", "density"},
    Synonym{WordKind::key, "t|wall|wall_thickness", "thickness"},
    Synonym{WordKind::key, "pocket|pockets|rib|ribs", "zones", "a zone has a thickness of its own"},
    Synonym{WordKind::key, "point|part_point|on_part", "part"},
    Synonym{WordKind::key, "zeta|xi|damping", "damping_ratio"},
    Synonym{WordKind::key, "zeta|xi|damping_ratio", "ratio"},
    Synonym{WordKind::key, "eta", "loss_factor"},
    Synonym{WordKind::key, "f|fn|f_n|natural_frequency|eigenfrequency", "frequency"},
    Synonym{WordKind::key, "k|modal_stiffness", "stiffness"},
    Synonym{WordKind::key, "m|modal_mass|weight", "mass"},
    Synonym{WordKind::key, "min|start|lowest", "from"},
    Synonym{WordKind::key, "max|stop|end|highest", "to"},
    Synonym{WordKind::key, "steps|points|speeds|number", "count"},
    Synonym{WordKind::key, "n_min|min_speed|min_rpm", "min_spindle_speed"},
    Synonym{WordKind::key, "n_max|max_speed|max_rpm", "max_spindle_speed"},
    Synonym{WordKind::key, "mesh_size|size|element_length", "element_size"},
    Synonym{WordKind::word, "climb|climb_milling|down_milling|down-milling", "down"},
    Synonym{WordKind::word, "conventional|conventional_milling|up_milling|up-milling", "up"},
    Synonym{WordKind::word, "kienzle", "power"},
    Synonym{WordKind::word, "compliance|displacement|dynamic_flexibility", "receptance"},
    Synonym{WordKind::word, "velocity|admittance", "mobility"},
    Synonym{WordKind::word, "inertance|acceleration", "accelerance"},
    Synonym{WordKind::word, "viscous", "modal"},
    Synonym{WordKind::word, "proportional", "rayleigh"},
    Synonym{WordKind::word, "hysteretic", "structural"},
    Synonym{WordKind::word, "zoa|single_frequency", "zeroth_order"},
    Synonym{WordKind::word, "sdm|semi_discretization", "semi_discretization_1"},
    Synonym{WordKind::word, "fdm|full_discretization", "full_discretization_2"},
    Synonym{WordKind::word, "static|static_condensation|irons", "guyan"},
    Synonym{WordKind::unit, "1/min|min^-1|min-1|/min|rev/min|r/min|U/min|tr/min", "rpm"},
    Synonym{WordKind::unit, "mm/tooth|mm/z|mm/rev", "mm", "the key says of what"},
    Synonym{WordKind::unit, "micron|microns|micrometer|micrometre", "um"},
    Synonym{WordKind::unit, "degree|degrees", "deg"},
    Synonym{WordKind::unit, "sec|second|seconds", "s"},
    Synonym{WordKind::unit, "inches", "in"},
    Synonym{WordKind::unit, "percent", "%"},
    Synonym{WordKind::unit, "Nm", "N m"},
    Synonym{WordKind::unit, "N/mm2", "N/mm^2"},
    Synonym{WordKind::unit, "kg/m3", "kg/m^3"},
    Synonym{WordKind::unit, "m/s2", "m/s^2"},
    Synonym{WordKind::command, "compute|solve|start", "run"},
    Synonym{WordKind::command, "march|chatter", "simulate"},
    Synonym{WordKind::command, "new|create|template", "init"},
    Synonym{WordKind::command, "validate|verify|lint", "check"},
    Synonym{WordKind::command, "diff", "compare"},
    Synonym{WordKind::command, "chart|sld|stability", "lobes"},
    Synonym{WordKind::command, "scan|grid", "sweep"},
    Synonym{WordKind::command, "page|html|plot", "report"},
    Synonym{WordKind::option, "-o|--output|--results|--result|--folder|--dir", "--out"},
    Synonym{WordKind::option, "-j|--jobs|--cores", "--threads"},
};
// clang-format on

std::string in_small_letters(std::string_view text) {
  std::string small(text);
  std::ranges::transform(small, small.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

/// The written words of a row.
std::vector<std::string_view> words_of(const Synonym& row) {
  std::vector<std::string_view> words;
  for (std::string_view rest = row.written; !rest.empty();) {
    const auto bar = std::min(rest.find('|'), rest.size());
    words.push_back(rest.substr(0, bar));
    rest.remove_prefix(std::min(bar + 1, rest.size()));
  }
  return words;
}

std::string_view title_of(WordKind kind) {
  switch (kind) {
    case WordKind::key:
      return "key";
    case WordKind::word:
      return "word";
    case WordKind::unit:
      return "unit";
    case WordKind::command:
      return "command";
    case WordKind::option:
      break;
  }
  return "option";
}

}  // namespace

std::span<const Synonym> synonyms() {
  return table;
}

std::vector<Synonym> meanings(std::string_view name) {
  const std::string small = in_small_letters(name);
  std::vector<Synonym> rows;
  std::ranges::copy_if(table, std::back_inserter(rows), [&](const Synonym& row) {
    return std::ranges::any_of(words_of(row), [&](auto written) { return in_small_letters(written) == small; });
  });
  return rows;
}

std::string meant_name(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string small = in_small_letters(name);
  for (const std::string& candidate : candidates) {
    if (in_small_letters(candidate) == small) return candidate;
  }
  const auto last = name.rfind('.') + 1;  // npos + 1 is 0
  for (const Synonym& row : meanings(name.substr(last))) {
    std::string own = std::string(name.substr(0, last)) + std::string(row.meant);
    if (std::ranges::find(candidates, own) != candidates.end()) return own;
    const std::string ending = "." + std::string(row.meant);
    const auto elsewhere = std::ranges::find_if(candidates, [&](const auto& text) { return text.ends_with(ending); });
    if (elsewhere != candidates.end()) return *elsewhere;
  }
  return "";
}

std::string meant_unit(std::string_view text) {
  for (const Synonym& row : meanings(text)) {
    if (row.kind == WordKind::unit) return std::string(row.meant);
  }
  return "";
}

std::string synonyms_markdown() {
  std::string text = "| written | meant | |\n|---|---|---|\n";
  for (const Synonym& row : table) {
    text += "|";
    for (bool first = true; const auto written : words_of(row)) {
      text += (first ? " `" : ", `") + std::string(written) + "`";
      first = false;
    }
    text += " | " + std::string(title_of(row.kind)) + " `" + std::string(row.meant) + "` | " + std::string(row.remark) +
            " |\n";
  }
  return text;
}

}  // namespace thinwall::core
