#include "case/templates.hpp"

#include <array>
#include <complex>
#include <numbers>
#include <system_error>

#include "case/template_texts.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/nearest_name.hpp"
#include "core/units.hpp"
#include "io/surface/stl.hpp"

namespace thinwall::cases {

namespace {

/// A bracket of 30 x 80 x 50 mm: a foot of 6 mm and a wall of 3 mm above its edge, extruded along y. In mm.
std::string bracket_stl() {
  constexpr double length = 80.0;
  // x and z of the outline, against the clock seen against y.
  constexpr std::array<std::array<double, 2>, 6> outline{
      {{0.0, 0.0}, {30.0, 0.0}, {30.0, 6.0}, {3.0, 6.0}, {3.0, 50.0}, {0.0, 50.0}}};
  constexpr std::array<std::array<int, 3>, 4> cap{{{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {3, 4, 5}}};
  constexpr int corners = static_cast<int>(outline.size());
  mesh::TriangleSoup soup;
  for (const double y : {0.0, length}) {
    for (const auto& corner : outline) soup.points.emplace_back(corner[0], y, corner[1]);
  }
  for (const auto& t : cap) {
    soup.triangles.push_back({t[0], t[1], t[2]});
    soup.triangles.push_back({corners + t[0], corners + t[2], corners + t[1]});
  }
  for (int i = 0; i < corners; ++i) {
    const int next = (i + 1) % corners;
    soup.triangles.push_back({i, corners + i, corners + next});
    soup.triangles.push_back({i, corners + next, next});
  }
  return io::stl_bytes(soup, 1.0);
}

struct TemplateMode {
  double frequency_hz, damping_ratio, stiffness_n_per_m;
};

/// Receptance of some modes, a line a frequency: 1/k (1 - r^2 + 2 i zeta r), r the frequency over the mode's; in um/N.
std::string receptance_csv(const std::vector<TemplateMode>& modes, int from_hz, int to_hz, int step_hz) {
  std::string text = "# made up by thinwall init from the modes";
  for (const auto& mode : modes)
    text += " " + core::number_text(mode.frequency_hz) + " Hz, " + core::number_text(mode.damping_ratio) + ", " +
            core::number_text(mode.stiffness_n_per_m) + " N/m;";
  text.back() = '\n';
  text += "frequency_hz,real_um_per_n,imaginary_um_per_n\n";
  for (int hz = from_hz; hz <= to_hz; hz += step_hz) {
    std::complex<double> receptance = 0.0;
    for (const auto& mode : modes) {
      const double r = hz / mode.frequency_hz;
      receptance += 1e6 / (mode.stiffness_n_per_m * std::complex(1.0 - r * r, 2.0 * mode.damping_ratio * r));
    }
    text += std::to_string(hz) + "," + core::number_text(receptance.real(), 9) + "," +
            core::number_text(receptance.imag(), 9) + "\n";
  }
  return text;
}

std::vector<TemplateFile> no_files() {
  return {};
}

std::vector<TemplateFile> stl_files() {
  return {{"bracket.stl", bracket_stl()}};
}

std::vector<TemplateFile> frf_files() {
  return {{"part_xx.csv", receptance_csv({{205.0, 0.01, 1.3e6}, {545.0, 0.01, 4.2e6}}, 10, 1000, 1)},
          {"robot_xx.csv", receptance_csv({{29.0, 0.02, 1.7e6}}, 10, 1000, 1)}};
}

std::vector<TemplateFile> tip_files() {
  return {{"tip_xx.csv", receptance_csv({{850.0, 0.03, 2.0e7}, {1650.0, 0.025, 4.0e7}}, 50, 4000, 5)},
          {"tip_yy.csv", receptance_csv({{880.0, 0.03, 2.2e7}, {1600.0, 0.025, 3.6e7}}, 50, 4000, 5)}};
}

struct CaseTemplate {
  std::string name;
  const char* text;
  std::vector<TemplateFile> (*files)();
};

const std::vector<CaseTemplate>& case_templates() {
  static const std::vector<CaseTemplate> list{
      {"plate", plate_template, no_files},        {"wall", wall_template, no_files},
      {"stl-part", stl_part_template, stl_files}, {"robot", robot_template, no_files},
      {"frf-only", frf_only_template, frf_files}, {"lobes", lobes_template, tip_files}};
  return list;
}

const CaseTemplate& template_named(const std::string& name) {
  for (const auto& candidate : case_templates()) {
    if (candidate.name == name) return candidate;
  }
  std::string list;
  for (const auto& known : template_names()) list += (list.empty() ? "" : ", ") + known;
  throw core::UsageError("there is no template \"" + name + "\"" + core::did_you_mean(name, template_names()) +
                         "; there are " + list);
}

}  // namespace

std::vector<std::string> template_names() {
  std::vector<std::string> names;
  for (const auto& known : case_templates()) names.push_back(known.name);
  return names;
}

std::string case_template(const std::string& name) {
  return template_named(name).text;
}

std::vector<TemplateFile> template_files(const std::string& name) {
  return template_named(name).files();
}

std::filesystem::path write_template(const std::string& name, const std::filesystem::path& folder) {
  std::vector<TemplateFile> files = template_files(name);
  files.push_back({"case.toml", case_template(name)});  // the last: a folder with a case is complete
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw core::DataError("cannot make \"" + folder.string() + "\": " + error.message() + "; choose another folder");
  for (const auto& file : files) {
    const auto path = folder / file.name;
    if (std::filesystem::exists(path)) {
      throw core::DataError("\"" + path.string() + "\" is already there and is not overwritten; choose another folder");
    }
  }
  for (const auto& file : files) core::write_file_atomically(folder / file.name, file.content);
  return folder / "case.toml";
}

}  // namespace thinwall::cases
