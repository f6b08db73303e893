#include "milling/cut/contact_grid.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "core/dense_factorisations.hpp"
#include "core/gauss_rule.hpp"
#include "milling/cut/cut_cycle.hpp"
#include "milling/cut/edge.hpp"
#include "milling/cut/product_rule.hpp"

namespace thinwall::milling {

namespace {

double longest_of(const std::vector<CutStretch>& stretches) {
  double longest = 0.0;
  for (const CutStretch& s : stretches) longest = std::max(longest, s.to_rad - s.from_rad);
  return longest;
}

void add_elements(const CutCycle& cycle, Resolution resolution, ContactGrid& grid) {
  const std::vector<CutStretch> stretches = cut_stretches(cycle);
  const double longest = longest_of(stretches);
  const core::GaussRule rule = core::gauss_legendre(resolution.nodes);
  std::vector<double> nodes;
  for (const CutStretch& s : stretches) {
    const double share = (s.to_rad - s.from_rad) / longest;
    const int count = std::max(1, static_cast<int>(std::ceil(share * resolution.elements - 1e-9)));
    const double length = (s.to_rad - s.from_rad) / count;
    for (int e = 0; e < count; ++e) {
      const double from = s.from_rad + e * length;
      grid.elements.push_back({from, from + length, static_cast<int>(nodes.size()), resolution.nodes});
      for (const double c : rule.node) nodes.push_back(from + c * length);
    }
  }
  grid.node_rad = Eigen::Map<const Eigen::VectorXd>(nodes.data(), static_cast<Eigen::Index>(nodes.size()));
}

/// A share of the displacement at a node.
struct ContactMoment {
  int node = 0;
  bool previous_period = true;
  double weight = 1.0;
};

/// The displacement at `theta_rad`, which may lie in the previous period, from the nodes of its element.
std::vector<ContactMoment> past_at(const ContactGrid& grid, double theta_rad) {
  const bool previous = theta_rad < 0.0;
  const double theta = previous ? theta_rad + grid.period_rad : theta_rad;
  const auto distance = [&](const CutElement& e) { return std::max({0.0, e.from_rad - theta, theta - e.to_rad}); };
  const auto element =
      std::min_element(grid.elements.begin(), grid.elements.end(),
                       [&](const CutElement& a, const CutElement& b) { return distance(a) < distance(b); });
  const double length = element->to_rad - element->from_rad;
  const Eigen::VectorXd place =
      (grid.node_rad.segment(element->first_node, element->nodes).array() - element->from_rad) / length;
  const Eigen::VectorXd weight = lagrange_polynomials(place, (theta - element->from_rad) / length);
  std::vector<ContactMoment> past;
  for (int i = 0; i < element->nodes; ++i) {
    if (std::abs(weight(i)) > 1e-14) past.push_back({element->first_node + i, previous, weight(i)});
  }
  return past;
}

/// The force of an edge, or of a height of it, at a node: D [q(t_node) − Σ weight q(past)].
struct Regeneration {
  Eigen::Matrix3d D;
  std::vector<ContactMoment> past;
};

/// Adds as many contacts as D has rank, for each of them is a row and a column of the loop's gain. They see the axes as
/// far as D does, the first of which it sees a quarter first, and change little where D does: an eigenvalue is followed
/// by its vectors from one depth to the next. Singular vectors would change their signs, and turn freely where two
/// teeth a quarter of a turn apart are in the cut, whose singular values are equal. Their signs follow those of the
/// node before, so that the contacts of an arc are smooth, as eigenvectors of low frequencies are, from which searches
/// begin.
void add_by_rank(const Regeneration& one, int node, std::vector<EdgeContact>& contacts) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(one.D, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Index rank = (svd.singularValues().array() > 1e-13 * svd.singularValues()(0)).count();
  Eigen::Matrix3d seen = svd.matrixV().leftCols(rank) * svd.matrixV().leftCols(rank).transpose();  // a projection
  for (Eigen::Index k = 0; k < rank; ++k) {
    Eigen::Index axis = 0;
    while (axis < 2 && seen(axis, axis) < 0.25) ++axis;
    Eigen::Vector3d chip = seen.col(axis).normalized();
    seen -= chip * chip.transpose();
    const auto alike = std::ssize(contacts) - rank;  // the contact as many before, of the same place in its node
    if (alike >= 0) {
      const EdgeContact& before = contacts[static_cast<std::size_t>(alike)];
      if (before.node + 1 == node && chip.dot(before.chip) < 0.0) chip = -chip;
    }
    contacts.push_back({node, one.D * chip, chip, {}});
    for (const ContactMoment& m : one.past)
      contacts.back().past.push_back({m.node, m.previous_period, m.weight * contacts.back().chip});
  }
}

/// A contact for each direction, whatever the number of delays.
void add_by_direction(const std::vector<Regeneration>& all, const Eigen::Matrix3Xd& directions, int node,
                      std::vector<EdgeContact>& contacts) {
  Eigen::Matrix3d now = Eigen::Matrix3d::Zero();
  std::map<std::pair<int, bool>, Eigen::Matrix3d> before;
  double size = 0.0;  // so that what a contact sees is a displacement
  for (const Regeneration& one : all) {
    size += one.D.norm();
    now += one.D;
    for (const ContactMoment& m : one.past)
      before.try_emplace({m.node, m.previous_period}, Eigen::Matrix3d::Zero()).first->second += m.weight * one.D;
  }
  if (size == 0.0) return;
  for (const auto& direction : directions.colwise()) {
    contacts.push_back({node, size * direction, now.transpose() * direction / size, {}});
    for (const auto& [moment, D] : before)
      contacts.back().past.push_back({moment.first, moment.second, D.transpose() * direction / size});
  }
}

Eigen::Matrix3d mean_over_depth(const EdgeShape& shape, const CuttingCoefficients& k, const Sweep& sweep, double s) {
  const Heights h = heights_in_cut(sweep, s);
  return edge_matrix(shape, k, sweep.entry_phi_rad + s, sweep.lag_rad, h.low, h.high);
}

/// All edges that cut at a node and have one delay, the period.
Eigen::Matrix3d sum_of_edges(const CutCycle& cycle, const EdgeShape& shape, double theta) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  for (const Sweep& sweep : cycle.sweeps) {
    each_pass(cycle, sweep, theta, [&](double s) { sum += mean_over_depth(shape, sweep.coefficients, sweep, s); });
  }
  return sum;
}

/// One edge at a node, s rad after its tip entered: its own delay, or one for each of its heights.
void add_edge(const Sweep& sweep, const EdgeShape& shape, double s, int node, const Eigen::Matrix3d& onto,
              const ContactGrid& grid, std::vector<Regeneration>& all) {
  const double theta = grid.node_rad(node);
  if (sweep.one_delay()) {
    all.push_back(
        {mean_over_depth(shape, sweep.coefficients, sweep, s) * onto, past_at(grid, theta - sweep.pitch_rad)});
    return;
  }
  const Heights h = heights_in_cut(sweep, s);
  for (const EdgeWeight& w : edge_weights(shape, 6, h.low, h.high)) {
    const Eigen::Matrix3d D =
        directional_matrix_on(sweep.coefficients, w.kappa_rad, sweep.entry_phi_rad + s - w.height * sweep.lag_rad);
    all.push_back({w.weight * D * onto, past_at(grid, theta - sweep.delay_rad(w.height))});
  }
}

/// The pasts with which a contact sees dq/dφ instead of q: the polynomial of the element has the slope
/// Σ d_j q(φ_j) at the node, and q − Σ weight q(past) is that slope, in m a rad, with weight = [own node] − d_j.
std::vector<ContactMoment> slope_at(const ContactGrid& grid, const CutElement& element, int node) {
  const int own = node - element.first_node;
  const Eigen::VectorXd slope = lagrange_slopes(grid.node_rad.segment(element.first_node, element.nodes), own);
  std::vector<ContactMoment> past;
  past.reserve(static_cast<std::size_t>(element.nodes));
  for (int j = 0; j < element.nodes; ++j)
    past.push_back({element.first_node + j, false, (j == own ? 1.0 : 0.0) - slope(j)});
  return past;
}

void add_process_damping(const MillingProcess& process, const CutCycle& cycle, const EdgeShape& shape,
                         const Eigen::Matrix3d& onto, ContactGrid& grid) {
  const CuttingCoefficients k = per_slope(process.damping, process.cutter);
  for (const CutElement& element : grid.elements) {
    for (int node = element.first_node; node < element.first_node + element.nodes; ++node) {
      Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
      for (const Sweep& sweep : cycle.sweeps) {
        each_pass(cycle, sweep, grid.node_rad(node), [&](double s) { sum += mean_over_depth(shape, k, sweep, s); });
      }
      add_by_rank({sum * onto, slope_at(grid, element, node)}, node, grid.contacts);
    }
  }
  grid.one_delay = false;
}

}  // namespace

