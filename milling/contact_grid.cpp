#include "milling/contact_grid.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "milling/product_rule.hpp"

namespace thinwall::milling {

namespace {

/// A tooth, or all of them where they are alike: the tip enters the cut at `entry_rad` of the period.
struct Edge {
  double entry_rad = 0.0;
  double pitch_rad = 0.0;      ///< at the tip, to the edge ahead
  double lag_rad = 0.0;        ///< of the edge at the depth behind its tip
  double ahead_lag_rad = 0.0;  ///< of the edge ahead
};

/// The process over its period.
struct Cycle {
  double period_rad = 0.0;
  double arc_rad = 0.0;
  std::vector<Edge> edges;
};

Cycle cycle_of(const MillingProcess& process, double depth_m) {
  const Cutter& cutter = process.cutter;
  Cycle cycle{cutter.equal_teeth() ? cutter.pitch_rad() : 2.0 * std::numbers::pi, process.engagement.arc_rad(), {}};
  double entry = 0.0;
  const int edges = cutter.equal_teeth() ? 1 : cutter.teeth;
  for (int j = 0; j < edges; ++j) {
    const int ahead = (j + cutter.teeth - 1) % cutter.teeth;
    if (j > 0) entry += cutter.pitch_rad(j);
    cycle.edges.push_back(
        {entry, cutter.pitch_rad(j), depth_m * cutter.lag_rad_per_m(j), depth_m * cutter.lag_rad_per_m(ahead)});
  }
  return cycle;
}

/// body(s) for every rotation s since the edge's tip entered, of this and earlier periods, while any of it may cut.
template <class Body>
void each_pass(const Cycle& cycle, const Edge& edge, double theta, const Body& body) {
  double s = std::fmod(theta - edge.entry_rad + cycle.period_rad, cycle.period_rad);
  for (; s < cycle.arc_rad + edge.lag_rad; s += cycle.period_rad) body(s);
}

bool cuts(const Cycle& cycle, const Edge& edge, double theta) {
  bool in_cut = false;
  each_pass(cycle, edge, theta, [&](double) { in_cut = true; });
  return in_cut;
}

/// Where the cut is not smooth, from 0 to the period, ascending.
std::vector<double> breaks_of(const Cycle& cycle) {
  constexpr double same = 1e-9;
  const auto within = [&](double theta) { return std::fmod(theta + 2.0 * cycle.period_rad, cycle.period_rad); };
  std::vector<double> breaks;
  for (const Edge& e : cycle.edges) {
    for (const double s : {0.0, cycle.arc_rad, e.lag_rad, cycle.arc_rad + e.lag_rad})
      breaks.push_back(std::fmod(e.entry_rad + s, cycle.period_rad));
  }
  if (cycle.edges.size() > 1) {
    const std::vector<double> first = breaks;
    for (const Edge& e : cycle.edges) {
      for (const double b : first) {
        const double again = within(b + e.pitch_rad);
        if (e.lag_rad == e.ahead_lag_rad && cuts(cycle, e, again)) breaks.push_back(again);
      }
    }
  }
  breaks.push_back(0.0);
  breaks.push_back(cycle.period_rad);
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end(), [](double a, double b) { return b - a < same; }),
               breaks.end());
  breaks.back() = cycle.period_rad;
  return breaks;
}

/// Stretches between breaks in which some edge cuts.
std::vector<CutElement> stretches_of(const Cycle& cycle) {
  const std::vector<double> breaks = breaks_of(cycle);
  std::vector<CutElement> stretches;
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double middle = 0.5 * (breaks[i - 1] + breaks[i]);
    const bool in_cut =
        std::any_of(cycle.edges.begin(), cycle.edges.end(), [&](const Edge& e) { return cuts(cycle, e, middle); });
    if (in_cut) stretches.push_back({breaks[i - 1], breaks[i], 0, 0});
  }
  return stretches;
}

double longest_of(const std::vector<CutElement>& stretches) {
  double longest = 0.0;
  for (const CutElement& s : stretches) longest = std::max(longest, s.to_rad - s.from_rad);
  return longest;
}

