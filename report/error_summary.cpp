#include "report/error_summary.hpp"

#include <algorithm>
#include <cmath>

#include "io/results/csv_table.hpp"

namespace thinwall::report {

namespace {

using Eigen::Index;

/// |a| of the largest entry.
template <typename Matrix>
double largest_entry(const Matrix& A) {
  return std::sqrt(A.cwiseAbs2().maxCoeff());
}

/// The largest entry of `errors` relative to the largest of the response on its line.
template <typename Matrix>
LargestErrorSummary largest(const dynamics::ResponseModel& response, const std::vector<Matrix>& errors) {
  double relative = 0.0, at_hz = response.axis.hz(0);
  for (std::size_t line = 0; line < errors.size(); ++line) {
    const double here = largest_entry(errors[line]) / largest_entry(response.H[line]);
    if (!(here > relative)) continue;
    relative = here;
    at_hz = response.axis.hz(static_cast<Index>(line));
  }
  return {relative, at_hz};
}

/// The errors of a response; none where nothing is known to be wrong.
std::optional<ResponseErrorsSummary> response_errors(const dynamics::ResponseModel& response,
                                                     const study::ResponseErrors& errors) {
  if (errors.truncation.empty() && errors.noise.empty()) return std::nullopt;
  ResponseErrorsSummary result;
  if (!errors.truncation.empty()) result.truncation = largest(response, errors.truncation);
  if (!errors.noise.empty()) result.noise = largest(response, errors.noise);
  return result;
}

/// Rows of the response between the points; all if there is none of them.
std::vector<Index> rows_at(const dynamics::ResponseModel& response, const std::vector<std::string>& points) {
  std::vector<Index> chosen, all;
  for (std::size_t i = 0; i < response.responses.size(); ++i) {
    all.push_back(static_cast<Index>(i));
    if (std::ranges::find(points, response.responses[i].point) != points.end()) chosen.push_back(all.back());
  }
  return chosen.empty() ? all : chosen;
}

template <typename Matrix>
void add_columns(io::Table& table, const std::string& what, const dynamics::ResponseModel& response,
                 const std::vector<Matrix>& errors, const std::vector<Index>& rows) {
  if (errors.empty()) return;
  for (const Index i : rows) {
    for (const Index j : rows) {
      std::vector<double> values;
      values.reserve(errors.size());
      for (const Matrix& line : errors) values.push_back(std::abs(line(i, j)));
      table.push_back({what + " " + dynamics::name(response.responses[static_cast<std::size_t>(i)]) + "/" +
                           dynamics::name(response.forces[static_cast<std::size_t>(j)]),
                       values});
    }
  }
}

}  // namespace

ErrorBudgetSummary error_budget_summary(const study::Results& results) {
  ErrorBudgetSummary budget;
  if (results.part) budget.part = response_errors(results.part->response, results.errors.part);
  if (results.robot) budget.robot = response_errors(results.robot->response, results.errors.robot);
  if (results.coupled) budget.coupled = response_errors(results.coupled->receptance.response, results.errors.coupled);
  return budget;
}

std::optional<ChartErrorsSummary> chart_errors_summary(const study::StructureLobes& named) {
  if (named.errors.empty()) return std::nullopt;
  std::optional<double> truncation, noise, identification;
  const study::DepthError* least = nullptr;
  for (std::size_t i = 0; i < named.errors.size(); ++i) {
    const study::DepthError& error = named.errors[i];
    const double depth = named.lobes.rows[i].limiting_depth_m;
    if (named.lobes.rows[i].spindle_speed_rpm == named.lobes.at_spindle_speed_rpm) least = &error;
    if (error.truncation_m) truncation = std::max(truncation.value_or(0.0), std::abs(*error.truncation_m) / depth);
    if (error.low_m && error.high_m)
      identification =
          std::max({identification.value_or(0.0), 1.0 - *error.low_m / depth, *error.high_m / depth - 1.0});
    if (error.noise_m) noise = std::max(noise.value_or(0.0), *error.noise_m / depth);
  }
  ChartErrorsSummary result{truncation, noise, identification, {}};
  if (least != nullptr) result.at_minimum = row_errors_summary(*least, std::nullopt, 0);
  return result;
}

DepthErrorsSummary row_errors_summary(const study::DepthError& error,
                                      const std::optional<milling::DepthScatter>& scatter, int seed) {
  DepthErrorsSummary result{error.truncation_m, error.noise_m, {}, {}};
  if (error.low_m && error.high_m) result.identification = {*error.low_m, *error.high_m};
  if (!scatter) return result;
  const auto with_limit = std::ssize(scatter->depth_m) - scatter->without_limit;
  SampledDepthSummary& sampled = result.sampled.emplace();
  sampled.draws = std::ssize(scatter->depth_m);
  sampled.seed = seed;
  if (with_limit > 0) sampled.mean_m = scatter->mean_m;
  if (with_limit > 1) sampled.deviation_m = scatter->deviation_m;
  sampled.without_limit = scatter->without_limit;
  return result;
}

void write_response_errors(const std::filesystem::path& file, const dynamics::ResponseModel& response,
                           const study::ResponseErrors& errors, const std::vector<std::string>& points) {
  io::Table table{{"frequency_hz", std::vector<double>(response.axis.hz.begin(), response.axis.hz.end())}};
  const std::vector<Index> rows = rows_at(response, points);
  add_columns(table, "noise_deviation", response, errors.noise, rows);
  add_columns(table, "truncation", response, errors.truncation, rows);
  io::write_csv(
      file, table,
      {"of each entry, in its unit (m/N): noise_deviation, the standard deviation of its real and imaginary part",
       "by the noise of the measured FRFs; truncation, the modulus of what the part's reduction leaves out"});
}

}  // namespace thinwall::report
