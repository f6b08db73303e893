#include "report/page/tool_frf_data.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/response_model.hpp"
#include "io/results/csv_table.hpp"
#include "report/page/agreement.hpp"
#include "report/page/arrays.hpp"
#include "report/page/thinned_lines.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

float for_picture_or_nothing(double value) {
  return std::isnan(value) ? nothing : for_picture(value);
}

bool has(const io::Table& table, const std::string& column) {
  return std::ranges::count(table, column, &io::Column::name) > 0;
}

/// "x" and "y" of the columns "re x/y m/N": all responses, then all forces, each once.
std::pair<std::vector<std::string>, std::vector<std::string>> directions(const io::Table& table) {
  std::vector<std::string> responses, forces;
  const auto add = [](std::vector<std::string>& list, const std::string& name) {
    if (std::ranges::count(list, name) == 0) list.push_back(name);
  };
  for (const io::Column& column : table) {
    const std::size_t slash = column.name.find('/'), end = column.name.find(" m/N");
    if (!column.name.starts_with("re ") || slash == std::string::npos || end == std::string::npos) continue;
    add(responses, column.name.substr(3, slash - 3));
    add(forces, column.name.substr(slash + 1, end - slash - 1));
  }
  return {responses, forces};
}

/// The lines that are drawn: those with the peaks of what was measured, wherever in the matrix it stands.
std::vector<std::size_t> lines_of(const io::Table& table, const std::filesystem::path& file, std::size_t most) {
  dynamics::ResponseModel measured;
  const std::vector<double>& hz = io::numbers(table, "frequency_hz", file);
  measured.axis.hz = Eigen::Map<const Eigen::VectorXd>(hz.data(), std::ssize(hz));
  std::vector<const std::vector<double>*> parts;
  for (const io::Column& column : table) {
    if (column.name.starts_with("re ") || column.name.starts_with("im "))
      parts.push_back(&io::numbers(table, column.name, file));
  }
  const auto count = std::ssize(parts) / 2;
  for (Eigen::Index i = 0; i < count; ++i)
    measured.responses.push_back({std::to_string(i), Eigen::Vector3d::UnitX(), dynamics::DofKind::translation});
  measured.forces = measured.responses;
  for (std::size_t line = 0; line < hz.size(); ++line) {
    measured.H.emplace_back(Eigen::MatrixXcd::Zero(count, count));
    for (Eigen::Index i = 0; i < count; ++i) {
      const auto at = static_cast<std::size_t>(2 * i);
      measured.H.back()(i, i) = {(*parts[at])[line], (*parts[at + 1])[line]};
    }
  }
  return thinned_lines({&measured}, most);
}

/// The figures of an entry besides its receptance: the lines of the poles' and how well both agree.
struct Synthesised {
  std::vector<double> real, imaginary;
  Agreement agreement;
};

std::optional<Synthesised> synthesised_of(const io::Table& table, const std::filesystem::path& file,
                                          const std::string& entry) {
  if (!has(table, "synthesised re " + entry + " m/N")) return std::nullopt;
  Synthesised found{io::numbers_or_gaps(table, "synthesised re " + entry + " m/N", file),
                    io::numbers_or_gaps(table, "synthesised im " + entry + " m/N", file),
                    {}};
  const auto &re = io::numbers(table, "re " + entry + " m/N", file),
             &im = io::numbers(table, "im " + entry + " m/N", file);
  Eigen::VectorXcd H(std::ssize(re)), G(std::ssize(re));
  for (std::size_t line = 0; line < re.size(); ++line) {
    H(static_cast<Eigen::Index>(line)) = {re[line], im[line]};
    G(static_cast<Eigen::Index>(line)) = {found.real[line], found.imaginary[line]};
  }
  const std::optional<Agreement> agreement = agreement_of(H, G);
  if (!agreement) return std::nullopt;
  found.agreement = *agreement;
  return found;
}

}  // namespace

json tool_frf_data(const std::filesystem::path& file, std::size_t most) {
  if (!std::filesystem::exists(file)) return nullptr;
  const io::Table table = io::read_csv(file);
  const std::vector<double>& all_hz = io::numbers(table, "frequency_hz", file);
  const std::vector<std::size_t> lines = lines_of(table, file, most);
  const auto [responses, forces] = directions(table);
  std::vector<double> hz;
  hz.reserve(lines.size());
  for (const std::size_t line : lines) hz.push_back(all_hz[line]);
  std::vector<float> H, coherence, poles;
  std::vector<double> agreement;
  bool coherent = false, fitted = false;
  for (const std::string& r : responses) {
    for (const std::string& f : forces) {
      const std::string entry = fmt::format("{}/{}", r, f);
      const auto column = [&](const std::string& name) {
        return has(table, name) ? &io::numbers(table, name, file) : nullptr;
      };
      const auto *re = column("re " + entry + " m/N"), *im = column("im " + entry + " m/N"),
                 *quality = column("coherence " + entry);
      coherent = coherent || quality != nullptr;
      for (const std::size_t line : lines) {
        H.push_back(re != nullptr ? for_picture((*re)[line]) : nothing);
        H.push_back(im != nullptr ? for_picture((*im)[line]) : nothing);
        coherence.push_back(quality != nullptr ? for_picture((*quality)[line]) : nothing);
      }
      const auto synthesised = synthesised_of(table, file, entry);
      fitted = fitted || synthesised.has_value();
      for (const std::size_t line : lines) {
        poles.push_back(synthesised ? for_picture_or_nothing(synthesised->real[line]) : nothing);
        poles.push_back(synthesised ? for_picture_or_nothing(synthesised->imaginary[line]) : nothing);
      }
      agreement.push_back(synthesised ? synthesised->agreement.frac : std::nan(""));
      agreement.push_back(synthesised ? synthesised->agreement.error : std::nan(""));
    }
  }
  json frf = {{"name", "tool"}, {"responses", responses}, {"forces", forces}, {"hz", packed(hz, {hz.size()})}};
  frf["H"] = packed(H, {responses.size(), forces.size(), lines.size(), 2});
  if (coherent) frf["coherence"] = packed(coherence, {responses.size(), forces.size(), lines.size()});
  if (fitted) {
    frf["synthesised"] = packed(poles, {responses.size(), forces.size(), lines.size(), 2});
    frf["agreement"] = packed(agreement, {responses.size(), forces.size(), 2});
  }
  if (lines.size() < all_hz.size()) frf["thinned"] = {{"from", all_hz.size()}, {"to", lines.size()}};
  return frf;
}

}  // namespace thinwall::report