void add_elements(const Cycle& cycle, Resolution resolution, ContactGrid& grid) {
  const std::vector<CutElement> stretches = stretches_of(cycle);
  const double longest = longest_of(stretches);
  const GaussRule rule = gauss_legendre(resolution.nodes);
  std::vector<double> nodes;
  for (const CutElement& s : stretches) {
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

/// The displacement at `theta_rad`, which may lie in the previous period, from the nodes of its element.
std::vector<Past> past_at(const ContactGrid& grid, double theta_rad) {
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
  std::vector<Past> past;
  for (int i = 0; i < element->nodes; ++i) {
    if (std::abs(weight(i)) > 1e-14) past.push_back({element->first_node + i, previous, weight(i)});
  }
  return past;
}

/// A = Σ force chipᵀ with as few terms as its rank has.
void add_contacts(const Eigen::Matrix3d& A, int node, const std::vector<Past>& past, std::vector<Contact>& contacts) {
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(A, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::Vector3d& size = svd.singularValues();
  for (int k = 0; k < 3 && size(k) > 1e-13 * size(0); ++k)
    contacts.push_back({node, size(k) * svd.matrixU().col(k), svd.matrixV().col(k), past});
}

/// The mean over the depth of one edge's directional matrix, s rad after its tip entered: heights from `low` to `high`,
/// shares of the depth, are in the cut.
struct Heights {
  double low = 0.0, high = 1.0;
};

Heights in_cut(const Cycle& cycle, const Edge& edge, double s) {
  if (edge.lag_rad == 0.0) return {};
  return {std::clamp((s - cycle.arc_rad) / edge.lag_rad, 0.0, 1.0), std::clamp(s / edge.lag_rad, 0.0, 1.0)};
}

Eigen::Matrix3d whole_edge(const MillingProcess& process, const Cycle& cycle, const Edge& edge, double s) {
  const Heights h = in_cut(cycle, edge, s);
  const double entry = process.engagement.entry_rad;
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  A.leftCols<2>() = (h.high - h.low) * mean_directional_matrix(process.coefficients, entry + s - h.high * edge.lag_rad,
                                                               entry + s - h.low * edge.lag_rad);
  return A;
}

}  // namespace

double longest_stretch_rad(const MillingProcess& process, double depth_m) {
  return longest_of(stretches_of(cycle_of(process, depth_m)));
}

ContactGrid contact_grid(const MillingProcess& process, const Eigen::Matrix3Xd& yielding, Resolution resolution,
                         double depth_m) {
  constexpr int slices = 6;
  const Cycle cycle = cycle_of(process, depth_m);
  const Eigen::Matrix3d onto = yielding * yielding.transpose();
  const GaussRule slice = gauss_legendre(slices);
  ContactGrid grid;
  grid.period_rad = cycle.period_rad;
  grid.one_delay = cycle.edges.size() == 1;
  add_elements(cycle, resolution, grid);
  for (int node = 0; node < static_cast<int>(grid.node_rad.size()); ++node) {
    const double theta = grid.node_rad(node);
    Eigen::Matrix3d all = Eigen::Matrix3d::Zero();
    for (const Edge& edge : cycle.edges) {
      each_pass(cycle, edge, theta, [&](double s) {
        if (grid.one_delay) {
          all += whole_edge(process, cycle, edge, s);
        } else if (edge.lag_rad == edge.ahead_lag_rad) {
          add_contacts(whole_edge(process, cycle, edge, s) * onto, node, past_at(grid, theta - edge.pitch_rad),
                       grid.contacts);
        } else {
          const Heights h = in_cut(cycle, edge, s);
          for (int k = 0; k < slices; ++k) {
            const double height = h.low + (h.high - h.low) * slice.node(k);
            const double delay = edge.pitch_rad + height * (edge.lag_rad - edge.ahead_lag_rad);
            Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
            A.leftCols<2>() =
                slice.weight(k) * (h.high - h.low) *
                directional_matrix(process.coefficients, process.engagement.entry_rad + s - height * edge.lag_rad);
            add_contacts(A * onto, node, past_at(grid, theta - delay), grid.contacts);
          }
        }
      });
    }
    if (grid.one_delay) add_contacts(all * onto, node, {{node, true, 1.0}}, grid.contacts);
  }
  return grid;
}

}  // namespace thinwall::milling
