#include "identification/tracking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>

#include "core/error.hpp"
#include "identification/assignment.hpp"

namespace thinwall::identification {

namespace {

constexpr double most_unlike = 3.0;

double mac(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  return std::norm(a.dot(b)) / (a.squaredNorm() * b.squaredNorm());
}

/// A mode in one frame and, where it is known, in another.
struct Seen {
  const FittedMode* mode = nullptr;
  const FittedMode* turned = nullptr;
};

using Modes = std::vector<Seen>;

/// The lesser of the frames'.
double unlikeness_of(const Seen& a, const Seen& b) {
  const double plain = unlikeness(*a.mode, *b.mode);
  return a.turned == nullptr ? plain : std::min(plain, unlikeness(*a.turned, *b.turned));
}

Eigen::MatrixXd unlikeness_of(const Modes& a, const Modes& b) {
  Eigen::MatrixXd cost(static_cast<Eigen::Index>(a.size()), static_cast<Eigen::Index>(b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j)
      cost(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = unlikeness_of(a[i], b[j]);
  }
  return cost;
}

/// The cost of the cheapest pairing of the modes of two postures; a mode without a partner costs as one that is most
/// unlike.
double difference(const Modes& a, const Modes& b) {
  double sum = most_unlike * static_cast<double>(std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
  if (a.empty() || b.empty()) return sum;
  const Eigen::MatrixXd cost = unlikeness_of(a, b);
  const std::vector<int> pair = cheapest_pairing(cost);
  for (std::size_t i = 0; i < pair.size(); ++i)
    if (pair[i] >= 0) sum += std::min(most_unlike, cost(static_cast<Eigen::Index>(i), pair[i]));
  return sum;
}

/// The differences of all pairs of postures.
Eigen::MatrixXd differences(const std::vector<Modes>& postures) {
  const auto n = static_cast<Eigen::Index>(postures.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j)
      result(i, j) = result(j, i) =
          difference(postures[static_cast<std::size_t>(i)], postures[static_cast<std::size_t>(j)]);
  }
  return result;
}

/// The shortest spanning tree: postures in the order in which they join, and the parent of each.
struct Tree {
  std::vector<std::size_t> order;
  std::vector<int> parent;
};

Tree spanning_tree(const Eigen::MatrixXd& distance, Eigen::Index root) {
  const Eigen::Index n = distance.rows();
  Tree tree{{}, std::vector<int>(static_cast<std::size_t>(n), -1)};
  Eigen::VectorXd to_tree = distance.col(root);
  std::vector<int> nearest(static_cast<std::size_t>(n), static_cast<int>(root));
  to_tree(root) = -1.0;
  std::vector<bool> joined(static_cast<std::size_t>(n), false);
  for (Eigen::Index k = 0; k < n; ++k) {
    Eigen::Index next = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!joined[static_cast<std::size_t>(i)] && (next < 0 || to_tree(i) < to_tree(next))) next = i;
    }
    const auto at = static_cast<std::size_t>(next);
    joined[at] = true;
    tree.order.push_back(at);
    if (next != root) tree.parent[at] = nearest[at];
    for (Eigen::Index i = 0; i < n; ++i) {
      if (joined[static_cast<std::size_t>(i)] || distance(i, next) >= to_tree(i)) continue;
      to_tree(i) = distance(i, next);
      nearest[static_cast<std::size_t>(i)] = static_cast<int>(next);
    }
  }
  return tree;
}

/// The modes of the labels that a posture's ancestors have, each of the nearest one.
std::map<int, Seen> known_modes(const std::vector<Modes>& postures, const Tracking& tracking, int ancestor) {
  std::map<int, Seen> known;
  for (; ancestor >= 0; ancestor = tracking.parent[static_cast<std::size_t>(ancestor)]) {
    const auto at = static_cast<std::size_t>(ancestor);
    for (std::size_t k = 0; k < tracking.label[at].size(); ++k) known.emplace(tracking.label[at][k], postures[at][k]);
  }
  return known;
}

void label(const std::vector<Modes>& postures, std::size_t at, Tracking& tracking) {
  const Modes& modes = postures[at];
  std::vector<int>& labels = tracking.label[at];
  labels.assign(modes.size(), -1);
  std::vector<int> known_labels;
  Modes known;
  for (const auto& [name, mode] : known_modes(postures, tracking, tracking.parent[at])) {
    known_labels.push_back(name);
    known.push_back(mode);
  }
  if (!known.empty() && !modes.empty()) {
    const Eigen::MatrixXd cost = unlikeness_of(known, modes);
    const std::vector<int> pair = cheapest_pairing(cost);
    for (std::size_t i = 0; i < pair.size(); ++i) {
      if (pair[i] >= 0 && cost(static_cast<Eigen::Index>(i), pair[i]) <= most_unlike)
        labels[static_cast<std::size_t>(pair[i])] = known_labels[i];
    }
  }
  for (int& name : labels) {
    if (name < 0) name = tracking.labels++;
  }
}

/// Numbers the labels by the mean logarithm of their frequencies.
void number(const std::vector<Modes>& postures, Tracking& tracking) {
  std::vector<double> sum(static_cast<std::size_t>(tracking.labels), 0.0), count = sum;
  for (std::size_t i = 0; i < postures.size(); ++i) {
    for (std::size_t k = 0; k < postures[i].size(); ++k) {
      const auto name = static_cast<std::size_t>(tracking.label[i][k]);
      sum[name] += std::log(postures[i][k].mode->frequency_hz);
      count[name] += 1.0;
    }
  }
  std::vector<std::size_t> order(sum.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return sum[a] / count[a] < sum[b] / count[b]; });
  std::vector<int> number_of(sum.size());
  for (std::size_t i = 0; i < order.size(); ++i) number_of[order[i]] = static_cast<int>(i);
  for (std::vector<int>& labels : tracking.label) {
    for (int& name : labels) name = number_of[static_cast<std::size_t>(name)];
  }
}