double longest_stretch_rad(const MillingProcess& process, double depth_m) {
  return longest_of(cut_stretches(cut_cycle(process, depth_m)));
}

ContactGrid contact_grid(const MillingProcess& process, const Eigen::Matrix3Xd& yielding, Resolution resolution,
                         double depth_m) {
  const CutCycle cycle = cut_cycle(process, depth_m);
  const EdgeShape shape = edge_shape(process.cutter, depth_m);
  const Eigen::Matrix3d onto = yielding * yielding.transpose();
  ContactGrid grid;
  grid.period_rad = cycle.period_rad;
  grid.one_delay = cycle.equal_teeth;
  add_elements(cycle, resolution, grid);
  for (int node = 0; node < static_cast<int>(grid.node_rad.size()); ++node) {
    std::vector<Regeneration> all;
    if (cycle.equal_teeth) {
      all.push_back({sum_of_edges(cycle, shape, grid.node_rad(node)) * onto, {{node, true, 1.0}}});
    } else {
      for (const Sweep& sweep : cycle.sweeps)
        each_pass(cycle, sweep, grid.node_rad(node),
                  [&](double s) { add_edge(sweep, shape, s, node, onto, grid, all); });
    }
    if (all.size() == 1) add_by_rank(all.front(), node, grid.contacts);
    else add_by_direction(all, yielding, node, grid.contacts);
  }
  if (process.damping.C > 0.0) add_process_damping(process, cycle, shape, onto, grid);
  return grid;
}

}  // namespace thinwall::milling
