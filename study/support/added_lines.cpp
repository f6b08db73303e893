#include "study/support/added_lines.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "dynamics/conversion.hpp"
#include "dynamics/round_circles.hpp"
#include "study/support/support_stage.hpp"

namespace thinwall::study {

namespace {

using Eigen::Index;

bool is_model(const std::optional<Component>& component) {
  return component && (component->modal || component->spatial);
}

/// A component's response at these lines, as component() and robot_component() have it.
dynamics::ResponseModel response_at(const Component& component, const dynamics::FrequencyAxis& axis) {
  const bool by_matrices = component.spatial && (!component.modal || component.spatial->has_structural_damping());
  return by_matrices ? dynamics::direct_response(*component.spatial, axis)
                     : dynamics::to_response(*component.modal, axis);
}

AddedLines responses_at(const coupling::CouplingOptions& options, const Results& results,
                        const dynamics::FrequencyAxis& axis) {
  AddedLines at;
  if (is_model(results.part)) at.part = response_at(*results.part, axis);
  if (is_model(results.robot)) at.robot = response_at(*results.robot, axis);
  if (!results.coupled || !at.part || !at.robot) return at;
  const Component part{results.part->spatial, results.part->modal, *at.part};
  const Component robot{results.robot->spatial, results.robot->modal, *at.robot};
  CoupledResponses both = coupled_responses(contacts_of(results.contacts), options, part, robot);
  at.coupled = std::move(both.receptance);
  at.coupled_spatial = std::move(both.spatial);
  return at;
}

/// Nyquist curves of the driving points of all responses.
struct Curves {
  Eigen::VectorXd hz;       ///< ascending
  Eigen::MatrixXcd values;  ///< lines × driving points
};

Curves curves_of(const std::vector<const dynamics::ResponseModel*>& responses) {
  Index columns = 0;
  for (const auto* response : responses) columns += response->H.front().diagonal().size();
  Curves curves{responses.front()->axis.hz, Eigen::MatrixXcd(responses.front()->axis.size(), columns)};
  for (Index line = 0; line < curves.hz.size(); ++line) {
    Index column = 0;
    for (const auto* response : responses) {
      const Eigen::VectorXcd own = response->H[static_cast<std::size_t>(line)].diagonal();
      curves.values.row(line).segment(column, own.size()) = own.transpose();
      column += own.size();
    }
  }
  return curves;
}

std::vector<const dynamics::ResponseModel*> list_of(const AddedLines& lines) {
  std::vector<const dynamics::ResponseModel*> list;
  for (const auto* response : {&lines.part, &lines.robot, &lines.coupled}) {
    if (*response) list.push_back(&**response);
  }
  return list;
}

/// The responses of the run that have further lines.
std::vector<const dynamics::ResponseModel*> list_of(const Results& results) {
  std::vector<const dynamics::ResponseModel*> list;
  if (is_model(results.part)) list.push_back(&results.part->response);
  if (is_model(results.robot)) list.push_back(&results.robot->response);
  if (results.coupled && list.size() == 2) list.push_back(&results.coupled->receptance.response);
  return list;
}

void merge(const Curves& more, Curves& curves) {
  std::multimap<double, std::pair<const Curves*, Index>> lines;
  for (const Curves* of : {&std::as_const(curves), &more}) {
    for (Index line = 0; line < of->hz.size(); ++line) lines.emplace(of->hz(line), std::pair(of, line));
  }
  Curves merged{Eigen::VectorXd(std::ssize(lines)), Eigen::MatrixXcd(std::ssize(lines), curves.values.cols())};
  Index at = 0;
  for (const auto& [hz, from] : lines) {
    merged.hz(at) = hz;
    merged.values.row(at++) = from.first->values.row(from.second);
  }
  curves = std::move(merged);
}

void append(const std::optional<dynamics::ResponseModel>& more, std::optional<dynamics::ResponseModel>& all) {
  if (!more) return;
  if (!all) {
    all = more;
    return;
  }
  Eigen::VectorXd hz(all->axis.size() + more->axis.size());
  hz << all->axis.hz, more->axis.hz;
  all->axis.hz = hz;
  all->H.insert(all->H.end(), more->H.begin(), more->H.end());
}

void sort_lines(std::optional<dynamics::ResponseModel>& response) {
  if (!response) return;
  std::vector<Index> order(response->H.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  std::ranges::sort(order, {}, [&](Index line) { return response->axis.hz(line); });
  std::vector<Eigen::MatrixXcd> H;
  H.reserve(order.size());
  for (const Index line : order) H.push_back(std::move(response->H[static_cast<std::size_t>(line)]));
  response->H = std::move(H);
  response->axis.hz = Eigen::VectorXd(response->axis.hz(order));
}

/// Resonances of a model that lie between lines farther apart than its half width, with one half width to either side.
void add_missed_poles(const std::optional<dynamics::ModalModel>& modal, const Eigen::VectorXd& hz,
                      std::vector<double>& wanted) {
  if (!modal) return;
  for (const int k : dynamics::oscillating_modes(*modal)) {
    const double at_hz = std::abs(modal->poles(k)) / (2.0 * std::numbers::pi);
    const double half_width = std::abs(modal->poles(k).real()) / (2.0 * std::numbers::pi);
    const auto above = std::upper_bound(hz.begin(), hz.end(), at_hz);
    if (half_width <= 1e-9 * at_hz) continue;  // no circle, and no receptance at the pole
    if (above == hz.begin() || above == hz.end() || *above - *(above - 1) < half_width) continue;
    for (const double line : {at_hz - half_width, at_hz, at_hz + half_width}) {
      if (line > hz(0) && line < hz(hz.size() - 1)) wanted.push_back(line);
    }
  }
}

/// Those of the wanted lines that are none yet, ascending.
std::vector<double> new_lines(std::vector<double> wanted, const Eigen::VectorXd& hz) {
  std::ranges::sort(wanted);
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-9 * b; };
  wanted.erase(std::unique(wanted.begin(), wanted.end(), same), wanted.end());
  std::erase_if(wanted, [&](double line) {
    const auto above = std::lower_bound(hz.begin(), hz.end(), line);
    return (above != hz.end() && same(*above, line)) || (above != hz.begin() && same(*(above - 1), line));
  });
  return wanted;
}

}  // namespace

AddedLines added_lines(const coupling::CouplingOptions& options, const Results& results) {
  constexpr int most_rounds = 8;
  AddedLines added;
  const auto known = list_of(results);
  if (known.empty() || known.front()->axis.size() < 3) return added;
  Curves curves = curves_of(known);
  const Index most = curves.hz.size() + curves.hz.size() / 2;
  std::vector<double> wanted;
  for (const auto* component : {&results.part, &results.robot}) {
    if (is_model(*component)) add_missed_poles((*component)->modal, curves.hz, wanted);
  }
  if (results.coupled && known.size() == 3) add_missed_poles(results.coupled->modal, curves.hz, wanted);
  for (int round = 0; round < most_rounds; ++round) {
    const std::vector<double> circles = dynamics::lines_to_add(curves.hz, curves.values);
    wanted.insert(wanted.end(), circles.begin(), circles.end());
    std::vector<double> lines = new_lines(std::exchange(wanted, {}), curves.hz);
    lines.resize(std::min(lines.size(), static_cast<std::size_t>(most - curves.hz.size())));
    if (lines.empty()) break;
    const AddedLines more = responses_at(options, results, {Eigen::VectorXd::Map(lines.data(), std::ssize(lines))});
    merge(curves_of(list_of(more)), curves);
    append(more.part, added.part);
    append(more.robot, added.robot);
    append(more.coupled, added.coupled);
    append(more.coupled_spatial, added.coupled_spatial);
  }
  for (auto* response : {&added.part, &added.robot, &added.coupled, &added.coupled_spatial}) sort_lines(*response);
  return added;
}

}  // namespace thinwall::study