using Neighbours = std::vector<std::vector<std::size_t>>;

/// Adds the `number` nearest of each posture to its neighbours.
void add_nearest(const Eigen::MatrixXd& distance, int number, Neighbours& neighbours) {
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    const auto column = distance.col(static_cast<Eigen::Index>(i));
    std::vector<std::size_t> nearest;
    for (std::size_t k = 0; k < neighbours.size(); ++k) {
      if (k != i) nearest.push_back(k);
    }
    std::ranges::stable_sort(nearest, {}, [&](std::size_t k) { return column(static_cast<Eigen::Index>(k)); });
    nearest.resize(std::min(nearest.size(), static_cast<std::size_t>(number)));
    for (const std::size_t k : nearest) {
      if (std::ranges::find(neighbours[i], k) == neighbours[i].end()) neighbours[i].push_back(k);
    }
  }
}

/// The cost of each name of a posture at each of its modes, summed over the neighbours that have the name.
Eigen::MatrixXd costs_of_names(const std::vector<Modes>& postures, std::size_t at, const std::vector<int>& names,
                               const std::vector<std::size_t>& neighbours, const Tracking& tracking) {
  const auto modes = static_cast<Eigen::Index>(names.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(modes, modes);
  for (const std::size_t other : neighbours) {
    const std::vector<int>& labels = tracking.label[other];
    const Eigen::MatrixXd cost = unlikeness_of(postures[other], postures[at]);
    for (Eigen::Index l = 0; l < modes; ++l) {
      const auto found = std::ranges::find(labels, names[static_cast<std::size_t>(l)]);
      if (found != labels.end()) sum.row(l) += cost.row(found - labels.begin()).cwiseMin(most_unlike);
    }
  }
  return sum;
}

/// Makes a neighbour of each posture that has it as one.
void make_mutual(Neighbours& neighbours) {
  const Neighbours heard = neighbours;
  for (std::size_t i = 0; i < heard.size(); ++i) {
    for (const std::size_t k : heard[i]) {
      if (std::ranges::find(neighbours[k], i) == neighbours[k].end()) neighbours[k].push_back(i);
    }
  }
}

/// Exchanges the names of a posture's modes where that agrees better with all of its neighbours (iterated conditional
/// modes, Besag 1986), of which a tree hears one only. Neighbours must be mutual: then the sum of the costs over all
/// pairs of them falls with each exchange, so that the exchanges end.
void exchange_names(const std::vector<Modes>& postures, const Neighbours& neighbours, Tracking& tracking) {
  bool exchanged = true;
  while (exchanged) {
    exchanged = false;
    for (std::size_t at = 0; at < postures.size(); ++at) {
      if (postures[at].empty()) continue;
      std::vector<int>& labels = tracking.label[at];
      const std::vector<int> names = labels;
      const Eigen::MatrixXd cost = costs_of_names(postures, at, names, neighbours[at], tracking);
      const std::vector<int> mode = cheapest_pairing(cost);
      double saved = cost.trace();
      for (std::size_t l = 0; l < names.size(); ++l) saved -= cost(static_cast<Eigen::Index>(l), mode[l]);
      const bool falls = saved > 1e-9;  // false for NaN
      if (!falls) continue;
      for (std::size_t l = 0; l < names.size(); ++l) labels[static_cast<std::size_t>(mode[l])] = names[l];
      exchanged = true;
    }
  }
}

/// Votes of the nearest postures on each label of a posture.
void doubt(const std::vector<Modes>& postures, const Neighbours& nearest, Tracking& tracking) {
  for (std::size_t i = 0; i < postures.size(); ++i) {
    std::vector<int> votes(postures[i].size(), 0);
    for (const std::size_t other : nearest[i]) {
      const Modes& of_other = postures[other];
      if (of_other.empty() || postures[i].empty()) continue;
      const Eigen::MatrixXd cost = unlikeness_of(of_other, postures[i]);
      const std::vector<int> pair = cheapest_pairing(cost);
      for (std::size_t m = 0; m < pair.size(); ++m) {
        if (pair[m] < 0 || cost(static_cast<Eigen::Index>(m), pair[m]) > most_unlike) continue;
        const auto mine = static_cast<std::size_t>(pair[m]);
        votes[mine] += tracking.label[other][m] == tracking.label[i][mine] ? 1 : -1;
      }
    }
    for (std::size_t m = 0; m < votes.size(); ++m) tracking.doubtful[i][m] = votes[m] < 0;
  }
}

/// The distances of all pairs of places, whose columns count by their ranges.
Eigen::MatrixXd distances(const Eigen::MatrixXd& places) {
  Eigen::MatrixXd scaled = places;
  for (auto column : scaled.colwise()) {
    const double range = column.maxCoeff() - column.minCoeff();
    if (range > 0.0) column /= range;
  }
  Eigen::MatrixXd result(places.rows(), places.rows());
  for (Eigen::Index i = 0; i < places.rows(); ++i) result.col(i) = (scaled.rowwise() - scaled.row(i)).rowwise().norm();
  return result;
}

/// The names that modes have along a tree, numbered as they are met.
Tracking follow(const std::vector<Modes>& postures, const Tree& tree) {
  Tracking tracking;
  tracking.label.resize(postures.size());
  tracking.parent = tree.parent;
  for (const Modes& modes : postures) tracking.doubtful.emplace_back(modes.size(), false);
  for (const std::size_t at : tree.order) label(postures, at, tracking);
  return tracking;
}

/// Doubts the names that are not those of another way to the postures. A name of that way stands for the one with which
/// it shares most modes.
void doubt_by(const Tracking& other, Tracking& tracking) {
  Eigen::MatrixXi shared = Eigen::MatrixXi::Zero(other.labels, tracking.labels);
  for (std::size_t i = 0; i < other.label.size(); ++i) {
    for (std::size_t k = 0; k < other.label[i].size(); ++k) ++shared(other.label[i][k], tracking.label[i][k]);
  }
  std::vector<int> name(static_cast<std::size_t>(other.labels));
  for (Eigen::Index l = 0; l < shared.rows(); ++l) {
    Eigen::Index most = 0;
    shared.row(l).maxCoeff(&most);
    name[static_cast<std::size_t>(l)] = static_cast<int>(most);
  }
  for (std::size_t i = 0; i < other.label.size(); ++i) {
    for (std::size_t k = 0; k < other.label[i].size(); ++k) {
      if (name[static_cast<std::size_t>(other.label[i][k])] != tracking.label[i][k]) tracking.doubtful[i][k] = true;
    }
  }
}

void require_vectors(const std::vector<std::vector<FittedMode>>& postures) {
  for (std::size_t i = 0; i < postures.size(); ++i) {
    for (const FittedMode& mode : postures[i]) {
      if (mode.left.size() == 0 || mode.right.size() == 0)
        throw core::InputError("tracking: a mode of posture " + std::to_string(i + 1) +
                               " has no vectors; fit residues of rank one");
    }
  }
}

/// The modes in both frames. Throws InputError unless those of the second frame are as many.
std::vector<Modes> seen_in_frames(const std::vector<std::vector<FittedMode>>& postures,
                                  const std::vector<std::vector<FittedMode>>& turned) {
  if (!turned.empty() &&
      !std::ranges::equal(postures, turned, {}, &std::vector<FittedMode>::size, &std::vector<FittedMode>::size))
    throw core::InputError("tracking: the second frame has not as many postures and modes as the first");
  std::vector<Modes> seen(postures.size());
  for (std::size_t i = 0; i < postures.size(); ++i) {
    for (std::size_t k = 0; k < postures[i].size(); ++k)
      seen[i].push_back({&postures[i][k], turned.empty() ? nullptr : &turned[i][k]});
  }
  return seen;
}

}  // namespace

