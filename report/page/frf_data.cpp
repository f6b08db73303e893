#include "report/page/frf_data.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "io/frf/response_csv.hpp"
#include "io/results/csv_table.hpp"
#include "report/page/arrays.hpp"
#include "report/page/thinned_lines.hpp"

namespace thinwall::report {

namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr float nothing = std::numeric_limits<float>::quiet_NaN();

std::size_t index(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

using Lines = std::vector<std::size_t>;

/// At most so many of the DOFs, those of the points first; the others' names go to `left_out`.
std::vector<Eigen::Index> chosen(const dynamics::DofTable& dofs, const FrfChoice& choice,
                                 std::set<std::string>& left_out) {
  std::vector<Eigen::Index> order(dofs.size());
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  std::ranges::stable_sort(order, {}, [&](Eigen::Index i) {
    return std::ranges::find(choice.points_first, dofs[index(i)].point) - choice.points_first.begin();
  });
  for (std::size_t i = choice.most_dofs; i < order.size(); ++i) left_out.insert(dynamics::name(dofs[index(order[i])]));
  order.resize(std::min(choice.most_dofs, order.size()));
  return order;
}

/// The response at these DOFs only.
dynamics::ResponseModel first(const dynamics::ResponseModel& all, const FrfChoice& choice,
                              std::set<std::string>& left_out) {
  const auto rows = chosen(all.responses, choice, left_out), columns = chosen(all.forces, choice, left_out);
  dynamics::ResponseModel kept{all.axis, {}, {}, {}};
  for (const Eigen::Index i : rows) kept.responses.push_back(all.responses[index(i)]);
  for (const Eigen::Index j : columns) kept.forces.push_back(all.forces[index(j)]);
  for (const auto& H : all.H) kept.H.emplace_back(H(rows, columns));
  return kept;
}

/// True if the entry below the diagonal shows nothing that its mirror image does not.
bool mirrors(const dynamics::ResponseModel& response, Eigen::Index i, Eigen::Index j) {
  if (i <= j || i >= std::ssize(response.forces) || j >= std::ssize(response.responses)) return false;
  for (const Eigen::Index k : {i, j}) {
    if (dynamics::name(response.responses[index(k)]) != dynamics::name(response.forces[index(k)])) return false;
  }
  double size = 0.0, difference = 0.0;
  for (const auto& H : response.H) {
    size = std::max(size, std::abs(H(i, j)));
    difference = std::max(difference, std::abs(H(i, j) - H(j, i)));
  }
  return difference <= 1e-6 * size;
}

/// The response with the lines that were added at its resonances, where there is a file of them.
dynamics::ResponseModel with_added_lines(dynamics::ResponseModel response, const fs::path& file) {
  if (!fs::exists(file)) return response;
  dynamics::ResponseModel added = io::read_response(file);
  std::map<double, Eigen::MatrixXcd*> lines;
  for (dynamics::ResponseModel* of : {&response, &added}) {
    for (Eigen::Index line = 0; line < of->axis.size(); ++line) lines[of->axis.hz(line)] = &of->H[index(line)];
  }
  dynamics::ResponseModel all{{Eigen::VectorXd(std::ssize(lines))}, response.responses, response.forces, {}};
  for (const auto& [hz, H] : lines) {
    all.axis.hz(std::ssize(all.H)) = hz;
    all.H.push_back(std::move(*H));
  }
  return all;
}

/// Values of a file's lines at a frequency: its own, or between its neighbours in proportion.
double value_at(const std::vector<double>& hz, const std::vector<double>& values, double at_hz) {
  const auto above = index(std::ranges::lower_bound(hz, at_hz) - hz.begin());
  if (above == hz.size()) return values.back();
  if (above == 0 || hz[above] == at_hz) return values[above];
  const double share = (at_hz - hz[above - 1]) / (hz[above] - hz[above - 1]);
  return (1.0 - share) * values[above - 1] + share * values[above];
}

/// Standard deviations or truncation of the modulus from the file of errors, where it knows the entry; at lines that
/// were added between those of its neighbours.
std::vector<float> deviations(const fs::path& file, const dynamics::ResponseModel& response, const Lines& lines) {
  std::map<std::string, const std::vector<double>*> columns;
  const io::Table table = io::read_csv(file);
  for (const io::Column& column : table) {
    const auto* values = std::get_if<std::vector<double>>(&column.values);
    if (values != nullptr) columns[column.name] = values;
  }
  const auto frequencies = columns.find("frequency_hz");
  std::vector<float> result;
  for (const auto& r : response.responses) {
    for (const auto& f : response.forces) {
      const std::string entry = dynamics::name(r) + "/" + dynamics::name(f);
      for (const std::size_t line : lines) {
        double sum = 0.0;
        bool known = false;
        for (const char* kind : {"noise_deviation ", "truncation "}) {
          const auto column = columns.find(kind + entry);
          if (column == columns.end() || frequencies == columns.end()) continue;
          known = true;
          const double value =
              value_at(*frequencies->second, *column->second, response.axis.hz(static_cast<Eigen::Index>(line)));
          sum += value * value;
        }
        result.push_back(known ? for_picture(std::sqrt(sum), 7) : nothing);
      }
    }
  }
  return result;
}

/// Coherence of every entry from the file of a measurement, also by its transpose; NaN where it has none.
std::vector<float> coherences(const fs::path& file, const dynamics::ResponseModel& response, const Lines& lines) {
  const io::Table table = io::read_csv(file);
  const std::vector<double>& hz = io::numbers(table, "frequency_hz", file);
  const auto column = [&](const dynamics::Dof& r, const dynamics::Dof& f) -> const std::vector<double>* {
    const std::string name = "coherence " + dynamics::name(r) + "/" + dynamics::name(f);
    const auto found = std::ranges::find(table, name, &io::Column::name);
    return found == table.end() ? nullptr : std::get_if<std::vector<double>>(&found->values);
  };
  std::vector<float> result;
  for (const auto& r : response.responses) {
    for (const auto& f : response.forces) {
      const auto* given = column(r, f);
      const auto* values = given != nullptr ? given : column(f, r);
      for (const std::size_t line : lines) {
        const double at_hz = response.axis.hz(static_cast<Eigen::Index>(line));
        result.push_back(values == nullptr ? nothing : for_picture(value_at(hz, *values, at_hz)));
      }
    }
  }
  return result;
}

json entry_of(const std::string& name, const dynamics::ResponseModel& response, const fs::path& errors,
              const fs::path& coherence, const Lines& lines) {
  std::vector<float> H;
  for (Eigen::Index i = 0; i < std::ssize(response.responses); ++i) {
    for (Eigen::Index j = 0; j < std::ssize(response.forces); ++j) {
      const bool left_out = mirrors(response, i, j);
      for (const std::size_t line : lines) {
        H.push_back(left_out ? nothing : for_picture(response.H[line](i, j).real()));
        H.push_back(left_out ? nothing : for_picture(response.H[line](i, j).imag()));
      }
    }
  }
  const std::size_t rows = response.responses.size(), columns = response.forces.size(), all = response.H.size();
  json result = {{"name", name}, {"responses", json::array()}, {"forces", json::array()}};
  std::vector<double> hz;
  for (const std::size_t line : lines) hz.push_back(response.axis.hz(static_cast<Eigen::Index>(line)));
  result["hz"] = packed(hz, {lines.size()});
  for (const auto& dof : response.responses) result["responses"].push_back(dynamics::name(dof));
  for (const auto& dof : response.forces) result["forces"].push_back(dynamics::name(dof));
  result["H"] = packed(H, {rows, columns, lines.size(), 2});
  if (fs::exists(errors))
    result["deviation"] = packed(deviations(errors, response, lines), {rows, columns, lines.size()});
  if (fs::exists(coherence))
    result["coherence"] = packed(coherences(coherence, response, lines), {rows, columns, lines.size()});
  if (lines.size() < all) result["thinned"] = {{"from", all}, {"to", lines.size()}};
  return result;
}

/// The receptances of a folder at the DOFs that are shown.
struct Responses {
  fs::path folder;
  std::vector<std::pair<std::string, dynamics::ResponseModel>> list;
  std::vector<double> route_difference;  ///< largest |G_receptance − G_spatial| over the largest entry, a line each

  [[nodiscard]] fs::path errors_of(const std::string& name) const {
    return name == "coupled_spatial" ? fs::path() : folder / (name.substr(0, name.find('_')) + "_error.csv");
  }
};

std::vector<double> difference(const dynamics::ResponseModel& a, const dynamics::ResponseModel& b) {
  std::vector<double> relative;
  for (std::size_t line = 0; line < a.H.size(); ++line)
    relative.push_back((a.H[line] - b.H[line]).cwiseAbs().maxCoeff() / a.H[line].cwiseAbs().maxCoeff());
  return relative;
}

Responses read(const fs::path& folder, const FrfChoice& choice, std::set<std::string>& left_out) {
  Responses found{folder, {}, {}};
  std::optional<dynamics::ResponseModel> receptance;
  for (const std::string name : {"part", "robot", "coupled_receptance", "coupled_spatial"}) {
    if (!fs::exists(folder / (name + ".csv"))) continue;
    dynamics::ResponseModel all =
        with_added_lines(io::read_response(folder / (name + ".csv")), folder / (name + "_added.csv"));
    found.list.emplace_back(name, first(all, choice, left_out));
    if (name == "coupled_spatial" && receptance && receptance->H.size() == all.H.size() &&
        receptance->responses.size() == all.responses.size())
      found.route_difference = difference(*receptance, all);
    if (name == "coupled_receptance") receptance = std::move(all);
  }
  return found;
}

/// The data with at most so many lines; responses of as many lines keep the same ones.
json with_lines(const Responses& responses, std::size_t most) {
  std::map<std::size_t, std::vector<const dynamics::ResponseModel*>> by_lines;
  for (const auto& [name, response] : responses.list) by_lines[response.H.size()].push_back(&response);
  std::map<std::size_t, Lines> lines;
  for (const auto& [count, same] : by_lines) lines[count] = thinned_lines(same, most);
  json run = {{"frf", json::array()}};
  for (const auto& [name, response] : responses.list)
    run["frf"].push_back(entry_of(name, response, responses.errors_of(name),
                                  responses.folder / (name + "_coherence.csv"), lines[response.H.size()]));
  if (responses.route_difference.empty()) return run;
  std::vector<float> routes;
  for (const std::size_t line : lines[responses.route_difference.size()])
    routes.push_back(static_cast<float>(responses.route_difference[line]));
  run["route_difference"] = packed(routes, {routes.size()});
  return run;
}

}  // namespace

json frf_data(const fs::path& results, const FrfChoice& choice) {
  constexpr std::size_t tried = 20000, least = 100;  // lines: packing more takes seconds
  std::set<std::string> left_out;
  const Responses responses = read(results / "frf", choice, left_out);
  std::size_t lines = 0;
  for (const auto& [name, response] : responses.list) lines = std::max(lines, response.H.size());
  std::size_t most = std::min(lines, tried);
  json run = with_lines(responses, most);
  for (int attempt = 0; attempt < 4; ++attempt) {  // the size is not quite in proportion to the lines
    const std::size_t size = run.dump().size();
    if (size <= choice.most_bytes && (attempt > 0 || most == lines)) break;
    const double fits =
        0.95 * static_cast<double>(most) * static_cast<double>(choice.most_bytes) / static_cast<double>(size);
    most = std::clamp(static_cast<std::size_t>(fits), std::min(least, lines), lines);
    run = with_lines(responses, most);
  }
  run["frf_left_out"] = left_out;
  return run;
}

}  // namespace thinwall::report