double unlikeness(const FittedMode& a, const FittedMode& b) {
  const double size_a = a.left.norm() * a.right.norm(), size_b = b.left.norm() * b.right.norm();
  return 1.0 - mac(a.left, b.left) * mac(a.right, b.right) + 8.0 * std::abs(std::log(a.frequency_hz / b.frequency_hz)) +
         0.5 * std::abs(std::log(a.damping_ratio / b.damping_ratio)) + 0.3 * std::abs(std::log(size_a / size_b));
}

Tracking track(const std::vector<std::vector<FittedMode>>& of_postures,
               const std::vector<std::vector<FittedMode>>& turned, const Eigen::MatrixXd& places, int neighbours) {
  if (of_postures.empty()) throw core::InputError("tracking: no posture, must be at least one");
  if (places.size() > 0 && places.rows() != std::ssize(of_postures))
    throw core::InputError("tracking: " + std::to_string(places.rows()) + " places of " +
                           std::to_string(of_postures.size()) + " postures; give one for each or none");
  require_vectors(of_postures);
  require_vectors(turned);
  const std::vector<Modes> postures = seen_in_frames(of_postures, turned);
  const Eigen::MatrixXd distance = differences(postures);
  Eigen::Index middle = 0;
  distance.colwise().sum().minCoeff(&middle);
  Tracking tracking = follow(postures, spanning_tree(distance, middle));
  Neighbours alike(postures.size());
  add_nearest(distance, neighbours, alike);
  Neighbours near = alike;
  const Eigen::MatrixXd apart = places.size() > 0 ? distances(places) : Eigen::MatrixXd();
  if (places.size() > 0) add_nearest(apart, neighbours, near);
  make_mutual(near);
  exchange_names(postures, near, tracking);
  number(postures, tracking);
  doubt(postures, alike, tracking);
  if (places.size() > 0) doubt_by(follow(postures, spanning_tree(apart, middle)), tracking);
  return tracking;
}

}  // namespace thinwall::identification
